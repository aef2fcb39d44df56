/* Functions that carry out verbs, for verb_table.c, before a step; false with a sentence in
   `why` where it cannot be. */
#ifndef JOX_WORLD_VERB_FUNCTIONS_H
#define JOX_WORLD_VERB_FUNCTIONS_H

#include "base/text.h"
#include "world/input/input_entries.h"

typedef struct JoWorld JoWorld;
typedef bool JoxPerform(JoWorld *world, const JoxInputEntry *entry, JoxText *why);

/* agent_verbs.c */
JoxPerform jox_perform_player, jox_perform_push, jox_perform_spawn, jox_perform_remove,
    jox_perform_teleport, jox_perform_goal, jox_perform_state, jox_perform_memory,
    jox_perform_parameter;
/* body_and_wall_verbs.c */
JoxPerform jox_perform_throw, jox_perform_box, jox_perform_grab, jox_perform_drag,
    jox_perform_release, jox_perform_impulse, jox_perform_place, jox_perform_velocity,
    jox_perform_delete, jox_perform_open, jox_perform_close, jox_perform_signal, jox_perform_wall,
    jox_perform_unwall, jox_perform_lift;

#endif
