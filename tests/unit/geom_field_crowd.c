/* Tests ways round a crowd that is held up, and goals along walls. */
#include "geom/field/field_parts.h"
#include "geom/place_kinds.h"
#include "unit/geom_walk.h"

enum { HELD = 60 };

/* Makes a square of 20 m, cut by a wall at y = 0 with doors 1 m wide around x = -1.5 and x = 5. */
static JoxWalls make_two_doors(double angle) {
    static const JoxV2 parts[][2] = {
        {{-10, 0}, {-2, 0}}, {{-1, 0}, {4.5f, 0}}, {{5.5f, 0}, {10, 0}}};
    JoxWalls walls = {0};
    for (int k = 0; k < 3; k++)
        add_turned_line(&walls, parts[k], 2, angle);
    return walls;
}

/* Places people around a point, in rows of ten, 0.4 m apart. */
static JoxFieldCrowd place_crowd(JoxV2 middle, double angle, float held, JoxV2 at[HELD],
                                 float share[HELD]) {
    for (int k = 0; k < HELD; k++) {
        at[k] = turn_point((JoxV2){middle.x + 0.4f * ((float)(k % 10) - 4.5f),
                                   middle.y + 0.4f * ((float)(k / 10) - 2.5f)},
                           angle);
        share[k] = held;
    }
    return (JoxFieldCrowd){.at = at, .held = share, .count = HELD, .slowing = 0.5f};
}

/* Returns x of the door that the way from `from` leads through, before the plan is turned. */
static float find_door_taken(const JoxFieldCrowd *crowd, double angle, JoxV2 from) {
    JoxWalls walls = make_two_doors(angle);
    JoxV2 goal = turn_point((JoxV2){0, 6}, angle), p = turn_point(from, angle);
    JoxPlace place = {.kind = JOX_PLACE_POINT, .points = &goal, .count = 1, .radius = 0.1f};
    jox_place_finish(&place);
    JoxField *field = jox_field_create(&walls, &place, 0, (JoxV2){-15, -15}, (JoxV2){15, 15}, 0.2f,
                                       0.15f, crowd, NULL, NULL, NULL);
    float x = NAN;
    for (int k = 0; k < 4000 && isnan(x); k++) {
        JoxV2 q = jox_add(p, jox_scale(jox_field_direction(field, p), 0.02f));
        JoxV2 before = turn_point(p, -angle), after = turn_point(q, -angle);
        if (before.y < 0.0f && after.y >= 0.0f)
            x = after.x;
        p = q;
    }
    jox_field_free(field);
    jox_walls_free(&walls);
    return x;
}

static void a_crowd_diverts_ways_to_the_other_door(void **state) {
    (void)state;
    const JoxV2 from = {1.0f, -5.0f}, front = {-1.5f, -1.5f};
    JoxV2 at[HELD];
    float share[HELD];
    for (int k = 0; k < 3; k++) {
        double angle = TURN * 37.0 / 360.0 * k;
        JoxFieldCrowd stands = place_crowd(front, angle, 1.0f, at, share);
        assert_true(find_door_taken(NULL, angle, from) < 0.0f);
        assert_true(find_door_taken(&stands, angle, from) > 4.0f);
        JoxFieldCrowd walks = place_crowd(front, angle, 0.0f, at, share); /* nobody is held up */
        assert_true(find_door_taken(&walks, angle, from) < 0.0f);
        JoxFieldCrowd elsewhere = place_crowd((JoxV2){5.0f, -1.5f}, angle, 1.0f, at, share);
        assert_true(find_door_taken(&elsewhere, angle, from) < 0.0f);
        JoxFieldCrowd nobody = {.slowing = 0.5f};
        assert_true(find_door_taken(&nobody, angle, from) < 0.0f);
    }
    /* People in the crowd still use the nearer door, as the other one is far away. */
    JoxFieldCrowd stands = place_crowd(front, 0.0, 1.0f, at, share);
    assert_true(find_door_taken(&stands, 0.0, (JoxV2){-1.5f, -0.5f}) < 0.0f);
}

