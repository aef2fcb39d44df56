/* Reads lifts of a scene. Each adds its walls, and a place for each storey that it serves. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "scene/scene_draft.h"

static const float ON_OUTLINE = 0.05f; /* m: ends of doors may be this far from the outline */
static const double NARROWEST = 0.6;   /* m: of doors */
static const double ROUNDING = 1e-4;   /* m: error of a width that is computed from points */
static const double DENSEST = 7.0;     /* people per m2 of the car's floor */
static const double PERSON = 100.0;    /* kg, for the load that is not given */
static const float LANDING = 1.5f;     /* m: who walks to a lift stops this near to its door */

void jox_key_read_lift_area(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                            void *item) {
    JoxLift *lift = &((JoxLiftDraft *)item)->lift;
    JoxV2 low, high;
    (void)key;
    if (!node)
        return;
    if (node->kind != JOX_YAML_LIST || node->count != 2) {
        lift->outline = jox_read_polygon(r, node, &lift->point_count);
        return;
    }
    if (!jox_read_box(r, node, &low, &high) || !(low.x < high.x && low.y < high.y))
        return;
    lift->outline = jox_arena_take(r->arena, 4, sizeof *lift->outline);
    lift->outline[0] = low;
    lift->outline[1] = jox_v2(high.x, low.y);
    lift->outline[2] = high;
    lift->outline[3] = jox_v2(low.x, high.y);
    lift->point_count = 4;
}

/* Reads the two ends of a door; false with an error. */
static bool read_door(const JoxReader *r, const JoxYaml *node, JoxV2 out[2]) {
    uint32_t count;
    JoxV2 *points = jox_read_points(r, node, 2, &count);
    if (!points)
        return false;
    if (count != 2) {
        jox_scene_error(r, node, "bad-lift", "door: [[0.4, 1.8], [1.2, 1.8]]",
                        "a door has two ends");
        return false;
    }
    out[0] = points[0];
    out[1] = points[1];
    return true;
}

void jox_key_read_lift_door(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                            void *item) {
    JoxLiftDraft *draft = item;
    (void)key;
    draft->has_door = node && read_door(r, node, draft->door);
}

/* Makes the storeys that the key names, default: all, stops of the lift. */
void jox_key_read_lift_storeys(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                               void *item) {
    JoxLiftDraft *draft = item;
    const uint32_t storeys = r->draft->storeys.storey_count;
    const JoxYaml *const *names;
    bool serves[JOX_MOST_STOREYS] = {false};
    (void)key;
    const uint32_t count = jox_read_names(r, node, &names);
    for (uint32_t n = 0; n < count; n++) {
        const int32_t storey = jox_scene_find_storey(r, names[n]);
        if (storey >= 0 && serves[storey])
            jox_scene_error(r, names[n], "duplicate-name", "Keep one of them",
                            "the storey '%.60s' is named twice", names[n]->text);
        else if (storey >= 0)
            serves[storey] = true;
    }
    draft->lift.stops = jox_arena_take(r->arena, (size_t)storeys + 1, sizeof *draft->lift.stops);
    for (uint32_t k = 0; k < storeys; k++)
        if (!node || serves[k])
            draft->lift.stops[draft->lift.stop_count++] = (JoxLiftStop){.storey = k};
}

/* Keeps the doors of single storeys, which jox_finish_lift gives to the stops. */
void jox_key_read_lift_doors(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                             void *item) {
    JoxLiftDraft *draft = item;
    if (!node)
        return;
    if (node->kind != JOX_YAML_MAP) {
        jox_scene_error(r, node, "bad-type", key->example, "doors maps storeys to doors");
        return;
    }
    draft->doors = jox_arena_take(r->arena, node->count, sizeof *draft->doors);
    for (uint32_t k = 0; k < node->count; k++) {
        const JoxYaml name = {
            .kind = JOX_YAML_SCALAR, .text = node->keys[k], .position = node->key_positions[k]};
        const int32_t storey = jox_scene_find_storey(r, &name);
        struct JoxDoorDraft *door = &draft->doors[draft->door_count];
        if (storey >= 0 && read_door(r, node->items[k], door->ends)) {
            door->storey = (uint32_t)storey;
            door->position = node->key_positions[k];
            draft->door_count++;
        }
    }
}

