/* Ways round walls: lengths and directions in the open, round traps, through gaps, out of margins.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/elementary.h"
#include "base/random.h"
#include "geom/field.h"

static const double TURN = 6.283185307179586;

/* ---- help ---- */

static double draw(uint32_t k, uint32_t sub) {
    return jox_random_unit(7, k, 0, JOX_DRAW_FILL, sub);
}

static JoxV2 turned(JoxV2 p, double angle) {
    double c = jox_cos(angle), s = jox_sin(angle);
    return (JoxV2){(float)(c * p.x - s * p.y), (float)(s * p.x + c * p.y)};
}

static void add_line(JoxWalls *walls, const JoxV2 *points, uint32_t count, double angle) {
    JoxV2 moved[16];
    for (uint32_t i = 0; i < count; i++)
        moved[i] = turned(points[i], angle);
    jox_walls_add_polyline(walls, moved, count, false, INFINITY);
}

static void add_solid(JoxWalls *walls, const JoxV2 *points, uint32_t count, double angle) {
    JoxV2 moved[16];
    for (uint32_t i = 0; i < count; i++)
        moved[i] = turned(points[i], angle);
    jox_walls_add_solid(walls, moved, count, INFINITY);
}

static JoxField *to_point(const JoxWalls *walls, JoxV2 goal, float half, float cell,
                          float clearance) {
    JoxPlace place = {.kind = JOX_PLACE_POINT, .points = &goal, .count = 1, .radius = 0.1f};
    jox_place_finish(&place);
    return jox_field_create(walls, &place, 0, (JoxV2){-half, -half}, (JoxV2){half, half}, cell,
                            clearance);
}

static bool crosses(const JoxWalls *walls, JoxV2 p, JoxV2 q) {
    for (uint32_t i = 0; i < walls->count; i++)
        if (jox_segment_crossing(walls->vertices[i].point,
                                 walls->vertices[walls->vertices[i].next].point, p, q))
            return true;
    return false;
}

static float wall_distance(const JoxWalls *walls, JoxV2 p) {
    float least = INFINITY;
    for (uint32_t i = 0; i < walls->count; i++) {
        JoxV2 a = walls->vertices[i].point, b = walls->vertices[walls->vertices[i].next].point;
        least = jox_minf(least, jox_length(jox_sub(p, jox_segment_nearest(a, b, p))));
    }
    return least;
}

