/* Reads the starts of a group: when, where and how fast each agent comes in, as in a recording. */
#include <math.h>

#include "base/assert.h"
#include "base/sort.h"
#include "scene/scene_draft.h"

enum { MOST_STARTS = 100000 };
#define LATEST 1e6 /* s */
#define FASTEST 10 /* m/s */

/* Reads [s, x, y] or [s, x, y, vx, vy]; without a velocity it is NAN. False with an error. */
static bool read_start(const JoxReader *r, const JoxYaml *row, JoxStart *start) {
    static const char *const UNITS[] = {"s", "m", "m", "m/s", "m/s"};
    static const double LEAST[] = {0, -JOX_FARTHEST, -JOX_FARTHEST, -FASTEST, -FASTEST};
    static const double GREATEST[] = {LATEST, JOX_FARTHEST, JOX_FARTHEST, FASTEST, FASTEST};
    double v[] = {0, 0, 0, NAN, NAN};
    if (row->kind != JOX_YAML_LIST || (row->count != 3 && row->count != 5)) {
        jox_scene_error(r, row, "bad-type", "[0, 1.5, 2], or [4.2, 1.5, 2, 0, -1.3]",
                        "a start is a time and a place, [s, x, y], and may have a velocity, "
                        "[s, x, y, vx, vy]");
        return false;
    }
    for (uint32_t k = 0; k < row->count; k++) {
        if (!jox_read_number(r, row->items[k], UNITS[k], &v[k]))
            return false;
        if (v[k] >= LEAST[k] && v[k] <= GREATEST[k])
            continue;
        jox_scene_error(r, row->items[k], "out-of-range", NULL, "this must be %g to %g %s",
                        LEAST[k], GREATEST[k], UNITS[k]);
        return false;
    }
    *start = (JoxStart){.time = v[0],
                        .at = jox_scene_position(r, (JoxV2){(float)v[1], (float)v[2]}),
                        .velocity = {(float)v[3], (float)v[4]}};
    return true;
}

static bool check_start_bounds(const JoxReader *r, const JoxYaml *row, JoxV2 p) {
    if (jox_scene_is_within_bounds(r->draft->scene, p))
        return true;
    p = jox_in_plan(&r->draft->scene->storeys, p);
    jox_scene_error(r, row, "out-of-bounds", NULL, "(%g, %g) is outside the scene's bounds", p.x,
                    p.y);
    return false;
}

void jox_key_read_starts(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxGroup *group = item;
    (void)key;
    if (!node)
        return;
    if (node->kind != JOX_YAML_LIST || node->count < 1 || node->count > MOST_STARTS) {
        jox_scene_error(r, node, "bad-type", "starts: [[0, 1, 2], [4.5, 1, 2, 1.3, 0]]",
                        "starts are a list of 1 to %d of [s, x, y]", MOST_STARTS);
        return;
    }
    group->starts = jox_arena_take(r->arena, node->count, sizeof *group->starts);
    for (uint32_t i = 0; i < node->count; i++)
        if (read_start(r, node->items[i], &group->starts[group->start_count]) &&
            check_start_bounds(r, node->items[i], group->starts[group->start_count].at))
            group->start_count++;
    JOX_ASSERT(group->start_count <= node->count);
}

static int compare_start_times(const void *left, const void *right, const void *context) {
    const JoxStart *a = left, *b = right;
    (void)context;
    return a->time < b->time ? -1 : a->time > b->time;
}

void jox_place_group_starts(const JoxReader *r, const JoxYaml *map, JoxGroup *group) {
    for (uint32_t s = 0; s < group->set_count; s++)
        if (group->set[s].kind == JOX_SET_ANTIPODE)
            jox_scene_error(r, jox_yaml_get(map, "starts"), "bad-value",
                            "Let the group be bound for a place",
                            "group '%.60s' sets %.60s: antipode, which is for agents who stand on "
                            "a circle at the start; they cannot come in by `starts`",
                            group->name, group->set[s].name);
    if (jox_yaml_get(map, "count") || jox_yaml_get(map, "density"))
        jox_scene_error(r, map, "too-many-keys", "Each start is one agent",
                        "a group has `starts`, or a count or density, not both");
    group->fill = JOX_FILL_AT;
    group->count = 0;
    if (group->start_count == 0)
        return; /* wrong, and reported */
    jox_sort(group->starts, group->start_count, sizeof *group->starts, compare_start_times, NULL,
             NULL);
    group->positions = jox_arena_take(r->arena, group->start_count, sizeof *group->positions);
    while (group->count < group->start_count && group->starts[group->count].time == 0.0) {
        group->positions[group->count] = group->starts[group->count].at;
        group->count++;
    }
}
