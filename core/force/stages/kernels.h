/* The kernels of this room, one function for each instruction set. forces.c and sum.c call them for
   one chunk of agents at a time, on several threads. */
#ifndef JOX_FORCE_STAGES_KERNELS_H
#define JOX_FORCE_STAGES_KERNELS_H

#include "force/forces.h"
#include "simd/isa.h"

/* Writes the records of agents [begin, end), which are in one chunk. */
typedef void JoxRecordKernel(const JoxForces *forces, uint32_t begin, uint32_t end);
#define X(name, isa) JoxRecordKernel jox_record_packets_##name;
JOX_ISAS(X)
#undef X
/* Equations 10 to 12 for agents [begin, end), in physical mode. `begin` is a multiple of
   JOX_LANES. */
typedef void JoxSumKernel(JoxForces *forces, uint32_t begin, uint32_t end);
#define X(name, isa) JoxSumKernel jox_sum_packets_##name;
JOX_ISAS(X)
#undef X

#endif
