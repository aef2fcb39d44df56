/* Checks of whole parts of a world: builds with assertions call them through JOX_CHECK, before and
   after each step. */
#ifndef JOX_WORLD_CHECK_H
#define JOX_WORLD_CHECK_H

#include "world/world.h"

/* Ids, ranks, slots and indices of the agents agree with each other and with the model. */
void jox_world_agents_check(const JoWorld *world);
/* Places, groups, sources and sinks name things that there are. */
void jox_world_model_check(const JoWorld *world);
/* What people want, inspect and drag is listed once each, and figures add up. */
void jox_world_lists_check(const JoWorld *world);

#endif
