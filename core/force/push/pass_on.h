/* The kernel of infer, which finds the agents that pass a force on, and those ahead; pass_on.c
   calls it for one chunk of agents at a time, on several threads, and has them do so. */
#ifndef JOX_FORCE_PUSH_PASS_ON_H
#define JOX_FORCE_PUSH_PASS_ON_H

#include "force/cones.h"
#include "simd/isa.h"

#define JOX_SHORTFALL_LEAST 1e-6f /* m/s: lesser shortfalls are not passed on */

/* Kind of force that an agent passes on: its resistance to a force (9), or the momentum lost by
   slowing down (8). */
typedef enum JoxPassKind {
    JOX_PASSES_NOTHING,
    JOX_PASSES_RESISTANCE,
    JOX_PASSES_DECELERATION
} JoxPassKind;
/* Results of infer for the agents of a chunk. `people`, who take the force, is valid for those that
   pass one on; shortfall, m/s, for resistance. */
typedef struct JoxPassing {
    uint8_t kind[JOX_FORCE_GRAIN];
    float shortfall[JOX_FORCE_GRAIN];
    JoxFound people;
} JoxPassing;
/* Decides what agents [begin, end) of one chunk pass on to whom, in physical mode. */
typedef void JoxInferKernel(const JoxForces *forces, uint32_t begin, uint32_t end,
                            JoxPassing *passing);
#define X(name, isa) JoxInferKernel jox_infer_packets_##name;
JOX_ISAS(X)
#undef X

#endif
