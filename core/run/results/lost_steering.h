/* People who stand at the end because whom their steering leads to is not found, in results. */
#ifndef JOX_RUN_RESULTS_LOST_STEERING_H
#define JOX_RUN_RESULTS_LOST_STEERING_H

#include "base/format/json_writer.h"
#include "base/text.h"
#include "jostle.h"

/* Appends a sentence of a run's last lines. */
void jox_run_say_lost(const JoScene *scene, JoxText *out);
/* Adds to a summary, if there are any, "lost_steering": [{machine, state, people, steering}]. */
void jox_run_add_lost(const JoScene *scene, JoxJson *json);

#endif
