/* Bodies of a scene. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "scene/internal.h"

enum {
    MOST_COPIES = 4096,  /* of a body, and blocks of one */
    MOST_PIECES = 200000 /* bodies of a scene, their blocks and their parts */
};
static const double CLOSEST = 0.01; /* m between copies along an axis */

void jox_key_turn(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const double half = jox_key_number(r, key, node) * JOX_DEGREE / 2;
    double *turn = JOX_MEMBER(double, item, key->offset);
    turn[2] = jox_sin(half);
    turn[3] = jox_cos(half);
}

static bool read_corner(const JoxReader *r, const JoxKey *key, const JoxYaml *p, double *out) {
    if (p->kind != JOX_YAML_LIST || p->count != 3) {
        jox_scene_error(r, p, "bad-type", "[x, y, z]", "a corner is three numbers");
        return false;
    }
    return jox_key_vector(r, key, p, out, 3);
}

void jox_key_hull(const JoxReader *r, const JoxKey *key, const JoxYaml *list, void *item) {
    JoxShape *shape = item;
    if (!list)
        return;
    if (list->kind != JOX_YAML_LIST || list->count < 4 || list->count > 256) {
        jox_scene_error(r, list, "bad-type", "[[0, 0, 0], ...]", "a hull has 4 to 256 points");
        return;
    }
    double *points = jox_arena_take(r->arena, (size_t)list->count * 3, sizeof *points);
    for (uint32_t i = 0; i < list->count; i++)
        if (!read_corner(r, key, list->items[i], &points[3 * i]))
            return;
    shape->points = points;
    shape->point_count = list->count;
}

/* Its first point is where the body begins, which is set once all of the body is read. */
void jox_key_path(const JoxReader *r, const JoxKey *key, const JoxYaml *list, void *item) {
    JoxBodyPath *path = &((JoxLoadBody *)item)->body.def.path;
    if (!list)
        return;
    if (list->kind != JOX_YAML_LIST || list->count < 1 || list->count >= JOX_PATH_POINTS) {
        jox_scene_error(r, list, "bad-type", "[[5, 0, 1], ...]", "a path has 1 to %d points",
                        JOX_PATH_POINTS - 1);
        return;
    }
    double *points = jox_arena_take(r->arena, 3 * ((size_t)list->count + 1), sizeof *points);
    for (uint32_t i = 0; i < list->count; i++)
        if (!read_corner(r, key, list->items[i], &points[3 * (i + 1)]))
            return;
    path->points = points;
    path->count = list->count + 1;
}

/* Three whole numbers, of blocks or of copies. */
static bool read_counts(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                        const char *what, double count[3]) {
    count[0] = count[1] = count[2] = 1;
    if (!jox_key_vector(r, key, node, count, 3))
        return false;
    for (uint32_t i = 0; i < 3; i++)
        if (count[i] != floor(count[i])) {
            jox_scene_error(r, node->items[i], "bad-type", NULL, "count must be whole numbers");
            return false;
        }
    if (count[0] * count[1] * count[2] <= MOST_COPIES)
        return true;
    jox_scene_error(r, node, "out-of-range", NULL, "a body has at most %d %s, not %.0f",
                    MOST_COPIES, what, count[0] * count[1] * count[2]);
    return false;
}

void jox_key_block_count(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    double count[3];
    if (read_counts(r, key, node, "blocks", count))
        for (uint32_t i = 0; i < 3; i++)
            ((JoxShape *)item)->count[i] = (uint32_t)count[i];
}

void jox_key_copies(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    double *copies = ((JoxLoadBody *)item)->copies;
    if (!read_counts(r, key, node, "copies", copies) && node)
        copies[0] = copies[1] = copies[2] = 0; /* wrong: none */
}

