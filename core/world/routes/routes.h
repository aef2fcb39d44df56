/* Routes round walls and large bodies: a distance field for each place that agents ask the way to,
   made on a worker thread beside the steps. think calls jox_routes_update; machines read the
   fields. */
#ifndef JOX_WORLD_ROUTES_H
#define JOX_WORLD_ROUTES_H

#include "base/sections.h"
#include "geom/objects.h"
#include "geom/walls.h"
#include "machine/run.h"
#include "world/routes/body_obstacles.h"

typedef struct JoxRoutes JoxRoutes;

/* Context of routes: their inputs, and where they are stored; filled by jox_world_route_stage. */
typedef struct JoxRouteStage {
    const JoxPlace *places;
    uint32_t place_count;
    const JoxWalls *all_walls;
    uint32_t walls_version; /* counts changes of walls */
    const JoxAgents *agents;
    const JoxObjects *objects;
    uint64_t tick;
    double dt;            /* s */
    double crowd_slowing; /* m2: parameter of the walking law */
    JoIsa isa;            /* instruction set of the kernels */
    JoxPool *pool;
    JoxMachineRun *machines; /* gets the fields; marks the wanted ones */
    JoxRoutes *routes;
} JoxRouteStage;

JoxRoutes *jox_routes_create(void);
void jox_routes_free(JoxRoutes *routes);
/* Before think of each step. In the first step makes all fields that agents ask for. Later a field
   is in use half a second of simulated time after it was asked for, however long it takes to make.
   While agents ask for it, it is made anew if walls changed, and at most every 2 s if large bodies
   moved (body_obstacles.h). While agents bound for a place are held up, agents that walk by the law
   have a field that is slow where those stand, made anew each second. */
void jox_routes_update(const JoxRouteStage *stage);
/* Obstacles of a field besides walls that never open. */
typedef struct JoxRouteFieldOptions {
    bool gates;      /* closed gates */
    uint32_t bodies; /* a bit for each JoxObstacleKind */
    float clearance; /* m: distance to walls, at least 0.05 */
    bool stepless;   /* stairs and escalators are closed */
    bool lifts;      /* ways lead by lifts, too */
    bool all_lifts;  /* as if all lifts were in use */
} JoxRouteFieldOptions;
/* Makes a field to a place at once, to see whether a way leads there; the caller frees it. Needs
   walls or agents. Changes nothing: bodies are where routes saw them last. */
JoxField *jox_routes_make_field(const JoxRouteStage *stage, uint32_t place,
                                const JoxRouteFieldOptions *look);
/* Updates where routes see bodies, in a world that is not stepped any more. */
void jox_routes_update_bodies(const JoxRouteStage *stage);
/* Returns the bodies that ways lead round, as routes saw them last. */
const JoxObstacles *jox_routes_obstacles(const JoxRoutes *routes);
/* Notes that a lift is used in another way. */
void jox_routes_note_lifts(JoxRoutes *routes);
/* Makes all fields anew, as places moved. */
void jox_routes_renew(JoxRoutes *routes);
/* Lists as state the fields in use, those being made, which are finished first, and their times. */
void jox_routes_sections(const JoxRouteStage *stage, JoxSections *sections);

#endif
