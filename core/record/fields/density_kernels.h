/* The loops of density that are compiled for each instruction set (density_wide.c). Whatever the
   width, each number comes of the same operations in the same order, so that all give the same
   bits. */
#ifndef JOX_RECORD_FIELDS_DENSITY_KERNELS_H
#define JOX_RECORD_FIELDS_DENSITY_KERNELS_H

#include <stdint.h>

#include "simd/isa.h"

enum {
    JOX_DENSITY_AT_ONCE = 128, /* people; a multiple of every width */
    JOX_DENSITY_IMAGES = 3     /* somebody, and they beyond a periodic edge at either side */
};

/* The nodes along x or y. Places from `first` to below `end`, in cells, are wanted. */
typedef struct JoxDensityAxis {
    float low, cell; /* m: where the first cell begins, and of each */
    float first, end;
    float period; /* m; 0: none */
} JoxDensityAxis;

/* Where people are along an axis, each between two nodes. */
typedef struct JoxDensityPlaced {
    uint32_t images[JOX_DENSITY_AT_ONCE]; /* bit k: image k is wanted; what follows then holds */
    uint32_t node[JOX_DENSITY_IMAGES][JOX_DENSITY_AT_ONCE]; /* the lower */
    float share[JOX_DENSITY_IMAGES][JOX_DENSITY_AT_ONCE];   /* of the higher one */
} JoxDensityPlaced;

/* Places `count` people, no more than at once; false: none is wanted. */
typedef bool JoxDensityPlaceKernel(const JoxDensityAxis *axis, const float *at, uint32_t count,
                                   JoxDensityPlaced *placed);
/* Which of so many cells, no more than 64, hold something: bits. */
typedef uint64_t JoxDensityHeldKernel(const float *cells, int count);
/* out[c] = scale * the sum of taps[k] * rows[k][c], added from the first row on. */
typedef void JoxDensitySumKernel(const float *const *rows, const float *taps, int count,
                                 float scale, float *out, int columns);

/* A step of diffusion along a row: what it reads, from the row's first cell on (see
   density_diffuse.c). */
typedef struct JoxDensityStep {
    float share;
    int wide;       /* from a row to the next */
    const float *u; /* densities */
    const float *open_x, *open_y, *per;
} JoxDensityStep;
/* Cells from..to - 1; those from `low` on may be stepped, too. */
typedef void JoxDensityStepKernel(const JoxDensityStep *step, int low, int from, int to,
                                  float *out);
/* Of words from..to - 1 of cells as bits, `row` words to a row: what can be reached from `is` in a
   step by the ways to the right of cells and up from them. */
typedef void JoxDensityReachKernel(const uint64_t *is, const uint64_t *right, const uint64_t *up,
                                   int row, int from, int to, uint64_t *next);

#define X(name, isa)                                                                               \
    JoxDensityPlaceKernel jox_density_place_##name;                                                \
    JoxDensityHeldKernel jox_density_held_##name;                                                  \
    JoxDensitySumKernel jox_density_sum_##name;                                                    \
    JoxDensityStepKernel jox_density_step_mixed_##name, jox_density_step_plain_##name;             \
    JoxDensityReachKernel jox_density_reach_##name;
JOX_ISAS(X)
#undef X

#endif
