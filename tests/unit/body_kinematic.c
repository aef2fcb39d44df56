/* Kinematic bodies: on paths, against other bodies, with others lying on them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "body/body.h"

static const float DT = 0.05f;

static void expect_spot(const JoxBodyPath *path, double time, double x, double y, double vx,
                        double vy) {
    JoxPathSpot s = jox_path_spot(path, time);
    const double got[] = {s.at[0], s.at[1], s.velocity[0], s.velocity[1]}, want[] = {x, y, vx, vy};
    for (int k = 0; k < 4; k++)
        if (!(fabs(got[k] - want[k]) < 1e-9))
            fail_msg("after %g s number %d is %g, not %g", time, k, got[k], want[k]);
}

static void path_gives_position_and_velocity_at_a_time(void **state) {
    (void)state;
    double points[] = {0, 0, 1, 4, 0, 1, 4, 2, 1};
    JoxBodyPath p = {.points = points, .count = 3, .speed = 2, .after = 3, .wait = 1};
    expect_spot(&p, 2.9, 0, 0, 0, 0);
    expect_spot(&p, 3.0, 0, 0, 2, 0);
    expect_spot(&p, 4.5, 3, 0, 2, 0);
    expect_spot(&p, 5.5, 4, 0, 0, 0); /* stops at the corner from 5 s to 6 s */
    expect_spot(&p, 6.5, 4, 1, 0, 2);
    expect_spot(&p, 1000, 4, 2, 0, 0);
    p.end = JO_PATH_BACK; /* stops at the last point from 7 s to 8 s; then a leg of 1 s, a stop, a
                             leg of 2 s, a stop */
    expect_spot(&p, 7.5, 4, 2, 0, 0);
    expect_spot(&p, 8.5, 4, 1, 0, -2);
    expect_spot(&p, 11, 2, 0, -2, 0);
    expect_spot(&p, 12.5, 0, 0, 0, 0);
    expect_spot(&p, 4.5 + 10, 3, 0, 2, 0);
    p.end = JO_PATH_ROUND;
    p.wait = 0; /* legs of 2 s, 1 s, and sqrt(5) s back to the first point */
    expect_spot(&p, 6 + sqrt(5.0) / 2, 2, 1, -4 / sqrt(5.0), -2 / sqrt(5.0));
    expect_spot(&p, 3 + 3 + sqrt(5.0) + 1, 2, 0, 2, 0);
}

static void path_gives_start_time_of_a_leg(void **state) {
    (void)state;
    double points[] = {0, 0, 1, 4, 0,
                       1, 4, 2, 1}; /* legs of 2 s and 1 s, each with a stop of 1 s */
    JoxBodyPath p = {.points = points, .count = 3, .speed = 2, .after = 3, .wait = 1};
    const struct {
        uint32_t end;
        double time, began;
    } at[] = {{JO_PATH_STAY, 1, 3},   {JO_PATH_STAY, 4, 3},     {JO_PATH_STAY, 5.5, 3},
              {JO_PATH_STAY, 6.5, 6}, {JO_PATH_STAY, 100, 6},   {JO_PATH_BACK, 8.5, 8},
              {JO_PATH_BACK, 11, 10}, {JO_PATH_BACK, 13.5, 13}, {JO_PATH_BACK, 26.5, 26}};
    for (size_t k = 0; k < sizeof at / sizeof *at; k++) {
        p.end = at[k].end;
        const double began = jox_path_leg_began(&p, at[k].time);
        if (!(fabs(began - at[k].began) < 1e-9))
            fail_msg("at %g s the leg began at %g s, not %g s", at[k].time, began, at[k].began);
    }
}

static JoxBodies *create_bodies_on_ground(void) {
    JoxBodiesDef def = jox_bodies_def();
    return jox_bodies_create(&def);
}

static uint32_t add_kinematic_test_body(JoxBodies *b, const JoxBodyDef *def) {
    JoxText why = {0};
    uint32_t row = jox_bodies_add(b, def, &why);
    if (row == JOX_NO_BODY)
        fail_msg("%s", why.data);
    return row;
}

static JoxBodyDef make_box_at(double x, double z, double wide, double high) {
    JoxBodyDef d = jox_body_def();
    d.position[0] = x;
    d.position[2] = z;
    d.shape.size[0] = d.shape.size[1] = wide;
    d.shape.size[2] = high;
    return d;
}

