/* Agents that are held up on their way to a place; routes.c leads others round them. */
#ifndef JOX_WORLD_HELD_UP_H
#define JOX_WORLD_HELD_UP_H

#include "agents/agents.h"
#include "geom/field/field.h"

enum { JOX_HELD = 256 }; /* parts of one agent that does not move at all */

/* Sums, by place, by how much the agents bound for it are held up, in 1 / JOX_HELD; in whole
   numbers, so that their order does not matter. `held` has `places` entries. */
void jox_held_up_sum(const JoxAgents *agents, uint32_t *held, uint32_t places);
/* Lists the agents that are held up on the way to a place, as the crowd of a field; the caller
   frees `at` and `held`. */
JoxFieldCrowd jox_held_up_list(const JoxAgents *agents, uint32_t place, float slowing, JoIsa isa);

#endif