static bool in_solid(const JoxWalls *walls, JoxV2 p) {
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
/* Walks by steps of 2 cm until within 0.3 m of the goal; the length that was walked. */
static int walk(const JoxField *field, const JoxWalls *walls, JoxV2 p, JoxV2 goal, float most,
                float *length) {
    const float step = 0.02f;
    for (*length = 0.0f; *length < most; *length += step) {
        if (jox_length(jox_sub(p, goal)) < 0.3f) {
            *length += jox_length(jox_sub(p, goal));
            return ARRIVED;
        }
        JoxV2 q = jox_add(p, jox_scale(jox_field_direction(field, p), step));
        if (crosses(walls, p, q)) {
            print_message("crossed a wall at %g %g -> %g %g\n", (double)p.x, (double)p.y,
                          (double)q.x, (double)q.y);
            return CROSSED;
        }
        p = q;
    }
    print_message("lost at %g %g\n", (double)p.x, (double)p.y);
    return LOST;
}

/* ---- the open ---- */

static void in_the_open_it_is_euclid(void **state) {
    (void)state;
    const float cells[] = {0.1f, 0.25f, 0.5f};
    for (int c = 0; c < 3; c++) {
        JoxWalls walls = {0};
        JoxV2 goal = {0.37f, -0.21f};
        JoxField *field = to_point(&walls, goal, 16.0f, cells[c], 0.2f);
        double worst = 0.0, bend = 0.0;
        for (int k = 0; k < 7200; k++) {
            double angle = TURN * k / 720.0, far = 1.0 + 1.4 * (k / 720);
            JoxV2 out = {(float)jox_cos(angle), (float)jox_sin(angle)};
            JoxV2 p = jox_add(goal, jox_scale(out, (float)far));
            double off = fabs((double)jox_field_distance(field, p) - far) / far;
            JoxV2 way = jox_field_direction(field, p);
            assert_true(fabs((double)jox_length(way) - 1.0) < 1e-5);
            double turn = fabs(jox_atan2((double)jox_det(out, way), -(double)jox_dot(out, way)));
            worst = off > worst ? off : worst;
            bend = turn > bend ? turn : bend;
        }
        print_message("cell %.2f: length off by %.2f %%, direction by %.2f degrees\n",
                      (double)cells[c], 100.0 * worst, bend * 360.0 / TURN);
        assert_true(worst < 0.03);
        assert_true(bend < 3.0 * TURN / 360.0);
        assert_true(jox_field_distance(field, goal) < 0.1f * cells[c]);
        assert_true(jox_length(jox_field_direction(field, goal)) < 1e-6f);
        jox_field_free(field);
    }
}

static void outside_the_box_one_walks_to_it(void **state) {
    (void)state;
    JoxWalls walls = {0};
    JoxField *field = to_point(&walls, (JoxV2){0, 0}, 5.0f, 0.25f, 0.2f);
    float there = jox_field_distance(field, (JoxV2){5, 3});
    assert_true(fabsf(jox_field_distance(field, (JoxV2){9, 3}) - (there + 4.0f)) < 0.01f);
    assert_true(fabsf(there - sqrtf(34.0f)) < 0.03f * there);
    JoxV2 way = jox_field_direction(field, (JoxV2){9, 3});
    assert_true(way.x < -0.7f && fabsf(jox_length(way) - 1.0f) < 1e-5f);
    way = jox_field_direction(field, (JoxV2){-40, -40});
    assert_true(way.x > 0.6f && way.y > 0.6f);
    JoxV2 nowhere = {NAN, INFINITY}; /* any answer, but one */
    assert_false(isinf(jox_field_direction(field, nowhere).x));
    jox_field_distance(field, nowhere);
    jox_field_free(field);
    jox_field_free(NULL);
}

static void boxes_that_are_none_are_borne(void **state) {
    (void)state;
    JoxWalls walls = {0};
    JoxV2 goal = {2, 3};
    JoxPlace place = {.kind = JOX_PLACE_POINT, .points = &goal, .count = 1, .radius = 0.5f};
    jox_place_finish(&place);
    const JoxV2 boxes[][2] = {{{INFINITY, INFINITY}, {-INFINITY, -INFINITY}},
                              {{-1e30f, -1e30f}, {1e30f, 1e30f}},
                              {{0, 0}, {NAN, NAN}},
                              {{7, 7}, {7, 7}},
                              {{-5000, -5000}, {5000, 5000}}};
    for (int k = 0; k < 5; k++) {
        JoxField *field = jox_field_create(&walls, &place, 0, boxes[k][0], boxes[k][1], 0.1f, 0.2f);
        float distance = jox_field_distance(field, (JoxV2){4, 3});
        assert_true(distance >= 0.0f);
        jox_field_free(field);
    }
}

/* ---- traps ---- */

/* A U of arms 8 m long, 6 m apart, open to the left; the goal lies behind its bottom. */
static const JoxV2 U[] = {{-4, 3}, {4, 3}, {4, -3}, {-4, -3}};
static const JoxV2 BEHIND = {6, 0};

/* Shortest way of a point from inside the U: by an end of an arm and a corner of its bottom. */
static float round_u(JoxV2 p) {
    float best = INFINITY;
    for (int side = 0; side < 2; side++) {
        JoxV2 end = U[side ? 3 : 0], corner = U[side ? 2 : 1];
        best = jox_minf(best, jox_length(jox_sub(p, end)) + jox_length(jox_sub(end, corner)) +
                                  jox_length(jox_sub(corner, BEHIND)));
    }
    return best;
}
/* What people add to it who keep 0.2 m off: to both sides of the end, and about it. */
static const float ROUND_AN_END = 0.6f;

static void a_trap_is_left(double angle) {
    JoxWalls walls = {0};
    add_line(&walls, U, 4, angle);
    JoxV2 goal = turned(BEHIND, angle);
    JoxField *field = to_point(&walls, goal, 12.0f, 0.25f, 0.2f);
    float most = 0.0f;
    int bad = 0;
    for (uint32_t k = 0; k < 200; k++) {
        JoxV2 p = {-4.0f + 8.0f * (float)draw(k, 0), -3.0f + 6.0f * (float)draw(k, 1)};
        float length, shortest = round_u(p);
        bad += walk(field, &walls, turned(p, angle), goal, 60.0f, &length) != ARRIVED;
        most = jox_maxf(most, length / shortest);
        float told = jox_field_distance(field, turned(p, angle));
        if (!(told > 0.97f * shortest && told < 1.08f * (shortest + ROUND_AN_END))) {
            print_message("told %g for %g at %g %g\n", (double)told, (double)shortest, (double)p.x,
                          (double)p.y);
            bad++;
        }
    }
    print_message("turned by %.0f degrees: at most %.3f of the shortest way\n",
                  angle * 360.0 / TURN, (double)most);
    assert_int_equal(bad, 0);
    assert_true(most < 1.1f);
    jox_field_free(field);
    jox_walls_free(&walls);
}

static void a_trap_is_left_by_the_shortest_way(void **state) {
    (void)state;
    a_trap_is_left(0.0);
    a_trap_is_left(TURN / 8);
    a_trap_is_left(0.3);
}

static void a_turned_plan_has_the_same_lengths(void **state) {
    (void)state;
    JoxWalls walls = {0}, other = {0};
    add_line(&walls, U, 4, 0.0);
    add_line(&other, U, 4, TURN / 8);
    JoxField *a = to_point(&walls, BEHIND, 12.0f, 0.25f, 0.2f);
    JoxField *b = to_point(&other, turned(BEHIND, TURN / 8), 12.0f, 0.25f, 0.2f);
    float worst = 0.0f;
    for (uint32_t k = 0; k < 500; k++) {
        JoxV2 p = {-7.0f + 14.0f * (float)draw(k, 2), -7.0f + 14.0f * (float)draw(k, 3)};
        float there = jox_field_distance(a, p);
        float here = jox_field_distance(b, turned(p, TURN / 8));
        if (jox_length(jox_sub(p, BEHIND)) > 1.0f)
            worst = jox_maxf(worst, fabsf(here - there) / there);
    }
    print_message("lengths differ by %.2f %%\n", 100.0 * (double)worst);
    assert_true(worst < 0.03f);
    jox_field_free(a);
    jox_field_free(b);
    jox_walls_free(&walls);
    jox_walls_free(&other);
}

/* ---- gaps ---- */

/* A wall right across the box with a gap of `width`, its middle `shift` along the wall. */
static JoxWalls barrier(float width, float shift, double angle) {
    JoxWalls walls = {0};
    JoxV2 left[] = {{-30, 0.013f}, {shift - width / 2, 0.013f}};
    JoxV2 right[] = {{shift + width / 2, 0.013f}, {30, 0.013f}};
    add_line(&walls, left, 2, angle);
    add_line(&walls, right, 2, angle);
    return walls;
}

static void a_gap_of_a_persons_width_is_passed(void **state) {
    (void)state;
    const float cells[] = {0.1f, 0.125f, 0.25f, 0.5f};
    int bad = 0;
    for (int c = 0; c < 4; c++)
        for (int s = 0; s < 5; s++)
            for (int t = 0; t < 4; t++) {
                double angle = t == 3 ? 0.2 : TURN / 16 * t;
                float shift = 0.061f * (float)s, length;
                /* Half a metre asks for more: 2 clearances and 0.6 cells. */
                JoxWalls walls = barrier(cells[c] < 0.4f ? 0.6f : 0.7f, shift, angle);
                JoxV2 goal = turned((JoxV2){0, -4}, angle), p = turned((JoxV2){2, 4}, angle);
                JoxField *field = to_point(&walls, goal, 8.0f, cells[c], 0.2f);
                float told = jox_field_distance(field, p);
                float shortest = jox_length((JoxV2){2 - shift, 4}) + jox_length((JoxV2){shift, 4});
                int end = walk(field, &walls, p, goal, 30.0f, &length);
                if (end != ARRIVED || length > 1.1f * shortest || !(told < 1.1f * shortest) ||
                    !(told > 0.95f * shortest)) {
                    print_message("cell %g shift %g turn %g: end %d walked %g told %g of %g\n",
                                  (double)cells[c], (double)shift, angle, end, (double)length,
                                  (double)told, (double)shortest);
                    bad++;
                }
                jox_field_free(field);
                jox_walls_free(&walls);
            }
    assert_int_equal(bad, 0);
}

static void a_shut_gap_lets_no_way_through(void **state) {
    (void)state;
    const float widths[] = {0.0f, 0.1f, 0.3f};
    const float cells[] = {0.1f, 0.25f, 0.5f, 2.0f};
    int bad = 0;
    for (int w = 0; w < 3; w++)
        for (int c = 0; c < 4; c++)
            for (int t = 0; t < 3; t++) {
                double angle = 0.37 * t;
                JoxWalls walls = barrier(widths[w], 0.05f, angle);
                JoxV2 goal = turned((JoxV2){0, -4}, angle);
                JoxField *field = to_point(&walls, goal, 8.0f, cells[c], 0.2f);
                for (uint32_t k = 0; k < 300; k++) { /* the margin of the wall as well */
                    float y = 0.02f + (k % 2 ? 0.3f : 5.0f) * (float)draw(k, 4);
                    JoxV2 p = {-5.0f + 10.0f * (float)draw(k, 5), y};
                    if (fabsf(p.x) < 1.0f && y < 0.5f)
                        continue; /* squeezed into the gap one may come out on either side */
                    p = turned(p, angle);
                    if (!isinf(jox_field_distance(field, p)) ||
                        jox_length(jox_field_direction(field, p)) > 0.0f) {
                        print_message("gap %g cell %g turn %g: a way from %g %g\n",
                                      (double)widths[w], (double)cells[c], angle, (double)p.x,
                                      (double)p.y);
                        bad++;
                    }
                }
                assert_true(jox_field_distance(field, turned((JoxV2){3, -4}, angle)) < 4.0f);
                jox_field_free(field);
                jox_walls_free(&walls);
            }
    assert_int_equal(bad, 0);
}

static void doors_stay_open_on_a_coarse_grid(void **state) {
    (void)state;
    int bad = 0;
    for (int s = 0; s < 8; s++)
        for (int t = 0; t < 3; t++) {
            double angle = 0.4 * t;
            JoxWalls walls = barrier(1.0f, 0.1f * (float)s, angle);
            JoxV2 goal = turned((JoxV2){0, -6}, angle), p = turned((JoxV2){1, 6}, angle);
            JoxField *field = to_point(&walls, goal, 12.0f, 0.8f, 0.2f);
            float length;
            bad += walk(field, &walls, p, goal, 30.0f, &length) != ARRIVED || length > 15.0f;
            jox_field_free(field);
            jox_walls_free(&walls);
        }
    assert_int_equal(bad, 0);
}

/* ---- margins, solids, thin walls ---- */

/* A room with a solid block, a solid corner, a niche and a crooked thin wall. */
static JoxWalls room(double angle) {
    static const JoxV2 block[] = {{-2, -1}, {1, -1}, {1, 1.5f}, {-2, 1.5f}};
    static const JoxV2 hook[] = {{4, -5}, {6, -5}, {6, 2}, {5, 2}, {5, -4}, {4, -4}};
    static const JoxV2 thin[] = {{-5, 4}, {-1, 3.1f}, {2, 4.7f}, {4.4f, 3.3f}, {4.6f, 5.8f}};
    static const JoxV2 niche[] = {{-4, -6}, {-4, -3}, {-3.7f, -3}, {-3.7f, -6}};
    static const JoxV2 fence[] = {{-7, 7}, {-7, -7}, {7, -7}, {7, 7}, {-7, 7}};
    JoxWalls walls = {0};
    add_solid(&walls, block, 4, angle);
    add_solid(&walls, hook, 6, angle);
    add_line(&walls, thin, 5, angle);
    add_line(&walls, niche, 4, angle);
    add_line(&walls, fence, 5, angle);
    return walls;
}

static void nobody_stays_in_a_margin_or_crosses_a_wall(void **state) {
    (void)state;
    const float cells[] = {0.1f, 0.25f, 0.4f};
    int bad = 0;
    for (int t = 0; t < 3; t++)
        for (int c = 0; c < 3; c++) {
            double angle = 0.35 * t;
            JoxWalls walls = room(angle);
            JoxV2 goal = turned((JoxV2){6.5f, 6.3f}, angle);
            JoxField *field = to_point(&walls, goal, 11.0f, cells[c], 0.2f);
            for (uint32_t k = 0, tried = 0; tried < 150; k++) {
                JoxV2 p = {-7.0f + 14.0f * (float)draw(k, 6), -7.0f + 14.0f * (float)draw(k, 7)};
                p = turned(p, angle);
                float near = wall_distance(&walls, p), length;
                if (near > 0.2f || near < 0.002f || in_solid(&walls, p))
                    continue;
                tried++;
                int end = walk(field, &walls, p, goal, 80.0f, &length);
                if (end != ARRIVED)
                    print_message("  cell %g turn %g from %g %g, %g m from a wall: %d\n",
                                  (double)cells[c], angle, (double)p.x, (double)p.y, (double)near,
                                  end);
                bad += end != ARRIVED;
                if (!(jox_field_distance(field, p) < 60.0f))
                    bad++;
            }
            jox_field_free(field);
            jox_walls_free(&walls);
        }
    assert_int_equal(bad, 0);
}

/* At both sides of a long thin wall, however near, one is led along one's own side. */
static void a_thin_wall_is_never_crossed(void **state) {
    (void)state;
    int bad = 0;
    for (int t = 0; t < 12; t++) {
        double angle = TURN * t / 12 + 0.01;
        JoxWalls walls = {0};
        static const JoxV2 thin[] = {{-6, 0.07f}, {6, 0.07f}};
        add_line(&walls, thin, 2, angle);
        JoxV2 goal = turned((JoxV2){0, -2}, angle);
        JoxField *field = to_point(&walls, goal, 10.0f, 0.25f, 0.2f);
        for (uint32_t k = 0; k < 400; k++) {
            float off = 0.001f + 0.6f * (float)(draw(k, 8) * draw(k, 8));
            JoxV2 p = {-5.5f + 11.0f * (float)draw(k, 9), 0.07f + off};
            JoxV2 way = turned(jox_field_direction(field, turned(p, angle)), -angle);
            float round = jox_minf(jox_length(jox_sub(p, thin[0])) + jox_length((JoxV2){6, 2.07f}),
                                   jox_length(jox_sub(p, thin[1])) + jox_length((JoxV2){6, 2.07f}));
            float told = jox_field_distance(field, turned(p, angle));
            if (!(told > 0.97f * round && told < 1.08f * (round + ROUND_AN_END)) ||
                way.y < (off < 0.15f ? 0.0f : -0.35f)) { /* not into the wall */
                print_message("turn %g at %g, %g off: told %g of %g, way %g %g\n", angle,
                              (double)p.x, (double)off, (double)told, (double)round, (double)way.x,
                              (double)way.y);
                bad++;
            }
        }
        float length;
        for (uint32_t k = 0; k < 20; k++) {
            JoxV2 p = {-5.9f + 11.8f * (float)draw(k, 10), 0.071f + 0.01f * (float)(k % 5)};
            bad += walk(field, &walls, turned(p, angle), goal, 40.0f, &length) != ARRIVED;
        }
        jox_field_free(field);
        jox_walls_free(&walls);
    }
    assert_int_equal(bad, 0);
}

static void a_solid_is_left_by_its_nearest_side(void **state) {
    (void)state;
    JoxWalls walls = {0};
    static const JoxV2 block[] = {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}};
    add_solid(&walls, block, 4, 0.0);
    JoxField *field = to_point(&walls, (JoxV2){9, 0}, 12.0f, 0.25f, 0.2f);
    assert_true(isinf(jox_field_distance(field, (JoxV2){0.1f, 0.3f})));
    assert_true(isinf(jox_field_distance(field, (JoxV2){-3.9f, 0.3f})));
    assert_true(jox_field_direction(field, (JoxV2){-3.9f, 0.3f}).x < -0.9f);
    assert_true(jox_field_direction(field, (JoxV2){3.9f, 0.3f}).x > 0.9f);
    assert_true(jox_field_direction(field, (JoxV2){0.3f, 3.95f}).y > 0.9f);
    for (uint32_t k = 0; k < 100; k++) { /* from the depth one comes out as well */
        JoxV2 p = {-3.9f + 7.8f * (float)draw(k, 11), -3.9f + 7.8f * (float)draw(k, 12)};
        int steps = 0;
        while (in_solid(&walls, p) && steps++ < 400)
            p = jox_add(p, jox_scale(jox_field_direction(field, p), 0.02f));
        assert_true(steps < 400);
    }
    /* From the far side the way leads round it. */
    float round = jox_length((JoxV2){4, 4}) + 8.0f + jox_length((JoxV2){5, 4});
    float told = jox_field_distance(field, (JoxV2){-8, 0});
    assert_true(told > 0.97f * round && told < 1.1f * round);
    jox_field_free(field);
    jox_walls_free(&walls);
}

