/* Ways between agents and points, as agents see them; private to machine/. */
#ifndef JOX_MACHINE_WAY_BETWEEN_H
#define JOX_MACHINE_WAY_BETWEEN_H

#include "agents/agents.h"
#include "geom/storeys.h"
#include "machine/run.h"

#define JOX_OUT_OF_SIGHT 1e6f /* m */
/* Returns the vector from a point to another, m, over joined edges and over the foot or head of a
   stair; out of sight where they are on different storeys and do not see each other there. */
static inline JoxV2 jox_way_to(const JoxAgents *a, JoxV2 from, JoxV2 to) {
    JoxV2 offset;
    return jox_plan_offset(a->storeys, from, to, &offset) ? jox_wrap(a, offset)
                                                          : jox_v2(0.0f, JOX_OUT_OF_SIGHT);
}
/* Returns the vector from agent i to agent j, as jox_way_to does. */
static inline JoxV2 jox_way_between(const JoxAgents *a, uint32_t i, uint32_t j) {
    return a->storeys ? jox_way_to(a, jox_v2(a->x[i], a->y[i]), jox_v2(a->x[j], a->y[j]))
                      : jox_offset(a, i, j);
}
/* Returns the distance from a point to a place, m: straight, through floors if it is on another
   storey (target.c). */
float jox_distance_to_place(const JoxMachineRun *run, uint32_t place, JoxV2 from);

#endif