/* Returns the integral over the floor of the slowness that a person at `at` adds. */
static double integrate_slowness(const JoxWalls *walls, JoxV2 at, float held) {
    enum { COUNT = 3600 };
    static JoxFieldCell cells[COUNT];
    JoxField f = {.low = {-6, -6},
                  .size = 0.2f,
                  .clearance = 0.15f,
                  .columns = 60,
                  .rows = 60,
                  .cells = cells};
    static float slowness[COUNT], before[COUNT];
    JoxFieldWork w = {.f = &f, .count = COUNT, .slowness = slowness};
    JoxFieldMarks *marks = NULL;
    jox_field_mark(&w, walls, &marks);
    memcpy(before, slowness, sizeof before);
    JoxFieldCrowd crowd = {.at = &at, .held = &held, .count = 1, .slowing = 0.7f};
    jox_field_crowd(&w, &crowd);
    double sum = 0.0;
    for (int i = 0; i < COUNT; i++) {
        assert_true(slowness[i] >= before[i]);
        if (w.walled.node[i] == JOX_FIELD_BLOCKED)
            assert_true(slowness[i] == before[i]);
        sum += (double)(slowness[i] - before[i]) * 0.04;
    }
    jox_free(f.edges);
    jox_free(f.refs);
    jox_free(f.patches);
    jox_field_marks_free(marks);
    return sum;
}

/* A person adds the same slowness in all on open floor, along a wall, in a corner and in a
   passage. */
static void slowness_of_a_person_is_kept_at_walls(void **state) {
    (void)state;
    static const JoxV2 corner[] = {{-4, 3}, {3, 3}, {3, -4}}, other[] = {{3.8f, 3}, {3.8f, -4}};
    static const JoxV2 block[] = {{-5, -5}, {-3, -5}, {-3, -3}, {-5, -3}};
    JoxWalls walls = {0};
    add_turned_line(&walls, corner, 3, 0.0);
    add_turned_line(&walls, other, 2, 0.0);
    add_turned_solid(&walls, block, 4, 0.0);
    const JoxV2 at[] = {{-1, -1},   {0, 2.75f},  {2.7f, 2.7f},
                        {3.4f, -1}, {-2.8f, -4}, {-2.8f, -2.8f}};
    for (int k = 0; k < 6; k++) {
        assert_true(fabs(integrate_slowness(&walls, at[k], 1.0f) - 0.7) < 0.002);
        assert_true(fabs(integrate_slowness(&walls, at[k], 0.25f) - 0.175) < 0.001);
        assert_true(integrate_slowness(&walls, at[k], 0.0f) == 0.0);
    }
    jox_walls_free(&walls);
}

/* The goal is a polygon with a side on a wall: from behind, the way leads round the wall. */
static void a_goal_along_a_wall_is_not_reached_through_it(void **state) {
    (void)state;
    static const JoxV2 line[] = {{-5, 0}, {5, 0}};
    for (int k = 0; k < 4; k++)
        for (int thick = 0; thick < 2; thick++) {
            double angle = TURN * 29.0 / 360.0 * k;
            JoxV2 corners[] = {{-2, 0}, {2, 0}, {2, 1.5f}, {-2, 1.5f}};
            static const JoxV2 slab[] = {{-5, -0.05f}, {5, -0.05f}, {5, 0}, {-5, 0}};
            JoxWalls walls = {0};
            if (thick)
                add_turned_solid(&walls, slab, 4, angle);
            else
                add_turned_line(&walls, line, 2, angle);
            for (int n = 0; n < 4; n++)
                corners[n] = turn_point(corners[n], angle);
            JoxPlace place = {
                .kind = JOX_PLACE_POLYGON, .points = corners, .count = 4, .start = -1};
            jox_place_finish(&place);
            JoxField *field = jox_field_create(&walls, &place, 0, (JoxV2){-9, -9}, (JoxV2){9, 9},
                                               0.2f, 0.15f, NULL, NULL, NULL, NULL);
            for (int n = -4; n <= 4; n++) {
                JoxV2 behind = turn_point((JoxV2){0.4f * (float)n, -0.5f}, angle);
                JoxV2 before = turn_point((JoxV2){0.4f * (float)n, 3.0f}, angle);
                float round = 5.0f - 0.4f * fabsf((float)n) + 3.0f; /* to an end and back */
                assert_true(jox_field_distance(field, behind) > round - 0.6f);
                assert_true(fabsf(jox_field_distance(field, before) - 1.5f) < 0.15f);
            }
            jox_field_free(field);
            jox_walls_free(&walls);
        }
}

