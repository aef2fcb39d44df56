/* Chooses the best of the agents and bodies that an agent sees, or of the members of a set of
   places, by a score that the behaviour gives as an expression over the candidate. target.c calls
   it; `nearest` needs no score. */
#include <math.h>

#include "machine/machine_parts.h"

/* The best candidate so far. */
typedef struct Best {
    JoxSpot spot;
    double score;
} Best;

/* Replaces the best one by the first of the candidates, if any, with a greater score. */
static void choose_best(const JoxMachineRun *run, uint32_t i, const JoxExpression *score,
                        const JoxSpot *candidates, uint32_t count, Best *best) {
    static _Thread_local JoxRegisters registers;
    jox_eval_scores(run, i, score, candidates, count, registers);
    for (uint32_t n = 0; n < count; n++)
        if (!isnan(registers[0][n]) && (!best->spot.found || registers[0][n] > best->score))
            *best = (Best){candidates[n], registers[0][n]};
}

/* Writes the agents that agent i sees and that match a target, by ascending id; returns how many.
 */
static uint32_t list_agents(const JoxMachineRun *run, const JoxTarget *target, uint32_t i,
                            JoxSpot *candidates) {
    const JoxAgents *a = run->agents;
    uint32_t found[JOX_SMALL_CROWD];
    const uint32_t count = target->filter.flies ? 0 : jox_list_wanted(run, target, i, found);
    for (uint32_t n = 1; n < count; n++) {
        const uint32_t moving = found[n];
        uint32_t at = n;
        for (; at > 0 && a->id[found[at - 1]] > a->id[moving]; at--)
            found[at] = found[at - 1];
        found[at] = moving;
    }
    for (uint32_t n = 0; n < count; n++)
        candidates[n] = jox_spot_agent(run, i, found[n]);
    return count;
}

int32_t jox_find_best_place(const JoxMachineRun *run, uint32_t i, const JoxTarget *target,
                            int32_t set) {
    const JoxExpression *score = &jox_machine_of(run, i)->expressions[target->score - 1];
    const JoxPlace *place = &run->places[set];
    Best best = {.spot = JOX_NO_SPOT};
    JoxSpot candidates[JOX_BATCH];
    for (uint32_t first = 0; first < place->member_count; first += JOX_BATCH) {
        const uint32_t left = place->member_count - first,
                       count = left < JOX_BATCH ? left : JOX_BATCH;
        for (uint32_t n = 0; n < count; n++)
            candidates[n] = jox_spot_place(run, i, place->members[first + n]);
        choose_best(run, i, score, candidates, count, &best);
    }
    return jox_place_is_set(place) ? best.spot.place : set;
}

JoxSpot jox_find_best(const JoxMachineRun *run, uint32_t i, const JoxTarget *target) {
    const JoxExpression *score = &jox_machine_of(run, i)->expressions[target->score - 1];
    JoxSpot candidates[JOX_SMALL_CROWD];
    Best best = {.spot = JOX_NO_SPOT};
    uint32_t count = list_agents(run, target, i, candidates);
    choose_best(run, i, score, candidates, count, &best);
    count = 0;
    for (uint32_t o = 0; run->objects && o < run->objects->count; o++) {
        if (!jox_is_wanted_body(run, target, i, &run->objects->rows[o]) ||
            !jox_sees_body(run, i, o))
            continue;
        candidates[count++] = jox_spot_body(&run->objects->rows[o], (int32_t)o);
        if (count == JOX_SMALL_CROWD) {
            choose_best(run, i, score, candidates, count, &best);
            count = 0;
        }
    }
    choose_best(run, i, score, candidates, count, &best);
    return best.spot;
}
