/* The plan of a side, read from the JSON that plan_json.c wrote for a scene, or recording.c for the
   walls of a recording. */
#ifndef JOX_SWEEP_COMPARE_SIDE_PLAN_H
#define JOX_SWEEP_COMPARE_SIDE_PLAN_H

#include "picture/draw.h"
#include "record/probes/probe.h"
#include "scene/scene.h"

typedef struct JoxSidePlan {
    JoxV2 low, high;    /* bounds of the picture, m; with storeys, in plan */
    JoxStoreys storeys; /* all points are positions on their sheets; empty: one plane */
    JoxWalls walls;
    JoxPlace *places;
    uint32_t place_count;
    JoxProbe **probes; /* probes with a place; for drawing only */
    uint32_t probe_count;
    JoxDrawnBodies bodies;
    JoxSceneReport report; /* what the scene states for the title block; `notes` is not read */
} JoxSidePlan;

/* Reads the JSON; false if it is no plan. Free the plan even then. */
bool jox_side_plan_read(JoxSidePlan *plan, const char *json);
void jox_side_plan_free(JoxSidePlan *plan);

#endif