/* ---- goals ---- */

static float length_to(const JoxWalls *walls, const JoxPlace *places, uint32_t place, JoxV2 p) {
    JoxField *field =
        jox_field_create(walls, places, place, (JoxV2){-12, -12}, (JoxV2){12, 12}, 0.25f, 0.2f);
    float length = jox_field_distance(field, p);
    jox_field_free(field);
    return length;
}

static void places_of_every_kind_are_goals(void **state) {
    (void)state;
    static JoxV2 square[] = {{-8, -2}, {-5, -2}, {-5, 2}, {-8, 2}}, line[] = {{-2, 8}, {2, 8}};
    static JoxV2 row[] = {{8, 0}, {8, -3}}, point[] = {{0, -8}};
    int32_t members[] = {0, 1, 2, 3};
    JoxPlace places[] = {
        {.kind = JOX_PLACE_POLYGON, .points = square, .count = 4, .start = -1},
        {.kind = JOX_PLACE_LINE, .points = line, .count = 2},
        {.kind = JOX_PLACE_QUEUE, .points = row, .count = 2, .spacing = 0.5f},
        {.kind = JOX_PLACE_POINT, .points = point, .count = 1, .radius = 0.5f},
        {.kind = JOX_PLACE_SET, .members = members, .member_count = 4},
    };
    JoxWalls walls = {0};
    for (int i = 0; i < 5; i++)
        jox_place_finish(&places[i]);
    const JoxV2 from[] = {{0.4f, 0.3f}, {-9, 9}, {9, -9}, {3, 6.5f}, {-6, 3}};
    for (int k = 0; k < 5; k++)
        for (uint32_t i = 0; i < 5; i++) {
            float true_length = jox_place_distance(places, i, from[k]);
            assert_true(fabsf(length_to(&walls, places, i, from[k]) - true_length) <
                        0.03f * true_length + 0.02f);
        }
    /* Inside a polygon one has arrived. */
    JoxField *field =
        jox_field_create(&walls, places, 0, (JoxV2){-12, -12}, (JoxV2){12, 12}, 0.25f, 0.2f);
    assert_true(jox_field_distance(field, (JoxV2){-6.5f, 0}) == 0.0f);
    assert_true(jox_length(jox_field_direction(field, (JoxV2){-6.5f, 0})) == 0.0f);
    jox_field_free(field);
}

