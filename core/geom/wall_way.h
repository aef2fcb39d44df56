/* Ways that walls stop. */
#ifndef JOX_GEOM_WALL_WAY_H
#define JOX_GEOM_WALL_WAY_H

#include "geom/wall_grid.h"

/* Where a disc of `radius` m ends up that goes straight from one point to another: it slides along
   walls that it would pass, and keeps clear of them; nobody passes a wall. */
JoxV2 jox_way_by_walls(const JoxWallGrid *grid, JoxV2 from, JoxV2 to, float radius);

#endif
