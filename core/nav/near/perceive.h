/* The stage perceive: its kernel for each instruction set, which perceive.c calls for chunks of
   agents on several threads, and the searches for one agent. */
#ifndef JOX_NAV_NEAR_PERCEIVE_H
#define JOX_NAV_NEAR_PERCEIVE_H

#include "base/number/pi.h"
#include "nav/nav_state.h"
#include "simd/isa.h"

typedef struct JoxPerceive {
    const JoxNav *nav;
    JoxAgents *agents; /* writes search_radius, density */
    JoxNeighbours *out;
    float sight; /* m: limit of every perception; INFINITY: none */
} JoxPerceive;

#define JOX_SEARCH_SLACK 0.03f    /* m: the first search radius exceeds the last one by this */
#define JOX_SEARCH_GROWTH 1.5f    /* growth of a radius that holds too few */
#define JOX_SEARCH_LEAST 0.01f    /* m: least radius that is stored */
#define JOX_DENSITY_LEAST 0.0025f /* m2: least squared radius in a density */

/* Finds the neighbours, the agents within touch range, `search_radius` and `density` of agents
   [begin, end). `begin` is a multiple of JOX_LANES. */
typedef void JoxPerceiveKernel(const JoxPerceive *perceive, uint32_t begin, uint32_t end);
#define X(name, isa) JoxPerceiveKernel jox_perceive_packets_##name;
JOX_ISAS(X)
#undef X
/* shape_wide.c: writes contact_radius, axis_x and axis_y, and the shapes, of agents [begin, end);
   stops the turning of discs, which may have been torsos. */
#define X(name, isa) JoxPerceiveKernel jox_shape_packets_##name;
JOX_ISAS(X)
#undef X
/* Finds the neighbours of one agent, with any number of candidates; searches within `radius` (m)
 * first. */
void jox_perceive_one(const JoxPerceive *perceive, uint32_t agent, float radius);
/* Finds the neighbours of one agent and their torsos exactly as the kernels do, at any time and by
   no grid; writes no column. `discs`: all are discs, as in literal mode. */
void jox_perceive_alone(const JoxAgents *agents, uint32_t agent, bool discs, JoxNeighbours *out);
/* Lists the agents within `range` (m) of one agent in touch_index. */
void jox_perceive_touching(const JoxPerceive *perceive, uint32_t agent, float range);

/* Returns how far any agent sees at most, m: less than half a period or pitch, so that no agent is
   seen from two sides; INFINITY without. */
float jox_nav_sight(const JoxAgents *agents);

#endif
