/* Four lanes: NEON, which every AArch64 has. See lanes_scalar.h. */
#ifndef JOX_SIMD_LANES_NEON_H
#define JOX_SIMD_LANES_NEON_H

#include <arm_neon.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "simd/packed.h"

enum { JOX_WIDTH = 4 };
#define JOX_WIDE(name) name##_neon

typedef float32x4_t JoxFloats;
typedef int32x4_t JoxInts;
typedef uint32x4_t JoxMask;

static inline JoxFloats jf_set(float x) {
    return vdupq_n_f32(x);
}
static inline JoxFloats jf_load(const float *from) {
    return vld1q_f32(from);
}
static inline void jf_store(float *to, JoxFloats a) {
    vst1q_f32(to, a);
}
static inline JoxInts ji_set(int32_t x) {
    return vdupq_n_s32(x);
}
static inline JoxInts ji_load(const uint32_t *from) {
    return vreinterpretq_s32_u32(vld1q_u32(from));
}
static inline void ji_store(uint32_t *to, JoxInts a) {
    vst1q_u32(to, vreinterpretq_u32_s32(a));
}
static inline JoxInts ji_load_bytes(const uint8_t *from) {
    return (JoxInts){from[0], from[1], from[2], from[3]};
}
static inline void ji_store_bytes(uint8_t *to, JoxInts a) {
    const uint16x4_t pairs = vmovn_u32(vreinterpretq_u32_s32(a));
    const uint32_t four =
        vget_lane_u32(vreinterpret_u32_u8(vmovn_u16(vcombine_u16(pairs, pairs))), 0);
    memcpy(to, &four, sizeof four);
}
static inline JoxInts ji_lane(void) {
    return (JoxInts){0, 1, 2, 3};
}

static inline JoxFloats jf_sqrt(JoxFloats a) {
    return vsqrtq_f32(a);
}
static inline JoxFloats jf_abs(JoxFloats a) {
    return vabsq_f32(a);
}
static inline JoxFloats jf_select(JoxMask m, JoxFloats a, JoxFloats b) {
    return vbslq_f32(m, a, b);
}
/* Not by vminq and vmaxq, which do not return `b` for equal zeros or if one is NaN. */
static inline JoxFloats jf_min(JoxFloats a, JoxFloats b) {
    return vbslq_f32(vcltq_f32(a, b), a, b);
}
static inline JoxFloats jf_max(JoxFloats a, JoxFloats b) {
    return vbslq_f32(vcgtq_f32(a, b), a, b);
}

static inline JoxFloats jf_next(JoxFloats a) {
    return vextq_f32(a, vdupq_laneq_f32(a, 3), 1);
}

static inline JoxMask jf_lt(JoxFloats a, JoxFloats b) {
    return vcltq_f32(a, b);
}
static inline JoxMask jf_le(JoxFloats a, JoxFloats b) {
    return vcleq_f32(a, b);
}

static inline JoxInts ji_add(JoxInts a, JoxInts b) {
    return vaddq_s32(a, b);
}
static inline JoxInts ji_sub(JoxInts a, JoxInts b) {
    return vsubq_s32(a, b);
}
static inline JoxInts ji_and(JoxInts a, JoxInts b) {
    return vandq_s32(a, b);
}
static inline JoxInts ji_or(JoxInts a, JoxInts b) {
    return vorrq_s32(a, b);
}
#define ji_shift_left(a, bits) vshlq_n_s32(a, bits)
#define ji_shift_right(a, bits) vreinterpretq_s32_u32(vshrq_n_u32(vreinterpretq_u32_s32(a), bits))
static inline JoxInts ji_opaque(JoxInts a) {
    __asm__("" : "+w"(a));
    return a;
}
static inline JoxMask ji_equal(JoxInts a, JoxInts b) {
    return vceqq_s32(a, b);
}
static inline JoxMask ji_less(JoxInts a, JoxInts b) {
    return vcltq_s32(a, b);
}
static inline JoxInts ji_select(JoxMask m, JoxInts a, JoxInts b) {
    return vbslq_s32(m, a, b);
}

/* The instruction saturates and gives 0 for NaN, so these cases are replaced. */
static inline JoxInts jf_to_ints(JoxFloats a) {
    JoxMask in_range = vcltq_f32(a, vdupq_n_f32(2147483648.0f));
    return vbslq_s32(in_range, vcvtq_s32_f32(a), vdupq_n_s32(INT32_MIN));
}
static inline JoxFloats ji_to_floats(JoxInts a) {
    return vcvtq_f32_s32(a);
}
static inline JoxInts jf_bits(JoxFloats a) {
    return vreinterpretq_s32_f32(a);
}
static inline JoxFloats ji_as_floats(JoxInts a) {
    return vreinterpretq_f32_s32(a);
}
static inline JoxInts ji_pick(const uint32_t *table, JoxInts at) {
    uint32_t k[4];
    ji_store(k, at);
    return (JoxInts){(int32_t)table[k[0]], (int32_t)table[k[1]], (int32_t)table[k[2]],
                     (int32_t)table[k[3]]};
}
static inline JoxFloats jf_pick_at(const float *table, const uint32_t *at) {
    return (JoxFloats){table[at[0]], table[at[1]], table[at[2]], table[at[3]]};
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

static inline void jf_transpose_(const JoxFloats r[4], JoxFloats out[4]) {
    float32x4x2_t even = vuzpq_f32(r[0], r[1]), odd = vuzpq_f32(r[2], r[3]);
    float32x4x2_t first = vuzpq_f32(even.val[0], odd.val[0]);
    float32x4x2_t second = vuzpq_f32(even.val[1], odd.val[1]);
    out[0] = first.val[0];
    out[1] = second.val[0];
    out[2] = first.val[1];
    out[3] = second.val[1];
}
static inline void jf_records_at(const float *records, const uint32_t *at, JoxFloats out[4]) {
    JoxFloats r[4];
    JOX_UNROLL
    for (int lane = 0; lane < 4; lane++)
        r[lane] = vld1q_f32(records + (size_t)4 * at[lane]);
    jf_transpose_(r, out);
}
static inline void jf_fours(const float *from, size_t stride, JoxFloats out[4]) {
    JoxFloats r[4];
    JOX_UNROLL
    for (size_t lane = 0; lane < 4; lane++)
        r[lane] = vld1q_f32(from + stride * lane);
    jf_transpose_(r, out);
}

static inline JoxMask jm_and(JoxMask a, JoxMask b) {
    return vandq_u32(a, b);
}
static inline JoxMask jm_or(JoxMask a, JoxMask b) {
    return vorrq_u32(a, b);
}
static inline JoxMask jm_without(JoxMask a, JoxMask b) {
    return vbicq_u32(a, b);
}
static inline uint32_t jm_bits(JoxMask m) {
    return vaddvq_u32(vandq_u32(m, (JoxMask){1, 2, 4, 8}));
}
static inline JoxMask jm_of_bits(uint32_t bits) {
    return vtstq_u32(vdupq_n_u32(bits), (JoxMask){1, 2, 4, 8});
}
static inline uint32_t jm_count(uint32_t bits) {
    return jox_count_of_four(bits);
}

#endif
