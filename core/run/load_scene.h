/* Loads scenes for the program and the tools above; jo_scene_load is built on it. */
#ifndef JOX_RUN_LOAD_SCENE_H
#define JOX_RUN_LOAD_SCENE_H

#include "run/messages.h"

/* Does what jo_scene_load does; `diagnosed` (may be NULL) is called with the diagnostics of this
   load and of all reloads. */
JoScene *jox_run_load_and_report(const JoSceneDef *def, JoxDiagnosed *diagnosed, void *context,
                                 JoError *error);
/* Does what jo_scene_load does, on the heap in use, and appends what is wrong to `diagnostics`.
   Returns NULL if there are errors. */
JoScene *jox_run_load(const JoSceneDef *def, JoxDiagnostics *diagnostics);

#endif
