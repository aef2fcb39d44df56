/* Loads the machines of a scene's groups, and links each state that becomes another machine to it.
   load_scene.c calls it; reload_swap.c links again after a swap. */
#include <stdio.h>
#include <string.h>

#include "base/format/installed.h"
#include "base/format/path.h"
#include "base/mem.h"
#include "base/overlay.h"
#include "run/run.h"
#include "run/scene_machines.h"
#include "run/tags_and_teams.h"

int32_t jox_run_find_machine(const JoScene *scene, const char *path) {
    const JoxMachineSet *set = &scene->world->model.machines;
    for (uint32_t m = 0; m < set->count; m++)
        if (strcmp(set->items[m]->path, path) == 0)
            return (int32_t)m;
    return -1;
}

const char *jox_run_journey_text(const JoxSceneSpec *spec, const char *path) {
    for (uint32_t g = 0; g < spec->group_count; g++)
        for (uint32_t m = 0; m < spec->groups[g].mix_count; m++)
            if (spec->groups[g].mix[m].text && !strcmp(spec->groups[g].mix[m].behaviour, path))
                return spec->groups[g].mix[m].text;
    return NULL;
}

void jox_run_own_set_parameters(const JoxSceneSpec *spec, JoxMachine *machine) {
    for (uint32_t g = 0; g < spec->group_count; g++)
        for (uint32_t m = 0; m < spec->groups[g].mix_count; m++) {
            if (strcmp(spec->groups[g].mix[m].behaviour, machine->path) != 0)
                continue;
            for (uint32_t s = 0; s < spec->groups[g].set_count; s++) {
                const int p = jox_parameter_find(spec->groups[g].set[s].name);
                if (p >= JOX_FIRST_RARE_PARAM)
                    jox_machine_own_parameter(machine, (JoxParameter)p);
            }
        }
}

static int32_t load_machine(JoScene *scene, const char *path, JoxDiagnostics *diagnostics) {
    JoxMachineRun *machines = &scene->world->machines;
    int32_t known = jox_run_find_machine(scene, path);
    if (known >= 0)
        return known;
    if (machines->set->count == JOX_MOST_MACHINES) {
        jox_diag_error(diagnostics, ((JoxPosition){path, 0, 0, 0}), "too-many", NULL,
                       "a scene has at most %d behaviours", JOX_MOST_MACHINES);
        return -1;
    }
    const char *made = jox_run_journey_text(scene->spec, path);
    JoxMachine *machine = jox_lua_load_text(scene->lua, path, made, made ? strlen(made) : 0,
                                            &scene->scope, diagnostics);
    if (!machine)
        return -1;
    jox_run_number_tags_and_teams(scene, machine);
    jox_run_own_set_parameters(scene->spec, machine);
    jox_run_restore_kept_slots(machine);
    return (int32_t)jox_machines_add(machines, machine);
}

/* Finds the file of a behaviour that another names: in a mod, beside it, or in the library. */
static bool find_behaviour_file(const JoScene *scene, const char *from, const char *name,
                                char path[1024]) {
    char shipped[JOX_LONGEST_PATH];
    const char *const folders[] = {"", shipped, NULL};
    snprintf(shipped, sizeof shipped, "%s/behaviours/", jox_data_folder());
    return jox_mod_find(scene->mods->items, scene->mods->count, name, path) ||
           jox_path_find(from, name, ".lua", folders, path);
}

bool jox_run_find_become(const JoScene *scene, const JoxMachine *machine, uint32_t number,
                         char path[1024], JoxDiagnostics *diagnostics) {
    const JoxState *state = &machine->states[number];
    JoxPosition at = {state->become_file, state->become_line, state->become_column, 0};
    if (number == machine->start) {
        jox_diag_error(diagnostics, at, "bad-value", "Begin in another state",
                       "the state that agents start in cannot become another machine at once");
        return false;
    }
    if (!strstr(state->become, "..") && *state->become != '/' &&
        find_behaviour_file(scene, machine->path, state->become, path)) {
        jox_path_clean(path);
        return true;
    }
    jox_diag_error(diagnostics, at, "missing-file",
                   "A plain name: of a file beside this one, or of the library",
                   "there is no behaviour '%.100s' to become", state->become);
    return false;
}

