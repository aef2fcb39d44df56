/* One lane, in plain C: the definition of every operation on lanes. The other lanes_*.h implement
   the same operations with the same results, bit for bit. */
#ifndef JOX_SIMD_LANES_SCALAR_H
#define JOX_SIMD_LANES_SCALAR_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum { JOX_WIDTH = 1 };
#define JOX_WIDE(name) name##_scalar

typedef float JoxFloats;
typedef int32_t JoxInts;
typedef bool JoxMask;

/* set: the same number in all lanes. load, store: JOX_WIDTH consecutive numbers, aligned or not. */
static inline JoxFloats jf_set(float x) {
    return x;
}
static inline JoxFloats jf_load(const float *from) {
    return *from;
}
static inline void jf_store(float *to, JoxFloats a) {
    *to = a;
}
static inline JoxInts ji_set(int32_t x) {
    return x;
}
static inline JoxInts ji_load(const uint32_t *from) {
    return (int32_t)*from;
}
static inline void ji_store(uint32_t *to, JoxInts a) {
    *to = (uint32_t)a;
}
/* Load and store JOX_WIDTH consecutive bytes; a store writes the low byte of each lane. */
static inline JoxInts ji_load_bytes(const uint8_t *from) {
    return *from;
}
static inline void ji_store_bytes(uint8_t *to, JoxInts a) {
    *to = (uint8_t)a;
}
/* Returns the index of each lane. */
static inline JoxInts ji_lane(void) {
    return 0;
}

static inline JoxFloats jf_sqrt(JoxFloats a) {
    return sqrtf(a);
}
static inline JoxFloats jf_abs(JoxFloats a) {
    return fabsf(a);
}
/* Return `b` where the two are equal or one is NaN. */
static inline JoxFloats jf_min(JoxFloats a, JoxFloats b) {
    return a < b ? a : b;
}
static inline JoxFloats jf_max(JoxFloats a, JoxFloats b) {
    return a > b ? a : b;
}
/* Returns `a` where the mask is set, else `b`. */
static inline JoxFloats jf_select(JoxMask m, JoxFloats a, JoxFloats b) {
    return m ? a : b;
}

/* Shifts down by one lane: lane l gets lane l + 1; the last keeps its own. */
static inline JoxFloats jf_next(JoxFloats a) {
    return a;
}

/* Arranges lanes anew: lane l gets lane from[l], below JOX_WIDTH. */
static inline JoxFloats jf_arrange(JoxFloats a, JoxInts from) {
    (void)from;
    return a;
}

/* Less, less or equal; false where one is NaN. */
static inline JoxMask jf_lt(JoxFloats a, JoxFloats b) {
    return a < b;
}
static inline JoxMask jf_le(JoxFloats a, JoxFloats b) {
    return a <= b;
}

/* Overflow wraps. */
static inline JoxInts ji_add(JoxInts a, JoxInts b) {
    return (int32_t)((uint32_t)a + (uint32_t)b);
}
static inline JoxInts ji_sub(JoxInts a, JoxInts b) {
    return (int32_t)((uint32_t)a - (uint32_t)b);
}
static inline JoxInts ji_and(JoxInts a, JoxInts b) {
    return a & b;
}
static inline JoxInts ji_or(JoxInts a, JoxInts b) {
    return a | b;
}
#define ji_shift_left(a, bits) ((int32_t)((uint32_t)(a) << (bits)))
/* Shifts in zeros. */
#define ji_shift_right(a, bits) ((int32_t)((uint32_t)(a) >> (bits)))
/* Returns `a` but hides its value from the compiler, which would otherwise make a constant of every
   index that is counted on from it. */
static inline JoxInts ji_opaque(JoxInts a) {
    __asm__("" : "+r"(a));
    return a;
}
static inline JoxMask ji_equal(JoxInts a, JoxInts b) {
    return a == b;
}
static inline JoxMask ji_less(JoxInts a, JoxInts b) {
    return a < b;
}
static inline JoxInts ji_select(JoxMask m, JoxInts a, JoxInts b) {
    return m ? a : b;
}

/* Rounds towards zero; INT32_MIN if out of range or NaN. */
static inline JoxInts jf_to_ints(JoxFloats a) {
    return a >= -2147483648.0f && a < 2147483648.0f ? (int32_t)a : INT32_MIN;
}
static inline JoxFloats ji_to_floats(JoxInts a) {
    return (float)a;
}
/* Reinterpret the bits. */
static inline JoxInts jf_bits(JoxFloats a) {
    JoxInts bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}
static inline JoxFloats ji_as_floats(JoxInts a) {
    JoxFloats floats;
    memcpy(&floats, &a, sizeof floats);
    return floats;
}
/* Gather table[at] for each lane. jf_pick_at reads the indices from memory, which is faster than
   from registers. */
static inline JoxFloats jf_pick(const float *table, JoxInts at) {
    return table[at];
}
static inline JoxFloats jf_pick_at(const float *table, const uint32_t *at) {
    return table[*at];
}
static inline JoxInts ji_pick(const uint32_t *table, JoxInts at) {
    return (int32_t)table[at];
}

/* Store the lanes whose bit is set one after the other. JOX_WIDTH numbers are written; those after
   the last such lane are undefined. */
static inline void jf_store_packed(float *to, JoxFloats a, uint32_t bits) {
    (void)bits;
    *to = a;
}
static inline void ji_store_packed(uint32_t *to, JoxInts a, uint32_t bits) {
    (void)bits;
    *to = (uint32_t)a;
}

/* Loads the record of four floats at index at[l] for each lane l: out[c][l] is number c. */
static inline void jf_records_at(const float *records, const uint32_t *at, JoxFloats out[4]) {
    for (size_t c = 0; c < 4; c++)
        out[c] = records[(size_t)4 * *at + c];
}
/* Loads four floats for each lane: out[c][l] is row[l][c]; and stores them. */
static inline void jf_rows(const float *const row[1], JoxFloats out[4]) {
    memcpy(out, row[0], 4 * sizeof *out);
}
static inline void jf_put_rows(float *const row[1], const JoxFloats in[4]) {
    memcpy(row[0], in, 4 * sizeof *in);
}
/* Loads four floats for each lane, from addresses `stride` floats apart: out[c][l] is number c. */
static inline void jf_fours(const float *from, size_t stride, JoxFloats out[4]) {
    (void)stride;
    for (size_t c = 0; c < 4; c++)
        out[c] = from[c];
}

static inline JoxMask jm_and(JoxMask a, JoxMask b) {
    return a && b;
}
static inline JoxMask jm_or(JoxMask a, JoxMask b) {
    return a || b;
}
/* Returns `a` and not `b`. */
static inline JoxMask jm_without(JoxMask a, JoxMask b) {
    return a && !b;
}
/* Convert a mask to bits and back: bit l is lane l. */
static inline uint32_t jm_bits(JoxMask m) {
    return m;
}
static inline JoxMask jm_of_bits(uint32_t bits) {
    return bits & 1;
}
/* Counts the set bits of a mask. */
static inline uint32_t jm_count(uint32_t bits) {
    return bits & 1;
}

#endif
