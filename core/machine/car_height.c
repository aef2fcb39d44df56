/* Heights at which agents stand: that of the floor, or of the car that they are in. */
#include "machine/lifts.h"

#include "machine/machine_parts.h"

int32_t jox_machines_car(const JoxMachineRun *run, uint32_t agent) {
    const JoxLiftView *view = run->lifts;
    const JoxV2 at = {run->agents->x[agent], run->agents->y[agent]};
    if (!view || view->lift_count == 0)
        return -1;
    const uint32_t sheet = jox_sheet_of(view->storeys, at.y);
    const JoxV2 plan = jox_in_plan(view->storeys, at);
    for (uint32_t l = 0; l < view->lift_count; l++)
        if (view->lifts[l].stops[view->cars[l].stop].storey == sheet &&
            jox_lift_contains(&view->lifts[l], plan))
            return (int32_t)l;
    return -1;
}

float jox_machines_height(const JoxMachineRun *run, uint32_t agent) {
    const int32_t lift = jox_machines_car(run, agent);
    const JoxAgents *a = run->agents;
    return lift >= 0 ? (float)run->lifts->cars[lift].height
                     : jox_floor_height(a->storeys, jox_v2(a->x[agent], a->y[agent]));
}
