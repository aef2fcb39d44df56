/* Values that a scene gives agents: parameters, their own values, their memory. */
#include <stdlib.h>
#include <string.h>

#include "agents/parameters.h"
#include "base/assert.h"
#include "scene/internal.h"

/* Whether all that a distribution gives lies in its parameter's range; of one without bounds, its
   middle. */
static bool parameter_fits(const JoxReader *r, const JoxGroupValue *set, const JoxYaml *value) {
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

/* Whether a text was meant as a number: it begins as one, or is all of "nan" or "inf". */
static bool looks_numeric(const char *text) {
    char *end;
    strtod(text, &end);
    return end != text && (*end == 0 || text[strcspn(text, "0123456789")] != 0);
}

/* A word for a parameter's value: haste is calm, normal or keen. */
static bool read_level(const JoxYaml *value, JoxGroupValue *set) {
    double level;
    int parameter = jox_parameter_find(set->name);
    if (parameter < 0 || value->kind != JOX_YAML_SCALAR ||
        !jox_parameter_level((JoxParameter)parameter, value->text, &level))
        return false;
    set->dist = jox_dist_constant(level);
    return true;
}

/* A parameter's number with its unit: mass: 70 kg, speed: 5 km/h. */
static bool read_quantity(const JoxReader *r, const JoxYaml *value, JoxGroupValue *set) {
    const int parameter = jox_parameter_find(set->name);
    double number;
    if (parameter < 0 || value->kind != JOX_YAML_SCALAR || !looks_numeric(value->text) ||
        value->text[strcspn(value->text, " ")] == 0)
        return false;
    set->dist = jox_dist_constant(0.0);
    if (jox_read_number(r, value, jox_parameters[parameter].unit, &number))
        set->dist = jox_dist_constant(number);
    return true;
}

/* One value of a map; false with an error. */
static bool read_set(const JoxReader *r, const JoxYaml *value, bool numbers_only,
                     JoxGroupValue *set) {
    const JoxSceneSpec *s = r->load->scene;
    const size_t errors = r->diagnostics->errors;
    bool flag = value->kind == JOX_YAML_SCALAR &&
                (!strcmp(value->text, "true") || !strcmp(value->text, "false"));
    if (flag)
        set->dist = jox_dist_constant(!strcmp(value->text, "true"));
    else if (read_level(value, set) || read_quantity(r, value, set))
        return r->diagnostics->errors == errors;
    else if (jox_read_dist(r, value, &set->dist))
        return r->diagnostics->errors == errors; /* else a malformed distribution */
    else if (numbers_only || value->kind != JOX_YAML_SCALAR ||
             (looks_numeric(value->text) &&
              jox_place_find(s->places, s->place_count, value->text) < 0)) {
        jox_scene_error(r, value, "bad-type", "uniform(0, 6)",
                        "this must be a finite number without a unit, or a distribution");
        return false;
    } else {
        set->kind = strcmp(value->text, "antipode") ? JOX_SET_PLACE : JOX_SET_ANTIPODE;
        if (set->kind == JOX_SET_PLACE)
            set->place = jox_load_place(r, value);
    }
    return set->kind != JOX_SET_PLACE || set->place >= 0;
}

/* A map of names to values; places are possible where the key holds "value". */
void jox_key_values(const JoxReader *r, const JoxKey *key, const JoxYaml *map, void *item) {
    const bool numbers_only = strcmp(key->of, "value*") != 0;
    uint32_t *count = JOX_MEMBER(uint32_t, item, key->counter);
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
        *count +=
            read_set(r, map->items[i], numbers_only, set) && parameter_fits(r, set, map->items[i]);
    }
    JOX_ASSERT(*count <= map->count);
}
