#include "geom/polygon.h"

#include "base/assert.h"

double jox_polygon_area(const JoxV2 *ring, uint32_t count) {
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        JoxV2 a = ring[i], b = ring[(i + 1) % count];
        sum += (double)a.x * b.y - (double)b.x * a.y;
    }
    return sum / 2.0;
}

bool jox_polygon_contains(const JoxV2 *ring, uint32_t count, JoxV2 p) {
    JOX_ASSERT(count > 0);
    bool inside = false;
    for (uint32_t i = 0, j = count - 1; i < count; j = i++) {
        JoxV2 a = ring[i], b = ring[j];
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x)
            inside = !inside;
    }
    return inside;
}

float jox_polygon_distance(const JoxV2 *ring, uint32_t count, JoxV2 p, bool solid) {
    if (solid && jox_polygon_contains(ring, count, p))
        return 0.0f;
    float best = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        JoxV2 q = jox_segment_nearest(ring[i], ring[(i + 1) % count], p);
        best = jox_minf(best, jox_length2(jox_sub(p, q)));
    }
    return sqrtf(best);
}

/* Returns the sign of the turn a -> b -> c, computed in double so that nearly straight corners are
   classified correctly. */
static int find_turn_sign(JoxV2 a, JoxV2 b, JoxV2 c) {
    double d =
        ((double)b.x - a.x) * ((double)c.y - a.y) - ((double)b.y - a.y) * ((double)c.x - a.x);
    return (d > 0.0) - (d < 0.0);
}

static bool is_on_segment(JoxV2 a, JoxV2 b, JoxV2 p) {
    return find_turn_sign(a, b, p) == 0 && p.x >= jox_minf(a.x, b.x) && p.x <= jox_maxf(a.x, b.x) &&
           p.y >= jox_minf(a.y, b.y) && p.y <= jox_maxf(a.y, b.y);
}

static bool do_segments_meet(JoxV2 a, JoxV2 b, JoxV2 c, JoxV2 d) {
    if (find_turn_sign(a, b, c) * find_turn_sign(a, b, d) < 0 &&
        find_turn_sign(c, d, a) * find_turn_sign(c, d, b) < 0)
        return true;
    return is_on_segment(a, b, c) || is_on_segment(a, b, d) || is_on_segment(c, d, a) ||
           is_on_segment(c, d, b);
}

bool jox_polygon_self_crosses(const JoxV2 *ring, uint32_t count, uint32_t *edge_a,
                              uint32_t *edge_b) {
    for (uint32_t i = 0; i < count; i++) {
        JoxV2 a = ring[i], b = ring[(i + 1) % count];
        for (uint32_t j = i + 1; j < count; j++) {
            JoxV2 c = ring[j], d = ring[(j + 1) % count];
            bool next = j == i + 1, last = (j + 1) % count == i;
            /* Neighbouring edges share a corner: they cross only by folding back on themselves. */
            bool cross = next   ? is_on_segment(a, b, d) || is_on_segment(c, d, a)
                         : last ? is_on_segment(a, b, c) || is_on_segment(c, d, b)
                                : do_segments_meet(a, b, c, d);
            if (cross) {
                *edge_a = i;
                *edge_b = j;
                return true;
            }
        }
    }
    return false;
}

JoxV2 jox_polygon_centroid(const JoxV2 *ring, uint32_t count) {
    JOX_ASSERT(count > 0);
    double area = 0.0, x = 0.0, y = 0.0;
    JoxV2 o = ring[0]; /* relative to the first corner, as precision would be lost far from the
                          origin */
    for (uint32_t i = 0; i < count; i++) {
        double ax = (double)ring[i].x - o.x, ay = (double)ring[i].y - o.y;
        double bx = (double)ring[(i + 1) % count].x - o.x;
        double by = (double)ring[(i + 1) % count].y - o.y;
        double cross = ax * by - bx * ay;
        area += cross;
        x += (ax + bx) * cross;
        y += (ay + by) * cross;
    }
    if (area == 0.0)
        return o;
    return (JoxV2){(float)(o.x + x / (3.0 * area)), (float)(o.y + y / (3.0 * area))};
}

void jox_bounds(const JoxV2 *points, uint32_t count, JoxV2 *low, JoxV2 *high) {
    *low = (JoxV2){INFINITY, INFINITY};
    *high = (JoxV2){-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < count; i++) {
        *low = (JoxV2){jox_minf(low->x, points[i].x), jox_minf(low->y, points[i].y)};
        *high = (JoxV2){jox_maxf(high->x, points[i].x), jox_maxf(high->y, points[i].y)};
    }
}

/* Returns whether a point is left of a-b; points on the line count as left. */
static bool is_left(JoxV2 a, JoxV2 b, JoxV2 p) {
    return ((double)b.x - a.x) * ((double)p.y - a.y) - ((double)b.y - a.y) * ((double)p.x - a.x) >=
           0.0;
}

int jox_segment_crosses(JoxV2 a, JoxV2 b, JoxV2 p, JoxV2 q) {
    bool p_left = is_left(a, b, p), q_left = is_left(a, b, q);
    if (p_left == q_left || is_left(p, q, a) == is_left(p, q, b))
        return 0;
    return q_left ? 1 : -1;
}
