/* Lists the mods of a scene (jo_mods_list), and turns mods on and off (jo_mods_enable). */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/format/path.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/result_block.h"
#include "base/zip.h"
#include "run/messages.h"
#include "run/read_scene.h"
#include "scene/mods_enabled.h"

/* ---- the list ---- */

enum { HEAD, ITEMS, PATCHES, SETTINGS }; /* parts of a pack */

static void add_patches(JoxPack *pack, const JoxMod *mod) {
    for (uint32_t p = 0; p < mod->patch_count; p++) {
        JoModPatch *patch = jox_pack_add(pack, PATCHES, sizeof *patch);
        patch->behaviour = mod->patches[p].lua;
        patch->replaces = mod->patches[p].replaces;
        jox_pack_text(pack, PATCHES, &patch->target,
                      mod->patches[p].target ? mod->patches[p].target : "");
    }
}

static void add_settings(JoxPack *pack, const JoxMod *mod) {
    for (uint32_t s = 0; s < mod->setting_count; s++) {
        const JoxModSetting *from = &mod->settings[s];
        JoModSetting *to = jox_pack_add(pack, SETTINGS, sizeof *to);
        static const JoModSettingKind KINDS[] = {[JOX_SETTING_NUMBER] = JO_SETTING_NUMBER,
                                                 [JOX_SETTING_BOOL] = JO_SETTING_BOOL,
                                                 [JOX_SETTING_CHOICE] = JO_SETTING_CHOICE};
        JoxText choices = {0};
        for (uint32_t c = 0; c < from->choice_count; c++)
            jox_text_printf(&choices, "%s\n", from->choices[c]);
        *to = (JoModSetting){.value = from->value,
                             .least = from->least,
                             .greatest = from->greatest,
                             .kind = KINDS[from->kind]};
        jox_pack_text(pack, SETTINGS, &to->text, jox_setting_text(from, from->value));
        jox_pack_text(pack, SETTINGS, &to->choices, choices.data ? choices.data : "");
        jox_text_free(&choices);
        jox_pack_text(pack, SETTINGS, &to->name, from->name);
        jox_pack_text(pack, SETTINGS, &to->unit, from->unit);
        jox_pack_text(pack, SETTINGS, &to->meaning, from->meaning);
    }
}

static void add_listed_mod(JoxPack *pack, const JoxMod *mod, bool taken) {
    static const JoModSwitch SWITCHES[] = {
        [JOX_MOD_OFF] = JO_MOD_OFF, [JOX_MOD_CHANGED] = JO_MOD_CHANGED, [JOX_MOD_ON] = JO_MOD_ON};
    JoMod *item = jox_pack_add(pack, ITEMS, sizeof *item);
    item->on = SWITCHES[mod->on];
    item->taken = taken;
    jox_pack_text(pack, ITEMS, &item->name, mod->name);
    jox_pack_text(pack, ITEMS, &item->version, mod->version);
    jox_pack_text(pack, ITEMS, &item->title, mod->title);
    jox_pack_text(pack, ITEMS, &item->folder, mod->folder);
    if (!taken)
        return;
    item->patch_count = mod->patch_count;
    item->setting_count = mod->setting_count;
    jox_pack_list(pack, ITEMS, &item->patches, PATCHES);
    jox_pack_list(pack, ITEMS, &item->settings, SETTINGS);
    add_patches(pack, mod);
    add_settings(pack, mod);
}

