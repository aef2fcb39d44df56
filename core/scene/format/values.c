/* Reads numbers with units, points, names and distributions. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "scene/format/values.h"

enum { MOST_POINTS = 5000 };

/* clang-format off */
const JoxUnit jox_scene_units[] = {
    {"m", "m", 1}, {"cm", "m", 0.01}, {"mm", "m", 0.001}, {"km", "m", 1000},
    {"s", "s", 1}, {"ms", "s", 0.001}, {"min", "s", 60}, {"h", "s", 3600},
    {"m/s", "m/s", 1}, {"km/h", "m/s", 1 / 3.6},
    {"rad/s", "rad/s", 1}, {"deg/s", "rad/s", 0.017453292519943295},
    {"deg", "deg", 1}, {"rad", "deg", 57.29577951308232},
    {"N", "N", 1}, {"kN", "N", 1000},
    {"kg", "kg", 1}, {"g", "kg", 0.001}, {"t", "kg", 1000},
    {"m/s2", "m/s2", 1}, {"kg/m3", "kg/m3", 1}, {"m2", "m2", 1}, {"1/m2", "1/m2", 1}, {"1/s", "1/s", 1}, {"MB", "MB", 1}, {"KB", "KB", 1},
};
const size_t jox_scene_unit_count = sizeof jox_scene_units / sizeof *jox_scene_units;
/* clang-format on */

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
    for (size_t i = 0; i < jox_scene_unit_count; i++) {
        if (!strcmp(jox_scene_units[i].kind, unit))
            names[count++] = jox_scene_units[i].name;
        if (strcmp(jox_scene_units[i].name, end) != 0)
            continue;
        other = jox_scene_units[i].kind;
        if (!strcmp(jox_scene_units[i].kind, unit)) {
            *out = value * jox_scene_units[i].factor;
            return true;
        }
    }
    JoxText hint = {0};
    if (strchr(",:.", *end) || (*end == '-' && isdigit((unsigned char)end[1]))) {
        jox_scene_error(reader, node, "bad-type",
                        "Several, one run each, are for `jostle sweep`, with commas: "
                        "PATH=60,70,80,90",
                        "this must be one number, not '%.60s'", node->text);
        return false;
    }
    for (size_t i = 0; i < count; i++)
        jox_text_printf(&hint, "%s%s", i ? ", " : "Units here: ", names[i]);
    jox_scene_error(reader, node, "bad-unit", hint.data,
                    other ? "'%.40s' is a unit of something else" : "unknown unit '%.40s'", end);
    jox_text_free(&hint);
    return false;
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
    JoxV2 *points = jox_arena_take(reader->arena, list->count, sizeof *points);
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
            if (fabs(v[k]) > JOX_FARTHEST) {
                jox_scene_error(reader, p->items[k], "out-of-range", NULL,
                                "points must lie within 10 km of the origin");
                return NULL;
            }
        }
        points[i] = jox_scene_position(reader, (JoxV2){(float)v[0], (float)v[1]});
    }
    *count = list->count;
    return points;
}

uint32_t jox_read_names(const JoxReader *reader, const JoxYaml *node, const JoxYaml *const **out) {
    if (!node)
        return 0;
    uint32_t count = node->kind == JOX_YAML_LIST ? node->count : 1, n = 0;
    const JoxYaml **names = jox_arena_take(reader->arena, count, sizeof *names);
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
    if (node->kind != JOX_YAML_SCALAR)
        return false;
    char *end;
    double number = strtod(node->text, &end);
    if (end != node->text && *end == 0 && isfinite(number)) {
        *out = jox_dist_constant(number);
        return true;
    }
    const char *open = strchr(node->text, '(');
    const JoxDistKind kind =
        open ? jox_dist_named(node->text, (size_t)(open - node->text)) : JOX_DIST_KINDS;
    if (kind == JOX_DIST_KINDS)
        return false;
    double v[JOX_DIST_CHOICES];
    int count = 0;
    const char *at = open + 1;
    while (count < JOX_DIST_CHOICES) {
        v[count] = strtod(at, &end);
        if (end == at || !isfinite(v[count]))
            break;
        count++;
        at = end + strspn(end, " ,");
    }
    if (*at == ')' && at[1] == 0 && jox_dist_make(kind, v, count, out))
        return true;
    jox_scene_error(reader, node, "bad-distribution", jox_dist_usage,
                    "this distribution is malformed");
    *out = jox_dist_constant(0.0);
    return true;
}
