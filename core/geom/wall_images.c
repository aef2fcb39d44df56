/* Lays the images of walls: ring by ring, each edge cut where another one covers it. */
#include "geom/wall_images.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "geom/polygon.h"
#include "geom/wall_grid.h"

static const float LEAST_REACH = 5.0f; /* m */
static const float HAIR = 1e-3f;       /* m: edges within this distance coincide */
static const float BEYOND = 5e-4f;     /* m: more than the rounding of positions on sheets */
static const float STRAIGHT = 0.9999f; /* cosine between edges that go on in one line */
static const float STRIDE = 0.5f;      /* m: between the points at which edges are looked up */

static float reach_along(float period) {
    return period > 0.0f ? jox_maxf(0.5f * period, LEAST_REACH) : INFINITY;
}

float jox_wall_images_reach(JoxV2 period) {
    return jox_minf(reach_along(period.x), reach_along(period.y));
}

int jox_wall_images_turns(float period) {
    return period > 0.0f ? (int)ceilf(reach_along(period) / period) : 0;
}

/* A part of an edge, m from its start; of an axis, m. */
typedef struct Span {
    float from, to;
} Span;

/* State of laying the images that are moved by one shift. */
typedef struct Laying {
    JoxWallImages *images;
    JoxWallGrid grid; /* over the walls and images of earlier shifts */
    JoxV2 shift;      /* m */
    /* The images of walls beyond a seam: only parts within `reach` m of it are laid. NULL: all
       is. `seam_a`: its end a as a position on this side. */
    const JoxSeam *seam;
    JoxV2 seam_a;
    float reach;         /* m: beyond the seam */
    float before, after; /* m: along its line, before its end a and after its end b */
    Span *spans;         /* covered parts of the edge in question */
    uint32_t span_count;
    size_t span_capacity;
} Laying;

static int compare_spans(const void *a, const void *b, const void *context) {
    const float x = ((const Span *)a)->from, y = ((const Span *)b)->from;
    (void)context;
    return (x > y) - (x < y);
}

/* ---- edges that lie there already ---- */

/* Adds the part that another edge covers of the edge from `a` of this direction and length. */
static void note_span(Laying *l, JoxV2 a, JoxV2 direction, float length, uint32_t other) {
    const JoxWalls *walls = &l->images->walls;
    const JoxWallVertex *v = &walls->vertices[other];
    const JoxV2 p = v->point, q = walls->vertices[v->next].point;
    if (jox_dot(v->direction, direction) < STRAIGHT)
        return;
    const Span span = {jox_maxf(jox_dot(jox_sub(p, a), direction), 0.0f),
                       jox_minf(jox_dot(jox_sub(q, a), direction), length)};
    const JoxV2 from = jox_add(a, jox_scale(direction, span.from));
    const JoxV2 to = jox_add(a, jox_scale(direction, span.to));
    if (span.to - span.from < HAIR || fabsf(jox_det(v->direction, jox_sub(from, p))) > HAIR ||
        fabsf(jox_det(v->direction, jox_sub(to, p))) > HAIR)
        return;
    for (uint32_t s = 0; s < l->span_count; s++) /* found from several points */
        if (l->spans[s].from == span.from && l->spans[s].to == span.to)
            return;
    JOX_RESERVE(l->spans, l->span_capacity, (size_t)l->span_count + 1);
    l->spans[l->span_count++] = span;
}

/* Lists the covered parts of an edge in order; parts that meet are one. */
static void find_spans(Laying *l, JoxV2 a, JoxV2 direction, float length) {
    const uint32_t points = (uint32_t)ceilf(length / STRIDE) + 1;
    l->span_count = 0;
    for (uint32_t n = 0; n < points; n++) {
        const float along = jox_minf((float)n * STRIDE, length);
        uint32_t count;
        const uint32_t *edges =
            jox_wall_grid_at(&l->grid, jox_add(a, jox_scale(direction, along)), &count);
        for (uint32_t e = 0; e < count; e++)
            note_span(l, a, direction, length, edges[e]);
    }
    if (l->span_count)
        jox_sort(l->spans, l->span_count, sizeof *l->spans, compare_spans, NULL, NULL);
    uint32_t kept = 0;
    for (uint32_t s = 0; s < l->span_count; s++) {
        if (kept && l->spans[s].from < l->spans[kept - 1].to + HAIR)
            l->spans[kept - 1].to = jox_maxf(l->spans[kept - 1].to, l->spans[s].to);
        else
            l->spans[kept++] = l->spans[s];
    }
    l->span_count = kept;
}

static bool is_within_hair(JoxV2 p, JoxV2 q) {
    return jox_length2(jox_sub(p, q)) < HAIR * HAIR;
}

