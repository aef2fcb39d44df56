/* People per square metre on a grid: the one density of maps, tables, summaries and levels of
   service. Each person is spread by the Gaussian exp(-d2 / R2) / (pi R2), R = 1 m, of Helbing,
   Johansson and Al-Abideen (Phys. Rev. E 75, 046109, 2007), as heat would spread over the floor
   that can be walked on: walls let nothing through and give back what comes to them. So
   - far from walls it is that Gaussian;
   - the integral over the floor is the number of people, wherever they stand;
   - people who stand evenly read the same density in the open, at a wall and in a corner;
   - those behind a wall, however thin, do not count, but round its end and through its doors.
   Walls are solids, thin lines and closed gates. Without walls (through which a kernel passes, as
   in Curtis et al.'s study of the Mataf) it is the Gaussian alone. */
#ifndef JOX_RECORD_FIELDS_DENSITY_H
#define JOX_RECORD_FIELDS_DENSITY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/sections.h"
#include "base/vec.h"
#include "geom/walls.h"
#include "simd/isa.h"

#define JOX_DENSITY_KERNEL 0.70710678f       /* m: R / sqrt 2, the Gaussian's standard deviation */
#define JOX_DENSITY_BY "(Gaussian, R = 1 m)" /* how people are told of it */
#define JOX_DENSITY_CELL 0.2f                /* m */
enum { JOX_DENSITY_FIELDS = 3 };             /* that can be spread at once */

typedef struct JoxDensityFloor JoxDensityFloor; /* where the walls let people through */

/* What a sample works with, of a strip of rows at a time. */
typedef struct JoxDensityWork {
    int first, end, fields;
    size_t room;                     /* cells of `mass` */
    float *mass[JOX_DENSITY_FIELDS]; /* of who was put there */
    /* Without walls: for each row of all, as bits, which stretches of columns may hold something;
       the last rows, spread along x. */
    uint64_t *marks;
    float *lines[JOX_DENSITY_FIELDS];
    /* With walls: a number of each cell; as bits, which cells may hold something before a step and
       after it; and the cells that are stepped. */
    float *spare;
    uint64_t *reached[2];
    struct JoxDensitySpan {     /* cells of a row that are stepped: from..to - 1 */
        int row, low, from, to; /* those from `low` on may be stepped with them */
        bool plain;             /* open on all sides */
    } * spans;
    size_t span_count, span_capacity;
} JoxDensityWork;

typedef struct JoxDensity {
    JoxV2 low;
    float cell; /* m */
    uint32_t columns, rows;
    float *now;  /* of the last frame, 1/m2, row by row from the lowest y */
    double *sum; /* over frames; NULL where means are not wanted */
    uint32_t frames;
    float most; /* greatest value of any frame */
    JoxV2 most_at;
    double most_time; /* s */

    /* The cells that are read and `edge` more at every side, for who stands outside. */
    JoIsa isa;    /* of the kernels; results do not depend on it */
    float kernel; /* m: the standard deviation */
    int edge, wide, high;
    int stretch; /* the columns of a mark are two to the power of this */
    JoxDensityWork work;
    JoxDensityFloor *floor; /* NULL: no walls */
} JoxDensity;

/* The people of a sample. */
typedef struct JoxDensityCrowd {
    uint32_t count;
    const float *x, *y;  /* m */
    JoxV2 period;        /* m: who stands beyond a periodic edge is put there too; 0: none */
    const uint8_t *seen; /* 1 for who is put; NULL: everyone */
    const float *weights[JOX_DENSITY_FIELDS]; /* of each, by field; NULL: 1 */
} JoxDensityCrowd;

/* Cells are widened where the area would take more than two million. */
JoxDensity *jox_density_create(JoxV2 low, JoxV2 high, float cell, float kernel);
/* The walls as they stand now; NULL for none. Cheap where nothing has changed. */
void jox_density_walls(JoxDensity *density, const JoxWalls *walls);
/* Another number where these are others; 0: none. */
uint64_t jox_density_walls_hash(const JoxDensity *density);
/* A sample. `out`: columns times rows values for each of the fields, the sums of weights per m2. */
void jox_density_sample(JoxDensity *density, const JoxDensityCrowd *crowd, int fields,
                        float *const *out);
/* From here on means over frames are kept, which takes eight bytes a cell. */
void jox_density_want_mean(JoxDensity *density);
/* Notes `now` as of time t, s, for the greatest value and, where it is wanted, the mean. */
void jox_density_note(JoxDensity *density, double t, bool mean);
/* A frame of `count` people: a sample into `now`, noted. */
void jox_density_add(JoxDensity *density, JoxV2 period, const float *x, const float *y,
                     uint32_t count, double t);
/* The cell whose value holds for somebody at (x, y): the nearest on the same side of the walls.
   False outside the area. */
bool jox_density_cell_of(const JoxDensity *density, float x, float y, size_t *cell);
JoxV2 jox_density_middle(const JoxDensity *density, size_t cell);
/* Square metres of a cell that can be walked on. */
float jox_density_area(const JoxDensity *density, size_t cell);
/* Mean of all frames at a cell; 0 before the first. */
double jox_density_mean(const JoxDensity *density, uint32_t column, uint32_t row);
/* What was noted so far, of one over the same area. */
void jox_density_sections(JoxDensity *density, JoxSections *sections);
void jox_density_free(JoxDensity *density);

#endif
