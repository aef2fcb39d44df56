/* Walls of stairs: their sides, and the walls around the holes and boxes that they are on storeys.
 */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "geom/polygon.h"
#include "geom/storeys.h"

static const float RAIL = 1.1f;  /* m: height of the walls around a stair on the storey above it */
static const float HAIR = 0.01f; /* m: points this near to a line lie on it */
static const float SLIT = 0.7f;  /* m: gaps beside seams that are narrower lead nowhere */

/* A wall in the making: points of the plan that follow each other. */
typedef struct Chain {
    JoxWalls *walls;
    const JoxStoreys *storeys;
    uint32_t storey;
    float height; /* m */
    JoxV2 *points;
    uint32_t count;
    size_t capacity;
} Chain;

static void end_chain(Chain *c) {
    if (c->count >= 2)
        jox_walls_add_polyline(c->walls, c->points, c->count, false, c->height);
    c->count = 0;
}

/* Appends a part of an edge; ends the wall before it if they do not meet. */
static void append_part(Chain *c, JoxV2 from, JoxV2 to) {
    from = jox_on_sheet(c->storeys, c->storey, from);
    to = jox_on_sheet(c->storeys, c->storey, to);
    if (c->count && jox_length(jox_sub(c->points[c->count - 1], from)) > HAIR)
        end_chain(c);
    JOX_RESERVE(c->points, c->capacity, (size_t)c->count + 2);
    if (c->count == 0)
        c->points[c->count++] = from;
    c->points[c->count++] = to;
}

/* Returns whether a stair stands on a storey, or passes it. */
static bool is_on_storey(const JoxStair *stair, uint32_t storey) {
    return jox_stair_joins(stair) && stair->lower <= storey && storey <= stair->upper;
}

/* Returns whether people pass at a point of the plan: at a seam of the storey, or inside the
   footprint of another stair than `own`. */
static bool is_passage(const Chain *c, const JoxStair *own, JoxV2 at) {
    const JoxStoreys *s = c->storeys;
    const JoxSheet *on = &s->sheets[c->storey];
    for (uint32_t k = on->first_seam; k < on->first_seam + on->seam_count; k++)
        if (jox_length(jox_sub(jox_segment_nearest(s->seams[k].a, s->seams[k].b, at), at)) < HAIR)
            return true;
    for (uint32_t k = 0; k < s->stair_count; k++) {
        const JoxStair *other = &s->stairs[k];
        const uint32_t n = 2 * other->path_count;
        if (other != own && is_on_storey(other, c->storey) &&
            jox_is_within(at, other->low, other->high) &&
            jox_polygon_contains(other->outline, n, at) &&
            jox_polygon_distance(other->outline, n, at, false) > HAIR)
            return true;
    }
    return false;
}

/* Appends to `at` the distances along an edge from a, m, at which another segment begins, ends or
   crosses it. */
static void note_meetings(JoxV2 a, JoxV2 b, JoxV2 p, JoxV2 q, float **at, uint32_t *count,
                          size_t *capacity) {
    const float length = jox_length(jox_sub(b, a));
    const JoxV2 along = jox_unit(jox_sub(b, a)), ends[2] = {p, q};
    float beside[2];
    JOX_RESERVE(*at, *capacity, (size_t)*count + 3);
    for (int k = 0; k < 2; k++) {
        const JoxV2 from = jox_sub(ends[k], a);
        beside[k] = jox_det(along, from);
        if (fabsf(beside[k]) < HAIR)
            (*at)[(*count)++] = jox_clampf(jox_dot(along, from), 0.0f, length);
    }
    if (beside[0] * beside[1] < 0.0f) {
        const float share = beside[0] / (beside[0] - beside[1]);
        const JoxV2 meet = jox_add(p, jox_scale(jox_sub(q, p), share));
        (*at)[(*count)++] = jox_clampf(jox_dot(along, jox_sub(meet, a)), 0.0f, length);
    }
}

static int compare_floats(const void *a, const void *b, const void *context) {
    const float x = *(const float *)a, y = *(const float *)b;
    (void)context;
    return (x > y) - (x < y);
}

