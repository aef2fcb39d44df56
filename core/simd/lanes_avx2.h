/* Eight lanes: AVX2. See lanes_scalar.h. */
#ifndef JOX_SIMD_LANES_AVX2_H
#define JOX_SIMD_LANES_AVX2_H

#include <immintrin.h>
#include <stddef.h>
#include <stdint.h>

#include "simd/packed.h"

enum { JOX_WIDTH = 8 };
#define JOX_WIDE(name) name##_avx2

typedef __m256 JoxFloats;
typedef __m256i JoxInts;
typedef __m256 JoxMask;

static inline JoxFloats jf_set(float x) {
    return _mm256_set1_ps(x);
}
static inline JoxFloats jf_load(const float *from) {
    return _mm256_loadu_ps(from);
}
static inline void jf_store(float *to, JoxFloats a) {
    _mm256_storeu_ps(to, a);
}
static inline JoxInts ji_set(int32_t x) {
    return _mm256_set1_epi32(x);
}
static inline JoxInts ji_load(const uint32_t *from) {
    return _mm256_loadu_si256((const __m256i *)from);
}
static inline void ji_store(uint32_t *to, JoxInts a) {
    _mm256_storeu_si256((__m256i *)to, a);
}
static inline JoxInts ji_load_bytes(const uint8_t *from) {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)from));
}
static inline void ji_store_bytes(uint8_t *to, JoxInts a) {
    const __m256i low = _mm256_and_si256(a, _mm256_set1_epi32(255));
    const __m128i pairs =
        _mm_packs_epi32(_mm256_castsi256_si128(low), _mm256_extracti128_si256(low, 1));
    _mm_storel_epi64((__m128i *)to, _mm_packus_epi16(pairs, pairs));
}
static inline JoxInts ji_lane(void) {
    return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
}

static inline JoxFloats jf_sqrt(JoxFloats a) {
    return _mm256_sqrt_ps(a);
}
static inline JoxFloats jf_abs(JoxFloats a) {
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a);
}
static inline JoxFloats jf_min(JoxFloats a, JoxFloats b) {
    return _mm256_min_ps(a, b);
}
static inline JoxFloats jf_max(JoxFloats a, JoxFloats b) {
    return _mm256_max_ps(a, b);
}
static inline JoxFloats jf_select(JoxMask m, JoxFloats a, JoxFloats b) {
    return _mm256_blendv_ps(b, a, m);
}

static inline JoxFloats jf_next(JoxFloats a) {
    return _mm256_permutevar8x32_ps(a, _mm256_setr_epi32(1, 2, 3, 4, 5, 6, 7, 7));
}

static inline JoxMask jf_lt(JoxFloats a, JoxFloats b) {
    return _mm256_cmp_ps(a, b, _CMP_LT_OQ);
}
static inline JoxMask jf_le(JoxFloats a, JoxFloats b) {
    return _mm256_cmp_ps(a, b, _CMP_LE_OQ);
}

static inline JoxInts ji_add(JoxInts a, JoxInts b) {
    return _mm256_add_epi32(a, b);
}
static inline JoxInts ji_sub(JoxInts a, JoxInts b) {
    return _mm256_sub_epi32(a, b);
}
static inline JoxInts ji_and(JoxInts a, JoxInts b) {
    return _mm256_and_si256(a, b);
}
static inline JoxInts ji_or(JoxInts a, JoxInts b) {
    return _mm256_or_si256(a, b);
}
#define ji_shift_left(a, bits) _mm256_slli_epi32(a, bits)
#define ji_shift_right(a, bits) _mm256_srli_epi32(a, bits)
static inline JoxInts ji_opaque(JoxInts a) {
    __asm__("" : "+x"(a));
    return a;
}
static inline JoxMask ji_equal(JoxInts a, JoxInts b) {
    return _mm256_castsi256_ps(_mm256_cmpeq_epi32(a, b));
}
static inline JoxMask ji_less(JoxInts a, JoxInts b) {
    return _mm256_castsi256_ps(_mm256_cmpgt_epi32(b, a));
}
static inline JoxInts ji_select(JoxMask m, JoxInts a, JoxInts b) {
    return _mm256_castps_si256(jf_select(m, _mm256_castsi256_ps(a), _mm256_castsi256_ps(b)));
}