/* Returns whether an edge of another ring goes on in one line with an edge at vertex `at`: it ends
   there in the direction of the edge that starts, or starts in the direction of the edge that ends.
   One of the two rings is an image. */
static bool is_continued(const Laying *l, uint32_t at) {
    const JoxWalls *walls = &l->images->walls;
    const uint32_t own = l->images->own_vertices;
    const JoxWallVertex *corner = &walls->vertices[at];
    const JoxV2 in = walls->vertices[corner->previous].direction;
    uint32_t count;
    const uint32_t *edges = jox_wall_grid_at(&l->grid, corner->point, &count);
    for (uint32_t e = 0; e < count; e++) {
        const JoxWallVertex *v = &walls->vertices[edges[e]];
        if ((at < own && edges[e] < own) || edges[e] == at || v->next == at)
            continue;
        if ((jox_dot(v->direction, corner->direction) > STRAIGHT &&
             is_within_hair(walls->vertices[v->next].point, corner->point)) ||
            (jox_dot(v->direction, in) > STRAIGHT && is_within_hair(v->point, corner->point)))
            return true;
    }
    return false;
}

/* ---- the images of one shift ---- */

/* Appends a vertex whose edge begins `along` m from the start of that of vertex `of`. */
static void append_vertex(Laying *l, uint32_t of, float along, bool covered) {
    JoxWallImages *images = l->images;
    JoxWalls *walls = &images->walls;
    const uint32_t at = walls->count;
    float from = along;
    const uint32_t origin = jox_wall_images_origin(images, of, &from);
    JOX_RESERVE(walls->vertices, walls->capacity, at + 1);
    JOX_RESERVE(images->origins, images->origin_capacity, at + 1 - images->own_vertices);
    JoxWallVertex *v = &walls->vertices[at];
    *v = walls->vertices[of];
    v->point = jox_add(jox_add(v->point, jox_scale(v->direction, along)), l->shift);
    v->convex |= along > 0.0f;
    v->covered = covered;
    v->next = at + 1;
    v->previous = at - 1;
    images->origins[at - images->own_vertices] = (struct JoxWallOrigin){origin, from};
    walls->count++;
}

/* Narrows the part of an edge from `a`, of this direction and length, to where the linear function
   that is `at` in `a` and grows by `by` a metre is at least 0. */
static void clip_span(Span *part, float at, float by) {
    if (by > 0.0f)
        part->from = jox_maxf(part->from, -at / by);
    else if (by < 0.0f)
        part->to = jox_minf(part->to, -at / by);
    else if (at < 0.0f)
        part->to = -INFINITY;
}

/* Finds the part of an image's edge that is laid; false if there is none. */
static bool find_laid_part(const Laying *l, uint32_t of, Span *part) {
    const JoxWalls *walls = &l->images->walls;
    const JoxWallVertex *v = &walls->vertices[of];
    const JoxSeam *seam = l->seam;
    const JoxV2 from = jox_sub(jox_add(v->point, l->shift), l->seam_a);
    const float along = jox_dot(seam->along, from), beyond = jox_det(seam->along, from);
    const float by_along = jox_dot(seam->along, v->direction);
    const float by_beyond = jox_det(seam->along, v->direction);
    *part = (Span){0.0f, jox_length(jox_sub(walls->vertices[v->next].point, v->point))};
    clip_span(part, beyond - BEYOND, by_beyond); /* not what lies in line with the seam */
    clip_span(part, l->reach - beyond, -by_beyond);
    clip_span(part, along + l->before, by_along);
    clip_span(part, seam->length + l->after - along, -by_along);
    if (fabsf(by_beyond) < HAIR && beyond < HAIR)
        return false; /* on the line of the seam, where other floor of this side may begin */
    return !v->covered && part->to - part->from > HAIR;
}

/* Appends the image of a part of an edge, cut where what covers it begins and ends; the rest of the
   edge counts as covered. */
static void append_part_image(Laying *l, uint32_t of, Span part) {
    const JoxWallVertex v = l->images->walls.vertices[of];
    const float length = jox_length(jox_sub(l->images->walls.vertices[v.next].point, v.point));
    float at = part.from;
    find_spans(l, jox_add(v.point, l->shift), v.direction, length);
    const uint32_t spans = l->span_count;
    for (uint32_t s = 0; s < spans && l->spans[s].from < part.to; s++) {
        if (l->spans[s].to <= at)
            continue;
        if (l->spans[s].from - at >= HAIR)
            append_vertex(l, of, at, false);
        append_vertex(l, of, jox_maxf(l->spans[s].from, at), true);
        at = l->spans[s].to;
    }
    if (part.to - at >= HAIR)
        append_vertex(l, of, at, false);
    append_vertex(l, of, part.to, true);
    l->images->walls.vertices[l->images->walls.count - 1].absent = true;
}

