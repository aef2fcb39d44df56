/* Pseudo-random numbers and walls for the tests of record, the same in each run. */
#ifndef JOSTLE_TESTS_RECORD_DRAW_H
#define JOSTLE_TESTS_RECORD_DRAW_H

#include <stdint.h>

#include "geom/walls.h"

/* Returns a pseudo-random number in [0, 1), and advances the state. */
static inline float draw_uniform(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777216.0f;
}

/* Returns a pseudo-random number in [0, 1) from a counter. */
static inline double draw_from_counter(uint32_t n) {
    n = (n ^ 61u) ^ (n >> 16);
    n *= 9u;
    n ^= n >> 4;
    n *= 0x27d4eb2du;
    return (double)((n ^ (n >> 15)) >> 8) / 16777216.0;
}

/* Adds a straight thin wall, 3 m high. */
static inline void add_wall_line(JoxWalls *walls, float x0, float y0, float x1, float y1) {
    const JoxV2 ends[] = {{x0, y0}, {x1, y1}};
    jox_walls_add_polyline(walls, ends, 2, false, 3);
}

#endif
