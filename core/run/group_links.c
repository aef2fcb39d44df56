/* Resolves the names that groups use, once: behaviours of mixes, values that are set, teams, tags.
   starting_people.c calls it before the first agents are made; reload_swap.c and reload_scene.c
   call it when machines or the specification were replaced. */
#include "run/group_links.h"

#include <string.h>

#include "base/assert.h"
#include "run/run.h"
#include "run/scene_machines.h"
#include "run/tags_and_teams.h"

static int32_t find_slot(const JoxMachine *machine, const char *name, bool memory) {
    const int32_t slot =
        memory ? jox_machine_memory(machine, name) : jox_machine_own_slot(machine, name);
    return slot < JOX_MOST_GIVEN ? slot : -1;
}

/* Whether a slot of own values takes a place where the value is a number, or the reverse; or a slot
   of memory holds somebody, whom no scene can name. */
static bool has_other_type(const JoxMachine *machine, int32_t slot, const JoxGroupValue *value,
                           bool memory) {
    return memory ? machine->memory[slot].kind >= JOX_MEMORY_SOMEBODY
                  : machine->own[slot].is_place != (value->kind != JOX_SET_NUMBER);
}

/* Finds the slots of values in all machines: an agent may become any of them. A slot of another
   type does not count. */
static void link_values(const JoxMachineSet *set, JoxGroupValue *values, uint32_t count,
                        bool memory) {
    for (uint32_t v = 0; v < count; v++)
        for (uint32_t m = 0; m < set->count; m++) {
            int32_t slot = find_slot(set->items[m], values[v].name, memory);
            if (slot >= 0 && has_other_type(set->items[m], slot, &values[v], memory))
                slot = -1;
            values[v].slots[m] = (uint16_t)(slot + 1);
        }
}

/* Reports each value that a machine has as another type. */
static void check_types(const JoxMachine *machine, const JoxGroupValue *values, uint32_t count,
                        bool memory, JoxSeverity severity, JoxDiagnostics *diagnostics) {
    for (uint32_t v = 0; v < count; v++) {
        const int32_t slot = find_slot(machine, values[v].name, memory);
        if (slot < 0 || !has_other_type(machine, slot, &values[v], memory))
            continue;
        if (memory)
            jox_diag_add(diagnostics, severity, values[v].position, "bad-type",
                         "The behaviour sets it, as set = { prey = nearest \"people\" }", NULL,
                         NULL, "memory '%.60s' of behaviour %s %s, which a scene cannot name",
                         values[v].name, machine->name,
                         machine->memory[slot].kind == JOX_MEMORY_SOMEBODY ? "holds somebody"
                                                                           : "is a list");
        else
            jox_diag_add(diagnostics, severity, values[v].position, "bad-type", NULL, NULL, NULL,
                         "'%.60s' of behaviour %s is a %s%s", values[v].name, machine->name,
                         machine->own[slot].is_place ? "place" : "number",
                         severity == JOX_SEVERITY_ERROR ? "" : ": nobody is given this value");
    }
}

/* Adds the error of a value that a machine has no slot for. */
static void report_unknown(const JoxMachine *machine, const JoxGroupValue *value, bool memory,
                           JoxDiagnostics *diagnostics) {
    const char *names[JOX_MOST_GIVEN];
    char hint[JOX_HINT];
    uint32_t known = memory ? machine->memory_count : machine->own_count;
    known = known < JOX_MOST_GIVEN ? known : JOX_MOST_GIVEN;
    for (uint32_t k = 0; k < known; k++)
        names[k] = memory ? machine->memory[k].name : machine->own[k].name;
    const char *now =
        jox_machine_renamed(machine, memory ? JOX_PART_MEMORY : JOX_PART_OWN, value->name);
    const char *successor = memory ? NULL : jox_parameter_successor(value->name);
    if (now)
        jox_diag_renamed(diagnostics, value->position, value->name, now);
    else
        jox_diag_error(diagnostics, value->position, "unknown-value",
                       successor ? successor : jox_did_you_mean(value->name, names, known, hint),
                       "behaviour %s has no '%.60s'%s", machine->name, value->name,
                       memory ? " in memory" : "");
}

