/* The torso of an agent in plan: a capsule, that is, all points within `radius` of a segment that
   reaches `half` to either side of the centre, across the chest. A disc has no segment. */
#ifndef JOX_AGENTS_TORSO_H
#define JOX_AGENTS_TORSO_H

#include <math.h>

#include "agents/agents.h"
#include "base/number/pi.h"

/* Breadth and depth of a torso for which none is given, in radii of the agent. */
#define JOX_TORSO_BREADTH 2.25f
#define JOX_TORSO_DEPTH 1.25f

typedef struct JoxTorso {
    float radius, half; /* m */
} JoxTorso;

/* Return the measures of a torso, m; 0: by the radius. */
static inline float jox_torso_breadth(float breadth, float radius) {
    return breadth > 0.0f ? breadth : JOX_TORSO_BREADTH * radius;
}
static inline float jox_torso_depth(float depth, float radius) {
    return depth > 0.0f ? depth : JOX_TORSO_DEPTH * radius;
}

/* Returns the torso of these measures, m; 0: by the radius. */
static inline JoxTorso jox_torso_of(float breadth, float depth, float radius) {
    const float across = jox_torso_breadth(breadth, radius);
    const float through = jox_torso_depth(depth, radius);
    return (JoxTorso){0.5f * (through < across ? through : across),
                      across > through ? 0.5f * (across - through) : 0.0f};
}

/* Returns the torso of agent i by its parameters. Literal mode has discs alone. */
static inline JoxTorso jox_agent_torso(const JoxAgents *a, uint32_t i, bool literal) {
    const float radius = jox_param(a, JOX_PARAM_radius, i);
    return literal ? (JoxTorso){radius, 0.0f}
                   : jox_torso_of(jox_param(a, JOX_PARAM_breadth, i),
                                  jox_param(a, JOX_PARAM_depth, i), radius);
}
static inline float jox_torso_circumference(JoxTorso t) {
    return (float)JOX_TURN * t.radius + 4.0f * t.half;
}

/* Returns the square of the radius of gyration about the vertical axis, m2: that of an ellipse with
   the same axes. */
static inline float jox_torso_gyration2(JoxTorso t) {
    const float side = t.half + t.radius;
    return 0.25f * (side * side + t.radius * t.radius);
}

/* Return, of agent i's shape as it is in this step, half the length of its axis, and its radius of
   gyration, m; 0 of a disc, which does not turn. */
static inline float jox_torso_half(const JoxAgents *a, uint32_t i) {
    return jox_length((JoxV2){a->axis_x[i], a->axis_y[i]});
}
static inline float jox_torso_gyration(const JoxAgents *a, uint32_t i) {
    const JoxTorso torso = {a->contact_radius[i], jox_torso_half(a, i)};
    return torso.half > 0.0f ? sqrtf(jox_torso_gyration2(torso)) : 0.0f;
}

/* Returns how far the shape of agent i reaches from its centre along a unit vector, m. */
static inline float jox_torso_reach(const JoxAgents *a, uint32_t i, JoxV2 direction) {
    return a->contact_radius[i] + fabsf(a->axis_x[i] * direction.x + a->axis_y[i] * direction.y);
}

/* The torsos of all agents in plan, for whoever shows or records them. Zero-initialise; free by
   jox_torsos_free. */
typedef struct JoxTorsos {
    float *axis_x, *axis_y; /* m: from the centre to the left end of the axis */
    float *radius;          /* m: distance of the surface from the axis */
    size_t capacity;
} JoxTorsos;
/* Fills the columns by the agents' parameters and chests: scratch columns of agents lack them
   before the first step. Returns false, with nothing filled, if all are discs. */
bool jox_torsos_list(JoxTorsos *torsos, const JoxAgents *agents, bool literal);
void jox_torsos_free(JoxTorsos *torsos);

/* Returns the distance of a point from the shape of an agent, m; negative within. */
float jox_torso_distance(const JoxAgents *agents, uint32_t i, JoxV2 point);
/* Returns the gap between the shapes of two agents, m; negative where they overlap. */
float jox_torso_gap(const JoxAgents *agents, uint32_t i, uint32_t j);
/* The same by listed torsos. */
float jox_torsos_gap(const JoxTorsos *torsos, const JoxAgents *agents, uint32_t i, uint32_t j);

/* Returns an upper bound of the distance of all agents' surfaces from their centres, m. `discs`:
   all are discs of their radius, as in literal mode. */
float jox_agents_widest(const JoxAgents *agents, bool discs);
/* Returns whether any agent is no disc. */
bool jox_agents_have_torsos(const JoxAgents *agents);

#endif
