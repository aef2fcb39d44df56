/* The plan of a side: what plan_json.c wrote of a scene, or a recording's walls. */
#ifndef JOX_SWEEP_COMPARE_PLAN_H
#define JOX_SWEEP_COMPARE_PLAN_H

#include "picture/draw.h"
#include "record/probes/probe.h"

typedef struct JoxSidePlan {
    JoxV2 low, high; /* what is shown, m */
    JoxWalls walls;
    JoxPlace *places;
    uint32_t place_count;
    JoxProbe **probes; /* of those that measure somewhere: what they measure in */
    uint32_t probe_count;
    JoxDrawnBodies bodies;
} JoxSidePlan;

/* False where the text is none; to be freed even then. */
bool jox_side_plan_read(JoxSidePlan *plan, const char *json);
void jox_side_plan_free(JoxSidePlan *plan);

#endif