/* A part is a simple shape: this ends the recursion. */
void jox_key_part_shape(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const bool compound = jox_yaml_get(node, "compound") != NULL;
    if (compound || jox_yaml_get(node, "blocks"))
        jox_scene_error(r, node, "bad-shape", NULL, "a part cannot be %s",
                        compound ? "a compound" : "glued blocks");
    else
        jox_keys_fill(r, node, key->of, &((JoxBodyPart *)item)->shape);
}

/* The whole has a mass or a density, or each block has a mass. */
static void set_mass(const JoxReader *r, const JoxYaml *map, JoxLoadBody *load) {
    JoxBodyDef *def = &load->body.def;
    const double each = r->load->block_mass;
    const bool mass = isfinite(load->mass), density = isfinite(load->density);
    if (mass && density)
        jox_scene_error(r, map, "bad-body", NULL, "a body has a mass or a density, not both");
    def->mass = mass ? load->mass : density ? 0 : def->mass;
    def->density = density ? load->density : 0;
    if (def->shape.kind != JOX_SHAPE_BLOCKS || !isfinite(each))
        return;
    if (jox_yaml_get(map, "mass") || jox_yaml_get(map, "density"))
        jox_scene_error(
            r, jox_yaml_get(jox_yaml_get(jox_yaml_get(map, "shape"), "blocks"), "block_mass"),
            "bad-body", NULL, "the body has a mass or a density, or its blocks have: not both");
    def->density = 0;
    def->mass = each * def->shape.count[0] * def->shape.count[1] * def->shape.count[2];
}

/* A kinematic body has no mass, and moves along its path or by its velocity. */
static void set_motion(const JoxReader *r, const JoxYaml *map, JoxLoadBody *load) {
    JoxBodyDef *def = &load->body.def;
    const JoxYaml *path = jox_yaml_get(map, "path"), *velocity = jox_yaml_get(map, "velocity");
    const JoxYaml *mass = jox_yaml_get(map, "mass"), *density = jox_yaml_get(map, "density");
    if (def->kinematic && (mass || density))
        jox_scene_error(r, mass ? mass : density, "bad-body", "Leave out its mass",
                        "a kinematic body has no mass: nothing pushes it");
    if (path && !def->kinematic)
        jox_scene_error(r, path, "bad-body", "Add `kinematic: true`, and no mass",
                        "only a kinematic body follows a path");
    if (path && velocity)
        jox_scene_error(r, velocity, "bad-body", "Leave out the velocity or the path",
                        "a body on a path moves at the speed of the path");
    if (def->kinematic)
        def->mass = def->density = 0;
    const JoxYaml *limit = jox_yaml_get(map, "force_limit"), *end = jox_yaml_get(map, "at_limit");
    if (!def->kinematic && (limit || end))
        jox_scene_error(r, limit ? limit : end, "bad-body", "Add `kinematic: true`, and no mass",
                        "only a kinematic body has a force limit: others press with their mass");
    if (limit && isfinite(load->path_force))
        jox_scene_error(r, limit, "bad-body", "Leave one of them out",
                        "the body has a force_limit, and so has its path");
    if (isfinite(load->path_force))
        def->force_limit = load->path_force;
    if (def->path.count)
        memcpy(def->path.points, def->position, sizeof def->position);
}

/* Bodies in one place all touch each other: their contacts are as many as pairs, and have no sense.
 */
static bool is_lattice(const JoxReader *r, const JoxYaml *map, const JoxLoadBody *load) {
    for (int i = 0; i < 3; i++)
        if (load->copies[i] > 1 && fabs(load->distance[i]) < CLOSEST) {
            jox_scene_error(r, jox_yaml_get(map, "repeat"), "bad-body", NULL,
                            "copies of a body stand at least %g m apart along each axis", CLOSEST);
            return false;
        }
    return true;
}

