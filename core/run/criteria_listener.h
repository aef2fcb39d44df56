/* The criteria of a scene in its run: measured from the start on, if the scene has any. */
#ifndef JOX_RUN_CRITERIA_LISTENER_H
#define JOX_RUN_CRITERIA_LISTENER_H

#include "base/format/json_writer.h"
#include "jostle.h"
#include "record/danger/criteria.h"

/* Attaches the listener, and danger before it, if the scene has criteria. */
void jox_run_collect_criteria(JoScene *scene);
/* Returns the number of criteria, and the verdict on one at this time. */
uint32_t jox_run_count_criteria(const JoScene *scene);
JoxVerdict jox_run_judge(const JoScene *scene, uint32_t number);
/* Adds ,"criteria": {...} to a summary, if there are any. */
void jox_run_add_criteria(const JoScene *scene, JoxJson *json);
/* Appends sentences on the criteria to a run's last lines. */
void jox_run_say_criteria(const JoScene *scene, JoxText *out);

#endif
