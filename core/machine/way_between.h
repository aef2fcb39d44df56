/* The way from one agent to another, as agents see each other; private to machine/. */
#ifndef JOX_MACHINE_WAY_BETWEEN_H
#define JOX_MACHINE_WAY_BETWEEN_H

#include "agents/agents.h"
#include "geom/storeys.h"

/* Returns the vector from agent i to agent j, m; out of sight where they are on different storeys
   and do not see each other over the foot or head of a stair. */
#define JOX_OUT_OF_SIGHT 1e6f /* m */
static inline JoxV2 jox_way_between(const JoxAgents *a, uint32_t i, uint32_t j) {
    JoxV2 offset;
    if (!a->storeys)
        return jox_offset(a, i, j);
    const bool sees =
        jox_plan_offset(a->storeys, jox_v2(a->x[i], a->y[i]), jox_v2(a->x[j], a->y[j]), &offset);
    return sees ? jox_wrap(a, offset) : jox_v2(0.0f, JOX_OUT_OF_SIGHT);
}

#endif
