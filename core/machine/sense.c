/* Words on signals, gates and held bodies or agents. Targets are resolved in target.c. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "geom/walls.h"
#include "machine/machine_parts.h"
#include "machine/way_between.h"

/* Orders signals by name, x, agent. */
static bool is_signal_before(const JoxSignal *a, const JoxSignal *b) {
    if (a->name != b->name)
        return a->name < b->name;
    return a->x != b->x ? a->x < b->x : a->agent_id < b->agent_id;
}

void jox_signals_peek(JoxMachineRun *run) {
    const JoxMachineState *state = run->state;
    JoxMachineScratch *s = run->scratch;
    JOX_RESERVE(s->heard, s->heard_capacity, state->called_count);
    JOX_RESERVE(s->everywhere, s->everywhere_capacity, state->announced_count);
    uint32_t count = s->heard_count = state->called_count;
    if (count)
        memcpy(s->heard, state->called, count * sizeof *s->heard);
    s->everywhere_count = state->announced_count;
    if (s->everywhere_count)
        memcpy(s->everywhere, state->announced, s->everywhere_count * sizeof *s->everywhere);
    for (uint32_t gap = count / 2; gap > 0; gap = gap == 2 ? 1 : gap * 5 / 11)
        for (uint32_t k = gap; k < count; k++) {
            JoxSignal moving = s->heard[k];
            uint32_t at = k;
            for (; at >= gap && is_signal_before(&moving, &s->heard[at - gap]); at -= gap)
                s->heard[at] = s->heard[at - gap];
            s->heard[at] = moving;
        }
    JOX_CHECK(jox_heard_check(run));
}

/* Counts a signal that is heard in this step. */
static void count_call(const JoxMachineRun *run, uint32_t name, uint32_t agent_id, JoxV2 at) {
    JoxMachineState *state = run->state;
    if (name >= state->call_count) {
        JOX_RESERVE(state->calls, state->call_capacity, run->set->name_count);
        memset(state->calls + state->call_count, 0,
               (run->set->name_count - state->call_count) * sizeof *state->calls);
        state->call_count = run->set->name_count;
    }
    state->calls[name] =
        (JoxNameCall){state->calls[name].count + 1, run->tick, agent_id, at.x, at.y};
}

void jox_machines_listen(JoxMachineRun *run) {
    JoxMachineState *state = run->state;
    jox_signals_peek(run);
    if (run->watched_count)
        jox_watch_calls(run);
    for (uint32_t n = 0; n < state->called_count; n++) {
        const JoxSignal *called = &state->called[n];
        count_call(run, called->name, called->agent_id, (JoxV2){called->x, called->y});
    }
    for (uint32_t n = 0; n < state->announced_count; n++)
        count_call(run, state->announced[n], UINT32_MAX, (JoxV2){0.0f, 0.0f});
    state->called_count = state->announced_count = 0;
}

/* Returns whether an agent hears a signal that was called at an x from `low` on, at most r m away
   from where it is. */
static bool is_heard_from(const JoxMachineRun *run, uint32_t i, uint32_t name, float low, float r) {
    const JoxAgents *a = run->agents;
    const JoxMachineScratch *heard = run->scratch;
    const JoxSignal from = {.name = name, .x = low};
    const JoxV2 at = {a->x[i], a->y[i]};
    uint32_t first = 0, high = heard->heard_count;
    while (first < high) {
        const uint32_t middle = (first + high) / 2;
        if (is_signal_before(&heard->heard[middle], &from))
            first = middle + 1;
        else
            high = middle;
    }
    for (uint32_t n = first; n < heard->heard_count; n++) {
        const JoxSignal *s = &heard->heard[n];
        if (s->name != name || s->x > low + 2.0f * r)
            return false;
        const JoxV2 way = jox_way_to(a, at, jox_v2(s->x, s->y));
        if (s->agent_id != a->id[i] && jox_length2(way) <= r * r &&
            !jox_is_hidden(run, at, jox_add(at, way), false))
            return true;
    }
    return false;
}

