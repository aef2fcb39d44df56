/* Sets parameters of states and machines while a scene runs. */
#ifndef JOX_RUN_SET_PARAMETER_H
#define JOX_RUN_SET_PARAMETER_H

#include "jostle.h"

/* A parameter of a machine's state. */
typedef struct JoxParameterChoice {
    uint32_t machine;
    int32_t state; /* -1: the machine's defaults; -2 - index of an outer state */
    int parameter;
} JoxParameterChoice;

/* Finds the parameter that the names mean; `machine` is a name or a path, `state` may be
   "defaults". False with `error` if one does not exist, or the value is out of range. */
bool jox_run_choose_parameter(const JoScene *scene, const char *machine, const char *state,
                              const char *parameter, double value, JoxParameterChoice *out,
                              JoError *error);
/* Sets it for all agents, present and to come, until the machine's file is reloaded. */
bool jox_run_set_parameter(JoScene *scene, const char *machine, const char *state,
                           const char *parameter, double value, JoError *error);

#endif
