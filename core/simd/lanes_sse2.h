/* Four lanes: SSE2, which every x86-64 has. See lanes_scalar.h. */
#ifndef JOX_SIMD_LANES_SSE2_H
#define JOX_SIMD_LANES_SSE2_H

#include <emmintrin.h>
#include <stdint.h>
#include <string.h>

enum { JOX_WIDTH = 4 };
#define JOX_WIDE(name) name##_sse2

#define JOX_EACH(X) X(0), X(1), X(2), X(3)
#define JOX_FOUR_LANES

typedef __m128 JoxFloats;
typedef int32_t JoxInts __attribute__((vector_size(16)));
typedef JoxInts JoxMask;

#include "simd/lanes_vector.h"

static inline JoxInts ji_load_bytes(const uint8_t *from) {
    int32_t four;
    memcpy(&four, from, sizeof four);
    const __m128i zero = _mm_setzero_si128();
    return (JoxInts)_mm_unpacklo_epi16(_mm_unpacklo_epi8(_mm_cvtsi32_si128(four), zero), zero);
}
static inline void ji_store_bytes(uint8_t *to, JoxInts a) {
    /* 0 to 255: not saturated by packing */
    const __m128i low = _mm_and_si128((__m128i)a, _mm_set1_epi32(255));
    const __m128i pairs = _mm_packs_epi32(low, low);
    const int32_t four = _mm_cvtsi128_si32(_mm_packus_epi16(pairs, pairs));
    memcpy(to, &four, sizeof four);
}

static inline JoxFloats jf_sqrt(JoxFloats a) {
    return _mm_sqrt_ps(a);
}
static inline JoxFloats jf_min(JoxFloats a, JoxFloats b) {
    return _mm_min_ps(a, b);
}
static inline JoxFloats jf_max(JoxFloats a, JoxFloats b) {
    return _mm_max_ps(a, b);
}
static inline JoxFloats jf_select(JoxMask m, JoxFloats a, JoxFloats b) {
    return (JoxFloats)((m & (JoxInts)a) | (~m & (JoxInts)b));
}

static inline JoxFloats jf_next(JoxFloats a) {
    return _mm_shuffle_ps(a, a, _MM_SHUFFLE(3, 3, 2, 1));
}

static inline JoxInts ji_opaque(JoxInts a) {
    __asm__("" : "+x"(a));
    return a;
}

static inline JoxInts jf_to_ints(JoxFloats a) {
    return (JoxInts)_mm_cvttps_epi32(a);
}

static inline void jf_transpose_rows_(const float *const row[4], JoxFloats out[4]) {
    JOX_UNROLL
    for (int lane = 0; lane < 4; lane++)
        out[lane] = _mm_loadu_ps(row[lane]);
    _MM_TRANSPOSE4_PS(out[0], out[1], out[2], out[3]);
}

static inline void jf_put_rows(float *const row[4], const JoxFloats in[4]) {
    JoxFloats r[4] = {in[0], in[1], in[2], in[3]};
    _MM_TRANSPOSE4_PS(r[0], r[1], r[2], r[3]);
    JOX_UNROLL
    for (int lane = 0; lane < 4; lane++)
        _mm_storeu_ps(row[lane], r[lane]);
}

static inline uint32_t jm_bits(JoxMask m) {
    return (uint32_t)_mm_movemask_ps((__m128)m);
}

#endif
