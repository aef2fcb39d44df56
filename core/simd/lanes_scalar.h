/* One lane, in plain C: what every operation of lanes is to do. */
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

/* The same in all lanes; from and to JOX_WIDTH consecutive numbers, aligned or not. */
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
/* From and to JOX_WIDTH consecutive bytes; of what is stored, the low ones. */
static inline JoxInts ji_load_bytes(const uint8_t *from) {
    return *from;
}
static inline void ji_store_bytes(uint8_t *to, JoxInts a) {
    *to = (uint8_t)a;
}
/* The number of the lane. */
static inline JoxInts ji_lane(void) {
    return 0;
}

static inline JoxFloats jf_sqrt(JoxFloats a) {
    return sqrtf(a);
}
static inline JoxFloats jf_abs(JoxFloats a) {
    return fabsf(a);
}
/* b where the two are equal or one is not a number. */
static inline JoxFloats jf_min(JoxFloats a, JoxFloats b) {
    return a < b ? a : b;
}
static inline JoxFloats jf_max(JoxFloats a, JoxFloats b) {
    return a > b ? a : b;
}
/* a where the mask is set, else b. */
static inline JoxFloats jf_select(JoxMask m, JoxFloats a, JoxFloats b) {
    return m ? a : b;
}

/* Each lane gets the next one's, and the last keeps its own. */
static inline JoxFloats jf_next(JoxFloats a) {
    return a;
}

/* False where one is not a number. */
static inline JoxMask jf_lt(JoxFloats a, JoxFloats b) {
    return a < b;
}
static inline JoxMask jf_le(JoxFloats a, JoxFloats b) {
    return a <= b;
}

/* Sums wrap. */
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
/* Zeros come in. */
#define ji_shift_right(a, bits) ((int32_t)((uint32_t)(a) >> (bits)))
/* The same, but the compiler does not know it: what is counted on from there is not turned into a
   constant for each turn of a loop. */
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

/* Towards zero; INT32_MIN where that is no 32-bit integer. */
static inline JoxInts jf_to_ints(JoxFloats a) {
    return a >= -2147483648.0f && a < 2147483648.0f ? (int32_t)a : INT32_MIN;
}
static inline JoxFloats ji_to_floats(JoxInts a) {
    return (float)a;
}
/* The same bits. */
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
/* Lane by lane table[at]; jf_pick_at: from where the places lie in memory, which is faster than
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

/* Stores the lanes of which `bits` are set, one after the other; writes JOX_WIDTH numbers, of which
   those after the last such lane are of no meaning. */
static inline void jf_store_packed(float *to, JoxFloats a, uint32_t bits) {
    (void)bits;
    *to = a;
}
static inline void ji_store_packed(uint32_t *to, JoxInts a, uint32_t bits) {
    (void)bits;
    *to = (uint32_t)a;
}

/* The records of four floats at the places `at` of the lanes: out[c] is number c of each. */
static inline void jf_records_at(const float *records, const uint32_t *at, JoxFloats out[4]) {
    for (size_t c = 0; c < 4; c++)
        out[c] = records[(size_t)4 * *at + c];
}
/* Four floats of each lane, `stride` floats on from lane to lane. */
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
/* a, but not b. */
static inline JoxMask jm_without(JoxMask a, JoxMask b) {
    return a && !b;
}
/* Bit l is lane l. */
static inline uint32_t jm_bits(JoxMask m) {
    return m;
}
static inline JoxMask jm_of_bits(uint32_t bits) {
    return bits & 1;
}
/* How many of the bits of a mask are set. */
static inline uint32_t jm_count(uint32_t bits) {
    return bits & 1;
}

#endif
