/* Dynamic bodies: they fall, stand and hit people; invalid ones are refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/clock.h"
#include "body/body.h"

static JoxBodyDef make_test_ball(void) {
    JoxBodyDef d = jox_body_def();
    d.shape.kind = JOX_SHAPE_SPHERE;
    d.shape.size[0] = 0.11;
    d.mass = 0.4;
    d.position[2] = 1.2;
    return d;
}

static void falling_ball_accelerates_by_gravity(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxBodyDef d = make_test_ball();
    d.position[2] = 100;
    uint32_t row = jox_bodies_add(b, &d, NULL);
    for (int i = 0; i < 20; i++)
        jox_bodies_step(b, 0.05f, NULL, 0);
    JoxPose p;
    assert_true(jox_bodies_pose(b, row, &p));
    assert_float_equal(p.velocity.z, -9.81, 1e-2);
    assert_float_equal(p.position.z, 100 - 4.905, 0.1);
    jox_bodies_free(b);
}

static void stack_stands(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxBodyDef d = jox_body_def();
    for (int i = 0; i < 4; i++) {
        d.position[2] = 0.5 + i;
        jox_bodies_add(b, &d, NULL);
    }
    for (int i = 0; i < 200; i++)
        jox_bodies_step(b, 0.05f, NULL, 0);
    JoxObjects o = {0};
    jox_bodies_objects(b, &o);
    for (uint32_t i = 0; i < 4; i++)
        assert_float_equal(o.rows[i].position.z, 0.5f + (float)i, 0.03);
    assert_true(o.rows[0].grounded);
    /* A tiny tilt may split a corner in two: all lie near the corners of the square. */
    assert_in_range(o.rows[0].footprint_count, 4, 8);
    for (uint32_t i = 0; i < o.rows[0].footprint_count; i++) {
        assert_float_equal(fabsf(o.rows[0].footprint[i].x), 0.5, 5e-3);
        assert_float_equal(fabsf(o.rows[0].footprint[i].y), 0.5, 5e-3);
    }
    jox_bodies_free(b);
}

static void ball_hits_person(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodiesDef def = jox_bodies_def();
    def.gravity = 0;
    JoxBodies *b = jox_bodies_create(&def);
    JoxBodyDef d = make_test_ball();
    d.velocity[0] = 30;
    uint32_t row = jox_bodies_add(b, &d, NULL);
    JoxDisc disc = {.x = 0.8f, .radius = 0.2f, .mass = 70};
    JoxBodiesReport r = jox_bodies_step(b, 0.05f, &disc, 1);
    JoxPose p;
    jox_bodies_pose(b, row, &p);
    assert_int_equal(r.hit_count, 1);
    assert_true(p.centre.x < 0.8f);
    assert_float_equal(0.4 * p.velocity.x + 70 * disc.vx, 12, 1e-4);
    jox_bodies_free(b);
}

/* An impulse at the start of the step and one spread over it give the same momentum, but
   different displacements. */
static void lasting_impulse_gives_the_same_momentum(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodiesDef def = jox_bodies_def();
    def.gravity = 0;
    for (int lasting = 0; lasting < 2; lasting++) {
        JoxBodies *b = jox_bodies_create(&def);
        JoxBodyDef d = jox_body_def();
        d.position[2] = 5;
        uint32_t row = jox_bodies_add(b, &d, NULL);
        JoxImpulse push = {row, {20, 0, 0}, {0, 0.5f, 5}, (float)lasting};
        double momentum[3];
        assert_int_equal(jox_bodies_impulses(b, &push, 1), 0);
        jox_bodies_momentum(b, momentum);
        assert_float_equal(momentum[0], 20, 1e-4);
        jox_bodies_step(b, 0.1f, NULL, 0); /* six substeps */
        jox_bodies_momentum(b, momentum);
        assert_float_equal(momentum[0], 20, 1e-4);
        JoxPose p;
        assert_true(jox_bodies_pose(b, row, &p));
        assert_float_equal(p.velocity.x, 2, 1e-4);
        assert_float_equal(p.position.x, lasting ? 0.2 * 7 / 12 : 0.2, 1e-4);
        assert_float_equal(p.spin.z, -10 / (10 / 6.0), 0.05);
        jox_bodies_step(b, 0.1f, NULL, 0); /* no impulse is left */
        assert_true(jox_bodies_pose(b, row, &p));
        assert_float_equal(p.velocity.x, 2, 1e-4);
        jox_bodies_free(b);
    }
}

