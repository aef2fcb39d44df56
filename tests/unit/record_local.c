/* Crowd pressure in crowds with known motion: turbulent, calm, and not measured.
   tests/scenes/real.sh covers recorded queues. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "record/local_samples.h"
#include "record_draw.h"
#include "unit/assert_near.h"

enum { SIDE = 30, PEOPLE = SIDE * SIDE };
static const float SPACING = 0.4f; /* m: 6.25 people per m2, on 12 m x 12 m */
static const double DT = 0.1;

static struct {
    uint32_t count, key[PEOPLE];
    float x[PEOPLE], y[PEOPLE], vx[PEOPLE], vy[PEOPLE];
    JoxV2 period;
} crowd;

/* Places a lattice about (6, 6) with random offsets of up to a quarter of its spacing. */
static JoxLocal *place_lattice(int side, float spacing) {
    uint32_t chance = 11;
    memset(&crowd, 0, sizeof crowd);
    crowd.count = (uint32_t)(side * side);
    for (uint32_t i = 0; i < crowd.count; i++) {
        crowd.key[i] = i;
        crowd.x[i] = 6 + spacing * ((float)(i % (uint32_t)side) - (float)(side - 1) / 2.0f) +
                     0.5f * spacing * (draw_uniform(&chance) - 0.5f);
        crowd.y[i] = 6 + spacing * ((float)(i / (uint32_t)side) - (float)(side - 1) / 2.0f) +
                     0.5f * spacing * (draw_uniform(&chance) - 0.5f);
    }
    JoxLocal *local = jox_local_create((JoxV2){0, 0}, (JoxV2){12, 12}, NULL);
    jox_local_enable_pressure(local);
    return local;
}

/* Returns the velocity of person i along x at time t. */
typedef float Motion(uint32_t i, double t);

static double find_greatest_pressure(const JoxLocal *local) {
    double most = NAN;
    for (size_t c = 0; c < (size_t)local->grid->columns * local->grid->rows; c++)
        most = fmax(most, jox_local_pressure(local, c));
    return most;
}

/* Moves the crowd for `seconds`, and returns the greatest pressure at any time; NAN: not
   measured. */
static double move_lattice(JoxLocal *local, Motion *motion, double seconds) {
    double most = NAN;
    for (int step = 0; step <= (int)(seconds / DT + 0.5); step++) {
        double t = DT * step;
        for (uint32_t i = 0; i < crowd.count && step > 0; i++) {
            crowd.vx[i] = motion(i, t - DT / 2);
            crowd.x[i] += (float)DT * crowd.vx[i];
            if (crowd.period.x > 0.0f && crowd.x[i] >= crowd.period.x)
                crowd.x[i] -= crowd.period.x;
            if (crowd.period.x > 0.0f && crowd.x[i] < 0.0f)
                crowd.x[i] += crowd.period.x;
        }
        const JoxFrame frame = {.time = t,
                                .count = crowd.count,
                                .period = crowd.period,
                                .keys = crowd.count,
                                .key = crowd.key,
                                .x = crowd.x,
                                .y = crowd.y,
                                .vx = crowd.vx,
                                .vy = crowd.vy};
        if (jox_local_frame(local, &frame, NULL))
            most = fmax(most, find_greatest_pressure(local));
    }
    jox_local_free(local);
    return most;
}

static float stand_still(uint32_t i, double t) {
    (void)i, (void)t;
    return 0.0f;
}
static float walk_evenly(uint32_t i, double t) {
    (void)i, (void)t;
    return 0.8f;
}
static float shake_evenly(uint32_t i, double t) { /* by 0.1 m/s, two seconds each way */
    (void)i;
    return fmod(t, 4.0) < 2.0 ? 0.1f : -0.1f;
}
static float walk_shaken(uint32_t i, double t) {
    return 0.5f + shake_evenly(i, t);
}
static float start_walking(uint32_t i, double t) { /* a gate opens */
    (void)i;
    return t < 21.3 ? 0.0f : 0.5f;
}
static float walk_through_standing(uint32_t i,
                                   double t) { /* one in twenty walks through a standing crowd */
    (void)t;
    return i % 40 == 7 ? 1.0f : i % 40 == 27 ? -1.0f : 0.0f;
}

static void calm_crowd_has_no_pressure(void **state) {
    (void)state;
    assert_true(move_lattice(place_lattice(SIDE, SPACING), stand_still, 40) < 1e-6);
    JoxLocal *local = place_lattice(SIDE, SPACING);
    crowd.period = (JoxV2){12, 0};
    assert_true(move_lattice(local, walk_evenly, 40) < 1e-4);
}

static void shaken_crowd_has_density_times_variance(void **state) {
    (void)state;
    JoxLocal *local = place_lattice(SIDE, SPACING);
    crowd.period = (JoxV2){12, 0};
    assert_near(move_lattice(local, shake_evenly, 40), 6.25 * 0.01, 0.006); /* 3 times 0.02 */
    local = place_lattice(SIDE, SPACING);
    crowd.period = (JoxV2){12, 0};
    assert_near(move_lattice(local, walk_shaken, 40), 6.25 * 0.01, 0.006);
}

/* The velocities of single people vary by 0.05 m2/s2, which would give 0.31 per s2. */
static void walking_through_crowd_is_no_turbulence(void **state) {
    (void)state;
    JoxLocal *local = place_lattice(SIDE, SPACING);
    crowd.period = (JoxV2){12, 0};
    double pressure = move_lattice(local, walk_through_standing, 60);
    assert_true(pressure > 0.0 && pressure < 0.01);
}

static void unmeasured_pressure_is_nan(void **state) {
    (void)state;
    assert_true(
        isnan(move_lattice(place_lattice(SIDE, SPACING), shake_evenly, 19)));     /* too short */
    assert_true(isnan(move_lattice(place_lattice(20, 0.55f), shake_evenly, 40))); /* 3.3 per m2 */
    assert_true(
        isnan(move_lattice(place_lattice(8, SPACING), shake_evenly, 40))); /* 10 m2 of people */
    assert_false(isnan(move_lattice(place_lattice(SIDE, SPACING), shake_evenly, 40)));
    JoxLocal *local = place_lattice(SIDE, SPACING);
    crowd.period = (JoxV2){12, 0};
    /* Before it and, from 25 s on, not measured. */
    assert_true(move_lattice(local, start_walking, 40) < 1e-4);
}

/* After a gap the measurement takes its full time again. */
static void gap_restarts_measurement(void **state) {
    (void)state;
    float one[400], nothing[400];
    JoxPressure *pressure = jox_pressure_create(20, 20, 0.5f);
    for (int c = 0; c < 400; c++) {
        one[c] = 6.0f;
        nothing[c] = 0.0f;
    }
    for (double t = 0; t < 41; t += 0.5) {
        if (t < 22 || t > 25)
            jox_pressure_add(pressure, t, one, nothing, nothing);
        assert_int_equal(isnan(jox_pressure_now(pressure)[210]), t < 19.4 || t > 25);
    }
    jox_pressure_free(pressure);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(calm_crowd_has_no_pressure),
        cmocka_unit_test(shaken_crowd_has_density_times_variance),
        cmocka_unit_test(walking_through_crowd_is_no_turbulence),
        cmocka_unit_test(unmeasured_pressure_is_nan),
        cmocka_unit_test(gap_restarts_measurement),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
