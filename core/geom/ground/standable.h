/* Cells of an area and its surroundings in which people can stand, the parts into which walls and
   fixed bodies divide them, and ways over them. Behaviours gather people there
   (machine/steering/gather.c).
 */
#ifndef JOX_GEOM_STANDABLE_H
#define JOX_GEOM_STANDABLE_H

#include "geom/objects.h"
#include "geom/place.h"
#include "geom/walls.h"

#define JOX_NO_CELL UINT32_MAX

/* Scratch of a search: a cell that it reached. */
typedef struct JoxStandableNode {
    uint32_t search, before; /* number of the search; cell before it on the way */
    float length;            /* cells, from the start */
} JoxStandableNode;

/* A cell that a search has to look at, ordered by the least length of a way through it. */
typedef struct JoxStandableOpen {
    float least; /* cells */
    uint32_t cell;
} JoxStandableOpen;

/* A way that was found: it depends on the cells alone. */
typedef struct JoxStandableWay {
    uint32_t from, to, next;
    float length; /* m */
} JoxStandableWay;

typedef struct JoxStandable {
    JoxV2 low;  /* m: corner of the first cell */
    float cell; /* m */
    uint32_t columns, rows;
    /* By cell, from 1: cells joined within the place are a part, and so are those about it whose
       way leads to them first. 0: nobody stands here, or gets to the place from here. */
    uint32_t *part;
    uint32_t part_count;
    JoxV2 *edges; /* walls and fixed bodies in reach: two points each */
    uint32_t edge_count;
    size_t part_capacity, edge_capacity;
    /* Scratch. */
    JoxStandableNode *nodes;
    JoxStandableOpen *open;
    JoxStandableWay *ways;
    uint32_t searches;
    size_t node_capacity, open_capacity;
} JoxStandable;

/* Divides a polygon and what lies up to `about` m about it into cells of 0.28 m, or wider where
   there would be over 262,144. Walls that are open and bodies that can be moved do not count.
   `images`: of walls, beyond joined edges; it, walls and objects may be NULL. */
void jox_standable_lay(JoxStandable *standable, const JoxPlace *place, float about,
                       const JoxWalls *walls, const JoxWalls *images, const JoxObjects *objects);
void jox_standable_free(JoxStandable *standable);
/* Whether a body is fixed and stands where people walk. */
bool jox_standable_is_fixed(const JoxObject *object);
/* The free cell about a point, on the same side of all walls, or JOX_NO_CELL. */
uint32_t jox_standable_cell(const JoxStandable *standable, JoxV2 point);
/* The part of a cell; 0 of JOX_NO_CELL. */
uint32_t jox_standable_part(const JoxStandable *standable, uint32_t cell);
/* Length in m of the way from a point to another, about 8 % too long at most where it is not
   straight; INFINITY: none. `next`: the farthest point of it that can be gone to straight. */
float jox_standable_way(JoxStandable *standable, JoxV2 from, JoxV2 to, JoxV2 *next);

#endif