/* A counter, a house and a pillar stand where the goals are; one member of a set is walled in. */
static void goals_in_and_at_walls_are_reached(void **state) {
    (void)state;
    static JoxV2 house[] = {{-8, -2}, {-5, -2}, {-5, 2}, {-8, 2}}, head[] = {{6.93f, 0}, {4, 0}};
    static const JoxV2 counter[] = {{7, -3}, {7, 3}};
    static JoxV2 cell[] = {{-1, 8}, {1, 8}, {1, 10}, {-1, 10}}, middle[] = {{0, 9}};
    int32_t members[] = {2, 1};
    JoxPlace places[] = {
        {.kind = JOX_PLACE_POLYGON, .points = house, .count = 4, .start = -1},
        {.kind = JOX_PLACE_QUEUE, .points = head, .count = 2, .spacing = 0.5f},
        {.kind = JOX_PLACE_POINT, .points = middle, .count = 1, .radius = 0.5f},
        {.kind = JOX_PLACE_SET, .members = members, .member_count = 2},
    };
    JoxWalls walls = {0};
    jox_walls_add_solid(&walls, house, 4, INFINITY);
    jox_walls_add_polyline(&walls, counter, 2, false, INFINITY);
    jox_walls_add_polyline(&walls, cell, 4, true, INFINITY);
    for (int i = 0; i < 4; i++)
        jox_place_finish(&places[i]);
    assert_true(fabsf(length_to(&walls, places, 0, (JoxV2){0, 0}) - 5.0f) < 0.3f);
    assert_true(fabsf(length_to(&walls, places, 1, (JoxV2){0, 0}) - 6.93f) < 0.3f);
    /* Behind the counter the way to its front leads round it. */
    assert_true(length_to(&walls, places, 1, (JoxV2){7.3f, 0}) > 5.5f);
    assert_true(isinf(length_to(&walls, places, 2, (JoxV2){0, 0})));
    assert_true(fabsf(length_to(&walls, places, 3, (JoxV2){0, 6}) - jox_length((JoxV2){6.93f, 6})) <
                0.5f);
    /* Every member counts, a free one and one close to a wall. */
    int32_t both[] = {1, 4};
    static JoxV2 far[] = {{-10, -10}};
    JoxPlace more[] = {places[0],
                       places[1],
                       places[2],
                       {.kind = JOX_PLACE_SET, .members = both, .member_count = 2},
                       {.kind = JOX_PLACE_POINT, .points = far, .count = 1, .radius = 0.5f}};
    jox_place_finish(&more[3]);
    jox_place_finish(&more[4]);
    assert_true(fabsf(length_to(&walls, more, 3, (JoxV2){4, 0}) - 2.93f) < 0.3f);
    assert_true(fabsf(length_to(&walls, more, 3, (JoxV2){-8, -10}) - 2.0f) < 0.2f);
    jox_walls_free(&walls);
}

