/* The nearest point of a body's footprint. Most who ask stand outside of it: for them four edges
   are looked at at once, each with the arithmetic of one, so that both ways agree to the bit. */
#include <math.h>

#include "base/number/bits.h"
#include "geom/objects.h"
#include "simd/four.h"

/* Nearest point of a disc about the body's centre; from the centre itself, +x leads out. */
static JoxFootprintPoint disc_nearest(const JoxObject *body, JoxV2 point) {
    JoxV2 centre = {body->position.x, body->position.y};
    JoxV2 offset = jox_sub(point, centre);
    float distance = jox_length(offset);
    JoxV2 normal = distance > 0.0f ? jox_scale(offset, 1.0f / distance) : jox_v2(1.0f, 0.0f);
    return (JoxFootprintPoint){normal, jox_add(centre, jox_scale(normal, body->round)),
                               distance - body->round};
}

/* Four edges of a ring: where they start, and from there to where the next starts. */
typedef struct Edges {
    JoxFour x, y, along_x, along_y;
} Edges;

static inline JoxFour same(float a) {
    return (JoxFour){a, a, a, a};
}

static inline JoxFour choose(JoxFourMask marks, JoxFour a, JoxFour b) {
    return (JoxFour)((marks & (JoxFourMask)a) | (~marks & (JoxFourMask)b));
}

/* Edges `first` to `first` + 3; those behind the last are of no length. */
static inline Edges edges_of(const JoxObject *body, uint32_t first) {
    const int left = (int)(body->footprint_count - first);
    const JoxV2 *ring = body->footprint, *next = left > 4 ? &ring[first + 4] : ring;
    const JoxFour low = jox_load_four(&ring[first].x), high = jox_load_four(&ring[first + 2].x);
    const JoxFourMask lane = {0, 1, 2, 3}, last = lane == left - 1, within = lane < left;
    const JoxFour x = JOX_SHUFFLE_FOURS(low, high, 0, 2, 4, 6);
    const JoxFour y = JOX_SHUFFLE_FOURS(low, high, 1, 3, 5, 7);
    const JoxFour to_x =
        choose(last, same(ring[0].x), JOX_SHUFFLE_FOURS(x, same(next->x), 1, 2, 3, 4));
    const JoxFour to_y =
        choose(last, same(ring[0].y), JOX_SHUFFLE_FOURS(y, same(next->y), 1, 2, 3, 4));
    return (Edges){x, y, jox_keep_four(within, to_x - x), jox_keep_four(within, to_y - y)};
}

/* Nearest point of an edge, which begins at `a`. */
static inline JoxV2 nearest_on(JoxV2 a, JoxV2 edge, JoxV2 point) {
    float along = jox_clampf(jox_dot(jox_sub(point, a), edge) / jox_length2(edge), 0.0f, 1.0f);
    return jox_add(a, jox_scale(edge, along));
}

/* From anywhere, edge by edge. */
static JoxFootprintPoint ring_nearest(const JoxObject *body, JoxV2 point) {
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
        JoxV2 at = nearest_on(a, edge, point);
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
    if (!(deepest > 0.0f) || !(gap > 0.0f)) /* within the ring, or on it */
        return inside;
    return (JoxFootprintPoint){jox_scale(away, 1.0f / gap), on_border, gap};
}

/* The magnitudes. */
static inline JoxFour size_of(JoxFour a) {
    const JoxFourMask sign = {INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN};
    return (JoxFour)(~sign & (JoxFourMask)a);
}

typedef int64_t Halves __attribute__((vector_size(16)));

/* The bits of all elements together. */
static inline uint32_t bits_of(JoxFourMask a) {
    const Halves halves = (Halves)a;
    const uint64_t both = (uint64_t)(halves[0] | halves[1]);
    return (uint32_t)both | (uint32_t)(both >> 32);
}

/* The element that is marked. */
static inline float marked(JoxFourMask one, JoxFour of) {
    return jox_float_of(bits_of(one & (JoxFourMask)of));
}