/* The path of a copy stands apart from the first one's as the copy does. */
static void move_path(const JoxReader *r, JoxBodyPath *path, const uint32_t cell[3],
                      const double step[3]) {
    if (!path->count || !(cell[0] || cell[1] || cell[2]))
        return;
    double *points = jox_arena_take(r->arena, 3 * (size_t)path->count, sizeof *points);
    for (uint32_t n = 0; n < 3 * path->count; n++)
        points[n] = path->points[n] + cell[n % 3] * step[n % 3];
    path->points = points;
}

/* Whether the bodies of the scene, each with its blocks or the parts of its compound, are few
   enough with the copies of one more: they take some 10 us and 1 KB each. An error at the first
   that is too much. */
static bool are_few(const JoxReader *r, const JoxYaml *map, const JoxLoadBody *load) {
    const JoxShape *shape = &load->body.def.shape;
    const double before = r->load->pieces;
    const double each = shape->kind == JOX_SHAPE_BLOCKS
                            ? (double)shape->count[0] * shape->count[1] * shape->count[2]
                            : fmax(shape->part_count, 1.0);
    r->load->pieces += load->copies[0] * load->copies[1] * load->copies[2] * each;
    if (r->load->pieces <= MOST_PIECES)
        return true;
    if (before <= MOST_PIECES)
        jox_scene_error(r, map, "too-many-bodies", "Take fewer copies, or larger blocks",
                        "from this body on, the bodies of the scene with their parts and blocks "
                        "are more than %d",
                        MOST_PIECES);
    return false;
}

/* The body at each point of its lattice, x first. Copies of a named one are NAME-1, NAME-2, ... */
static void add_copies(const JoxReader *r, const JoxLoadBody *load, uint32_t *room) {
    JoxSceneSpec *scene = r->load->scene;
    const JoxSceneBody *body = &load->body;
    const double *count = load->copies, *step = load->distance;
    uint32_t copies = (uint32_t)(count[0] * count[1] * count[2]);
    if (scene->body_count + copies > *room) {
        *room = 2 * (scene->body_count + copies);
        JoxSceneBody *wider = jox_arena_take(r->arena, *room, sizeof *wider);
        if (scene->body_count)
            memcpy(wider, scene->bodies, scene->body_count * sizeof *wider);
        scene->bodies = wider;
    }
    JOX_ASSERT(copies <= MOST_COPIES && scene->body_count + copies <= *room);
    for (uint32_t n = 0; n < copies; n++) {
        uint32_t x = (uint32_t)count[0], y = (uint32_t)count[1];
        uint32_t cell[3] = {n % x, n / x % y, n / (x * y)};
        JoxSceneBody *copy = &scene->bodies[scene->body_count++];
        *copy = *body;
        for (int i = 0; i < 3; i++)
            copy->def.position[i] += cell[i] * step[i];
        move_path(r, &copy->def.path, cell, step);
        if (copies > 1 && body->def.name) {
            char name[80];
            snprintf(name, sizeof name, "%.60s-%u", body->def.name, n + 1);
            copy->def.name = jox_arena_text(r->arena, name);
        }
    }
}

void jox_key_bodies(const JoxReader *r, const JoxKey *key, const JoxYaml *list, void *item) {
    JoxSceneSpec *scene = item;
    if (list && list->kind != JOX_YAML_LIST)
        jox_scene_error(r, list, "bad-type",
                        "A map may change bodies of an included scene that have these names",
                        "%s is a list", key->name);
    uint32_t count = list && list->kind == JOX_YAML_LIST ? list->count : 0, room = count;
    scene->bodies = jox_arena_take(r->arena, room, sizeof *scene->bodies);
    for (uint32_t i = 0; i < count; i++) {
        JoxLoadBody body = {.body = {.def = jox_body_def(), .position = list->items[i]->position}};
        r->load->block_mass = NAN;
        if (jox_keys_fill(r, list->items[i], "body", &body)) {
            set_mass(r, list->items[i], &body);
            set_motion(r, list->items[i], &body);
        }
        if (is_lattice(r, list->items[i], &body) && are_few(r, list->items[i], &body))
            add_copies(r, &body, &room);
    }
}
