/* Cells in and around an area on which people can stand, the parts into which walls and fixed
   bodies divide them, and ways over them. machine/gather_ground.c keeps them for agents that
   gather. */
#ifndef JOX_GEOM_STANDABLE_H
#define JOX_GEOM_STANDABLE_H

#include "geom/objects.h"
#include "geom/place.h"
#include "geom/walls.h"

#define JOX_NO_CELL UINT32_MAX

/* Scratch of a search: a cell that it reached. */
typedef struct JoxStandableNode {
    uint32_t search, before; /* number of the search; previous cell on the way */
    float length;            /* cells, from the start */
} JoxStandableNode;

/* A cell that a search has to visit, ordered by the least length of a way through it. */
typedef struct JoxStandableOpen {
    float least; /* cells */
    uint32_t cell;
} JoxStandableOpen;

/* A cached way; it depends on the cells alone. */
typedef struct JoxStandableWay {
    uint32_t from, to, next;
    float length; /* m */
} JoxStandableWay;

typedef struct JoxStandable {
    JoxV2 low;  /* m: corner of the first cell */
    float cell; /* m */
    uint32_t columns, rows;
    /* By cell, from 1: cells connected inside the place form a part, with the cells around it that
       reach this part first. 0: blocked, or without a way to the place. */
    uint32_t *part;
    uint32_t part_count;
    JoxV2 *edges; /* walls and fixed bodies within reach: two points each */
    uint32_t edge_count;
    size_t part_capacity, edge_capacity;
    /* Scratch of searches. */
    JoxStandableNode *nodes;
    JoxStandableOpen *open;
    JoxStandableWay *ways;
    uint32_t searches;
    size_t node_capacity, open_capacity;
} JoxStandable;

/* Divides a polygon and its surroundings up to `about` m into cells of 0.28 m, or wider cells if
   there would be more than `most_cells`. Open gates and movable bodies are ignored. `images`: of
   walls beyond joined edges. `walls`, `images` and `objects` may be NULL. */
void jox_standable_lay(JoxStandable *standable, const JoxPlace *place, float about,
                       float most_cells, const JoxWalls *walls, const JoxWalls *images,
                       const JoxObjects *objects);
void jox_standable_free(JoxStandable *standable);
/* Returns whether a body is fixed and within reach of people. */
bool jox_standable_is_fixed(const JoxObject *object);
/* Returns the free cell at a point, or the nearest one on the same side of all walls; JOX_NO_CELL
   if none is near. */
uint32_t jox_standable_cell(const JoxStandable *standable, JoxV2 point);
/* Returns the part of a cell; 0 for JOX_NO_CELL. */
uint32_t jox_standable_part(const JoxStandable *standable, uint32_t cell);
/* Returns whether the straight line between two points passes over free cells alone. */
bool jox_standable_is_straight(const JoxStandable *standable, JoxV2 a, JoxV2 b);
/* Returns the length of the way between two points, m, at most about 8 % too long if it is not
   straight; INFINITY: no way. `next` receives the farthest point of it that can be reached
   straight. */
float jox_standable_way(JoxStandable *standable, JoxV2 from, JoxV2 to, JoxV2 *next);

#endif