static inline JoxInts jf_to_ints(JoxFloats a) {
    return _mm256_cvttps_epi32(a);
}
static inline JoxFloats ji_to_floats(JoxInts a) {
    return _mm256_cvtepi32_ps(a);
}
static inline JoxInts jf_bits(JoxFloats a) {
    return _mm256_castps_si256(a);
}
static inline JoxFloats ji_as_floats(JoxInts a) {
    return _mm256_castsi256_ps(a);
}
/* Without gather instructions: where these are microcode, as on AMD processors, they are slower. */
static inline JoxInts ji_pick(const uint32_t *table, JoxInts at) {
    uint32_t k[8];
    ji_store(k, at);
    return _mm256_setr_epi32((int)table[k[0]], (int)table[k[1]], (int)table[k[2]], (int)table[k[3]],
                             (int)table[k[4]], (int)table[k[5]], (int)table[k[6]],
                             (int)table[k[7]]);
}
static inline JoxFloats jf_pick_at(const float *table, const uint32_t *k) {
    return _mm256_setr_ps(table[k[0]], table[k[1]], table[k[2]], table[k[3]], table[k[4]],
                          table[k[5]], table[k[6]], table[k[7]]);
}
static inline JoxFloats jf_pick(const float *table, JoxInts at) {
    uint32_t k[8];
    ji_store(k, at);
    return jf_pick_at(table, k);
}

static inline __m256i ji_packed_order_(uint32_t bits) {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)&jox_packed_order[bits]));
}
static inline void jf_store_packed(float *to, JoxFloats a, uint32_t bits) {
    _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(a, ji_packed_order_(bits)));
}
static inline void ji_store_packed(uint32_t *to, JoxInts a, uint32_t bits) {
    _mm256_storeu_si256((__m256i *)to, _mm256_permutevar8x32_epi32(a, ji_packed_order_(bits)));
}

/* Loads the fours of lanes l and l + 4 into one register; its two halves are then transposed
   separately. */
static inline __m256 jf_two_fours_(const float *low, const float *high) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1);
}
static inline void jf_transpose_(const __m256 r[4], JoxFloats out[4]) {
    __m256 xy01 = _mm256_unpacklo_ps(r[0], r[1]), zw01 = _mm256_unpackhi_ps(r[0], r[1]);
    __m256 xy23 = _mm256_unpacklo_ps(r[2], r[3]), zw23 = _mm256_unpackhi_ps(r[2], r[3]);
    out[0] = _mm256_shuffle_ps(xy01, xy23, 0x44);
    out[1] = _mm256_shuffle_ps(xy01, xy23, 0xee);
    out[2] = _mm256_shuffle_ps(zw01, zw23, 0x44);
    out[3] = _mm256_shuffle_ps(zw01, zw23, 0xee);
}
static inline void jf_records_at(const float *records, const uint32_t *at, JoxFloats out[4]) {
    __m256 r[4];
    JOX_UNROLL
    for (int l = 0; l < 4; l++)
        r[l] = jf_two_fours_(records + (size_t)4 * at[l], records + (size_t)4 * at[l + 4]);
    jf_transpose_(r, out);
}
static inline void jf_fours(const float *from, size_t stride, JoxFloats out[4]) {
    __m256 r[4];
    JOX_UNROLL
    for (size_t l = 0; l < 4; l++)
        r[l] = jf_two_fours_(from + stride * l, from + stride * (l + 4));
    jf_transpose_(r, out);
}

static inline JoxMask jm_and(JoxMask a, JoxMask b) {
    return _mm256_and_ps(a, b);
}
static inline JoxMask jm_or(JoxMask a, JoxMask b) {
    return _mm256_or_ps(a, b);
}
static inline JoxMask jm_without(JoxMask a, JoxMask b) {
    return _mm256_andnot_ps(b, a);
}
static inline uint32_t jm_bits(JoxMask m) {
    return (uint32_t)_mm256_movemask_ps(m);
}
static inline JoxMask jm_of_bits(uint32_t bits) {
    const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    return ji_equal(_mm256_and_si256(_mm256_set1_epi32((int32_t)bits), bit), bit);
}
static inline uint32_t jm_count(uint32_t bits) {
    return (uint32_t)__builtin_popcount(bits);
}

#endif
