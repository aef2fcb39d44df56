/* Changes of settings of mods that go live with a batch of reloaded behaviours, or are taken back.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "run/input_log.h"
#include "run/reload_batch.h"

JoxModSetting *jox_setting_of(const JoScene *scene, const JoxSettingChange *change) {
    return &scene->mods->items[change->mod].settings[change->setting];
}

/* Writes the path that stands for the settings of a mod; no file has it. */
void jox_setting_path(const JoScene *scene, uint32_t mod, char path[JOX_LONGEST_PATH]) {
    snprintf(path, JOX_LONGEST_PATH, "%.900s/settings/", scene->mods->items[mod].folder);
}

void jox_setting_revert(JoxReload *r, const JoxSettingChange *change) {
    char path[JOX_LONGEST_PATH];
    jox_setting_path(r->scene, change->mod, path);
    jox_changes_forget_file(&r->changes, path);
    jox_setting_of(r->scene, change)->value = change->before;
}

/* Writes a value as an input log has it. */
static void write_value(const JoxModSetting *setting, double value, JoxText *out) {
    char number[32];
    snprintf(number, sizeof number, "%.15g", value);
    if (strtod(number, NULL) != value) /* read back, a run goes the same way */
        snprintf(number, sizeof number, "%.17g", value);
    jox_text_add(out,
                 setting->kind == JOX_SETTING_NUMBER ? number : jox_setting_text(setting, value));
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
