#include "scene/schema.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"

#define FAR 10000 /* m: floats still resolve a millimetre */
enum { MOST_POINTS = 5000 };
#define N JOX_TYPE_NUMBER
const JoxKey jox_scene_keys[] = {
    {"scene", "jostle", JOX_TYPE_WHOLE, "", 1, 1, "!", "version of the format"},
    {"scene", "include", JOX_TYPE_NAMES, "", 0, 0, "", "files that give what this one lacks"},
    {"scene", "title", JOX_TYPE_TEXT, "", 0, 0, "", "what people see"},
    {"scene", "seed", JOX_TYPE_WHOLE, "", 0, 9e15, "1", "of all random numbers"},
    {"scene", "step", N, "s", 0.001, 0.2, "0.05", "time step"},
    {"scene", "duration", N, "s", 0, 1e6, "60", "how long a run lasts unless told otherwise"},
    {"scene", "gravity", N, "m/s2", 0, 100, "9.81", "downwards, for bodies"},
    {"scene", "bounds", JOX_TYPE_POINTS, "m", -FAR, FAR, "",
     "[[x, y], [x, y]]: all must lie within"},
    {"scene", "input", JOX_TYPE_TEXT, "", 0, 0, "", "input log that drives player agents"},
    {"scene", "player", JOX_TYPE_TEXT, "", 0, 0, "", "group whose first agent a person drives"},
    {"scene", "forces", JOX_TYPE_TABLE, "", 0, 0, "", "how forces act"},
    {"scene", "limits", JOX_TYPE_TABLE, "", 0, 0, "", "what scripts may use"},
    {"scene", "heatmap", JOX_TYPE_TABLE, "", 0, 0, "", "the area of the density map"},
    {"scene", "camera", JOX_TYPE_TABLE, "", 0, 0, "", "where one looks from"},
    {"scene", "mods", JOX_TYPE_TABLE, "", 0, 0, "", "name: settings; mods that are taken"},
    {"scene", "patch", JOX_TYPE_TEXT, "", 0, 0, "", "in a mod: the scene that this file changes"},
    {"scene", "replace", JOX_TYPE_TEXT, "", 0, 0, "",
     "in a mod: the scene that this file replaces"},
    {"scene", "places", JOX_TYPE_TABLE, "", 0, 0, "", "name: place"},
    {"scene", "regions", JOX_TYPE_TABLE, "", 0, 0, "",
     "name: polygon whose mean speed is measured"},
    {"scene", "walls", JOX_TYPE_LIST, "", 0, 0, "", "static walls"},
    {"scene", "bodies", JOX_TYPE_LIST, "", 0, 0, "", "rigid bodies"},
    {"scene", "groups", JOX_TYPE_TABLE, "", 0, 0, "", "name: group of agents"},
    {"scene", "sources", JOX_TYPE_LIST, "", 0, 0, "", "where agents come in"},
    {"scene", "sinks", JOX_TYPE_LIST, "", 0, 0, "", "where agents leave"},

    {"forces", "enabled", JOX_TYPE_BOOL, "", 0, 0, "true", "false: collision avoidance alone"},
    {"forces", "mode", JOX_TYPE_TEXT, "", 0, 0, "physical", "physical, or literal: as printed"},
    {"limits", "instructions", JOX_TYPE_WHOLE, "", 1000, 1e9, "100000",
     "of one Lua function's call"},
    {"limits", "step_instructions", JOX_TYPE_WHOLE, "", 10000, 1e12, "20000000",
     "of all functions of a behaviour in a step"},
    {"limits", "load_instructions", JOX_TYPE_WHOLE, "", 10000, 1e9, "20000000",
     "of loading one behaviour"},
    {"limits", "memory", N, "MB", 1, 1024, "32", "of one behaviour"},
    {"limits", "block", N, "MB", 0.1, 1024, "2", "of one text or table of a behaviour"},
    {"limits", "source", N, "KB", 1, 16384, "256", "of one Lua file"},
    {"limits", "print", JOX_TYPE_WHOLE, "", 0, 1000, "20",
     "lines that a behaviour may print in a second"},
    {"heatmap", "area", JOX_TYPE_POINTS, "m", -FAR, FAR, "", "[[x, y], [x, y]]"},
    {"heatmap", "from", N, "s", 0, 1e6, "0", "averages begin then"},
    {"camera", "position", JOX_TYPE_POINT3, "m", -FAR, FAR, "", "where the eye is"},
    {"camera", "target", JOX_TYPE_POINT3, "m", -FAR, FAR, "", "what it looks at"},

    {"place", "point", JOX_TYPE_POINT, "m", -FAR, FAR, "", "a point"},
    {"place", "radius", N, "m", 0.01, 1000, "0.5", "of a point: inside is nearer than this"},
    {"place", "line", JOX_TYPE_POINTS, "m", -FAR, FAR, "",
     "two points; crossed from right to left"},
    {"place", "polygon", JOX_TYPE_POINTS, "m", -FAR, FAR, "", "a ring that does not cross itself"},
    {"place", "start", JOX_TYPE_TEXT, "", 0, 0, "", "of a polygon: line from which circuits count"},
    {"place", "queue", JOX_TYPE_POINTS, "m", -FAR, FAR, "", "a polyline, the head first"},
    {"place", "spacing", N, "m", 0.1, 10, "0.5", "of a queue: length that a person takes"},
    {"place", "set", JOX_TYPE_NAMES, "", 0, 0, "", "names of other places"},

    {"wall", "solid", JOX_TYPE_POINTS, "m", -FAR, FAR, "", "a polygon that is filled"},
    {"wall", "line", JOX_TYPE_POINTS, "m", -FAR, FAR, "", "a thin wall along points"},
    {"wall", "closed", JOX_TYPE_BOOL, "", 0, 0, "false", "of a line: joins its ends"},
    {"wall", "height", N, "m", 0.01, 1000, "3", "for bodies"},

    {"body", "name", JOX_TYPE_TEXT, "", 0, 0, "", "for people and messages"},
    {"body", "shape", JOX_TYPE_TABLE, "", 0, 0, "!",
     "one of box, sphere, cylinder, hull, compound"},
    {"body", "mass", N, "kg", 0, 1e7, "", "0 is static"},
    {"body", "density", N, "kg/m3", 0.1, 30000, "", "in place of mass"},
    {"body", "at", JOX_TYPE_POINT3, "m", -FAR, FAR, "!", "centre of the shape"},
    {"body", "turn", N, "deg", -1e4, 1e4, "0", "about the vertical, anti-clockwise"},
    {"body", "velocity", JOX_TYPE_POINT3, "m/s", -100, 100, "", "at the start"},
    {"body", "friction", N, "", 0, 10, "0.6", "multiplied with the other's"},
    {"body", "restitution", N, "", 0, 1, "0", "multiplied with the other's"},
    {"body", "damping", N, "", 0, 1, "0", "share of the velocity lost in a second"},
    {"body", "tags", JOX_TYPE_NAMES, "", 0, 0, "", "what behaviours know it by"},
    {"part", "shape", JOX_TYPE_TABLE, "", 0, 0, "!", "as of a body, but no compound"},
    {"part", "at", JOX_TYPE_POINT3, "m", -FAR, FAR, "", "in the body's frame"},
    {"part", "mass", N, "kg", 0.001, 1e7, "1", "of this part"},
    {"shape", "box", JOX_TYPE_TABLE, "", 0, 0, "", "size: [x, y, z] m"},
    {"shape", "sphere", JOX_TYPE_TABLE, "", 0, 0, "", "radius"},
    {"shape", "cylinder", JOX_TYPE_TABLE, "", 0, 0, "", "radius, height; upright"},
    {"shape", "hull", JOX_TYPE_TABLE, "", 0, 0, "", "points: [[x, y, z], ...]"},
    {"shape", "compound", JOX_TYPE_LIST, "", 0, 0, "", "parts with shape, at and mass"},
    {"box", "size", JOX_TYPE_POINT3, "m", 0.01, 1000, "!", "lengths along x, y, z"},
    {"sphere", "radius", N, "m", 0.01, 100, "!", ""},
    {"cylinder", "radius", N, "m", 0.01, 100, "!", ""},
    {"cylinder", "height", N, "m", 0.01, 100, "!", ""},
    {"hull", "points", JOX_TYPE_LIST, "m", -FAR, FAR, "!", "4 to 256 corners"},

    {"group", "behaviour", JOX_TYPE_TEXT, "", 0, 0, "", "a Lua file"},
    {"group", "mix", JOX_TYPE_VALUES, "", 0, 0, "", "Lua file: weight, in place of behaviour"},
    {"group", "count", JOX_TYPE_WHOLE, "", 1, 1000000, "", "how many agents"},
    {"group", "density", N, "1/m2", 0.001, 20, "", "in place of count"},
    {"group", "at", JOX_TYPE_POINTS, "m", -FAR, FAR, "", "one agent at each point"},
    {"group", "fill", JOX_TYPE_TEXT, "", 0, 0, "random", "grid, hex, random or circle"},
    {"group", "in", JOX_TYPE_NAMES, "", 0, 0, "", "places to fill"},
    {"group", "outside", JOX_TYPE_NAMES, "", 0, 0, "", "places to keep out of"},
    {"group", "spacing", N, "m", 0.05, 100, "", "least distance between agents"},
    {"group", "facing", N, "deg", -1e4, 1e4, "", "anti-clockwise from +x"},
    {"group", "team", JOX_TYPE_TEXT, "", 0, 0, "", "others' teams are opponents"},
    {"group", "party", JOX_TYPE_WHOLE, "", 1, 1000, "1",
     "agents in a row that belong together: each party is a team of its own"},
    {"group", "tags", JOX_TYPE_NAMES, "", 0, 0, "", "what behaviours know them by"},
    {"group", "set", JOX_TYPE_VALUES, "", 0, 0, "",
     "parameter or own value: number, distribution, place"},
    {"group", "memory", JOX_TYPE_VALUES, "", 0, 0, "", "what they remember at the start"},

    {"source", "at", JOX_TYPE_TEXT, "", 0, 0, "!", "the place where agents appear"},
    {"source", "like", JOX_TYPE_TEXT, "", 0, 0, "!", "the group that they belong to"},
    {"source", "rate", N, "1/s", 0, 1000, "0", "agents a second"},
    {"source", "keep", JOX_TYPE_WHOLE, "", 0, 1000000, "0", "tops the group up to this number"},
    {"source", "from", N, "s", 0, 1e9, "0", ""},
    {"source", "until", N, "s", 0, 1e9, "1e9", ""},
    {"source", "memory", JOX_TYPE_VALUES, "", 0, 0, "", "in place of the group's"},

    {"mod", "name", JOX_TYPE_TEXT, "", 0, 0, "!", "lower-case letters, digits, - and _"},
    {"mod", "title", JOX_TYPE_TEXT, "", 0, 0, "", "what people see"},
    {"mod", "version", JOX_TYPE_TEXT, "", 0, 0, "!", "as 1.2.0"},
    {"mod", "api", JOX_TYPE_WHOLE, "", 1, 1, "!", "version of the language of mods"},
    {"mod", "enabled", JOX_TYPE_BOOL, "", 0, 0, "true",
     "whether it is taken because it lies in a folder of mods; else it must be named"},
    {"mod", "depends", JOX_TYPE_NAMES, "", 0, 0, "",
     "mods that it needs: NAME, or \"NAME >= 1.2\""},
    {"mod", "optional", JOX_TYPE_NAMES, "", 0, 0, "",
     "mods that come before it where they are taken"},
    {"mod", "conflicts", JOX_TYPE_NAMES, "", 0, 0, "", "mods that it does not go together with"},
    {"mod", "load_after", JOX_TYPE_NAMES, "", 0, 0, "",
     "mods that come before it where they are taken"},
    {"mod", "settings", JOX_TYPE_TABLE, "", 0, 0, "", "name: setting"},
    {"setting", "value", N, "", -1e12, 1e12, "!", "unless the scene or --set gives another"},
    {"setting", "unit", JOX_TYPE_TEXT, "", 0, 0, "", "for people"},
    {"setting", "least", N, "", -1e12, 1e12, "-1e12", "least value"},
    {"setting", "greatest", N, "", -1e12, 1e12, "1e12", "greatest value"},
    {"setting", "meaning", JOX_TYPE_TEXT, "", 0, 0, "", "for people"},

    {"sink", "at", JOX_TYPE_TEXT, "", 0, 0, "!", "agents that come in are removed"},
    {"sink", "group", JOX_TYPE_TEXT, "", 0, 0, "", "only those of this group"},
};
#undef N
const size_t jox_scene_key_count = sizeof jox_scene_keys / sizeof *jox_scene_keys;

