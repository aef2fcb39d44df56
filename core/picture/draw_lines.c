/* Lines of the plan: of points, and of walls. */
#include "base/mem.h"
#include "picture/draw_parts.h"

/* Points of the plan in px; to be freed. */
static JoxV2 *project(const JoxDrawing *d, const JoxV2 *points, uint32_t count) {
    JoxV2 *out = jox_alloc(count + 1, sizeof *out);
    for (uint32_t i = 0; i < count; i++)
        out[i] = jox_draw_at(d, points[i]);
    return out;
}

void jox_draw_plan_line(const JoxDrawing *d, const JoxV2 *points, uint32_t count, bool closed,
                        const char *name) {
    JoxV2 *at = project(d, points, count);
    jox_canvas_line(d->canvas, at, count, closed, name);
    jox_free(at);
}

static bool same(JoxV2 a, JoxV2 b) {
    return a.x == b.x && a.y == b.y;
}

/* Thin walls have two sides: an open line's vertices go there and back, so that half of them draw
   it; a closed line is two rings, of which one does. */
uint32_t jox_draw_ring_points(const JoxWalls *walls, uint32_t r, bool *closed) {
    const struct JoxWallRing *ring = &walls->rings[r];
    const JoxWallVertex *v = &walls->vertices[ring->first];
    uint32_t i = 1, half = ring->count / 2 + 1;
    *closed = true;
    if (ring->solid)
        return ring->count;
    while (i < half && same(v[i].point, v[ring->count - i].point))
        i++;
    *closed = i < half;
    if (!*closed)
        return half;
    const struct JoxWallRing *last = ring - 1;
    if (r == 0 || last->solid || last->count != ring->count)
        return ring->count;
    const JoxWallVertex *w = &walls->vertices[last->first];
    for (i = 0; i < ring->count && same(v[i].point, w[ring->count - 1 - i].point);)
        i++;
    return i < ring->count ? ring->count : 0;
}
