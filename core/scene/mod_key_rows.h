/* Rows of the table of keys (key_table.c, with its macros) of a mod's mod.yaml. */
#ifndef JOX_SCENE_MOD_KEY_ROWS_H
#define JOX_SCENE_MOD_KEY_ROWS_H

/* clang-format off */
#define JOX_MOD_KEY_ROWS \
    {"mod", "name", TEXT, "", 0, 0, "!", TO(JoxMod, name), .meaning = "name of the mod: lower-case letters, digits, - and _"}, \
    {"mod", "title", TEXT, "", 0, 0, "", TO(JoxMod, title), .meaning = "title for people"}, \
    {"mod", "version", TEXT, "", 0, 0, "!", TO(JoxMod, version), .meaning = "three numbers: 1.2.0"}, \
    {"mod", "api", WHOLE, "", 1, 1, "!", CHECKED, .meaning = "version of the engine's interface for mods"}, \
    {"mod", "depends", NAMES, "", 0, 0, "", EARLIER, .meaning = "mods that it needs, which come before it: NAME, or \"NAME >= 1.2\""}, \
    {"mod", "optional", NAMES, "", 0, 0, "", EARLIER, .meaning = "mods that it uses if they are applied, which come before it"}, \
    {"mod", "conflicts", NAMES, "", 0, 0, "", EARLIER, .meaning = "mods that cannot be applied together with it"}, \
    {"mod", "load_after", NAMES, "", 0, 0, "", EARLIER, .meaning = "mods that come before it if they are applied"}, \
    {"mod", "settings", TABLE, "", 0, 0, "", READ(jox_key_read_settings), .content = "setting*", .meaning = "values that a scene may choose for it"}, \
    {"setting", "value", TEXT, "", 0, 0, "!", TO(JoxModSetting, written), .content = "plain", .meaning = "value, unless the scene or --set gives another; its kind is that of the setting"}, \
    {"setting", "choices", NAMES, "", 0, 0, "", READ(jox_key_read_setting_choices), .meaning = "the texts of which the value is one"}, \
    {"setting", "unit", TEXT, "", 0, 0, "", TO(JoxModSetting, unit), .meaning = "unit of a number, as m/s"}, \
    {"setting", "least", NUMBER, "", -1e12, 1e12, "-1e12", TO(JoxModSetting, least), .meaning = "the smallest number that may be chosen"}, \
    {"setting", "greatest", NUMBER, "", -1e12, 1e12, "1e12", TO(JoxModSetting, greatest), .meaning = "the largest number that may be chosen"}, \
    {"setting", "meaning", TEXT, "", 0, 0, "", TO(JoxModSetting, meaning), .meaning = "what the setting does, in a sentence"},
/* clang-format on */

#endif
