/* Checks that there is floor under what a scene places: a storey has none in the footprints of its
   stairs and in the shafts of lifts. stair_checks.c calls it for people, bodies, sources and
   places once the scene is read, walls.c for each wall, group_positions.c before it fills areas. */
#include <math.h>
#include <stdio.h>

#include "base/mem.h"
#include "geom/polygon.h"
#include "geom/storey_text.h"
#include "scene/scene_draft.h"

enum { SAMPLES = 24 };            /* points along each axis at which a place is sampled */
static const float BESIDE = 0.1f; /* m: walls at the edge of a stair or shaft may lie this far in */
static const float STEP = 0.1f;   /* m between points of a wall that are tested */

/* Returns whether a shaft passes a storey. */
static bool passes(const JoxLift *lift, uint32_t storey) {
    return lift->stops[0].storey <= storey && storey <= lift->stops[lift->stop_count - 1].storey;
}

/* Returns the lift in whose shaft a position is, NULL: in none. */
static const JoxLift *find_shaft(const JoxSceneSpec *s, JoxV2 at) {
    for (uint32_t l = 0; l < s->lift_count; l++)
        if (passes(&s->lifts[l], jox_sheet_of(&s->storeys, at.y)) &&
            jox_polygon_contains(s->lifts[l].outline, s->lifts[l].point_count,
                                 jox_in_plan(&s->storeys, at)))
            return &s->lifts[l];
    return NULL;
}

/* Returns whether the car of a lift stands on the storey of a position at the start. */
static bool has_car(const JoxSceneSpec *s, const JoxLift *lift, JoxV2 at) {
    return lift->stops[lift->home].storey == jox_sheet_of(&s->storeys, at.y);
}

/* Reports something that is where there is no floor. `in_car`: it may stand in a car that is there
   at the start. */
static bool check_floor(const JoxReader *r, JoxPosition position, JoxV2 at, bool in_car,
                        const char *what) {
    const JoxSceneSpec *scene = r->draft->scene;
    const JoxStoreys *s = &scene->storeys;
    const JoxLift *shaft = find_shaft(scene, at);
    JoxText where = {0};
    if (jox_is_floor(s, at) && (!shaft || (in_car && has_car(scene, shaft, at))))
        return true;
    jox_text_position(&where, s, at, 2);
    if (shaft)
        jox_diag_error(r->diagnostics, position, "no-floor",
                       in_car ? "Move it, or start in the car on its `home` storey"
                              : "Move it out of the shaft",
                       "%s at %s is in the shaft of the lift '%.60s'", what, where.data,
                       shaft->name);
    else if (jox_stair_at(s, at) >= 0)
        jox_diag_error(r->diagnostics, position, "no-floor", "Move it onto the stair",
                       "%s at %s is beside the stair", what, where.data);
    else
        jox_diag_error(r->diagnostics, position, "no-floor",
                       "Move it, or write the name of the stair as its `storey`",
                       "%s at %s is where a stair leads through the storey", what, where.data);
    jox_text_free(&where);
    return false;
}

/* Returns whether there is floor at the centre or at any point of a place. */
static bool has_any_floor(const JoxStoreys *s, const JoxPlace *place) {
    bool floor = jox_is_floor(s, place->centre);
    for (uint32_t k = 0; k < place->count; k++)
        floor |= jox_is_floor(s, place->points[k]);
    return floor;
}

static JoxPosition get_position(const JoxReader *r, const char *owner, const char *name) {
    return jox_yaml_get(jox_yaml_get(r->draft->root, owner), name)->position;
}

static void check_places(const JoxReader *r, const JoxSceneSpec *s) {
    char what[100];
    for (uint32_t p = 0; p < s->place_count; p++) {
        const JoxPlace *place = &s->places[p];
        if (place->count == 0 || jox_place_is_set(place) || has_any_floor(&s->storeys, place))
            continue;
        snprintf(what, sizeof what, "the place %.60s", place->name);
        check_floor(r, get_position(r, "places", place->name), place->centre, true, what);
    }
}

