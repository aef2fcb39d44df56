/* Moves and lines of sight that walls stop. nav moves agents by it; world and places test what lies
   between two points. */
#ifndef JOX_GEOM_WALL_WAY_H
#define JOX_GEOM_WALL_WAY_H

#include "geom/wall_grid.h"

/* Returns where a disc of `radius` m ends up that moves straight from one point to another: it
   slides along walls that it would cross, keeps clear of them, and never passes one. */
JoxV2 jox_way_by_walls(const JoxWallGrid *grid, JoxV2 from, JoxV2 to, float radius);

/* Returns whether a wall separates two points: an edge, ends included, crosses the segment p-q, but
   not if p or q lies on it, nor if its ring is `passable` (by ring; NULL: none). Exact, without
   rounding. */
bool jox_walls_lie_between(const JoxWalls *walls, JoxV2 p, JoxV2 q, const bool *passable);
/* Does the same for a single edge, a-b. */
bool jox_edge_lies_between(JoxV2 a, JoxV2 b, JoxV2 p, JoxV2 q);

#endif
