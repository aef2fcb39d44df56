#include "scene/schema.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/name.h"
void jox_scene_error(const JoxReader *reader, const JoxYaml *node, const char *code,
                     const char *hint, const char *format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    jox_diag_error(reader->diagnostics, node->position, code, hint, "%s", text);
}

bool jox_scene_name(const JoxReader *reader, JoxPosition at, const char *what, const char *name) {
    if (jox_name_is_plain(name))
        return true;
    jox_diag_error(reader->diagnostics, at, "bad-name", JOX_NAME_RULE,
                   "'%.60s' is no name for a %s", name, what);
    return false;
}

const char *jox_scene_suggest(const JoxReader *reader, const char *word, const char *const *names,
                              size_t count) {
    if (!jox_diag_has_room(reader->diagnostics, JOX_SEVERITY_ERROR))
        return NULL;
    const char *near = jox_suggest(word, names, count);
    if (!near)
        return NULL;
    char *hint = jox_arena_take(reader->arena, strlen(near) + 24, 1);
    sprintf(hint, "Did you mean '%s'?", near);
    return hint;
}

const JoxKey *jox_key_find(const char *owner, const char *name) {
    for (size_t i = 0; i < jox_scene_key_count; i++)
        if (!strcmp(jox_scene_keys[i].owner, owner) && !strcmp(jox_scene_keys[i].name, name))
            return &jox_scene_keys[i];
    return NULL;
}

bool jox_key_is_table(const char *owner, const char *name) {
    const JoxKey *key = jox_key_find(owner, name);
    return key && key->type == JOX_TYPE_TABLE;
}

bool jox_keys_check(const JoxReader *reader, const JoxYaml *map, const char *owner) {
    if (!map || map->kind != JOX_YAML_MAP) {
        if (map)
            jox_scene_error(reader, map, "bad-type", NULL, "a %s is a map of keys", owner);
        return false;
    }
    const char *names[64];
    size_t count = 0;
    for (size_t i = 0; i < jox_scene_key_count; i++)
        if (!strcmp(jox_scene_keys[i].owner, owner)) {
            names[count++] = jox_scene_keys[i].name;
            if (jox_scene_keys[i].standard[0] == '!' && !jox_yaml_get(map, jox_scene_keys[i].name))
                jox_scene_error(reader, map, "missing-key", jox_scene_keys[i].meaning,
                                "this %s lacks '%s'", owner, jox_scene_keys[i].name);
        }
    for (uint32_t k = 0; k < map->count; k++)
        if (!jox_key_find(owner, map->keys[k])) {
            const char *hint = jox_scene_suggest(reader, map->keys[k], names, count);
            jox_diag_error(reader->diagnostics, map->key_positions[k], "unknown-key", hint,
                           "unknown key '%s' of a %s", map->keys[k], owner);
        }
    return true;
}

static bool check_range(const JoxReader *reader, const JoxYaml *node, const JoxKey *key,
                        double value) {
    if (value >= key->least && value <= key->greatest)
        return true;
    jox_scene_error(reader, node, "out-of-range", NULL, "%s must be from %g to %g%s%s, not %g",
                    key->name, key->least, key->greatest, *key->unit ? " " : "", key->unit, value);
    return false;
}

double jox_key_number(const JoxReader *reader, const JoxYaml *map, const char *owner,
                      const char *name) {
    const JoxKey *key = jox_key_find(owner, name);
    const JoxYaml *node = jox_yaml_get(map, name);
    double standard = *key->standard && *key->standard != '!' ? strtod(key->standard, NULL) : NAN;
    double value;
    if (!node || !jox_read_number(reader, node, key->unit, &value) ||
        !check_range(reader, node, key, value))
        return standard;
    if (key->type == JOX_TYPE_WHOLE && value != floor(value)) {
        jox_scene_error(reader, node, "bad-type", NULL, "%s must be a whole number", name);
        return standard;
    }
    return value;
}

bool jox_key_bool(const JoxReader *reader, const JoxYaml *map, const char *owner,
                  const char *name) {
    const JoxYaml *node = jox_yaml_get(map, name);
    const char *text = node && node->kind == JOX_YAML_SCALAR ? node->text : NULL;
    if (node && (!text || (strcmp(text, "true") && strcmp(text, "false"))))
        jox_scene_error(reader, node, "bad-type", NULL, "%s must be true or false", name);
    return !strcmp(text ? text : jox_key_find(owner, name)->standard, "true");
}

const char *jox_key_text(const JoxReader *reader, const JoxYaml *map, const char *owner,
                         const char *name) {
    const JoxYaml *node = jox_yaml_get(map, name);
    const char *standard = jox_key_find(owner, name)->standard;
    if (node && node->kind != JOX_YAML_SCALAR) {
        jox_scene_error(reader, node, "bad-type", NULL, "%s must be a text", name);
        node = NULL;
    }
    return node ? node->text : *standard && *standard != '!' ? standard : NULL;
}

bool jox_choice_name(const char *choices, int n, char *out, size_t size) {
    for (; n > 0 && choices; n--)
        choices = strchr(choices, '|') ? strchr(choices, '|') + 1 : NULL;
    if (choices)
        snprintf(out, size, "%.*s", (int)strcspn(choices, "|"), choices);
    return choices != NULL;
}

void jox_choices_text(const char *choices, JoxText *out) {
    char name[64], next[64];
    for (int i = 0; jox_choice_name(choices, i, name, sizeof name); i++) {
        bool last = !jox_choice_name(choices, i + 1, next, sizeof next);
        jox_text_printf(out, "%s%s", i == 0 ? "" : last ? " or " : ", ", name);
    }
}

int jox_key_choice(const JoxReader *reader, const JoxYaml *map, const char *owner,
                   const char *name) {
    const JoxKey *key = jox_key_find(owner, name);
    const char *text = jox_key_text(reader, map, owner, name);
    char names[8][64];
    const char *list[8];
    int count = 0;
    for (; count < 8 && jox_choice_name(key->choices, count, names[count], 64); count++) {
        list[count] = names[count];
        if (text && !strcmp(names[count], text))
            return count;
    }
    if (text) {
        JoxText known = {0};
        jox_choices_text(key->choices, &known);
        jox_scene_error(reader, jox_yaml_get(map, name), "bad-value",
                        jox_scene_suggest(reader, text, list, (size_t)count), "%s is %s", name,
                        known.data);
        jox_text_free(&known);
    }
    return -1;
}

bool jox_key_vector(const JoxReader *reader, const JoxYaml *map, const char *owner,
                    const char *name, double *out, int count) {
    const JoxKey *key = jox_key_find(owner, name);
    const JoxYaml *node = jox_yaml_get(map, name);
    if (!node)
        return false;
    if (node->kind != JOX_YAML_LIST || node->count != (uint32_t)count) {
        jox_scene_error(reader, node, "bad-type", count == 2 ? "[x, y]" : "[x, y, z]",
                        "%s must be a list of %d numbers", name, count);
        return false;
    }
    for (int i = 0; i < count; i++)
        if (!jox_read_number(reader, node->items[i], key->unit, &out[i]) ||
            !check_range(reader, node->items[i], key, out[i]))
            return false;
    return true;
}