static void check_people(const JoxReader *r, const JoxSceneSpec *s) {
    char what[100];
    for (uint32_t g = 0; g < s->group_count; g++) {
        const JoxGroup *group = &s->groups[g];
        const JoxPosition position = get_position(r, "groups", group->name);
        snprintf(what, sizeof what, "a person of group %.60s", group->name);
        bool good = true;
        for (uint32_t i = 0; good && group->positions && i < group->count; i++)
            good = check_floor(r, position, group->positions[i], true, what);
        for (uint32_t i = 0; good && i < group->start_count; i++)
            good =
                check_floor(r, position, group->starts[i].at, group->starts[i].time == 0.0, what);
    }
}

static void check_bodies(const JoxReader *r, const JoxSceneSpec *s) {
    char what[100];
    for (uint32_t b = 0; b < s->body_count; b++) {
        const JoxBodyDef *def = &s->bodies[b].def;
        const JoxV2 at = {(float)def->position[0], (float)def->position[1]};
        snprintf(what, sizeof what, def->name ? "the body %.60s" : "the body%.0s",
                 def->name ? def->name : "");
        check_floor(r, s->bodies[b].position, at, false, what);
    }
}

/* Returns a lift whose shaft takes half of a place or more, NULL: none does. */
static const JoxLift *find_filling_shaft(const JoxSceneSpec *s, const JoxPlace *places,
                                         uint32_t index) {
    const JoxPlace *place = &places[index];
    uint32_t inside = 0, taken = 0;
    const JoxLift *shaft = find_shaft(s, place->centre);
    JoxV2 low, high;
    if (!jox_place_is_area(place))
        return shaft;
    jox_bounds(place->points, place->count, &low, &high);
    for (int n = 0; n < SAMPLES * SAMPLES; n++) {
        const JoxV2 share = {((float)(n % SAMPLES) + 0.5f) / SAMPLES,
                             ((float)(n / SAMPLES) + 0.5f) / SAMPLES};
        const JoxV2 at = {low.x + share.x * (high.x - low.x), low.y + share.y * (high.y - low.y)};
        if (!jox_place_contains(places, index, at))
            continue;
        const JoxLift *in = find_shaft(s, at);
        inside++;
        taken += in != NULL;
        shaft = in ? in : shaft;
    }
    return 2 * taken >= inside && taken > 0 ? shaft : NULL;
}

static void check_sources(const JoxReader *r, const JoxSceneSpec *s) {
    for (uint32_t n = 0; n < s->source_count; n++) {
        const JoxPlace *place = &s->places[s->sources[n].place];
        const bool set = jox_place_is_set(place);
        for (uint32_t m = 0; m < (set ? place->member_count : 1); m++) {
            const uint32_t door = set ? (uint32_t)place->members[m] : s->sources[n].place;
            const JoxLift *shaft = find_filling_shaft(s, s->places, door);
            if (shaft)
                jox_diag_error(r->diagnostics, s->sources[n].position, "no-floor",
                               "Let them come in outside, as before its door",
                               "people would come in at '%.60s', in the shaft of the lift '%.60s'",
                               s->places[door].name, shaft->name);
        }
    }
}

void jox_scene_check_floors(const JoxReader *r) {
    const JoxSceneSpec *s = r->draft->scene;
    if (!jox_has_storeys(&s->storeys))
        return;
    check_places(r, s);
    check_people(r, s);
    check_bodies(r, s);
    check_sources(r, s);
}

/* ---- people in areas ---- */

/* Returns whether a group fills a place, alone or as one of a set. */
static bool fills_place(const JoxSceneSpec *s, const struct JoxFillDraft *fill, int32_t index) {
    for (uint32_t n = 0; n < fill->in_count; n++) {
        const JoxPlace *place = &s->places[fill->in[n]];
        if (fill->in[n] == (uint32_t)index)
            return true;
        for (uint32_t m = 0; jox_place_is_set(place) && m < place->member_count; m++)
            if (place->members[m] == index)
                return true;
    }
    return false;
}

bool jox_scene_check_fill(const JoxReader *r, const JoxYaml *map, const struct JoxFillDraft *fill) {
    const JoxSceneSpec *s = r->draft->scene;
    for (uint32_t n = 0; n < fill->in_count; n++) {
        const JoxPlace *place = &s->places[fill->in[n]];
        const JoxLift *shaft = find_filling_shaft(s, s->places, fill->in[n]);
        if (jox_place_is_set(place) || !shaft ||
            shaft->stops[shaft->home].place == (int32_t)fill->in[n])
            continue;
        jox_scene_error(r, map, "no-floor", "Let them start outside, or in the car on its `home`",
                        "people would start in '%.60s', in the shaft of the lift '%.60s'",
                        place->name, shaft->name);
        return false;
    }
    return true;
}

