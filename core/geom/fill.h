/* Where the agents of a group stand at the start. */
#ifndef JOX_GEOM_FILL_H
#define JOX_GEOM_FILL_H

#include <stdbool.h>
#include <stdint.h>

#include "geom/place.h"
#include "geom/walls.h"

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

/* An area: inside any of `in`, outside all of `out` (indices of places), `clear` m from walls. */
typedef struct JoxArea {
    const JoxPlace *places;
    const uint32_t *in, *out;
    uint32_t in_count, out_count;
    const JoxWalls *walls;
    float clear;
} JoxArea;

/* Writes `count` positions at least `spacing` metres apart (0: as wide as the count allows, from
   the area). `mode` is hex, grid or random. Random is a hexagonal lattice, shaken by up to an
   eighth of its spacing, of which `count` points are drawn by (seed, stream). Returns the number
   that fit, `count` if all did; the array is allocated by jox_alloc. */
uint32_t jox_fill(const JoxArea *area, JoxFillMode mode, uint32_t count, float spacing,
                  uint64_t seed, uint32_t stream, JoxV2 **positions);
/* Square metres, by sampling a lattice of 0.1 m or coarser (at most a million samples). */
double jox_area_size(const JoxArea *area);

#endif