static void expect_same_fields(const JoxField *a, const JoxField *b) {
    assert_int_equal(a->patch_count, b->patch_count);
    assert_memory_equal(a->patches, b->patches, a->patch_count * sizeof *a->patches);
    for (int k = 0; k < 4000; k++) {
        const JoxV2 p = {-9.5f + 0.3f * (float)(k % 64), -9.5f + 0.3f * (float)(k / 64)};
        const JoxV2 ways[2] = {jox_field_direction(a, p), jox_field_direction(b, p)};
        const float lengths[2] = {jox_field_distance(a, p), jox_field_distance(b, p)};
        assert_memory_equal(&ways[0], &ways[1], sizeof ways[0]);
        assert_memory_equal(&lengths[0], &lengths[1], sizeof lengths[0]);
    }
}

/* Fields made with cached marks, also marks of other walls or another box, equal fields made
   without, wherever the crowd is. */
static void cached_marks_change_no_field(void **state) {
    (void)state;
    static const JoxV2 nook[] = {{-7, -7.1f}, {-5.2f, -7}, {-5.1f, -5}, {-6.9f, -5.2f}};
    static const JoxV2 block[] = {{2.1f, 1.9f}, {4.3f, 2.2f}, {3.2f, 4.1f}};
    JoxV2 goal = {0, 6}, at[HELD];
    float share[HELD];
    JoxPlace place = {.kind = JOX_PLACE_POINT, .points = &goal, .count = 1, .radius = 0.1f};
    JoxFieldMarks *marks = NULL;
    jox_place_finish(&place);
    for (int k = 0; k < 8; k++) {
        const double angle = k < 4 ? 0.0 : 0.3;
        const float wide = k % 4 == 3 ? 11.0f : 9.0f;
        const JoxV2 middle = {-1.5f + 1.3f * (float)(k % 3), -1.5f};
        JoxFieldCrowd crowd = place_crowd(middle, angle, 0.125f * (float)k, at, share);
        JoxWalls walls = make_two_doors(angle);
        add_turned_line(&walls, nook, 4, angle);
        add_turned_solid(&walls, block, 3, angle);
        const JoxV2 low = {-wide, -wide}, high = {wide, wide};
        JoxField *with =
            jox_field_create(&walls, &place, 0, low, high, 0.2f, 0.15f, &crowd, NULL, NULL, &marks);
        JoxField *without =
            jox_field_create(&walls, &place, 0, low, high, 0.2f, 0.15f, &crowd, NULL, NULL, NULL);
        assert_non_null(marks);
        expect_same_fields(with, without);
        jox_field_free(with);
        jox_field_free(without);
        jox_walls_free(&walls);
    }
    jox_field_marks_free(marks);
}

/* The kernels add shares in the same order, so fields are bitwise equal. */
static void every_instruction_set_spreads_people_alike(void **state) {
    (void)state;
    static const JoxV2 line[] = {{-4, 1}, {2.3f, 1.4f}, {2.3f, -3}};
    const JoxV2 low = {-6, -6}, high = {6, 6};
    JoxV2 goal = {4.5f, 0.0f}, at[HELD];
    float share[HELD];
    JoxPlace place = {.kind = JOX_PLACE_POINT, .points = &goal, .count = 1, .radius = 0.4f};
    jox_place_finish(&place);
    JoxWalls walls = {0};
    add_turned_line(&walls, line, 3, 0.3);
    for (int k = 0; k < 5; k++) {
        const float cell = 0.1f + 0.037f * (float)k;
        JoxFieldCrowd crowd = place_crowd((JoxV2){(float)k, -1.0f}, 0.2, 0.8f, at, share);
        crowd.isa = JO_ISA_SCALAR;
        JoxField *plain =
            jox_field_create(&walls, &place, 0, low, high, cell, 0.2f, &crowd, NULL, NULL, NULL);
        for (JoIsa isa = JO_ISA_SCALAR; isa <= JO_ISA_NEON; isa++) {
            if (!jox_isa_runs(isa))
                continue;
            crowd.isa = isa;
            JoxField *wide = jox_field_create(&walls, &place, 0, low, high, cell, 0.2f, &crowd,
                                              NULL, NULL, NULL);
            expect_same_fields(wide, plain);
            jox_field_free(wide);
        }
        jox_field_free(plain);
    }
    jox_walls_free(&walls);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_crowd_diverts_ways_to_the_other_door),
        cmocka_unit_test(slowness_of_a_person_is_kept_at_walls),
        cmocka_unit_test(a_goal_along_a_wall_is_not_reached_through_it),
        cmocka_unit_test(cached_marks_change_no_field),
        cmocka_unit_test(every_instruction_set_spreads_people_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
