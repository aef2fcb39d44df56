/* The groups of a scene become the world's agents. */
#include <string.h>

#include "run/run.h"

/* Names that a group sets must be known to every behaviour of its mix. */
static void check_names(const JoScene *scene, const JoxGroup *group, const JoxGroupValue *sets,
                        uint32_t count, bool memory, JoxDiagnostics *diagnostics) {
    for (uint32_t m = 0; m < group->mix_count; m++) {
        const JoxMachineRun *machines = &scene->world->machines;
        const JoxMachine *machine =
            machines->set->items[jox_world_machine(scene->world, group->mix[m].behaviour)];
        const char *names[256];
        uint32_t known = memory ? machine->memory_count : machine->own_count;
        known = known < 256 ? known : 256;
        for (uint32_t k = 0; k < known; k++)
            names[k] = memory ? machine->memory[k].name : machine->own[k].name;
        for (uint32_t s = 0; s < count; s++) {
            int32_t slot = -1;
            for (uint32_t k = 0; k < known; k++)
                slot = strcmp(names[k], sets[s].name) == 0 ? (int32_t)k : slot;
            bool place = sets[s].kind != JOX_SET_NUMBER;
            const char *near = slot < 0 ? jox_suggest(sets[s].name, names, known) : NULL;
            char hint[96] = "";
            if (near)
                strcat(strcat(strcpy(hint, "Did you mean '"), near), "'?");
            if (slot < 0)
                jox_diag_error(diagnostics, sets[s].position, "unknown-value", near ? hint : NULL,
                               "behaviour %s has no '%.60s'%s", machine->name, sets[s].name,
                               memory ? " in memory" : "");
            else if (!memory && machine->own[slot].is_place != place)
                jox_diag_error(diagnostics, sets[s].position, "bad-type", NULL,
                               "'%.60s' of behaviour %s is a %s", sets[s].name, machine->name,
                               place ? "number" : "place");
        }
    }
}

void jox_run_set_schedule(JoScene *scene, bool anew) {
    const JoxSceneSpec *spec = scene->spec;
    jox_world_set_population(scene->world, spec->groups, spec->group_count, spec->sources,
                             spec->source_count, anew);
    jox_world_set_sinks(scene->world, spec->sinks, spec->sink_count);
    jox_world_set_events(scene->world, spec->events, spec->event_count);
}

bool jox_run_populate(JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoxSceneSpec *spec = scene->spec;
    for (uint32_t g = 0; g < spec->group_count; g++) {
        const JoxGroup *group = &spec->groups[g];
        check_names(scene, group, group->set, group->set_count, false, diagnostics);
        check_names(scene, group, group->memory, group->memory_count, true, diagnostics);
    }
    for (uint32_t s = 0; s < spec->source_count; s++)
        check_names(scene, &spec->groups[spec->sources[s].like], spec->sources[s].memory,
                    spec->sources[s].memory_count, true, diagnostics);
    if (diagnostics->errors)
        return false;
    jox_run_set_schedule(scene, true);
    jox_world_populate(scene->world);
    return true;
}
