/* A field of a route while it is made: copies of all that it is made of, so that a worker thread
   can make it beside the steps. routes.c alone calls this. */
#ifndef JOX_WORLD_ROUTE_MAKING_H
#define JOX_WORLD_ROUTE_MAKING_H

#include "task/worker.h"
#include "world/routes/routes.h"

#define JOX_ROUTE_CELLS 400000.0f /* most cells of a field */

typedef struct JoxRouteMaking {
    JoxWorkItem item; /* first */
    JoxWalls walls;
    JoxPlace *places; /* the place, followed by its members */
    uint32_t place_count;
    JoxV2 low, high;
    float cell, clearance; /* m */
    JoxFieldCrowd crowd;
    const JoxStoreys *storeys; /* the world's storeys; NULL: one plane */
    JoxStoreys
        stairs; /* the same, with a copy of the stairs: which are closed may change meanwhile */
    bool by_lifts;
    JoxFieldLifts lifts; /* the world's lifts, with copies of their modes */
    bool keeps_marks;
    JoxFieldMarks *marks; /* marks of the previous field, then of this one; NULL: none */
    JoxField *field;
} JoxRouteMaking;

/* Copies all that a field is made of. `before`: the field that it replaces, or NULL. */
JoxRouteMaking *jox_route_making_prepare(const JoxRouteStage *stage, const JoxObstacles *obstacles,
                                         uint32_t place, const JoxRouteFieldOptions *look,
                                         float most_cells, const JoxField *before);
/* Makes the field; on any thread. */
void jox_route_making_run(JoxWorkItem *item);
void jox_route_making_free(JoxRouteMaking *making);

#endif
