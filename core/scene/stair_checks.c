/* Checks of storeys and stairs: each stair alone once its keys are read (storeys.c calls it), and
   all of them among each other and walls once the scene is read (read_specification.c). */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "geom/polygon.h"
#include "geom/wall_grid.h"
#include "scene/scene_draft.h"

static const float SHARPEST = -0.2f; /* cosine of the sharpest turn of a path */
static const float SHARP = 0.85f;    /* of turns that have a landing, as in geom/storeys.c */
static const float SHORTEST = 0.05f; /* m, of a part of a path */
static const float LONGEST = 300.0f; /* m */
static const float STEEPEST = 1.0f;  /* slope of any stair: 45 degrees */
static const float STEEP_RAMP = 1.0f / 6.0f; /* building codes allow 1:12 to 1:8 */
static const float CLEAR_FRONT = 0.6f;       /* m before a foot or head that no wall may cross */

/* ---- one stair ---- */

/* Returns the part of the path from point k to k + 1 as a vector, m. */
static JoxV2 get_part(const JoxStair *stair, uint32_t k) {
    return jox_sub(stair->path[k + 1], stair->path[k]);
}

/* Returns the cosine of the turn at point k of a path; 1 at its ends. */
static float get_turn(const JoxStair *stair, uint32_t k) {
    if (k == 0 || k + 1 == stair->path_count)
        return 1.0f;
    return jox_dot(jox_unit(get_part(stair, k - 1)), jox_unit(get_part(stair, k)));
}

/* Checks that a path has no short parts and no sharp turns, and room for its landings. */
static bool check_path(const JoxReader *r, const JoxYaml *path, const JoxStair *stair) {
    for (uint32_t k = 0; k + 1 < stair->path_count; k++) {
        const float length = jox_length(get_part(stair, k));
        if (length < SHORTEST) {
            jox_scene_error(r, path->items[k + 1], "bad-stair", "Leave it out",
                            "this point of the path is less than 5 cm from the one before");
            return false;
        }
    }
    for (uint32_t k = 0; k + 1 < stair->path_count; k++) {
        const float length = jox_length(get_part(stair, k));
        const float turned =
            (float)(get_turn(stair, k) < SHARP) + (float)(get_turn(stair, k + 1) < SHARP);
        if (get_turn(stair, k) < SHARPEST) {
            jox_scene_error(
                r, path->items[k], "bad-stair",
                "Turn twice, with a landing between: [[0, 0], [3, 0], [3, 1.5], [0, 1.5]]",
                "the path turns back here by more than about 100 degrees");
            return false;
        }
        if (length < 0.5f * stair->width * turned) {
            jox_scene_error(r, path->items[k + 1], "bad-stair",
                            "Make it longer, or the stair narrower",
                            "this part of the path, %.2f m long, has no room for the landings of "
                            "%.2f m where the path turns",
                            (double)length, 0.5 * (double)stair->width);
            return false;
        }
    }
    return true;
}

/* Returns the length of flights of a stair that is alone, m in plan; NAN if the stair overlaps
   itself. */
static float measure_flights(const JoxStair *stair) {
    JoxStorey storeys[2] = {{.name = "", .height = 0.0f}, {.name = "", .height = 1.0f}};
    JoxStair one = *stair, *laid;
    one.lower = 0;
    one.upper = 1;
    JoxStoreys alone = {.storeys = storeys, .storey_count = 2, .stairs = &one, .stair_count = 1},
               copy;
    uint32_t a, b;
    float run = 0.0f;
    jox_storeys_copy(&copy, &alone);
    jox_storeys_lay_out(&copy, stair->path[0], stair->path[0]);
    laid = copy.stairs;
    for (uint32_t f = 0; f < copy.flight_count; f++)
        run += copy.flights[f].run;
    if (jox_polygon_self_crosses(laid->outline, 2 * laid->path_count, &a, &b))
        run = NAN;
    jox_storeys_free(&copy);
    return run;
}