/* Appends the image of an edge, cut where what covers it begins and ends. */
static void append_edge_image(Laying *l, uint32_t of) {
    const JoxWalls *walls = &l->images->walls;
    const JoxWallVertex v = walls->vertices[of];
    const JoxV2 a = jox_add(v.point, l->shift);
    const float length = jox_length(jox_sub(walls->vertices[v.next].point, v.point));
    l->span_count = 0;
    if (!v.covered)
        find_spans(l, a, v.direction, length);
    const uint32_t spans = l->span_count;
    if (!spans || l->spans[0].from >= HAIR)
        append_vertex(l, of, 0.0f, v.covered);
    for (uint32_t s = 0; s < spans; s++) {
        append_vertex(l, of, l->spans[s].from < HAIR ? 0.0f : l->spans[s].from, true);
        if (l->spans[s].to <= length - HAIR)
            append_vertex(l, of, l->spans[s].to, false);
    }
}

static void append_ring_image(Laying *l, uint32_t of) {
    JoxWalls *walls = &l->images->walls;
    struct JoxWallRing ring = walls->rings[of];
    const uint32_t first = walls->count;
    Span part;
    for (uint32_t v = ring.first; v < ring.first + ring.count; v++)
        if (!l->seam)
            append_edge_image(l, v);
        else if (find_laid_part(l, v, &part))
            append_part_image(l, v, part);
    ring.first = first;
    ring.count = walls->count - first;
    if (ring.count == 0)
        return;
    walls->vertices[first].previous = walls->count - 1;
    walls->vertices[walls->count - 1].next = first;
    JOX_RESERVE(walls->rings, walls->ring_capacity, walls->ring_count + 1);
    walls->rings[walls->ring_count++] = ring;
}

/* Returns where a ring begins and ends along one axis, m. */
static Span find_ring_extent(const JoxWalls *walls, uint32_t ring, bool x) {
    const struct JoxWallRing *r = &walls->rings[ring];
    Span extent = {INFINITY, -INFINITY};
    for (uint32_t v = r->first; v < r->first + r->count; v++) {
        const float at = x ? walls->vertices[v].point.x : walls->vertices[v].point.y;
        extent.from = jox_minf(extent.from, at);
        extent.to = jox_maxf(extent.to, at);
    }
    return extent;
}

/* Returns by how many periods images along one axis are moved at most to reach `reach` m beyond the
   bounds. Walls that are drawn beyond the bounds need more, as they are shorter within. */
static int count_turns(const JoxWalls *walls, bool x, Span bounds, float reach) {
    const float period = bounds.to - bounds.from;
    float beyond = 0.0f;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const Span extent = find_ring_extent(walls, r, x);
        beyond = jox_maxf(beyond, jox_maxf(bounds.from - extent.from, extent.to - bounds.to));
    }
    return (int)ceilf((reach + jox_minf(beyond, 2.0f * period)) / period);
}

/* Lays images of all rings so far, moved along one axis. */
static void lay_along(JoxWallImages *images, bool x, Span bounds, float reach) {
    const float period = bounds.to - bounds.from;
    const uint32_t rings = images->walls.ring_count;
    const int turns = count_turns(&images->walls, x, bounds, reach);
    Laying l = {.images = images};
    for (int turn = 1; turn <= turns; turn++)
        for (int side = 0; side < 2; side++) {
            const float by = (float)(side ? -turn : turn) * period;
            l.shift = x ? jox_v2(by, 0.0f) : jox_v2(0.0f, by);
            l.grid.walls = &images->walls;
            jox_wall_grid_reset(&l.grid, STRIDE);
            for (uint32_t r = 0; r < rings; r++) {
                const Span extent = find_ring_extent(&images->walls, r, x);
                if (extent.to + by >= bounds.from - reach && extent.from + by <= bounds.to + reach)
                    append_ring_image(&l, r);
            }
        }
    jox_wall_grid_free(&l.grid);
    jox_free(l.spans);
}

static void mark_continued(JoxWallImages *images) {
    Laying l = {.images = images, .grid.walls = &images->walls};
    jox_wall_grid_reset(&l.grid, STRIDE);
    for (uint32_t v = 0; v < images->walls.count; v++)
        images->walls.vertices[v].continued = is_continued(&l, v);
    jox_wall_grid_free(&l.grid);
}

static void lay_images(JoxWallImages *images, const JoxWalls *standing, JoxV2 low, JoxV2 period,
                       JoxV2 reach) {
    jox_walls_standing(&images->walls, standing, true);
    images->own_rings = images->walls.ring_count;
    images->own_vertices = images->walls.count;
    if (period.x > 0.0f)
        lay_along(images, true, (Span){low.x, low.x + period.x},
                  jox_maxf(reach.x, reach_along(period.x)));
    if (period.y > 0.0f)
        lay_along(images, false, (Span){low.y, low.y + period.y},
                  jox_maxf(reach.y, reach_along(period.y)));
    if (period.x > 0.0f || period.y > 0.0f)
        mark_continued(images);
}