void jox_scene_add_shafts(const JoxSceneSpec *s, const struct JoxFillDraft *fill, JoxWalls *walls) {
    for (uint32_t l = 0; l < s->lift_count; l++) {
        const JoxLift *lift = &s->lifts[l];
        const JoxLiftStop *home = &lift->stops[lift->home];
        for (uint32_t k = 0; k < s->storeys.storey_count; k++) {
            if (!passes(lift, k) || (home->storey == k && fills_place(s, fill, home->place)))
                continue;
            JoxV2 *points = jox_alloc(lift->point_count, sizeof *points);
            for (uint32_t p = 0; p < lift->point_count; p++)
                points[p] = jox_on_sheet(&s->storeys, k, lift->outline[p]);
            jox_walls_add_solid(walls, points, lift->point_count, INFINITY);
            jox_free(points);
        }
    }
}

/* ---- walls ---- */

/* Finds a point of an edge of a wall that lies well inside an outline. */
static bool find_point_inside(const JoxV2 *outline, uint32_t count, JoxV2 a, JoxV2 b, JoxV2 *at) {
    JoxV2 low, high;
    jox_bounds(outline, count, &low, &high);
    if (!jox_boxes_meet(a, b, low, high))
        return false;
    const int steps = 1 + (int)(jox_length(jox_sub(b, a)) / STEP);
    for (int n = 0; n <= steps; n++) {
        *at = jox_add(a, jox_scale(jox_sub(b, a), (float)n / (float)steps));
        if (jox_polygon_contains(outline, count, *at) &&
            jox_polygon_distance(outline, count, *at, false) > BESIDE)
            return true;
    }
    return false;
}

/* Finds a point of a wall's rings from `first` on that lies in an outline, on a storey. */
static bool find_wall_inside(const JoxSceneSpec *s, uint32_t first, uint32_t storey,
                             const JoxV2 *outline, uint32_t count, JoxV2 *at) {
    const JoxWalls *walls = &s->walls;
    for (uint32_t v = walls->rings[first].first; v < walls->count; v++) {
        const JoxV2 from = walls->vertices[v].point,
                    to = walls->vertices[walls->vertices[v].next].point;
        if (jox_sheet_of(&s->storeys, from.y) == storey &&
            find_point_inside(outline, count, jox_in_plan(&s->storeys, from),
                              jox_in_plan(&s->storeys, to), at))
            return true;
    }
    return false;
}

static void warn_of_wall(const JoxReader *r, const JoxYaml *wall, const char *hint, JoxV2 at,
                         uint32_t storey, const char *what, const char *name) {
    const JoxStoreys *s = &r->draft->scene->storeys;
    JoxText where = {0};
    jox_text_position(&where, s, jox_on_sheet(s, storey, at), 1);
    jox_diag_warn(r->diagnostics, wall->position, "wall-without-effect", hint,
                  "at %s this wall leads into the %s '%.60s', where it has no effect", where.data,
                  what, name);
    jox_text_free(&where);
}

void jox_scene_check_wall_floor(const JoxReader *r, const JoxYaml *wall, uint32_t first) {
    const JoxSceneSpec *s = r->draft->scene;
    JoxV2 at;
    if (!jox_has_storeys(&s->storeys) || first >= s->walls.ring_count)
        return;
    for (uint32_t k = 0; k < s->storeys.stair_count; k++) {
        const JoxStair *stair = &s->storeys.stairs[k];
        for (uint32_t on = stair->lower; jox_stair_joins(stair) && on <= stair->upper; on++)
            if (find_wall_inside(s, first, on, stair->outline, 2 * stair->path_count, &at)) {
                warn_of_wall(r, wall, "End it at the stair, or write the stair's name as `storey`",
                             at, on, "footprint of the stair", stair->name);
                break;
            }
    }
    for (uint32_t l = 0; l < s->lift_count; l++) {
        const JoxLift *lift = &s->lifts[l];
        for (uint32_t on = 0; on < s->storeys.storey_count; on++)
            if (passes(lift, on) &&
                find_wall_inside(s, first, on, lift->outline, lift->point_count, &at)) {
                warn_of_wall(r, wall, "End it at the shaft", at, on, "shaft of the lift",
                             lift->name);
                break;
            }
    }
}
