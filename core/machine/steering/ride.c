/* The steering term `ride`: to the door of a lift, in, out on another storey. world/lifts.c says
   where each agent goes near the lift; farther away a distance field leads to its door. */
#include "machine/kernels.h"
#include "machine/lifts.h"

/* m: an agent this near to its spot in the car looks at the door. */
static const float AT_SPOT = 0.3f;

static void face_door(const JoxMachineRun *run, const JoxRider *rider, uint32_t i) {
    const JoxLiftView *view = run->lifts;
    const JoxLiftStop *stop = &view->lifts[rider->lift].stops[view->cars[rider->lift].stop];
    run->agents->face_x[i] = stop->out.x;
    run->agents->face_y[i] = stop->out.y;
}

void jox_steer_rider(const JoxMachineRun *run, const JoxRider *rider, JoxSteer *s, uint32_t n) {
    const JoxAgents *a = run->agents;
    const uint32_t i = s->index[n];
    const JoxV2 at = {a->x[i], a->y[i]}, to = {rider->x, rider->y};
    const JoxV2 way = jox_steer_arrive(at, to, jox_param(a, JOX_PARAM_speed, i));
    s->way_x[n] = way.x;
    s->way_y[n] = way.y;
    if (rider->phase == JOX_RIDE_INSIDE && jox_length(jox_sub(to, at)) < AT_SPOT)
        face_door(run, rider, i);
}

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
        if (rider && rider->goal == goals[n] && rider->phase != JOX_RIDE_APPROACH &&
            jox_weight_counts(s->by[n]))
            jox_steer_rider(run, rider, s, n);
    }
}