/* Appends the parts of an edge of a stair's outline where nobody passes. */
static void append_edge(Chain *c, const JoxStair *own, JoxV2 a, JoxV2 b) {
    const JoxStoreys *s = c->storeys;
    const JoxSheet *on = &s->sheets[c->storey];
    const JoxV2 along = jox_unit(jox_sub(b, a));
    float *at = NULL;
    uint32_t count = 0;
    size_t capacity = 0;
    note_meetings(a, b, a, b, &at, &count, &capacity);
    for (uint32_t k = on->first_seam; k < on->first_seam + on->seam_count; k++)
        note_meetings(a, b, s->seams[k].a, s->seams[k].b, &at, &count, &capacity);
    for (uint32_t k = 0; k < s->stair_count; k++) {
        const JoxStair *other = &s->stairs[k];
        const uint32_t n = 2 * other->path_count;
        for (uint32_t e = 0; other != own && is_on_storey(other, c->storey) && e < n; e++)
            note_meetings(a, b, other->outline[e], other->outline[(e + 1) % n], &at, &count,
                          &capacity);
    }
    jox_sort(at, count, sizeof *at, compare_floats, NULL, NULL);
    for (uint32_t k = 0; k + 1 < count; k++) {
        const JoxV2 from = jox_add(a, jox_scale(along, at[k]));
        const JoxV2 to = jox_add(a, jox_scale(along, at[k + 1]));
        if (at[k + 1] - at[k] > 1e-4f && !is_passage(c, own, jox_scale(jox_add(from, to), 0.5f)))
            append_part(c, from, to);
    }
    jox_free(at);
}

/* Closes a slit beside the end of a seam, between its stair and the nearest wall of a stair that
   does not begin there: people would be pressed into it. */
static void close_slit(Chain *c, JoxV2 end) {
    const JoxStoreys *s = c->storeys;
    JoxV2 nearest = end;
    float least = SLIT;
    for (uint32_t k = 0; k < s->stair_count; k++) {
        const JoxStair *stair = &s->stairs[k];
        const uint32_t n = 2 * stair->path_count;
        for (uint32_t e = 0; is_on_storey(stair, c->storey) && e < n; e++) {
            const JoxV2 at =
                jox_segment_nearest(stair->outline[e], stair->outline[(e + 1) % n], end);
            const float away = jox_length(jox_sub(at, end));
            if (away > 2.0f * HAIR && away < least) {
                least = away;
                nearest = at;
            }
        }
    }
    if (least < SLIT && !is_passage(c, NULL, jox_scale(jox_add(end, nearest), 0.5f)))
        append_part(c, end, nearest);
    end_chain(c);
}

/* Adds the walls of a stair on its own sheet. */
static void add_sides(const JoxStoreys *s, const JoxStair *st, JoxWalls *walls) {
    const uint32_t n = st->path_count;
    JoxV2 *side = jox_alloc(n, sizeof *side);
    for (uint32_t first = 0; first < 2 * n; first += n) {
        for (uint32_t k = 0; k < n; k++)
            side[k] = jox_on_sheet(s, st->sheet, st->outline[first + k]);
        jox_walls_add_polyline(walls, side, n, false, INFINITY);
    }
    jox_free(side);
}

static void close_slits(const JoxStoreys *s, JoxWalls *walls) {
    for (uint32_t k = 0; k < s->seam_count; k++) {
        Chain chain = {.walls = walls, .storeys = s, .storey = s->seams[k].here, .height = RAIL};
        if (!s->seams[k].enters)
            continue;
        close_slit(&chain, s->seams[k].a);
        close_slit(&chain, s->seams[k].b);
        jox_free(chain.points);
    }
}

void jox_storeys_add_walls(const JoxStoreys *s, JoxWalls *walls) {
    close_slits(s, walls);
    for (uint32_t k = 0; k < s->stair_count; k++) {
        const JoxStair *st = &s->stairs[k];
        const uint32_t n = 2 * st->path_count;
        if (!jox_stair_joins(st))
            continue;
        add_sides(s, st, walls);
        for (uint32_t storey = st->lower; storey <= st->upper; storey++) {
            Chain chain = {.walls = walls,
                           .storeys = s,
                           .storey = storey,
                           .height = storey == st->lower ? INFINITY : RAIL};
            for (uint32_t e = 0; e < n; e++)
                append_edge(&chain, st, st->outline[e], st->outline[(e + 1) % n]);
            end_chain(&chain);
            jox_free(chain.points);
        }
    }
}
