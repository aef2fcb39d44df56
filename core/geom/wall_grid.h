/* A grid over the edges of walls, which tells the edges near a point. */
#ifndef JOX_GEOM_WALL_GRID_H
#define JOX_GEOM_WALL_GRID_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "geom/walls.h"
#include "simd/isa.h"

/* Edges of walls by cell: each cell lists all edges within `reach` of any of its points. */
typedef struct JoxWallGrid {
    const JoxWalls *walls;
    float reach, cell; /* m */
    JoxV2 low;
    uint32_t columns, rows;
    uint32_t *first; /* columns * rows + 1 */
    uint32_t *edges;
} JoxWallGrid;

/* Makes the grid serve queries up to `reach` metres; does nothing if it already does. */
void jox_wall_grid_fit(JoxWallGrid *grid, float reach);
/* Makes it anew for queries up to exactly `reach` metres; empty for 0. */
void jox_wall_grid_reset(JoxWallGrid *grid, float reach);
/* Edges that may be within the grid's reach of a point. */
static inline const uint32_t *jox_wall_grid_at(const JoxWallGrid *g, JoxV2 point, uint32_t *count) {
    *count = 0;
    if (!g->first)
        return NULL;
    float x = (point.x - g->low.x) / g->cell, y = (point.y - g->low.y) / g->cell;
    if (!(x >= 0.0f && y >= 0.0f && x < (float)g->columns && y < (float)g->rows))
        return NULL;
    size_t c = (size_t)(uint32_t)y * g->columns + (uint32_t)x;
    *count = g->first[c + 1] - g->first[c];
    return g->edges + g->first[c];
}
/* Whether an edge that is within the grid's reach of `from` separates it from `to`: no one touches
   another through a wall. Ends that lie on an edge are separated from those beyond it. */
bool jox_wall_grid_separates(const JoxWallGrid *grid, JoxV2 from, JoxV2 to);
/* m2: whoever is nearer to a point than the root of this is not separated from it, being on the
   same side of the lines of all edges within the grid's reach; INFINITY where there are none. */
float jox_wall_grid_clear2(const JoxWallGrid *grid, JoxV2 from);
/* Whether all edges are farther from somebody than `reach` m, which the grid serves; clear2: of
   where they are, or NULL, where it is not known. */
static inline bool jox_wall_grid_is_clear(const float *clear2, uint32_t of, float reach) {
    return clear2 && reach * reach < clear2[of];
}
/* The kernel: jox_wall_grid_clear2 of many points, to the bit. It reads and writes whole packets of
   lanes. */
typedef void JoxWallClearKernel(const JoxWallGrid *grid, const float *x, const float *y,
                                uint32_t count, float *clear2);
#define X(name, isa) JoxWallClearKernel jox_wall_clear_##name;
JOX_ISAS(X)
#undef X
/* Whether the ways p -> q and a -> b cross; where one ends on the other is on its right. */
bool jox_segments_cross(JoxV2 p, JoxV2 q, JoxV2 a, JoxV2 b);
void jox_wall_grid_free(JoxWallGrid *grid);
/* Whether an edge lies nearer to a point than `clear` m; the grid reaches as far. */
bool jox_wall_grid_is_near(const JoxWallGrid *grid, JoxV2 point, float clear);
/* Point inside a ring (crossing number). */
bool jox_walls_ring_holds(const JoxWalls *walls, uint32_t ring, JoxV2 point);
/* Point inside a solid. */
bool jox_walls_contain(const JoxWalls *walls, JoxV2 point);

#endif
