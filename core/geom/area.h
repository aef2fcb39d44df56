/* Areas: what lies in some places, outside of others and clear of walls. */
#ifndef JOX_GEOM_AREA_H
#define JOX_GEOM_AREA_H

#include <stdbool.h>
#include <stdint.h>

#include "geom/place.h"
#include "geom/walls.h"

/* An area: inside any of `in`, outside all of `out` (indices of places), `clear` m from walls.
   Points at random keep away from those `taken`, and where ends of the area are joined, after
   `period` m, from each other across them. */
typedef struct JoxArea {
    const JoxPlace *places;
    const uint32_t *in, *out;
    uint32_t in_count, out_count;
    const JoxWalls *walls;
    float clear;
    JoxV2 period; /* 0: not joined */
    const JoxV2 *taken;
    uint32_t taken_count;
} JoxArea;

/* An area and the edges of its walls and polygons, sorted so that a point is tested against those
   at its height alone. Places and walls must stay as they are. */
typedef struct JoxAreaIndex JoxAreaIndex;

JoxAreaIndex *jox_area_index(const JoxArea *area);
bool jox_area_contains(const JoxAreaIndex *index, JoxV2 point);
void jox_area_index_free(JoxAreaIndex *index);

/* Corners of a box about the area; false where the area is empty. */
bool jox_area_extent(const JoxArea *area, JoxV2 *low, JoxV2 *high);
/* m between the points by which an area with such corners is measured. */
double jox_area_sampling(JoxV2 low, JoxV2 high);
/* Square metres, by sampling a lattice of 0.1 m or coarser (at most a million samples). */
double jox_area_size(const JoxArea *area);
/* Square metres up to the walls, whatever `clear` is: what is not in a solid. By samples, of which
   a square of 10 x 10 m has 500 a side. */
double jox_area_floor(const JoxArea *area);

#endif
