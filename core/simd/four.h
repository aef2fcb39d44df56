/* Four floats of one thing, in place of one of four things as in vectors.h: x, y, z and 0. By the
   compiler, on any machine; each element and each sum in the order of plain C, to the bit. */
#ifndef JOX_SIMD_FOUR_H
#define JOX_SIMD_FOUR_H

typedef float JoxFour __attribute__((vector_size(16)));

static inline float jox_dot_four(JoxFour a, JoxFour b) {
    const JoxFour p = a * b;
    return p[0] + p[1] + p[2];
}

#endif
