/* Reads the bodies of a scene, with their shapes, paths and copies. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "scene/scene_draft.h"

enum {
    MOST_COPIES = 4096,  /* copies of a body; also blocks of one */
    MOST_PIECES = 200000 /* bodies of a scene, counting their blocks and parts */
};
static const double CLOSEST = 0.01;    /* m between copies along an axis */
static const double LEAST_MASS = 1e-9; /* kg of a part of a compound */

void jox_key_read_turn(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const double half = jox_key_read_number(r, key, node) * JOX_DEGREE / 2;
    double *turn = JOX_MEMBER(double, item, key->offset);
    turn[2] = jox_sin(half);
    turn[3] = jox_cos(half);
}

static bool read_corner(const JoxReader *r, const JoxKey *key, const JoxYaml *p, double *out) {
    if (p->kind != JOX_YAML_LIST || p->count != 3) {
        jox_scene_error(r, p, "bad-type", "[x, y, z]", "a corner is three numbers");
        return false;
    }
    return jox_key_read_vector(r, key, p, out, 3);
}

void jox_key_read_hull(const JoxReader *r, const JoxKey *key, const JoxYaml *list, void *item) {
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

/* Reads a path. Its first point is the position of the body, which set_motion stores there. */
void jox_key_read_path(const JoxReader *r, const JoxKey *key, const JoxYaml *list, void *item) {
    JoxBodyPath *path = &((JoxBodyDraft *)item)->body.def.path;
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

/* Reads numbers of blocks or copies along x, y and z; 1 each if missing. False if the
   node is missing or wrong. */
static bool read_counts(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                        const char *what, double count[3]) {
    count[0] = count[1] = count[2] = 1;
    if (!jox_key_read_vector(r, key, node, count, 3))
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

void jox_key_read_block_count(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                              void *item) {
    double count[3];
    if (read_counts(r, key, node, "blocks", count))
        for (uint32_t i = 0; i < 3; i++)
            ((JoxShape *)item)->count[i] = (uint32_t)count[i];
}

void jox_key_read_copies(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    double *copies = ((JoxBodyDraft *)item)->copies;
    if (!read_counts(r, key, node, "copies", copies) && node)
        copies[0] = copies[1] = copies[2] = 0; /* wrong: make no body */
}

/* Reads the shape of a part, which must be simple: parts are not nested. */
void jox_key_read_part_shape(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                             void *item) {
    const bool compound = jox_yaml_get(node, "compound") != NULL;
    if (compound || jox_yaml_get(node, "blocks"))
        jox_scene_error(r, node, "bad-shape", NULL, "a part cannot be %s",
                        compound ? "a compound" : "glued blocks");
    else
        jox_owner_read(r, node, key->content, &((JoxBodyPart *)item)->shape);
}

/* Scales the masses of a compound's parts to the mass of the body, if that is given; without mass
   the body is static. */
static void set_compound_mass(const JoxReader *r, const JoxYaml *map, JoxBodyDraft *draft) {
    JoxShape *shape = &draft->body.def.shape;
    const JoxYaml *density = jox_yaml_get(map, "density");
    if (density)
        jox_scene_error(r, density, "bad-body", "Give its mass, or masses of its parts",
                        "a compound has the masses of its parts, and no density");
    if (!isfinite(draft->mass) || shape->part_count == 0)
        return;
    draft->body.def.still = !(draft->mass > 0);
    double sum = 0;
    for (uint32_t p = 0; p < shape->part_count; p++)
        sum += shape->parts[p].mass;
    JoxBodyPart *parts = jox_arena_take(r->arena, shape->part_count, sizeof *parts);
    for (uint32_t p = 0; p < shape->part_count; p++) {
        parts[p] = shape->parts[p];
        if (draft->mass > 0) /* body/ takes no less than LEAST_MASS */
            parts[p].mass = fmax(parts[p].mass * draft->mass / sum, LEAST_MASS);
    }
    shape->parts = parts;
}

/* Sets the mass from one of: the body's mass, its density, the mass of each block. */
static void set_mass(const JoxReader *r, const JoxYaml *map, JoxBodyDraft *draft) {
    JoxBodyDef *def = &draft->body.def;
    const double each = r->draft->block_mass;
    const bool mass = isfinite(draft->mass), density = isfinite(draft->density);
    if (mass && density)
        jox_scene_error(r, map, "bad-body", NULL, "a body has a mass or a density, not both");
    def->mass = mass ? draft->mass : density ? 0 : def->mass;
    def->density = density ? draft->density : 0;
    if (def->shape.kind == JOX_SHAPE_COMPOUND)
        set_compound_mass(r, map, draft);
    if (def->shape.kind != JOX_SHAPE_BLOCKS || !isfinite(each))
        return;
    if (jox_yaml_get(map, "mass") || jox_yaml_get(map, "density"))
        jox_scene_error(
            r, jox_yaml_get(jox_yaml_get(jox_yaml_get(map, "shape"), "blocks"), "block_mass"),
            "bad-body", NULL, "the body has a mass or a density, or its blocks have: not both");
    def->density = 0;
    def->mass = each * def->shape.count[0] * def->shape.count[1] * def->shape.count[2];
}

/* Checks and sets how the body moves: a kinematic body has no mass, and has a path or a
   velocity. */
static void set_motion(const JoxReader *r, const JoxYaml *map, JoxBodyDraft *draft) {
    JoxBodyDef *def = &draft->body.def;
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
    if (limit && isfinite(draft->path_force))
        jox_scene_error(r, limit, "bad-body", "Leave one of them out",
                        "the body has a force_limit, and so has its path");
    if (isfinite(draft->path_force))
        def->force_limit = draft->path_force;
    if (def->path.count)
        memcpy(def->path.points, def->position, sizeof def->position);
}

/* Whether copies stand apart. Bodies at one place would all touch each other: contacts as many as
   pairs, and without meaning. */
static bool copies_stand_apart(const JoxReader *r, const JoxYaml *map, const JoxBodyDraft *draft) {
    for (int i = 0; i < 3; i++)
        if (draft->copies[i] > 1 && fabs(draft->distance[i]) < CLOSEST) {
            jox_scene_error(r, jox_yaml_get(map, "repeat"), "bad-body", NULL,
                            "copies of a body stand at least %g m apart along each axis", CLOSEST);
            return false;
        }
    return true;
}

/* Moves the path of a copy, by `step` m times the cell of the lattice that the copy stands in. */
static void move_path(const JoxReader *r, JoxBodyPath *path, const uint32_t cell[3],
                      const double step[3]) {
    if (!path->count || !(cell[0] || cell[1] || cell[2]))
        return;
    double *points = jox_arena_take(r->arena, 3 * (size_t)path->count, sizeof *points);
    for (uint32_t n = 0; n < 3 * path->count; n++)
        points[n] = path->points[n] + cell[n % 3] * step[n % 3];
    path->points = points;
}

/* Counts the copies of a body with their blocks or parts, each of which costs some 10 us and
   1 KB; whether the scene has few enough. Reports the first body that is too much. */
static bool count_pieces(const JoxReader *r, const JoxYaml *map, const JoxBodyDraft *draft) {
    const JoxShape *shape = &draft->body.def.shape;
    const double before = r->draft->pieces;
    const double each = shape->kind == JOX_SHAPE_BLOCKS
                            ? (double)shape->count[0] * shape->count[1] * shape->count[2]
                            : fmax(shape->part_count, 1.0);
    r->draft->pieces += draft->copies[0] * draft->copies[1] * draft->copies[2] * each;
    if (r->draft->pieces <= MOST_PIECES)
        return true;
    if (before <= MOST_PIECES)
        jox_scene_error(r, map, "too-many-bodies", "Take fewer copies, or larger blocks",
                        "from this body on, the bodies of the scene with their parts and blocks "
                        "are more than %d",
                        MOST_PIECES);
    return false;
}

/* Adds a copy of the body at each point of its lattice, along x first. Copies of a named body are
   NAME-1, NAME-2, ... `room`: capacity of the scene's bodies. */
static void add_copies(const JoxReader *r, const JoxBodyDraft *draft, uint32_t *room) {
    JoxSceneSpec *scene = r->draft->scene;
    const JoxSceneBody *body = &draft->body;
    const double *count = draft->copies, *step = draft->distance;
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

void jox_key_read_bodies(const JoxReader *r, const JoxKey *key, const JoxYaml *list, void *item) {
    JoxSceneSpec *scene = item;
    if (list && list->kind != JOX_YAML_LIST)
        jox_scene_error(r, list, "bad-type",
                        "A map may change bodies of an included scene that have these names",
                        "%s is a list", key->name);
    uint32_t count = list && list->kind == JOX_YAML_LIST ? list->count : 0, room = count;
    scene->bodies = jox_arena_take(r->arena, room, sizeof *scene->bodies);
    for (uint32_t i = 0; i < count; i++) {
        JoxBodyDraft body = {.body = {.def = jox_body_def(), .position = list->items[i]->position}};
        r->draft->block_mass = NAN;
        if (jox_owner_read(r, list->items[i], "body", &body)) {
            set_mass(r, list->items[i], &body);
            set_motion(r, list->items[i], &body);
        }
        if (copies_stand_apart(r, list->items[i], &body) && count_pieces(r, list->items[i], &body))
            add_copies(r, &body, &room);
    }
}
