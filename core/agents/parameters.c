#include "agents/parameters.h"

#include <math.h>
#include <string.h>

#include "base/number/elementary.h"
#include "base/number/pi.h"

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

const char *jox_parameter_successor(const char *name) {
    if (strcmp(name, "turn") == 0)
        return "People have torsos that turn: see breadth and depth";
    if (strcmp(name, "wall_radius") == 0)
        return "See wall_reach: it counts in reaches of the torso, not in radii";
    return NULL;
}

/* Words for values of parameters. */
static const struct {
    JoxParameter parameter;
    const char *word;
    double value;
} LEVELS[] = {{JOX_PARAM_haste, "calm", 0.0},   {JOX_PARAM_haste, "normal", 0.5},
              {JOX_PARAM_haste, "keen", 1.0},   {JOX_PARAM_lifts, "never", 0.0},
              {JOX_PARAM_lifts, "either", 0.5}, {JOX_PARAM_lifts, "only", 1.0}};
enum { LEVEL_COUNT = sizeof LEVELS / sizeof *LEVELS };

const char *jox_parameter_word(JoxParameter parameter, uint32_t n) {
    for (int k = 0; k < LEVEL_COUNT; k++)
        if (LEVELS[k].parameter == parameter && n-- == 0)
            return LEVELS[k].word;
    return NULL;
}

bool jox_parameter_level(JoxParameter parameter, const char *word, double *value) {
    for (int k = 0; k < LEVEL_COUNT; k++)
        if (LEVELS[k].parameter == parameter && strcmp(LEVELS[k].word, word) == 0) {
            *value = LEVELS[k].value;
            return true;
        }
    return false;
}

bool jox_parameter_acts_in_literal(JoxParameter parameter) {
    switch (parameter) {
    case JOX_PARAM_yield:
    case JOX_PARAM_damping:
    case JOX_PARAM_brace:
    case JOX_PARAM_time_gap:
    case JOX_PARAM_haste:
    case JOX_PARAM_step_back:
    case JOX_PARAM_balance:
    case JOX_PARAM_rise:
    case JOX_PARAM_stance:
    case JOX_PARAM_breadth:
    case JOX_PARAM_depth:
        return false;
    default:
        return true;
    }
}

float jox_parameter_store(JoxParameter parameter, double value) {
    const JoxParameterInfo *info = &jox_parameters[parameter];
    if (value != value)
        value = info->value;
    value = value < info->least ? info->least : value > info->greatest ? info->greatest : value;
    if (parameter == JOX_PARAM_push_angle || parameter == JOX_PARAM_brace_angle)
        value = jox_cos(value * JOX_DEGREE);
    return (float)value;
}

void jox_parameter_store_all(JoxParameter parameter, const double *values, const uint32_t *agents,
                             uint32_t count, float *column) {
    if (parameter == JOX_PARAM_push_angle || parameter == JOX_PARAM_brace_angle) {
        for (uint32_t n = 0; n < count; n++)
            column[agents[n]] = jox_parameter_store(parameter, values[n]);
        return;
    }
    const JoxParameterInfo *info = &jox_parameters[parameter];
    const double least = info->least, greatest = info->greatest, unset = info->value;
    for (uint32_t n = 0; n < count; n++) {
        const double value = values[n] != values[n] ? unset : values[n];
        column[agents[n]] = (float)(value < least ? least : value > greatest ? greatest : value);
    }
}

bool jox_parameter_is_stored(JoxParameter parameter, float stored) {
    const JoxParameterInfo *info = &jox_parameters[parameter];
    if (parameter == JOX_PARAM_push_angle || parameter == JOX_PARAM_brace_angle)
        return stored >= -1.0f && stored <= 1.0f;
    return stored >= (float)info->least && stored <= (float)info->greatest;
}

double jox_parameter_value(JoxParameter parameter, float stored) {
    if (parameter != JOX_PARAM_push_angle && parameter != JOX_PARAM_brace_angle)
        return stored;
    double cosine = stored, sine2 = 1.0 - cosine * cosine;
    double degrees = jox_atan2(sine2 > 0.0 ? sqrt(sine2) : 0.0, cosine) * (180.0 / JOX_PI);
    return floor(degrees * 100.0 + 0.5) / 100.0; /* a cosine in a float has no more precision */
}
