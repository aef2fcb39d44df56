/* Voronoi cells of people: the part of the plane nearer to one person than to any other, within a
   polygon of 32 corners on a circle of radius `cutoff` (Steffen and Seyfried 2010, doi
   10.1016/j.physa.2009.12.015), and not behind a wall. The density at a point is one over the area
   of its cell.

   To get cells, clear the sites, add all people, sort them, then ask for the cell of each. Probe
   `measure` and voronoi_people.c do so. */
#ifndef JOX_RECORD_VORONOI_H
#define JOX_RECORD_VORONOI_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"
#include "geom/storeys.h"

enum { JOX_CELL_CORNERS = 32, JOX_MOST_CORNERS = 256 };

/* Convex cell; corners anti-clockwise, m, relative to the person. */
typedef struct JoxCell {
    double x[JOX_MOST_CORNERS], y[JOX_MOST_CORNERS];
    uint32_t count;
} JoxCell;

void jox_cell_begin(JoxCell *cell, double cutoff);
/* Removes the part nearer to a neighbour at (x, y), m, relative to the person; nothing for (0, 0).
   Returns whether anything was removed. */
bool jox_cell_cut(JoxCell *cell, double x, double y);
/* Returns the squared distance of the farthest corner, m2. */
double jox_cell_reach2(const JoxCell *cell);
double jox_cell_area(const JoxCell *cell); /* m2 */
/* Returns the area, m2, that the cell of a person at `at` shares with a polygon without crossing
   edges. */
double jox_cell_area_within(const JoxCell *cell, JoxV2 at, const JoxV2 *ring, uint32_t count);

/* Edges of walls, m. */
typedef struct JoxBars {
    struct JoxBar {
        JoxV2 from, to;
    } * items;
    uint32_t count, capacity;
} JoxBars;
/* Sets `whole` to the area, m2, of the part of a cell that the person at `at` sees past the
   walls, and `within` to the part of that area in the ring. */
void jox_cell_visible_area(const JoxCell *cell, JoxV2 at, const JoxBars *bars, const JoxV2 *ring,
                           uint32_t count, double *whole, double *within);

/* Sites in bins, for fast search of neighbours. Initialise to zero and keep for later frames;
   jox_sites_free frees it. */
typedef struct JoxSites {
    const JoxBars *bars;       /* sites behind these are no neighbours; NULL: no walls */
    const JoxStoreys *storeys; /* for images beyond seams; NULL: none */
    JoxV2 *points;
    uint32_t *person; /* number given by the caller */
    uint32_t *seam;   /* of images: 1 + the seam, from the person's side; 0: no image */
    uint32_t count, capacity, person_capacity, seam_capacity;
    JoxV2 low;
    double bin;        /* m: side of a bin */
    JoxCell lone_cell; /* cell of a person without neighbours */
    uint32_t columns, rows;
    /* index in `order` of the first site of each bin; one more at the end */
    uint32_t *first, first_capacity;
    uint32_t *order, order_capacity;
    /* Used if a bin has very many sites: the site repeats the point of another one. */
    bool *repeated;
    uint32_t *sort_scratch; /* scratch for sorting */
    uint32_t repeated_capacity, sort_scratch_capacity;
} JoxSites;

void jox_sites_clear(JoxSites *sites);
void jox_sites_add(JoxSites *sites, JoxV2 point, uint32_t person);
/* Adds the image of a person beyond a seam of `storeys` (seam_images.h). */
void jox_sites_add_image(JoxSites *sites, JoxV2 point, uint32_t person, uint32_t seam);
/* Puts the sites into bins. Call it after adding all sites, and before jox_sites_cell with the same
   cutoff, m. */
void jox_sites_sort(JoxSites *sites, double cutoff);
void jox_sites_cell(const JoxSites *sites, uint32_t site, double cutoff, JoxCell *out);
void jox_sites_free(JoxSites *sites);

#endif