void jox_scene_check_stair(const JoxReader *r, const JoxYaml *map, const JoxStair *stair) {
    const JoxStoreysDraft *all = &r->draft->storeys;
    const JoxYaml *path = jox_yaml_get(map, "path"), *landings = jox_yaml_get(map, "landings");
    const bool joins = stair->lower != stair->upper;
    const double rise = joins ? (double)all->storeys[stair->upper].height -
                                    (double)all->storeys[stair->lower].height
                              : (double)stair->rise;
    if (!check_path(r, path, stair))
        return;
    const float length = jox_stair_length(stair);
    if (length > LONGEST) {
        jox_scene_error(r, path, "too-large", "A length may be in millimetres",
                        "a stair is at most %g m long, not %g m", (double)LONGEST, (double)length);
        return;
    }
    const float run = measure_flights(stair);
    if (stair->landing_count && stair->landings[stair->landing_count - 1].to > length) {
        jox_scene_error(r, landings->items[stair->landing_count - 1], "bad-stair", NULL,
                        "this landing ends beyond the path, which is %.2f m long", (double)length);
    } else if (isnan(run)) {
        jox_scene_error(r, path, "bad-stair",
                        "Lead its flights farther apart: the middle lines at least its width and "
                        "5 cm",
                        "the stair, %.2f m wide, overlaps itself", (double)stair->width);
    } else if (run < SHORTEST) {
        jox_scene_error(r, path, "bad-stair", "Make its path longer",
                        "the stair has no flights: landings take all of its %.2f m",
                        (double)length);
    } else if (rise > (double)(STEEPEST * run)) {
        jox_scene_error(
            r, path, "bad-stair", "Make its path longer; stairs rise by 0.5 to 0.65",
            "the stair is steeper than 45 degrees: it rises %.2f m on flights of %.2f m", rise,
            (double)run);
    } else if (stair->kind == JOX_STAIR_RAMP && rise > (double)(STEEP_RAMP * run)) {
        jox_diag_warn(r->diagnostics, path->position, "steep-ramp",
                      "Make its path longer, or take kind: stairs",
                      "the ramp rises %.2f m on %.2f m, more than 1 in 6", rise, (double)run);
    }
}

/* ---- all together ---- */

/* Returns the map of a stair in the scene's file. */
static const JoxYaml *find_stair_map(const JoxReader *r, const JoxStair *stair) {
    return jox_yaml_get(jox_yaml_get(r->draft->root, "stairs"), stair->name);
}

static bool is_at_storey(const JoxStair *stair, uint32_t storey) {
    return stair->lower != stair->upper && stair->lower <= storey && storey <= stair->upper;
}

/* Returns whether the outlines of two stairs have floor in common, apart from edges: whether the
   middle of a part of one's path, or a point beside it, is well inside the other. */
static bool has_point_inside(const JoxStair *a, const JoxStair *b) {
    for (uint32_t k = 0; k + 1 < a->path_count; k++)
        for (int at = 1; at < 8; at++)
            for (int aside = -1; aside <= 1; aside++) {
                const JoxV2 part = get_part(a, k);
                const JoxV2 beside =
                    jox_scale(jox_left(jox_unit(part)), 0.45f * a->width * (float)aside);
                const JoxV2 p =
                    jox_add(jox_add(a->path[k], jox_scale(part, (float)at / 8.0f)), beside);
                if (jox_polygon_contains(b->outline, 2 * b->path_count, p) &&
                    jox_polygon_distance(b->outline, 2 * b->path_count, p, false) > 0.02f)
                    return true;
            }
    return false;
}

static bool has_same_outline(const JoxStair *a, const JoxStair *b) {
    bool same = a->path_count == b->path_count;
    for (uint32_t k = 0; same && k < 2 * a->path_count; k++)
        same = jox_polygon_distance(b->outline, 2 * b->path_count, a->outline[k], false) < 0.02f;
    return same;
}

/* Reports stairs that take floor from each other on a storey. Stairs of one outline may lie one
   above the other, as in a stairwell. */
