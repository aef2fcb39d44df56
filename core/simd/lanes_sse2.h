/* Four lanes: SSE2, which every x86-64 has. See lanes_scalar.h. */
#ifndef JOX_SIMD_LANES_SSE2_H
#define JOX_SIMD_LANES_SSE2_H

#include <emmintrin.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "simd/packed.h"

enum { JOX_WIDTH = 4 };
#define JOX_WIDE(name) name##_sse2

typedef __m128 JoxFloats;
typedef __m128i JoxInts;
typedef __m128 JoxMask;

static inline JoxFloats jf_set(float x) {
    return _mm_set1_ps(x);
}
static inline JoxFloats jf_load(const float *from) {
    return _mm_loadu_ps(from);
}
static inline void jf_store(float *to, JoxFloats a) {
    _mm_storeu_ps(to, a);
}
static inline JoxInts ji_set(int32_t x) {
    return _mm_set1_epi32(x);
}
static inline JoxInts ji_load(const uint32_t *from) {
    return _mm_loadu_si128((const __m128i *)from);
}
static inline void ji_store(uint32_t *to, JoxInts a) {
    _mm_storeu_si128((__m128i *)to, a);
}
static inline JoxInts ji_load_bytes(const uint8_t *from) {
    int32_t four;
    memcpy(&four, from, sizeof four);
    const __m128i zero = _mm_setzero_si128();
    return _mm_unpacklo_epi16(_mm_unpacklo_epi8(_mm_cvtsi32_si128(four), zero), zero);
}
static inline void ji_store_bytes(uint8_t *to, JoxInts a) {
    /* 0 to 255: not saturated by packing */
    const __m128i low = _mm_and_si128(a, _mm_set1_epi32(255));
    const __m128i pairs = _mm_packs_epi32(low, low);
    const int32_t four = _mm_cvtsi128_si32(_mm_packus_epi16(pairs, pairs));
    memcpy(to, &four, sizeof four);
}
static inline JoxInts ji_lane(void) {
    return _mm_setr_epi32(0, 1, 2, 3);
}

static inline JoxFloats jf_sqrt(JoxFloats a) {
    return _mm_sqrt_ps(a);
}
static inline JoxFloats jf_abs(JoxFloats a) {
    return _mm_andnot_ps(_mm_set1_ps(-0.0f), a);
}
static inline JoxFloats jf_min(JoxFloats a, JoxFloats b) {
    return _mm_min_ps(a, b);
}
static inline JoxFloats jf_max(JoxFloats a, JoxFloats b) {
    return _mm_max_ps(a, b);
}
static inline JoxFloats jf_select(JoxMask m, JoxFloats a, JoxFloats b) {
    return _mm_or_ps(_mm_and_ps(m, a), _mm_andnot_ps(m, b));
}

static inline JoxFloats jf_next(JoxFloats a) {
    return _mm_shuffle_ps(a, a, _MM_SHUFFLE(3, 3, 2, 1));
}

static inline JoxMask jf_lt(JoxFloats a, JoxFloats b) {
    return _mm_cmplt_ps(a, b);
}
static inline JoxMask jf_le(JoxFloats a, JoxFloats b) {
    return _mm_cmple_ps(a, b);
}

static inline JoxInts ji_add(JoxInts a, JoxInts b) {
    return _mm_add_epi32(a, b);
}
static inline JoxInts ji_sub(JoxInts a, JoxInts b) {
    return _mm_sub_epi32(a, b);
}
static inline JoxInts ji_and(JoxInts a, JoxInts b) {
    return _mm_and_si128(a, b);
}
static inline JoxInts ji_or(JoxInts a, JoxInts b) {
    return _mm_or_si128(a, b);
}
#define ji_shift_left(a, bits) _mm_slli_epi32(a, bits)
#define ji_shift_right(a, bits) _mm_srli_epi32(a, bits)
static inline JoxInts ji_opaque(JoxInts a) {
    __asm__("" : "+x"(a));
    return a;
}
static inline JoxMask ji_equal(JoxInts a, JoxInts b) {
    return _mm_castsi128_ps(_mm_cmpeq_epi32(a, b));
}
static inline JoxMask ji_less(JoxInts a, JoxInts b) {
    return _mm_castsi128_ps(_mm_cmplt_epi32(a, b));
}
static inline JoxInts ji_select(JoxMask m, JoxInts a, JoxInts b) {
    return _mm_castps_si128(jf_select(m, _mm_castsi128_ps(a), _mm_castsi128_ps(b)));
}

