/* Finds which files and mods set a path of a scene or of one of its behaviours, for the command
   `mod why` (jo_mods_why). */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/path.h"
#include "base/guard.h"
#include "base/mem.h"
#include "run/load_scene.h"
#include "run/mods/settings.h"
#include "run/read_scene.h"

/* Adds what sets a path of the scene: its own files, then mods, then `--set`; else the default.
   Returns whether anything does. */
static bool add_scene_settings(const JoScene *scene, const char *path, JoxPack *pack) {
    const JoxSceneSpec *spec = scene->spec;
    bool found = jox_scene_visit_own_value(spec, path, jox_settings_add, pack);
    for (uint32_t c = 0; c < spec->changes.count; c++) {
        const JoxPatchChange *change = &spec->changes.items[c];
        const char *rest;
        if (!jox_patch_leads(change, path, &rest))
            continue;
        const JoxMod *mod = &scene->mods->items[change->mod];
        JoxText value = {0};
        if (!change->removes && !jox_scene_print_changed_value(change, rest, &value))
            continue;
        jox_settings_add(pack, &(JoSetting){.by = JO_SET_MOD,
                                            .value = value.data,
                                            .file = change->position.file,
                                            .line = change->position.line,
                                            .column = change->position.column,
                                            .mod = mod->name,
                                            .version = mod->version,
                                            .removes = change->removes});
        jox_text_free(&value);
        found = true;
    }
    found |= jox_scene_visit_set_value(spec, path, jox_settings_add, pack);
    return found || jox_scene_visit_default(spec, path, jox_settings_add, pack);
}

/* Returns the machine with a name, or from a file of that name; NULL if the scene loads none. */
static const JoxMachine *find_named_machine(JoScene *scene, const char *name) {
    const JoxMachineRun *machines = &scene->world->machines;
    name = strchr(name, ':') ? strchr(name, ':') + 1 : name; /* "mod:name" */
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const char *stem = jox_path_name(machines->set->items[m]->path);
        size_t n = strlen(name);
        if (strcmp(machines->set->items[m]->name, name) == 0 ||
            (strncmp(stem, name, n) == 0 && stem[n] == '.'))
            return machines->set->items[m];
    }
    return NULL;
}

/* Reports that nothing sets the path, and suggests a similar name of a behaviour. */
static void report_unset_path(const JoScene *scene, const char *path, const char *name,
                              bool of_behaviour, JoError *error) {
    const JoxMachineRun *machines = &scene->world->machines;
    const char *names[JOX_MOST_MACHINES];
    for (uint32_t m = 0; m < machines->set->count; m++)
        names[m] = machines->set->items[m]->name;
    const char *near = jox_suggest(name, names, machines->set->count);
    near = near && strcmp(near, name) != 0 ? near : NULL; /* the rest of the path is wrong */
    jox_error(error, JO_INPUT,
              of_behaviour ? "nothing sets '%s'; write BEHAVIOUR.STATE.KEY, "
                             "BEHAVIOUR.STATE.TRANSITION.KEY or BEHAVIOUR.defaults.KEY%s%s"
                           : "neither the scene nor a behaviour or a mod sets '%s'%s%s",
              path, near ? "; did you mean " : "", near ? near : "");
}

JoSettings *jo_mods_why(const JoSceneDef *def, const char *path, JoError *error) {
    JOX_REQUIRE(def && jox_run_is_def_whole(def) && def->path && path, NULL);
    JOX_GUARD (NULL, error)
        return NULL;
    JoxDiagnostics diagnostics = {0};
    JoScene *scene = jox_run_load(def, &diagnostics);
    if (!scene) {
        jox_run_report_diagnostics(def->message, def->message_context, &diagnostics, error);
        return NULL;
    }
    char name[128];
    size_t n = strcspn(path, ".");
    snprintf(name, sizeof name, "%.*s", (int)(n < 127 ? n : 127), path);
    const JoxMachine *machine = find_named_machine(scene, name);
    JoxPack pack = {0};
    jox_settings_set_value(&pack, jox_settings_begin(&pack), "");
    const bool found = machine ? path[n] && jox_lua_why(scene->lua, machine, path + n + 1,
                                                        &scene->scope, jox_settings_add, &pack)
                               : add_scene_settings(scene, path, &pack);
    JoSettings *settings = jox_settings_end(&pack);
    if (!found) {
        report_unset_path(scene, path, name, machine != NULL, error);
        jox_free(settings);
        settings = NULL;
    }
    jo_scene_free(scene);
    jox_diag_free(&diagnostics);
    return jox_disown(settings);
}
