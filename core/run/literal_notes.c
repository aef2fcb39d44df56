/* Looks for settings that have no effect in literal mode. Every load of a scene adds the notes;
   reports add them too. */
#include <string.h>

#include "run/literal_notes.h"
#include "run/run.h"

/* Returns where a machine sets a parameter: in its defaults, or in the first such state. NULL: it
   does not. */
static const JoxValue *find_machine_value(const JoxMachine *machine, JoxParameter parameter) {
    if (machine->defaults[parameter].line != 0)
        return &machine->defaults[parameter];
    for (uint32_t s = 0; s < machine->state_count; s++)
        if (machine->states[s].param[parameter].kind != JOX_VALUE_UNSET)
            return &machine->states[s].param[parameter];
    return NULL;
}

/* Returns the value by which a group or profile sets a parameter, or NULL. */
static const JoxGroupValue *find_set_value(const JoxGroupValue *set, uint32_t count,
                                           JoxParameter parameter) {
    for (uint32_t s = 0; s < count; s++)
        if (strcmp(set[s].name, jox_parameters[parameter].name) == 0)
            return &set[s];
    return NULL;
}

/* Finds where behaviours, or else groups of the scene, set a parameter first. Returns false if none
   does. */
static bool find_first_setting(const JoScene *scene, JoxParameter parameter, JoxPosition *out) {
    const JoxMachineSet *machines = &scene->world->model.machines;
    for (uint32_t m = 0; m < machines->count; m++) {
        const JoxMachine *machine = machines->items[m];
        const JoxValue *value = find_machine_value(machine, parameter);
        if (value) {
            *out = (JoxPosition){jox_machine_file(machine, value->source), value->line, 0, 0};
            return true;
        }
    }
    for (uint32_t g = 0; g < scene->spec->group_count; g++) {
        const JoxGroup *group = &scene->spec->groups[g];
        const JoxGroupValue *value = find_set_value(group->set, group->set_count, parameter);
        for (uint32_t p = 0; p < group->profile_count && !value; p++)
            value = find_set_value(group->profiles[p].set, group->profiles[p].set_count, parameter);
        if (value) {
            *out = value->position;
            return true;
        }
    }
    return false;
}

void jox_run_note_literal(const JoScene *scene, JoxDiagnostics *diagnostics) {
    JoxPosition position;
    for (int p = 0; scene->spec->literal && p < JOX_PARAM_COUNT; p++)
        if (!jox_parameter_acts_in_literal((JoxParameter)p) &&
            find_first_setting(scene, (JoxParameter)p, &position))
            jox_diag_note(diagnostics, position, "literal-unused",
                          "'%s' has no effect in literal mode, as no equation of the paper has it",
                          jox_parameters[p].name);
}
