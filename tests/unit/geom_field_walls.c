/* Tests distance fields at walls: margins, solids, thin walls, goals at walls. */
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

/* ---- margins, solids, thin walls ---- */

/* Makes a room with a solid block, a solid corner, a niche and a crooked thin wall. */
static JoxWalls make_walled_room(double angle) {
    static const JoxV2 block[] = {{-2, -1}, {1, -1}, {1, 1.5f}, {-2, 1.5f}};
    static const JoxV2 hook[] = {{4, -5}, {6, -5}, {6, 2}, {5, 2}, {5, -4}, {4, -4}};
    static const JoxV2 thin[] = {{-5, 4}, {-1, 3.1f}, {2, 4.7f}, {4.4f, 3.3f}, {4.6f, 5.8f}};
    static const JoxV2 niche[] = {{-4, -6}, {-4, -3}, {-3.7f, -3}, {-3.7f, -6}};
    static const JoxV2 fence[] = {{-7, 7}, {-7, -7}, {7, -7}, {7, 7}, {-7, 7}};
    JoxWalls walls = {0};
    add_turned_solid(&walls, block, 4, angle);
    add_turned_solid(&walls, hook, 6, angle);
    add_turned_line(&walls, thin, 5, angle);
    add_turned_line(&walls, niche, 4, angle);
    add_turned_line(&walls, fence, 5, angle);
    return walls;
}

static void walks_leave_margins_and_cross_no_wall(void **state) {
    (void)state;
    const float cells[] = {0.1f, 0.25f, 0.4f};
    int bad = 0;
    for (int t = 0; t < 3; t++)
        for (int c = 0; c < 3; c++) {
            double angle = 0.35 * t;
            JoxWalls walls = make_walled_room(angle);
            JoxV2 goal = turn_point((JoxV2){6.5f, 6.3f}, angle);
            JoxField *field = make_field_to_point(&walls, goal, 11.0f, cells[c], 0.2f);
            for (uint32_t k = 0, tried = 0; tried < 150; k++) {
                JoxV2 p = {-7.0f + 14.0f * (float)draw_walk_number(k, 6),
                           -7.0f + 14.0f * (float)draw_walk_number(k, 7)};
                p = turn_point(p, angle);
                float near = find_wall_distance(&walls, p), length;
                if (near > 0.2f || near < 0.002f || is_point_in_solid(&walls, p))
                    continue;
                tried++;
                int end = walk_by_field(field, &walls, p, goal, 80.0f, &length);
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

/* On both sides of a long thin wall, however near, ways lead along the same side. */
static void a_thin_wall_is_never_crossed(void **state) {
    (void)state;
    int bad = 0;
    for (int t = 0; t < 12; t++) {
        double angle = TURN * t / 12 + 0.01;
        JoxWalls walls = {0};
        static const JoxV2 thin[] = {{-6, 0.07f}, {6, 0.07f}};
        add_turned_line(&walls, thin, 2, angle);
        JoxV2 goal = turn_point((JoxV2){0, -2}, angle);
        JoxField *field = make_field_to_point(&walls, goal, 10.0f, 0.25f, 0.2f);
        for (uint32_t k = 0; k < 400; k++) {
            float off = 0.001f + 0.6f * (float)(draw_walk_number(k, 8) * draw_walk_number(k, 8));
            JoxV2 p = {-5.5f + 11.0f * (float)draw_walk_number(k, 9), 0.07f + off};
            JoxV2 way = turn_point(jox_field_direction(field, turn_point(p, angle)), -angle);
            float round = jox_minf(jox_length(jox_sub(p, thin[0])) + jox_length((JoxV2){6, 2.07f}),
                                   jox_length(jox_sub(p, thin[1])) + jox_length((JoxV2){6, 2.07f}));
            float told = jox_field_distance(field, turn_point(p, angle));
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
            JoxV2 p = {-5.9f + 11.8f * (float)draw_walk_number(k, 10),
                       0.071f + 0.01f * (float)(k % 5)};
            bad +=
                walk_by_field(field, &walls, turn_point(p, angle), goal, 40.0f, &length) != ARRIVED;
        }
        jox_field_free(field);
        jox_walls_free(&walls);
    }
    assert_int_equal(bad, 0);
}

static void ways_out_of_a_solid_lead_to_its_nearest_side(void **state) {
    (void)state;
    JoxWalls walls = {0};
    static const JoxV2 block[] = {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}};
    add_turned_solid(&walls, block, 4, 0.0);
    JoxField *field = make_field_to_point(&walls, (JoxV2){9, 0}, 12.0f, 0.25f, 0.2f);
    assert_true(isinf(jox_field_distance(field, (JoxV2){0.1f, 0.3f})));
    assert_true(isinf(jox_field_distance(field, (JoxV2){-3.9f, 0.3f})));
    assert_true(jox_field_direction(field, (JoxV2){-3.9f, 0.3f}).x < -0.9f);
    assert_true(jox_field_direction(field, (JoxV2){3.9f, 0.3f}).x > 0.9f);
    assert_true(jox_field_direction(field, (JoxV2){0.3f, 3.95f}).y > 0.9f);
    for (uint32_t k = 0; k < 100; k++) { /* ways lead out from deep inside, too */
        JoxV2 p = {-3.9f + 7.8f * (float)draw_walk_number(k, 11),
                   -3.9f + 7.8f * (float)draw_walk_number(k, 12)};
        int steps = 0;
        while (is_point_in_solid(&walls, p) && steps++ < 400)
            p = jox_add(p, jox_scale(jox_field_direction(field, p), 0.02f));
        assert_true(steps < 400);
    }
    /* From the far side the way leads round the block. */
    float round = jox_length((JoxV2){4, 4}) + 8.0f + jox_length((JoxV2){5, 4});
    float told = jox_field_distance(field, (JoxV2){-8, 0});
    assert_true(told > 0.97f * round && told < 1.1f * round);
    jox_field_free(field);
    jox_walls_free(&walls);
}

/* ---- goals ---- */

static float find_length_to(const JoxWalls *walls, const JoxPlace *places, uint32_t place,
                            JoxV2 p) {
    JoxField *field = jox_field_create(walls, places, place, (JoxV2){-12, -12}, (JoxV2){12, 12},
                                       0.25f, 0.2f, NULL, NULL, NULL, NULL);
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
            assert_true(fabsf(find_length_to(&walls, places, i, from[k]) - true_length) <
                        0.03f * true_length + 0.02f);
        }
    /* Points inside a polygon are at the goal. */
    JoxField *field = jox_field_create(&walls, places, 0, (JoxV2){-12, -12}, (JoxV2){12, 12}, 0.25f,
                                       0.2f, NULL, NULL, NULL, NULL);
    assert_true(jox_field_distance(field, (JoxV2){-6.5f, 0}) == 0.0f);
    assert_true(jox_length(jox_field_direction(field, (JoxV2){-6.5f, 0})) == 0.0f);
    jox_field_free(field);
}

/* A counter, a house and a pillar stand at the goals; one member of a set is walled in. */
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
    assert_true(fabsf(find_length_to(&walls, places, 0, (JoxV2){0, 0}) - 5.0f) < 0.3f);
    assert_true(fabsf(find_length_to(&walls, places, 1, (JoxV2){0, 0}) - 6.93f) < 0.3f);
    /* From behind the counter the way leads round to its front. */
    assert_true(find_length_to(&walls, places, 1, (JoxV2){7.3f, 0}) > 5.5f);
    assert_true(isinf(find_length_to(&walls, places, 2, (JoxV2){0, 0})));
    assert_true(fabsf(find_length_to(&walls, places, 3, (JoxV2){0, 6}) -
                      jox_length((JoxV2){6.93f, 6})) < 0.5f);
    /* Every member counts, a free one as well as one close to a wall. */
    int32_t both[] = {1, 4};
    static JoxV2 far[] = {{-10, -10}};
    JoxPlace more[] = {places[0],
                       places[1],
                       places[2],
                       {.kind = JOX_PLACE_SET, .members = both, .member_count = 2},
                       {.kind = JOX_PLACE_POINT, .points = far, .count = 1, .radius = 0.5f}};
    jox_place_finish(&more[3]);
    jox_place_finish(&more[4]);
    assert_true(fabsf(find_length_to(&walls, more, 3, (JoxV2){4, 0}) - 2.93f) < 0.3f);
    assert_true(fabsf(find_length_to(&walls, more, 3, (JoxV2){-8, -10}) - 2.0f) < 0.2f);
    jox_walls_free(&walls);
}

