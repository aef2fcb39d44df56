/* Changes a setting of a mod, as an input log, a page or a program asks. input_actions.c calls it.
 */
#include "run/mod_setting.h"

#include <string.h>

#include "run/reload_batch.h"

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
    const JoxModSetting *setting = jox_setting_of(scene, &change);
    change.before = setting->shown;
    if (!jox_setting_parse(setting, value, &change.value, &why)) {
        jox_error(error, JO_INPUT, "setting '%s' of mod %s %s", name, mod, why.data);
        jox_text_free(&why);
        return false;
    }
    return jox_run_reload_setting(scene, &change, error);
}
