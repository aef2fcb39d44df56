/* Troubles of a run in one sentence. */
#ifndef JOX_RUN_RESULTS_RESULT_STRUCTS_H
#define JOX_RUN_RESULTS_RESULT_STRUCTS_H

#include "jostle.h"

/* Returns the troubles of jo_scene_troubles in one sentence, to be freed with jox_free; NULL: none.
 */
char *jox_run_troubles(const JoScene *scene);

#endif
