/* Four floats, by the compiler, on any machine and in any instruction set; each element and each
   sum in the order of plain C, to the bit. Mostly of one thing, in place of one of four things as
   in vectors.h: x, y, z and 0. */
#ifndef JOX_SIMD_FOUR_H
#define JOX_SIMD_FOUR_H

#include <stddef.h>
#include <string.h>

typedef float JoxFour __attribute__((vector_size(16)));

/* What comparisons give: all bits where they hold, else none. */
typedef int JoxFourMask __attribute__((vector_size(16)));

/* The elements that are marked, 0 for the others. */
static inline JoxFour jox_keep_four(JoxFourMask marks, JoxFour a) {
    return (JoxFour)(marks & (JoxFourMask)a);
}

static inline JoxFour jox_load_four(const float *from) {
    JoxFour a;
    memcpy(&a, from, sizeof a);
    return a;
}

/* Element by element the greater, which is `b` where they are equal. */
static inline JoxFour jox_greater_four(JoxFour a, JoxFour b) {
    const JoxFourMask greater = a > b;
    return (JoxFour)((greater & (JoxFourMask)a) | (~greater & (JoxFourMask)b));
}

/* The greatest element, or `least` where that is greater. */
static inline float jox_greatest_of_four(JoxFour a, float least) {
    for (int k = 0; k < 4; k++)
        least = a[k] > least ? a[k] : least;
    return least;
}

/* The greatest of `count` floats, or 0 where that is greater. */
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

/* Elements of two: 0 to 3 of the first, 4 to 7 of the second. */
#if defined __clang__
#define JOX_SHUFFLE_FOURS(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l)
#else
#define JOX_SHUFFLE_FOURS(a, b, i, j, k, l) __builtin_shuffle(a, b, (JoxFourMask){i, j, k, l})
#endif

/* Four rows of four, of four columns. */
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

/* `count` records of four words each, one of each column. */
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

static inline float jox_dot_four(JoxFour a, JoxFour b) {
    const JoxFour p = a * b;
    return p[0] + p[1] + p[2];
}

#endif
