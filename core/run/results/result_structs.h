/* Troubles of a run in one sentence. */
#ifndef JOX_RUN_RESULTS_RESULT_STRUCTS_H
#define JOX_RUN_RESULTS_RESULT_STRUCTS_H

#include "jostle.h"

/* Returns what jo_scene_troubles tells, in one sentence; NULL: nothing. Freed by jox_free. */
char *jox_run_troubles(const JoScene *scene);

#endif
