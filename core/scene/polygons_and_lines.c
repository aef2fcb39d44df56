/* Reads polygons, boxes, lines and points of a scene. */
#include <math.h>

#include "base/assert.h"
#include "geom/polygon.h"
#include "scene/scene_draft.h"

enum { MOST_TESTED = 2000 }; /* corners of a polygon whose edges are tested against each other */

JoxV2 *jox_read_polygon(const JoxReader *r, const JoxYaml *node, uint32_t *count) {
    JoxV2 *ring = jox_read_points(r, node, 3, count);
    uint32_t a, b;
    if (!ring)
        return NULL;
    if (*count <= MOST_TESTED && jox_polygon_self_crosses(ring, *count, &a, &b)) {
        jox_scene_error(r, node->items[b], "self-crossing", "Put the corners in order",
                        "this polygon crosses itself: the edges from corner %u and corner %u meet",
                        a + 1, b + 1);
        *count = 0;
        return NULL;
    }
    double area = jox_polygon_area(ring, *count);
    if (fabs(area) < 1e-6) {
        jox_scene_error(r, node, "no-area", NULL, "this polygon encloses no area");
        *count = 0;
        return NULL;
    }
    for (uint32_t i = 0; area < 0 && i < *count / 2; i++) { /* make it counter-clockwise */
        JoxV2 swap = ring[i];
        ring[i] = ring[*count - 1 - i];
        ring[*count - 1 - i] = swap;
    }
    JOX_ASSERT(jox_polygon_area(ring, *count) > 0);
    return ring;
}

bool jox_read_box(const JoxReader *r, const JoxYaml *node, JoxV2 *low, JoxV2 *high) {
    uint32_t count;
    JoxV2 *points = node ? jox_read_points(r, node, 2, &count) : NULL;
    if (points)
        jox_bounds(points, count, low, high);
    if (points && !(low->x < high->x && low->y < high->y))
        jox_scene_error(r, node, "no-area", NULL, "this area is empty");
    return points != NULL;
}

static void store_key_points(const JoxKey *key, void *item, const JoxV2 *points, uint32_t count) {
    JOX_ASSERT(points || count == 0);
    *JOX_MEMBER(const JoxV2 *, item, key->offset) = points;
    *JOX_MEMBER(uint32_t, item, key->count_offset) = count;
}

void jox_key_read_ring(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    uint32_t count = 0;
    const JoxV2 *ring = node ? jox_read_polygon(r, node, &count) : NULL;
    store_key_points(key, item, ring, count);
}

void jox_key_read_points(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    uint32_t count = 0;
    const JoxV2 *points = node ? jox_read_points(r, node, 1, &count) : NULL;
    if (node) /* else the count of another key stays */
        store_key_points(key, item, points, count);
}

void jox_key_read_point(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    double v[2];
    if (!jox_key_read_vector(r, key, node, v, 2))
        return;
    JoxV2 *point = jox_arena_take(r->arena, 1, sizeof *point);
    *point = jox_v2((float)v[0], (float)v[1]);
    store_key_points(key, item, point, 1);
}

/* Reads a line of two points that lie apart into out[0] and out[1]; false with an error. */
static bool read_two_points(const JoxReader *r, const JoxYaml *node, JoxV2 *out) {
    uint32_t count;
    JoxV2 *points = jox_read_points(r, node, 2, &count);
    if (!points)
        return false;
    if (count != 2) {
        jox_scene_error(r, node, "bad-probe", "[[0, 0], [0, 2]]", "a line has two points");
        return false;
    }
    if (!(jox_length(jox_sub(points[1], points[0])) >= 1e-3f)) {
        jox_scene_error(r, node, "bad-probe", "Nobody crosses a point",
                        "the ends of this line are less than a millimetre apart");
        return false;
    }
    out[0] = points[0];
    out[1] = points[1];
    return true;
}

void jox_key_read_line(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxV2 *points = jox_arena_take(r->arena, 2, sizeof *points);
    store_key_points(key, item, points, node && read_two_points(r, node, points) ? 2 : 0);
}

void jox_key_read_lines(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxV2 *points = jox_arena_take(r->arena, 4, sizeof *points);
    bool good = node && node->kind == JOX_YAML_LIST && node->count == 2;
    if (node && !good)
        jox_scene_error(r, node, "bad-type", "transit: [[[0, 0], [0, 2]], [[5, 0], [5, 2]]]",
                        "%s is a list of two lines", key->name);
    for (uint32_t i = 0; node && i < 2 && node->kind == JOX_YAML_LIST && i < node->count; i++)
        good = read_two_points(r, node->items[i], points + 2 * i) && good;
    store_key_points(key, item, points, good ? 4 : 0);
}

void jox_key_read_box(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxV2 *low = JOX_MEMBER(JoxV2, item, key->offset),
          *high = JOX_MEMBER(JoxV2, item, key->count_offset);
    *low = jox_v2(INFINITY, INFINITY);
    *high = jox_v2(-INFINITY, -INFINITY);
    jox_read_box(r, node, low, high);
}
