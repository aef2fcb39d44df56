/* What of a played input log had no effect, in results. */
#ifndef JOX_RUN_RESULTS_IDLE_INPUT_H
#define JOX_RUN_RESULTS_IDLE_INPUT_H

#include "base/text.h"
#include "jostle.h"

/* Appends sentences of a run's last lines. */
void jox_run_say_idle_input(const JoScene *scene, JoxText *out);

#endif
