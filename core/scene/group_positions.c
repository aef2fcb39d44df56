/* Computes where the agents of a group stand at the start. Called by groups.c. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/plurals.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "geom/start_positions.h"
#include "geom/wall_images.h"
#include "scene/scene_draft.h"

enum { MOST_AGENTS = 1000000 };
/* m between agents on a circle or a line; the first step moves them apart. */
static const float CLOSEST = 0.005f;

/* Reads the indices of the places that a group fills, or keeps out of. */
void jox_key_read_fills(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const JoxYaml *const *names;
    uint32_t count = jox_read_names(r, node, &names), n = 0;
    uint32_t *out = jox_arena_take(r->arena, count, sizeof *out);
    for (uint32_t i = 0; i < count; i++) {
        int32_t place = jox_scene_find_place(r, names[i]);
        /* A place that is wrong has no points, and is reported already. */
        if (place >= 0 &&
            (r->draft->scene->places[place].count || r->draft->scene->places[place].member_count))
            out[n++] = (uint32_t)place;
    }
    JOX_ASSERT(n <= count);
    *JOX_MEMBER(uint32_t *, item, key->offset) = out;
    *JOX_MEMBER(uint32_t, item, key->count_offset) = n;
}

/* Whether a group has room along `way` m; reports an error if not. */
static bool check_length(const JoxReader *r, const JoxYaml *map, const JoxGroup *group, float way) {
    char agents[JOX_NOUN];
    const bool fit = (float)(group->count - 1) * CLOSEST <= way;
    if (!fit)
        jox_scene_error(r, map, "too-many", "Lower count, or widen the place",
                        "%s on %.3g m would stand less than %g m apart",
                        jox_noun(agents, group->count, "agent"), (double)way, (double)CLOSEST);
    return fit;
}

/* Returns the place that a group fills if there is exactly one; else NULL. */
static const JoxPlace *get_single_place(const JoxReader *r) {
    return r->draft->fill.in_count == 1 ? &r->draft->scene->places[r->draft->fill.in[0]] : NULL;
}

static void fill_circle(const JoxReader *r, const JoxYaml *map, JoxGroup *group) {
    const JoxPlace *place = get_single_place(r);
    if (!place || !jox_place_is_spot(place)) {
        jox_scene_error(r, map, "bad-fill", "in: a place with point and radius",
                        "a circle is filled about one point");
        return;
    }
    if (!check_length(r, map, group, (float)JOX_TURN * place->radius))
        return;
    group->centre = place->centre;
    group->positions = jox_arena_take(r->arena, group->count, sizeof *group->positions);
    for (uint32_t i = 0; i < group->count; i++) {
        double angle = JOX_TURN * i / group->count;
        group->positions[i] = (JoxV2){place->centre.x + place->radius * (float)jox_cos(angle),
                                      place->centre.y + place->radius * (float)jox_sin(angle)};
    }
}

/* Places agents along one line, each in the middle of an equal share of it: so the distances are
   equal even where periodic bounds join the line's ends. */
static void fill_line(const JoxReader *r, const JoxYaml *map, JoxGroup *group) {
    const JoxPlace *place = get_single_place(r);
    if (!place || !jox_place_is_line(place)) {
        jox_scene_error(r, map, "bad-fill", "in: a place with line",
                        "`fill: line` goes along one line");
        return;
    }
    JoxV2 from = place->points[0], way = jox_sub(place->points[1], from);
    if (!check_length(r, map, group, jox_length(way)))
        return;
    group->positions = jox_arena_take(r->arena, group->count, sizeof *group->positions);
    for (uint32_t i = 0; i < group->count; i++)
        group->positions[i] =
            jox_add(from, jox_scale(way, (float)((i + 0.5) / (double)group->count)));
}

/* Returns the positions of all groups read so far, to be freed by jox_free. */
static JoxV2 *list_positions(const JoxSceneSpec *s, uint32_t *count) {
    *count = 0;
    for (uint32_t g = 0; g < s->group_count; g++)
        *count += s->groups[g].positions ? s->groups[g].count : 0;
    JoxV2 *points = jox_alloc((size_t)*count + 1, sizeof *points);
    uint32_t n = 0;
    for (uint32_t g = 0; g < s->group_count; g++)
        for (uint32_t i = 0; s->groups[g].positions && i < s->groups[g].count; i++)
            points[n++] = s->groups[g].positions[i];
    JOX_ASSERT(n == *count);
    return points;
}

