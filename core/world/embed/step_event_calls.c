/* The public call jo_world_events: finds what happened in the last step, when a program asks. */
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "world/world.h"

static void read_transitions(const JoWorld *w, JoxStepEvents *h) {
    const JoxMachineRun *run = &w->machines;
    JOX_RESERVE(h->transitions, h->transition_capacity, run->taken_count);
    h->transition_count = 0;
    for (uint32_t k = 0; k < run->taken_count; k++) {
        const JoxTaken *t = &run->taken[k];
        h->transitions[h->transition_count++] =
            (JoTransitionEvent){t->agent_id, t->machine, t->from, t->to};
    }
}

static void read_signals(const JoWorld *w, JoxStepEvents *h) {
    const JoxMachineState *state = &w->state.machines;
    JOX_RESERVE(h->said, h->said_capacity, state->called_count);
    h->said_count = 0;
    for (uint32_t k = 0; k < state->called_count; k++) {
        const JoxSignal *s = &state->called[k];
        h->said[h->said_count++] = (JoSaidEvent){s->agent_id, s->name, s->x, s->y};
    }
}

/* ---- contacts that press ---- */

static int compare_touches(const JoxSeenTouch *a, const JoxSeenTouch *b) {
    if (a->agent != b->agent)
        return a->agent < b->agent ? -1 : 1;
    if (a->kind != b->kind)
        return a->kind < b->kind ? -1 : 1;
    return (a->other > b->other) - (a->other < b->other);
}

/* Merges the three lists of contacts, each in ascending ids, and marks contacts that are not in the
   previous list, which has the same order. */
static void read_touches(const JoWorld *w, JoxStepEvents *h) {
    const JoxKeptImpulse *list[3];
    size_t count[3], at[3] = {0, 0, 0}, before = 0;
    const float dt = (float)jox_world_substep_length(w);
    for (int k = 0; k < 3; k++) /* in the order of JoTouched */
        list[k] = jox_force_kept_impulses(
            w->scratch.forces, (JoxKeptKind[]){JOX_KEPT_PAIRS, JOX_KEPT_TOUCHES, JOX_KEPT_WALLS}[k],
            &count[k]);
    const size_t most = count[0] + count[1] + count[2];
    JOX_RESERVE(h->touches, h->touch_capacity, most);
    JOX_RESERVE(h->touching, h->touching_capacity, most);
    h->touch_count = 0;
    for (;;) {
        int next = -1;
        for (int k = 0; k < 3; k++) {
            while (at[k] < count[k] && !(list[k][at[k]].impulse > 0.0f))
                at[k]++; /* does not press */
            if (at[k] < count[k] && (next < 0 || list[k][at[k]].id < list[next][at[next]].id))
                next = k;
        }
        if (next < 0)
            break;
        const JoxKeptImpulse *one = &list[next][at[next]++];
        const JoxSeenTouch touch = {one->id, (uint32_t)next, one->other};
        while (before < h->touched_count && compare_touches(&h->touched[before], &touch) < 0)
            before++;
        const bool known =
            before < h->touched_count && compare_touches(&h->touched[before], &touch) == 0;
        h->touching[h->touch_count] = touch;
        h->touches[h->touch_count++] = (JoTouchEvent){.agent = touch.agent,
                                                      .kind = touch.kind,
                                                      .other = touch.other,
                                                      .began = !known,
                                                      .force = one->impulse / dt};
    }
    JoxSeenTouch *spare = h->touched;
    const size_t spare_capacity = h->touched_capacity;
    h->touched = h->touching;
    h->touched_capacity = h->touching_capacity;
    h->touched_count = h->touch_count;
    h->touching = spare;
    h->touching_capacity = spare_capacity;
}

/* ---- agents that entered, left, kicked, grasped, fell and got up ---- */

static void add_action(JoxStepEvents *h, const JoxAgents *a, uint32_t i, JoDone kind,
                       uint32_t other) {
    h->actions[h->action_count++] = (JoActionEvent){a->id[i], kind, other, a->x[i], a->y[i]};
}

static JoPresenceEvent make_presence(const JoxSeenAgent *seen) {
    return (JoPresenceEvent){seen->id, seen->group, seen->x, seen->y};
}

static void read_presence(const JoWorld *w, JoxStepEvents *h) {
    const JoxAgents *a = &w->state.agents;
    uint32_t before = 0;
    JOX_RESERVE(h->seeing, h->seeing_capacity, a->count);
    JOX_RESERVE(h->entered, h->entered_capacity, a->count);
    JOX_RESERVE(h->left, h->left_capacity, h->seen_count);
    JOX_RESERVE(h->actions, h->action_capacity, 3 * a->count); /* at most so many in one step */
    h->entered_count = h->left_count = h->action_count = 0;
    for (uint32_t r = 0; r < a->count; r++) {
        const uint32_t i = a->by_rank[r];
        const JoxSeenAgent now = {a->id[i], a->group[i], a->grasped[i],
                                  a->x[i],  a->y[i],     a->fallen[i] > 0.0f};
        JoxSeenAgent was = {0};
        while (before < h->seen_count && h->seen[before].id < now.id)
            h->left[h->left_count++] = make_presence(&h->seen[before++]);
        if (before < h->seen_count && h->seen[before].id == now.id)
            was = h->seen[before++];
        else
            h->entered[h->entered_count++] = make_presence(&now);
        if (a->kicked[i])
            add_action(h, a, i, JO_DONE_KICK, a->kicked[i] - 1);
        if (now.grasped && now.grasped != was.grasped)
            add_action(h, a, i, JO_DONE_GRASP, now.grasped - 1);
        if (now.lies != was.lies)
            add_action(h, a, i, now.lies ? JO_DONE_FALL : JO_DONE_RISE, 0);
        h->seeing[r] = now;
    }
    while (before < h->seen_count)
        h->left[h->left_count++] = make_presence(&h->seen[before++]);
    JoxSeenAgent *spare = h->seen;
    const size_t spare_capacity = h->seen_capacity;
    h->seen = h->seeing;
    h->seen_capacity = h->seeing_capacity;
    h->seen_count = a->count;
    h->seeing = spare;
    h->seeing_capacity = spare_capacity;
}

JoEvents jo_world_events(JoWorld *world) {
    JOX_REQUIRE(world && !world->busy, (JoEvents){0});
    JoxStepEvents *h = &world->scratch.step_events;
    const JoxAgents *a = &world->state.agents;
    JOX_GUARD (world->heap, NULL)
        return (JoEvents){0};
    const bool same = h->tick == world->state.tick + 1 && h->next_id == a->next_id &&
                      h->count == a->count; /* asked again in the same step */
    if (!same) {
        read_transitions(world, h);
        read_signals(world, h);
        read_touches(world, h);
        read_presence(world, h);
        h->tick = world->state.tick + 1;
        h->next_id = a->next_id;
        h->count = a->count;
    }
    return (JoEvents){.transitions = h->transitions,
                      .touches = h->touches,
                      .hits = h->hits,
                      .breaks = h->breaks,
                      .entered = h->entered,
                      .left = h->left,
                      .said = h->said,
                      .actions = h->actions,
                      .transition_count = h->transition_count,
                      .touch_count = h->touch_count,
                      .hit_count = h->hit_count,
                      .break_count = h->break_count,
                      .entered_count = h->entered_count,
                      .left_count = h->left_count,
                      .said_count = h->said_count,
                      .action_count = h->action_count};
}
