/* Where the agents of a group stand at the start. */
#ifndef JOX_GEOM_FILL_H
#define JOX_GEOM_FILL_H

#include <stdbool.h>
#include <stdint.h>

#include "geom/area.h"

/* How the agents of a group stand at the start, with the words of scenes; JOX_FILL_AT: at given
   points. The first three spread over an area. */
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

/* Writes `count` positions at least `spacing` metres apart (0: lattices as wide as the count
   allows, from the area; points at random 0.4 m, or less where they are many). `mode` is hex, grid
   or random. Of a lattice with more points, `count` are drawn by (seed, stream). Random points are
   drawn one after the other, each uniformly over what of the area is left by those before. Returns
   the number that fit, `count` if all did; the array is allocated by jox_alloc. */
uint32_t jox_fill(const JoxArea *area, JoxFillMode mode, uint32_t count, float spacing,
                  uint64_t seed, uint32_t stream, JoxV2 **positions);

#endif
