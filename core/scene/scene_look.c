/* Writes what a scene shows as JSON, for the live page and for recordings, and reads it back. */
#include "scene/scene_look.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/format/json.h"
#include "base/mem.h"
#include "scene/format/yaml.h"

enum { DIGITS = 7 }; /* significant digits of positions and sizes */

JoxSceneLook jox_scene_look(const JoxSceneSpec *spec) {
    return spec ? (JoxSceneLook){.title = spec->title,
                                 .about = spec->about,
                                 .camera = spec->camera,
                                 .colour = spec->view.colour,
                                 .field = spec->view.field,
                                 .places = spec->places,
                                 .place_count = spec->place_count,
                                 .floor = spec->floor,
                                 .scenery = spec->scenery,
                                 .scenery_count = spec->scenery_count}
                : (JoxSceneLook){.field = JOX_SCENE_NO_FIELD};
}

/* ---- writing ---- */

void jox_scene_add_camera(const JoxSceneLook *look, JoxJson *json) {
    if (!look->camera.given) {
        jox_json_null(json, "camera");
        return;
    }
    jox_json_object(json, "camera");
    jox_json_numbers_of(json, "at", look->camera.position, 3, DIGITS);
    jox_json_numbers_of(json, "look", look->camera.target, 3, DIGITS);
    jox_json_end(json);
}

static void add_points(JoxJson *json, const char *key, const JoxV2 *points, uint32_t count) {
    jox_json_array(json, key);
    for (uint32_t i = 0; i < count; i++)
        jox_json_numbers_of(json, NULL, (double[]){(double)points[i].x, (double)points[i].y}, 2,
                            DIGITS);
    jox_json_end(json);
}

static void add_scenery_item(JoxJson *json, const JoxScenery *scenery) {
    char colour[8];
    jox_json_object(json, NULL);
    jox_json_string(json, "kind", jox_scenery_kinds[scenery->kind].name);
    if (scenery->at_count)
        add_points(json, "at", scenery->at, scenery->at_count);
    if (scenery->through_count)
        add_points(json, "through", scenery->through, scenery->through_count);
    jox_json_array(json, "turns"); /* degrees, of each copy */
    for (uint32_t k = 0; k < scenery->at_count; k++)
        jox_json_digits(json, NULL, jox_scenery_turn(scenery, k), DIGITS);
    jox_json_end(json);
    jox_json_numbers_of(json, "size", scenery->size, 3, DIGITS);
    if (scenery->door_count)
        jox_json_numbers_of(json, "doors", scenery->doors, (int)scenery->door_count, DIGITS);
    if (scenery->colour) {
        jox_colour_write(scenery->colour & 0xffffff, colour);
        jox_json_string(json, "colour", colour);
    }
    if (scenery->body)
        jox_json_string(json, "body", scenery->body);
    jox_json_end(json);
}

void jox_scene_add_scenery(const JoxSceneLook *look, JoxJson *json) {
    jox_json_string(json, "floor", jox_floor_names[look->floor]);
    jox_json_array(json, "scenery");
    for (uint32_t i = 0; i < look->scenery_count; i++)
        add_scenery_item(json, &look->scenery[i]);
    jox_json_end(json);
}

