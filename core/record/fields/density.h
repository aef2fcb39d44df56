/* People per square metre on a grid, by a Gaussian kernel: sum of exp(-d2 / 2R2) / (2 pi R2), cut
   off at 3 R and normalised there. Averaged over frames. */
#ifndef JOX_RECORD_DENSITY_H
#define JOX_RECORD_DENSITY_H

#include <stdint.h>

#include "base/vec.h"

#define JOX_DENSITY_KERNEL 1.5f /* m: the R of Curtis et al.'s study of the Mataf */
#define JOX_DENSITY_CELL 0.2f   /* m */

typedef struct JoxDensity {
    JoxV2 low;
    float cell; /* m */
    uint32_t columns, rows;
    float *now;  /* of the last frame, 1/m2, row by row from the lowest y */
    double *sum; /* over frames */
    uint32_t frames;
    float *kernel;         /* along one axis, by position within a cell */
    float *centred;        /* the same of somebody in the middle of a cell */
    int reach;             /* cells */
    float *lines;          /* of a frame: spread along x alone; `reach` more rows at either side */
    uint32_t *from, *to;   /* by row of `lines`: the columns that are not empty */
    float most, most_mean; /* greatest value of any frame */
    JoxV2 most_at;
    double most_time; /* s */
} JoxDensity;

/* Cells are widened where the area would take more than four million. */
JoxDensity *jox_density_create(JoxV2 low, JoxV2 high, float cell, float kernel);
/* Spreads somebody at (x, y) over `count` fields of the grid's size, each with a weight of its own.
 */
void jox_density_spread(const JoxDensity *density, float *const *fields, const float *weights,
                        int count, float x, float y);
/* Adds a frame of `count` positions at time t, s. People are spread along x from where they stand,
   then along y from the middle of their row of cells, which is quick. */
void jox_density_add(JoxDensity *density, const float *x, const float *y, uint32_t count, double t);
/* Mean of all frames at a cell; 0 before the first. */
double jox_density_mean(const JoxDensity *density, uint32_t column, uint32_t row);
void jox_density_free(JoxDensity *density);

#endif