static void the_same_plan_gives_the_same_bits(void **state) {
    (void)state;
    JoxWalls walls = room(0.2);
    JoxField *a = to_point(&walls, (JoxV2){6, 6}, 11.0f, 0.25f, 0.2f);
    JoxField *b = to_point(&walls, (JoxV2){6, 6}, 11.0f, 0.25f, 0.2f);
    for (uint32_t k = 0; k < 2000; k++) {
        JoxV2 p = {-11.0f + 22.0f * (float)draw(k, 13), -11.0f + 22.0f * (float)draw(k, 14)};
        JoxV2 va = jox_field_direction(a, p), vb = jox_field_direction(b, p);
        assert_memory_equal(&va, &vb, sizeof va);
        /* Everywhere a unit vector or none at all. */
        float l = jox_length(va);
        assert_true(l == 0.0f || fabsf(l - 1.0f) < 1e-5f);
    }
    jox_field_free(a);
    jox_field_free(b);
    jox_walls_free(&walls);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(in_the_open_it_is_euclid),
        cmocka_unit_test(outside_the_box_one_walks_to_it),
        cmocka_unit_test(boxes_that_are_none_are_borne),
        cmocka_unit_test(a_trap_is_left_by_the_shortest_way),
        cmocka_unit_test(a_turned_plan_has_the_same_lengths),
        cmocka_unit_test(a_gap_of_a_persons_width_is_passed),
        cmocka_unit_test(a_shut_gap_lets_no_way_through),
        cmocka_unit_test(doors_stay_open_on_a_coarse_grid),
        cmocka_unit_test(nobody_stays_in_a_margin_or_crosses_a_wall),
        cmocka_unit_test(a_thin_wall_is_never_crossed),
        cmocka_unit_test(a_solid_is_left_by_its_nearest_side),
        cmocka_unit_test(places_of_every_kind_are_goals),
        cmocka_unit_test(goals_in_and_at_walls_are_reached),
        cmocka_unit_test(the_same_plan_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
