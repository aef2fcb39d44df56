/* Finds the nearest point of a body's footprint. Most queries come from outside: for them four
   edges are processed at once, each with the arithmetic of the scalar code, so that both give the
   same bits. */
#include <math.h>

#include "base/number/bits.h"
#include "geom/objects.h"
#include "simd/four.h"

/* Returns the nearest point of a disc about the body's centre; from the centre itself, +x leads
   out. */
static JoxFootprintPoint find_nearest_on_disc(const JoxObject *body, JoxV2 point) {
    JoxV2 centre = {body->position.x, body->position.y};
    JoxV2 offset = jox_sub(point, centre);
    float distance = jox_length(offset);
    JoxV2 normal = distance > 0.0f ? jox_scale(offset, 1.0f / distance) : jox_v2(1.0f, 0.0f);
    return (JoxFootprintPoint){normal, jox_add(centre, jox_scale(normal, body->round)),
                               distance - body->round};
}

/* Four edges of a ring: start points, and vectors to the next start point. */
typedef struct Edges {
    JoxFour x, y, along_x, along_y;
} Edges;

static inline JoxFour broadcast_four(float a) {
    return (JoxFour){a, a, a, a};
}

static inline JoxFour select_four(JoxFourMask marks, JoxFour a, JoxFour b) {
    return (JoxFour)((marks & (JoxFourMask)a) | (~marks & (JoxFourMask)b));
}

/* Loads edges `first` to `first` + 3; those beyond the last have length 0. */
static inline Edges load_edges(const JoxObject *body, uint32_t first) {
    const int left = (int)(body->footprint_count - first);
    const JoxV2 *ring = body->footprint, *next = left > 4 ? &ring[first + 4] : ring;
    const JoxFour low = jox_load_four(&ring[first].x), high = jox_load_four(&ring[first + 2].x);
    const JoxFourMask lane = {0, 1, 2, 3}, last = lane == left - 1, within = lane < left;
    const JoxFour x = JOX_SHUFFLE_FOURS(low, high, 0, 2, 4, 6);
    const JoxFour y = JOX_SHUFFLE_FOURS(low, high, 1, 3, 5, 7);
    const JoxFour to_x = select_four(last, broadcast_four(ring[0].x),
                                     JOX_SHUFFLE_FOURS(x, broadcast_four(next->x), 1, 2, 3, 4));
    const JoxFour to_y = select_four(last, broadcast_four(ring[0].y),
                                     JOX_SHUFFLE_FOURS(y, broadcast_four(next->y), 1, 2, 3, 4));
    return (Edges){x, y, jox_keep_four(within, to_x - x), jox_keep_four(within, to_y - y)};
}

/* Returns the nearest point of an edge that begins at `a`. */
static inline JoxV2 find_nearest_on_edge(JoxV2 a, JoxV2 edge, JoxV2 point) {
    float along = jox_clampf(jox_dot(jox_sub(point, a), edge) / jox_length2(edge), 0.0f, 1.0f);
    return jox_add(a, jox_scale(edge, along));
}

/* Finds the nearest point from any position, edge by edge. */
static JoxFootprintPoint find_nearest_on_ring(const JoxObject *body, JoxV2 point) {
    uint32_t count = body->footprint_count;
    float nearest2 = INFINITY, deepest = -INFINITY;
    JoxFootprintPoint inside = {{1.0f, 0.0f}, point, 0.0f};
    JoxV2 on_border = point;
    for (uint32_t i = 0; i < count; i++) {
        JoxV2 a = body->footprint[i], edge = jox_sub(body->footprint[(i + 1) % count], a);
        JoxV2 to = jox_sub(point, a);
        float length2 = jox_length2(edge);
        if (!(length2 > 0.0f))
            continue;
        JoxV2 at = find_nearest_on_edge(a, edge, point);
        float away2 = jox_length2(jox_sub(point, at));
        if (away2 < nearest2) {
            nearest2 = away2;
            on_border = at;
        }
        JoxV2 outward = jox_scale(jox_v2(edge.y, -edge.x), 1.0f / sqrtf(length2));
        float height = jox_dot(to, outward);
        if (height > deepest) {
            deepest = height;
            inside =
                (JoxFootprintPoint){outward, jox_sub(point, jox_scale(outward, height)), height};
        }
    }
    JoxV2 away = jox_sub(point, on_border);
    float gap = jox_length(away);
    if (!(deepest > 0.0f) || !(gap > 0.0f)) /* inside the ring, or on it */
        return inside;
    return (JoxFootprintPoint){jox_scale(away, 1.0f / gap), on_border, gap};
}

/* Returns the absolute values. */
static inline JoxFour absolute_four(JoxFour a) {
    const JoxFourMask sign = {INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN};
    return (JoxFour)(~sign & (JoxFourMask)a);
}