static void check_crossing_stairs(const JoxReader *r, const JoxStoreys *s) {
    for (uint32_t a = 0; a < s->stair_count; a++)
        for (uint32_t b = 0; b < a; b++) {
            const JoxStair *one = &s->stairs[a], *other = &s->stairs[b];
            const uint32_t low = one->lower > other->lower ? one->lower : other->lower;
            if (!is_at_storey(one, low) || !is_at_storey(other, low) ||
                has_same_outline(one, other) ||
                !(has_point_inside(one, other) || has_point_inside(other, one)))
                continue;
            jox_scene_error(r, find_stair_map(r, one), "bad-stair",
                            "Move one of them, or give both the same outline, one above the other",
                            "the stairs %.60s and %.60s cross each other on %.60s", one->name,
                            other->name, s->storeys[low].name);
            return;
        }
}

/* Reports a foot or head before which a wall that never opens stands. */
static void check_front(const JoxReader *r, const JoxStoreys *s, const JoxSeam *seam) {
    const JoxWalls *walls = &r->draft->scene->walls;
    const JoxStair *stair = &s->stairs[seam->stair];
    const JoxV2 middle = jox_scale(jox_add(seam->a, seam->b), 0.5f);
    const JoxV2 out = jox_scale(jox_left(seam->along), -CLEAR_FRONT);
    const JoxV2 from = jox_on_sheet(s, seam->here, jox_add(middle, jox_scale(out, 0.02f)));
    const JoxV2 to = jox_on_sheet(s, seam->here, jox_add(middle, out));
    for (uint32_t ring = 0; ring < walls->ring_count; ring++)
        for (uint32_t v = walls->rings[ring].first;
             v < walls->rings[ring].first + walls->rings[ring].count; v++) {
            const JoxV2 a = walls->vertices[v].point,
                        b = walls->vertices[walls->vertices[v].next].point;
            if (walls->rings[ring].name || !jox_segments_cross(from, to, a, b))
                continue;
            jox_scene_error(r, find_stair_map(r, stair), "bad-stair",
                            "Move the wall, or turn the stair round",
                            "a wall stands before the %s of this stair on %.60s",
                            seam->at_head ? "head" : "foot", s->storeys[seam->here].name);
            return;
        }
}

/* Warns of storeys that nothing joins to another, though others are joined. */
static void check_joined(const JoxReader *r, const JoxStoreys *s) {
    const JoxSceneSpec *scene = r->draft->scene;
    const JoxYaml *map = jox_yaml_get(r->draft->root, "storeys");
    bool any = false;                          /* where nothing is joined, that is meant */
    if (jox_yaml_get(r->draft->root, "lifts")) /* which join storeys, too */
        return;
    for (uint32_t n = 0; n < s->stair_count; n++)
        any |= s->stairs[n].lower != s->stairs[n].upper;
    for (uint32_t k = 0; any && k < s->storey_count; k++) {
        bool joined = false;
        for (uint32_t n = 0; n < s->stair_count && !joined; n++)
            joined = s->stairs[n].lower != s->stairs[n].upper &&
                     (s->stairs[n].lower == k || s->stairs[n].upper == k);
        for (uint32_t l = 0; l < scene->lift_count && !joined; l++)
            joined = jox_lift_stop_at(&scene->lifts[l], k) >= 0;
        for (uint32_t i = 0; !joined && i < map->count; i++)
            if (strcmp(map->keys[i], s->storeys[k].name) == 0)
                jox_diag_warn(
                    r->diagnostics, map->key_positions[i], "storey-alone",
                    "stairs: {north: {from: ground, to: first, path: [[10, 2], [16, 2]]}}",
                    "no stair or lift joins %.60s to another storey", s->storeys[k].name);
    }
}

void jox_scene_check_storeys(const JoxReader *r) {
    const JoxSceneSpec *scene = r->draft->scene;
    const JoxStoreys *s = &scene->storeys;
    if (s->storey_count == 0)
        return;
    check_joined(r, s);
    check_crossing_stairs(r, s);
    for (uint32_t k = 0; k < s->seam_count; k++)
        if (s->seams[k].enters)
            check_front(r, s, &s->seams[k]);
    jox_scene_check_floors(r);
}
