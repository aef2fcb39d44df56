/* Bodies that ways lead round, as they were when routes last examined them. */
#ifndef JOX_WORLD_BODY_OBSTACLES_H
#define JOX_WORLD_BODY_OBSTACLES_H

#include "base/sections.h"
#include "geom/objects.h"
#include "geom/walls.h"

typedef enum JoxObstacleKind {
    JOX_OBSTACLE_FIXED,   /* nothing moves it */
    JOX_OBSTACLE_MOVABLE, /* anything that pushes it moves it */
    JOX_OBSTACLE_DRIVEN,  /* kinematic, as doors are */
    JOX_OBSTACLE_KINDS
} JoxObstacleKind;
#define JOX_OBSTACLES_ALL ((1u << JOX_OBSTACLE_KINDS) - 1) /* one bit per kind */

typedef struct JoxObstacle {
    uint32_t id;   /* id of the body */
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

/* Examines bodies: static ones, and others longer than 1 m and slower than 0.5 m/s. If one is new,
   gone, or has a corner of its footprint more than 0.3 m from its old outline, copies all as they
   are now and increments `version`. */
void jox_obstacles_update(JoxObstacles *obstacles, const JoxObjects *objects);
/* Adds the bodies of some kinds, one bit per kind, to walls as solids. */
void jox_obstacles_add(const JoxObstacles *obstacles, uint32_t kinds, JoxWalls *walls);
/* Returns whether any body may move out of the way. */
bool jox_obstacles_may_move(const JoxObstacles *obstacles);
void jox_obstacles_sections(JoxObstacles *obstacles, JoxSections *sections);
void jox_obstacles_free(JoxObstacles *obstacles);

#endif
