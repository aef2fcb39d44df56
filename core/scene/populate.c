/* Where the agents of a group stand at the start. */
#include <math.h>
#include <string.h>

#include "base/elementary.h"
#include "base/mem.h"
#include "geom/fill.h"
#include "scene/internal.h"

enum { MOST_AGENTS = 1000000 };

static uint32_t read_places(const JoxLoad *l, const JoxYaml *node, uint32_t **out) {
    const JoxYaml *const *names;
    uint32_t count = jox_read_names(&l->reader, node, &names), n = 0;
    *out = jox_arena_take(l->reader.arena, count, sizeof **out);
    for (uint32_t i = 0; i < count; i++) {
        int32_t place = jox_load_place(l, names[i]);
        /* One that was wrong has no points; that is reported already. */
        if (place >= 0 && (l->scene->places[place].count || l->scene->places[place].member_count))
            (*out)[n++] = (uint32_t)place;
    }
    return n;
}

static void circle(const JoxLoad *l, const JoxYaml *map, const uint32_t *in, uint32_t in_count,
                   JoxGroup *group) {
    const JoxPlace *place = in_count == 1 ? &l->scene->places[in[0]] : NULL;
    if (!place || place->kind != JOX_PLACE_POINT) {
        jox_scene_error(&l->reader, map, "bad-fill", "in: a place with point and radius",
                        "a circle is filled about one point");
        return;
    }
    group->centre = place->centre;
    group->positions = jox_arena_take(l->reader.arena, group->count, sizeof *group->positions);
    for (uint32_t i = 0; i < group->count; i++) {
        double angle = 6.283185307179586 * i / group->count;
        group->positions[i] = (JoxV2){place->centre.x + place->radius * (float)jox_cos(angle),
                                      place->centre.y + place->radius * (float)jox_sin(angle)};
    }
}

/* Along one line, each in the middle of an equal share of it: where the line's ends are joined by
   periodic edges, nobody stands closer there than elsewhere. */
static void line(const JoxLoad *l, const JoxYaml *map, const uint32_t *in, uint32_t in_count,
                 JoxGroup *group) {
    const JoxPlace *place = in_count == 1 ? &l->scene->places[in[0]] : NULL;
    if (!place || place->kind != JOX_PLACE_LINE) {
        jox_scene_error(&l->reader, map, "bad-fill", "in: a place with line",
                        "`fill: line` goes along one line");
        return;
    }
    JoxV2 from = place->points[0], way = jox_sub(place->points[1], from);
    group->positions = jox_arena_take(l->reader.arena, group->count, sizeof *group->positions);
    for (uint32_t i = 0; i < group->count; i++)
        group->positions[i] =
            jox_add(from, jox_scale(way, (float)((i + 0.5) / (double)group->count)));
}

static void area(const JoxLoad *l, const JoxYaml *map, const JoxArea *a, JoxFillMode mode,
                 float spacing, uint32_t number, JoxGroup *group) {
    JoxV2 *positions = NULL;
    uint32_t fit = jox_fill(a, mode, group->count, spacing, l->scene->seed, number, &positions);
    if (fit < group->count)
        jox_scene_error(&l->reader, map, "too-many", "Lower count or spacing, or widen the area",
                        "%u of %u agents fit", fit, group->count);
    group->count = fit < group->count ? fit : group->count;
    group->positions = jox_arena_take(l->reader.arena, group->count, sizeof *group->positions);
    if (positions)
        memcpy(group->positions, positions, group->count * sizeof *positions);
    jox_free(positions);
}

/* Whether a source makes agents like a group. */
static bool has_source(const JoxLoad *l, const JoxGroup *group) {
    const JoxYaml *list = jox_yaml_get(l->root, "sources");
    for (uint32_t s = 0; list && list->kind == JOX_YAML_LIST && s < list->count; s++) {
        const JoxYaml *like = jox_yaml_get(list->items[s], "like");
        if (like && like->kind == JOX_YAML_SCALAR && strcmp(like->text, group->name) == 0)
            return true;
    }
    return false;
}

/* `node`: the group, or the list of its agents' points. */
static void check_bounds(const JoxLoad *l, const JoxYaml *node, const JoxGroup *group) {
    const JoxSceneSpec *s = l->scene;
    for (uint32_t i = 0; s->bounded && group->positions && i < group->count; i++) {
        JoxV2 p = group->positions[i];
        if (p.x >= s->low.x && p.x <= s->high.x && p.y >= s->low.y && p.y <= s->high.y)
            continue;
        if (node->kind == JOX_YAML_LIST)
            node = node->items[i];
        jox_scene_error(&l->reader, node, "out-of-bounds", NULL,
                        "agent %u at (%g, %g) is outside the scene's bounds", i + 1, p.x, p.y);
        return;
    }
}

void jox_load_positions(const JoxLoad *l, const JoxYaml *map, JoxGroup *group, uint32_t number) {
    const JoxYaml *at = jox_yaml_get(map, "at"), *count = jox_yaml_get(map, "count");
    const JoxYaml *density = jox_yaml_get(map, "density");
    if (at) {
        group->positions = jox_read_points(&l->reader, at, 1, &group->count);
        check_bounds(l, at, group);
        return;
    }
    if (!count == !density) {
        jox_scene_error(&l->reader, map, "missing-key", "count: 100, density: 2, or at: [[0, 0]]",
                        "a group needs one of count, density and at");
        return;
    }
    double number_of = jox_key_number(&l->reader, map, "group", count ? "count" : "density");
    if (!isfinite(number_of))
        return;
    if (count && number_of == 0 && has_source(l, group))
        return; /* nobody is there at the start */
    uint32_t *in, *out;
    uint32_t in_count = read_places(l, jox_yaml_get(map, "in"), &in);
    uint32_t out_count = read_places(l, jox_yaml_get(map, "outside"), &out);
    if (in_count == 0) {
        if (!jox_yaml_get(map, "in"))
            jox_scene_error(&l->reader, map, "missing-key", "in: NAME",
                            "a group needs `in`, places");
        return;
    }
    JoxArea a = {l->scene->places, in, out, in_count, out_count, &l->scene->walls, 0.2f};
    if (density)
        number_of = floor(number_of * jox_area_size(&a) + 0.5);
    if (!(number_of >= 1 && number_of <= MOST_AGENTS)) {
        jox_scene_error(&l->reader, density ? density : count, "out-of-range",
                        "A group may begin empty, with count: 0, where a source is like it",
                        "this makes %g agents; 1 to 1,000,000 are possible", number_of);
        return;
    }
    for (uint32_t g = 0; g < number; g++)
        number_of += l->scene->groups[g].count;
    if (number_of > MOST_AGENTS) {
        jox_scene_error(&l->reader, density ? density : count, "too-many", NULL,
                        "with this group the scene has %g agents; 1,000,000 are possible",
                        number_of);
        return;
    }
    for (uint32_t g = 0; g < number; g++)
        number_of -= l->scene->groups[g].count;
    group->count = (uint32_t)number_of;
    int fill = jox_key_choice(&l->reader, map, "group", "fill"); /* in the order of JoxFillMode */
    group->fill = fill < 0 ? JOX_FILL_AT : (JoxFillMode)fill;
    double spacing = jox_key_number(&l->reader, map, "group", "spacing");
    if (group->fill == JOX_FILL_CIRCLE)
        circle(l, map, in, in_count, group);
    else if (group->fill == JOX_FILL_LINE)
        line(l, map, in, in_count, group);
    else if (fill >= 0)
        area(l, map, &a, group->fill, isfinite(spacing) ? (float)spacing : 0.0f, number, group);
    check_bounds(l, map, group);
}
