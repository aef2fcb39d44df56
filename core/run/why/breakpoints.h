/* Breakpoints: a step in which an agent enters or leaves a state, or gives a signal. */
#ifndef JOX_RUN_WHY_BREAKPOINTS_H
#define JOX_RUN_WHY_BREAKPOINTS_H

#include "run/run.h"

/* Returns whether a breakpoint was met in the last step; *agent: the id of the first who met
   one. */
bool jox_run_broke(const JoScene *scene, uint32_t *agent);

#endif
