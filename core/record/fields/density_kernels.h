/* Loops of the density that are compiled for each instruction set (density_wide.c); density_put.c,
   density_spread.c and density_diffuse.c call them. For any lane count, each number results from
   the same operations in the same order, so all results are equal bit by bit. */
#ifndef JOX_RECORD_FIELDS_DENSITY_KERNELS_H
#define JOX_RECORD_FIELDS_DENSITY_KERNELS_H

#include <stdint.h>

#include "simd/isa.h"

enum {
    JOX_DENSITY_AT_ONCE = 128, /* people in a chunk; a multiple of all lane counts */
    JOX_DENSITY_IMAGES = 3     /* a person, and the images across each of the two periodic edges */
};

/* The nodes along x or y. A position is wanted if first <= position < end, in cells. */
typedef struct JoxDensityAxis {
    float low, cell; /* m: lower end of the first cell, and side of a cell */
    float first, end;
    float period; /* m; 0: not periodic */
} JoxDensityAxis;

/* Positions of a chunk of people along an axis, each between two nodes. */
typedef struct JoxDensityPlaced {
    /* bit k: image k is wanted; only then are the arrays below set */
    uint32_t images[JOX_DENSITY_AT_ONCE];
    uint32_t node[JOX_DENSITY_IMAGES][JOX_DENSITY_AT_ONCE]; /* index of the lower node */
    float share[JOX_DENSITY_IMAGES][JOX_DENSITY_AT_ONCE];   /* share of the upper node */
} JoxDensityPlaced;

/* Places `count` people, at most JOX_DENSITY_AT_ONCE. Returns false if no image is wanted. */
typedef bool JoxDensityPlaceKernel(const JoxDensityAxis *axis, const float *at, uint32_t count,
                                   JoxDensityPlaced *placed);
/* Returns bits of the cells that are not zero, among at most 64. */
typedef uint64_t JoxDensityNonzeroKernel(const float *cells, int count);
/* Sets out[c] to scale * the sum of taps[k] * rows[k][c], added in order of k. */
typedef void JoxDensitySumKernel(const float *const *rows, const float *taps, int count,
                                 float scale, float *out, int columns);

/* Input of a diffusion step along a row; pointers are to the first cell of the row
   (density_diffuse.c). */
typedef struct JoxDensityStep {
    float share;                  /* flow over a fully open side per difference of densities */
    int wide;                     /* cells from one row to the next */
    const float *u;               /* densities */
    const float *open_x, *open_y; /* cells: open width to the next node along x, and along y */
    const float *per;             /* 1 / area of the node */
} JoxDensityStep;
/* Computes cells from..to - 1 of `out`; it may compute further cells from `low` on. */
typedef void JoxDensityStepKernel(const JoxDensityStep *step, int low, int from, int to,
                                  float *out);
/* Computes words from..to - 1 of `next`, the cells reached from `reached` in a step over the ways
   to the right (`right`) and up (`up`) of each cell; `row` is the number of words in a row. */
typedef void JoxDensityReachKernel(const uint64_t *reached, const uint64_t *right,
                                   const uint64_t *up, int row, int from, int to, uint64_t *next);

#define X(name, isa)                                                                               \
    JoxDensityPlaceKernel jox_density_place_##name;                                                \
    JoxDensityNonzeroKernel jox_density_find_nonzero_##name;                                       \
    JoxDensitySumKernel jox_density_sum_##name;                                                    \
    JoxDensityStepKernel jox_density_step_mixed_##name, jox_density_step_plain_##name;             \
    JoxDensityReachKernel jox_density_reach_##name;
JOX_ISAS(X)
#undef X

#endif
