/* Bodies of a scene. */
#include <math.h>
#include <string.h>

#include "base/elementary.h"
#include "scene/internal.h"

static const double DEGREE = 3.14159265358979323846 / 180.0;

static bool read_shape(const JoxLoad *l, const JoxYaml *map, JoxShape *shape, bool parts_allowed);

static void read_hull(const JoxLoad *l, const JoxYaml *map, JoxShape *shape) {
    const JoxYaml *list = jox_yaml_get(map, "points");
    if (!list || list->kind != JOX_YAML_LIST || list->count < 4 || list->count > 256) {
        jox_scene_error(&l->reader, list ? list : map, "bad-type", "[[0, 0, 0], ...]",
                        "a hull has 4 to 256 points");
        return;
    }
    double *points = jox_hoard_take(l->reader.hoard, list->count * 3, sizeof *points);
    for (uint32_t i = 0; i < list->count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            const JoxYaml *p = list->items[i];
            if (p->kind != JOX_YAML_LIST || p->count != 3) {
                jox_scene_error(&l->reader, p, "bad-type", "[x, y, z]",
                                "a corner is three numbers");
                return;
            }
            if (!jox_read_number(&l->reader, p->items[k], "m", &points[3 * i + k]))
                return;
            if (!(fabs(points[3 * i + k]) <= 1000)) {
                jox_scene_error(&l->reader, p->items[k], "out-of-range", NULL,
                                "corners of a hull lie within 1 km of its origin");
                return;
            }
        }
    shape->points = points;
    shape->point_count = list->count;
}

static void read_parts(const JoxLoad *l, const JoxYaml *list, JoxShape *shape) {
    if (list->kind != JOX_YAML_LIST || list->count == 0) {
        jox_scene_error(&l->reader, list, "bad-type", NULL, "a compound is a list of parts");
        return;
    }
    JoxBodyPart *parts = jox_hoard_take(l->reader.hoard, list->count, sizeof *parts);
    for (uint32_t i = 0; i < list->count; i++) {
        const JoxYaml *map = list->items[i], *inner = jox_yaml_get(map, "shape");
        if (!jox_keys_check(&l->reader, map, "part"))
            continue;
        jox_key_vector(&l->reader, map, "part", "at", parts[i].position, 3);
        parts[i].mass = jox_key_number(&l->reader, map, "part", "mass");
        if (inner)
            read_shape(l, inner, &parts[i].shape, false);
    }
    shape->parts = parts;
    shape->part_count = list->count;
}

static bool read_shape(const JoxLoad *l, const JoxYaml *map, JoxShape *shape, bool parts_allowed) {
    static const char *const KINDS[] = {"box", "sphere", "cylinder", "hull", "compound"};
    const JoxReader *r = &l->reader;
    if (!jox_keys_check(r, map, "shape"))
        return false;
    if (map->count != 1) {
        jox_scene_error(r, map, "bad-shape", "{sphere: {radius: 0.1}}", "a body has one shape");
        return false;
    }
    int kind = -1;
    for (int k = 0; k < 5; k++)
        if (!strcmp(map->keys[0], KINDS[k]))
            kind = k;
    if (kind < 0 || (kind == 4 && !parts_allowed)) {
        if (kind == 4)
            jox_scene_error(r, map, "bad-shape", NULL, "a part cannot be a compound");
        return false;
    }
    const JoxYaml *value = map->items[0];
    shape->kind = (JoxShapeKind)kind;
    if (kind == 4) {
        read_parts(l, value, shape);
        return true;
    }
    if (!jox_keys_check(r, value, KINDS[kind]))
        return false;
    if (kind == 0)
        jox_key_vector(r, value, "box", "size", shape->size, 3);
    else if (kind == 3)
        read_hull(l, value, shape);
    else
        shape->size[0] = jox_key_number(r, value, KINDS[kind], "radius");
    if (kind == 2)
        shape->size[1] = jox_key_number(r, value, "cylinder", "height");
    return true;
}

static void read_body(JoxLoad *l, const JoxYaml *map, JoxSceneBody *body) {
    const JoxReader *r = &l->reader;
    body->def = jox_body_def();
    body->position = map->position;
    if (!jox_keys_check(r, map, "body"))
        return;
    body->def.name = jox_hoard_text(r->hoard, jox_key_text(r, map, "body", "name"));
    double mass = jox_key_number(r, map, "body", "mass");
    double density = jox_key_number(r, map, "body", "density");
    if (isfinite(mass) && isfinite(density))
        jox_scene_error(r, map, "bad-body", NULL, "a body has a mass or a density, not both");
    body->def.mass = isfinite(mass) ? mass : isfinite(density) ? 0 : body->def.mass;
    body->def.density = isfinite(density) ? density : 0;
    jox_key_vector(r, map, "body", "at", body->def.position, 3);
    double half = jox_key_number(r, map, "body", "turn") * DEGREE / 2;
    body->def.turn[2] = jox_sin(half);
    body->def.turn[3] = jox_cos(half);
    jox_key_vector(r, map, "body", "velocity", body->def.velocity, 3);
    body->def.friction = jox_key_number(r, map, "body", "friction");
    body->def.restitution = jox_key_number(r, map, "body", "restitution");
    body->def.damping = jox_key_number(r, map, "body", "damping");
    body->tags = jox_load_tags(l, jox_yaml_get(map, "tags"), &body->tag_count);
    const JoxYaml *shape = jox_yaml_get(map, "shape");
    if (shape)
        read_shape(l, shape, &body->def.shape, true);
}

void jox_load_bodies(JoxLoad *l, const JoxYaml *list) {
    if (list && list->kind != JOX_YAML_LIST)
        jox_scene_error(&l->reader, list, "bad-type", NULL, "bodies is a list");
    uint32_t count = list && list->kind == JOX_YAML_LIST ? list->count : 0;
    l->scene->bodies = jox_hoard_take(l->reader.hoard, count, sizeof *l->scene->bodies);
    l->scene->body_count = count;
    for (uint32_t i = 0; i < count; i++)
        read_body(l, list->items[i], &l->scene->bodies[i]);
}
