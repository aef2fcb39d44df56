/* Lookups in the grid of walls by lanes, for kernels (*_wide.c) to include. */
#ifndef JOX_GEOM_WALL_GRID_LANES_H
#define JOX_GEOM_WALL_GRID_LANES_H

#include "geom/wall_grid.h"
#include "simd/lanes.h"

/* Returns the lanes whose point, m, has edges within the grid's reach, in the sense of
   jox_wall_grid_at. */
static inline JoxMask jox_wall_grid_near_lanes(const JoxWallGrid *g, JoxFloats px, JoxFloats py) {
    const JoxFloats zero = jf_set(0.0f), cell = jf_set(g->cell);
    if (!g->first)
        return jm_of_bits(0);
    const JoxFloats columns = jf_set((float)g->columns), rows = jf_set((float)g->rows);
    JoxFloats x = (px - g->low.x) / cell;
    JoxFloats y = (py - g->low.y) / cell;
    JoxMask within =
        jm_and(jm_and(jf_le(zero, x), jf_lt(x, columns)), jm_and(jf_le(zero, y), jf_lt(y, rows)));
    if (!jm_bits(within))
        return within;
    /* exact: there are fewer cells than integers that a float can represent */
    JoxFloats row = ji_to_floats(jf_to_ints(y)) * columns;
    JoxInts at = jf_to_ints(row + ji_to_floats(jf_to_ints(x)));
    at = ji_select(within, at, ji_set(0));
    JoxInts begin = ji_pick(g->first, at), end = ji_pick(g->first + 1, at);
    return jm_and(within, ji_less(begin, end));
}

/* Does jox_wall_grid_is_clear for a packet of agents from `first` on, with a reach, m, for each. */
static inline JoxMask jox_wall_grid_clear_lanes(const float *unhidden2, uint32_t first,
                                                JoxFloats reach) {
    return unhidden2 ? jf_lt(reach * reach, jf_load(unhidden2 + first)) : jm_of_bits(0);
}

/* Returns a distance, m, of each lane within which no edge is: from its unhidden2, less `way`, m,
   that it has moved since. The grid knows of no edge beyond its reach. */
static inline JoxFloats jox_wall_grid_unhidden_lanes(const JoxWallGrid *g, JoxFloats unhidden2,
                                                     JoxFloats way) {
    return jf_min(jf_sqrt(unhidden2), jf_set(0.999f * g->reach)) - way;
}

/* Returns the lanes in which edges may cross a segment of squared length d2, m2: not those where
   the unhidden distances of its ends add up to more. */
static inline JoxMask jox_wall_grid_may_cross_lanes(JoxFloats d2, JoxFloats from, JoxFloats to) {
    const JoxFloats sum = 0.9999f * (from + to);
    return jm_or(jf_lt(sum, jf_set(0.0f)), jf_le(sum * sum, d2));
}

#endif
