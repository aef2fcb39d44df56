/* The kernels of programs and of prefer, one function for each instruction set, and what they share
   with the plain C about them. */
#ifndef JOX_MACHINE_KERNELS_H
#define JOX_MACHINE_KERNELS_H

#include "machine/internal.h"
#include "simd/isa.h"

/* Steering of a batch of one state. Lanes read and write the arrays in whole packets. */
typedef struct JoxSteer {
    JoxAgents *agents;
    uint32_t index[JOX_BATCH]; /* the agents; behind `count` of them the last again */
    uint32_t count;
    /* Of one term: what it asks for, as a share of the wanted speed, and its weight. */
    float way_x[JOX_BATCH], way_y[JOX_BATCH], by[JOX_BATCH];
    float sum_x[JOX_BATCH], sum_y[JOX_BATCH];     /* of the terms so far */
    float ahead_x[JOX_BATCH], ahead_y[JOX_BATCH]; /* where those that do not evade lead */
    bool leads;                                   /* `ahead` is known */
    /* For arrive: those that go to a point and stop there, all bits set, and where it is, m. */
    uint32_t arrives[JOX_BATCH];
    float to_x[JOX_BATCH], to_y[JOX_BATCH];
    /* For orbit: of agents [begin, end) of the batch, the place, NULL where there is none. */
    uint32_t begin, end;
    const JoxPlace *place;
    const double *args; /* JoxOrbitArgument */
} JoxSteer;

#define JOX_SLOWING 0.5f /* s: who arrives slows to stop within this time */

/* orbit: way. arrive: way of those who arrive, the others' stays. add: way, weighed, into sum; what
   asks for more than any word does, or for what is no number, is left out. finish: pref_x, pref_y
   from sum. face: face_x, face_y along the velocity of those who move. */
typedef void JoxSteerKernel(JoxSteer *steer);
#define X(name, isa)                                                                               \
    JoxSteerKernel jox_steer_orbit_##name, jox_steer_arrive_##name, jox_steer_add_##name,          \
        jox_steer_finish_##name, jox_steer_face_##name;
JOX_ISAS(X)
#undef X

/* steering/steer_place.c: the ways of a term that leads to places, or along them: seek and along,
   of those of a batch whose weight counts. What leads to points is left to the kernel `arrive`. */
void jox_steer_place(const JoxMachineRun *run, const JoxMachine *machine, const JoxSteerTerm *term,
                     JoxSteer *steer);

/* steering/steer_field.c: the ways of a term of the kind field, of `count` of the agents in index,
   those of them whose weight counts: way. Sets what they are bound for. */
void jox_steer_field(const JoxMachineRun *run, const JoxMachine *machine, const JoxSteerTerm *term,
                     JoxSteer *steer);

/* Runs one instruction over `count` agents of a batch, and says whether it is one that has a loop
   here: arithmetic, or the agents' own figures. */
typedef bool JoxEvalKernel(const JoxMachineRun *run, const JoxInstruction *in,
                           const uint32_t *agents, uint32_t count, JoxRegisters registers);
#define X(name, isa) JoxEvalKernel jox_eval_numbers_##name;
JOX_ISAS(X)
#undef X

/* Whether a term of this weight is asked for. A weight may come from a target that is not there:
   infinitely far. */
static inline bool jox_weight_counts(float by) {
    return by != 0.0f && fabsf(by) <= (float)JOX_MOST_WEIGHT;
}

#endif
