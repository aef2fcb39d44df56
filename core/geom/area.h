/* Areas of floor: the union of some places, minus other places, at a distance from walls. Used to
   place agents and to measure floors. */
#ifndef JOX_GEOM_AREA_H
#define JOX_GEOM_AREA_H

#include <stdbool.h>
#include <stdint.h>

#include "geom/place.h"
#include "geom/storeys.h"
#include "geom/walls.h"

/* An area: inside any place of `in`, outside all places of `out` (indices), at least `clear` m from
   walls, where there is floor. Random points also keep their spacing from the points `taken` and,
   if edges of the area are joined with period `period`, from each other across the edges. */
typedef struct JoxArea {
    const JoxPlace *places;
    const uint32_t *in, *out;
    uint32_t in_count, out_count;
    const JoxWalls *walls;
    const JoxStoreys *storeys; /* NULL: there is floor everywhere */
    float clear;
    JoxV2 period; /* m; 0 along an axis: not joined */
    const JoxV2 *taken;
    uint32_t taken_count;
} JoxArea;

/* An area with the edges of its walls and polygons sorted by y, so that a point is tested only
   against edges at its height. Places and walls must not change while the index exists. */
typedef struct JoxAreaIndex JoxAreaIndex;

JoxAreaIndex *jox_area_index(const JoxArea *area);
bool jox_area_contains(const JoxAreaIndex *index, JoxV2 point);
void jox_area_index_free(JoxAreaIndex *index);

/* Finds the corners of the area's bounding box; false if the area is empty. */
bool jox_area_extent(const JoxArea *area, JoxV2 *low, JoxV2 *high);
/* Returns the distance of the sample points by which an area with these corners is measured, m. */
double jox_area_sampling(JoxV2 low, JoxV2 high);
/* Returns the size of the area, m2, from samples 0.1 m apart or coarser (at most a million). */
double jox_area_size(const JoxArea *area);
/* Returns the size up to the walls, m2, regardless of `clear`: all that is not inside a solid. A
   square of 10 x 10 m has 500 samples a side. */
double jox_area_floor(const JoxArea *area);

#endif
