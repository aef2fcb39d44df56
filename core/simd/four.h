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

static inline float jox_dot_four(JoxFour a, JoxFour b) {
    const JoxFour p = a * b;
    return p[0] + p[1] + p[2];
}

#endif