static JoxPose get_kinematic_pose(const JoxBodies *b, uint32_t row) {
    JoxPose p;
    assert_true(jox_bodies_pose(b, row, &p));
    return p;
}

static void step_seconds(JoxBodies *b, double seconds) {
    for (int i = 0; i < (int)(seconds / 0.05 + 0.5); i++)
        jox_bodies_step(b, DT, NULL, 0);
}

static void kinematic_body_pushes_and_is_not_pushed(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodies *b = create_bodies_on_ground();
    JoxBodyDef door = make_box_at(0, 1, 1, 2), crate = make_box_at(2, 0.5, 1, 1);
    door.kinematic = true;
    door.velocity[0] = 0.5;
    crate.mass = 1000;
    uint32_t mover = add_kinematic_test_body(b, &door), pushed = add_kinematic_test_body(b, &crate);
    step_seconds(b, 6);
    assert_float_equal(get_kinematic_pose(b, mover).position.x, 3.0, 1e-4); /* unhindered */
    assert_float_equal(get_kinematic_pose(b, mover).velocity.x, 0.5, 0.0);
    assert_float_equal(get_kinematic_pose(b, pushed).position.x, 4.0, 0.02);
    assert_float_equal(get_kinematic_pose(b, pushed).velocity.x, 0.5, 0.05);
    assert_float_equal(get_kinematic_pose(b, mover).mass, 0.0, 0.0);
    const JoxImpulse hard = {.object = mover, .point = {3, 0, 1}, .impulse = {-1e4f, 0, 0}};
    assert_int_equal(jox_bodies_impulses(b, &hard, 1), 0); /* counted, but not applied */
    assert_false(jox_bodies_force(b, mover, (JoxV3){-1e4f, 0, 0}));
    assert_false(jox_bodies_set_carrier(b, mover, 1));
    step_seconds(b, 1);
    assert_float_equal(get_kinematic_pose(b, mover).position.x, 3.5, 1e-4);
    JoxObjects o = {0};
    jox_bodies_objects(b, &o);
    assert_true(o.rows[mover].kinematic && !o.rows[mover].moves);
    assert_float_equal(o.rows[mover].velocity.x, 0.5, 0.0);
    assert_true(!o.rows[pushed].kinematic && o.rows[pushed].moves);
    /* The contact of the pushed crate names the row of the pushing body. */
    uint32_t between = 0;
    const JoxObjectContacts contacts = jox_objects_contacts(&o);
    for (uint32_t k = 0; k < contacts.count; k++)
        between += contacts.items[k].first == pushed && contacts.items[k].second == mover;
    assert_true(between > 0);
    jox_bodies_free(b);
}

/* A crate on a platform that stops long enough for the crate to sleep, and then rises and moves
   sideways. */
static void platform_carries_its_load(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodies *b = create_bodies_on_ground();
    double points[] = {0, 0, 0.1, 0, 0, 2.1, 3, 0, 2.1};
    JoxBodyDef lift = make_box_at(0, 0.1, 2, 0.2), crate = make_box_at(0, 0.7, 1, 1);
    lift.kinematic = true;
    lift.path = (JoxBodyPath){.points = points, .count = 3, .speed = 0.5, .after = 10, .wait = 5};
    uint32_t platform = add_kinematic_test_body(b, &lift),
             load = add_kinematic_test_body(b, &crate);
    step_seconds(b, 9);
    assert_float_equal(get_kinematic_pose(b, load).velocity.z, 0.0, 0.0); /* asleep */
    step_seconds(b, 3);
    assert_float_equal(get_kinematic_pose(b, platform).position.z, 1.1, 1e-4);
    assert_float_equal(get_kinematic_pose(b, platform).velocity.z, 0.5, 1e-6);
    assert_float_equal(get_kinematic_pose(b, load).position.z, 1.7, 0.02);
    JoxObjects o = {0};
    jox_bodies_objects(b, &o);
    assert_true(o.rows[load].grounded);
    step_seconds(
        b, 16); /* at 28 s: the platform reached the second point at 14 s and left it at 19 s */
    assert_float_equal(get_kinematic_pose(b, platform).position.x, 3.0, 1e-4);
    assert_float_equal(get_kinematic_pose(b, platform).velocity.x, 0.0, 0.0);
    assert_float_equal(get_kinematic_pose(b, load).position.x, 3.0, 0.05);
    assert_float_equal(get_kinematic_pose(b, load).position.z, 2.7, 0.02);
    jox_bodies_free(b);
}

