/* Bodies of a scene. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/elementary.h"
#include "scene/internal.h"

enum { MOST_COPIES = 4096 }; /* of a body that is repeated */
static const double DEGREE = 3.14159265358979323846 / 180.0;

static bool read_shape(const JoxLoad *l, const JoxYaml *map, JoxShape *shape, bool parts_allowed);

static void read_hull(const JoxLoad *l, const JoxYaml *map, JoxShape *shape) {
    const JoxYaml *list = jox_yaml_get(map, "points");
    if (!list || list->kind != JOX_YAML_LIST || list->count < 4 || list->count > 256) {
        jox_scene_error(&l->reader, list ? list : map, "bad-type", "[[0, 0, 0], ...]",
                        "a hull has 4 to 256 points");
        return;
    }
    double *points = jox_arena_take(l->reader.arena, list->count * 3, sizeof *points);
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
    JoxBodyPart *parts = jox_arena_take(l->reader.arena, list->count, sizeof *parts);
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

/* Glued blocks: at least one along each axis, and no more than glue can hold. */
static void read_blocks(const JoxReader *r, const JoxYaml *map, JoxShape *shape) {
    double count[3] = {1, 1, 1};
    const JoxYaml *node = jox_yaml_get(map, "count");
    jox_key_vector(r, map, "blocks", "size", shape->size, 3);
    shape->bond = jox_key_number(r, map, "blocks", "bond");
    if (!jox_key_vector(r, map, "blocks", "count", count, 3))
        return;
    for (uint32_t i = 0; i < 3; i++) {
        if (count[i] != floor(count[i])) {
            jox_scene_error(r, node->items[i], "bad-type", NULL, "count must be whole numbers");
            return;
        }
        shape->count[i] = (uint32_t)count[i];
    }
    if (count[0] * count[1] * count[2] > 4096)
        jox_scene_error(r, node, "out-of-range", NULL,
                        "a body is glued of at most 4096 blocks, not %.0f",
                        count[0] * count[1] * count[2]);
}

static bool read_shape(const JoxLoad *l, const JoxYaml *map, JoxShape *shape, bool parts_allowed) {
    static const char *const KINDS[] = {"box", "sphere", "cylinder", "hull", "compound", "blocks"};
    const JoxReader *r = &l->reader;
    if (!jox_keys_check(r, map, "shape"))
        return false;
    if (map->count != 1) {
        jox_scene_error(r, map, "bad-shape", "{sphere: {radius: 0.1}}", "a body has one shape");
        return false;
    }
    int kind = -1;
    for (int k = 0; k < 6; k++)
        if (!strcmp(map->keys[0], KINDS[k]))
            kind = k;
    if (kind < 0 || (kind >= 4 && !parts_allowed)) {
        if (kind >= 4)
            jox_scene_error(r, map, "bad-shape", NULL, "a part cannot be %s",
                            kind == 4 ? "a compound" : "glued blocks");
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
    else if (kind == 5)
        read_blocks(r, value, shape);
    else
        shape->size[0] = jox_key_number(r, value, KINDS[kind], "radius");
    if (kind == 2)
        shape->size[1] = jox_key_number(r, value, "cylinder", "height");
    return true;
}

/* The whole has a mass or a density, or each block has a mass. */
static void read_block_mass(const JoxReader *r, const JoxYaml *map, const JoxYaml *blocks,
                            JoxBodyDef *def) {
    const JoxShape *shape = &def->shape;
    double each = jox_key_number(r, blocks, "blocks", "block_mass");
    if (!isfinite(each))
        return;
    if (jox_yaml_get(map, "mass") || jox_yaml_get(map, "density"))
        jox_scene_error(r, jox_yaml_get(blocks, "block_mass"), "bad-body", NULL,
                        "the body has a mass or a density, or its blocks have: not both");
    def->density = 0;
    def->mass = each * shape->count[0] * shape->count[1] * shape->count[2];
}

static void read_body(JoxLoad *l, const JoxYaml *map, JoxSceneBody *body) {
    const JoxReader *r = &l->reader;
    body->def = jox_body_def();
    body->position = map->position;
    if (!jox_keys_check(r, map, "body"))
        return;
    body->def.name = jox_load_name(l, map, "body", "name");
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
    if (!shape || !read_shape(l, shape, &body->def.shape, true))
        return;
    if (body->def.shape.kind == JOX_SHAPE_BLOCKS)
        read_block_mass(r, map, jox_yaml_get(shape, "blocks"), &body->def);
}

/* How often a body stands there, along x, y and z; false with an error. */
static bool read_repeat(const JoxReader *r, const JoxYaml *map, double count[3], double step[3]) {
    const JoxYaml *repeat = jox_yaml_get(map, "repeat"), *node;
    count[0] = count[1] = count[2] = 1;
    step[0] = step[1] = step[2] = 0;
    if (!repeat)
        return true;
    if (!jox_keys_check(r, repeat, "repeat") ||
        !jox_key_vector(r, repeat, "repeat", "count", count, 3) ||
        !jox_key_vector(r, repeat, "repeat", "step", step, 3))
        return false;
    node = jox_yaml_get(repeat, "count");
    for (uint32_t i = 0; i < 3; i++)
        if (count[i] != floor(count[i])) {
            jox_scene_error(r, node->items[i], "bad-type", NULL, "count must be whole numbers");
            return false;
        }
    if (count[0] * count[1] * count[2] <= MOST_COPIES)
        return true;
    jox_scene_error(r, node, "out-of-range", NULL, "a body is repeated at most %d times, not %.0f",
                    MOST_COPIES, count[0] * count[1] * count[2]);
    return false;
}

/* The body at each point of its lattice, x first. Copies of a named one are NAME-1, NAME-2, ... */
static void add_copies(JoxLoad *l, const JoxSceneBody *body, const double count[3],
                       const double step[3], uint32_t *room) {
    JoxSceneSpec *scene = l->scene;
    uint32_t copies = (uint32_t)(count[0] * count[1] * count[2]);
    if (scene->body_count + copies > *room) {
        *room = 2 * (scene->body_count + copies);
        JoxSceneBody *wider = jox_arena_take(l->reader.arena, *room, sizeof *wider);
        if (scene->body_count)
            memcpy(wider, scene->bodies, scene->body_count * sizeof *wider);
        scene->bodies = wider;
    }
    for (uint32_t n = 0; n < copies; n++) {
        uint32_t x = (uint32_t)count[0], y = (uint32_t)count[1];
        uint32_t cell[3] = {n % x, n / x % y, n / (x * y)};
        JoxSceneBody *copy = &scene->bodies[scene->body_count++];
        *copy = *body;
        for (int i = 0; i < 3; i++)
            copy->def.position[i] += cell[i] * step[i];
        if (copies > 1 && body->def.name) {
            char name[80];
            snprintf(name, sizeof name, "%.60s-%u", body->def.name, n + 1);
            copy->def.name = jox_arena_text(l->reader.arena, name);
        }
    }
}

void jox_load_bodies(JoxLoad *l, const JoxYaml *list) {
    if (list && list->kind != JOX_YAML_LIST)
        jox_scene_error(&l->reader, list, "bad-type",
                        "A map may change bodies of an included scene that have these names",
                        "bodies is a list");
    uint32_t count = list && list->kind == JOX_YAML_LIST ? list->count : 0, room = count;
    l->scene->bodies = jox_arena_take(l->reader.arena, room, sizeof *l->scene->bodies);
    for (uint32_t i = 0; i < count; i++) {
        JoxSceneBody body = {0};
        double copies[3], step[3];
        read_body(l, list->items[i], &body);
        if (read_repeat(&l->reader, list->items[i], copies, step))
            add_copies(l, &body, copies, step, &room);
    }
}