/* ---- checks ---- */

/* Returns the nearest point of the outline, and the number of its edge. */
static JoxV2 find_on_outline(const JoxLift *lift, JoxV2 at, uint32_t *edge) {
    JoxV2 best = at;
    float least = INFINITY;
    for (uint32_t k = 0; k < lift->point_count; k++) {
        const JoxV2 near =
            jox_segment_nearest(lift->outline[k], lift->outline[(k + 1) % lift->point_count], at);
        const float way = jox_length(jox_sub(near, at));
        if (way < least - 1e-6f) {
            least = way;
            best = near;
            *edge = k;
        }
    }
    return best;
}

/* Puts a door on the outline; false with an error if it lies elsewhere. */
static bool fit_door(const JoxReader *r, const JoxYaml *map, const JoxLift *lift,
                     JoxLiftStop *stop) {
    const char *storey = r->draft->storeys.storeys[stop->storey].name;
    const JoxV2 middle = jox_scale(jox_add(stop->door[0], stop->door[1]), 0.5f);
    uint32_t edge = 0;
    const JoxV2 on = find_on_outline(lift, middle, &edge);
    bool good = jox_length(jox_sub(on, middle)) <= ON_OUTLINE;
    for (int k = 0; k < 2; k++) {
        const JoxV2 at = jox_segment_nearest(
            lift->outline[edge], lift->outline[(edge + 1) % lift->point_count], stop->door[k]);
        good &= jox_length(jox_sub(at, stop->door[k])) <= ON_OUTLINE;
        stop->door[k] = at;
    }
    if (!good) {
        jox_scene_error(r, map, "bad-lift", "Both ends lie on one side of `area`",
                        "the door of '%.60s' on storey '%.60s' is not on the outline of its area",
                        lift->name, storey);
        return false;
    }
    const double width = (double)jox_length(jox_sub(stop->door[1], stop->door[0]));
    if (width < NARROWEST - ROUNDING)
        jox_scene_error(r, map, "bad-lift", "0.8 to 1.1 m are usual",
                        "the door of '%.60s' on storey '%.60s' is %.2f m wide: people need %g m",
                        lift->name, storey, width, NARROWEST);
    return width >= NARROWEST - ROUNDING;
}

/* Gives each stop its door; false with an error if one has none. */
static bool give_doors(const JoxReader *r, const JoxYaml *map, JoxLiftDraft *draft) {
    JoxLift *lift = &draft->lift;
    for (uint32_t k = 0; k < draft->door_count; k++)
        if (jox_lift_stop_at(lift, draft->doors[k].storey) < 0)
            jox_scene_error(r, jox_yaml_get(map, "doors"), "bad-lift",
                            "Add the storey to `storeys`, or leave its door out",
                            "'%.60s' does not serve the storey '%.60s' of this door", lift->name,
                            r->draft->storeys.storeys[draft->doors[k].storey].name);
    for (uint32_t s = 0; s < lift->stop_count; s++) {
        JoxLiftStop *stop = &lift->stops[s];
        bool has = draft->has_door;
        memcpy(stop->door, draft->door, sizeof stop->door);
        for (uint32_t k = 0; k < draft->door_count; k++)
            if (draft->doors[k].storey == stop->storey) {
                memcpy(stop->door, draft->doors[k].ends, sizeof stop->door);
                has = true;
            }
        if (!has) {
            jox_scene_error(r, map, "bad-lift", "door: [[0.4, 1.8], [1.2, 1.8]]",
                            "'%.60s' has no door on storey '%.60s'", lift->name,
                            r->draft->storeys.storeys[stop->storey].name);
            return false;
        }
        if (!fit_door(r, map, lift, stop))
            return false;
    }
    return true;
}

/* Returns the stop at the storey that a key names, `none` if it is missing. */
static int32_t find_stop(const JoxReader *r, const JoxYaml *map, const JoxLift *lift,
                         const char *key, uint32_t storey, int32_t none) {
    const JoxYaml *node = jox_yaml_get(map, key);
    const int32_t stop = node ? jox_lift_stop_at(lift, storey) : none;
    if (node && stop < 0)
        jox_scene_error(r, node, "bad-lift", "Add it to `storeys`, or name one that it serves",
                        "'%.60s' does not serve the storey '%.60s'", lift->name, node->text);
    return node && stop < 0 ? none : stop;
}

