/* Four lanes: NEON, which every AArch64 has. See lanes_scalar.h. */
#ifndef JOX_SIMD_LANES_NEON_H
#define JOX_SIMD_LANES_NEON_H

#include <arm_neon.h>
#include <stdint.h>
#include <string.h>

enum { JOX_WIDTH = 4 };
#define JOX_WIDE(name) name##_neon

#define JOX_EACH(X) X(0), X(1), X(2), X(3)
#define JOX_FOUR_LANES

typedef float32x4_t JoxFloats;
typedef int32x4_t JoxInts;
typedef uint32x4_t JoxMask;

#include "simd/lanes_vector.h"

static inline JoxInts ji_load_bytes(const uint8_t *from) {
    return (JoxInts){from[0], from[1], from[2], from[3]};
}
static inline void ji_store_bytes(uint8_t *to, JoxInts a) {
    const uint16x4_t pairs = vmovn_u32(vreinterpretq_u32_s32(a));
    const uint32_t four =
        vget_lane_u32(vreinterpret_u32_u8(vmovn_u16(vcombine_u16(pairs, pairs))), 0);
    memcpy(to, &four, sizeof four);
}

static inline JoxFloats jf_sqrt(JoxFloats a) {
    return vsqrtq_f32(a);
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

static inline JoxInts ji_opaque(JoxInts a) {
    __asm__("" : "+w"(a));
    return a;
}

/* The instruction saturates and gives 0 for NaN, so these cases are replaced. */
static inline JoxInts jf_to_ints(JoxFloats a) {
    JoxMask in_range = vcltq_f32(a, vdupq_n_f32(2147483648.0f));
    return vbslq_s32(in_range, vcvtq_s32_f32(a), vdupq_n_s32(INT32_MIN));
}

static inline void jf_transpose_rows_(const float *const row[4], JoxFloats out[4]) {
    float32x4x2_t even = vuzpq_f32(jf_load(row[0]), jf_load(row[1]));
    float32x4x2_t odd = vuzpq_f32(jf_load(row[2]), jf_load(row[3]));
    float32x4x2_t first = vuzpq_f32(even.val[0], odd.val[0]);
    float32x4x2_t second = vuzpq_f32(even.val[1], odd.val[1]);
    out[0] = first.val[0];
    out[1] = second.val[0];
    out[2] = first.val[1];
    out[3] = second.val[1];
}

static inline void jf_put_rows(float *const row[4], const JoxFloats in[4]) {
    const float32x4x2_t xz = vzipq_f32(in[0], in[2]), yw = vzipq_f32(in[1], in[3]);
    const float32x4x2_t low = vzipq_f32(xz.val[0], yw.val[0]);
    const float32x4x2_t high = vzipq_f32(xz.val[1], yw.val[1]);
    jf_store(row[0], low.val[0]);
    jf_store(row[1], low.val[1]);
    jf_store(row[2], high.val[0]);
    jf_store(row[3], high.val[1]);
}

static inline uint32_t jm_bits(JoxMask m) {
    return vaddvq_u32(vandq_u32(m, (JoxMask){1, 2, 4, 8}));
}

#endif
