/* Routes round walls and large bodies: a distance field for each place that some agent asks its
   way to, made beside the steps. */
#ifndef JOX_WORLD_ROUTES_H
#define JOX_WORLD_ROUTES_H

#include "base/sections.h"
#include "geom/objects.h"
#include "geom/walls.h"
#include "machine/run.h"
#include "world/routes/body_obstacles.h"

typedef struct JoxRoutes JoxRoutes;

/* What routes are made of, and where they are found. */
typedef struct JoxRouteStage {
    const JoxPlace *places;
    uint32_t place_count;
    const JoxWalls *all_walls;
    uint32_t walls_version; /* counts their changes */
    const JoxAgents *agents;
    const JoxObjects *objects;
    uint64_t tick;
    double dt;            /* s */
    double crowd_slowing; /* of the walking law, m2 */
    JoIsa isa;            /* of kernels */
    JoxPool *pool;
    JoxMachineRun *machines; /* is given the fields; marks which it wants */
    JoxRoutes *routes;
} JoxRouteStage;

JoxRoutes *jox_routes_create(void);
void jox_routes_free(JoxRoutes *routes);
/* Before think of each step. In the first step: makes all fields that agents ask for in the states
   they are in. Later: what was asked for at a tick is used from half a second of simulated time
   after it on, however long it takes to make. A field is renewed where walls went up or down; where
   large bodies moved (see obstacles.h), at most every 2 s; and only if somebody still asks. While
   people bound for a place are held up, who walks by the law has a field that is slow where they
   stand, made anew each second. */
void jox_routes_update(const JoxRouteStage *stage);
/* What a field takes into account besides walls that never open. */
typedef struct JoxRouteFieldOptions {
    bool gates;      /* closed ones */
    uint32_t bodies; /* a bit for each JoxObstacleKind */
    float clearance; /* m: from walls, at least 0.05 */
} JoxRouteFieldOptions;
/* A field to a place that is made at once, for who asks whether a way leads there; the caller frees
   it. There are walls or agents. Changes nothing: bodies are where routes saw them last. */
JoxField *jox_routes_make_field(const JoxRouteStage *stage, uint32_t place,
                                const JoxRouteFieldOptions *look);
/* Has routes see where bodies are, in a world that is not stepped any more. */
void jox_routes_update_bodies(const JoxRouteStage *stage);
/* Bodies that ways lead round, as routes saw them last. */
const JoxObstacles *jox_routes_obstacles(const JoxRoutes *routes);
/* Places moved: all fields are renewed. */
void jox_routes_renew(JoxRoutes *routes);
/* Lists the fields in use, those under way, which are finished first, and when they come into use.
 */
void jox_routes_sections(const JoxRouteStage *stage, JoxSections *sections);

#endif
