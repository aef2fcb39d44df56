/* Ways that walls stop. */
#ifndef JOX_GEOM_WALL_WAY_H
#define JOX_GEOM_WALL_WAY_H

#include "geom/wall_grid.h"

/* Where a disc of `radius` m ends up that goes straight from one point to another: it slides along
   walls that it would pass, and keeps clear of them; nobody passes a wall. */
JoxV2 jox_way_by_walls(const JoxWallGrid *grid, JoxV2 from, JoxV2 to, float radius);

/* Whether a wall lies between two points: an edge, ends included, that separates them. One on which
   p or q lies is none, nor are those of rings that are `passable` (by ring; NULL: none is). Judged
   without rounding. */
bool jox_walls_lie_between(const JoxWalls *walls, JoxV2 p, JoxV2 q, const bool *passable);
/* The same of one edge, a-b. */
bool jox_edge_lies_between(JoxV2 a, JoxV2 b, JoxV2 p, JoxV2 q);

#endif