bool jox_finish_lift(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxLiftDraft *draft = item;
    JoxLift *lift = &draft->lift;
    if (!good || !lift->outline || r->draft->measuring)
        return false;
    if (r->draft->storeys.storey_count == 0)
        return false; /* reported once, for all lifts */
    if (lift->stop_count < 2) {
        jox_scene_error(r, map, "bad-lift", "storeys: [ground, first]",
                        "a lift serves at least two storeys");
        return false;
    }
    const double floor = jox_polygon_area(lift->outline, lift->point_count);
    const JoxYaml *capacity = jox_yaml_get(map, "capacity");
    if (lift->capacity / floor > DENSEST)
        jox_scene_error(r, capacity ? capacity : map, "bad-lift",
                        "Enlarge `area`, or lower `capacity`",
                        "%u people do not fit into the %.2f m2 of '%.60s': more than %g on each m2",
                        lift->capacity, floor, lift->name, DENSEST);
    lift->load = (float)(isfinite(draft->load) ? draft->load : PERSON * lift->capacity);
    lift->home = (uint32_t)find_stop(r, map, lift, "home", draft->home, 0);
    lift->first = find_stop(r, map, lift, "first", draft->first, -1);
    return give_doors(r, map, draft);
}

/* ---- places ---- */

/* Adds the car's floor on each storey that a lift serves to the places. */
static void add_places(const JoxReader *r, const JoxYaml *node, JoxLift *lift, JoxPlace *places,
                       uint32_t *count) {
    const JoxStoreys *storeys = &r->draft->scene->storeys;
    for (uint32_t s = 0; s < lift->stop_count; s++) {
        JoxLiftStop *stop = &lift->stops[s];
        JoxPlace *place = &places[*count];
        char *name = jox_lift_stop_name(lift->name, storeys->storeys[stop->storey].name);
        stop->name = jox_arena_text(r->arena, name);
        jox_free(name);
        stop->place = (int32_t)(*count)++;
        *place = (JoxPlace){
            .name = stop->name,
            .points = jox_arena_take(r->arena, lift->point_count, sizeof *place->points),
            .count = lift->point_count,
            .landing = jox_on_sheet(storeys, stop->storey, jox_lift_point_outside(lift, s, 0.3f)),
            .landing_radius = LANDING,
            .start = -1};
        for (uint32_t k = 0; k < lift->point_count; k++)
            place->points[k] = jox_on_sheet(storeys, stop->storey, lift->outline[k]);
        jox_place_make_area(place);
        jox_place_finish(place);
        const JoxYaml *own = jox_yaml_get(r->draft->root, "places");
        if (own && own->kind == JOX_YAML_MAP && jox_yaml_get(own, stop->name))
            jox_scene_error(r, node, "duplicate-name", "Give the place another name",
                            "the lift '%.60s' makes a place '%.100s', which `places` has too",
                            lift->name, stop->name);
    }
}

/* Returns whether two rings have floor in common: an edge of one crosses an edge of the other, or a
   corner of one is inside the other. */
static bool overlaps(const JoxV2 *a, uint32_t n, const JoxV2 *b, uint32_t m) {
    if (jox_polygon_contains(a, n, jox_polygon_centroid(b, m)) ||
        jox_polygon_contains(b, m, jox_polygon_centroid(a, n)))
        return true;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < m; k++)
            if (jox_segment_crossing(a[i], a[(i + 1) % n], b[k], b[(k + 1) % m]))
                return true;
    return false;
}

