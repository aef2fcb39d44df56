/* Four lanes: the 128-bit vectors of WebAssembly. See lanes_scalar.h. */
#ifndef JOX_SIMD_LANES_WASM_H
#define JOX_SIMD_LANES_WASM_H

#include <stdint.h>
#include <string.h>
#include <wasm_simd128.h>

enum { JOX_WIDTH = 4 };
#define JOX_WIDE(name) name##_wasm

#define JOX_EACH(X) X(0), X(1), X(2), X(3)

typedef float JoxFloats __attribute__((vector_size(16)));
typedef int32_t JoxInts __attribute__((vector_size(16)));
typedef JoxInts JoxMask;

#include "simd/lanes_vector.h"
#include "simd/packed.h"

static inline JoxInts ji_load_bytes(const uint8_t *from) {
    const v128_t pairs = wasm_u16x8_extend_low_u8x16(wasm_v128_load32_zero(from));
    return (JoxInts)wasm_u32x4_extend_low_u16x8(pairs);
}
static inline void ji_store_bytes(uint8_t *to, JoxInts a) {
    /* 0 to 255: not saturated by narrowing */
    const v128_t low = (v128_t)(a & 255), pairs = wasm_i16x8_narrow_i32x4(low, low);
    wasm_v128_store32_lane(to, wasm_u8x16_narrow_i16x8(pairs, pairs), 0);
}

static inline JoxFloats jf_sqrt(JoxFloats a) {
    return (JoxFloats)wasm_f32x4_sqrt((v128_t)a);
}
/* The instructions give their first argument for equal numbers and NaN. */
static inline JoxFloats jf_min(JoxFloats a, JoxFloats b) {
    return (JoxFloats)wasm_f32x4_pmin((v128_t)b, (v128_t)a);
}
static inline JoxFloats jf_max(JoxFloats a, JoxFloats b) {
    return (JoxFloats)wasm_f32x4_pmax((v128_t)b, (v128_t)a);
}
static inline JoxFloats jf_select(JoxMask m, JoxFloats a, JoxFloats b) {
    return (JoxFloats)wasm_v128_bitselect((v128_t)a, (v128_t)b, (v128_t)m);
}

static inline JoxFloats jf_next(JoxFloats a) {
    return __builtin_shufflevector(a, a, 1, 2, 3, 3);
}

/* Permutes lanes: each of the four bytes of lane l of `from` is the lane that l gets. */
static inline v128_t jox_permute_lanes(v128_t a, v128_t from) {
    const v128_t bytes = wasm_i8x16_const(0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3);
    return wasm_i8x16_swizzle(a, wasm_v128_or(wasm_i32x4_shl(from, 2), bytes));
}
static inline v128_t jox_pack_lanes(v128_t a, uint32_t bits) {
    const v128_t order = wasm_v128_load32_zero(&jox_packed_order[bits]);
    return jox_permute_lanes(
        a, wasm_i8x16_shuffle(order, order, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3));
}
static inline void jf_store_packed(float *to, JoxFloats a, uint32_t bits) {
    wasm_v128_store(to, jox_pack_lanes((v128_t)a, bits));
}
static inline void ji_store_packed(uint32_t *to, JoxInts a, uint32_t bits) {
    wasm_v128_store(to, jox_pack_lanes((v128_t)a, bits));
}
static inline JoxFloats jf_arrange(JoxFloats a, JoxInts from) {
    const v128_t lanes = (v128_t)from;
    return (JoxFloats)jox_permute_lanes(
        (v128_t)a,
        wasm_i8x16_shuffle(lanes, lanes, 0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12));
}
static inline uint32_t jm_count(uint32_t bits) {
    return (uint32_t)__builtin_popcount(bits);
}

static inline JoxInts ji_opaque(JoxInts a) {
    __asm__("" : "+r"(a));
    return a;
}

/* The instruction saturates and gives 0 for NaN, so these cases are replaced. */
static inline JoxInts jf_to_ints(JoxFloats a) {
    const JoxMask in_range = a < 2147483648.0f;
    return ji_select(in_range, (JoxInts)wasm_i32x4_trunc_sat_f32x4((v128_t)a), ji_set(INT32_MIN));
}

/* Transposes four vectors. */
static inline void jf_transpose_(const JoxFloats in[4], JoxFloats out[4]) {
    const JoxFloats xy_low = __builtin_shufflevector(in[0], in[1], 0, 4, 1, 5);
    const JoxFloats zw_low = __builtin_shufflevector(in[0], in[1], 2, 6, 3, 7);
    const JoxFloats xy_high = __builtin_shufflevector(in[2], in[3], 0, 4, 1, 5);
    const JoxFloats zw_high = __builtin_shufflevector(in[2], in[3], 2, 6, 3, 7);
    out[0] = __builtin_shufflevector(xy_low, xy_high, 0, 1, 4, 5);
    out[1] = __builtin_shufflevector(xy_low, xy_high, 2, 3, 6, 7);
    out[2] = __builtin_shufflevector(zw_low, zw_high, 0, 1, 4, 5);
    out[3] = __builtin_shufflevector(zw_low, zw_high, 2, 3, 6, 7);
}
static inline void jf_transpose_rows_(const float *const row[4], JoxFloats out[4]) {
    const JoxFloats in[4] = {jf_load(row[0]), jf_load(row[1]), jf_load(row[2]), jf_load(row[3])};
    jf_transpose_(in, out);
}

static inline void jf_put_rows(float *const row[4], const JoxFloats in[4]) {
    JoxFloats out[4];
    jf_transpose_(in, out);
    JOX_UNROLL
    for (int lane = 0; lane < 4; lane++)
        jf_store(row[lane], out[lane]);
}

static inline uint32_t jm_bits(JoxMask m) {
    return wasm_i32x4_bitmask((v128_t)m);
}

#endif
