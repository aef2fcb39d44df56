/* The kernels of force, one function for each instruction set, and what they share with the plain C
   about them. */
#ifndef JOX_FORCE_KERNELS_H
#define JOX_FORCE_KERNELS_H

#include "force/equations.h"
#include "force/internal.h"
#include "simd/isa.h"

/* The radius at which agents [begin, end), of one chunk, touch: `breadth`. */
typedef void JoxBreadthKernel(const JoxForces *forces, uint32_t begin, uint32_t end);
#define X(name, isa) JoxBreadthKernel jox_breadth_packets_##name;
JOX_ISAS(X)
#undef X
/* What agents [begin, end), of one chunk, touch: people, of whom the one of lesser id finds the
   contact, and walls. `begin` is a multiple of JOX_LANES. */
typedef void JoxFindKernel(JoxForces *forces, uint32_t begin, uint32_t end);
#define X(name, isa) JoxFindKernel jox_find_packets_##name;
JOX_ISAS(X)
#undef X
/* What the solve of contacts begins with, of agents [begin, end): `work` and `lightness`, which
   have room for whole blocks of JOX_LANES. */
typedef void JoxStartKernel(JoxForces *forces, uint32_t begin, uint32_t end);
#define X(name, isa) JoxStartKernel jox_start_packets_##name;
JOX_ISAS(X)
#undef X
/* Equations 10 to 12 of agents [begin, end), in physical mode. `begin` is a multiple of JOX_LANES.
 */
typedef void JoxSumKernel(JoxForces *forces, uint32_t begin, uint32_t end);
#define X(name, isa) JoxSumKernel jox_sum_packets_##name;
JOX_ISAS(X)
#undef X

#define JOX_SHORTFALL_LEAST 1e-6f /* m/s: less is not passed on */

/* What someone passes on: what they hold against a force (9), or what they lose by slowing down
   (8). */
typedef enum JoxPassKind {
    JOX_PASSES_NOTHING,
    JOX_PASSES_RESISTANCE,
    JOX_PASSES_DECELERATION
} JoxPassKind;
/* That of the agents of a chunk, and what they fall short by who pass resistance on, m/s. */
typedef struct JoxPassing {
    uint8_t kind[JOX_FORCE_GRAIN];
    float shortfall[JOX_FORCE_GRAIN];
} JoxPassing;
/* Of agents [begin, end) of one chunk, in physical mode. */
typedef void JoxInferKernel(const JoxForces *forces, uint32_t begin, uint32_t end,
                            JoxPassing *passing);
#define X(name, isa) JoxInferKernel jox_infer_packets_##name;
JOX_ISAS(X)
#undef X

#endif
