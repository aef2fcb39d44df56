/* Spectra of directions in crowds whose directions change in known ways. */
#include "record_crowd.h"

#include "base/number/random.h"

enum { PEOPLE = 100, SPAN = 60, SECONDS = 300 };
static const double TURN = 2 * M_PI * 5 / SPAN; /* rad/s: the fifth frequency of the spectrum */

typedef void (*Velocity)(uint32_t window, double t, float v[2]);

/* Runs a probe with 25 windows of four people, who all have the velocity of their window. */
static JoxProbe *run_oscillation_probe(Velocity velocity) {
    JoxProbeDef def = default_probe_def(JOX_PROBE_OSCILLATION, NULL, 0);
    def.low = (JoxV2){0, 0};
    def.high = (JoxV2){10, 10};
    def.window = 2;
    def.span = SPAN;
    def.every = 0.5;
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(PEOPLE);
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
        show_crowd(p, 0.1 * step);
    }
    return p;
}

/* Turns windows alternately one way and the other, from different directions. */
static void turn_windows(uint32_t window, double t, float v[2]) {
    const double angle = window + (window % 2 ? -TURN : TURN) * t;
    v[0] = 0.1f * (float)cos(angle);
    v[1] = 0.1f * (float)sin(angle);
}

static void turning_has_frequency_and_sense(void **state) {
    (void)state;
    JoxProbe *p = run_oscillation_probe(turn_windows);
    assert_near(figure_value(p, "intervals"), SECONDS * 2, 0);
    assert_near(figure_value(p, "windows"), 25, 0);
    assert_near(figure_value(p, "density"), 1, 1e-6);
    assert_near(figure_value(p, "speed"), 0.1, 1e-3);
    assert_near(figure_value(p, "frequency"), TURN, 1e-6);
    assert_true(figure_value(p, "rises") > 100);
    assert_near(figure_value(p, "anticlockwise"), 13.0 / 25, 1e-9);
    assert_near(figure_value(p, "one_way"), 1, 0.02);
    jox_probe_free(p);
}

/* Swings along a line, faster and slower. */
static void swing_windows(uint32_t window, double t, float v[2]) {
    v[0] = 0.1f * (float)cos(TURN * t + window);
    v[1] = 0.5f * v[0];
}

static void swinging_turns_neither_way(void **state) {
    (void)state;
    JoxProbe *p = run_oscillation_probe(swing_windows);
    assert_near(figure_value(p, "frequency"), TURN, 1e-6);
    assert_true(figure_value(p, "rises") > 100);
    assert_near(figure_value(p, "one_way"), 0, 0.02);
    /* The speed is greatest twice per period. */
    assert_near(figure_value(p, "speed_frequency"), 2 * TURN, 1e-6);
    jox_probe_free(p);
}

/* Draws a random direction in each interval. */
static void draw_direction(uint32_t window, double t, float v[2]) {
    const uint64_t drawn =
        jox_random_of(7, window, (uint32_t)(t / 0.5 - 1e-6), jox_random_moment(1, JOX_DRAW_LUA));
    const double angle = 2 * M_PI * (double)(drawn >> 11) * 0x1p-53;
    v[0] = 0.1f * (float)cos(angle);
    v[1] = 0.1f * (float)sin(angle);
}

static void random_directions_have_no_peak(void **state) {
    (void)state;
    JoxProbe *p = run_oscillation_probe(draw_direction);
    assert_true(figure_value(p, "rises") < 2);
    assert_near(figure_value(p, "anticlockwise"), 0.5, 0.15);
    jox_probe_free(p);
}

/* Drifts by random steps of the direction. */
static void drift_direction(uint32_t window, double t, float v[2]) {
    static double angle[25], last[25];
    float step[2];
    if (t < last[window])
        angle[window] = 0;
    if (t > last[window]) {
        draw_direction(window, t, step);
        angle[window] += 0.1 * (step[0] > 0 ? 1 : -1);
    }
    last[window] = t;
    v[0] = (float)cos(angle[window]);
    v[1] = (float)sin(angle[window]);
}

static void drift_has_lowest_frequency(void **state) {
    (void)state;
    JoxProbe *p = run_oscillation_probe(drift_direction);
    assert_true(figure_value(p, "frequency") < TURN / 2);
    assert_true(figure_value(p, "rises") < 2);
    jox_probe_free(p);
}

static void short_time_has_no_frequency(void **state) {
    (void)state;
    JoxProbeDef def = default_probe_def(JOX_PROBE_OSCILLATION, NULL, 0);
    def.window = 20; /* wider than the area: there is one window all the same */
    def.span = SPAN;
    JoxProbe *p = jox_probe_create(&def);
    assert_true(isnan(figure_value(p, "density")) && isnan(figure_value(p, "frequency")));
    reset_crowd(1);
    for (int second = 1; second <= 10; second++)
        show_crowd(p, second);
    assert_near(figure_value(p, "windows"), 1, 0);
    assert_near(figure_value(p, "intervals"), 10, 0);
    assert_true(isnan(figure_value(p, "frequency")) && isnan(figure_value(p, "rises")));
    jox_probe_free(p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turning_has_frequency_and_sense),
        cmocka_unit_test(swinging_turns_neither_way),
        cmocka_unit_test(random_directions_have_no_peak),
        cmocka_unit_test(drift_has_lowest_frequency),
        cmocka_unit_test(short_time_has_no_frequency),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
