#include "body/footprint.h"

#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"

void jox_footprint_begin(JoxFootprint *footprint) {
    footprint->count = 0;
    footprint->low = INFINITY;
    footprint->high = -INFINITY;
}

static void put(JoxFootprint *f, float x, float y) {
    JOX_RESERVE(f->points, f->capacity, f->count + 1);
    f->points[f->count++] = jox_v2(x, y);
}

/* Where the edge a-b passes a height. */
static void cut(JoxFootprint *f, JoxV3 a, JoxV3 b, float height) {
    if ((a.z < height) == (b.z < height))
        return;
    float t = (height - a.z) / (b.z - a.z);
    JOX_ASSERT(t >= 0.0f && t <= 1.0f);
    put(f, a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t);
}

void jox_footprint_add(JoxFootprint *footprint, const JoxV3 *corners, uint32_t corner_count,
                       const uint32_t *edges, uint32_t edge_count) {
    float low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < corner_count; i++) {
        JoxV3 p = corners[i];
        low = jox_minf(low, p.z);
        high = jox_maxf(high, p.z);
        if (p.z >= JOX_BAND_LOW && p.z <= JOX_BAND_HIGH)
            put(footprint, p.x, p.y);
    }
    footprint->low = jox_minf(footprint->low, low);
    footprint->high = jox_maxf(footprint->high, high);
    /* Most of what stands on the ground ends below the upper height. */
    const bool passes_low = low < JOX_BAND_LOW && high >= JOX_BAND_LOW;
    const bool passes_high = low < JOX_BAND_HIGH && high >= JOX_BAND_HIGH;
    for (uint32_t e = 0; (passes_low || passes_high) && e < edge_count; e++) {
        JoxV3 a = corners[edges[2 * e]], b = corners[edges[2 * e + 1]];
        if (passes_low)
            cut(footprint, a, b, JOX_BAND_LOW);
        if (passes_high)
            cut(footprint, a, b, JOX_BAND_HIGH);
    }
}

float jox_footprint_sphere(float z, float radius) {
    float away = jox_maxf(JOX_BAND_LOW - z, z - JOX_BAND_HIGH);
    if (away <= 0.0f)
        return radius;
    return away < radius ? sqrtf(radius * radius - away * away) : 0.0f;
}

static void lay_circle(JoxFootprint *footprint) {
    for (int i = 0; i < JOX_FOOTPRINT_POINTS; i++) {
        double angle = i * (JOX_TURN / JOX_FOOTPRINT_POINTS);
        footprint->circle[i] = jox_v2((float)jox_cos(angle), (float)jox_sin(angle));
    }
    footprint->has_circle = true;
}

void jox_footprint_add_sphere(JoxFootprint *footprint, JoxV3 centre, float radius) {
    footprint->low = jox_minf(footprint->low, centre.z - radius);
    footprint->high = jox_maxf(footprint->high, centre.z + radius);
    float round = jox_footprint_sphere(centre.z, radius);
    if (round <= 0.0f)
        return;
    if (!footprint->has_circle)
        lay_circle(footprint);
    for (int i = 0; i < JOX_FOOTPRINT_POINTS; i++)
        put(footprint, centre.x + round * footprint->circle[i].x,
            centre.y + round * footprint->circle[i].y);
}

/* By x, then y. */
static inline bool comes_after(JoxV2 p, JoxV2 q) {
    return p.x != q.x ? p.x > q.x : p.y > q.y;
}

static void insert_points(JoxV2 *points, uint32_t count) {
    for (uint32_t k = 1; k < count; k++) {
        const JoxV2 point = points[k];
        uint32_t at = k;
        for (; at > 0 && comes_after(points[at - 1], point); at--)
            points[at] = points[at - 1];
        points[at] = point;
    }
}

/* Merges halves, as jox_sort does, whose calls for each comparison would cost more than all else
   here. `spare` has room for half of the points. */
