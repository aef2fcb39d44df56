/* Eight lanes: AVX2. See lanes_scalar.h. */
#ifndef JOX_SIMD_LANES_AVX2_H
#define JOX_SIMD_LANES_AVX2_H

#include <immintrin.h>
#include <stdint.h>

#include "simd/packed.h"

enum { JOX_WIDTH = 8 };
#define JOX_WIDE(name) name##_avx2

#define JOX_EACH(X) X(0), X(1), X(2), X(3), X(4), X(5), X(6), X(7)

typedef __m256 JoxFloats;
typedef int32_t JoxInts __attribute__((vector_size(32)));
typedef JoxInts JoxMask;

#include "simd/lanes_vector.h"

static inline JoxInts ji_load_bytes(const uint8_t *from) {
    return (JoxInts)_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)from));
}
static inline void ji_store_bytes(uint8_t *to, JoxInts a) {
    const __m256i low = _mm256_and_si256((__m256i)a, _mm256_set1_epi32(255));
    const __m128i pairs =
        _mm_packs_epi32(_mm256_castsi256_si128(low), _mm256_extracti128_si256(low, 1));
    _mm_storel_epi64((__m128i *)to, _mm_packus_epi16(pairs, pairs));
}

static inline JoxFloats jf_sqrt(JoxFloats a) {
    return _mm256_sqrt_ps(a);
}
static inline JoxFloats jf_min(JoxFloats a, JoxFloats b) {
    return _mm256_min_ps(a, b);
}
static inline JoxFloats jf_max(JoxFloats a, JoxFloats b) {
    return _mm256_max_ps(a, b);
}
static inline JoxFloats jf_select(JoxMask m, JoxFloats a, JoxFloats b) {
    return _mm256_blendv_ps(b, a, (__m256)m);
}

static inline JoxFloats jf_next(JoxFloats a) {
    return _mm256_permutevar8x32_ps(a, _mm256_setr_epi32(1, 2, 3, 4, 5, 6, 7, 7));
}

static inline JoxFloats jf_arrange(JoxFloats a, JoxInts from) {
    return _mm256_permutevar8x32_ps(a, (__m256i)from);
}

static inline JoxInts ji_opaque(JoxInts a) {
    __asm__("" : "+x"(a));
    return a;
}

static inline JoxInts jf_to_ints(JoxFloats a) {
    return (JoxInts)_mm256_cvttps_epi32(a);
}

static inline __m256i ji_packed_order_(uint32_t bits) {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)&jox_packed_order[bits]));
}
static inline void jf_store_packed(float *to, JoxFloats a, uint32_t bits) {
    _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(a, ji_packed_order_(bits)));
}
static inline void ji_store_packed(uint32_t *to, JoxInts a, uint32_t bits) {
    _mm256_storeu_si256((__m256i *)to,
                        _mm256_permutevar8x32_epi32((__m256i)a, ji_packed_order_(bits)));
}

/* Loads the fours of lanes l and l + 4 into one register; its two halves are then transposed
   separately. */
static inline __m256 jf_two_fours_(const float *low, const float *high) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1);
}
static inline void jf_transpose_rows_(const float *const row[8], JoxFloats out[4]) {
    __m256 r[4];
    JOX_UNROLL
    for (int l = 0; l < 4; l++)
        r[l] = jf_two_fours_(row[l], row[l + 4]);
    __m256 xy01 = _mm256_unpacklo_ps(r[0], r[1]), zw01 = _mm256_unpackhi_ps(r[0], r[1]);
    __m256 xy23 = _mm256_unpacklo_ps(r[2], r[3]), zw23 = _mm256_unpackhi_ps(r[2], r[3]);
    out[0] = _mm256_shuffle_ps(xy01, xy23, 0x44);
    out[1] = _mm256_shuffle_ps(xy01, xy23, 0xee);
    out[2] = _mm256_shuffle_ps(zw01, zw23, 0x44);
    out[3] = _mm256_shuffle_ps(zw01, zw23, 0xee);
}

static inline void jf_put_rows(float *const row[8], const JoxFloats in[4]) {
    const __m256 xy01 = _mm256_unpacklo_ps(in[0], in[1]), zw01 = _mm256_unpacklo_ps(in[2], in[3]);
    const __m256 xy23 = _mm256_unpackhi_ps(in[0], in[1]), zw23 = _mm256_unpackhi_ps(in[2], in[3]);
    const __m256 r[4] = {_mm256_shuffle_ps(xy01, zw01, 0x44), _mm256_shuffle_ps(xy01, zw01, 0xee),
                         _mm256_shuffle_ps(xy23, zw23, 0x44), _mm256_shuffle_ps(xy23, zw23, 0xee)};
    JOX_UNROLL
    for (int l = 0; l < 4; l++) {
        _mm_storeu_ps(row[l], _mm256_castps256_ps128(r[l]));
        _mm_storeu_ps(row[l + 4], _mm256_extractf128_ps(r[l], 1));
    }
}

static inline uint32_t jm_bits(JoxMask m) {
    return (uint32_t)_mm256_movemask_ps((__m256)m);
}
static inline uint32_t jm_count(uint32_t bits) {
    return (uint32_t)__builtin_popcount(bits);
}

#endif
