/* The equations of forces as functions of plain values: sign, size, momentum. */
#include "unit/force_crowd.h"

static void a_cone_has_an_edge(void **state) {
    (void)state;
    JoxV2 axis = {1.0f, 0.0f};
    float cosine = jox_parameter_store(JOX_PARAM_push_angle, 60);
    assert_true(jox_cone_holds(jox_v2(1.0f, 1.7f), axis, cosine));
    assert_false(jox_cone_holds(jox_v2(1.0f, 1.8f), axis, cosine));
    assert_false(jox_cone_holds(jox_v2(-1.0f, 0.0f), axis, cosine));
    float wide = jox_parameter_store(JOX_PARAM_push_angle, 120);
    assert_true(jox_cone_holds(jox_v2(-1.0f, 1.8f), axis, wide));
    assert_false(jox_cone_holds(jox_v2(-1.0f, 1.6f), axis, wide));
}

static void shares_of_a_push_add_up(void **state) {
    (void)state;
    JoxV2 share = jox_push_share(jox_v2(3.0f, 4.0f), 120.0f, 3);
    assert_near(share.x, 24.0, 1e-4);
    assert_near(share.y, 32.0, 1e-4);
}

static void impulses_keep_momentum_and_restitution(void **state) {
    (void)state;
    const double masses[][2] = {{70, 70}, {70, 20}, {1, 10000}};
    for (int k = 0; k < 3; k++)
        for (float e = 0.0f; e <= 1.0f; e += 0.25f) {
            double m = masses[k][0], n = masses[k][1], v = -2.0, w = 0.5;
            double j = jox_contact_impulse((float)(v - w), e, (float)(1 / m + 1 / n));
            assert_true(j > 0);
            double v2 = v + j / m, w2 = w - j / n;
            assert_near(m * v2 + n * w2, m * v + n * w, 1e-3 * n);
            assert_near(v2 - w2, -e * (v - w), 1e-4);
        }
    assert_true(jox_contact_impulse(0.0f, 0.5f, 1.0f) == 0.0f);
    assert_true(jox_contact_impulse(1.0f, 0.5f, 1.0f) == 0.0f);
    assert_true(jox_contact_impulse(NAN, 0.5f, 1.0f) == 0.0f);
    assert_true(jox_contact_impulse(-1.0f, 0.5f, 0.0f) == 0.0f);
}

static void damped_force_settles(void **state) {
    (void)state;
    /* 100 N on 70 kg with damping 2.5 tends to 100 / (70 * 2.5) = 0.571 m/s, for any dt. */
    for (float dt = 0.01f; dt < 0.06f; dt *= 2.0f) {
        JoxV2 v = {0.0f, 0.0f};
        float decay = (float)jox_exp(-2.5 * dt);
        for (int i = 0; i < (int)(4.0f / dt); i++)
            v = jox_forced_velocity(v, jox_v2(100.0f, 0.0f), 70.0f, decay, dt);
        assert_near(v.x, 0.571, 0.05);
        assert_true(v.y == 0.0f);
    }
}

static void resistance_passes_the_shortfall_on(void **state) {
    (void)state;
    JoxV2 unit = {0.0f, 1.0f};
    JoxV2 each = jox_resistance(unit, 0.75f, 0.8f, 70.0f, 2, 0.05f);
    assert_near(each.y * 2 * 0.05, 0.8 * 70 * 0.75, 1e-3); /* N s, along the force */
    assert_true(each.x == 0.0f);
}

static void slowing_throws_forward(void **state) {
    (void)state;
    JoxV2 before = {2.0f, 0.0f}, after = {0.5f, 0.0f};
    JoxV2 change = jox_slowing(before, after);
    assert_true(change.x == -1.5f);
    JoxV2 force = jox_deceleration(change, 0.8f, 70.0f, 3, 0.05f);
    assert_near(force.x * 3 * 0.05, 0.8 * 70 * 1.5, 1e-3);
}

static void a_turn_is_no_harder_than_a_stop(void **state) {
    (void)state;
    JoxV2 before = {2.0f, 0.0f}, after = {-1.9f, 0.0f};
    assert_near(jox_length(jox_slowing(before, after)), 2.0, 1e-6);
}

static void own_force_never_reverses_the_motion(void **state) {
    (void)state;
    JoxV2 v = {0.1f, 0.0f}, f = jox_keep_from_reversing(jox_v2(-1000.0f, 30.0f), v, 70.0f, 0.05f);
    assert_near(v.x + f.x * 0.05 / 70, 0.0, 1e-6);
    assert_near(f.y, 30.0, 1e-4);
    f = jox_keep_from_reversing(jox_v2(500.0f, 0.0f), v, 70.0f, 0.05f);
    assert_true(f.x == 500.0f);
    f = jox_keep_from_reversing(jox_v2(-10.0f, 0.0f), jox_v2(0.0f, 0.0f), 70.0f, 0.05f);
    assert_true(f.x == -10.0f);
}

static void the_filter_keeps_the_impulse_and_its_delay(void **state) {
    (void)state;
    for (double dt = 0.01; dt < 0.3; dt *= 2) {
        double share = jox_filter_share(dt, 0.13), force = 0, sum = 0, delay = 0;
        for (int i = 0; i < 2000; i++) {
            force += share * ((i == 0 ? 10 / dt : 0) - force);
            sum += force * dt;
            delay += force * dt * (i + 1) * dt / 10; /* the force of a step acts in the next one */
        }
        assert_near(sum, 10.0, 1e-5);
        assert_near(delay, dt > 0.13 ? dt : 0.13, 1e-5);
    }
    assert_true(jox_filter_share(0.05, 0) == 1.0f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cone_has_an_edge),
        cmocka_unit_test(shares_of_a_push_add_up),
        cmocka_unit_test(impulses_keep_momentum_and_restitution),
        cmocka_unit_test(damped_force_settles),
        cmocka_unit_test(resistance_passes_the_shortfall_on),
        cmocka_unit_test(slowing_throws_forward),
        cmocka_unit_test(a_turn_is_no_harder_than_a_stop),
        cmocka_unit_test(own_force_never_reverses_the_motion),
        cmocka_unit_test(the_filter_keeps_the_impulse_and_its_delay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