static inline JoxInts jf_to_ints(JoxFloats a) {
    return _mm_cvttps_epi32(a);
}
static inline JoxFloats ji_to_floats(JoxInts a) {
    return _mm_cvtepi32_ps(a);
}
static inline JoxInts jf_bits(JoxFloats a) {
    return _mm_castps_si128(a);
}
static inline JoxFloats ji_as_floats(JoxInts a) {
    return _mm_castsi128_ps(a);
}
static inline JoxInts ji_pick(const uint32_t *table, JoxInts at) {
    uint32_t k[4];
    ji_store(k, at);
    return _mm_setr_epi32((int32_t)table[k[0]], (int32_t)table[k[1]], (int32_t)table[k[2]],
                          (int32_t)table[k[3]]);
}
static inline JoxFloats jf_pick_at(const float *table, const uint32_t *at) {
    return _mm_setr_ps(table[at[0]], table[at[1]], table[at[2]], table[at[3]]);
}
static inline JoxFloats jf_pick(const float *table, JoxInts at) {
    uint32_t k[4];
    ji_store(k, at);
    return jf_pick_at(table, k);
}

static inline void jf_store_packed(float *to, JoxFloats a, uint32_t bits) {
    const uint32_t order = (uint32_t)jox_packed_order[bits];
    float lanes[4];
    jf_store(lanes, a);
    for (int k = 0; k < 4; k++)
        to[k] = lanes[order >> 8 * k & 3];
}
static inline void ji_store_packed(uint32_t *to, JoxInts a, uint32_t bits) {
    const uint32_t order = (uint32_t)jox_packed_order[bits];
    uint32_t lanes[4];
    ji_store(lanes, a);
    for (int k = 0; k < 4; k++)
        to[k] = lanes[order >> 8 * k & 3];
}

static inline void jf_records_at(const float *records, const uint32_t *at, JoxFloats out[4]) {
    JOX_UNROLL
    for (int lane = 0; lane < 4; lane++)
        out[lane] = _mm_loadu_ps(records + (size_t)4 * at[lane]);
    _MM_TRANSPOSE4_PS(out[0], out[1], out[2], out[3]);
}
static inline void jf_fours(const float *from, size_t stride, JoxFloats out[4]) {
    JOX_UNROLL
    for (size_t lane = 0; lane < 4; lane++)
        out[lane] = _mm_loadu_ps(from + stride * lane);
    _MM_TRANSPOSE4_PS(out[0], out[1], out[2], out[3]);
}

static inline JoxMask jm_and(JoxMask a, JoxMask b) {
    return _mm_and_ps(a, b);
}
static inline JoxMask jm_or(JoxMask a, JoxMask b) {
    return _mm_or_ps(a, b);
}
static inline JoxMask jm_without(JoxMask a, JoxMask b) {
    return _mm_andnot_ps(b, a);
}
static inline uint32_t jm_bits(JoxMask m) {
    return (uint32_t)_mm_movemask_ps(m);
}
static inline JoxMask jm_of_bits(uint32_t bits) {
    const __m128i bit = _mm_setr_epi32(1, 2, 4, 8);
    return ji_equal(_mm_and_si128(_mm_set1_epi32((int32_t)bits), bit), bit);
}
static inline uint32_t jm_count(uint32_t bits) {
    return jox_count_of_four(bits);
}

#endif
