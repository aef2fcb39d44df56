/* People per square metre on a grid: the one density of maps, tables, summaries and levels of
   service. Each person is spread by the Gaussian exp(-d2 / R2) / (pi R2), R = 1 m, of Helbing,
   Johansson and Al-Abideen (Phys. Rev. E 75, 046109, 2007), as heat spreads over the walkable
   floor: walls are impermeable and reflect. So

   - far from walls the density is that Gaussian
   - the integral over the floor is the number of people, wherever they stand
   - an evenly spaced crowd has the same density in the open, at a wall and in a corner
   - people behind a wall, however thin, count only by the way round its end and through its doors

   Walls are solids, thin lines and closed gates. Without walls the kernel is the Gaussian alone; a
   map may ask for that, as in Curtis et al.'s study of the Mataf.

   With storeys, the floor goes on through the seams at which stairs meet storeys, as one plane
   would; the floor of one storey is apart from that of another, and the footprints of stairs are no
   floor of the storeys that they pass.

   A caller creates a density, sets the walls by jox_density_walls before each sample, samples
   crowds, and frees it. record/local_samples.h does this for most users. */
#ifndef JOX_RECORD_FIELDS_DENSITY_H
#define JOX_RECORD_FIELDS_DENSITY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/sections.h"
#include "base/vec.h"
#include "geom/storeys.h"
#include "geom/walls.h"
#include "simd/isa.h"

#define JOX_DENSITY_KERNEL                                                                         \
    0.70710678f /* m: standard deviation of the Gaussian exp(-(d/R)2), R = 1 m */
#define JOX_DENSITY_BY "(Gaussian, R = 1 m)" /* its description in titles */
#define JOX_DENSITY_CELL 0.2f                /* m: side of a cell */
enum { JOX_DENSITY_FIELDS = 3 };             /* most fields sampled at once */

typedef struct JoxDensityFloor JoxDensityFloor;   /* where walls let people through */
typedef struct JoxDensitySheets JoxDensitySheets; /* rows of several storeys */

/* Scratch of a sample, for one strip of rows at a time: rows first to end - 1. */
typedef struct JoxDensityWork {
    int first, end, fields;
    size_t room;                     /* cells allocated in `mass` */
    float *mass[JOX_DENSITY_FIELDS]; /* sums of weights at each node, before the kernel */
    /* Without walls: for each row of the grid, bits of the column groups that may be non-zero; and
       the last rows after the pass along x. */
    uint64_t *marks;
    float *lines[JOX_DENSITY_FIELDS];
    /* With walls: a number for each cell; bits of the cells that may be non-zero before and after a
       step; and the cells that a step computes. */
    float *spare;
    uint64_t *reached[2];
    struct JoxDensitySpan {     /* cells from..to - 1 of a row, computed in a step */
        int row, low, from, to; /* cells from `low` on may be computed, too */
        bool plain;             /* all ways to the four neighbours are fully open */
    } * spans;
    size_t span_count, span_capacity;
} JoxDensityWork;

typedef struct JoxDensity {
    JoxV2 low;
    float cell; /* m: side of a cell */
    uint32_t columns, rows;
    float *now;  /* 1/m2: values of the last sample, row by row from the lowest y */
    double *sum; /* 1/m2: sum over samples; NULL unless means are wanted */
    uint32_t frames;
    float most; /* 1/m2: greatest value of any sample */
    JoxV2 most_at;
    double most_time; /* s */

    /* The working grid has `edge` more cells on each side than the grid that is read, for people
       outside it. */
    JoIsa isa;    /* instruction set of the kernels; results do not depend on it */
    float kernel; /* m: standard deviation */
    int edge, wide, high;
    int stretch; /* a bit of `marks` stands for 2^stretch columns */
    JoxDensityWork work;
    JoxDensityFloor *floor;   /* NULL: no walls */
    JoxDensitySheets *sheets; /* NULL: one plane */
} JoxDensity;

/* People of a sample. */
typedef struct JoxDensityCrowd {
    uint32_t count;
    const float *x, *y; /* m */
    /* m: a person near a periodic edge is added beyond the opposite edge, too; 0: not periodic */
    JoxV2 period;
    const JoxStoreys *storeys;                /* for Voronoi cells; NULL: one plane */
    const uint8_t *seen;                      /* 1 for people who count; NULL: everybody counts */
    const float *weights[JOX_DENSITY_FIELDS]; /* weight of each person, by field; NULL: 1 */
} JoxDensityCrowd;

/* Creates a density of the area `low` to `high`, m. Cells are enlarged if there would be more than
   two million. */
JoxDensity *jox_density_create(JoxV2 low, JoxV2 high, float cell, float kernel);
/* Creates a density of the area `low` to `high`, m in plan, of all storeys and of the stairs
   between them. Its rows lie one sheet after the other, without the empty space between sheets.
   Without storeys it is that of jox_density_create. */
JoxDensity *jox_density_create_on_storeys(JoxV2 low, JoxV2 high, float cell, float kernel,
                                          const JoxStoreys *storeys);
/* Returns the length along y of the rows that such a density has, m. */
float jox_density_depth(const JoxStoreys *storeys, JoxV2 low, JoxV2 high);
/* Tells a density of an area of positions about storeys, before each jox_density_walls, so that
   people beyond the seams near the area count. Cheap after the first time; NULL for none. */
void jox_density_storeys(JoxDensity *density, const JoxStoreys *storeys);
/* Returns the storeys of a density of all storeys, NULL for one plane or an area of positions. */
const JoxStoreys *jox_density_storeys_of(const JoxDensity *density);
/* Sets the walls that stand at present; NULL for none. Cheap if they have not
   changed. */
void jox_density_walls(JoxDensity *density, const JoxWalls *walls);
/* Returns a hash of the walls; 0: none. */
uint64_t jox_density_walls_hash(const JoxDensity *density);
/* Samples a crowd. out[f] receives columns * rows values for each field: the sum of weights per
   m2. */
void jox_density_sample(JoxDensity *density, const JoxDensityCrowd *crowd, int fields,
                        float *const *out);
/* Keeps means over samples from now on, at eight bytes per cell. */
void jox_density_want_mean(JoxDensity *density);
/* Updates the greatest value and, if wanted and with `mean`, the mean from the sample in `now`,
   taken at t, s. */
void jox_density_update_statistics(JoxDensity *density, double t, bool mean);
/* Samples `count` people into `now` and updates as jox_density_update_statistics does. */
void jox_density_add(JoxDensity *density, JoxV2 period, const float *x, const float *y,
                     uint32_t count, double t);
/* Sets the cell whose value applies to a person at (x, y): the nearest one on the same side of
   walls. Returns false outside the area. */
bool jox_density_cell_of(const JoxDensity *density, float x, float y, size_t *cell);
/* Returns the position of the middle of a cell; y is NAN in the rows between two sheets. */
JoxV2 jox_density_middle(const JoxDensity *density, size_t cell);
/* Returns the walkable area of a cell, m2. */
float jox_density_area(const JoxDensity *density, size_t cell);
/* Returns the mean of a cell over samples, 1/m2; 0 before the first. */
double jox_density_mean(const JoxDensity *density, uint32_t column, uint32_t row);
/* Lists the values and maxima; a restored state must be of the same area. */
void jox_density_sections(JoxDensity *density, JoxSections *sections);
void jox_density_free(JoxDensity *density);

#endif
