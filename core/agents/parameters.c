#include "agents/parameters.h"

#include <string.h>

#include "base/elementary.h"

const JoxParameterInfo jox_parameters[JOX_PARAM_COUNT] = {
#define X(name, unit, least, greatest, value, meaning)                                             \
    {#name, unit, meaning, least, greatest, value},
    JOX_PARAMETERS(X)
#undef X
};

int jox_parameter_find(const char *name) {
    for (int i = 0; i < JOX_PARAM_COUNT; i++)
        if (strcmp(jox_parameters[i].name, name) == 0)
            return i;
    return -1;
}

float jox_parameter_store(JoxParameter parameter, double value) {
    const JoxParameterInfo *info = &jox_parameters[parameter];
    if (value != value)
        value = info->value;
    value = value < info->least ? info->least : value > info->greatest ? info->greatest : value;
    if (parameter == JOX_PARAM_push_angle || parameter == JOX_PARAM_brace_angle)
        value = jox_cos(value * (3.14159265358979323846 / 180.0));
    return (float)value;
}
