/* Sixteen lanes: AVX-512F. See lanes_scalar.h. */
#ifndef JOX_SIMD_LANES_AVX512_H
#define JOX_SIMD_LANES_AVX512_H

#include <immintrin.h>
#include <stdint.h>

enum { JOX_WIDTH = 16 };
#define JOX_WIDE(name) name##_avx512

#define JOX_EACH(X)                                                                                \
    X(0), X(1), X(2), X(3), X(4), X(5), X(6), X(7), X(8), X(9), X(10), X(11), X(12), X(13), X(14), \
        X(15)
#define JOX_MASK_REGISTERS

typedef __m512 JoxFloats;
typedef int32_t JoxInts __attribute__((vector_size(64)));
typedef __mmask16 JoxMask;

#include "simd/lanes_vector.h"

static inline JoxInts ji_load_bytes(const uint8_t *from) {
    return (JoxInts)_mm512_cvtepu8_epi32(_mm_loadu_si128((const __m128i *)from));
}
static inline void ji_store_bytes(uint8_t *to, JoxInts a) {
    _mm_storeu_si128((__m128i *)to, _mm512_cvtepi32_epi8((__m512i)a));
}

static inline JoxFloats jf_sqrt(JoxFloats a) {
    return _mm512_sqrt_ps(a);
}
static inline JoxFloats jf_min(JoxFloats a, JoxFloats b) {
    return _mm512_min_ps(a, b);
}
static inline JoxFloats jf_max(JoxFloats a, JoxFloats b) {
    return _mm512_max_ps(a, b);
}
static inline JoxFloats jf_select(JoxMask m, JoxFloats a, JoxFloats b) {
    return _mm512_mask_blend_ps(m, b, a);
}

static inline JoxFloats jf_next(JoxFloats a) {
    const __m512i next = _mm512_setr_epi32(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 15);
    return _mm512_permutexvar_ps(next, a);
}

static inline JoxFloats jf_arrange(JoxFloats a, JoxInts from) {
    return _mm512_permutexvar_ps((__m512i)from, a);
}

static inline JoxMask jf_lt(JoxFloats a, JoxFloats b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ);
}
static inline JoxMask jf_le(JoxFloats a, JoxFloats b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ);
}

static inline JoxInts ji_opaque(JoxInts a) {
    __asm__("" : "+v"(a));
    return a;
}
static inline JoxMask ji_equal(JoxInts a, JoxInts b) {
    return _mm512_cmpeq_epi32_mask((__m512i)a, (__m512i)b);
}
static inline JoxMask ji_less(JoxInts a, JoxInts b) {
    return _mm512_cmpgt_epi32_mask((__m512i)b, (__m512i)a);
}

static inline JoxInts jf_to_ints(JoxFloats a) {
    return (JoxInts)_mm512_cvttps_epi32(a);
}
static inline JoxInts ji_pick(const uint32_t *table, JoxInts at) {
    return (JoxInts)_mm512_i32gather_epi32((__m512i)at, table, 4);
}
static inline JoxFloats jf_pick(const float *table, JoxInts at) {
    return _mm512_i32gather_ps((__m512i)at, table, 4);
}
static inline JoxFloats jf_pick_at(const float *table, const uint32_t *at) {
    return jf_pick(table, ji_load(at));
}

static inline void jf_store_packed(float *to, JoxFloats a, uint32_t bits) {
    _mm512_storeu_ps(to, _mm512_maskz_compress_ps((__mmask16)bits, a));
}
static inline void ji_store_packed(uint32_t *to, JoxInts a, uint32_t bits) {
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32((__mmask16)bits, (__m512i)a));
}

/* Loads the fours of lanes l, l + 4, l + 8 and l + 12 into one register; its quarters are then
   transposed separately. */
static inline __m512 jf_four_fours_(const float *a, const float *b, const float *c,
                                    const float *d) {
    const __m512 ab =
        _mm512_insertf32x4(_mm512_castps128_ps512(_mm_loadu_ps(a)), _mm_loadu_ps(b), 1);
    return _mm512_insertf32x4(_mm512_insertf32x4(ab, _mm_loadu_ps(c), 2), _mm_loadu_ps(d), 3);
}
static inline void jf_transpose_rows_(const float *const row[16], JoxFloats out[4]) {
    __m512 r[4];
    JOX_UNROLL
    for (int l = 0; l < 4; l++)
        r[l] = jf_four_fours_(row[l], row[l + 4], row[l + 8], row[l + 12]);
    __m512 xy01 = _mm512_unpacklo_ps(r[0], r[1]), zw01 = _mm512_unpackhi_ps(r[0], r[1]);
    __m512 xy23 = _mm512_unpacklo_ps(r[2], r[3]), zw23 = _mm512_unpackhi_ps(r[2], r[3]);
    out[0] = _mm512_shuffle_ps(xy01, xy23, 0x44);
    out[1] = _mm512_shuffle_ps(xy01, xy23, 0xee);
    out[2] = _mm512_shuffle_ps(zw01, zw23, 0x44);
    out[3] = _mm512_shuffle_ps(zw01, zw23, 0xee);
}

static inline void jf_put_rows(float *const row[16], const JoxFloats in[4]) {
    const __m512 xy01 = _mm512_unpacklo_ps(in[0], in[1]), zw01 = _mm512_unpacklo_ps(in[2], in[3]);
    const __m512 xy23 = _mm512_unpackhi_ps(in[0], in[1]), zw23 = _mm512_unpackhi_ps(in[2], in[3]);
    const __m512 r[4] = {_mm512_shuffle_ps(xy01, zw01, 0x44), _mm512_shuffle_ps(xy01, zw01, 0xee),
                         _mm512_shuffle_ps(xy23, zw23, 0x44), _mm512_shuffle_ps(xy23, zw23, 0xee)};
    JOX_UNROLL
    for (int l = 0; l < 4; l++) {
        _mm_storeu_ps(row[l], _mm512_castps512_ps128(r[l]));
        _mm_storeu_ps(row[l + 4], _mm512_extractf32x4_ps(r[l], 1));
        _mm_storeu_ps(row[l + 8], _mm512_extractf32x4_ps(r[l], 2));
        _mm_storeu_ps(row[l + 12], _mm512_extractf32x4_ps(r[l], 3));
    }
}

static inline uint32_t jm_bits(JoxMask m) {
    return m;
}
static inline JoxMask jm_of_bits(uint32_t bits) {
    return (JoxMask)bits;
}
static inline uint32_t jm_count(uint32_t bits) {
    return (uint32_t)__builtin_popcount(bits);
}

#endif