static void spinning_body_turns_about_its_centre(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodies *b = create_bodies_on_ground();
    JoxBodyDef bar = make_box_at(0, 0.5, 1, 0.2), ball = make_box_at(2.5, 0.5, 0, 0);
    bar.shape.size[0] = 6;
    bar.kinematic = true;
    bar.spin[2] = 0.5;
    ball.position[1] = 1.2;
    ball.shape.kind = JOX_SHAPE_SPHERE;
    ball.shape.size[0] = 0.4;
    uint32_t sweeper = add_kinematic_test_body(b, &bar), swept = add_kinematic_test_body(b, &ball);
    step_seconds(b, 3.14159265 / 0.5 + 0.02); /* half a turn, rounded to steps */
    JoxPose p = get_kinematic_pose(b, sweeper);
    assert_float_equal(fabsf(p.turn[2]), 1.0, 2e-3);
    assert_float_equal(p.position.x, 0.0, 1e-6);
    assert_true(get_kinematic_pose(b, swept).position.x < 2.0f ||
                get_kinematic_pose(b, swept).position.y > 1.5f);
    jox_bodies_free(b);
}

/* A call that sets the velocity or the place of a body ends its path. */
static void new_velocity_or_place_ends_the_path(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodies *b = create_bodies_on_ground();
    double points[] = {0, 0, 1, 5, 0, 1};
    JoxBodyDef door = make_box_at(0, 1, 1, 2);
    door.kinematic = true;
    door.path = (JoxBodyPath){.points = points, .count = 2, .speed = 1};
    uint32_t row = add_kinematic_test_body(b, &door);
    step_seconds(b, 2);
    assert_float_equal(get_kinematic_pose(b, row).position.x, 2.0, 1e-4);
    assert_true(jox_bodies_set_velocity(b, row, (JoxV3){0, 2, 0}, (JoxV3){0, 0, 0}));
    step_seconds(b, 1);
    assert_float_equal(get_kinematic_pose(b, row).position.x, 2.0, 1e-4);
    assert_float_equal(get_kinematic_pose(b, row).position.y, 2.0, 1e-4);
    assert_true(jox_bodies_place(b, row, (double[]){7, 7, 1}, NULL));
    step_seconds(b, 1);
    assert_float_equal(get_kinematic_pose(b, row).position.x, 7.0, 0.0);
    assert_float_equal(get_kinematic_pose(b, row).position.y, 7.0, 0.0);
    jox_bodies_free(b);
}

static void expect_refusal_naming(JoxBodies *b, const JoxBodyDef *def, const char *word) {
    JoxText why = {0};
    assert_int_equal(jox_bodies_add(b, def, &why), JOX_NO_BODY);
    assert_non_null(strstr(why.data, word));
    jox_text_free(&why);
}

static void invalid_paths_are_refused(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodies *b = create_bodies_on_ground();
    double points[] = {0, 0, 1, 5, 0, 1, 5, 0, 1};
    JoxBodyDef d = make_box_at(0, 1, 1, 2);
    d.path = (JoxBodyPath){.points = points, .count = 2, .speed = 1};
    expect_refusal_naming(b, &d, "kinematic");
    d.kinematic = true;
    d.path.speed = 0;
    expect_refusal_naming(b, &d, "speed");
    d.path = (JoxBodyPath){.points = points, .count = 3, .speed = 1};
    expect_refusal_naming(b, &d, "1 mm");
    d.path.count = 2;
    points[4] = NAN;
    expect_refusal_naming(b, &d, "10 km");
    points[4] = 0;
    d.path.wait = -1;
    expect_refusal_naming(b, &d, "waits");
    assert_int_equal(jox_bodies_count(b), 0);
    jox_bodies_free(b);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(path_gives_position_and_velocity_at_a_time),
                                       cmocka_unit_test(path_gives_start_time_of_a_leg),
                                       cmocka_unit_test(kinematic_body_pushes_and_is_not_pushed),
                                       cmocka_unit_test(platform_carries_its_load),
                                       cmocka_unit_test(spinning_body_turns_about_its_centre),
                                       cmocka_unit_test(new_velocity_or_place_ends_the_path),
                                       cmocka_unit_test(invalid_paths_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