static void add_places(const JoxSceneLook *look, JoxJson *json) {
    jox_json_array(json, "places");
    for (uint32_t p = 0; p < look->place_count; p++) {
        const JoxPlace *place = &look->places[p];
        jox_json_object(json, NULL);
        jox_json_string(json, "name", place->name);
        jox_json_string(json, "kind", jox_place_kinds[place->kind].name);
        jox_json_digits(json, "radius", (double)jox_place_radius(place), DIGITS);
        add_points(json, "points", place->points, place->count);
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_scene_write_look(const JoxSceneLook *look, JoxText *out) {
    JoxJson json = jox_json_begin(out, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "title", look->title);
    jox_json_string(&json, "about", look->about);
    jox_json_object(&json, "view");
    jox_json_string(&json, "colour", jox_scene_colours[look->colour]);
    jox_json_string(&json, "field", jox_scene_fields[look->field]);
    jox_json_end(&json);
    jox_scene_add_camera(look, &json);
    add_places(look, &json);
    jox_scene_add_scenery(look, &json);
    jox_json_end(&json);
}

/* ---- reading ---- */

static const JoxJsonLimits LIMITS = {.length = 1 << 24, .items = 1 << 19, .depth = 6};
enum { MOST_DOORS = 40 };
static const double FARTHEST = 1e6, LARGEST = 1e3; /* m: of positions, of sizes */

typedef struct LookReader {
    JoxArena *arena;
    JoxSceneLook *look;
    uint32_t capacity;
    uint32_t turn_count, size_count; /* of the last item */
} LookReader;

/* Returns a list of `count` items of `size` bytes with room for one more: itself, or a copy of
   twice the length. */
static void *make_room(JoxArena *arena, void *items, uint32_t count, size_t size) {
    if (count & (count - 1) || (count && count < 4)) /* lengths are 4, 8, 16, ... */
        return items;
    void *longer = jox_arena_take(arena, count ? 2 * (size_t)count : 4, size);
    if (count)
        memcpy(longer, items, count * size);
    return longer;
}

/* Finds a word in a list of `count` names; `count` if it is not there. */
static uint32_t find_word(const char *word, const char *const *names, uint32_t count) {
    uint32_t n = 0;
    while (n < count && strcmp(word, names[n]) != 0)
        n++;
    return n;
}

static bool read_kind(JoxScenery *scenery, const char *word) {
    uint32_t kind = 0;
    while (kind < JOX_SCENERY_KIND_COUNT && strcmp(word, jox_scenery_kinds[kind].name) != 0)
        kind++;
    scenery->kind = kind;
    return kind < JOX_SCENERY_KIND_COUNT;
}

/* Adds coordinate 0 or 1 of point `row` to a list of points; they come in order. */
static bool add_coordinate(LookReader *r, JoxV2 **points, uint32_t *count, unsigned row,
                           unsigned axis, double value) {
    if (axis > 1 || row != (axis == 0 ? *count : *count - 1) || !(fabs(value) <= FARTHEST))
        return false;
    if (axis == 0) {
        *points = make_room(r->arena, *points, *count, sizeof **points);
        (*points)[(*count)++] = (JoxV2){(float)value, 0.0f};
    } else if (*count) {
        (*points)[*count - 1].y = (float)value;
    }
    return *count > 0;
}

/* Reads a number of an item: the member "at.3.0" and so on. */
static bool read_scenery_number(LookReader *r, JoxScenery *s, const char *member, double value) {
    unsigned row, column;
    char rest;
    if (sscanf(member, "at.%u.%u%c", &row, &column, &rest) == 2)
        return add_coordinate(r, &s->at, &s->at_count, row, column, value);
    if (sscanf(member, "through.%u.%u%c", &row, &column, &rest) == 2)
        return add_coordinate(r, &s->through, &s->through_count, row, column, value);
    if (sscanf(member, "turns.%u%c", &row, &rest) == 1 && row == r->turn_count) {
        s->turns = make_room(r->arena, s->turns, r->turn_count, sizeof *s->turns);
        s->turns[r->turn_count++] = value;
        return fabs(value) <= FARTHEST;
    }
    if (sscanf(member, "size.%u%c", &row, &rest) == 1 && row == r->size_count && row < 3) {
        s->size[r->size_count++] = value;
        return value >= 0.0 && value <= LARGEST;
    }
    if (sscanf(member, "doors.%u%c", &row, &rest) == 1 && row == s->door_count &&
        row < MOST_DOORS) {
        s->doors = make_room(r->arena, s->doors, s->door_count, sizeof *s->doors);
        s->doors[s->door_count++] = value;
        return fabs(value) <= LARGEST;
    }
    return false;
}

static bool read_scenery_text(LookReader *r, JoxScenery *s, const char *member, const char *text) {
    if (strcmp(member, "kind") == 0)
        return read_kind(s, text);
    if (strcmp(member, "colour") == 0)
        return jox_colour_read(text, &s->colour);
    if (strcmp(member, "body") != 0)
        return false;
    s->body = jox_arena_text(r->arena, text);
    return true;
}

/* Returns whether the camera, if there is one, looks somewhere. */
static bool looks_somewhere(const JoxSceneCamera *camera) {
    return !camera->given || memcmp(camera->position, camera->target, sizeof camera->position) != 0;
}

/* Returns whether the last item is complete: a known kind, with the points that its form needs. */
static bool is_item_whole(const LookReader *r) {
    static const uint32_t LEAST[] = {
        [JOX_SCENERY_LINE] = 2, [JOX_SCENERY_FENCE] = 2, [JOX_SCENERY_AREA] = 3};
    if (r->look->scenery_count == 0)
        return true;
    const JoxScenery *s = &r->look->scenery[r->look->scenery_count - 1];
    if (s->kind >= JOX_SCENERY_KIND_COUNT || r->size_count != 3 || r->turn_count != s->at_count)
        return false;
    const JoxSceneryForm form = jox_scenery_kinds[s->kind].form;
    const bool placed = form == JOX_SCENERY_OPEN || form == JOX_SCENERY_SOLID;
    return placed ? s->at_count > 0 && s->through_count == 0
                  : s->at_count == 0 && s->through_count >= LEAST[form];
}

/* Reads a value of the list "scenery", whose path goes on with `rest`: "12", "12.kind", ... */
static bool read_scenery_value(LookReader *r, const char *rest, const JoxJsonItem *item) {
    char *member;
    const unsigned long index = strtoul(rest, &member, 10);
    JoxSceneLook *look = r->look;
    if (!*member) { /* the item itself */
        if (item->kind != JOX_JSON_OBJECT || index != look->scenery_count || !is_item_whole(r))
            return false;
        look->scenery =
            make_room(r->arena, look->scenery, look->scenery_count, sizeof *look->scenery);
        look->scenery[look->scenery_count++] = (JoxScenery){.kind = JOX_SCENERY_KIND_COUNT};
        r->turn_count = r->size_count = 0;
        return true;
    }
    if (*member != '.' || index + 1 != look->scenery_count)
        return false;
    JoxScenery *scenery = &look->scenery[index];
    return item->kind == JOX_JSON_NUMBER ? read_scenery_number(r, scenery, member + 1, item->number)
           : item->kind == JOX_JSON_TEXT ? read_scenery_text(r, scenery, member + 1, item->text)
                                         : item->kind == JOX_JSON_ARRAY;
}

/* Returns whether the last place has a name and the points of its kind, and computes its centre. */
static bool finish_last_place(const LookReader *r) {
    JoxPlace *place = r->look->place_count ? &r->look->places[r->look->place_count - 1] : NULL;
    if (!place)
        return true;
    if (!place->name || (uint32_t)place->kind >= jox_place_kind_count ||
        place->count < jox_place_kinds[place->kind].least_points)
        return false;
    jox_place_finish(place);
    return isfinite(place->centre.x) && isfinite(place->centre.y);
}

static bool read_place_kind(JoxPlace *place, const char *word) {
    uint32_t kind = 0;
    while (kind < jox_place_kind_count &&
           (!jox_place_kinds[kind].name || strcmp(word, jox_place_kinds[kind].name) != 0))
        kind++;
    place->kind = (JoxPlaceKind)kind;
    return kind < jox_place_kind_count;
}

/* Reads a member of a place, but for its points. */
static bool read_place_member(LookReader *r, JoxPlace *place, const char *member,
                              const JoxJsonItem *item) {
    const bool is_text = item->kind == JOX_JSON_TEXT;
    if (is_text && strcmp(member, "name") == 0)
        return (place->name = jox_arena_text(r->arena, item->text)) != NULL;
    if (is_text && strcmp(member, "kind") == 0)
        return read_place_kind(place, item->text);
    if (item->kind != JOX_JSON_NUMBER || strcmp(member, "radius") != 0)
        return item->kind == JOX_JSON_ARRAY;
    place->radius = (float)item->number;
    return item->number >= 0.0 && item->number <= LARGEST;
}

/* Reads a value of the list "places", as read_scenery_value does. */
static bool read_place_value(LookReader *r, const char *rest, const JoxJsonItem *item) {
    char *member, more;
    unsigned row, axis;
    const unsigned long index = strtoul(rest, &member, 10);
    JoxSceneLook *look = r->look;
    if (!*member) {
        if (item->kind != JOX_JSON_OBJECT || index != look->place_count || !finish_last_place(r))
            return false;
        look->places = make_room(r->arena, look->places, look->place_count, sizeof *look->places);
        look->places[look->place_count++] =
            (JoxPlace){.kind = (JoxPlaceKind)jox_place_kind_count, .start = -1};
        return true;
    }
    if (*member != '.' || index + 1 != look->place_count)
        return false;
    JoxPlace *place = &look->places[index];
    return sscanf(member, ".points.%u.%u%c", &row, &axis, &more) == 2
               ? item->kind == JOX_JSON_NUMBER &&
                     add_coordinate(r, &place->points, &place->count, row, axis, item->number)
               : read_place_member(r, place, member + 1, item);
}

static bool read_camera_value(JoxSceneCamera *camera, const char *rest, const JoxJsonItem *item) {
    unsigned axis;
    char more;
    const bool at = sscanf(rest, "at.%u%c", &axis, &more) == 1;
    if (item->kind == JOX_JSON_ARRAY)
        return true;
    if (item->kind != JOX_JSON_NUMBER || (!at && sscanf(rest, "look.%u%c", &axis, &more) != 1) ||
        axis > 2)
        return false;
    (at ? camera->position : camera->target)[axis] = item->number;
    return fabs(item->number) <= FARTHEST;
}

static bool read_look_value(void *context, const JoxJsonItem *item) {
    LookReader *r = context;
    JoxSceneLook *look = r->look;
    if (strncmp(item->path, "scenery.", 8) == 0)
        return read_scenery_value(r, item->path + 8, item);
    if (strncmp(item->path, "places.", 7) == 0)
        return read_place_value(r, item->path + 7, item);
    if (strncmp(item->path, "camera.", 7) == 0)
        return read_camera_value(&look->camera, item->path + 7, item);
    if (strcmp(item->path, "camera") == 0)
        look->camera.given = item->kind == JOX_JSON_OBJECT;
    if (item->kind != JOX_JSON_TEXT) /* members of later versions are left out */
        return true;
    if (strcmp(item->path, "title") == 0)
        look->title = jox_arena_text(r->arena, item->text);
    else if (strcmp(item->path, "about") == 0)
        look->about = jox_arena_text(r->arena, item->text);
    else if (strcmp(item->path, "floor") == 0)
        look->floor = find_word(item->text, jox_floor_names, jox_floor_count);
    else if (strcmp(item->path, "view.colour") == 0)
        look->colour = find_word(item->text, jox_scene_colours, JOX_SCENE_COLOUR_COUNT);
    else if (strcmp(item->path, "view.field") == 0)
        look->field = find_word(item->text, jox_scene_fields, JOX_SCENE_FIELD_COUNT);
    return look->floor < jox_floor_count && look->colour < JOX_SCENE_COLOUR_COUNT &&
           look->field < JOX_SCENE_FIELD_COUNT;
}

bool jox_scene_read_look(const char *text, JoxSceneLook *look) {
    LookReader reader = {.arena = jox_arena_create(), .look = look};
    *look = (JoxSceneLook){.field = JOX_SCENE_NO_FIELD, .memory = reader.arena};
    if (jox_json_read(text, LIMITS, read_look_value, &reader) && is_item_whole(&reader) &&
        finish_last_place(&reader) && looks_somewhere(&look->camera))
        return true;
    jox_scene_free_look(look);
    return false;
}

void jox_scene_free_look(JoxSceneLook *look) {
    if (look->memory)
        jox_arena_free(look->memory);
    *look = jox_scene_look(NULL);
}
