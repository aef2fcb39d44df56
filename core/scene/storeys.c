/* Reads storeys and stairs of a scene, lays them out, and moves points to the sheet of their
   storey. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "scene/scene_draft.h"

static const double FARTHEST = 4000.0; /* m: beyond, positions are coarser than .25 mm */
static const float BELT_SPEED = 0.5f;  /* m/s of escalators: EN 115-1 has .5, .65 and .75 */

/* ---- names ---- */

static int32_t find_storey(const JoxSceneDraft *draft, const char *name) {
    for (uint32_t k = 0; k < draft->storeys.storey_count; k++)
        if (strcmp(draft->storeys.storeys[k].name, name) == 0)
            return (int32_t)k;
    return -1;
}

static int32_t find_stair(const JoxSceneDraft *draft, const char *name) {
    for (uint32_t k = 0; k < draft->storeys.stair_count; k++)
        if (strcmp(draft->storeys.stairs[k].stair.name, name) == 0)
            return (int32_t)k;
    return -1;
}

static void report_unknown_storey(const JoxReader *r, const JoxYaml *node, bool stairs) {
    const JoxStoreysDraft *all = &r->draft->storeys;
    const char *names[JOX_MOST_STOREYS + JOX_MOST_STAIRS];
    size_t count = 0;
    for (uint32_t k = 0; k < all->storey_count && count < JOX_MOST_STOREYS; k++)
        names[count++] = all->storeys[k].name;
    for (uint32_t k = 0; stairs && k < all->stair_count && k < JOX_MOST_STAIRS; k++)
        names[count++] = all->stairs[k].stair.name;
    jox_scene_error(r, node, "unknown-storey",
                    count ? jox_scene_suggest(r, node->text, names, count)
                          : "storeys: {ground: {height: 0}, first: {height: 3.5}}",
                    "there is no storey%s '%.60s'", stairs ? " or stair" : "", node->text);
}

int32_t jox_scene_find_storey(const JoxReader *r, const JoxYaml *name) {
    const int32_t storey = find_storey(r->draft, name->text);
    if (storey < 0)
        report_unknown_storey(r, name, false);
    return storey;
}

void jox_key_read_storey(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const JoxStoreys *laid = &r->draft->scene->storeys;
    (void)item;
    const JoxYaml *list = node;
    const bool several = node && node->kind == JOX_YAML_LIST && key->type == JOX_TYPE_NAMES;
    if (several && node->count)
        node = node->items[r->placing->copy];
    if (!jox_key_read_scalar(r, key, node, "name"))
        return;
    for (uint32_t k = 0; several && k < r->placing->copy; k++)
        if (list->items[k]->kind == JOX_YAML_SCALAR && !strcmp(list->items[k]->text, node->text))
            jox_scene_error(r, node, "duplicate-name", "Keep one of them",
                            "the storey '%.60s' is named twice", node->text);
    const int32_t storey = find_storey(r->draft, node->text);
    const int32_t stair = storey < 0 ? find_stair(r->draft, node->text) : -1;
    if (storey < 0 && stair < 0)
        report_unknown_storey(r, node, true);
    else if (laid->sheet_count) /* else they are wrong, or the extent is being measured */
        r->placing->shift =
            (float)(storey < 0 ? laid->stairs[stair].sheet : (uint32_t)storey) * laid->pitch;
}

/* ---- storeys and stairs ---- */

bool jox_finish_storey(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    const JoxStoreysDraft *all = &r->draft->storeys;
    const JoxStorey *storey = item;
    if (!good)
        return false;
    if (all->storey_count >= JOX_MOST_STOREYS)
        jox_scene_error(r, map, "too-many", NULL, "a scene has at most %d storeys",
                        JOX_MOST_STOREYS);
    if (all->storey_count > 0 && !(storey->height > storey[-1].height))
        jox_scene_error(r, jox_yaml_get(map, "height"), "bad-storey",
                        "List storeys from the lowest up",
                        "%.60s, at %g m, is not above %.60s, at %g m", storey->name,
                        (double)storey->height, storey[-1].name, (double)storey[-1].height);
    return true;
}

void jox_key_read_stair_storey(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                               void *item) {
    if (!jox_key_read_scalar(r, key, node, "name"))
        return;
    const int32_t storey = jox_scene_find_storey(r, node);
    if (storey >= 0)
        *JOX_MEMBER(uint32_t, item, key->offset) = (uint32_t)storey;
}

