/* Where agents go that wait at a lift or are in it: to the positions that world/lift_riders.c gives
   them. */
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
