/* Positions of a group's agents at the start: lattices and random points in an area. */
#ifndef JOX_GEOM_START_POSITIONS_H
#define JOX_GEOM_START_POSITIONS_H

#include <stdbool.h>
#include <stdint.h>

#include "geom/area.h"

/* Arrangements of a group with their names in scenes. The first three fill an area; JOX_FILL_AT
   means listed points. */
#define JOX_FILLS(X)                                                                               \
    X(HEX, "hex")                                                                                  \
    X(GRID, "grid")                                                                                \
    X(RANDOM, "random")                                                                            \
    X(CIRCLE, "circle")                                                                            \
    X(LINE, "line")
typedef enum JoxFillMode {
#define X(fill, name) JOX_FILL_##fill,
    JOX_FILLS(X)
#undef X
        JOX_FILL_AT
} JoxFillMode;

/* Fills an area with `count` positions, at least `spacing` m apart. 0: a lattice as wide as `count`
   allows, or random points 0.4 m apart, less if they are many. `mode` is HEX, GRID or RANDOM. If a
   lattice has more points, `count` of them are drawn by (seed, stream). Random points are drawn one
   by one, each uniformly over the part of the area that the points before leave free. Returns the
   number that fit, `count` if all did; the caller frees `positions` (jox_free). */
uint32_t jox_fill(const JoxArea *area, JoxFillMode mode, uint32_t count, float spacing,
                  uint64_t seed, uint32_t stream, JoxV2 **positions);

#endif
