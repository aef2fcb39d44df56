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

static void add_footprint_point(JoxFootprint *f, float x, float y) {
    JOX_RESERVE(f->points, f->capacity, f->count + 1);
    f->points[f->count++] = jox_v2(x, y);
}

/* Adds the point at which the edge a-b crosses a height, m. */
static void add_edge_cut(JoxFootprint *f, JoxV3 a, JoxV3 b, float height) {
    if ((a.z < height) == (b.z < height))
        return;
    float t = (height - a.z) / (b.z - a.z);
    JOX_ASSERT(t >= 0.0f && t <= 1.0f);
    add_footprint_point(f, a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t);
}

void jox_footprint_add(JoxFootprint *footprint, const JoxV3 *corners, uint32_t corner_count,
                       const uint32_t *edges, uint32_t edge_count) {
    float low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < corner_count; i++) {
        JoxV3 p = corners[i];
        low = jox_minf(low, p.z);
        high = jox_maxf(high, p.z);
        if (p.z >= JOX_BAND_LOW && p.z <= JOX_BAND_HIGH)
            add_footprint_point(footprint, p.x, p.y);
    }
    footprint->low = jox_minf(footprint->low, low);
    footprint->high = jox_maxf(footprint->high, high);
    /* Most bodies on the ground end below the upper height. */
    const bool passes_low = low < JOX_BAND_LOW && high >= JOX_BAND_LOW;
    const bool passes_high = low < JOX_BAND_HIGH && high >= JOX_BAND_HIGH;
    for (uint32_t e = 0; (passes_low || passes_high) && e < edge_count; e++) {
        JoxV3 a = corners[edges[2 * e]], b = corners[edges[2 * e + 1]];
        if (passes_low)
            add_edge_cut(footprint, a, b, JOX_BAND_LOW);
        if (passes_high)
            add_edge_cut(footprint, a, b, JOX_BAND_HIGH);
    }
}

float jox_footprint_sphere(float z, float radius) {
    float away = jox_maxf(JOX_BAND_LOW - z, z - JOX_BAND_HIGH);
    if (away <= 0.0f)
        return radius;
    return away < radius ? sqrtf(radius * radius - away * away) : 0.0f;
}

static void fill_unit_circle(JoxFootprint *footprint) {
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
        fill_unit_circle(footprint);
    for (int i = 0; i < JOX_FOOTPRINT_POINTS; i++)
        add_footprint_point(footprint, centre.x + round * footprint->circle[i].x,
                            centre.y + round * footprint->circle[i].y);
}

/* Whether p comes after q in the order of x, then y. */
static inline bool is_point_after(JoxV2 p, JoxV2 q) {
    return p.x != q.x ? p.x > q.x : p.y > q.y;
}

static void insertion_sort_points(JoxV2 *points, uint32_t count) {
    for (uint32_t k = 1; k < count; k++) {
        const JoxV2 point = points[k];
        uint32_t at = k;
        for (; at > 0 && is_point_after(points[at - 1], point); at--)
            points[at] = points[at - 1];
        points[at] = point;
    }
}

/* Sorts points by merging halves. jox_sort does the same, but its calls for each comparison
   would dominate the cost here. `spare` has room for half of the points. */
static void merge_sort_points(JoxV2 *points, uint32_t count, JoxV2 *spare) {
    enum { FEW = 16 };
    const uint32_t half = count / 2;
    if (count <= FEW) {
        insertion_sort_points(points, count);
        return;
    }
    merge_sort_points(points, half, spare);
    merge_sort_points(points + half, count - half, spare);
    memcpy(spare, points, half * sizeof *spare);
    for (uint32_t left = 0, right = half, to = 0; left < half; to++)
        points[to] = right == count || !is_point_after(spare[left], points[right])
                         ? spare[left++]
                         : points[right++];
}

static float compute_turn_area(JoxV2 a, JoxV2 b, JoxV2 c) {
    return jox_det(jox_sub(b, a), jox_sub(c, a));
}

/* Whether a, b, c turn left, computed exactly: with a tolerance, two almost equal points would
   hide a corner between them in the order of x. */
static bool turns_left(JoxV2 a, JoxV2 b, JoxV2 c) {
    return ((double)b.x - a.x) * ((double)c.y - a.y) > ((double)b.y - a.y) * ((double)c.x - a.x);
}

/* Builds the convex hull by monotone chains; returns its number of corners. `ring` has room for
   count + 1 points. */
static uint32_t build_hull_ring(const JoxV2 *points, uint32_t count, JoxV2 *ring) {
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

/* Returns the corner whose triangle with its two neighbours has the least area, and twice that
   area, m2. */
static uint32_t find_least_corner(const JoxV2 *ring, uint32_t n, float *least_area) {
    uint32_t least = 0;
    JoxV2 before = ring[n - 1], at = ring[0];
    *least_area = INFINITY;
    for (uint32_t i = 0; i < n; i++) {
        const JoxV2 after = ring[i + 1 < n ? i + 1 : 0];
        const float area = compute_turn_area(before, at, after);
        if (area < *least_area) {
            *least_area = area;
            least = i;
        }
        before = at;
        at = after;
    }
    return least;
}

/* Removes the corners that span the least area: those beyond the limit of points, and artefacts
   of rounding. Returns how many are left. */
static uint32_t remove_least_corners(JoxV2 *ring, uint32_t n) {
    while (n > 3) {
        float least_area;
        const uint32_t least = find_least_corner(ring, n, &least_area);
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
    JoxV2 *ring = footprint->points + n; /* spare memory of the sort, then the hull */
    merge_sort_points(footprint->points, n, ring);
    uint32_t corners = remove_least_corners(ring, build_hull_ring(footprint->points, n, ring));
    /* A footprint without area cannot be touched. */
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
