/* Mods of a scene: found, asked about, and blamed. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "run/run.h"

enum { LARGEST_PATCH = 256 << 10 };

/* What a mod's Lua files change: known to lua/, which alone reads that language. False with an
   error where that is nothing. */
static bool name_target(JoxModPatch *patch, JoxDiagnostics *diagnostics) {
    size_t length;
    char *text = jox_read_file(patch->path, LARGEST_PATCH, &length);
    char target[128];
    int line = 0, column = 0;
    if (text && jox_lua_patch_target(text, length, target, &patch->replaces, &line, &column)) {
        patch->target = jox_strdup(target);
        patch->position =
            (JoxPosition){patch->path, line, column, column + (int)strlen(target) + 2};
    } else {
        jox_diag_error(diagnostics, ((JoxPosition){patch->path, 0, 0, 0}), "no-patch",
                       "End the file with: return patch \"NAME\" { ... }",
                       text ? "this file names no behaviour that it changes"
                            : "this file cannot be read, or is over 256 KB");
    }
    jox_free(text);
    return patch->target != NULL;
}

JoxMods *jox_run_find_mods(const JoSceneDef *def, uint64_t without, JoxDiagnostics *diagnostics) {
    JoxModsDef find = {.named = def->mods,
                       .named_count = (uint32_t)def->mod_count,
                       .scene = def->path,
                       .sets = def->overrides,
                       .set_count = (uint32_t)def->override_count,
                       .named_only = def->named_mods_only,
                       .without = without};
    for (JoxDiagnostics targets = {0};;) {
        JoxDiagnostics found = {0};
        JoxMods *mods = jox_mods_find(&find, &found);
        uint64_t broken = 0;
        for (uint32_t m = 0; m < mods->count; m++)
            for (uint32_t p = 0; p < mods->items[m].patch_count; p++)
                if (mods->items[m].patches[p].lua &&
                    !name_target(&mods->items[m].patches[p], &targets))
                    broken |= (uint64_t)1 << mods->number[m];
        if (!broken) {
            jox_diag_move(diagnostics, &found);
            jox_diag_move(diagnostics, &targets);
            return mods;
        }
        jox_diag_free(&found);
        jox_mods_free(mods);
        find.without |= broken; /* and those that need it */
    }
}

char *jo_mods_list(const JoSceneDef *def) {
    JOX_REQUIRE(def, NULL);
    JOX_GUARD (NULL, NULL)
        return NULL;
    JoxDiagnostics diagnostics = {0};
    JoxMods *mods = jox_run_find_mods(def, 0, &diagnostics);
    JoxText out = {0};
    for (uint32_t m = 0; m < mods->count; m++) {
        const JoxMod *mod = &mods->items[m];
        jox_text_printf(&out, "%u. %s %s%s%s (%s)\n", m + 1, mod->name, mod->version,
                        *mod->title ? ": " : "", mod->title, mod->folder);
        for (uint32_t p = 0; p < mod->patch_count; p++)
            jox_text_printf(&out, "     %s %s %s\n",
                            mod->patches[p].replaces ? "replaces" : "patches",
                            mod->patches[p].lua ? "behaviour" : "scene",
                            mod->patches[p].target ? mod->patches[p].target : "?");
        for (uint32_t s = 0; s < mod->setting_count; s++) {
            const JoxModSetting *set = &mod->settings[s];
            jox_text_printf(&out, "     %s = %g %s (%g to %g)%s%s\n", set->name, set->value,
                            set->unit, set->least, set->greatest, *set->meaning ? ": " : "",
                            set->meaning);
        }
    }
    for (uint32_t f = 0; f < mods->found_count; f++) {
        bool taken = false;
        for (uint32_t m = 0; m < mods->count; m++)
            taken |= mods->number[m] == f;
        if (!taken)
            jox_text_printf(&out, "not taken: %s %s%s%s (%s)\n", mods->found[f].name,
                            mods->found[f].version, *mods->found[f].title ? ": " : "",
                            mods->found[f].title, mods->found[f].folder);
    }
    if (mods->found_count == 0)
        jox_text_add(&out, "no mods found\n");
    jox_diag_print(&diagnostics, &out);
    jox_diag_free(&diagnostics);
    jox_mods_free(mods);
    return jox_disown(out.data);
}

/* ---- why ---- */

/* Who set a path of the scene: its own file, then mods. */
static bool why_scene(const JoScene *scene, const char *path, JoxText *out) {
    const JoxSceneSpec *spec = scene->spec;
    bool found = false;
    for (uint32_t c = 0; c < spec->change_count; c++) {
        const JoxSceneChange *change = &spec->changes[c];
        size_t n = strlen(change->path);
        if (strncmp(change->path, path, n) != 0 || (n && path[n] && path[n] != '.'))
            continue;
        const JoxMod *mod = &scene->mods->items[change->mod];
        jox_text_printf(out, "  %s:%d:%d: %s   (mod %s %s)\n", change->position.file,
                        change->position.line, change->position.column,
                        change->removes ? "taken away" : "set", mod->name, mod->version);
        found = true;
    }
    return found;
}

/* The behaviour that the first part of a path names: loaded by the scene, or a file beside it. */
static const JoxMachine *find_behaviour(JoScene *scene, const char *name) {
    const JoxMachineRun *machines = &scene->world->machines;
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const char *path = machines->set->items[m]->path, *slash = strrchr(path, '/');
        const char *stem = slash ? slash + 1 : path;
        size_t n = strlen(name);
        if (strcmp(machines->set->items[m]->name, name) == 0 ||
            (strncmp(stem, name, n) == 0 && stem[n] == '.'))
            return machines->set->items[m];
    }
    return NULL;
}

char *jo_mods_why(const JoSceneDef *def, const char *path, JoError *error) {
    JOX_REQUIRE(def && def->path && path, NULL);
    JOX_GUARD (NULL, error)
        return NULL;
    JoxDiagnostics diagnostics = {0};
    JoxText out = {0};
    JoScene *scene = jox_run_load(def, &diagnostics);
    if (!scene) {
        jox_run_report(def->message, def->message_context, &diagnostics, error);
        return NULL;
    }
    char name[128];
    size_t n = strcspn(path, ".");
    snprintf(name, sizeof name, "%.*s", (int)(n < 127 ? n : 127), path);
    const JoxMachine *machine = find_behaviour(scene, name);
    jox_text_printf(&out, "%s\n", path);
    bool found =
        machine ? path[n] && jox_lua_why(scene->lua, machine, path + n + 1, &scene->scope, &out)
                : why_scene(scene, path, &out);
    if (!found) {
        const JoxMachineRun *machines = &scene->world->machines;
        const char *names[JOX_MOST_MACHINES];
        for (uint32_t m = 0; m < machines->set->count; m++)
            names[m] = machines->set->items[m]->name;
        const char *near = jox_suggest(name, names, machines->set->count);
        jox_error(error, JO_INPUT,
                  machine ? "nothing sets '%s'; write BEHAVIOUR.STATE.KEY, "
                            "BEHAVIOUR.STATE.TRANSITION.KEY or BEHAVIOUR.defaults.KEY%s%s"
                          : "neither a behaviour nor a mod sets '%s'%s%s",
                  path, near ? "; did you mean " : "", near ? near : "");
        jox_text_free(&out);
    } else {
        jox_text_add(&out, "  the last one counts\n");
    }
    jo_scene_free(scene);
    jox_diag_free(&diagnostics);
    return jox_disown(out.data);
}
