/* Where the agents of a group stand at the start. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/noun.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "geom/fill.h"
#include "geom/wall_images.h"
#include "scene/internal.h"

enum { MOST_AGENTS = 1000000 };
static const float CLOSEST =
    0.005f; /* m between those on a circle or a line, who are moved apart */

/* The places that a group fills, or keeps out of: indices. */
void jox_key_fills(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const JoxYaml *const *names;
    uint32_t count = jox_read_names(r, node, &names), n = 0;
    uint32_t *out = jox_arena_take(r->arena, count, sizeof *out);
    for (uint32_t i = 0; i < count; i++) {
        int32_t place = jox_load_place(r, names[i]);
        /* One that was wrong has no points; that is reported already. */
        if (place >= 0 &&
            (r->load->scene->places[place].count || r->load->scene->places[place].member_count))
            out[n++] = (uint32_t)place;
    }
    JOX_ASSERT(n <= count);
    *JOX_MEMBER(uint32_t *, item, key->offset) = out;
    *JOX_MEMBER(uint32_t, item, key->counter) = n;
}

/* Whether all of a group stand along a way of so many metres; else an error. */
static bool fit_along(const JoxReader *r, const JoxYaml *map, const JoxGroup *group, float way) {
    char agents[JOX_NOUN];
    const bool fit = (float)(group->count - 1) * CLOSEST <= way;
    if (!fit)
        jox_scene_error(r, map, "too-many", "Lower count, or widen the place",
                        "%s on %.3g m would stand less than %g m apart",
                        jox_noun(agents, group->count, "agent"), (double)way, (double)CLOSEST);
    return fit;
}

static void circle(const JoxReader *r, const JoxYaml *map, JoxGroup *group) {
    const JoxPlace *place =
        r->load->fill.in_count == 1 ? &r->load->scene->places[r->load->fill.in[0]] : NULL;
    if (!place || !jox_place_is_spot(place)) {
        jox_scene_error(r, map, "bad-fill", "in: a place with point and radius",
                        "a circle is filled about one point");
        return;
    }
    if (!fit_along(r, map, group, (float)JOX_TURN * place->radius))
        return;
    group->centre = place->centre;
    group->positions = jox_arena_take(r->arena, group->count, sizeof *group->positions);
    for (uint32_t i = 0; i < group->count; i++) {
        double angle = JOX_TURN * i / group->count;
        group->positions[i] = (JoxV2){place->centre.x + place->radius * (float)jox_cos(angle),
                                      place->centre.y + place->radius * (float)jox_sin(angle)};
    }
}

/* Along one line, each in the middle of an equal share of it: where the line's ends are joined by
   periodic edges, nobody stands closer there than elsewhere. */
static void line(const JoxReader *r, const JoxYaml *map, JoxGroup *group) {
    const JoxPlace *place =
        r->load->fill.in_count == 1 ? &r->load->scene->places[r->load->fill.in[0]] : NULL;
    if (!place || !jox_place_is_line(place)) {
        jox_scene_error(r, map, "bad-fill", "in: a place with line",
                        "`fill: line` goes along one line");
        return;
    }
    JoxV2 from = place->points[0], way = jox_sub(place->points[1], from);
    if (!fit_along(r, map, group, jox_length(way)))
        return;
    group->positions = jox_arena_take(r->arena, group->count, sizeof *group->positions);
    for (uint32_t i = 0; i < group->count; i++)
        group->positions[i] =
            jox_add(from, jox_scale(way, (float)((i + 0.5) / (double)group->count)));
}