static inline JoxFour lesser(JoxFour a, JoxFour b) {
    return choose(a < b, a, b);
}

static inline JoxFourMask lesser_whole(JoxFourMask a, JoxFourMask b) {
    const JoxFourMask less = a < b;
    return (less & a) | (~less & b);
}

/* Of each lane the nearest point so far, how far off it is, and of which edge. */
typedef struct Nearest {
    JoxFour away2, x, y;
    JoxFourMask edge;
} Nearest;

/* Marks the nearest of all lanes; of equals the one of the first edge. */
static inline JoxFourMask nearest_lane(const Nearest *n) {
    const JoxFourMask none = {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX};
    JoxFour least = lesser(n->away2, JOX_SHUFFLE_FOURS(n->away2, n->away2, 2, 3, 0, 1));
    least = lesser(least, JOX_SHUFFLE_FOURS(least, least, 1, 0, 3, 2));
    const JoxFourMask is_least = n->away2 == least;
    const JoxFourMask edges = (is_least & n->edge) | (~is_least & none);
    JoxFourMask first = lesser_whole(edges, JOX_SHUFFLE_FOURS(edges, edges, 2, 3, 0, 1));
    first = lesser_whole(first, JOX_SHUFFLE_FOURS(first, first, 1, 0, 3, 2));
    return edges == first;
}

/* How far a point is beyond the line of an edge, times the edge's length, must be more than this
   share of what it is the difference of, and than this in m2: then rounding hides no sign. */
static const float SURE = 1e-5f, LEAST = 1e-25f;
/* m: what is longer or farther, squared, soon is no number any more. */
static const float FAR = 1e15f;

/* The nearest point on the ring, for a point outside; false where that is not sure. */
static inline bool nearest_from_outside(const JoxObject *body, JoxV2 point, JoxV2 *on_border) {
    Nearest n = {same(INFINITY), same(point.x), same(point.y), {0, 0, 0, 0}};
    JoxFourMask edge = {0, 1, 2, 3}, outside = {0, 0, 0, 0};
    for (uint32_t first = 0; first < body->footprint_count; first += 4, edge += 4) {
        const Edges e = edges_of(body, first);
        const JoxFour to_x = point.x - e.x, to_y = point.y - e.y;
        const JoxFour length2 = e.along_x * e.along_x + e.along_y * e.along_y;
        const JoxFour share = (to_x * e.along_x + to_y * e.along_y) / length2;
        const JoxFour along =
            choose(share < 0.0f, same(0.0f), choose(share > 1.0f, same(1.0f), share));
        const JoxFour x = e.x + e.along_x * along, y = e.y + e.along_y * along;
        const JoxFour away_x = point.x - x, away_y = point.y - y;
        const JoxFour away2 = away_x * away_x + away_y * away_y;
        const JoxFourMask less = (length2 > 0.0f) & (away2 < n.away2);
        n = (Nearest){choose(less, away2, n.away2), choose(less, x, n.x), choose(less, y, n.y),
                      (less & edge) | (~less & n.edge)};
        const JoxFour right = to_x * e.along_y, left = to_y * e.along_x;
        outside |= (length2 > 0.0f) & (length2 < FAR * FAR) & (right - left > LEAST) &
                   (right - left > SURE * (size_of(right) + size_of(left)));
    }
    const JoxFourMask lane = nearest_lane(&n);
    *on_border = (JoxV2){marked(lane, n.x), marked(lane, n.y)};
    return bits_of(outside) != 0;
}

JoxFootprintPoint jox_footprint_nearest(const JoxObject *body, JoxV2 point) {
    JoxV2 on_border;
    if (body->footprint_count < 2)
        return disc_nearest(body, point);
    if (!nearest_from_outside(body, point, &on_border))
        return ring_nearest(body, point);
    const JoxV2 away = jox_sub(point, on_border);
    const float gap = jox_length(away);
    if (!(gap > 0.0f && gap < FAR))
        return ring_nearest(body, point);
    return (JoxFootprintPoint){jox_scale(away, 1.0f / gap), on_border, gap};
}
