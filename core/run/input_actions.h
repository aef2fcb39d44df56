/* Performs the actions of people and of input logs on a running scene. */
#ifndef JOX_RUN_INPUT_ACTIONS_H
#define JOX_RUN_INPUT_ACTIONS_H

#include "jostle.h"
#include "world/input/input_entries.h"

/* Performs the entries of the played log that are due in the step that begins. */
void jox_run_perform_due_inputs(JoScene *scene);
/* Performs an entry between two steps and logs it, as jo_scene_input does with a line. False with
   the error if it cannot be performed. */
bool jox_run_perform_input(JoScene *scene, JoxInputEntry *entry, JoError *error);
/* Logs what the program did to the world (JoWorld.record); `context` is the scene. */
void jox_run_log_act(void *context, JoxInputEntry *entry);

#endif