static void fill_area(const JoxReader *r, const JoxYaml *map, JoxArea *a, JoxFillMode spread,
                      float spacing, uint32_t number, JoxGroup *group) {
    JoxV2 *positions = NULL, *taken = NULL;
    if (spread == JOX_FILL_RANDOM)
        a->taken = taken = list_positions(r->draft->scene, &a->taken_count);
    uint32_t fit =
        jox_fill(a, spread, group->count, spacing, r->draft->scene->seed, number, &positions);
    jox_free(taken);
    a->taken = NULL;
    char agents[JOX_NOUN];
    if (fit < group->count)
        jox_scene_error(
            r, map, "too-many",
            "Lower count, density or spacing, or widen the area; `fill: hex` packs closest",
            "%u of %s fit", fit, jox_noun(agents, group->count, "agent"));
    group->count = fit < group->count ? fit : group->count;
    group->positions = jox_arena_take(r->arena, group->count, sizeof *group->positions);
    if (positions)
        memcpy(group->positions, positions, group->count * sizeof *positions);
    jox_free(positions);
}

/* Whether a source of the scene has `like: GROUP`. Sources are read after groups, hence from the
   tree. */
static bool has_source(const JoxReader *r, const JoxGroup *group) {
    const JoxYaml *list = jox_yaml_get(r->draft->root, "sources");
    for (uint32_t s = 0; list && list->kind == JOX_YAML_LIST && s < list->count; s++) {
        const JoxYaml *like = jox_yaml_get(list->items[s], "like");
        if (like && like->kind == JOX_YAML_SCALAR && strcmp(like->text, group->name) == 0)
            return true;
    }
    return false;
}

/* Reports the first agent outside the bounds, at `node`: the group, or the list of its points. */
static void check_group_bounds(const JoxReader *r, const JoxYaml *node, const JoxGroup *group) {
    const JoxSceneSpec *s = r->draft->scene;
    for (uint32_t i = 0; group->positions && i < group->count; i++) {
        JoxV2 p = group->positions[i];
        if (jox_scene_is_within_bounds(s, p))
            continue;
        if (node->kind == JOX_YAML_LIST)
            node = node->items[i];
        p = jox_in_plan(&s->storeys, p);
        jox_scene_error(r, node, "out-of-bounds", NULL,
                        "agent %u at (%g, %g) is outside the scene's bounds", i + 1, p.x, p.y);
        return;
    }
}

/* Whether a count is written as 0; false if it is wrong. */
static bool is_zero_count(const JoxYaml *count) {
    char *end;
    return count->kind == JOX_YAML_SCALAR && strtod(count->text, &end) == 0.0 && !*end;
}

/* Returns the number of agents at the start, from the count or the density; 0 with an error. */
static uint32_t compute_count(const JoxReader *r, const JoxYaml *map, const JoxArea *area,
                              const JoxGroup *group) {
    const JoxYaml *density = jox_yaml_get(map, "density");
    const JoxYaml *from = density ? density : jox_yaml_get(map, "count");
    const double number =
        density ? floor(r->draft->fill.density * jox_area_floor(area) + 0.5) : (double)group->count;
    if (!(number >= 1 && number <= MOST_AGENTS)) {
        jox_scene_error(r, from, "out-of-range",
                        "A group may begin empty, with count: 0, where a source is like it",
                        "this makes %g agents; 1 to 1,000,000 are possible", number);
        return 0;
    }
    double all = number;
    for (uint32_t g = 0; g < r->draft->scene->group_count; g++)
        all += r->draft->scene->groups[g].count;
    if (all <= MOST_AGENTS)
        return (uint32_t)number;
    jox_scene_error(r, from, "too-many", NULL,
                    "with this group the scene has %g agents; 1,000,000 are possible", all);
    return 0;
}

