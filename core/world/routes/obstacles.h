/* Bodies that ways lead round, as they stood when last looked at closely. */
#ifndef JOX_WORLD_OBSTACLES_H
#define JOX_WORLD_OBSTACLES_H

#include "base/sections.h"
#include "geom/objects.h"
#include "geom/walls.h"

typedef struct JoxObstacle {
    uint32_t id;      /* of the body */
    uint32_t movable; /* 1: not static */
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
/* Adds them to walls as solids; `movable` too, or only those that never move. */
void jox_obstacles_add(const JoxObstacles *obstacles, bool movable, JoxWalls *walls);
void jox_obstacles_sections(JoxObstacles *obstacles, JoxSections *sections);
void jox_obstacles_free(JoxObstacles *obstacles);

#endif
