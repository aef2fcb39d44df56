/* The public calls about mods: listed, turned on and off, asked who set what. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/assert.h"
#include "base/format/path.h"
#include "base/guard.h"
#include "base/mem.h"
#include "run/run.h"
#include "scene/mods_on.h"

/* How the list says it of those that are not taken. */
static const char *const SWITCHES[] = {
    [JOX_MOD_OFF] = "off",
    [JOX_MOD_CHANGED] = "off, as it has changed since it was turned on",
    [JOX_MOD_ON] = "on, but not taken",
};

char *jo_mods_list(const JoSceneDef *def) {
    JOX_REQUIRE(def && jox_run_is_whole(def), NULL);
    JOX_GUARD (NULL, NULL)
        return NULL;
    JoxDiagnostics diagnostics = {0};
    JoxMods *mods = jox_run_find_mods(def, 0, &diagnostics);
    JoxText out = {0};
    for (uint32_t m = 0; m < mods->count; m++) {
        const JoxMod *mod = &mods->items[m];
        jox_text_printf(&out, "%u. %s %s%s%s (%s; %s)\n", m + 1, mod->name, mod->version,
                        *mod->title ? ": " : "", mod->title, mod->folder,
                        mod->on == JOX_MOD_ON ? "on" : "named");
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
            jox_text_printf(&out, "%s: %s %s%s%s (%s)\n", SWITCHES[mods->found[f].on],
                            mods->found[f].name, mods->found[f].version,
                            *mods->found[f].title ? ": " : "", mods->found[f].title,
                            mods->found[f].folder);
    }
    if (mods->found_count == 0)
        jox_text_add(&out, "no mods found\n");
    jox_diag_print(&diagnostics, &out);
    jox_diag_free(&diagnostics);
    jox_mods_free(mods);
    return jox_disown(out.data);
}

/* ---- on and off ---- */

/* Turns the mod of the name, or in the folder, on or off, if it is among those that a scene of the
   path (or NULL) would find; *found says whether it is. */
static bool turn(const char *scene, const char *mod, bool on, bool *found, JoError *error) {
    const JoSceneDef def = {
        .path = scene, .mods = &mod, .mod_count = 1, .named_mods_only = true, .message = NULL};
    JoxDiagnostics problems = {0};
    JoxText why = {0};
    JoxMods *mods = jox_run_find_mods(&def, 0, &problems);
    const JoxMod *one = NULL;
    struct stat wanted, other;
    const bool folder = stat(mod, &wanted) == 0 && S_ISDIR(wanted.st_mode);
    for (uint32_t m = 0; m < mods->found_count && !one; m++) {
        const JoxMod *candidate = &mods->found[m];
        if (folder ? stat(candidate->folder, &other) == 0 && other.st_dev == wanted.st_dev &&
                         other.st_ino == wanted.st_ino
                   : strcmp(candidate->name, mod) == 0)
            one = candidate;
    }
    *found = one != NULL;
    const bool good = one && jox_mods_on_set(one->name, one->folder, on, &why);
    if (one && !good)
        jox_error(error, JO_FAILED, "%s", why.data);
    else if (folder && !one) /* its mod.yaml is what is wrong */
        jox_run_report(NULL, NULL, &problems, error);
    jox_text_free(&why);
    jox_mods_free(mods);
    jox_diag_free(&problems);
    return good;
}

bool jo_mods_enable(const JoSceneDef *def, const char *mod, bool on, JoError *error) {
    JOX_REQUIRE(def && jox_run_is_whole(def) && mod, false);
    /* Without a scene: the user's mods, then those of scenes here. */
    const char *const places[] = {def->path, def->path ? NULL : "./scene",
                                  def->path ? NULL : "scenes/scene"};
    bool found = false;
    *error = (JoError){0};
    for (int p = 0; p < 3; p++)
        if ((p == 0 || places[p]) && turn(places[p], mod, on, &found, error))
            return true;
        else if (found || error->code != JO_OK)
            return false;
    jox_error(error, JO_INPUT,
              "there is no mod '%.100s' here; give its folder, or its name and the scene that it "
              "lies beside",
              mod);
    return false;
}

/* ---- why ---- */

/* Who set a path of the scene: its own files, then mods, then `--set`; else the default. */
static bool why_scene(const JoScene *scene, const char *path, JoxText *out) {
    const JoxSceneSpec *spec = scene->spec;
    bool found = jox_scene_why(spec, path, out);
    for (uint32_t c = 0; c < spec->changes.count; c++) {
        const JoxPatchChange *change = &spec->changes.items[c];
        const char *rest;
        if (!jox_patch_leads(change, path, &rest))
            continue;
        const JoxMod *mod = &scene->mods->items[change->mod];
        jox_text_printf(out, "  %s:%d:%d: %s   (mod %s %s)\n", change->position.file,
                        change->position.line, change->position.column,
                        change->removes ? "taken away" : "set", mod->name, mod->version);
        found = true;
    }
    found |= jox_scene_why_set(spec, path, out);
    return found || jox_scene_why_default(spec, path, out);
}

/* The behaviour that the first part of a path names: loaded by the scene, or a file beside it. */
static const JoxMachine *find_behaviour(JoScene *scene, const char *name) {
    const JoxMachineRun *machines = &scene->world->machines;
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const char *stem = jox_path_name(machines->set->items[m]->path);
        size_t n = strlen(name);
        if (strcmp(machines->set->items[m]->name, name) == 0 ||
            (strncmp(stem, name, n) == 0 && stem[n] == '.'))
            return machines->set->items[m];
    }
    return NULL;
}

static uint32_t count_lines(const char *text) {
    uint32_t lines = 0;
    for (; *text; text++)
        lines += *text == '\n';
    return lines;
}

char *jo_mods_why(const JoSceneDef *def, const char *path, JoError *error) {
    JOX_REQUIRE(def && jox_run_is_whole(def) && def->path && path, NULL);
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
                          : "neither the scene nor a behaviour or a mod sets '%s'%s%s",
                  path, near ? "; did you mean " : "", near ? near : "");
        jox_text_free(&out);
    } else if (count_lines(out.data) > 2) { /* the path, and more than one place */
        jox_text_add(&out, "  the last one counts\n");
    }
    jo_scene_free(scene);
    jox_diag_free(&diagnostics);
    return jox_disown(out.data);
}
