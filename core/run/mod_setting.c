#include "run/mod_setting.h"

#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "run/input_log.h"

static JoxModSetting *get_setting(const JoScene *scene, const JoxSettingChange *change) {
    return &scene->mods->items[change->mod].settings[change->setting];
}

/* Writes the path that stands for the settings of a mod; no file has it. */
static void write_settings_path(const JoScene *scene, uint32_t mod, char path[JOX_LONGEST_PATH]) {
    snprintf(path, JOX_LONGEST_PATH, "%.900s/settings/", scene->mods->items[mod].folder);
}

/* Returns whether a part is made of one of the patches of a mod. */
static bool uses_patches(const JoxFiles *files, const JoxMod *mod) {
    for (uint32_t p = 0; p < mod->patch_count; p++)
        for (uint32_t f = 0; f < files->count; f++)
            if (mod->patches[p].lua && strcmp(files->paths[f], mod->patches[p].path) == 0)
                return true;
    return false;
}

JoxBatch *jox_setting_prepare(JoxReload *r, const JoxSettingChange *change) {
    const JoScene *scene = r->scene;
    char path[JOX_LONGEST_PATH];
    get_setting(scene, change)->value = change->value;
    write_settings_path(scene, change->mod, path);
    for (uint32_t m = 0; m < atomic_load(&r->machine_count); m++)
        if (uses_patches(&r->changes.made_of[m], &scene->mods->items[change->mod])) {
            jox_changes_add_use(&r->changes, m, path);
            jox_changes_add_changed_file(&r->changes, path, 0.0);
        }
    JoxBatch *batch = jox_batch_prepare(r);
    batch = batch ? batch : jox_alloc(1, sizeof *batch);
    batch->sets = true;
    batch->setting = *change;
    return batch;
}

void jox_setting_revert(JoxReload *r, const JoxSettingChange *change) {
    char path[JOX_LONGEST_PATH];
    write_settings_path(r->scene, change->mod, path);
    jox_changes_forget_file(&r->changes, path);
    get_setting(r->scene, change)->value = change->before;
}

/* Writes a value as an input log has it. */
static void write_value(const JoxModSetting *setting, double value, JoxText *out) {
    if (setting->kind == JOX_SETTING_NUMBER)
        jox_text_printf(out, "%.17g", value);
    else
        jox_text_add(out, jox_setting_text(setting, value));
}

/* Keeps the value among the overrides of the scene, for its checkpoints. */
static void keep_override(JoScene *scene, const char *mod, const char *setting, const char *value) {
    JoxText text = {0};
    jox_text_printf(&text, "mods.%s.%s=", mod, setting);
    const char **overrides = (const char **)scene->def.overrides;
    size_t at = 0;
    while (at < scene->def.override_count && strncmp(overrides[at], text.data, text.length) != 0)
        at++;
    jox_text_add(&text, value);
    if (at == scene->def.override_count) {
        const char **more = jox_alloc(at + 2, sizeof *more);
        for (size_t o = 0; o < at; o++)
            more[o] = overrides[o];
        jox_free(overrides);
        scene->def.overrides = overrides = more;
        scene->def.override_count++;
    } else {
        jox_free((char *)overrides[at]);
    }
    overrides[at] = jox_strdup(text.data);
    jox_text_free(&text);
}

void jox_setting_went_live(JoScene *scene, const JoxSettingChange *change) {
    const JoxMod *mod = &scene->mods->items[change->mod];
    JoxModSetting *setting = &mod->settings[change->setting];
    JoxText now = {0}, before = {0};
    setting->shown = change->value;
    scene->settings_changed++;
    write_value(setting, change->value, &now);
    write_value(setting, change->before, &before);
    jox_run_say(scene, "mod %s: %s is %s%s%s from t = %.2f s (it was %s)\n", mod->name,
                setting->name, now.data, *setting->unit ? " " : "", setting->unit,
                jo_world_time(scene->world), before.data);
    keep_override(scene, mod->name, setting->name, now.data);
    JoxInputEntry entry = {.verb = JOX_INPUT_SETTING,
                           .names = {mod->name, setting->name, now.data}};
    jox_run_log_entry(scene, &entry);
    jox_text_free(&now);
    jox_text_free(&before);
}

/* Finds a setting of the scene's mods; false with `error`. */
static bool find_setting(const JoScene *scene, const char *mod, const char *name,
                         JoxSettingChange *change, JoError *error) {
    const char *names[JOX_MOST_MODS + 64], *near;
    char hint[JOX_HINT];
    const JoxMods *mods = scene->mods;
    uint32_t m = 0, s = 0;
    for (; m < mods->count && strcmp(mods->items[m].name, mod) != 0; m++)
        names[m] = mods->items[m].name;
    if (m == mods->count) {
        near = jox_did_you_mean(mod, names, m, hint);
        jox_error(error, JO_INPUT, "the scene has no mod '%.60s'%s%s", mod, near ? ". " : "",
                  near ? near : "");
        return false;
    }
    for (; s < mods->items[m].setting_count && strcmp(mods->items[m].settings[s].name, name) != 0;
         s++)
        names[s] = mods->items[m].settings[s].name;
    if (s == mods->items[m].setting_count) {
        near = jox_did_you_mean(name, names, s, hint);
        jox_error(error, JO_INPUT, "mod %s has no setting '%.60s'%s%s", mod, name, near ? ". " : "",
                  near ? near : "");
        return false;
    }
    *change = (JoxSettingChange){.mod = m, .setting = s};
    return true;
}

bool jox_run_set_mod_setting(JoScene *scene, const char *mod, const char *name, const char *value,
                             JoError *error) {
    JoxSettingChange change;
    JoxText why = {0};
    if (!find_setting(scene, mod, name, &change, error))
        return false;
    const JoxModSetting *setting = get_setting(scene, &change);
    change.before = setting->shown;
    if (!jox_setting_parse(setting, value, &change.value, &why)) {
        jox_error(error, JO_INPUT, "setting '%s' of mod %s %s", name, mod, why.data);
        jox_text_free(&why);
        return false;
    }
    return jox_run_reload_setting(scene, &change, error);
}
