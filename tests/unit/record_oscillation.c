/* Spectra of the directions in a crowd, of crowds whose directions change in known ways. */
#include "record_crowd.h"

#include "base/number/random.h"

enum { PEOPLE = 100, SPAN = 60, SECONDS = 300 };
static const double TURN = 2 * M_PI * 5 / SPAN; /* rad/s: the fifth frequency of the spectrum */

typedef void (*Velocity)(uint32_t window, double t, float v[2]);

/* A probe of 25 windows, four people in each, all of whom have the velocity of their window. */
static JoxProbe *watched(Velocity velocity) {
    JoxProbeDef def = def_of(JOX_PROBE_OSCILLATION, NULL, 0);
    def.low = (JoxV2){0, 0};
    def.high = (JoxV2){10, 10};
    def.window = 2;
    def.span = SPAN;
    def.every = 0.5;
    JoxProbe *p = jox_probe_create(&def);
    nobody(PEOPLE);
    for (uint32_t i = 0; i < PEOPLE; i++) {
        crowd.x[i] = 0.5f + (float)(i % 10);
        crowd.y[i] = 0.5f + (float)(i / 10);
    }
    for (int step = 1; step <= SECONDS * 10; step++) {
        for (uint32_t i = 0; i < PEOPLE; i++) {
            float v[2];
            velocity(i % 10 / 2 + i / 20 * 5, 0.1 * step, v);
            crowd.vx[i] = v[0];
            crowd.vy[i] = v[1];
        }
        show(p, 0.1 * step);
    }
    return p;
}

/* From window to window one way and the other, each from a direction of its own. */
static void circle(uint32_t window, double t, float v[2]) {
    const double angle = window + (window % 2 ? -TURN : TURN) * t;
    v[0] = 0.1f * (float)cos(angle);
    v[1] = 0.1f * (float)sin(angle);
}

static void who_turns_has_a_frequency_and_a_sense(void **state) {
    (void)state;
    JoxProbe *p = watched(circle);
    assert_near(figure(p, "intervals"), SECONDS * 2, 0);
    assert_near(figure(p, "windows"), 25, 0);
    assert_near(figure(p, "density"), 1, 1e-6);
    assert_near(figure(p, "speed"), 0.1, 1e-3);
    assert_near(figure(p, "frequency"), TURN, 1e-6);
    assert_true(figure(p, "rises") > 100);
    assert_near(figure(p, "anticlockwise"), 13.0 / 25, 1e-9);
    assert_near(figure(p, "one_way"), 1, 0.02);
    jox_probe_free(p);
}

/* To and fro along a line, faster and slower. */
static void swing(uint32_t window, double t, float v[2]) {
    v[0] = 0.1f * (float)cos(TURN * t + window);
    v[1] = 0.5f * v[0];
}

static void who_swings_turns_neither_way(void **state) {
    (void)state;
    JoxProbe *p = watched(swing);
    assert_near(figure(p, "frequency"), TURN, 1e-6);
    assert_true(figure(p, "rises") > 100);
    assert_near(figure(p, "one_way"), 0, 0.02);
    assert_near(figure(p, "speed_frequency"), 2 * TURN, 1e-6); /* greatest twice a turn */
    jox_probe_free(p);
}

/* A direction by chance in each interval. */
static void chance(uint32_t window, double t, float v[2]) {
    const uint64_t drawn =
        jox_random_of(7, window, (uint32_t)(t / 0.5 - 1e-6), jox_random_moment(1, JOX_DRAW_LUA));
    const double angle = 2 * M_PI * (double)(drawn >> 11) * 0x1p-53;
    v[0] = 0.1f * (float)cos(angle);
    v[1] = 0.1f * (float)sin(angle);
}

static void chance_has_no_peak(void **state) {
    (void)state;
    JoxProbe *p = watched(chance);
    assert_true(figure(p, "rises") < 2);
    assert_near(figure(p, "anticlockwise"), 0.5, 0.15);
    jox_probe_free(p);
}

/* A direction that drifts: a sum of steps by chance. */
static void drift(uint32_t window, double t, float v[2]) {
    static double angle[25], last[25];
    float step[2];
    if (t < last[window])
        angle[window] = 0;
    if (t > last[window]) {
        chance(window, t, step);
        angle[window] += 0.1 * (step[0] > 0 ? 1 : -1);
    }
    last[window] = t;
    v[0] = (float)cos(angle[window]);
    v[1] = (float)sin(angle[window]);
}

static void a_drift_is_slowest_of_all(void **state) {
    (void)state;
    JoxProbe *p = watched(drift);
    assert_true(figure(p, "frequency") < TURN / 2);
    assert_true(figure(p, "rises") < 2);
    jox_probe_free(p);
}

static void too_short_a_time_has_none(void **state) {
    (void)state;
    JoxProbeDef def = def_of(JOX_PROBE_OSCILLATION, NULL, 0);
    def.window = 20; /* wider than the area: one window all the same */
    def.span = SPAN;
    JoxProbe *p = jox_probe_create(&def);
    assert_true(isnan(figure(p, "density")) && isnan(figure(p, "frequency")));
    nobody(1);
    for (int second = 1; second <= 10; second++)
        show(p, second);
    assert_near(figure(p, "windows"), 1, 0);
    assert_near(figure(p, "intervals"), 10, 0);
    assert_true(isnan(figure(p, "frequency")) && isnan(figure(p, "rises")));
    jox_probe_free(p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(who_turns_has_a_frequency_and_a_sense),
        cmocka_unit_test(who_swings_turns_neither_way),
        cmocka_unit_test(chance_has_no_peak),
        cmocka_unit_test(a_drift_is_slowest_of_all),
        cmocka_unit_test(too_short_a_time_has_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
