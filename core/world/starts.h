/* People who come in at times and places of their own, as a recording has them. */
#ifndef JOX_WORLD_STARTS_H
#define JOX_WORLD_STARTS_H

#include "world/population.h"

/* Lists the starts of all groups that lie after 0 s; of a world that has none yet. */
void jox_world_list_starts(JoWorld *world);
/* Before a step: brings in whose time has come. Who would stand in another waits until that one has
   gone on; those behind do not wait for it. */
void jox_world_starts(JoWorld *world);
/* Gives an agent a velocity, and has it look there; NAN leaves it as it is. */
void jox_world_set_going(JoWorld *world, uint32_t agent, JoxV2 velocity);

#endif
