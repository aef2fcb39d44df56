/* States that nobody left though people are in them at the end, and transitions that never fired,
   in results. */
#ifndef JOX_RUN_RESULTS_UNLEFT_STATES_H
#define JOX_RUN_RESULTS_UNLEFT_STATES_H

#include "base/format/json_writer.h"
#include "base/text.h"
#include "jostle.h"

/* Appends sentences of a run's last lines. */
void jox_run_say_unleft(const JoScene *scene, JoxText *out);
/* Adds to a summary, if there are any, "unleft": [{machine, state, people, since_s}] and
   "never_fired": [{machine, from, to, id}]. */
void jox_run_add_unleft(const JoScene *scene, JoxJson *json);

#endif
