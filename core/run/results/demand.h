/* People who were due and did not come: by sources, and by starts at given times. */
#ifndef JOX_RUN_RESULTS_DEMAND_H
#define JOX_RUN_RESULTS_DEMAND_H

#include "base/format/json_writer.h"
#include "base/text.h"
#include "jostle.h"

/* People of a source so far: due, arrived, waiting for room, and not arrived before its end. */
typedef struct JoxDemand {
    double due, entered, waiting, did_not_come;
} JoxDemand;
JoxDemand jox_run_demand(const JoScene *scene, uint32_t source);
/* Adds ,"sources": {...} to a summary, if the scene has sources. */
void jox_run_add_demand(const JoScene *scene, JoxJson *json);
/* Appends sentences of a run's last lines, on sources at which people are missing. */
void jox_run_say_demand(const JoScene *scene, JoxText *out);
/* The same for people who start at given times and wait while others stand there: adds
   ,"starts_waiting": N if people start after 0 s. */
void jox_run_add_starts(const JoScene *scene, JoxJson *json);
void jox_run_say_starts(const JoScene *scene, JoxText *out);
/* The same for people who came in with their torso deep in another. */
void jox_run_say_births(const JoScene *scene, JoxText *out);

#endif
