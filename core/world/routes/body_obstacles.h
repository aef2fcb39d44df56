/* Bodies that ways lead round, as they stood when last looked at closely. */
#ifndef JOX_WORLD_OBSTACLES_H
#define JOX_WORLD_OBSTACLES_H

#include "base/sections.h"
#include "geom/objects.h"
#include "geom/walls.h"

typedef enum JoxObstacleKind {
    JOX_OBSTACLE_FIXED,   /* nothing moves it */
    JOX_OBSTACLE_MOVABLE, /* by what pushes it */
    JOX_OBSTACLE_DRIVEN,  /* kinematic, as doors are */
    JOX_OBSTACLE_KINDS
} JoxObstacleKind;
#define JOX_OBSTACLES_ALL ((1u << JOX_OBSTACLE_KINDS) - 1) /* a bit for each kind */

typedef struct JoxObstacle {
    uint32_t id;   /* of the body */
    uint32_t kind; /* JoxObstacleKind */
    uint32_t count;
    JoxV2 ring[JOX_FOOTPRINT_POINTS]; /* counter-clockwise, m */
} JoxObstacle;

/* Zero-initialise. */
typedef struct JoxObstacles {
    JoxObstacle *items; /* in the order of the bodies' rows */
    uint32_t count, capacity;
    uint32_t version; /* counts the changes */
} JoxObstacles;

/* Looks at the bodies: those that do not move by themselves, and others that are longer than 1 m
   and slower than 0.5 m/s. Where one came, went, or has a corner of its footprint more than 0.3 m
   from where it was, all are taken as they stand now, and `version` counts up. */
void jox_obstacles_update(JoxObstacles *obstacles, const JoxObjects *objects);
/* Adds those of some kinds, a bit for each, to walls as solids. */
void jox_obstacles_add(const JoxObstacles *obstacles, uint32_t kinds, JoxWalls *walls);
void jox_obstacles_sections(JoxObstacles *obstacles, JoxSections *sections);
void jox_obstacles_free(JoxObstacles *obstacles);

#endif
