/* Helpers of the tests geom_field*: turned walls, and walks along a distance field. */
#ifndef JOSTLE_TESTS_GEOM_WALK_H
#define JOSTLE_TESTS_GEOM_WALK_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/number/elementary.h"
#include "base/number/random.h"
#include "geom/field/field.h"
#include "geom/place_kinds.h"

static const double TURN = 6.283185307179586;

static inline double draw_walk_number(uint32_t k, uint32_t sub) {
    return jox_random_unit(7, k, 0, JOX_DRAW_FILL, sub);
}

static inline JoxV2 turn_point(JoxV2 p, double angle) {
    double c = jox_cos(angle), s = jox_sin(angle);
    return (JoxV2){(float)(c * p.x - s * p.y), (float)(s * p.x + c * p.y)};
}

static inline void add_turned_line(JoxWalls *walls, const JoxV2 *points, uint32_t count,
                                   double angle) {
    JoxV2 moved[16];
    for (uint32_t i = 0; i < count; i++)
        moved[i] = turn_point(points[i], angle);
    jox_walls_add_polyline(walls, moved, count, false, INFINITY);
}

static inline void add_turned_solid(JoxWalls *walls, const JoxV2 *points, uint32_t count,
                                    double angle) {
    JoxV2 moved[16];
    for (uint32_t i = 0; i < count; i++)
        moved[i] = turn_point(points[i], angle);
    jox_walls_add_solid(walls, moved, count, INFINITY);
}

static inline JoxField *make_field_to_point(const JoxWalls *walls, JoxV2 goal, float half,
                                            float cell, float clearance) {
    JoxPlace place = {.kind = JOX_PLACE_POINT, .points = &goal, .count = 1, .radius = 0.1f};
    jox_place_finish(&place);
    return jox_field_create(walls, &place, 0, (JoxV2){-half, -half}, (JoxV2){half, half}, cell,
                            clearance, NULL, NULL, NULL, NULL);
}

static inline bool is_wall_crossed(const JoxWalls *walls, JoxV2 p, JoxV2 q) {
    for (uint32_t i = 0; i < walls->count; i++)
        if (jox_segment_crossing(walls->vertices[i].point,
                                 walls->vertices[walls->vertices[i].next].point, p, q))
            return true;
    return false;
}

static inline float find_wall_distance(const JoxWalls *walls, JoxV2 p) {
    float least = INFINITY;
    for (uint32_t i = 0; i < walls->count; i++) {
        JoxV2 a = walls->vertices[i].point, b = walls->vertices[walls->vertices[i].next].point;
        least = jox_minf(least, jox_length(jox_sub(p, jox_segment_nearest(a, b, p))));
    }
    return least;
}

static inline bool is_point_in_solid(const JoxWalls *walls, JoxV2 p) {
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        JoxV2 ring[16];
        for (uint32_t k = 0; k < walls->rings[r].count && k < 16; k++)
            ring[k] = walls->vertices[walls->rings[r].first + k].point;
        if (walls->rings[r].solid && jox_polygon_contains(ring, walls->rings[r].count, p))
            return true;
    }
    return false;
}

enum { ARRIVED, CROSSED, LOST };
/* Walks in steps of 2 cm until within 0.3 m of the goal, at most `most` m; returns how it ended,
   and the length of the walk, m. */
static inline int walk_by_field(const JoxField *field, const JoxWalls *walls, JoxV2 p, JoxV2 goal,
                                float most, float *length) {
    const float step = 0.02f;
    for (*length = 0.0f; *length < most; *length += step) {
        if (jox_length(jox_sub(p, goal)) < 0.3f) {
            *length += jox_length(jox_sub(p, goal));
            return ARRIVED;
        }
        JoxV2 q = jox_add(p, jox_scale(jox_field_direction(field, p), step));
        if (is_wall_crossed(walls, p, q)) {
            print_message("crossed a wall at %g %g -> %g %g\n", (double)p.x, (double)p.y,
                          (double)q.x, (double)q.y);
            return CROSSED;
        }
        p = q;
    }
    print_message("lost at %g %g\n", (double)p.x, (double)p.y);
    return LOST;
}

/* m: length that a clearance of 0.2 m adds to a way round the end of a wall. */
static const float ROUND_AN_END = 0.6f;

#endif
