#include "geom/hand_reach.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "geom/polygon.h"
#include "geom/wall_grid.h"

static const float CLEARANCE = 0.03f;  /* m: gap between a carried body and a wall, which is 4 cm
                                          thick */
static const float FAST_MASS = 200.0f; /* kg: arms do not push aside heavier bodies */

/* ---- obstacles ---- */

static void add_edge(JoxHands *h, JoxV2 a, JoxV2 b, JoxV2 from, float reach) {
    if (jox_minf(a.x, b.x) > from.x + reach || jox_maxf(a.x, b.x) < from.x - reach ||
        jox_minf(a.y, b.y) > from.y + reach || jox_maxf(a.y, b.y) < from.y - reach)
        return;
    JOX_RESERVE(h->edges, h->capacity, h->count + 1);
    h->edges[h->count++] = (struct JoxHandEdge){a, b};
}

static void add_wall_obstacles(JoxHands *h, const JoxWalls *walls, float lowest, JoxV2 from,
                               float reach) {
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        if (ring->open || ring->height <= lowest)
            continue;
        for (uint32_t v = ring->first; v < ring->first + ring->count; v++)
            if (!walls->vertices[v].absent)
                add_edge(h, walls->vertices[v].point,
                         walls->vertices[walls->vertices[v].next].point, from, reach);
    }
}

/* Makes a polygon around a disc. */
static void make_circle(JoxV2 corners[JOX_FOOTPRINT_POINTS], JoxV2 centre, float radius) {
    const double wedge = JOX_TURN / JOX_FOOTPRINT_POINTS;
    const float about = radius / (float)jox_cos(wedge / 2.0);
    for (int k = 0; k < JOX_FOOTPRINT_POINTS; k++)
        corners[k] = jox_v2(centre.x + about * (float)jox_cos(k * wedge),
                            centre.y + about * (float)jox_sin(k * wedge));
}

/* Adds the edges of a body's footprint; a disc becomes a polygon. */
static void add_footprint(JoxHands *h, const JoxObject *body, JoxV2 from, float reach) {
    JoxV2 circle[JOX_FOOTPRINT_POINTS];
    const bool round = body->footprint_count == 0;
    const uint32_t count = round ? JOX_FOOTPRINT_POINTS : body->footprint_count;
    const JoxV2 *ring = round ? circle : body->footprint;
    if (round)
        make_circle(circle, jox_v2(body->position.x, body->position.y), body->round);
    for (uint32_t k = 0; k < count; k++)
        add_edge(h, ring[k], ring[(k + 1) % count], from, reach);
}

static bool is_fixed(const JoxObject *body) {
    return body->live && body->in_band && body->inverse_mass < 1.0f / FAST_MASS;
}

static void add_objects(JoxHands *h, const JoxObjects *objects, uint32_t row, float lowest,
                        float highest, JoxV2 from, float reach) {
    JoxObjectWalk walk = jox_objects_near(objects, from, reach);
    uint32_t other;
    while (jox_objects_next(&walk, &other)) {
        const JoxObject *body = &objects->rows[other];
        if (other != row && is_fixed(body) && body->high > lowest && body->low < highest &&
            jox_footprint_nearest(body, from).gap > 0.0f)
            add_footprint(h, body, from, reach);
    }
}

/* Makes the held body's outline, relative to its centre, with each edge moved outwards by
   CLEARANCE. */
static void make_outline(JoxHands *h, const JoxV2 *corners, uint32_t count, JoxV2 centre) {
    h->ring_count = count;
    for (uint32_t k = 0; k < count; k++) {
        const JoxV2 before = corners[(k + count - 1) % count], at = corners[k],
                    after = corners[(k + 1) % count];
        const JoxV2 in = jox_unit(jox_sub(at, before)), out = jox_unit(jox_sub(after, at));
        const JoxV2 both = {in.y + out.y, -in.x - out.x}; /* the ring is counter-clockwise */
        const float scale = CLEARANCE / jox_maxf(0.2f, 0.5f * jox_length2(both));
        h->ring[k] = jox_add(jox_sub(at, centre), jox_scale(both, scale));
    }
}

