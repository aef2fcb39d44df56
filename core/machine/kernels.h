/* Kernels of expressions and of the stage prefer, one function for each instruction set, and the
   data that they share with their callers in scalar C. */
#ifndef JOX_MACHINE_KERNELS_H
#define JOX_MACHINE_KERNELS_H

#include "machine/machine_parts.h"
#include "simd/isa.h"

/* Steering of one batch. Kernels read and write the arrays in whole packets. */
typedef struct JoxSteer {
    JoxAgents *agents;
    uint32_t index[JOX_BATCH]; /* the agents; entries beyond `count` repeat the last one */
    uint32_t count;
    /* The present term: velocity as a share of the wanted speed, and weight. */
    float way_x[JOX_BATCH], way_y[JOX_BATCH], by[JOX_BATCH];
    float sum_x[JOX_BATCH], sum_y[JOX_BATCH];     /* weighted sum of the terms so far */
    float ahead_x[JOX_BATCH], ahead_y[JOX_BATCH]; /* sum of the terms except evade */
    bool leads;                                   /* `ahead` is computed */
    /* Input of `arrive`: all bits set for agents that go to a point and stop there; the point,
       m. */
    uint32_t arrives[JOX_BATCH];
    float to_x[JOX_BATCH], to_y[JOX_BATCH];
    /* Input of `orbit`: agents [begin, end) of the batch and their place; NULL: none. */
    uint32_t begin, end;
    const JoxPlace *place;
    const double *args; /* see JoxOrbitArg */
} JoxSteer;

#define JOX_SLOWING 0.5f /* s: agents that arrive slow down to stop within this time */

/* orbit: computes way. arrive: computes way of agents that arrive, leaves the others'. add: adds
   way times weight to sum, except velocities that are NaN or longer than any term allows. finish:
   computes pref_x, pref_y from sum. face: computes face_x, face_y along the velocity of agents that
   move. */
typedef void JoxSteerKernel(JoxSteer *steer);
#define X(name, isa)                                                                               \
    JoxSteerKernel jox_steer_orbit_##name, jox_steer_arrive_##name, jox_steer_add_##name,          \
        jox_steer_finish_##name, jox_steer_face_##name;
JOX_ISAS(X)
#undef X

/* steering/steer_place.c: computes `way` of the terms seek and along, for agents whose weight
   counts. Points are left to the kernel `arrive`. */
void jox_steer_place(const JoxMachineRun *run, const JoxMachine *machine, const JoxSteerTerm *term,
                     JoxSteer *steer);

/* steering/steer_field.c: computes `way` of a term field for agents whose weight counts, and sets
   the places that they are bound for. */
void jox_steer_field(const JoxMachineRun *run, const JoxMachine *machine, const JoxSteerTerm *term,
                     JoxSteer *steer);

/* Does the same for places that are given for each agent, -1: none. */
void jox_steer_to_places(const JoxMachineRun *run, const JoxSteerTerm *term, JoxSteer *steer,
                         const int32_t *places);
/* Returns whether the straight way from a point to a place leads off the storey, or the stair,
   where the point is. Only in a world of storeys. */
bool jox_is_place_elsewhere(const JoxMachineRun *run, uint32_t place, JoxV2 at);
/* steering/at_lift.c: computes `way` of agent n of a batch, which is at a lift or in it. */
struct JoxRider;
void jox_steer_rider(const JoxMachineRun *run, const struct JoxRider *rider, JoxSteer *steer,
                     uint32_t n);
/* steering/ride.c: computes `way` of a term ride. */
void jox_steer_ride(const JoxMachineRun *run, const JoxMachine *machine, const JoxSteerTerm *term,
                    JoxSteer *steer);

/* steering/stay_in.c: changes preferred velocities so that agents stay in places (`stays_in`). */
void jox_machines_stay_in(JoxMachineRun *run);

/* steering/stairs.c: slows preferred velocities down on stairs, ramps and escalators. */
void jox_machines_mind_stairs(JoxMachineRun *run, JoxPool *pool);

/* Executes one instruction for `count` agents of a batch, if it is arithmetic or reads the agents'
   columns; returns false, without effect, for all other instructions. */
typedef bool JoxEvalKernel(const JoxMachineRun *run, const JoxInstruction *in,
                           const uint32_t *agents, uint32_t count, JoxRegisters registers);
#define X(name, isa) JoxEvalKernel jox_eval_numbers_##name;
JOX_ISAS(X)
#undef X

/* Returns whether a term of this weight is evaluated. A weight is infinite if it is computed from
   the distance to an absent target. */
static inline bool jox_weight_counts(float by) {
    return by != 0.0f && fabsf(by) <= (float)JOX_MOST_WEIGHT;
}

#endif
