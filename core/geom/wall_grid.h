/* A grid over the edges of walls, for finding the edges near a point. body, force, machine, nav and
   record use it. */
#ifndef JOX_GEOM_WALL_GRID_H
#define JOX_GEOM_WALL_GRID_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "geom/walls.h"
#include "simd/isa.h"

/* An edge that a cell lists: no point of the cell is nearer to it than `away`, rounding included.
   The ends come last, so that one load fetches both. m. */
typedef struct JoxNearEdge {
    float away;
    uint32_t edge;
    JoxV2 start, end;
} JoxNearEdge;

/* Edges of walls by cell: each cell lists all edges within `reach` of any of its points. The grid
   does not own `walls`; callers set that member and keep the walls unchanged. */
typedef struct JoxWallGrid {
    const JoxWalls *walls;
    float reach, cell; /* m */
    JoxV2 low;
    uint32_t columns, rows;
    uint32_t *first;      /* columns * rows + 1 indices into edges */
    uint32_t *edges;      /* edges of each cell, in ascending order */
    JoxNearEdge *nearest; /* the same, nearest to the cell first */
} JoxWallGrid;

/* Extends the reach to at least `reach` m; does nothing if it is long enough already. */
void jox_wall_grid_fit(JoxWallGrid *grid, float reach);
/* Rebuilds the grid with exactly this reach, m; empty for 0. */
void jox_wall_grid_reset(JoxWallGrid *grid, float reach);
/* Returns the index in `edges` of the first edge of a point's cell, and how many it has. */
static inline uint32_t jox_wall_grid_find(const JoxWallGrid *g, JoxV2 point, uint32_t *count) {
    *count = 0;
    if (!g->first)
        return 0;
    float x = (point.x - g->low.x) / g->cell, y = (point.y - g->low.y) / g->cell;
    if (!(x >= 0.0f && y >= 0.0f && x < (float)g->columns && y < (float)g->rows))
        return 0;
    size_t c = (size_t)(uint32_t)y * g->columns + (uint32_t)x;
    *count = g->first[c + 1] - g->first[c];
    return g->first[c];
}
/* Returns the edges of a point's cell, which include all edges within reach of the point. */
static inline const uint32_t *jox_wall_grid_at(const JoxWallGrid *g, JoxV2 point, uint32_t *count) {
    const uint32_t first = jox_wall_grid_find(g, point, count);
    return *count ? g->edges + first : NULL;
}
/* Returns the same edges, nearest to the cell first: callers stop at the first that is too far
   away. */
static inline const JoxNearEdge *jox_wall_grid_nearest(const JoxWallGrid *g, JoxV2 point,
                                                       uint32_t *count) {
    const uint32_t first = jox_wall_grid_find(g, point, count);
    return *count ? g->nearest + first : NULL;
}
/* Returns whether an edge within the grid's reach of `from` separates it from `to`: agents do not
   touch through walls. Points on an edge are separated from points beyond it. */
bool jox_wall_grid_has_wall_between(const JoxWallGrid *grid, JoxV2 from, JoxV2 to);
/* Returns the square, m2, of the distance from `from` to the nearest edge within the grid's reach,
   less what covers rounding: within it no wall hides anything. INFINITY without such edges. */
float jox_wall_grid_unhidden_distance2(const JoxWallGrid *grid, JoxV2 from);
/* Returns whether all edges are farther than `reach` m from agent `of`. `unhidden2`:
   jox_wall_grid_unhidden_distance2 by agent; NULL: unknown. The grid's reach must be at least
   `reach`. */
static inline bool jox_wall_grid_is_clear(const float *unhidden2, uint32_t of, float reach) {
    return unhidden2 && reach * reach < unhidden2[of];
}
/* Kernel: jox_wall_grid_unhidden_distance2 of many points, with the same bits. Reads and writes
   whole packets. */
typedef void JoxWallUnhiddenKernel(const JoxWallGrid *grid, const float *x, const float *y,
                                   uint32_t count, float *unhidden2);
#define X(name, isa) JoxWallUnhiddenKernel jox_wall_unhidden_##name;
JOX_ISAS(X)
#undef X
/* Returns whether the segments p -> q and a -> b cross; an end on the other segment counts as on
   its right. */
bool jox_segments_cross(JoxV2 p, JoxV2 q, JoxV2 a, JoxV2 b);
void jox_wall_grid_free(JoxWallGrid *grid);
/* Returns whether an edge is nearer to a point than `clear` m, which is within the grid's reach. */
bool jox_wall_grid_is_near(const JoxWallGrid *grid, JoxV2 point, float clear);
/* Returns whether a point is inside a ring (crossing number). */
bool jox_walls_ring_holds(const JoxWalls *walls, uint32_t ring, JoxV2 point);
/* Returns whether a point is inside a solid. */
bool jox_walls_contain(const JoxWalls *walls, JoxV2 point);

#endif