/* A body of 200 kg with friction 0.6 stands against 600 N at its upper edge. */
static void friction_holds_without_creep(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxBodyDef d = jox_body_def();
    d.shape.size[2] = 0.8;
    d.position[2] = 0.4;
    d.mass = 200;
    uint32_t row = jox_bodies_add(b, &d, NULL);
    for (int i = 0; i < 100; i++) {
        JoxImpulse push = {row, {30, 0, 0}, {-0.5f, 0, 0.8f}, 1};
        jox_bodies_impulses(b, &push, 1);
        jox_bodies_step(b, 0.05f, NULL, 0);
    }
    JoxPose p;
    assert_true(jox_bodies_pose(b, row, &p));
    assert_float_equal(p.position.x, 0, 1e-3);
    assert_float_equal(p.position.y, 0, 1e-3);
    assert_float_equal(p.velocity.x, 0, 1e-3);
    jox_bodies_free(b);
}

static void invalid_balls_are_refused(void **state) {
    (void)state;
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxText error = {0};
    JoxBodyDef d = make_test_ball();
    d.mass = -1;
    assert_int_equal(jox_bodies_add(b, &d, &error), JOX_NO_BODY);
    assert_non_null(error.data);
    d = make_test_ball();
    d.position[0] = 1e300;
    assert_int_equal(jox_bodies_add(b, &d, &error), JOX_NO_BODY);
    d = make_test_ball();
    d.shape.size[0] = NAN;
    assert_int_equal(jox_bodies_add(b, &d, &error), JOX_NO_BODY);
    assert_int_equal(jox_bodies_count(b), 0);
    jox_text_free(&error);
    jox_bodies_free(b);
}

/* Walls are put into Bullet's world with the first body: without bodies a plan of 100,000
   corners costs next to nothing, and the first body, whenever it comes, collides with them. */
static void walls_enter_bullet_with_the_first_body(void **state) {
    (void)state;
    enum { CORNERS = 100000 };
    static JoxV2 ring[CORNERS];
    if (!jox_bodies_available())
        skip();
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxWalls many = {0}, few = {0};
    const JoxV2 wall[] = {{1, -2}, {1, 2}};
    for (int k = 0; k < CORNERS; k++)
        ring[k] = (JoxV2){50 * cosf(6.2831853f * (float)k / CORNERS),
                          50 * sinf(6.2831853f * (float)k / CORNERS)};
    jox_walls_add_polyline(&many, ring, CORNERS, true, 3);
    jox_walls_add_polyline(&few, wall, 2, false, 3);
    const double begin = jox_clock_thread();
    jox_bodies_set_walls(b, &many, 3);
    assert_true(jox_clock_thread() - begin < 3.0); /* Bullet needs half a minute for them */
    jox_bodies_set_walls(b, &few, 3);
    for (int again = 0; again < 2; again++) { /* also after all bodies were removed */
        JoxBodyDef d = make_test_ball();
        d.position[2] = 0.11;
        d.velocity[0] = 3;
        const uint32_t row = jox_bodies_add(b, &d, NULL);
        for (int i = 0; i < 20; i++)
            jox_bodies_step(b, 0.05f, NULL, 0);
        JoxPose p;
        assert_true(jox_bodies_pose(b, row, &p));
        assert_in_range(1000 * p.position.x, 500, 900);
        jox_bodies_remove(b, row);
        jox_bodies_set_walls(b, &few, 3);
    }
    jox_bodies_free(b);
    jox_walls_free(&many);
    jox_walls_free(&few);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(falling_ball_accelerates_by_gravity),
                                       cmocka_unit_test(stack_stands),
                                       cmocka_unit_test(ball_hits_person),
                                       cmocka_unit_test(lasting_impulse_gives_the_same_momentum),
                                       cmocka_unit_test(friction_holds_without_creep),
                                       cmocka_unit_test(invalid_balls_are_refused),
                                       cmocka_unit_test(walls_enter_bullet_with_the_first_body)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