typedef int64_t Halves __attribute__((vector_size(16)));

/* Returns the bitwise OR of all elements. */
static inline uint32_t join_bits(JoxFourMask a) {
    const Halves halves = (Halves)a;
    const uint64_t both = (uint64_t)(halves[0] | halves[1]);
    return (uint32_t)both | (uint32_t)(both >> 32);
}

/* Returns the element that the mask `one` selects. */
static inline float pick_marked(JoxFourMask one, JoxFour of) {
    return jox_float_of(join_bits(one & (JoxFourMask)of));
}

static inline JoxFour least_four(JoxFour a, JoxFour b) {
    return select_four(a < b, a, b);
}

static inline JoxFourMask least_four_whole(JoxFourMask a, JoxFourMask b) {
    const JoxFourMask less = a < b;
    return (less & a) | (~less & b);
}

/* Per lane: nearest point so far, its squared distance, m2, and its edge. */
typedef struct Nearest {
    JoxFour away2, x, y;
    JoxFourMask edge;
} Nearest;

/* Returns a mask of the lane with the nearest point; ties go to the lowest edge. */
static inline JoxFourMask find_nearest_lane(const Nearest *n) {
    const JoxFourMask none = {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX};
    JoxFour least = least_four(n->away2, JOX_SHUFFLE_FOURS(n->away2, n->away2, 2, 3, 0, 1));
    least = least_four(least, JOX_SHUFFLE_FOURS(least, least, 1, 0, 3, 2));
    const JoxFourMask is_least = n->away2 == least;
    const JoxFourMask edges = (is_least & n->edge) | (~is_least & none);
    JoxFourMask first = least_four_whole(edges, JOX_SHUFFLE_FOURS(edges, edges, 2, 3, 0, 1));
    first = least_four_whole(first, JOX_SHUFFLE_FOURS(first, first, 1, 0, 3, 2));
    return edges == first;
}

/* A point is safely outside an edge if its determinant exceeds this share of the two products that
   it is the difference of, and this number, m2: rounding cannot change its sign. */
static const float SURE = 1e-5f, LEAST = 1e-25f;
/* m: squares of greater lengths come close to overflow. */
static const float FAR = 1e15f;

/* Finds the nearest point on the ring for a point outside; false if the point is not safely
   outside. */
static inline bool find_nearest_from_outside(const JoxObject *body, JoxV2 point, JoxV2 *on_border) {
    Nearest n = {
        broadcast_four(INFINITY), broadcast_four(point.x), broadcast_four(point.y), {0, 0, 0, 0}};
    JoxFourMask edge = {0, 1, 2, 3}, outside = {0, 0, 0, 0};
    for (uint32_t first = 0; first < body->footprint_count; first += 4, edge += 4) {
        const Edges e = load_edges(body, first);
        const JoxFour to_x = point.x - e.x, to_y = point.y - e.y;
        const JoxFour length2 = e.along_x * e.along_x + e.along_y * e.along_y;
        const JoxFour share = (to_x * e.along_x + to_y * e.along_y) / length2;
        const JoxFour along = select_four(share < 0.0f, broadcast_four(0.0f),
                                          select_four(share > 1.0f, broadcast_four(1.0f), share));
        const JoxFour x = e.x + e.along_x * along, y = e.y + e.along_y * along;
        const JoxFour away_x = point.x - x, away_y = point.y - y;
        const JoxFour away2 = away_x * away_x + away_y * away_y;
        const JoxFourMask less = (length2 > 0.0f) & (away2 < n.away2);
        n = (Nearest){select_four(less, away2, n.away2), select_four(less, x, n.x),
                      select_four(less, y, n.y), (less & edge) | (~less & n.edge)};
        const JoxFour right = to_x * e.along_y, left = to_y * e.along_x;
        outside |= (length2 > 0.0f) & (length2 < FAR * FAR) & (right - left > LEAST) &
                   (right - left > SURE * (absolute_four(right) + absolute_four(left)));
    }
    const JoxFourMask lane = find_nearest_lane(&n);
    *on_border = (JoxV2){pick_marked(lane, n.x), pick_marked(lane, n.y)};
    return join_bits(outside) != 0;
}

JoxFootprintPoint jox_footprint_nearest(const JoxObject *body, JoxV2 point) {
    JoxV2 on_border;
    if (body->footprint_count < 2)
        return find_nearest_on_disc(body, point);
    if (!find_nearest_from_outside(body, point, &on_border))
        return find_nearest_on_ring(body, point);
    const JoxV2 away = jox_sub(point, on_border);
    const float gap = jox_length(away);
    if (!(gap > 0.0f && gap < FAR))
        return find_nearest_on_ring(body, point);
    return (JoxFootprintPoint){jox_scale(away, 1.0f / gap), on_border, gap};
}
