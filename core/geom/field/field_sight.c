/* Visibility between walls: which cells have patches, and of their nine samples everything that
   does not depend on the goal or the crowd. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/field/field_parts.h"

static const float TOUCH = 1e-3f; /* m: samples this near to an edge count as on it, on neither
                                     side */

/* ---- sight ---- */

void jox_field_span(float from, float to, float low, float size, int most, int *first, int *last) {
    float a = floorf((from - low) / size), b = floorf((to - low) / size);
    *first = a > (float)most ? most : a > 0.0f ? (int)a : 0;
    *last = b < (float)most ? (b < 0.0f ? -1 : (int)b) : most - 1;
}

float jox_field_nearest(const JoxField *f, uint32_t first, uint32_t last, JoxV2 p, JoxV2 *at,
                        uint32_t *edge) {
    float least = INFINITY;
    for (uint32_t k = first; k < last; k++) {
        const JoxFieldEdge *e = &f->edges[f->refs[k]];
        JoxV2 q = jox_segment_nearest(e->a, e->b, p);
        float d2 = jox_length2(jox_sub(p, q));
        if (d2 < least) {
            least = d2;
            if (at)
                *at = q;
            if (edge)
                *edge = f->refs[k];
        }
    }
    return least < INFINITY ? sqrtf(least) : INFINITY;
}

static float find_distance2(JoxV2 a, JoxV2 b, JoxV2 p) {
    return jox_length2(jox_sub(p, jox_segment_nearest(a, b, p)));
}

/* Returns whether an edge blocks the segment p-q, or is nearer to it than `least` allows
   (jox_field_sees). */
static bool does_edge_hide(const JoxFieldEdge *e, JoxV2 p, JoxV2 q, float least) {
    if (jox_maxf(p.x, q.x) + least < jox_minf(e->a.x, e->b.x) ||
        jox_minf(p.x, q.x) - least > jox_maxf(e->a.x, e->b.x) ||
        jox_maxf(p.y, q.y) + least < jox_minf(e->a.y, e->b.y) ||
        jox_minf(p.y, q.y) - least > jox_maxf(e->a.y, e->b.y))
        return false;
    float own2 = find_distance2(e->a, e->b, p);
    if (own2 < 1e-6f)
        return false; /* p is on the edge: visible from both sides */
    if (jox_segment_crossing(e->a, e->b, p, q) != 0)
        return true;
    float allowed2 = jox_minf(least * least, 0.81f * own2);
    return find_distance2(e->a, e->b, q) < allowed2 || find_distance2(p, q, e->a) < allowed2 ||
           find_distance2(p, q, e->b) < allowed2;
}

bool jox_field_sees(const JoxFieldWork *w, JoxV2 p, JoxV2 q, float least) {
    enum { KNOWN = 4 };
    const JoxField *f = w->f;
    const int steps = (int)ceilf(jox_length(jox_sub(q, p)) / f->size);
    /* The edges examined last: a long one is in many cells one after the other. */
    uint32_t known[KNOWN] = {UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX}, examined = 0;
    for (int k = 0, before = -1; k <= steps; k++) {
        const JoxV2 at =
            jox_add(p, jox_scale(jox_sub(q, p), steps ? (float)k / (float)steps : 0.0f));
        const int c = (int)jox_clampf((at.x - f->low.x) / f->size, 0.0f, (float)(f->columns - 1));
        const int r = (int)jox_clampf((at.y - f->low.y) / f->size, 0.0f, (float)(f->rows - 1));
        const int cell = r * f->columns + c;
        const uint32_t end = cell == before ? 0 : w->walled.first[cell + 1];
        for (uint32_t i = w->walled.first[cell]; i < end; i++) {
            const uint32_t e = f->refs[i];
            if (e == known[0] || e == known[1] || e == known[2] || e == known[3])
                continue;
            if (does_edge_hide(&f->edges[e], p, q, least))
                return false;
            known[examined++ % KNOWN] = e;
        }
        before = cell;
    }
    return true;
}

bool jox_field_sees_near(const JoxFieldWork *w, int cell, JoxV2 p, JoxV2 q, float least) {
    JOX_ASSERT(least <= w->f->clearance);
    if (!w->exact)
        return jox_field_sees(w, p, q, least);
    for (uint32_t i = w->walled.first[cell]; i < w->walled.first[cell + 1]; i++)
        if (does_edge_hide(&w->f->edges[w->f->refs[i]], p, q, least))
            return false;
    return true;
}

/* ---- patches ---- */

/* Returns whether a cell is interpolated with all of its neighbours; `within`: bits of the
   neighbours inside the grid. */
static bool is_interpolated(const JoxFieldWork *w, int cell, uint32_t within) {
    const uint32_t both = within & (within >> 1 | within << 7);
    return w->walled.even[cell] && (w->walled.links[cell] & within) == within &&
           (w->walled.corners[cell] & both) == (both & 0xff);
}

