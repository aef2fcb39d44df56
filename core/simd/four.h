/* A vector of four floats, by the compiler's vector types, on any machine. Each element and each
   sum is computed as in plain C, bit for bit. Holds mostly one thing (x, y, z and 0), whereas
   vectors.h holds one value of several things. */
#ifndef JOX_SIMD_FOUR_H
#define JOX_SIMD_FOUR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef float JoxFour __attribute__((vector_size(16)));

/* The result of a comparison: all bits of an element set where it holds, else none. */
typedef int JoxFourMask __attribute__((vector_size(16)));

/* Returns the elements that the mask marks, and 0 for the others. */
static inline JoxFour jox_keep_four(JoxFourMask marks, JoxFour a) {
    return (JoxFour)(marks & (JoxFourMask)a);
}

static inline JoxFour jox_load_four(const float *from) {
    JoxFour a;
    memcpy(&a, from, sizeof a);
    return a;
}

/* Returns whether the mask marks any element. */
static inline bool jox_any_of_four(JoxFourMask marks) {
    uint64_t halves[2];
    memcpy(halves, &marks, sizeof halves);
    return (halves[0] | halves[1]) != 0;
}

/* Returns the greater of each pair of elements; `b` if they are equal. */
static inline JoxFour jox_greater_four(JoxFour a, JoxFour b) {
    const JoxFourMask greater = a > b;
    return (JoxFour)((greater & (JoxFourMask)a) | (~greater & (JoxFourMask)b));
}

/* Returns the greatest of the elements and `least`. */
static inline float jox_greatest_of_four(JoxFour a, float least) {
    for (int k = 0; k < 4; k++)
        least = a[k] > least ? a[k] : least;
    return least;
}

/* Returns the greatest of `count` floats and 0. */
static inline float jox_greatest(const float *of, size_t count) {
    JoxFour most = {0.0f};
    size_t i = 0;
    for (; i + 4 <= count; i += 4)
        most = jox_greater_four(jox_load_four(of + i), most);
    float greatest = jox_greatest_of_four(most, 0.0f);
    for (; i < count; i++)
        greatest = of[i] > greatest ? of[i] : greatest;
    return greatest;
}

/* Selects four elements of two vectors: 0 to 3 are those of `a`, 4 to 7 those of `b`. */
#if defined __clang__
#define JOX_SHUFFLE_FOURS(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l)
#else
#define JOX_SHUFFLE_FOURS(a, b, i, j, k, l) __builtin_shuffle(a, b, (JoxFourMask){i, j, k, l})
#endif

/* Transposes a 4 x 4 matrix in place. */
static inline void jox_transpose_four(JoxFour r[4]) {
    const JoxFour xy_low = JOX_SHUFFLE_FOURS(r[0], r[1], 0, 4, 1, 5);
    const JoxFour xy_high = JOX_SHUFFLE_FOURS(r[0], r[1], 2, 6, 3, 7);
    const JoxFour zw_low = JOX_SHUFFLE_FOURS(r[2], r[3], 0, 4, 1, 5);
    const JoxFour zw_high = JOX_SHUFFLE_FOURS(r[2], r[3], 2, 6, 3, 7);
    r[0] = JOX_SHUFFLE_FOURS(xy_low, zw_low, 0, 1, 4, 5);
    r[1] = JOX_SHUFFLE_FOURS(xy_low, zw_low, 2, 3, 6, 7);
    r[2] = JOX_SHUFFLE_FOURS(xy_high, zw_high, 0, 1, 4, 5);
    r[3] = JOX_SHUFFLE_FOURS(xy_high, zw_high, 2, 3, 6, 7);
}

/* Writes `count` records of four 32-bit words, one from each column. */
static inline void jox_interleave(void *records, const void *x, const void *y, const void *z,
                                  const void *w, size_t count) {
    const char *columns[4] = {x, y, z, w};
    char *to = records;
    size_t i = 0;
    for (; i + 4 <= count; i += 4, to += 4 * sizeof(JoxFour)) {
        JoxFour rows[4];
        for (int c = 0; c < 4; c++)
            memcpy(&rows[c], columns[c] + i * sizeof(float), sizeof *rows);
        jox_transpose_four(rows);
        memcpy(to, rows, sizeof rows);
    }
    for (; i < count; i++)
        for (int c = 0; c < 4; c++, to += sizeof(float))
            memcpy(to, columns[c] + i * sizeof(float), sizeof(float));
}

#endif