/* Adds an error for each value that a machine of the group's mix does not have, or has as another
   type. */
static void check_values(const JoxMachineSet *set, const JoxGroup *group,
                         const JoxGroupValue *values, uint32_t count, bool memory,
                         JoxDiagnostics *diagnostics) {
    for (uint32_t m = 0; m < group->mix_count; m++) {
        const JoxMachine *machine = set->items[group->mix[m].machine];
        for (uint32_t v = 0; v < count; v++)
            if (find_slot(machine, values[v].name, memory) < 0)
                report_unknown(machine, &values[v], memory, diagnostics);
        check_types(machine, values, count, memory, JOX_SEVERITY_ERROR, diagnostics);
    }
}

static void link_and_check(const JoxMachineSet *set, const JoxGroup *group, JoxGroupValue *values,
                           uint32_t count, bool memory, JoxDiagnostics *diagnostics) {
    link_values(set, values, count, memory);
    if (diagnostics)
        check_values(set, group, values, count, memory, diagnostics);
}

/* Returns the number of a group's team: 1 + the first group of the team; 0: no team. */
static uint16_t find_team(const JoxSceneSpec *spec, const char *team) {
    for (uint32_t g = 0; team && g < spec->group_count; g++)
        if (spec->groups[g].team && strcmp(spec->groups[g].team, team) == 0)
            return (uint16_t)(g + 1);
    return 0;
}

void jox_run_link_groups(JoScene *scene, JoxSceneSpec *spec, JoxDiagnostics *diagnostics) {
    const JoxMachineSet *set = &scene->world->model.machines;
    for (uint32_t g = 0; g < spec->group_count; g++) {
        JoxGroup *group = &spec->groups[g];
        group->team_number = find_team(spec, group->team);
        group->tag_bits =
            jox_run_number_tags(scene, group->tags, group->tag_count, group->position, NULL);
        for (uint32_t m = 0; m < group->mix_count; m++) {
            const int32_t machine = jox_run_find_machine(scene, group->mix[m].behaviour);
            group->mix[m].machine = machine < 0 ? 0 : (uint32_t)machine;
        }
        link_and_check(set, group, group->set, group->set_count, false, diagnostics);
        link_and_check(set, group, group->memory, group->memory_count, true, diagnostics);
        for (uint32_t p = 0; p < group->profile_count; p++)
            link_and_check(set, group, group->profiles[p].set, group->profiles[p].set_count, false,
                           diagnostics);
    }
    for (uint32_t s = 0; s < spec->source_count; s++)
        link_and_check(set, &spec->groups[spec->sources[s].like], spec->sources[s].memory,
                       spec->sources[s].memory_count, true, diagnostics);
}

static const JoxMachine *find_loaded(const JoxMachine *const *machines, uint32_t count,
                                     const char *path) {
    for (uint32_t m = 0; m < count; m++)
        if (strcmp(machines[m]->path, path) == 0)
            return machines[m];
    return NULL;
}

void jox_run_check_value_types(const JoxSceneSpec *spec, const JoxMachine *const *machines,
                               uint32_t count, JoxSeverity severity, JoxDiagnostics *diagnostics) {
    for (uint32_t g = 0; g < spec->group_count; g++) {
        const JoxGroup *group = &spec->groups[g];
        for (uint32_t m = 0; m < group->mix_count; m++) {
            const JoxMachine *machine = find_loaded(machines, count, group->mix[m].behaviour);
            if (!machine)
                continue;
            check_types(machine, group->set, group->set_count, false, severity, diagnostics);
            for (uint32_t p = 0; p < group->profile_count; p++)
                check_types(machine, group->profiles[p].set, group->profiles[p].set_count, false,
                            severity, diagnostics);
        }
    }
}
