/* Chests of people who come in turn as far as they must, as people do who stand close: spots are
   searched for discs, so broader torsos would begin in each other. step.c calls it for people of
   sources and of start times, verbs/ for those whom somebody adds, run/starting_torsos.c for those
   who are there when a scene starts. */
#ifndef JOX_WORLD_TURN_CHESTS_H
#define JOX_WORLD_TURN_CHESTS_H

#include "agents/torso.h"
#include "jostle.h"

/* Turns the chests of the agents from index `from` on out of other torsos, in `torsos` too. Returns
   how deep each of them still is in another, m; free by jox_free. */
float *jox_chests_turn(JoxAgents *agents, JoxTorsos *torsos, uint32_t from);
/* Returns whether agent i is in another by more than torsos may be when people come in. */
bool jox_torso_is_deep(const JoxTorsos *torsos, uint32_t i, float depth);
/* The same for agents that came in between two steps; counts those that are deep in others all the
   same. */
void jox_world_turn_newcomers(JoWorld *world, uint32_t from);

#endif
