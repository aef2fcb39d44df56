/* Figures of lifts: how long people waited, and how full cars were. */
#ifndef JOX_RUN_RESULTS_LIFT_FIGURES_H
#define JOX_RUN_RESULTS_LIFT_FIGURES_H

#include "base/format/json_writer.h"
#include "run/run.h"

/* Adds them to the summary, as "lifts"; nothing without lifts. */
void jox_run_add_lifts(const JoScene *scene, JoxJson *json);
/* Appends them to the last lines of a run. */
void jox_run_say_lifts(const JoScene *scene, JoxText *out);

#endif