/* Warns of memory that does not go on as it is in the machine that agents of a state become. */
static void compare_memory(const JoxMachine *machine, const JoxState *state, const JoxMachine *next,
                           JoxDiagnostics *diagnostics) {
    const JoxPosition at = {state->become_file, state->become_line, state->become_column, 0};
    for (uint32_t s = 0; s < machine->memory_count; s++) {
        const JoxMemorySlot *was = &machine->memory[s];
        const int32_t slot = jox_machine_memory(next, was->name);
        const JoxMemorySlot *is = slot < 0 ? NULL : &next->memory[slot];
        if (is && is->kind != was->kind)
            jox_diag_warn(diagnostics, at, "other-memory", "Give one of them another name",
                          "memory '%.60s' is of another kind in '%.60s', and begins anew there",
                          was->name, next->name);
        else if (is && is->capacity < was->capacity)
            jox_diag_warn(diagnostics, at, "other-memory", "Give both the same length",
                          "the list '%.60s' holds %u items, and %u in '%.60s': of more, the oldest "
                          "are dropped there",
                          was->name, was->capacity, is->capacity, next->name);
    }
}

bool jox_run_link_becomes(JoScene *scene, JoxMachine *machine, JoxDiagnostics *diagnostics) {
    bool good = true;
    for (uint32_t s = 0; s < machine->state_count; s++) {
        char path[1024];
        if (!machine->states[s].become)
            continue;
        int32_t index = jox_run_find_become(scene, machine, s, path, diagnostics)
                            ? load_machine(scene, path, diagnostics)
                            : -1;
        machine->states[s].become_machine = index;
        if (index >= 0)
            compare_memory(machine, &machine->states[s], scene->world->machines.set->built[index],
                           diagnostics);
        good = good && index >= 0;
    }
    return good;
}

void jox_run_attach_sources(const JoxLuaFile *files, uint32_t count, JoxDiagnostics *diagnostics) {
    for (uint32_t f = 0; f < count; f++) {
        size_t length;
        char *text = jox_read_file(files[f].path, 1 << 20, &length);
        if (text)
            jox_diag_attach_source(diagnostics, files[f].path, text, length);
        jox_free(text);
    }
}

bool jox_run_load_machines(JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoxSceneSpec *spec = scene->spec;
    JoxMachineRun *machines = &scene->world->machines;
    bool good = true;
    for (uint32_t g = 0; g < spec->group_count; g++)
        for (uint32_t m = 0; m < spec->groups[g].mix_count; m++) {
            const char *path = spec->groups[g].mix[m].behaviour;
            bool failed_before = false;
            for (uint32_t h = 0; h <= g; h++)
                for (uint32_t k = 0; k < (h == g ? m : spec->groups[h].mix_count); k++)
                    failed_before |= !strcmp(spec->groups[h].mix[k].behaviour, path);
            if (failed_before || load_machine(scene, path, diagnostics) >= 0)
                continue;
            good = false;
        }
    for (uint32_t m = 0; m < machines->set->count; m++) /* the count grows in this loop */
        good &= jox_run_link_becomes(scene, machines->set->built[m], diagnostics);
    for (uint32_t m = 0; good && m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->built[m];
        const size_t before = diagnostics->count;
        uint32_t count;
        const JoxLuaFile *files = jox_lua_files(scene->lua, machine, &count);
        jox_run_check_tags_and_teams(scene, machine, files, count,
                                     (const JoxMachine *const *)machines->set->built,
                                     machines->set->count, diagnostics);
        if (diagnostics->count > before)
            jox_run_attach_sources(files, count, diagnostics);
    }
    return good && diagnostics->errors == 0;
}
