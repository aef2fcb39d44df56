/* Includes the lanes of the instruction set that a kernel is being compiled for. The build compiles
   each kernel once per set, with JOX_ISA_scalar, JOX_ISA_sse2, ... defined (see README.md). */
#ifndef JOX_SIMD_LANES_H
#define JOX_SIMD_LANES_H

/* Unrolls a short loop over an array of lanes, so that the array lives in registers. */
#if defined __clang__
#define JOX_UNROLL _Pragma("unroll")
#else
#define JOX_UNROLL _Pragma("GCC unroll 32")
#endif

#if defined JOX_ISA_avx512
#include "simd/lanes_avx512.h"
#elif defined JOX_ISA_avx2
#include "simd/lanes_avx2.h"
#elif defined JOX_ISA_sse2
#include "simd/lanes_sse2.h"
#elif defined JOX_ISA_neon
#include "simd/lanes_neon.h"
#elif defined JOX_ISA_wasm
#include "simd/lanes_wasm.h"
#else
#include "simd/lanes_scalar.h"
#endif

/* A bit for each lane. */
#define JOX_ALL_LANES ((uint32_t)(((uint64_t)1 << JOX_WIDTH) - 1))

/* Returns the bits of the first `count` lanes, for a packet with fewer agents than lanes; of all
   lanes if `count` is larger. */
static inline uint32_t jox_first_lanes(uint32_t count) {
    return count < JOX_WIDTH ? (1u << count) - 1 : JOX_ALL_LANES;
}

/* Loads the record of four floats at index at[l] for each lane l: out[c][l] is number c. */
static inline void jf_records(const float *records, JoxInts at, JoxFloats out[4]) {
    uint32_t k[JOX_WIDTH];
    ji_store(k, at);
    jf_records_at(records, k, out);
}

#endif