JoMods *jo_mods_list(const JoSceneDef *def) {
    JOX_REQUIRE(def && jox_run_is_def_whole(def), NULL);
    JOX_GUARD (NULL, NULL)
        return NULL;
    JoxDiagnostics diagnostics = {0};
    JoxPack pack = {0};
    JoxMods *mods = jox_run_find_mods(def, 0, &diagnostics);
    JoMods *head = jox_pack_add(&pack, HEAD, sizeof *head);
    jox_pack_list(&pack, HEAD, &head->items, ITEMS);
    for (uint32_t m = 0; m < mods->count; m++)
        add_listed_mod(&pack, &mods->items[m], true);
    for (uint32_t f = 0; f < mods->found_count; f++) {
        bool taken = false;
        for (uint32_t m = 0; m < mods->count; m++)
            taken |= mods->found_index[m] == f;
        if (!taken)
            add_listed_mod(&pack, &mods->found[f], false);
    }
    head->taken = mods->count;
    head->count = (uint32_t)(jox_pack_length(&pack, ITEMS) / sizeof(JoMod));
    head->errors = (uint32_t)diagnostics.errors;
    jox_mods_free(mods);
    jox_run_report_diagnostics(def->message, def->message_context, &diagnostics, NULL);
    return jox_disown(jox_pack_end(&pack));
}

/* ---- on and off ---- */

/* Whether a mod lies in a folder, or in an archive, in which it may be a folder. */
static bool is_mod_folder(const char *folder, const char *given) {
    const char *inside;
    return jox_path_same(folder, given) ||
           (jox_zip_split(given, &inside) && !*inside && jox_path_below(folder, given));
}

/* Turns a mod on or off, given by its name or folder, if the scene at a path would find it; `scene`
   may be NULL. Sets *found if it does. */
static bool switch_mod(const char *scene, const char *mod, bool on, bool *found, JoError *error) {
    const JoSceneDef def = {
        .path = scene, .mods = &mod, .mod_count = 1, .named_mods_only = true, .message = NULL};
    JoxDiagnostics problems = {0};
    JoxText why = {0};
    JoxMods *mods = jox_run_find_mods(&def, 0, &problems);
    const JoxMod *one = NULL;
    const bool folder = jox_is_folder(mod);
    for (uint32_t m = 0; m < mods->found_count && !one; m++) {
        const JoxMod *candidate = &mods->found[m];
        if (folder ? is_mod_folder(candidate->folder, mod) : strcmp(candidate->name, mod) == 0)
            one = candidate;
    }
    *found = one != NULL;
    const bool good = one && jox_mods_set_enabled(one->name, one->folder, on, &why);
    if (one && !good)
        jox_error(error, JO_FAILED, "%s", why.data);
    else if (folder && !one) /* its mod.yaml is wrong */
        jox_run_report_diagnostics(NULL, NULL, &problems, error);
    jox_text_free(&why);
    jox_mods_free(mods);
    jox_diag_free(&problems);
    return good;
}

/* Returns a suggestion for a misspelt mod, from those that scenes at the places would find, or
   NULL. */
static const char *suggest_mod(const char *const places[3], const char *mod, char hint[JOX_HINT]) {
    const char *near = NULL;
    for (int p = 0; p < 3 && !near; p++) {
        const JoSceneDef def = {.path = places[p], .named_mods_only = true};
        const char *names[JOX_MOST_MODS];
        JoxDiagnostics problems = {0};
        JoxMods *mods = jox_run_find_mods(&def, 0, &problems);
        for (uint32_t m = 0; m < mods->found_count; m++)
            names[m] = mods->found[m].name;
        near = jox_did_you_mean(mod, names, mods->found_count, hint);
        jox_mods_free(mods);
        jox_diag_free(&problems);
    }
    return near;
}

bool jo_mods_enable(const JoSceneDef *def, const char *mod, bool on, JoError *error) {
    JOX_REQUIRE(def && jox_run_is_def_whole(def) && mod, false);
    /* without a scene: the user's mods, then those of scenes in this folder */
    const char *const places[] = {def->path, def->path ? NULL : "./scene",
                                  def->path ? NULL : "scenes/scene"};
    bool found = false;
    *error = (JoError){0};
    for (int p = 0; p < 3; p++)
        if ((p == 0 || places[p]) && switch_mod(places[p], mod, on, &found, error))
            return true;
        else if (found || error->code != JO_OK)
            return false;
    char hint[JOX_HINT];
    const char *near = suggest_mod(places, mod, hint);
    jox_error(error, JO_INPUT, "there is no mod '%.100s' here%s%s", mod, near ? ". " : "",
              near ? near : "; give its folder, or its name and the scene that it lies beside");
    return false;
}
