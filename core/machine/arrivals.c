/* Arrival in a crowd, for the condition `arrived`: people crowd round a place, and those who come
   last never get into it. So an agent has arrived, too, once agents who have arrived there before
   it have kept it from getting nearer for a while. The column `arrived_at` remembers the place. */
#include "base/mem.h"
#include "machine/machine_parts.h"
#include "machine/way_between.h"

#define KEPT_OFF 1.0f  /* s: an agent that is kept off for this time gets no nearer */
#define PROGRESS 0.25f /* share of its speed at which an agent at least gets nearer to a place */
#define BESIDE 0.3f    /* m: gap to those who keep it off */
#define AHEAD 0.5f     /* cosine of the greatest angle between the way and those who keep it off */

/* The agents of a batch: references to the places at which they have arrived, and to those that
   arrived agents keep them off. */
typedef struct Arrivals {
    uint32_t at[JOX_BATCH], kept_off[JOX_BATCH];
} Arrivals;

/* Returns whether an agent wants to move away from a place. */
static bool wants_away(const JoxMachineRun *run, uint32_t i, uint32_t place) {
    const JoxAgents *a = run->agents;
    const JoxV2 at = {a->x[i], a->y[i]}, wanted = {a->pref_x[i], a->pref_y[i]};
    const JoxV2 way = jox_sub(jox_place_nearest(run->places, place, at), at);
    return !jox_stands(a, i) && jox_dot(wanted, way) < 0.0f;
}

static bool is_in_place(const JoxMachineRun *run, uint32_t i, uint32_t place) {
    return jox_place_is_arrival(run->places, place, run->walls,
                                jox_v2(run->agents->x[i], run->agents->y[i]));
}

/* Returns whether an agent that has arrived at the place, or stands in it, keeps another off. */
static bool keeps_off(const JoxMachineRun *run, uint32_t keeper, uint32_t i, uint32_t place,
                      JoxV2 way) {
    const JoxAgents *a = run->agents;
    const JoxV2 at = {a->x[i], a->y[i]}, offset = jox_way_between(a, i, keeper);
    const float away = jox_length(offset);
    const float gap =
        away - jox_param(a, JOX_PARAM_radius, i) - jox_param(a, JOX_PARAM_radius, keeper);
    return gap <= BESIDE && jox_dot(offset, way) >= AHEAD * away &&
           (a->arrived_at[keeper] == jox_reference((int32_t)place) ||
            (jox_stands(a, keeper) && is_in_place(run, keeper, place))) &&
           !jox_is_hidden(run, at, jox_add(at, offset), true);
}

/* Returns whether an agent gets no nearer to a place because of those who have arrived there. */
static bool is_kept_off(const JoxMachineRun *run, uint32_t i, uint32_t place) {
    const JoxAgents *a = run->agents;
    const JoxNeighbours *near = run->neighbours;
    const JoxV2 at = {a->x[i], a->y[i]};
    const JoxV2 way = jox_unit(jox_sub(jox_place_nearest(run->places, place, at), at));
    if (a->vx[i] * way.x + a->vy[i] * way.y > PROGRESS * jox_param(a, JOX_PARAM_speed, i))
        return false;
    for (uint32_t k = 0; k < near->count[i]; k++)
        if (keeps_off(run, near->index[jox_neighbour_at(near, i, k)], i, place, way))
            return true;
    return false;
}

/* Notes the place that an instruction asks for, for agents that have arrived at none. */
static void note_place(const JoxMachineRun *run, const uint32_t *agents, uint32_t count,
                       int16_t target, Arrivals *arrivals) {
    for (uint32_t n = 0; n < count; n++) {
        const uint32_t i = agents[n];
        const int32_t place = arrivals->at[n] ? -1 : jox_target_place(run, i, target);
        if (place < 0 || wants_away(run, i, (uint32_t)place))
            continue;
        if (is_in_place(run, i, (uint32_t)place))
            arrivals->at[n] = jox_reference(place);
        else if (is_kept_off(run, i, (uint32_t)place))
            arrivals->kept_off[n] = jox_reference(place);
    }
}

/* Finds the arrivals of a batch at the places that its machine asks for. An agent leaves a place
   when it wants to move away. */
static void find_arrivals(const JoxMachineRun *run, const JoxBatchRange *batch,
                          Arrivals *arrivals) {
    const JoxMachine *machine = run->set->items[batch->machine];
    const uint32_t *agents = run->scratch->grouped + batch->begin;
    for (uint32_t n = 0; n < batch->count; n++) {
        const int32_t before = jox_referred(run->agents->arrived_at[agents[n]]);
        const bool leaves = before >= 0 && wants_away(run, agents[n], (uint32_t)before);
        arrivals->at[n] = leaves ? 0 : jox_reference(before);
        arrivals->kept_off[n] = 0;
    }
    for (uint32_t e = 0; machine->arrivals && e < machine->expression_count; e++)
        for (uint32_t k = 0; k < machine->expressions[e].count; k++) {
            const JoxInstruction *in = &machine->expressions[e].code[k];
            if (in->op == JOX_OP_ARRIVED)
                note_place(run, agents, batch->count, in->place, arrivals);
        }
}

/* Counts the time for which an agent has been kept off a place; after KEPT_OFF it has arrived. */
static uint32_t count_kept_off(const JoxMachineRun *run, uint32_t i, uint32_t at,
                               uint32_t kept_off) {
    float *time = &run->agents->kept_off[i];
    if (at || (!kept_off && *time == 0.0f)) {
        if (*time != 0.0f)
            *time = 0.0f;
        return at;
    }
    *time = jox_maxf(0.0f, *time + (kept_off ? 1.0f : -1.0f) * (float)run->dt);
    return *time >= KEPT_OFF ? kept_off : 0;
}

void jox_arrivals_note(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    JoxAgents *a = run->agents;
    bool asked = false;
    for (uint32_t m = 0; m < run->set->count; m++)
        asked |= run->set->items[m]->arrivals;
    uint32_t count = 0;
    for (uint32_t b = 0; asked && b < s->batch_count; b++) {
        const JoxBatchRange *batch = &s->batches[b];
        Arrivals arrivals;
        find_arrivals(run, batch, &arrivals);
        JOX_RESERVE(s->arrivals, s->arrival_capacity, count + batch->count);
        for (uint32_t n = 0; n < batch->count; n++) {
            const uint32_t i = s->grouped[batch->begin + n];
            const uint32_t at = count_kept_off(run, i, arrivals.at[n], arrivals.kept_off[n]);
            if (at != a->arrived_at[i])
                s->arrivals[count++] = (JoxArrival){i, at};
        }
    }
    for (uint32_t n = 0; n < count; n++) /* all agents have seen the arrivals of the last step */
        a->arrived_at[s->arrivals[n].agent] = s->arrivals[n].place;
}
