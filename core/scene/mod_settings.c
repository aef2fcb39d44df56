/* Settings of mods: reads them in mod.yaml, and their values in scenes and on the command line. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "scene/mods_parts.h"
#include "scene/scene_draft.h"

enum { MOST_SETTINGS = 64, MOST_CHOICES = 32, LONGEST_CHOICE = 60 };

/* ---- mod.yaml ---- */

void jox_key_read_settings(const JoxReader *r, const JoxKey *key, const JoxYaml *map, void *item) {
    if (map && (map->kind != JOX_YAML_MAP || map->count > MOST_SETTINGS)) {
        jox_scene_error(r, map, "bad-type", "settings: {weight: {value: 80}}",
                        "%s maps at most %d names to settings", key->name, MOST_SETTINGS);
        return;
    }
    const JoxKey items = {.name = key->name,
                          .content = key->content,
                          .offset = offsetof(JoxMod, settings),
                          .count_offset = offsetof(JoxMod, setting_count)};
    jox_key_read_items(r, &items, map, item);
}

void jox_key_read_setting_choices(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                                  void *item) {
    JoxModSetting *s = item;
    const JoxYaml *const *names = NULL;
    s->choice_count = jox_read_names(r, node, &names);
    if (!node)
        return;
    bool good = s->choice_count >= 2 && s->choice_count <= MOST_CHOICES;
    s->choices = jox_arena_take(r->arena, s->choice_count + 1, sizeof *s->choices);
    for (uint32_t c = 0; c < s->choice_count; c++) {
        s->choices[c] = jox_arena_text(r->arena, names[c]->text);
        good &= *names[c]->text && strlen(names[c]->text) <= LONGEST_CHOICE;
        for (uint32_t o = 0; o < c; o++)
            good &= strcmp(s->choices[o], s->choices[c]) != 0;
    }
    if (!good)
        jox_scene_error(r, node, "bad-value", "choices: [polite, rude]",
                        "%s is a list of 2 to %d different texts of at most %d bytes", key->name,
                        MOST_CHOICES, LONGEST_CHOICE);
}

/* Reports keys that only numbers have, of a setting of another kind; whether there are none. */
static bool check_plain_keys(const JoxReader *r, const JoxYaml *map, const JoxModSetting *s) {
    static const char *const OF_NUMBERS[] = {"unit", "least", "greatest"};
    bool good = true;
    for (size_t k = 0; k < sizeof OF_NUMBERS / sizeof *OF_NUMBERS; k++) {
        const JoxYaml *node = jox_yaml_get(map, OF_NUMBERS[k]);
        good &= !node;
        if (node)
            jox_scene_error(r, node, "bad-value", NULL,
                            "'%s' goes with numbers; setting '%s' is %s", OF_NUMBERS[k], s->name,
                            s->kind == JOX_SETTING_BOOL ? "true or false" : "a choice");
    }
    return good;
}

bool jox_finish_setting(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxModSetting *s = item;
    JoxText why = {0};
    const char *written = s->written ? s->written : "";
    s->unit = s->unit ? s->unit : jox_arena_text(r->arena, "");
    s->meaning = s->meaning ? s->meaning : jox_arena_text(r->arena, "");
    s->kind = s->choice_count                                                 ? JOX_SETTING_CHOICE
              : strcmp(written, "true") == 0 || strcmp(written, "false") == 0 ? JOX_SETTING_BOOL
                                                                              : JOX_SETTING_NUMBER;
    if (s->kind != JOX_SETTING_NUMBER)
        good &= check_plain_keys(r, map, s);
    if (good && !jox_setting_parse(s, written, &s->value, &why)) {
        jox_scene_error(r, jox_yaml_get(map, "value"), "bad-value",
                        s->kind == JOX_SETTING_NUMBER
                            ? "A number, true or false, or a text of `choices: [polite, rude]`"
                            : NULL,
                        "setting '%s' %s", s->name, why.data);
        good = false;
    }
    jox_text_free(&why);
    return good;
}