static void the_same_plan_gives_the_same_bits(void **state) {
    (void)state;
    JoxWalls walls = make_walled_room(0.2);
    JoxField *a = make_field_to_point(&walls, (JoxV2){6, 6}, 11.0f, 0.25f, 0.2f);
    JoxField *b = make_field_to_point(&walls, (JoxV2){6, 6}, 11.0f, 0.25f, 0.2f);
    for (uint32_t k = 0; k < 2000; k++) {
        JoxV2 p = {-11.0f + 22.0f * (float)draw_walk_number(k, 13),
                   -11.0f + 22.0f * (float)draw_walk_number(k, 14)};
        JoxV2 va = jox_field_direction(a, p), vb = jox_field_direction(b, p);
        assert_memory_equal(&va, &vb, sizeof va);
        /* Every direction is a unit vector or zero. */
        float l = jox_length(va);
        assert_true(l == 0.0f || fabsf(l - 1.0f) < 1e-5f);
    }
    jox_field_free(a);
    jox_field_free(b);
    jox_walls_free(&walls);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walks_leave_margins_and_cross_no_wall),
        cmocka_unit_test(a_thin_wall_is_never_crossed),
        cmocka_unit_test(ways_out_of_a_solid_lead_to_its_nearest_side),
        cmocka_unit_test(places_of_every_kind_are_goals),
        cmocka_unit_test(goals_in_and_at_walls_are_reached),
        cmocka_unit_test(the_same_plan_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