/* Returns the direction straight out of a solid: towards the nearest edge, or off the edge that p
   is on. */
static JoxV2 find_way_out(const JoxField *f, JoxV2 p, JoxV2 at, uint32_t edge) {
    JoxV2 out = jox_sub(at, p);
    if (jox_length(out) > TOUCH)
        return jox_unit(out);
    return jox_unit(jox_scale(jox_left(jox_sub(f->edges[edge].b, f->edges[edge].a)), -1.0f));
}

/* Returns which of the four nodes around a sample are visible (bits); `near`: its distance from the
   nearest edge, m. */
static JoxFieldSight find_visible_nodes(const JoxFieldWork *w, const JoxFieldSpot *spot,
                                        float near) {
    const JoxV2 p = jox_field_spot_at(spot);
    const float least = JOX_FIELD_KEEP * w->f->clearance;
    JoxFieldSight seen = 0;
    for (int k = 0; k < 4; k++) {
        const int cell = jox_field_about(w, spot, k).cell;
        if (cell < 0)
            continue;
        const JoxV2 node = jox_field_node(w, cell);
        if (jox_field_surely_sees(w, near, w->near[cell], p, node, least) ||
            jox_field_sees_near(w, spot->cell, p, node, least))
            seen |= (JoxFieldSight)1 << k;
    }
    return seen;
}

/* Computes the visibility of a sample; fills the marks and directions of its patch that walls
   determine. */
static JoxFieldSight examine_sample(const JoxFieldWork *w, JoxFieldPatch *patch, int cell, int s) {
    const JoxField *f = w->f;
    const JoxFieldSpot spot = jox_field_spot(w, cell, s);
    const JoxV2 p = jox_field_spot_at(&spot);
    JoxV2 at = p;
    uint32_t edge = 0;
    float near = jox_field_nearest(f, patch->first, patch->first + patch->count, p, &at, &edge);
    float half = 0.5f * f->size / (float)JOX_FIELD_SIDE;
    if (near < 1.5f * half) /* more than half the diagonal of a ninth */
        patch->cut |= (uint16_t)(1 << s);
    if (w->walled.solid[cell] >> s & 1) {
        if (patch->count == 0)
            return JOX_SIGHT_DEEP; /* no edge near: it follows a neighbour later */
        JoxV2 out = find_way_out(f, p, at, edge);
        patch->x[s] = out.x;
        patch->y[s] = out.y;
        return JOX_SIGHT_SOLID;
    }
    if (near < TOUCH) {
        patch->on_edge |= (uint16_t)(1 << s);
        return 0;
    }
    JoxFieldSight sight = find_visible_nodes(w, &spot, near);
    if (near < f->clearance) {
        const JoxV2 off = jox_scale(jox_sub(p, at), (1.0f - near / f->clearance) / near);
        patch->x[s] = off.x;
        patch->y[s] = off.y;
        sight |= JOX_SIGHT_BY_WALL;
    }
    if (near > JOX_FIELD_AHEAD * f->size + JOX_FIELD_KEEP * f->clearance + TOUCH)
        sight |= JOX_SIGHT_OPEN;
    return sight;
}

void jox_field_look_about(JoxFieldWork *w) {
    JoxField *f = w->f;
    for (int i = 0; i < w->count; i++) {
        const int c = i % f->columns, r = i / f->columns;
        const uint32_t within = (r > 0 ? 0xff : 0x1f) & (r + 1 < f->rows ? 0xff : 0xf1) &
                                (c > 0 ? 0xff : 0xc7) & (c + 1 < f->columns ? 0xff : 0x7c);
        bool clear = is_interpolated(w, i, within), edges = jox_field_has_edges(w, i);
        f->cells[i].patch = clear ? JOX_FIELD_CLEAR : JOX_FIELD_PLAIN;
        if (clear || !edges)
            continue;
        JOX_RESERVE(f->patches, f->patch_capacity, f->patch_count + 1);
        f->cells[i].patch = (int32_t)f->patch_count;
        f->patches[f->patch_count++] = (JoxFieldPatch){
            .first = w->walled.first[i], .count = w->walled.first[i + 1] - w->walled.first[i]};
    }
    JOX_ASSERT(f->patch_count <= (uint32_t)w->count);
    w->walled.patched = jox_alloc((size_t)f->patch_count + 1, sizeof *w->walled.patched);
    w->walled.sight =
        jox_alloc((size_t)f->patch_count + 1, JOX_FIELD_SAMPLES * sizeof *w->walled.sight);
    for (int i = 0; i < w->count; i++) {
        const int32_t p = f->cells[i].patch;
        if (p < 0)
            continue;
        w->walled.patched[p] = i;
        for (int s = 0; s < JOX_FIELD_SAMPLES; s++)
            w->walled.sight[p * JOX_FIELD_SAMPLES + s] = examine_sample(w, &f->patches[p], i, s);
    }
}