/* ---- values ---- */

/* Reports a value that a setting cannot have. */
static void report_wrong_value(JoxModsFind *f, uint32_t m, const JoxModSetting *s, JoxPosition at,
                               const JoxText *why) {
    jox_diag_error(f->reader.diagnostics, at, "bad-value", *s->meaning ? s->meaning : NULL,
                   "setting '%s' of mod %s %s", s->name, f->mods->found[m].name, why->data);
    f->needs[m].broken = true;
}

static JoxModSetting *find_setting(const JoxMod *mod, const char *name, size_t length) {
    for (uint32_t s = 0; s < mod->setting_count; s++)
        if (strlen(mod->settings[s].name) == length &&
            strncmp(mod->settings[s].name, name, length) == 0)
            return &mod->settings[s];
    return NULL;
}

void jox_mods_read_values(JoxModsFind *f, uint32_t m, const JoxYaml *values) {
    const JoxMod *mod = &f->mods->found[m];
    if (values->kind != JOX_YAML_MAP && !(values->kind == JOX_YAML_SCALAR && !*values->text))
        jox_scene_error(&f->reader, values, "bad-type", "mods: {NAME: {SETTING: 3}}",
                        "the settings of a mod are a map");
    for (uint32_t v = 0; values->kind == JOX_YAML_MAP && v < values->count; v++) {
        const JoxYaml *node = values->items[v];
        JoxModSetting *s = find_setting(mod, values->keys[v], strlen(values->keys[v]));
        JoxText why = {0};
        double number = 0.0;
        char plain[64];
        if (!s) {
            jox_diag_error(f->reader.diagnostics, values->key_positions[v], "unknown-setting", NULL,
                           "mod %s has no setting '%.60s'", mod->name, values->keys[v]);
            continue;
        }
        if (node->kind != JOX_YAML_SCALAR)
            jox_text_add(&why, "takes one value");
        else if (s->kind == JOX_SETTING_NUMBER &&
                 !jox_read_number(&f->reader, node, s->unit, &number))
            continue;
        snprintf(plain, sizeof plain, "%.17g", number);
        if (!why.data && jox_setting_parse(s, s->kind == JOX_SETTING_NUMBER ? plain : node->text,
                                           &s->value, &why))
            s->position = node->position;
        else
            report_wrong_value(f, m, s, node->position, &why);
        jox_text_free(&why);
    }
}

/* Returns the setting that "mods.NAME.SETTING=..." names, and its mod's index; NULL if there is
   none. */
static JoxModSetting *find_overridden(const JoxModsFind *f, const char *set, uint32_t *mod) {
    const char *name = set + strlen("mods.");
    for (*mod = 0; *mod < f->mods->found_count; (*mod)++) {
        const size_t n = strlen(f->mods->found[*mod].name);
        if (strncmp(name, f->mods->found[*mod].name, n) != 0 || name[n] != '.')
            continue;
        JoxModSetting *s =
            find_setting(&f->mods->found[*mod], name + n + 1, strcspn(name + n + 1, "="));
        if (s)
            return s;
    }
    return NULL;
}

void jox_mods_apply_overrides(JoxModsFind *f) {
    for (uint32_t n = 0; n < f->def->set_count; n++) {
        const char *set = f->def->sets[n], *equals = strchr(set, '=');
        if (strncmp(set, "mods.", 5) != 0 || !equals)
            continue;
        const JoxPosition at = {"--set", 1, 1, (int)strlen(set) + 1};
        uint32_t m;
        JoxText why = {0};
        JoxModSetting *s = find_overridden(f, set, &m);
        if (!s)
            jox_diag_error(f->reader.diagnostics, at, "bad-override",
                           "Example: mods.gentle-queue.weight=80",
                           "'%.100s' names no setting of a mod", set);
        else if (jox_setting_parse(s, equals + 1, &s->value, &why))
            s->position = at;
        else
            report_wrong_value(f, m, s, at, &why);
        jox_text_free(&why);
    }
}