void jox_scene_error(const JoxReader *reader, const JoxYaml *node, const char *code,
                     const char *hint, const char *format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    jox_diag_error(reader->diagnostics, node->position, code, hint, "%s", text);
}

const char *jox_scene_suggest(const JoxReader *reader, const char *word, const char *const *names,
                              size_t count) {
    if (reader->diagnostics->errors >= 20)
        return NULL; /* no more are shown */
    const char *near = jox_suggest(word, names, count);
    if (!near)
        return NULL;
    char *hint = jox_hoard_take(reader->hoard, strlen(near) + 24, 1);
    sprintf(hint, "Did you mean '%s'?", near);
    return hint;
}

static const JoxKey *find_key(const char *owner, const char *name) {
    for (size_t i = 0; i < jox_scene_key_count; i++)
        if (!strcmp(jox_scene_keys[i].owner, owner) && !strcmp(jox_scene_keys[i].name, name))
            return &jox_scene_keys[i];
    return NULL;
}

bool jox_key_is_table(const char *owner, const char *name) {
    const JoxKey *key = find_key(owner, name);
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
        if (!find_key(owner, map->keys[k])) {
            const char *hint = jox_scene_suggest(reader, map->keys[k], names, count);
            jox_diag_error(reader->diagnostics, map->key_positions[k], "unknown-key", hint,
                           "unknown key '%s' of a %s", map->keys[k], owner);
        }
    return true;
}