/* Where those of the groups before it stand; the caller frees them. */
static JoxV2 *others(const JoxSceneSpec *s, uint32_t *count) {
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

static void area(const JoxReader *r, const JoxYaml *map, JoxArea *a, JoxFillMode spread,
                 float spacing, uint32_t number, JoxGroup *group) {
    JoxV2 *positions = NULL, *taken = NULL;
    if (spread == JOX_FILL_RANDOM)
        a->taken = taken = others(r->load->scene, &a->taken_count);
    uint32_t fit =
        jox_fill(a, spread, group->count, spacing, r->load->scene->seed, number, &positions);
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

/* Whether a source makes agents like a group. */
static bool has_source(const JoxReader *r, const JoxGroup *group) {
    const JoxYaml *list = jox_yaml_get(r->load->root, "sources");
    for (uint32_t s = 0; list && list->kind == JOX_YAML_LIST && s < list->count; s++) {
        const JoxYaml *like = jox_yaml_get(list->items[s], "like");
        if (like && like->kind == JOX_YAML_SCALAR && strcmp(like->text, group->name) == 0)
            return true;
    }
    return false;
}

/* `node`: the group, or the list of its agents' points. */
static void check_bounds(const JoxReader *r, const JoxYaml *node, const JoxGroup *group) {
    const JoxSceneSpec *s = r->load->scene;
    for (uint32_t i = 0; s->bounded && group->positions && i < group->count; i++) {
        JoxV2 p = group->positions[i];
        if (p.x >= s->low.x && p.x <= s->high.x && p.y >= s->low.y && p.y <= s->high.y)
            continue;
        if (node->kind == JOX_YAML_LIST)
            node = node->items[i];
        jox_scene_error(r, node, "out-of-bounds", NULL,
                        "agent %u at (%g, %g) is outside the scene's bounds", i + 1, p.x, p.y);
        return;
    }
}

/* Whether a count says that there is nobody: one that is wrong does not. */
static bool is_zero(const JoxYaml *count) {
    char *end;
    return count->kind == JOX_YAML_SCALAR && strtod(count->text, &end) == 0.0 && !*end;
}

/* How many agents a group has at the start; 0, with an error, if that is impossible. */
static uint32_t number_of(const JoxReader *r, const JoxYaml *map, const JoxArea *area,
                          const JoxGroup *group) {
    const JoxYaml *density = jox_yaml_get(map, "density");
    const JoxYaml *from = density ? density : jox_yaml_get(map, "count");
    const double number =
        density ? floor(r->load->fill.density * jox_area_floor(area) + 0.5) : (double)group->count;
    if (!(number >= 1 && number <= MOST_AGENTS)) {
        jox_scene_error(r, from, "out-of-range",
                        "A group may begin empty, with count: 0, where a source is like it",
                        "this makes %g agents; 1 to 1,000,000 are possible", number);
        return 0;
    }
    double all = number;
    for (uint32_t g = 0; g < r->load->scene->group_count; g++) /* those before it */
        all += r->load->scene->groups[g].count;
    if (all <= MOST_AGENTS)
        return (uint32_t)number;
    jox_scene_error(r, from, "too-many", NULL,
                    "with this group the scene has %g agents; 1,000,000 are possible", all);
    return 0;
}

/* Points that were given one by one. */
static void take_points(const JoxReader *r, const JoxYaml *at, JoxGroup *group) {
    group->fill = JOX_FILL_AT;
    check_bounds(r, at, group);
}

/* Period of the bounds, m; 0 along an axis that is not joined. */
static JoxV2 period_of(const JoxSceneSpec *s) {
    return (JoxV2){s->periodic_x ? s->high.x - s->low.x : 0.0f,
                   s->periodic_y ? s->high.y - s->low.y : 0.0f};
}

/* Copies the walls that agents keep clear of at the start: open gates too, and images. */
static JoxWalls copy_shut_walls(const JoxSceneSpec *s) {
    JoxWalls shut = s->walls, walls = {0};
    shut.rings = jox_alloc((size_t)shut.ring_count + 1, sizeof *shut.rings);
    for (uint32_t r = 0; r < shut.ring_count; r++) {
        shut.rings[r] = s->walls.rings[r];
        shut.rings[r].open = false;
    }
    jox_walls_standing(&walls, &shut, true);
    jox_wall_images_add(&walls, (JoxV2){s->low.x, s->low.y}, period_of(s), (JoxV2){0.0f, 0.0f});
    jox_free(shut.rings);
    return walls;
}

/* Sets the positions of a group's agents in its places. */
static void fill_places(const JoxReader *r, const JoxYaml *map, JoxArea *a, JoxGroup *group) {
    const struct JoxLoadFill *fill = &r->load->fill;
    if (group->fill == JOX_FILL_CIRCLE) {
        circle(r, map, group);
        return;
    }
    if (group->fill == JOX_FILL_LINE) {
        line(r, map, group);
        return;
    }
    area(r, map, a, group->fill, isfinite(fill->spacing) ? fill->spacing : 0.0f,
         r->load->scene->group_count, group);
    group->in = fill->in;
    group->in_count = fill->in_count;
    group->outside = fill->outside;
    group->outside_count = fill->outside_count;
}

void jox_load_positions(const JoxReader *r, const JoxYaml *map, JoxGroup *group) {
    const JoxYaml *at = jox_yaml_get(map, "at"), *count = jox_yaml_get(map, "count");
    const JoxYaml *density = jox_yaml_get(map, "density");
    const JoxSceneSpec *s = r->load->scene;
    const struct JoxLoadFill *fill = &r->load->fill;
    if (at) {
        take_points(r, at, group);
        return;
    }
    if (jox_yaml_get(map, "starts")) {
        jox_load_starts(r, map, group);
        return;
    }
    if (!count == !density) {
        jox_scene_error(r, map, "missing-key", "count: 100, density: 2, or at: [[0, 0]]",
                        "a group needs one of count, density, at and starts");
        return;
    }
    if (density ? !isfinite(r->load->fill.density) : group->count == 0 && !is_zero(count))
        return; /* wrong, and reported */
    if (count && group->count == 0 && has_source(r, group))
        return; /* nobody is there at the start */
    if (fill->in_count == 0) {
        if (!jox_yaml_get(map, "in"))
            jox_scene_error(r, map, "missing-key", "in: NAME", "a group needs `in`, places");
        group->count = 0;
        return;
    }
    JoxWalls walls = copy_shut_walls(s);
    JoxArea a = {.places = s->places,
                 .in = fill->in,
                 .out = fill->outside,
                 .in_count = fill->in_count,
                 .out_count = fill->outside_count,
                 .walls = &walls,
                 .clear = 0.2f,
                 .period = period_of(s)};
    group->count = number_of(r, map, &a, group);
    if (group->count > 0)
        fill_places(r, map, &a, group);
    jox_walls_free(&walls);
    if (group->count == 0)
        return;
    JOX_ASSERT(group->positions || r->diagnostics->errors > 0);
    check_bounds(r, map, group);
}
