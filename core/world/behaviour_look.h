/* A look at behaviours between two steps: agents sense what they will sense in the next step, so
   that conditions can be explained (machine/why.h). It writes scratch alone, and the next step and
   the hash are the same with and without it. Called by run/why. */
#ifndef JOX_WORLD_BEHAVIOUR_LOOK_H
#define JOX_WORLD_BEHAVIOUR_LOOK_H

#include "machine/why.h"

struct JoWorld;
typedef struct JoxBehaviourLook {
    JoxMachineLook before;
    JoxNeighbours neighbours; /* neighbours of the inspected agent */
} JoxBehaviourLook;

/* Begins a look; end it before the next step. */
void jox_world_look(struct JoWorld *world, JoxBehaviourLook *look);
/* Finds the neighbours of the agent whose conditions are asked for next. */
void jox_world_look_at(struct JoWorld *world, JoxBehaviourLook *look, uint32_t agent);
void jox_world_end_look(struct JoWorld *world, JoxBehaviourLook *look);

#endif
