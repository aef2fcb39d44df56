/* The lanes of the instruction set that a kernel is being compiled for. The build defines one of
   JOX_ISA_scalar, JOX_ISA_sse2, ... for each of its objects (see README.md). */
#ifndef JOX_SIMD_LANES_H
#define JOX_SIMD_LANES_H

/* Before a loop of few turns over an array of lanes: the array then lives in registers. */
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
#else
#include "simd/lanes_scalar.h"
#endif

/* The bits of all lanes. */
#define JOX_ALL_LANES ((uint32_t)(((uint64_t)1 << JOX_WIDTH) - 1))

/* Those of the first lanes, as many as there are agents left; of a whole packet and more, all. */
static inline uint32_t jox_first_lanes(uint32_t count) {
    return count < JOX_WIDTH ? (1u << count) - 1 : JOX_ALL_LANES;
}

/* Lane by lane the four numbers of record `at`. */
static inline void jf_records(const float *records, JoxInts at, JoxFloats out[4]) {
    uint32_t k[JOX_WIDTH];
    ji_store(k, at);
    jf_records_at(records, k, out);
}

#endif
