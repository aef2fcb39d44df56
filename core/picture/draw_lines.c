/* Lines given in metres, and which vertices of a wall ring have to be drawn. */
#include "base/mem.h"
#include "picture/draw_parts.h"

/* Converts points of the plan from metres to pixels; the caller frees the result. */
static JoxV2 *project_points(const JoxDrawing *d, const JoxV2 *points, uint32_t count) {
    JoxV2 *out = jox_alloc(count + 1, sizeof *out);
    for (uint32_t i = 0; i < count; i++)
        out[i] = jox_draw_to_pixels(d, points[i]);
    return out;
}

void jox_draw_plan_line(const JoxDrawing *d, const JoxV2 *points, uint32_t count, bool closed,
                        const char *name) {
    JoxV2 *at = project_points(d, points, count);
    jox_canvas_line(d->canvas, at, count, closed, name);
    jox_free(at);
}

static bool is_at_same_point(JoxV2 a, JoxV2 b) {
    return a.x == b.x && a.y == b.y;
}

/* A thin wall has two sides. If it is an open line, its ring runs along it and back, so half of
   the vertices draw it. If it is closed, it is two rings, of which one draws it. */
uint32_t jox_draw_ring_points(const JoxWalls *walls, uint32_t r, bool *closed) {
    const struct JoxWallRing *ring = &walls->rings[r];
    const JoxWallVertex *v = &walls->vertices[ring->first];
    uint32_t i = 1, half = ring->count / 2 + 1;
    *closed = true;
    if (ring->solid)
        return ring->count;
    while (i < half && is_at_same_point(v[i].point, v[ring->count - i].point))
        i++;
    *closed = i < half;
    if (!*closed)
        return half;
    const struct JoxWallRing *last = ring - 1;
    if (r == 0 || last->solid || last->count != ring->count)
        return ring->count;
    const JoxWallVertex *w = &walls->vertices[last->first];
    for (i = 0; i < ring->count && is_at_same_point(v[i].point, w[ring->count - 1 - i].point);)
        i++;
    return i < ring->count ? ring->count : 0;
}
