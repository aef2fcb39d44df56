/* The kernels of force, one function for each instruction set, and what they share with the plain C
   around them. Each stage calls its kernel for one chunk of agents at a time, on several
   threads. */
#ifndef JOX_FORCE_KERNELS_H
#define JOX_FORCE_KERNELS_H

#include "force/equations.h"
#include "force/forces.h"
#include "simd/isa.h"

/* Computes `breadth` of agents [begin, end), which are in one chunk. */
typedef void JoxBreadthKernel(const JoxForces *forces, uint32_t begin, uint32_t end);
#define X(name, isa) JoxBreadthKernel jox_breadth_packets_##name;
JOX_ISAS(X)
#undef X
/* Finds the contacts of agents [begin, end) of one chunk, with agents of greater id and with walls.
   `begin` is a multiple of JOX_LANES. */
typedef void JoxFindKernel(JoxForces *forces, uint32_t begin, uint32_t end);
#define X(name, isa) JoxFindKernel jox_find_packets_##name;
JOX_ISAS(X)
#undef X
/* Computes `velocities` and `inverse_mass` of agents [begin, end), the start of the contact solve.
   Both have room for whole blocks of JOX_LANES. */
typedef void JoxStartKernel(JoxForces *forces, uint32_t begin, uint32_t end);
#define X(name, isa) JoxStartKernel jox_start_packets_##name;
JOX_ISAS(X)
#undef X
/* Equations 10 to 12 for agents [begin, end), in physical mode. `begin` is a multiple of
   JOX_LANES. */
typedef void JoxSumKernel(JoxForces *forces, uint32_t begin, uint32_t end);
#define X(name, isa) JoxSumKernel jox_sum_packets_##name;
JOX_ISAS(X)
#undef X

#define JOX_SHORTFALL_LEAST 1e-6f /* m/s: lesser shortfalls are not passed on */

/* Kind of force that an agent passes on: its resistance to a force (9), or the momentum lost by
   slowing down (8). */
typedef enum JoxPassKind {
    JOX_PASSES_NOTHING,
    JOX_PASSES_RESISTANCE,
    JOX_PASSES_DECELERATION
} JoxPassKind;
/* Results of infer for the agents of a chunk; shortfall, m/s, is valid for resistance. */
typedef struct JoxPassing {
    uint8_t kind[JOX_FORCE_GRAIN];
    float shortfall[JOX_FORCE_GRAIN];
} JoxPassing;
/* Decides what agents [begin, end) of one chunk pass on, in physical mode. */
typedef void JoxInferKernel(const JoxForces *forces, uint32_t begin, uint32_t end,
                            JoxPassing *passing);
#define X(name, isa) JoxInferKernel jox_infer_packets_##name;
JOX_ISAS(X)
#undef X

#endif
