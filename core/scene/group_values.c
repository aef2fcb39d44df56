/* Reads the values that a group gives its agents: parameters, own values, memory. */
#include <stdlib.h>
#include <string.h>

#include "agents/parameters.h"
#include "base/assert.h"
#include "scene/scene_draft.h"

/* Whether the bounds or choices of a distribution, or its middle if it has none, lie in the range
   of the parameter that it sets; reports an error if not. */
static bool check_parameter_range(const JoxReader *r, const JoxGroupValue *set,
                                  const JoxYaml *value) {
    int parameter = jox_parameter_find(set->name);
    const JoxDist *dist = &set->dist;
    if (parameter < 0 || set->kind != JOX_SET_NUMBER)
        return true;
    const JoxParameterInfo *info = &jox_parameters[parameter];
    bool choose = dist->kind == JOX_DIST_CHOOSE;
    int count = choose ? dist->choices : dist->kind == JOX_DIST_UNIFORM ? 2 : 1;
    for (int i = 0; i < count; i++) {
        double v = choose ? dist->values[i] : jox_dist_middle(dist);
        if (dist->kind == JOX_DIST_UNIFORM)
            v = i ? dist->b : dist->a;
        if (v >= info->least && v <= info->greatest)
            continue;
        jox_scene_error(r, value, "out-of-range", NULL, "%s must be from %g to %g %s, not %g",
                        set->name, info->least, info->greatest, info->unit, v);
        return false;
    }
    return true;
}

/* Whether a text is meant as a number: it begins with one, or is "nan" or "inf". */
static bool looks_like_number(const char *text) {
    char *end;
    strtod(text, &end);
    return end != text && (*end == 0 || text[strcspn(text, "0123456789")] != 0);
}

/* Reads a word for a parameter's value, as in haste: keen; false if it is none. */
static bool read_parameter_word(const JoxYaml *value, JoxGroupValue *set) {
    double level;
    int parameter = jox_parameter_find(set->name);
    if (parameter < 0 || value->kind != JOX_YAML_SCALAR ||
        !jox_parameter_level((JoxParameter)parameter, value->text, &level))
        return false;
    set->dist = jox_dist_constant(level);
    return true;
}

/* Returns whether values of a parameter have words. */
static bool has_parameter_words(const char *name) {
    const int parameter = jox_parameter_find(name);
    return parameter >= 0 && jox_parameter_word((JoxParameter)parameter, 0);
}

/* Reports a word that a parameter does not have, with those that it has. */
static void report_parameter_word(const JoxReader *r, const JoxYaml *value, const char *name) {
    const int parameter = jox_parameter_find(name);
    JoxText words = {0};
    const char *word;
    jox_text_add(&words, "Write ");
    for (uint32_t n = 0; (word = jox_parameter_word((JoxParameter)parameter, n)); n++)
        jox_text_printf(&words, "%s, ", word);
    jox_text_printf(&words, "or a number from %g to %g", jox_parameters[parameter].least,
                    jox_parameters[parameter].greatest);
    jox_scene_error(r, value, "bad-value", words.data, "%s has no value '%.60s'", name,
                    value->text);
    jox_text_free(&words);
}

/* Reads a parameter's number with a unit, as in speed: 5 km/h; false if it is none. */
static bool read_parameter_quantity(const JoxReader *r, const JoxYaml *value, JoxGroupValue *set) {
    const int parameter = jox_parameter_find(set->name);
    double number;
    if (parameter < 0 || value->kind != JOX_YAML_SCALAR || !looks_like_number(value->text) ||
        value->text[strcspn(value->text, " ")] == 0)
        return false;
    set->dist = jox_dist_constant(0.0);
    if (jox_read_number(r, value, jox_parameters[parameter].unit, &number))
        set->dist = jox_dist_constant(number);
    return true;
}

/* Reads one value of a map: a number, a distribution, true or false, or a place; false with an
   error. */
static bool read_group_value(const JoxReader *r, const JoxYaml *value, bool numbers_only,
                             JoxGroupValue *set) {
    const JoxSceneSpec *s = r->draft->scene;
    const size_t errors = r->diagnostics->errors;
    bool flag = value->kind == JOX_YAML_SCALAR &&
                (!strcmp(value->text, "true") || !strcmp(value->text, "false"));
    if (flag)
        set->dist = jox_dist_constant(!strcmp(value->text, "true"));
    else if (read_parameter_word(value, set) || read_parameter_quantity(r, value, set))
        return r->diagnostics->errors == errors;
    else if (jox_read_dist(r, value, &set->dist))
        return r->diagnostics->errors == errors; /* a malformed distribution is an error */
    else if (numbers_only || value->kind != JOX_YAML_SCALAR ||
             (looks_like_number(value->text) &&
              jox_place_find(s->places, s->place_count, value->text) < 0)) {
        jox_scene_error(r, value, "bad-type", "uniform(0, 6)",
                        "this must be a finite number without a unit, or a distribution");
        return false;
    } else if (has_parameter_words(set->name)) {
        report_parameter_word(r, value, set->name);
        return false;
    } else {
        set->kind = strcmp(value->text, "antipode") ? JOX_SET_PLACE : JOX_SET_ANTIPODE;
        if (set->kind == JOX_SET_PLACE)
            set->place = jox_scene_find_place(r, value);
    }
    return set->kind != JOX_SET_PLACE || set->place >= 0;
}

/* Reads a map of names to values. Places are allowed if the key's content is "value*". */
void jox_key_read_values(const JoxReader *r, const JoxKey *key, const JoxYaml *map, void *item) {
    const bool numbers_only = strcmp(key->content, "value*") != 0;
    uint32_t *count = JOX_MEMBER(uint32_t, item, key->count_offset);
    *count = 0;
    if (map && map->kind != JOX_YAML_MAP)
        jox_scene_error(r, map, "bad-type", NULL, "%s maps names to values", key->name);
    if (!map || map->kind != JOX_YAML_MAP)
        return;
    JoxGroupValue *sets = jox_arena_take(r->arena, map->count, sizeof *sets);
    *JOX_MEMBER(JoxGroupValue *, item, key->offset) = sets;
    for (uint32_t i = 0; i < map->count; i++) {
        JoxGroupValue *set = &sets[*count];
        *set = (JoxGroupValue){.name = jox_arena_text(r->arena, map->keys[i]),
                               .position = map->key_positions[i]};
        *count += read_group_value(r, map->items[i], numbers_only, set) &&
                  check_parameter_range(r, set, map->items[i]);
    }
    JOX_ASSERT(*count <= map->count);
}