/* Units that may be written, each with the SI unit of its kind and the factor to it. */
static const struct Unit {
    const char *name, *kind;
    double factor;
} UNITS[] = {{"m", "m", 1},         {"cm", "m", 0.01},
             {"mm", "m", 0.001},    {"km", "m", 1000},
             {"s", "s", 1},         {"ms", "s", 0.001},
             {"min", "s", 60},      {"h", "s", 3600},
             {"m/s", "m/s", 1},     {"km/h", "m/s", 1 / 3.6},
             {"deg", "deg", 1},     {"rad", "deg", 57.29577951308232},
             {"kg", "kg", 1},       {"g", "kg", 0.001},
             {"t", "kg", 1000},     {"m/s2", "m/s2", 1},
             {"kg/m3", "kg/m3", 1}, {"1/m2", "1/m2", 1},
             {"1/s", "1/s", 1},     {"MB", "MB", 1}};

bool jox_read_number(const JoxReader *reader, const JoxYaml *node, const char *unit, double *out) {
    char *end;
    if (node->kind != JOX_YAML_SCALAR) {
        jox_scene_error(reader, node, "bad-type", NULL, "this must be a number");
        return false;
    }
    double value = strtod(node->text, &end);
    bool hex = strchr(node->text, 'x') || strchr(node->text, 'X');
    if (end == node->text || hex) {
        jox_scene_error(reader, node, "bad-type", *unit ? "Numbers are in SI units" : NULL,
                        "this must be a number, not '%.60s'", node->text);
        return false;
    }
    if (!isfinite(value)) {
        jox_scene_error(reader, node, "out-of-range", NULL, "this must be a finite number");
        return false;
    }
    *out = value;
    end += strspn(end, " ");
    if (*end == 0)
        return true;
    const char *names[32], *other = NULL;
    size_t count = 0;
    for (size_t i = 0; i < sizeof UNITS / sizeof *UNITS; i++) {
        if (!strcmp(UNITS[i].kind, unit))
            names[count++] = UNITS[i].name;
        if (strcmp(UNITS[i].name, end) != 0)
            continue;
        other = UNITS[i].kind;
        if (!strcmp(UNITS[i].kind, unit)) {
            *out = value * UNITS[i].factor;
            return true;
        }
    }
    JoxText hint = {0};
    for (size_t i = 0; i < count; i++)
        jox_text_printf(&hint, "%s%s", i ? ", " : "Units here: ", names[i]);
    jox_scene_error(reader, node, "bad-unit", hint.data,
                    other ? "'%.40s' is a unit of something else" : "unknown unit '%.40s'", end);
    jox_text_free(&hint);
    return false;
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
    const JoxKey *key = find_key(owner, name);
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
    return !strcmp(text ? text : find_key(owner, name)->standard, "true");
}