static void sort_points(JoxV2 *points, uint32_t count, JoxV2 *spare) {
    enum { FEW = 16 };
    const uint32_t half = count / 2;
    if (count <= FEW) {
        insert_points(points, count);
        return;
    }
    sort_points(points, half, spare);
    sort_points(points + half, count - half, spare);
    memcpy(spare, points, half * sizeof *spare);
    for (uint32_t left = 0, right = half, to = 0; left < half; to++)
        points[to] = right == count || !comes_after(spare[left], points[right]) ? spare[left++]
                                                                                : points[right++];
}

static float turn(JoxV2 a, JoxV2 b, JoxV2 c) {
    return jox_det(jox_sub(b, a), jox_sub(c, a));
}

/* Whether a, b, c turn left, exactly: with a tolerance, two points that all but coincide would hide
   a corner between which they lie in the order of x. */
static bool turns_left(JoxV2 a, JoxV2 b, JoxV2 c) {
    return ((double)b.x - a.x) * ((double)c.y - a.y) > ((double)b.y - a.y) * ((double)c.x - a.x);
}

/* Monotone chains. `ring` has room for count + 1 points. */
static uint32_t hull(const JoxV2 *points, uint32_t count, JoxV2 *ring) {
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++) {
        while (n >= 2 && !turns_left(ring[n - 2], ring[n - 1], points[i]))
            n--;
        ring[n++] = points[i];
    }
    for (uint32_t i = count - 1, least = n + 1; i-- > 0;) {
        while (n >= least && !turns_left(ring[n - 2], ring[n - 1], points[i]))
            n--;
        ring[n++] = points[i];
    }
    JOX_ASSERT(n <= count + 1);
    return n > 1 ? n - 1 : n;
}

/* The corner that spans least with those beside it, and what it spans, m2. */
static uint32_t find_least(const JoxV2 *ring, uint32_t n, float *least_area) {
    uint32_t least = 0;
    JoxV2 before = ring[n - 1], at = ring[0];
    *least_area = INFINITY;
    for (uint32_t i = 0; i < n; i++) {
        const JoxV2 after = ring[i + 1 < n ? i + 1 : 0];
        const float area = turn(before, at, after);
        if (area < *least_area) {
            *least_area = area;
            least = i;
        }
        before = at;
        at = after;
    }
    return least;
}

/* Takes out the corners that span least: those over the limit, and those that rounding made. */
static uint32_t thin(JoxV2 *ring, uint32_t n) {
    while (n > 3) {
        float least_area;
        const uint32_t least = find_least(ring, n, &least_area);
        if (n <= JOX_FOOTPRINT_POINTS && least_area > 1e-6f)
            break;
        for (uint32_t i = least; i + 1 < n; i++)
            ring[i] = ring[i + 1];
        n--;
    }
    return n;
}

void jox_footprint_end(JoxFootprint *footprint, JoxObject *object) {
    uint32_t n = footprint->count;
    object->low = jox_maxf(footprint->low, JOX_BAND_LOW);
    object->high = jox_minf(footprint->high, JOX_BAND_HIGH);
    object->footprint_count = 0;
    object->in_band = object->high > object->low && n > 0;
    if (!object->in_band)
        return;
    JOX_RESERVE(footprint->points, footprint->capacity, 2 * n + 2);
    JoxV2 *ring = footprint->points + n; /* spare room, then the hull */
    sort_points(footprint->points, n, ring);
    uint32_t corners = thin(ring, hull(footprint->points, n, ring));
    /* A sliver without area cannot be touched. */
    object->in_band = corners >= 3;
    object->footprint_count = corners >= 3 ? corners : 0;
    for (uint32_t i = 0; i < object->footprint_count; i++)
        object->footprint[i] = ring[i];
    JOX_CHECK(jox_footprint_check(object));
}

void jox_footprint_free(JoxFootprint *footprint) {
    jox_free(footprint->points);
    *footprint = (JoxFootprint){0};
}
