/* Polygons and segments in the plane; metres. */
#ifndef JOX_GEOM_POLYGON_H
#define JOX_GEOM_POLYGON_H

#include <stdbool.h>
#include <stdint.h>

#include "base/assert.h"
#include "base/vec.h"

/* Twice the signed area is positive for counter-clockwise rings. */
double jox_polygon_area(const JoxV2 *ring, uint32_t count);
/* Even-odd rule; a point on the border may be either. */
bool jox_polygon_contains(const JoxV2 *ring, uint32_t count, JoxV2 point);
/* Distance to the ring's border, 0 inside when `solid`. */
float jox_polygon_distance(const JoxV2 *ring, uint32_t count, JoxV2 point, bool solid);
/* True, with the indices of two edges that cross or touch, if the ring crosses itself. */
bool jox_polygon_self_crosses(const JoxV2 *ring, uint32_t count, uint32_t *edge_a,
                              uint32_t *edge_b);
JoxV2 jox_polygon_centroid(const JoxV2 *ring, uint32_t count);
void jox_bounds(const JoxV2 *points, uint32_t count, JoxV2 *low, JoxV2 *high);
/* Whether a point lies in the box between two corners, its border included. */
static inline bool jox_is_within(JoxV2 point, JoxV2 low, JoxV2 high) {
    return point.x >= low.x && point.x <= high.x && point.y >= low.y && point.y <= high.y;
}

/* The point of a segment that is nearest to another. */
static inline JoxV2 jox_segment_nearest(JoxV2 a, JoxV2 b, JoxV2 p) {
    JoxV2 ab = jox_sub(b, a);
    float l2 = jox_length2(ab);
    float t = l2 > 0.0f ? jox_clampf(jox_dot(jox_sub(p, a), ab) / l2, 0.0f, 1.0f) : 0.0f;
    JOX_ASSERT(!(t < 0.0f || t > 1.0f));
    return jox_add(a, jox_scale(ab, t));
}
/* Whether the boxes about a-b and p-q have a point in common. */
static inline bool jox_boxes_meet(JoxV2 a, JoxV2 b, JoxV2 p, JoxV2 q) {
    return !(jox_maxf(p.x, q.x) < jox_minf(a.x, b.x) || jox_minf(p.x, q.x) > jox_maxf(a.x, b.x) ||
             jox_maxf(p.y, q.y) < jox_minf(a.y, b.y) || jox_minf(p.y, q.y) > jox_maxf(a.y, b.y));
}
/* Of segments whose boxes meet: see jox_segment_crossing. */
int jox_segment_crosses(JoxV2 a, JoxV2 b, JoxV2 p, JoxV2 q);
/* +1 if the way from p to q crosses a-b from its right to its left, -1 for left to right, else 0.
   Half-open, so that a way split at any point counts once. */
static inline int jox_segment_crossing(JoxV2 a, JoxV2 b, JoxV2 p, JoxV2 q) {
    return jox_boxes_meet(a, b, p, q) ? jox_segment_crosses(a, b, p, q) : 0;
}

#endif
