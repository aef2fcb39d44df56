/* Tests distance fields: lengths and directions on open floor, out of traps, through gaps, out of
   margins at walls. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "geom/place_kinds.h"
#include "geom_walk.h"

/* ---- open floor ---- */

static void lengths_on_open_floor_are_euclidean(void **state) {
    (void)state;
    const float cells[] = {0.1f, 0.25f, 0.5f};
    for (int c = 0; c < 3; c++) {
        JoxWalls walls = {0};
        JoxV2 goal = {0.37f, -0.21f};
        JoxField *field = make_field_to_point(&walls, goal, 16.0f, cells[c], 0.2f);
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

static void ways_from_outside_lead_to_the_box(void **state) {
    (void)state;
    JoxWalls walls = {0};
    JoxField *field = make_field_to_point(&walls, (JoxV2){0, 0}, 5.0f, 0.25f, 0.2f);
    float there = jox_field_distance(field, (JoxV2){5, 3});
    assert_true(fabsf(jox_field_distance(field, (JoxV2){9, 3}) - (there + 4.0f)) < 0.01f);
    assert_true(fabsf(there - sqrtf(34.0f)) < 0.03f * there);
    JoxV2 way = jox_field_direction(field, (JoxV2){9, 3});
    assert_true(way.x < -0.7f && fabsf(jox_length(way) - 1.0f) < 1e-5f);
    way = jox_field_direction(field, (JoxV2){-40, -40});
    assert_true(way.x > 0.6f && way.y > 0.6f);
    JoxV2 nowhere = {NAN, INFINITY}; /* any answer will do */
    assert_false(isinf(jox_field_direction(field, nowhere).x));
    jox_field_distance(field, nowhere);
    jox_field_free(field);
    jox_field_free(NULL);
}

static void invalid_boxes_give_a_field(void **state) {
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
        JoxField *field = jox_field_create(&walls, &place, 0, boxes[k][0], boxes[k][1], 0.1f, 0.2f,
                                           NULL, NULL, NULL, NULL);
        float distance = jox_field_distance(field, (JoxV2){4, 3});
        assert_true(distance >= 0.0f);
        jox_field_free(field);
    }
}

/* ---- traps ---- */

/* A U with arms 8 m long, 6 m apart, open to the left; the goal is behind its bottom. */
static const JoxV2 U[] = {{-4, 3}, {4, 3}, {4, -3}, {-4, -3}};
static const JoxV2 BEHIND = {6, 0};

/* Returns the length of the shortest way from inside the U: by an end of an arm and a corner of its
   bottom. */
static float find_way_round_u(JoxV2 p) {
    float best = INFINITY;
    for (int side = 0; side < 2; side++) {
        JoxV2 end = U[side ? 3 : 0], corner = U[side ? 2 : 1];
        best = jox_minf(best, jox_length(jox_sub(p, end)) + jox_length(jox_sub(end, corner)) +
                                  jox_length(jox_sub(corner, BEHIND)));
    }
    return best;
}

static void expect_way_out_of_trap(double angle) {
    JoxWalls walls = {0};
    add_turned_line(&walls, U, 4, angle);
    JoxV2 goal = turn_point(BEHIND, angle);
    JoxField *field = make_field_to_point(&walls, goal, 12.0f, 0.25f, 0.2f);
    float most = 0.0f;
    int bad = 0;
    for (uint32_t k = 0; k < 200; k++) {
        JoxV2 p = {-4.0f + 8.0f * (float)draw_walk_number(k, 0),
                   -3.0f + 6.0f * (float)draw_walk_number(k, 1)};
        float length, shortest = find_way_round_u(p);
        bad += walk_by_field(field, &walls, turn_point(p, angle), goal, 60.0f, &length) != ARRIVED;
        most = jox_maxf(most, length / shortest);
        float told = jox_field_distance(field, turn_point(p, angle));
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

static void ways_out_of_a_trap_are_shortest(void **state) {
    (void)state;
    expect_way_out_of_trap(0.0);
    expect_way_out_of_trap(TURN / 8);
    expect_way_out_of_trap(0.3);
}

static void a_turned_plan_has_the_same_lengths(void **state) {
    (void)state;
    JoxWalls walls = {0}, other = {0};
    add_turned_line(&walls, U, 4, 0.0);
    add_turned_line(&other, U, 4, TURN / 8);
    JoxField *a = make_field_to_point(&walls, BEHIND, 12.0f, 0.25f, 0.2f);
    JoxField *b = make_field_to_point(&other, turn_point(BEHIND, TURN / 8), 12.0f, 0.25f, 0.2f);
    float worst = 0.0f;
    for (uint32_t k = 0; k < 500; k++) {
        JoxV2 p = {-7.0f + 14.0f * (float)draw_walk_number(k, 2),
                   -7.0f + 14.0f * (float)draw_walk_number(k, 3)};
        float there = jox_field_distance(a, p);
        float here = jox_field_distance(b, turn_point(p, TURN / 8));
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

/* Makes a wall across the box with a gap of `width`, its middle `shift` along the wall. */
static JoxWalls make_barrier(float width, float shift, double angle) {
    JoxWalls walls = {0};
    JoxV2 left[] = {{-30, 0.013f}, {shift - width / 2, 0.013f}};
    JoxV2 right[] = {{shift + width / 2, 0.013f}, {30, 0.013f}};
    add_turned_line(&walls, left, 2, angle);
    add_turned_line(&walls, right, 2, angle);
    return walls;
}

static void ways_lead_through_a_gap_of_a_persons_width(void **state) {
    (void)state;
    const float cells[] = {0.1f, 0.125f, 0.25f, 0.5f};
    int bad = 0;
    for (int c = 0; c < 4; c++)
        for (int s = 0; s < 5; s++)
            for (int t = 0; t < 4; t++) {
                double angle = t == 3 ? 0.2 : TURN / 16 * t;
                float shift = 0.061f * (float)s, length;
                /* Cells of half a metre need more: 2 clearances and 0.6 cells. */
                JoxWalls walls = make_barrier(cells[c] < 0.4f ? 0.6f : 0.7f, shift, angle);
                JoxV2 goal = turn_point((JoxV2){0, -4}, angle),
                      p = turn_point((JoxV2){2, 4}, angle);
                JoxField *field = make_field_to_point(&walls, goal, 8.0f, cells[c], 0.2f);
                float told = jox_field_distance(field, p);
                float shortest = jox_length((JoxV2){2 - shift, 4}) + jox_length((JoxV2){shift, 4});
                int end = walk_by_field(field, &walls, p, goal, 30.0f, &length);
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

static void no_way_leads_through_a_closed_gap(void **state) {
    (void)state;
    const float widths[] = {0.0f, 0.1f, 0.3f};
    const float cells[] = {0.1f, 0.25f, 0.5f, 2.0f};
    int bad = 0;
    for (int w = 0; w < 3; w++)
        for (int c = 0; c < 4; c++)
            for (int t = 0; t < 3; t++) {
                double angle = 0.37 * t;
                JoxWalls walls = make_barrier(widths[w], 0.05f, angle);
                JoxV2 goal = turn_point((JoxV2){0, -4}, angle);
                JoxField *field = make_field_to_point(&walls, goal, 8.0f, cells[c], 0.2f);
                for (uint32_t k = 0; k < 300; k++) { /* also the margin at the wall */
                    float y = 0.02f + (k % 2 ? 0.3f : 5.0f) * (float)draw_walk_number(k, 4);
                    JoxV2 p = {-5.0f + 10.0f * (float)draw_walk_number(k, 5), y};
                    if (fabsf(p.x) < 1.0f && y < 0.5f)
                        continue; /* inside the gap, either side is right */
                    p = turn_point(p, angle);
                    if (!isinf(jox_field_distance(field, p)) ||
                        jox_length(jox_field_direction(field, p)) > 0.0f) {
                        print_message("gap %g cell %g turn %g: a way from %g %g\n",
                                      (double)widths[w], (double)cells[c], angle, (double)p.x,
                                      (double)p.y);
                        bad++;
                    }
                }
                assert_true(jox_field_distance(field, turn_point((JoxV2){3, -4}, angle)) < 4.0f);
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
            JoxWalls walls = make_barrier(1.0f, 0.1f * (float)s, angle);
            JoxV2 goal = turn_point((JoxV2){0, -6}, angle), p = turn_point((JoxV2){1, 6}, angle);
            JoxField *field = make_field_to_point(&walls, goal, 12.0f, 0.8f, 0.2f);
            float length;
            bad +=
                walk_by_field(field, &walls, p, goal, 30.0f, &length) != ARRIVED || length > 15.0f;
            jox_field_free(field);
            jox_walls_free(&walls);
        }
    assert_int_equal(bad, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lengths_on_open_floor_are_euclidean),
        cmocka_unit_test(ways_from_outside_lead_to_the_box),
        cmocka_unit_test(invalid_boxes_give_a_field),
        cmocka_unit_test(ways_out_of_a_trap_are_shortest),
        cmocka_unit_test(a_turned_plan_has_the_same_lengths),
        cmocka_unit_test(ways_lead_through_a_gap_of_a_persons_width),
        cmocka_unit_test(no_way_leads_through_a_closed_gap),
        cmocka_unit_test(doors_stay_open_on_a_coarse_grid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