const char *jox_key_text(const JoxReader *reader, const JoxYaml *map, const char *owner,
                         const char *name) {
    const JoxYaml *node = jox_yaml_get(map, name);
    const char *standard = find_key(owner, name)->standard;
    if (node && node->kind != JOX_YAML_SCALAR) {
        jox_scene_error(reader, node, "bad-type", NULL, "%s must be a text", name);
        node = NULL;
    }
    return node ? node->text : *standard && *standard != '!' ? standard : NULL;
}

bool jox_key_vector(const JoxReader *reader, const JoxYaml *map, const char *owner,
                    const char *name, double *out, int count) {
    const JoxKey *key = find_key(owner, name);
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

JoxV2 *jox_read_points(const JoxReader *reader, const JoxYaml *list, uint32_t least,
                       uint32_t *count) {
    *count = 0;
    if (list->kind != JOX_YAML_LIST || list->count < least) {
        jox_scene_error(reader, list, "bad-type", "[[0, 0], [1, 0], ...]",
                        "this must be a list of at least %u points", least);
        return NULL;
    }
    if (list->count > MOST_POINTS) {
        jox_scene_error(reader, list, "too-many", "Simplify the outline",
                        "a list of points has at most %d, not %u", MOST_POINTS, list->count);
        return NULL;
    }
    JoxV2 *points = jox_hoard_take(reader->hoard, list->count, sizeof *points);
    for (uint32_t i = 0; i < list->count; i++) {
        const JoxYaml *p = list->items[i];
        double v[2] = {0, 0};
        if (p->kind != JOX_YAML_LIST || p->count != 2) {
            jox_scene_error(reader, p, "bad-type", "[x, y]", "a point is two numbers");
            return NULL;
        }
        for (int k = 0; k < 2; k++) {
            if (!jox_read_number(reader, p->items[k], "m", &v[k]))
                return NULL;
            if (fabs(v[k]) > FAR) {
                jox_scene_error(reader, p->items[k], "out-of-range", NULL,
                                "points must lie within 10 km of the origin");
                return NULL;
            }
        }
        points[i] = (JoxV2){(float)v[0], (float)v[1]};
    }
    *count = list->count;
    return points;
}

uint32_t jox_read_names(const JoxReader *reader, const JoxYaml *node, const JoxYaml *const **out) {
    if (!node)
        return 0;
    uint32_t count = node->kind == JOX_YAML_LIST ? node->count : 1, n = 0;
    const JoxYaml **names = jox_hoard_take(reader->hoard, count, sizeof *names);
    for (uint32_t i = 0; i < count; i++) {
        const JoxYaml *name = node->kind == JOX_YAML_LIST ? node->items[i] : node;
        if (name->kind == JOX_YAML_SCALAR)
            names[n++] = name;
        else
            jox_scene_error(reader, name, "bad-type", NULL, "this must be a name");
    }
    *out = names;
    return n;
}

bool jox_read_dist(const JoxReader *reader, const JoxYaml *node, JoxDist *out) {
    static const char *const NAMES[] = {"normal", "uniform", "choose"};
    if (node->kind != JOX_YAML_SCALAR)
        return false;
    char *end;
    double number = strtod(node->text, &end);
    if (end != node->text && *end == 0 && isfinite(number)) {
        *out = jox_dist_constant(number);
        return true;
    }
    for (int which = 0; which < 3; which++) {
        size_t n = strlen(NAMES[which]);
        if (strncmp(node->text, NAMES[which], n) != 0 || node->text[n] != '(')
            continue;
        double v[JOX_DIST_CHOICES];
        int count = 0;
        const char *at = node->text + n + 1;
        while (count < JOX_DIST_CHOICES) {
            v[count] = strtod(at, &end);
            if (end == at || !isfinite(v[count]))
                break;
            count++;
            at = end + strspn(end, " ,");
        }
        bool good =
            *at == ')' && at[1] == 0 &&
            (which == 0   ? (count == 2 || count == 4) && v[1] >= 0 && (count < 4 || v[2] < v[3])
             : which == 1 ? count == 2 && v[0] <= v[1]
                          : count >= 1);
        if (!good)
            jox_scene_error(
                reader, node, "bad-distribution",
                "normal(mean, deviation [, least, greatest]), uniform(least, greatest), "
                "choose(a, b, ...) with at most 8",
                "this distribution is malformed");
        *out = (JoxDist){.kind = which == 0   ? JOX_DIST_NORMAL
                                 : which == 1 ? JOX_DIST_UNIFORM
                                              : JOX_DIST_CHOOSE,
                         .a = good ? v[0] : 0,
                         .b = good && count > 1 ? v[1] : 0,
                         .lo = good && count == 4 ? v[2] : -INFINITY,
                         .hi = good && count == 4 ? v[3] : INFINITY,
                         .choices = good ? count : 1};
        memcpy(out->values, v, (size_t)count * sizeof *v);
        return true;
    }
    return false;
}

void jox_scene_print_reference(JoxText *out) {
    static const char *const TYPES[] = {"number", "whole number", "true/false",    "text",
                                        "[x, y]", "[x, y, z]",    "[[x, y], ...]", "name or names",
                                        "map",    "list",         "map of values"};
    const char *owner = "";
    for (size_t i = 0; i < jox_scene_key_count; i++) {
        const JoxKey *k = &jox_scene_keys[i];
        if (strcmp(owner, k->owner) != 0)
            jox_text_printf(out, "%s%s\n", i ? "\n" : "", k->owner);
        owner = k->owner;
        jox_text_printf(out, "  %-12s %-14s %-6s ", k->name, TYPES[k->type], k->unit);
        if (k->least != k->greatest && k->type <= JOX_TYPE_WHOLE)
            jox_text_printf(out, "%g to %g; ", k->least, k->greatest);
        if (*k->standard == '!')
            jox_text_add(out, "required; ");
        else if (*k->standard)
            jox_text_printf(out, "default %s; ", k->standard);
        jox_text_printf(out, "%s\n", k->meaning);
    }
}