/* Finds how far images are laid along the line of a seam: half way to other seams beside it, as
   floor beyond those is not floor beyond this one. */
static void find_sides(const JoxStoreys *s, Laying *l) {
    const JoxSeam *seam = l->seam;
    const JoxSheet *on = &s->sheets[seam->here];
    l->before = l->after = l->reach;
    for (uint32_t k = on->first_seam; k < on->first_seam + on->seam_count; k++) {
        const JoxSeam *other = &s->seams[k];
        const JoxV2 a = jox_sub(other->a, seam->a), b = jox_sub(other->b, seam->a);
        const float at_a = jox_dot(seam->along, a), at_b = jox_dot(seam->along, b);
        const float beyond =
            jox_minf(fabsf(jox_det(seam->along, a)), fabsf(jox_det(seam->along, b)));
        const float beside = jox_minf(at_a, at_b) - seam->length;
        if (other == seam || beyond > l->reach)
            continue;
        if (beside > -HAIR)
            l->after = jox_minf(l->after, 0.5f * jox_maxf(beside, 0.0f));
        else if (jox_maxf(at_a, at_b) < HAIR)
            l->before = jox_minf(l->before, 0.5f * jox_maxf(-jox_maxf(at_a, at_b), 0.0f));
    }
}

/* Lays the images of the walls beyond one seam, as far as they are seen from before it. */
static void lay_beyond_seam(JoxWallImages *images, const JoxStoreys *s, const JoxSeam *seam,
                            float reach) {
    Laying l = {.images = images, .seam = seam, .shift = {0.0f, -seam->shift}, .reach = reach};
    const float wide = seam->length + 2.0f * reach;
    const JoxV2 there = jox_on_sheet(s, seam->there, seam->a);
    l.seam_a = jox_on_sheet(s, seam->here, seam->a);
    l.grid.walls = &images->walls;
    find_sides(s, &l);
    jox_wall_grid_reset(&l.grid, STRIDE);
    for (uint32_t r = 0; r < images->own_rings; r++) {
        const Span x = find_ring_extent(&images->walls, r, true);
        const Span y = find_ring_extent(&images->walls, r, false);
        if (x.from <= there.x + wide && x.to >= there.x - wide && y.from <= there.y + wide &&
            y.to >= there.y - wide)
            append_ring_image(&l, r);
    }
    jox_wall_grid_free(&l.grid);
    jox_free(l.spans);
}

void jox_wall_images_lay_seams(JoxWallImages *images, const JoxStoreys *storeys, float reach) {
    for (uint32_t k = 0; k < storeys->seam_count; k++)
        lay_beyond_seam(images, storeys, &storeys->seams[k], reach);
    mark_continued(images);
}

void jox_wall_images_lay(JoxWallImages *images, const JoxWalls *standing, JoxV2 low, JoxV2 period) {
    lay_images(images, standing, low, period, (JoxV2){0.0f, 0.0f});
}

void jox_wall_images_add(JoxWalls *walls, JoxV2 low, JoxV2 period, JoxV2 reach) {
    JoxWallImages images = {0};
    if (!(period.x > 0.0f || period.y > 0.0f))
        return;
    lay_images(&images, walls, low, period, reach);
    jox_walls_free(walls);
    *walls = images.walls;
    jox_free(images.origins);
}

void jox_wall_images_add_seams(JoxWalls *walls, const JoxStoreys *storeys, float reach) {
    JoxWallImages images = {
        .walls = *walls, .own_rings = walls->ring_count, .own_vertices = walls->count};
    jox_wall_images_lay_seams(&images, storeys, reach);
    *walls = images.walls;
    jox_free(images.origins);
}

JoxWalls jox_wall_images_only(const JoxWallImages *images) {
    JoxWalls walls = images->walls;
    JOX_ASSERT(images->own_rings <= walls.ring_count);
    if (images->own_rings)
        walls.rings += images->own_rings;
    walls.ring_count -= images->own_rings;
    return walls;
}

uint32_t jox_wall_images_origin(const JoxWallImages *images, uint32_t edge, float *along) {
    JOX_ASSERT(edge < images->walls.count);
    if (edge < images->own_vertices)
        return edge;
    const struct JoxWallOrigin *origin = &images->origins[edge - images->own_vertices];
    JOX_ASSERT(origin->edge < images->own_vertices);
    *along += origin->from;
    return origin->edge;
}

void jox_wall_images_free(JoxWallImages *images) {
    jox_walls_free(&images->walls);
    jox_free(images->origins);
    *images = (JoxWallImages){0};
}
