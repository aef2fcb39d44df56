/* Operations on several lanes that the vector types of GCC and Clang have on every machine.
   Included by the header of an instruction set, which first defines:
   - JOX_WIDTH, JoxFloats, JoxInts (of int32_t), JoxMask;
   - JOX_EACH(X): X(0), X(1), ... for every lane;
   - JOX_MASK_REGISTERS if masks have registers of their own; else all bits of a lane of JoxMask are
     set, or none;
   - JOX_FOUR_LANES if there are four lanes, which no instruction packs.
   It then adds the operations that take an instruction of its own. lanes_scalar.h defines all. */
#ifndef JOX_SIMD_LANES_VECTOR_H
#define JOX_SIMD_LANES_VECTOR_H

#include <stddef.h>
#include <stdint.h>

typedef uint32_t JoxUints __attribute__((vector_size(4 * JOX_WIDTH)));
/* Lanes in memory, aligned like one number. */
typedef float JoxFloatsAt __attribute__((vector_size(4 * JOX_WIDTH), aligned(4), may_alias));
typedef int32_t JoxIntsAt __attribute__((vector_size(4 * JOX_WIDTH), aligned(4), may_alias));

/* Subtracting 0 spreads a number over all lanes and changes none; adding 0 would change -0. */
static inline JoxFloats jf_set(float x) {
    return x - (JoxFloats){0};
}
static inline JoxFloats jf_load(const float *from) {
    return *(const JoxFloatsAt *)from;
}
static inline void jf_store(float *to, JoxFloats a) {
    *(JoxFloatsAt *)to = a;
}
static inline JoxInts ji_set(int32_t x) {
    return x - (JoxInts){0};
}
static inline JoxInts ji_load(const uint32_t *from) {
    return *(const JoxIntsAt *)from;
}
static inline void ji_store(uint32_t *to, JoxInts a) {
    *(JoxIntsAt *)to = a;
}
static inline JoxInts ji_lane(void) {
#define LANE(l) l
    return (JoxInts){JOX_EACH(LANE)};
#undef LANE
}

/* Defined by every instruction set: jf_select, and the transposition of one row of four floats for
   each lane into four vectors, and back. */
static inline JoxFloats jf_select(JoxMask m, JoxFloats a, JoxFloats b);
static inline void jf_transpose_rows_(const float *const row[JOX_WIDTH], JoxFloats out[4]);
static inline void jf_put_rows(float *const row[JOX_WIDTH], const JoxFloats in[4]);

static inline JoxInts ji_select(JoxMask m, JoxInts a, JoxInts b) {
    return (JoxInts)jf_select(m, (JoxFloats)a, (JoxFloats)b);
}
static inline void jf_rows(const float *const row[JOX_WIDTH], JoxFloats out[4]) {
    jf_transpose_rows_(row, out);
}
static inline void jf_records_at(const float *records, const uint32_t *at, JoxFloats out[4]) {
    const float *row[JOX_WIDTH];
    JOX_UNROLL
    for (int l = 0; l < JOX_WIDTH; l++)
        row[l] = records + (size_t)4 * at[l];
    jf_transpose_rows_(row, out);
}
static inline void jf_fours(const float *from, size_t stride, JoxFloats out[4]) {
    const float *row[JOX_WIDTH];
    JOX_UNROLL
    for (size_t l = 0; l < JOX_WIDTH; l++)
        row[l] = from + stride * l;
    jf_transpose_rows_(row, out);
}

static inline JoxInts jf_bits(JoxFloats a) {
    return (JoxInts)a;
}
static inline JoxFloats ji_as_floats(JoxInts a) {
    return (JoxFloats)a;
}
static inline JoxFloats ji_to_floats(JoxInts a) {
    return __builtin_convertvector(a, JoxFloats);
}
static inline JoxFloats jf_abs(JoxFloats a) {
    return (JoxFloats)((JoxInts)a & INT32_MAX);
}

static inline JoxInts ji_add(JoxInts a, JoxInts b) {
    return (JoxInts)((JoxUints)a + (JoxUints)b);
}
static inline JoxInts ji_sub(JoxInts a, JoxInts b) {
    return (JoxInts)((JoxUints)a - (JoxUints)b);
}
static inline JoxInts ji_and(JoxInts a, JoxInts b) {
    return a & b;
}
static inline JoxInts ji_or(JoxInts a, JoxInts b) {
    return a | b;
}
static inline JoxInts ji_shift_left(JoxInts a, int bits) {
    return (JoxInts)((JoxUints)a << bits);
}
static inline JoxInts ji_shift_right(JoxInts a, int bits) {
    return (JoxInts)((JoxUints)a >> bits);
}

static inline JoxMask jm_and(JoxMask a, JoxMask b) {
    return a & b;
}
static inline JoxMask jm_or(JoxMask a, JoxMask b) {
    return a | b;
}
static inline JoxMask jm_without(JoxMask a, JoxMask b) {
    return a & (JoxMask)~b;
}

/* ---- masks and gathers of instruction sets that have no registers for masks ---- */

#ifndef JOX_MASK_REGISTERS

static inline JoxMask jf_lt(JoxFloats a, JoxFloats b) {
    return (JoxMask)(a < b);
}
static inline JoxMask jf_le(JoxFloats a, JoxFloats b) {
    return (JoxMask)(a <= b);
}
static inline JoxMask ji_equal(JoxInts a, JoxInts b) {
    return (JoxMask)(a == b);
}
static inline JoxMask ji_less(JoxInts a, JoxInts b) {
    return (JoxMask)(a < b);
}
static inline JoxMask jm_of_bits(uint32_t bits) {
#define BIT(l) 1 << l
    const JoxInts bit = {JOX_EACH(BIT)};
#undef BIT
    return ji_equal(ji_set((int32_t)bits) & bit, bit);
}

/* Without gather instructions: where these are microcode, as on AMD processors, they are slower. */
#define PICKED(l) table[at[l]]
static inline JoxFloats jf_pick_at(const float *table, const uint32_t *at) {
    return (JoxFloats){JOX_EACH(PICKED)};
}
static inline JoxFloats jf_pick(const float *table, JoxInts lanes) {
    uint32_t at[JOX_WIDTH];
    ji_store(at, lanes);
    return jf_pick_at(table, at);
}
static inline JoxInts ji_pick(const uint32_t *from, JoxInts lanes) {
    const int32_t *table = (const int32_t *)from;
    uint32_t at[JOX_WIDTH];
    ji_store(at, lanes);
    return (JoxInts){JOX_EACH(PICKED)};
}
#undef PICKED

#endif

/* ---- four lanes, of instruction sets that cannot permute by a register ---- */

#ifdef JOX_FOUR_LANES
#include "simd/packed.h"

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
static inline JoxFloats jf_arrange(JoxFloats a, JoxInts from) {
    float lanes[4];
    jf_store(lanes, a);
    return jf_pick(lanes, from);
}
static inline uint32_t jm_count(uint32_t bits) {
    return jox_count_of_four(bits);
}

#endif

#endif
