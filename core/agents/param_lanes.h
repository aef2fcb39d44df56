/* Reading parameters of agents in lanes. The kernels of nav, force and machine include this. */
#ifndef JOX_AGENTS_PARAM_LANES_H
#define JOX_AGENTS_PARAM_LANES_H

#include "agents/agents.h"
#include "simd/lanes.h"

/* Returns the parameter of a packet of consecutive agents from `first` on. */
static inline JoxFloats jox_param_lanes(const JoxAgents *agents, JoxParameter p, uint32_t first) {
    return jf_load(jox_params(agents, p, first));
}
/* Return the parameter of agents whose indices are in memory, or in lanes. */
static inline JoxFloats jox_param_of(JoxParameterColumn column, const uint32_t *agents) {
    return column.mask ? jf_pick_at(column.cells, agents) : jf_set(column.cells[0]);
}
static inline JoxFloats jox_param_pick(JoxParameterColumn column, JoxInts agents) {
    return column.mask ? jf_pick(column.cells, agents) : jf_set(column.cells[0]);
}
/* jox_stands, by lane. */
static inline JoxMask jox_stands_lanes(const JoxAgents *a, uint32_t first) {
    const JoxFloats x = jf_load(a->pref_x + first), y = jf_load(a->pref_y + first);
    return jf_lt(x * x + y * y, jf_set((float)(JOX_STANDS * JOX_STANDS)));
}
/* jox_steps_back, by lane. */
static inline JoxMask jox_steps_back_lanes(const JoxAgents *a, uint32_t first) {
    const JoxMask settled = jf_lt(jf_set(JOX_STEP_REACTION), jf_load(a->settled + first));
    if (!jm_bits(settled))
        return settled;
    const JoxMask free = jf_le(jf_load(a->load + first), jf_set(JOX_STEP_LOAD));
    return jm_and(jm_and(settled, free), jox_stands_lanes(a, first));
}

#endif
