/* Reads `scenery` of a scene: kinds, points, sizes. */
#include "scene/scenery.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/number/pi.h"
#include "scene/scene_draft.h"

const JoxSceneryKindInfo jox_scenery_kinds[JOX_SCENERY_KIND_COUNT] = {
#define X(kind, name, form, x, y, z, meaning) {name, JOX_SCENERY_##form, {x, y, z}},
    JOX_SCENERY_KINDS(X)
#undef X
};

const char *const jox_floor_names[] = {
#define X(floor, name) name,
    JOX_FLOORS(X)
#undef X
};
const uint32_t jox_floor_count = sizeof jox_floor_names / sizeof *jox_floor_names;

static const double TRUNK = 0.4; /* m, at most: side of the footprint of a tree or lamp */

void jox_key_read_scenery_at(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                             void *item) {
    const bool many = node && node->kind == JOX_YAML_LIST && node->count > 0 &&
                      node->items[0]->kind == JOX_YAML_LIST;
    if (many)
        jox_key_read_points(r, key, node, item);
    else
        jox_key_read_point(r, key, node, item);
}

/* Reads where along a train its doors are, m. */
void jox_key_read_doors(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    enum { MOST_DOORS = 40 };
    JoxScenery *scenery = item;
    if (!node)
        return;
    if (node->kind != JOX_YAML_LIST || node->count < 1 || node->count > MOST_DOORS) {
        jox_scene_error(r, node, "bad-type", key->example, "%s are a list of 1 to %d lengths",
                        key->name, MOST_DOORS);
        return;
    }
    scenery->doors = jox_arena_take(r->arena, node->count, sizeof *scenery->doors);
    for (uint32_t d = 0; d < node->count; d++) {
        double at;
        if (!jox_read_number(r, node->items[d], "m", &at))
            continue;
        if (at >= key->least && at <= key->greatest)
            scenery->doors[scenery->door_count++] = at;
        else
            jox_scene_error(r, node->items[d], "out-of-range", NULL, "this must be %g to %g m",
                            key->least, key->greatest);
    }
}

/* Reports keys that a kind does not have, and those that it lacks. */
static bool check_form(const JoxReader *r, const JoxYaml *map, const JoxScenery *scenery) {
    const JoxSceneryKindInfo *kind = &jox_scenery_kinds[scenery->kind];
    const bool along = kind->form == JOX_SCENERY_LINE || kind->form == JOX_SCENERY_FENCE;
    const bool placed = kind->form == JOX_SCENERY_OPEN || kind->form == JOX_SCENERY_SOLID;
    static const char *const PLACING[] = {"at", "turn", "faces", "body"};
    const char *needed = placed ? "at" : "through";
    const uint32_t least = placed ? 1 : along ? 2 : 3;
    bool good = true;
    for (size_t k = 0; !placed && k < sizeof PLACING / sizeof *PLACING; k++) {
        const JoxYaml *node = jox_yaml_get(map, PLACING[k]);
        good = good && !node;
        if (node)
            jox_scene_error(r, node, "bad-scenery", "Give the points that it goes through",
                            "`%s` is not for kind %s", PLACING[k], kind->name);
    }
    if (placed && jox_yaml_get(map, "through")) {
        jox_scene_error(r, jox_yaml_get(map, "through"), "bad-scenery", "at: [2, 3]",
                        "`through` is not for kind %s, which stands at points", kind->name);
        good = false;
    }
    if (good && !jox_yaml_get(map, needed)) {
        jox_scene_error(r, map, "missing-key",
                        placed ? "at: [2, 3]" : "through: [[0, 0], [4, 0], [4, 3]]",
                        "kind %s needs `%s`", kind->name, needed);
        return false;
    }
    if (!placed && scenery->through && scenery->through_count < least) {
        jox_scene_error(r, jox_yaml_get(map, "through"), "bad-scenery", NULL,
                        "kind %s goes through at least %u points", kind->name, least);
        good = false;
    }
    if (jox_yaml_get(map, "storey") && jox_yaml_get(map, "body")) {
        jox_scene_error(r, jox_yaml_get(map, "storey"), "bad-scenery", "Leave it out",
                        "what a body carries is on the storey of the body");
        good = false;
    }
    if (jox_yaml_get(map, "doors") && scenery->kind != JOX_SCENERY_KIND_TRAIN) {
        jox_scene_error(r, jox_yaml_get(map, "doors"), "bad-scenery", NULL,
                        "only a train has `doors`");
        good = false;
    }
    return good;
}

bool jox_finish_scenery(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxScenery *scenery = item;
    JOX_ASSERT(scenery->kind < JOX_SCENERY_KIND_COUNT);
    for (int k = 0; k < 3; k++)
        if (!(scenery->size[k] > 0.0))
            scenery->size[k] = jox_scenery_kinds[scenery->kind].size[k];
    return good && check_form(r, map, scenery);
}

/* Looks up the body that carries it; copies of a body are NAME-1, NAME-2, ... */
void jox_resolve_scenery(const JoxReader *r, const JoxYaml *map, void *item) {
    enum { MOST_NAMES = 512 };
    const JoxSceneSpec *s = r->draft->scene;
    const JoxScenery *scenery = item;
    const char *names[MOST_NAMES];
    uint32_t count = 0;
    if (!scenery->body)
        return;
    for (uint32_t b = 0; b < s->body_count; b++) {
        const char *name = s->bodies[b].def.name;
        if (name && strcmp(name, scenery->body) == 0)
            return;
        if (name && count < MOST_NAMES)
            names[count++] = name;
    }
    jox_scene_error(r, jox_yaml_get(map, "body"), "unknown-body",
                    jox_scene_suggest(r, scenery->body, names, count), "there is no body '%.60s'",
                    scenery->body);
}

double jox_scenery_turn(const JoxScenery *scenery, uint32_t copy) {
    JOX_ASSERT(copy < scenery->at_count);
    if (scenery->turns)
        return scenery->turns[copy];
    if (scenery->face_count == 0)
        return scenery->turn;
    const JoxV2 back = jox_sub(scenery->at[copy], scenery->faces[0]); /* direction of its y axis */
    return scenery->turn + atan2(-(double)back.x, (double)back.y) / JOX_DEGREE;
}

void jox_scenery_footprint(const JoxScenery *scenery, uint32_t copy, JoxV2 corners[4]) {
    static const float SIGNS[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const bool trunk =
        scenery->kind == JOX_SCENERY_KIND_TREE || scenery->kind == JOX_SCENERY_KIND_LAMP;
    const double most = trunk ? TRUNK : (double)INFINITY;
    const double turn = jox_scenery_turn(scenery, copy) * JOX_DEGREE;
    const JoxV2 at = scenery->at[copy];
    const float x = (float)(0.5 * fmin(scenery->size[0], most));
    const float y = (float)(0.5 * fmin(scenery->size[1], most));
    const float c = (float)cos(turn), s = (float)sin(turn); /* no state: it is for warnings */
    for (int k = 0; k < 4; k++) {
        const float dx = SIGNS[k][0] * x, dy = SIGNS[k][1] * y;
        corners[k] = jox_v2(at.x + c * dx - s * dy, at.y + s * dx + c * dy);
    }
}