/* Uses the points of the key `at`. */
static void take_given_points(const JoxReader *r, const JoxYaml *at, JoxGroup *group) {
    group->fill = JOX_FILL_AT;
    check_group_bounds(r, at, group);
}

/* Returns the period of the bounds, m; 0 along an axis that is not joined. */
static JoxV2 get_period(const JoxSceneSpec *s) {
    return (JoxV2){s->periodic_x ? s->high.x - s->low.x : 0.0f,
                   s->periodic_y ? s->high.y - s->low.y : 0.0f};
}

/* Copies the walls that agents keep clear of at the start: with open gates, shafts of lifts, and
   images of walls beyond periodic bounds. To be freed by jox_walls_free. */
static JoxWalls copy_shut_walls(const JoxSceneSpec *s, const struct JoxFillDraft *fill) {
    JoxWalls shut = s->walls, walls = {0};
    shut.rings = jox_alloc((size_t)shut.ring_count + 1, sizeof *shut.rings);
    for (uint32_t r = 0; r < shut.ring_count; r++) {
        shut.rings[r] = s->walls.rings[r];
        shut.rings[r].open = false;
    }
    jox_walls_standing(&walls, &shut, true);
    jox_scene_add_shafts(s, fill, &walls);
    jox_wall_images_add(&walls, (JoxV2){s->low.x, s->low.y}, get_period(s), (JoxV2){0.0f, 0.0f});
    jox_free(shut.rings);
    return walls;
}

/* Sets the positions of a group's agents in its places. */
static void fill_group_places(const JoxReader *r, const JoxYaml *map, JoxArea *a, JoxGroup *group) {
    const struct JoxFillDraft *fill = &r->draft->fill;
    if (group->fill == JOX_FILL_CIRCLE) {
        fill_circle(r, map, group);
        return;
    }
    if (group->fill == JOX_FILL_LINE) {
        fill_line(r, map, group);
        return;
    }
    fill_area(r, map, a, group->fill, isfinite(fill->spacing) ? fill->spacing : 0.0f,
              r->draft->scene->group_count, group);
    group->in = fill->in;
    group->in_count = fill->in_count;
    group->outside = fill->outside;
    group->outside_count = fill->outside_count;
}

void jox_place_group(const JoxReader *r, const JoxYaml *map, JoxGroup *group) {
    const JoxYaml *at = jox_yaml_get(map, "at"), *count = jox_yaml_get(map, "count");
    const JoxYaml *density = jox_yaml_get(map, "density");
    const JoxSceneSpec *s = r->draft->scene;
    const struct JoxFillDraft *fill = &r->draft->fill;
    if (at) {
        take_given_points(r, at, group);
        return;
    }
    if (jox_yaml_get(map, "starts")) {
        jox_place_group_starts(r, map, group);
        return;
    }
    if (!count == !density) {
        jox_scene_error(r, map, "missing-key", "count: 100, density: 2, or at: [[0, 0]]",
                        "a group needs one of count, density, at and starts");
        return;
    }
    if (density ? !isfinite(r->draft->fill.density) : group->count == 0 && !is_zero_count(count))
        return; /* wrong, and reported already */
    if (count && group->count == 0 && has_source(r, group))
        return; /* nobody is there at the start */
    if (fill->in_count == 0 || !jox_scene_check_fill(r, map, fill)) {
        if (!jox_yaml_get(map, "in"))
            jox_scene_error(r, map, "missing-key", "in: NAME", "a group needs `in`, places");
        group->count = 0;
        return;
    }
    JoxWalls walls = copy_shut_walls(s, fill);
    JoxArea a = {.places = s->places,
                 .in = fill->in,
                 .out = fill->outside,
                 .in_count = fill->in_count,
                 .out_count = fill->outside_count,
                 .walls = &walls,
                 .storeys = &s->storeys,
                 .clear = 0.2f,
                 .period = get_period(s)};
    group->count = compute_count(r, map, &a, group);
    if (group->count > 0)
        fill_group_places(r, map, &a, group);
    jox_walls_free(&walls);
    if (group->count == 0)
        return;
    JOX_ASSERT(group->positions || r->diagnostics->errors > 0);
    check_group_bounds(r, map, group);
}