/* Reports a shaft that overlaps one of a lift before it, or a stair, on a storey that both pass. */
static void check_room(const JoxReader *r, const JoxYaml *map, const JoxSceneSpec *s, uint32_t l) {
    const JoxLift *lift = &s->lifts[l];
    const uint32_t first = lift->stops[0].storey, last = lift->stops[lift->stop_count - 1].storey;
    for (uint32_t o = 0; o < l; o++) {
        const JoxLift *other = &s->lifts[o];
        if (other->stops[0].storey <= last && first <= other->stops[other->stop_count - 1].storey &&
            overlaps(lift->outline, lift->point_count, other->outline, other->point_count))
            jox_scene_error(r, map, "bad-lift", "Move one of them",
                            "the shafts of '%.60s' and '%.60s' overlap", other->name, lift->name);
    }
    for (uint32_t k = 0; k < s->storeys.stair_count; k++) {
        const JoxStair *stair = &s->storeys.stairs[k];
        if (stair->lower <= last && first <= stair->upper &&
            overlaps(lift->outline, lift->point_count, stair->outline, 2 * stair->path_count))
            jox_scene_error(r, map, "bad-lift", "Move one of them",
                            "the shaft of '%.60s' overlaps the stair '%.60s'", lift->name,
                            stair->name);
    }
}

void jox_key_read_lifts(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxSceneDraft *draft = r->draft;
    JoxSceneSpec *s = draft->scene;
    const size_t errors = r->diagnostics->errors;
    jox_key_read_items(r, key, node, item);
    if (node && draft->storeys.storey_count < 2 && !draft->measuring)
        jox_scene_error(r, node, "missing-key",
                        "storeys: {ground: {height: 0}, first: {height: 3.5}}",
                        "lifts need at least two `storeys`");
    if (draft->lift_count > JOX_MOST_LIFTS)
        jox_scene_error(r, node, "too-many", NULL, "a scene has at most %d lifts", JOX_MOST_LIFTS);
    draft->lifts_wrong = r->diagnostics->errors > errors;
    if (!draft->lift_count || draft->lifts_wrong || !s->storeys.sheet_count)
        return;
    uint32_t stops = 0;
    for (uint32_t l = 0; l < draft->lift_count; l++)
        stops += draft->lifts[l].lift.stop_count;
    JOX_ASSERT(s->place_count == 0); /* lifts come first, so that sets may name their places */
    s->places = jox_arena_take(r->arena, stops, sizeof *s->places);
    s->lifts = jox_arena_take(r->arena, draft->lift_count, sizeof *s->lifts);
    for (uint32_t l = 0; l < draft->lift_count; l++) {
        add_places(r, node, &draft->lifts[l].lift, s->places, &s->place_count);
        s->lifts[s->lift_count++] = draft->lifts[l].lift;
        check_room(r, jox_yaml_get(node, draft->lifts[l].lift.name), s, l);
    }
}

void jox_scene_add_lift_walls(const JoxSceneSpec *scene, JoxWalls *walls) {
    for (uint32_t l = 0; l < scene->lift_count; l++)
        jox_lift_add_walls(&scene->lifts[l], &scene->storeys, walls);
}

bool jox_scene_is_lift_place(const JoxSceneSpec *scene, int32_t place) {
    for (uint32_t l = 0; l < scene->lift_count; l++)
        for (uint32_t s = 0; s < scene->lifts[l].stop_count; s++)
            if (scene->lifts[l].stops[s].place == place)
                return true;
    return false;
}

bool jox_scene_is_wrong_lift(const JoxReader *r, const char *text) {
    const JoxYaml *lifts = jox_yaml_get(r->draft->root, "lifts");
    for (uint32_t k = 0; r->draft->lifts_wrong && lifts->kind == JOX_YAML_MAP && k < lifts->count;
         k++) {
        const size_t n = strlen(lifts->keys[k]);
        if (strncmp(text, lifts->keys[k], n) == 0 && (text[n] == '.' || text[n] == 0))
            return true;
    }
    return false;
}

void jox_scene_check_lift(const JoxReader *r, const JoxYaml *name) {
    const JoxSceneSpec *s = r->draft->scene;
    const char *names[JOX_MOST_LIFTS + 1];
    uint32_t count = 0;
    for (uint32_t l = 0; l < s->lift_count; l++) {
        if (strcmp(s->lifts[l].name, name->text) == 0)
            return;
        names[count++] = s->lifts[l].name;
    }
    names[count++] = "all";
    if ((s->lift_count && strcmp(name->text, "all") == 0) || jox_scene_is_wrong_lift(r, name->text))
        return;
    jox_scene_error(r, name, "unknown-lift",
                    s->lift_count ? jox_scene_suggest(r, name->text, names, count)
                                  : "Add `lifts` to the scene",
                    "there is no lift '%.60s'", name->text);
}