void jox_key_read_landings(const JoxReader *r, const JoxKey *key, const JoxYaml *list, void *item) {
    JoxStair *stair = &((JoxStairDraft *)item)->stair;
    if (!list)
        return;
    if (list->kind != JOX_YAML_LIST) {
        jox_scene_error(r, list, "bad-type", key->example, "landings are a list of [from, to]");
        return;
    }
    stair->landings = jox_arena_take(r->arena, list->count, sizeof *stair->landings);
    for (uint32_t k = 0; k < list->count; k++) {
        double v[2];
        if (!jox_key_read_vector(r, key, list->items[k], v, 2))
            return;
        const double before =
            stair->landing_count ? (double)stair->landings[stair->landing_count - 1].to : 0.0;
        if (!(v[0] < v[1]) || v[0] < before) {
            jox_scene_error(r, list->items[k], "bad-stair", key->example,
                            "a landing goes from one length along the path to a greater one, and "
                            "begins after the landing before it");
            return;
        }
        stair->landings[stair->landing_count++] = (JoxLanding){(float)v[0], (float)v[1]};
    }
}

bool jox_finish_stair(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    const size_t errors = r->diagnostics->errors;
    JoxStairDraft *draft = item;
    JoxStair *stair = &draft->stair;
    if (!good)
        return false;
    stair->kind = (JoxStairKind)draft->kind;
    stair->way = (JoxStairWay)draft->way;
    if (stair->lower > stair->upper)
        jox_scene_error(r, jox_yaml_get(map, "to"), "bad-stair",
                        "Exchange `from` and `to`, and turn the path round",
                        "a stair leads up: `to` is below `from`");
    const bool slope = stair->lower == stair->upper;
    if (slope && !isfinite(draft->rise))
        jox_scene_error(r, map, "missing-key", "rise: 1.2",
                        "steps on one storey need a `rise`, in m");
    else if (!slope && isfinite(draft->rise))
        jox_scene_error(r, jox_yaml_get(map, "rise"), "bad-stair", "Leave it out",
                        "this stair rises by the heights of its storeys");
    stair->rise = slope ? (float)draft->rise : 0.0f;
    const bool moves = stair->kind == JOX_STAIR_ESCALATOR;
    if (moves && stair->way == JOX_STAIR_BOTH_WAYS)
        jox_scene_error(r, map, "bad-stair", "way: up", "an escalator runs up or down");
    if (!moves && isfinite(draft->speed))
        jox_scene_error(r, jox_yaml_get(map, "speed"), "bad-stair", "kind: escalator",
                        "only an escalator has a speed");
    const float speed = isfinite(draft->speed) ? (float)draft->speed : BELT_SPEED;
    stair->belt = !moves ? 0.0f : stair->way == JOX_STAIR_DOWN ? -speed : speed;
    if (find_storey(r->draft, stair->name) >= 0)
        jox_scene_error(r, map, "bad-name", "Choose another", "there is a storey named '%.60s'",
                        stair->name);
    if (r->draft->storeys.stair_count >= JOX_MOST_STAIRS)
        jox_scene_error(r, map, "too-many", NULL, "a scene has at most %d stairs", JOX_MOST_STAIRS);
    if (r->diagnostics->errors == errors)
        jox_scene_check_stair(r, map, stair);
    return true;
}

/* Lays storeys and stairs out, for the extent of all points of the scene. */
static void lay_out(const JoxReader *r, const JoxYaml *node) {
    const JoxStoreysDraft *from = &r->draft->storeys;
    JoxStoreys *to = &r->draft->scene->storeys;
    JoxStair *stairs = jox_arena_take(r->arena, (size_t)from->stair_count + 1, sizeof *stairs);
    for (uint32_t k = 0; k < from->stair_count; k++)
        stairs[k] = from->stairs[k].stair;
    const JoxStoreys written = {.storeys = from->storeys,
                                .storey_count = from->storey_count,
                                .stairs = stairs,
                                .stair_count = from->stair_count};
    jox_storeys_copy(to, &written);
    jox_storeys_lay_out(to, r->placing->low, r->placing->high);
    const double end = (double)to->origin + (double)to->pitch * to->sheet_count;
    if (end > FARTHEST)
        jox_scene_error(r, node, "too-large",
                        "Take fewer storeys, or a plan that is less deep along y",
                        "%u storeys and the stairs between them on a plan of %.0f m along y are "
                        "more than Jostle computes precisely",
                        to->storey_count, (double)(r->placing->high.y - r->placing->low.y));
}

void jox_key_read_stairs(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const size_t errors = r->diagnostics->errors;
    const JoxStoreysDraft *all = &r->draft->storeys;
    if (node && all->storey_count == 0) {
        if (!jox_yaml_get(r->draft->root, "storeys")) /* else they are wrong, and reported */
            jox_scene_error(r, node, "missing-key",
                            "storeys: {ground: {height: 0}, first: {height: 3.5}}",
                            "stairs need `storeys`");
        return;
    }
    jox_key_read_items(r, key, node, item);
    if (all->storey_count > 0 && !r->draft->measuring && r->diagnostics->errors == errors)
        lay_out(r, node ? node : jox_yaml_get(r->draft->root, "storeys"));
}
