/* Entrances: the part of a place's floor on which people can come in, after walls have cut it.
   World uses them for sources. */
#ifndef JOX_GEOM_ENTRANCE_H
#define JOX_GEOM_ENTRANCE_H

#include "geom/area.h"
#include "geom/place.h"
#include "geom/wall_grid.h"

/* m: people enter at a line, or at a point with a smaller radius, up to this distance from it */
#define JOX_ENTRANCE_REACH 0.5f

/* If walls lie on the floor or near it, or part of the floor is outside the walkable area, the
   floor is divided into cells. Clear cells that are connected form a piece; people enter on the
   largest piece only, never beyond a wall. Of pieces of about equal size, the one inside more
   closed walls is taken, else, at a line, the one on its left. */
typedef enum JoxFloorCell {
    JOX_FLOOR_NONE,    /* not part of the floor */
    JOX_FLOOR_TIGHT,   /* too close to a wall to stand */
    JOX_FLOOR_SOLID,   /* inside a solid */
    JOX_FLOOR_OUTSIDE, /* outside every outline of the walkable area */
    JOX_FLOOR_BEYOND,  /* clear, but in another piece */
    JOX_FLOOR_OPEN     /* people enter here */
} JoxFloorCell;

typedef struct JoxEntrance {
    JoxPlace floor; /* the place's shape, but a circle of JOX_ENTRANCE_REACH for smaller points and
                       polygons, and the first segment for a queue */
    double area;    /* m2 of open cells; if nothing is cut, of the floor */
    double blocked; /* share of the original place that is solid, outside or beyond */
    double outside; /* share of it that is outside */
    bool cut;       /* some cells are solid, outside or beyond, or none is open; false: people enter
                       anywhere on the floor */
    JoxFloorCell *cells; /* row by row; NULL: not divided */
    JoxV2 low;           /* m: corner of the first cell */
    float cell;          /* m */
    uint32_t columns, rows;
    uint32_t *open; /* indices of open cells */
    uint32_t open_count;
    JoxArea clear; /* the floor without its tight and solid parts */
    JoxAreaIndex *index;
    const JoxWallGrid *grid;
} JoxEntrance;

/* Makes the entrance of a place that is no set. `grid` is the grid of the closed walls; its reach
   is extended as needed. Place and grid must not change until the entrance is freed. The entrance
   must not be moved in memory, as it points to itself. */
void jox_entrance_make(JoxEntrance *entrance, const JoxStoreys *storeys, JoxWallGrid *grid,
                       const JoxPlace *place);
void jox_entrance_free(JoxEntrance *entrance);
/* Returns whether a point lies on the floor, on the side of the walls where people enter. */
bool jox_entrance_holds(const JoxEntrance *entrance, JoxV2 point);
/* Returns whether people can enter at a point of the floor. */
bool jox_entrance_is_open(const JoxEntrance *entrance, JoxV2 point);
/* Returns the middle of an open cell; `share`, from 0 to below 1, selects it. There must be one. */
JoxV2 jox_entrance_pick(const JoxEntrance *entrance, double share);

#endif
