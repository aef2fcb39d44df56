/* Torsos of a packet of agents; torso.h has the same for one agent. */
#ifndef JOX_AGENTS_TORSO_LANES_H
#define JOX_AGENTS_TORSO_LANES_H

#include "agents/param_lanes.h"
#include "agents/torso.h"

typedef struct JoxTorsoLanes {
    JoxFloats radius, half; /* m */
} JoxTorsoLanes;

static inline JoxTorsoLanes jox_torso_lanes(const JoxAgents *a, uint32_t first) {
    const JoxFloats zero = jf_set(0.0f);
    const JoxFloats radius = jox_param_lanes(a, JOX_PARAM_radius, first),
                    breadth = jox_param_lanes(a, JOX_PARAM_breadth, first),
                    depth = jox_param_lanes(a, JOX_PARAM_depth, first);
    const JoxFloats across = jf_select(jf_lt(zero, breadth), breadth, JOX_TORSO_BREADTH * radius);
    const JoxFloats through = jf_select(jf_lt(zero, depth), depth, JOX_TORSO_DEPTH * radius);
    const JoxMask longer = jf_lt(through, across);
    return (JoxTorsoLanes){0.5f * jf_select(longer, through, across),
                           jf_select(longer, 0.5f * (across - through), zero)};
}

/* Returns the distance of the farthest surface of the agents from their centres, m. */
static inline JoxFloats jox_outer_lanes(const JoxAgents *a, uint32_t first) {
    const JoxFloats x = jf_load(a->axis_x + first), y = jf_load(a->axis_y + first);
    return jf_load(a->contact_radius + first) + jf_sqrt(x * x + y * y);
}

/* Returns the radius of gyration of the agents' torsos about the vertical axis, m. */
static inline JoxFloats jox_gyration_lanes(const JoxAgents *a, uint32_t first) {
    const JoxFloats radius = jf_load(a->contact_radius + first), side = jox_outer_lanes(a, first);
    return 0.5f * jf_sqrt(side * side + radius * radius);
}

#endif
