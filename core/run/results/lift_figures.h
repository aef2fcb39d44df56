/* Figures of lifts: how long people waited, and how full cars were. */
#ifndef JOX_RUN_RESULTS_LIFT_FIGURES_H
#define JOX_RUN_RESULTS_LIFT_FIGURES_H

#include "base/format/json_writer.h"
#include "run/run.h"

/* s: a door that stands open for longer is told in the last lines of a run and in its report. */
#define JOX_LONG_OPEN 60.0

/* Figures of a lift up to now. Times are in s; NAN where nobody came in, or was let out. */
typedef struct JoxLiftResult {
    const char *name; /* borrowed */
    uint32_t capacity;
    JoxLiftFigures count; /* as the world counts them; `waits` is borrowed */
    double wait_mean, wait_p90, wait_most;
    double ride_mean;
    double filled;          /* mean share of the capacity that its trips filled; 0: none */
    double queue_most_time; /* NAN: nobody waited */
    uint32_t waiting;       /* people before its doors now */
    double waiting_longest; /* for which the one of them waits who came first; 0: nobody does */
} JoxLiftResult;

/* Returns the figures of a lift, by its index. */
JoxLiftResult jox_run_lift_result(const JoWorld *world, uint32_t lift);
/* Returns whether people who cannot use stairs stay. */
bool jox_run_is_anybody_stranded(const JoxStranded *stranded);
/* Adds them to the summary, as "lifts", and people who cannot use stairs, as "cannot_use_stairs";
   nothing without lifts, and without storeys. */
void jox_run_add_lifts(const JoScene *scene, JoxJson *json);
/* Appends them to the last lines of a run. */
void jox_run_say_lifts(const JoScene *scene, JoxText *out);

#endif
