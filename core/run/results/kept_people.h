/* People whom a gate or a moving body keeps from their goal, in results. */
#ifndef JOX_RUN_RESULTS_KEPT_PEOPLE_H
#define JOX_RUN_RESULTS_KEPT_PEOPLE_H

#include "base/format/json_writer.h"
#include "base/text.h"
#include "jostle.h"

/* Appends sentences of a run's last lines. */
void jox_run_say_kept(const JoScene *scene, JoxText *out);
/* Adds ,"kept": [{from, cause, by, people, since_s}] to a summary, if people are kept. */
void jox_run_add_kept(const JoScene *scene, JoxJson *json);

#endif