static void make_held_outline(JoxHands *h, const JoxObject *body) {
    const JoxV2 centre = {body->position.x, body->position.y};
    if (body->footprint_count >= 3) {
        make_outline(h, body->footprint, body->footprint_count, centre);
        return;
    }
    h->ring_count = JOX_FOOTPRINT_POINTS;
    make_circle(h->ring, jox_v2(0.0f, 0.0f), body->disc + CLEARANCE);
}

void jox_hands_look(JoxHands *hands, const JoxWalls *walls, const JoxWalls *images,
                    const JoxObjects *objects, uint32_t row, JoxV2 from, float reach) {
    JOX_ASSERT(objects && row < objects->count && reach >= 0.0f);
    const JoxObject *body = &objects->rows[row];
    const float middle = jox_maxf(JOX_HAND_HEIGHT, body->position.z);
    const float lowest = middle - body->below, highest = middle + body->above;
    hands->count = 0;
    make_held_outline(hands, body);
    if (walls)
        add_wall_obstacles(hands, walls, lowest, from, reach);
    if (images)
        add_wall_obstacles(hands, images, lowest, from, reach);
    add_objects(hands, objects, row, lowest, highest, from, reach);
}

/* ---- queries ---- */

bool jox_hands_reach(const JoxHands *hands, JoxV2 from, JoxV2 to) {
    for (uint32_t k = 0; k < hands->count; k++)
        if (jox_segments_cross(from, to, hands->edges[k].a, hands->edges[k].b))
            return false;
    return true;
}

/* Returns whether a point lies in a triangle, whatever its orientation. */
static bool is_in_triangle(JoxV2 point, JoxV2 a, JoxV2 b, JoxV2 c) {
    const bool left = jox_det(jox_sub(b, a), jox_sub(point, a)) > 0.0f;
    return left == (jox_det(jox_sub(c, b), jox_sub(point, b)) > 0.0f) &&
           left == (jox_det(jox_sub(a, c), jox_sub(point, c)) > 0.0f);
}

bool jox_hands_can_hold(const JoxHands *hands, JoxV2 from, JoxV2 at) {
    for (uint32_t e = 0; e < hands->count; e++) {
        const struct JoxHandEdge *edge = &hands->edges[e];
        for (uint32_t k = 0; k < hands->ring_count; k++) {
            const JoxV2 corner = jox_add(at, hands->ring[k]);
            const JoxV2 next = jox_add(at, hands->ring[(k + 1) % hands->ring_count]);
            if (jox_segments_cross(corner, next, edge->a, edge->b) ||
                jox_segments_cross(from, corner, edge->a, edge->b) ||
                is_in_triangle(edge->a, from, corner, next))
                return false;
        }
    }
    return true;
}

enum { STRIDES = 16, HALVINGS = 5 };

/* Finds the farthest point along a direction, up to `gap`, at which the body can be held. */
static bool find_along(const JoxHands *h, JoxV2 from, JoxV2 way, float gap, JoxV2 *at) {
    int stride = STRIDES;
    *at = jox_add(from, jox_scale(way, gap));
    while (!jox_hands_can_hold(h, from, *at)) {
        if (stride-- == 0)
            return false;
        *at = jox_add(from, jox_scale(way, gap * (float)stride / STRIDES));
    }
    float good = gap * (float)stride / STRIDES, span = stride < STRIDES ? gap / STRIDES : 0.0f;
    for (int k = 0; k < HALVINGS && span > 0.0f; k++) {
        span *= 0.5f;
        const JoxV2 farther = jox_add(from, jox_scale(way, good + span));
        if (!jox_hands_can_hold(h, from, farther))
            continue;
        good += span;
        *at = farther;
    }
    return true;
}

bool jox_hands_find(const JoxHands *hands, JoxV2 from, JoxV2 way, float gap, bool around,
                    JoxV2 *at) {
    static const float EIGHTH = 0.70710678f; /* sine and cosine of 45 degrees */
    JoxV2 left = way, right = way;
    if (find_along(hands, from, way, gap, at))
        return true;
    for (int turn = 0; around && turn < 4; turn++) {
        left = jox_scale(jox_add(left, jox_left(left)), EIGHTH);
        right = jox_scale(jox_sub(right, jox_left(right)), EIGHTH);
        if (find_along(hands, from, left, gap, at) || find_along(hands, from, right, gap, at))
            return true;
    }
    return false;
}

void jox_hands_free(JoxHands *hands) {
    jox_free(hands->edges);
    *hands = (JoxHands){0};
}
