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

#endif
