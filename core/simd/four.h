/* Four floats, by the compiler, on any machine and in any instruction set; each element and each
   sum in the order of plain C, to the bit. Mostly of one thing, in place of one of four things as
   in vectors.h: x, y, z and 0. */
#ifndef JOX_SIMD_FOUR_H
#define JOX_SIMD_FOUR_H

typedef float JoxFour __attribute__((vector_size(16)));

/* What comparisons give: all bits where they hold, else none. */
typedef int JoxFourMask __attribute__((vector_size(16)));

/* The elements that are marked, 0 for the others. */
static inline JoxFour jox_keep_four(JoxFourMask marks, JoxFour a) {
    return (JoxFour)(marks & (JoxFourMask)a);
}

static inline float jox_dot_four(JoxFour a, JoxFour b) {
    const JoxFour p = a * b;
    return p[0] + p[1] + p[2];
}

#endif
