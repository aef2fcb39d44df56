/* Entrances: the floor of a place on which people can come in, which walls may take from it. */
#ifndef JOX_GEOM_ENTRANCE_H
#define JOX_GEOM_ENTRANCE_H

#include "geom/area.h"
#include "geom/place.h"
#include "geom/wall_grid.h"

/* m: people who come in at a line, or at a point of a smaller radius, stand up to here beside it */
#define JOX_ENTRANCE_REACH 0.5f

/* Where walls lie in the floor or beside it, or all of it outside the walkable area, it is divided
   into cells. Those that are clear and joined to each other within the floor are a piece of it;
   people come in on the greatest piece alone, so that nobody comes in beyond a wall. Of pieces of
   about one size it is the one within more closed walls, else, at a line, the one on its left. */
typedef enum JoxFloorCell {
    JOX_FLOOR_NONE,    /* no part of the floor */
    JOX_FLOOR_TIGHT,   /* so near to a wall that nobody stands there */
    JOX_FLOOR_SOLID,   /* in a solid */
    JOX_FLOOR_OUTSIDE, /* outside every outline of the walkable area */
    JOX_FLOOR_BEYOND,  /* clear, in another piece */
    JOX_FLOOR_OPEN     /* people come in here */
} JoxFloorCell;

typedef struct JoxEntrance {
    JoxPlace floor; /* as the place, but for a point of less than the reach and a small polygon,
                       which are a circle of the reach, and a queue, which is its first line */
    double area;    /* m2, of open cells; where nothing is cut, of the floor */
    double blocked; /* share of the place as it was given that is solid, outside or beyond */
    double outside; /* share of it that is outside */
    bool cut;       /* some cells are solid, outside or beyond, or none is open; else people come in
                       anywhere */
    JoxFloorCell *cells; /* row by row; NULL: it is not divided */
    JoxV2 low;           /* m: the corner of the first */
    float cell;          /* m */
    uint32_t columns, rows;
    uint32_t *open; /* indices of open cells */
    uint32_t open_count;
    JoxArea clear; /* the floor without its tight, solid part */
    JoxAreaIndex *index;
    const JoxWallGrid *grid;
} JoxEntrance;

/* The entrance of a place that is no set. `grid` is one of the walls that stand; it is made wide
   enough, and both stay as they are until the entrance is freed. The entrance stays where it is, as
   it points to itself. */
void jox_entrance_make(JoxEntrance *entrance, JoxWallGrid *grid, const JoxPlace *place);
void jox_entrance_free(JoxEntrance *entrance);
/* Whether a point lies in the floor, on the side of the walls on which people come in. */
bool jox_entrance_holds(const JoxEntrance *entrance, JoxV2 point);
/* Whether somebody can come in at a point of the floor. */
bool jox_entrance_is_open(const JoxEntrance *entrance, JoxV2 point);
/* Middle of one of the open cells, of which there are some; `share` from 0 to below 1 says which.
 */
JoxV2 jox_entrance_pick(const JoxEntrance *entrance, double share);

#endif
