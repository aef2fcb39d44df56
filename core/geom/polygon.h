/* Polygons and segments in the plane; metres. */
#ifndef JOX_GEOM_POLYGON_H
#define JOX_GEOM_POLYGON_H

#include <stdbool.h>
#include <stdint.h>

#include "base/assert.h"
#include "base/vec.h"

/* Returns the signed area, m2: positive for counter-clockwise rings. */
double jox_polygon_area(const JoxV2 *ring, uint32_t count);
/* Returns whether a ring contains a point, by the even-odd rule; points on the border may be
   either. */
bool jox_polygon_contains(const JoxV2 *ring, uint32_t count, JoxV2 point);
/* Returns the distance to the ring's border, m; 0 inside if `solid`. */
float jox_polygon_distance(const JoxV2 *ring, uint32_t count, JoxV2 point, bool solid);
/* Returns whether the ring crosses itself, with the indices of two edges that cross or touch. */
bool jox_polygon_self_crosses(const JoxV2 *ring, uint32_t count, uint32_t *edge_a,
                              uint32_t *edge_b);
JoxV2 jox_polygon_centroid(const JoxV2 *ring, uint32_t count);
void jox_bounds(const JoxV2 *points, uint32_t count, JoxV2 *low, JoxV2 *high);
/* Returns whether a point lies in the box between two corners, border included. */
static inline bool jox_is_within(JoxV2 point, JoxV2 low, JoxV2 high) {
    return point.x >= low.x && point.x <= high.x && point.y >= low.y && point.y <= high.y;
}

/* Returns the point of segment a-b that is nearest to p. */
static inline JoxV2 jox_segment_nearest(JoxV2 a, JoxV2 b, JoxV2 p) {
    JoxV2 ab = jox_sub(b, a);
    float l2 = jox_length2(ab);
    float t = l2 > 0.0f ? jox_clampf(jox_dot(jox_sub(p, a), ab) / l2, 0.0f, 1.0f) : 0.0f;
    JOX_ASSERT(!(t < 0.0f || t > 1.0f));
    return jox_add(a, jox_scale(ab, t));
}
/* Returns whether the bounding boxes of a-b and p-q overlap or touch. */
static inline bool jox_boxes_meet(JoxV2 a, JoxV2 b, JoxV2 p, JoxV2 q) {
    return !(jox_maxf(p.x, q.x) < jox_minf(a.x, b.x) || jox_minf(p.x, q.x) > jox_maxf(a.x, b.x) ||
             jox_maxf(p.y, q.y) < jox_minf(a.y, b.y) || jox_minf(p.y, q.y) > jox_maxf(a.y, b.y));
}
/* Does the same as jox_segment_crossing, for segments whose boxes meet. */
int jox_segment_crosses(JoxV2 a, JoxV2 b, JoxV2 p, JoxV2 q);
/* Returns +1 if the move from p to q crosses a-b from its right to its left, -1 from left to right,
   else 0. Half-open, so that a move split at any point counts once. */
static inline int jox_segment_crossing(JoxV2 a, JoxV2 b, JoxV2 p, JoxV2 q) {
    return jox_boxes_meet(a, b, p, q) ? jox_segment_crosses(a, b, p, q) : 0;
}

#endif