bool jox_heard(const JoxMachineRun *run, uint32_t i, uint32_t name, double reach) {
    const JoxAgents *a = run->agents;
    const JoxMachineScratch *heard = run->scratch;
    for (uint32_t n = 0; n < heard->everywhere_count; n++)
        if (heard->everywhere[n] == name)
            return true;
    const float r = jox_minf((float)reach, jox_param(a, JOX_PARAM_perception, i));
    const float low = a->x[i] - r, period = a->period.x;
    return is_heard_from(run, i, name, low, r) ||
           (period > 0.0f && (is_heard_from(run, i, name, low - period, r) ||
                              is_heard_from(run, i, name, low + period, r)));
}

static const float AT_PLACE = 0.5f; /* m: a gate belongs to a place within this distance */

/* Returns whether an agent sees an edge of the gate that belongs to the place. */
static bool sees_gate(const JoxMachineRun *run, uint32_t i, uint32_t place, uint32_t gate) {
    const JoxWalls *walls = run->walls;
    const struct JoxWallRing *ring = &walls->rings[gate];
    const JoxV2 agent = {run->agents->x[i], run->agents->y[i]};
    const float perception = jox_param(run->agents, JOX_PARAM_perception, i);
    for (uint32_t v = ring->first; v < ring->first + ring->count; v++) {
        const JoxV2 a = walls->vertices[v].point,
                    b = walls->vertices[walls->vertices[v].next].point;
        const JoxV2 middle = jox_scale(jox_add(a, b), 0.5f);
        /* The agent's image next to the edge, over joined edges of the world and stairs. */
        const JoxV2 at = jox_sub(middle, jox_way_to(run->agents, agent, middle));
        if (jox_length(jox_sub(jox_segment_nearest(a, b, at), at)) <= perception &&
            jox_place_distance(run->places, place, middle) <= AT_PLACE &&
            !jox_is_hidden_by(run, gate, at, middle, false))
            return true;
    }
    return false;
}

bool jox_sees_shut(const JoxMachineRun *run, uint32_t i, int32_t place) {
    for (uint32_t r = 0; place >= 0 && run->walls && r < run->walls->ring_count; r++) {
        const struct JoxWallRing *ring = &run->walls->rings[r];
        if (ring->name && !ring->open && sees_gate(run, i, (uint32_t)place, r))
            return true;
    }
    return false;
}

bool jox_holds_target(const JoxMachineRun *run, uint32_t i, int32_t target) {
    const uint32_t grasped = run->agents->grasped[i];
    if (jox_held_body_row(run, i, target) >= 0)
        return true;
    if (!grasped)
        return false;
    const JoxTarget *t = &jox_machine_of(run, i)->targets[target];
    const uint32_t j = jox_agents_find(run->agents, grasped - 1);
    if (j == JOX_NO_INDEX || !jox_target_kind_moves(t->kind))
        return false;
    return jox_target_kind_chooses(t->kind) ? jox_is_wanted(run, t, i, j)
                                            : jox_target_who(run, i, target) == grasped;
}

int32_t jox_held_body_row(const JoxMachineRun *run, uint32_t i, int32_t target) {
    JOX_ASSERT(target >= 0 && target < (int32_t)jox_machine_of(run, i)->target_count);
    for (uint32_t o = 0; run->objects && o < run->objects->count; o++) {
        const JoxObject *object = &run->objects->rows[o];
        if (object->live && object->held && object->holder == run->agents->id[i] &&
            jox_target_means(run, i, target, (int32_t)o))
            return (int32_t)o;
    }
    return -1;
}

double jox_target_memory(const JoxMachineRun *run, uint32_t i, int32_t target, uint32_t name) {
    const JoxSpot spot = jox_target_find(run, i, target);
    const double value =
        spot.agent == JOX_NO_INDEX ? NAN : jox_public_memory(run, spot.agent, name);
    return isnan(value) ? 0.0 : value;
}
