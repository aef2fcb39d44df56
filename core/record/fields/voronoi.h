/* Voronoi cells of people: the part of the plane that is nearer to one of them than to all others,
   within a polygon of 32 corners on a circle of radius `cutoff` (Steffen and Seyfried 2010,
   doi 10.1016/j.physa.2009.12.015), and not behind a wall. The density at a point is one over the
   area of its cell. */
#ifndef JOX_RECORD_VORONOI_H
#define JOX_RECORD_VORONOI_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

enum { JOX_CELL_CORNERS = 32, JOX_MOST_CORNERS = 256 };

/* Corners anti-clockwise, m, relative to the person. */
typedef struct JoxCell {
    double x[JOX_MOST_CORNERS], y[JOX_MOST_CORNERS];
    uint32_t count;
} JoxCell;

void jox_cell_begin(JoxCell *cell, double cutoff);
/* Takes away what is nearer to a neighbour at (x, y), relative to the person; none at (0, 0).
   Returns whether there was any. */
bool jox_cell_cut(JoxCell *cell, double x, double y);
/* Square of the distance of the farthest corner, m2. */
double jox_cell_reach2(const JoxCell *cell);
double jox_cell_area(const JoxCell *cell); /* m2 */
/* Area that the cell of the person at `at` shares with a polygon without crossing edges, m2. */
double jox_cell_area_within(const JoxCell *cell, JoxV2 at, const JoxV2 *ring, uint32_t count);

/* Stretches of walls, m. */
typedef struct JoxBars {
    struct JoxBar {
        JoxV2 from, to;
    } * items;
    uint32_t count, capacity;
} JoxBars;
/* The part of a cell that the person at `at` sees: its area, and what of it lies in the ring. */
void jox_cell_seen(const JoxCell *cell, JoxV2 at, const JoxBars *bars, const JoxV2 *ring,
                   uint32_t count, double *whole, double *within);

/* Points in bins, so that neighbours are found; zero-initialise, keep for the next frame. */
typedef struct JoxSites {
    const JoxBars *bars; /* who stands behind them is no neighbour; NULL: none */
    JoxV2 *points;
    uint32_t *who; /* the caller's number of each */
    uint32_t count, capacity, who_capacity;
    JoxV2 low;
    double bin;    /* m */
    JoxCell whole; /* of somebody alone */
    uint32_t columns, rows;
    uint32_t *first, first_capacity; /* of each bin in `order`; one more at the end */
    uint32_t *order, order_capacity;
    bool *again;     /* of each site, where a bin holds very many: the place of one before it */
    uint32_t *spare; /* for sorting */
    uint32_t again_capacity, spare_capacity;
} JoxSites;

void jox_sites_clear(JoxSites *sites);
void jox_sites_add(JoxSites *sites, JoxV2 point, uint32_t who);
/* After all were added; cells of this cutoff can then be made. */
void jox_sites_sort(JoxSites *sites, double cutoff);
void jox_sites_cell(const JoxSites *sites, uint32_t site, double cutoff, JoxCell *out);
void jox_sites_free(JoxSites *sites);

#endif
