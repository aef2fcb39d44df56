/* The steering term `ride`: to the door of a lift, in, out on another storey. world/lifts.c says
   where each agent goes near the lift; farther away a distance field leads to its door. */
#include "machine/kernels.h"
#include "machine/lifts.h"

void jox_steer_ride(const JoxMachineRun *run, const JoxMachine *machine, const JoxSteerTerm *term,
                    JoxSteer *s) {
    const JoxAgents *a = run->agents;
    int32_t goals[JOX_BATCH], places[JOX_BATCH];
    jox_target_places(run, machine, term->target, s->index, s->count, goals);
    for (uint32_t n = 0; n < s->count; n++)
        places[n] =
            jox_weight_counts(s->by[n]) ? jox_ride_approach(run, s->index[n], goals[n]) : -1;
    jox_steer_to_places(run, term, s, places);
    for (uint32_t n = 0; n < s->count; n++) {
        const JoxRider *rider = jox_rider_find(run->lifts, a->id[s->index[n]]);
        if (rider && (rider->stray || rider->goal == goals[n]) &&
            rider->phase != JOX_RIDE_APPROACH && jox_weight_counts(s->by[n]))
            jox_steer_rider(run, rider, s, n);
    }
}
