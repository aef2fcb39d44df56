/* Sets parameters of a state, or of a machine's defaults, while a scene runs. Inputs and the
   live page call it. */
#include <math.h>
#include <string.h>

#include "run/reload.h"
#include "run/run.h"
#include "run/set_parameter.h"

enum { MOST_NAMES = 256 };

static bool refuse_unknown(const char *kind, const char *name, const char *const *names,
                           uint32_t count, JoError *error) {
    const char *near = jox_suggest(name, names, count);
    jox_error(error, JO_INPUT, "there is no %s '%.60s'%s%.60s%s", kind, name,
              near ? ". Did you mean '" : "", near ? near : "", near ? "'?" : "");
    return false;
}

static bool find_machine_named(const JoxMachineRun *machines, const char *name,
                               JoxParameterChoice *out, JoError *error) {
    const char *names[JOX_MOST_MACHINES];
    uint32_t found = 0;
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        names[m] = machine->name;
        if (strcmp(machine->path, name) == 0) { /* a path tells machines of one name apart */
            out->machine = m;
            return true;
        }
        if (strcmp(machine->name, name) == 0 && found++ == 0)
            out->machine = m;
    }
    if (found > 1) {
        jox_error(error, JO_INPUT,
                  "%u machines are named '%.60s'; name it by its file, as '%.200s'", found, name,
                  machines->set->items[out->machine]->path);
        return false;
    }
    return found == 1 || refuse_unknown("machine", name, names, machines->set->count, error);
}

static bool find_state_named(const JoxMachine *machine, const char *name, JoxParameterChoice *out,
                             JoError *error) {
    const int outer = jox_machine_outer(machine, name);
    out->state = outer < 0 ? jox_machine_state(machine, name) : -2 - outer;
    if (out->state != -1 || strcmp(name, "defaults") == 0)
        return true;
    const char *names[MOST_NAMES] = {"defaults"};
    uint32_t count = 1;
    for (uint32_t s = 0; s < machine->state_count && count < MOST_NAMES; s++)
        names[count++] = machine->states[s].name;
    for (uint32_t o = 0; o < machine->outer_count && count < MOST_NAMES; o++)
        names[count++] = machine->outer[o].name;
    const char *now = jox_machine_renamed(machine, JOX_PART_STATE, name);
    if (now) {
        jox_error(error, JO_INPUT, "'%.60s' of %.60s is called '%.60s' now", name, machine->name,
                  now);
        return false;
    }
    char kind[100];
    snprintf(kind, sizeof kind, "state of %.60s named", machine->name);
    return refuse_unknown(kind, name, names, count, error);
}

bool jox_run_choose_parameter(const JoScene *scene, const char *machine, const char *state,
                              const char *parameter, double value, JoxParameterChoice *out,
                              JoError *error) {
    const JoxMachineRun *machines = &scene->world->machines;
    if (!find_machine_named(machines, machine, out, error) ||
        !find_state_named(machines->set->items[out->machine], state, out, error))
        return false;
    out->parameter = jox_parameter_find(parameter);
    if (out->parameter < 0) {
        const char *names[JOX_PARAM_COUNT], *successor = jox_parameter_successor(parameter);
        if (successor) {
            jox_error(error, JO_INPUT, "there is no parameter '%s'. %s", parameter, successor);
            return false;
        }
        for (int p = 0; p < JOX_PARAM_COUNT; p++)
            names[p] = jox_parameters[p].name;
        return refuse_unknown("parameter", parameter, names, JOX_PARAM_COUNT, error);
    }
    const JoxParameterInfo *info = &jox_parameters[out->parameter];
    if (value >= info->least && value <= info->greatest)
        return true;
    jox_error(error, JO_INPUT, "%s must be from %g to %g%s%s, not %g", info->name, info->least,
              info->greatest, *info->unit ? " " : "", info->unit, value);
    return false;
}

bool jox_run_set_parameter(JoScene *scene, const char *machine, const char *state,
                           const char *parameter, double value, JoError *error) {
    JoxParameterChoice choice;
    if (!jox_run_choose_parameter(scene, machine, state, parameter, value, &choice, error))
        return false;
    jox_run_hold_machines(scene, choice.machine, true);
    jox_machines_set_parameter(&scene->world->machines, choice.machine, choice.state,
                               choice.parameter, value);
    jox_run_hold_machines(scene, choice.machine, false);
    return true;
}
