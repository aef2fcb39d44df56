/* The floor and the scenery of a scene message; a recording that is shown with its scene has them
   too. */
#include "base/hash.h"
#include "live/live_parts.h"

enum { DIGITS = 7 }; /* significant digits of positions and sizes */

static void add_scenery_points(JoxJson *json, const char *key, const JoxV2 *points,
                               uint32_t count) {
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
        add_scenery_points(json, "at", scenery->at, scenery->at_count);
    if (scenery->through_count)
        add_scenery_points(json, "through", scenery->through, scenery->through_count);
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

void jox_live_add_scenery(const JoxSceneSpec *spec, JoxJson *json) {
    jox_json_string(json, "floor", jox_floor_names[spec ? spec->floor : 0]);
    jox_json_array(json, "scenery");
    for (uint32_t i = 0; spec && i < spec->scenery_count; i++)
        add_scenery_item(json, &spec->scenery[i]);
    jox_json_end(json);
}

void jox_live_add_clothes(const JoxSceneSpec *spec, JoxJson *json) {
    static const char *const NAMES[] = {
#define X(clothes, name) name,
        JOX_CLOTHES(X)
#undef X
    };
    jox_json_object(json, "clothes");
    for (uint32_t g = 0; spec && g < spec->group_count; g++)
        if (spec->groups[g].clothes)
            jox_json_string(json, spec->groups[g].name, NAMES[spec->groups[g].clothes]);
    jox_json_end(json);
}

void jox_live_hash_scenery(const JoxSceneSpec *spec, JoxHash *hash) {
    jox_hash_add(hash, &spec->floor, sizeof spec->floor);
    for (uint32_t g = 0; g < spec->group_count; g++)
        jox_hash_add(hash, &spec->groups[g].clothes, sizeof spec->groups[g].clothes);
    for (uint32_t i = 0; i < spec->scenery_count; i++) {
        const JoxScenery *s = &spec->scenery[i];
        jox_hash_add(hash, &s->kind, sizeof s->kind);
        jox_hash_add(hash, s->at, s->at_count * sizeof *s->at);
        jox_hash_add(hash, s->through, s->through_count * sizeof *s->through);
        jox_hash_add(hash, s->faces, s->face_count * sizeof *s->faces);
        jox_hash_add(hash, &s->turn, sizeof s->turn);
        jox_hash_add(hash, s->size, sizeof s->size);
        jox_hash_add(hash, s->doors, s->door_count * sizeof *s->doors);
        jox_hash_add(hash, &s->colour, sizeof s->colour);
    }
}
