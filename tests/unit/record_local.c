/* Crowd pressure of crowds whose motion is known: what is turbulence, what is not, and what was not
   measured. Recorded queues are read by tests/scenes/real.sh. */
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
#include "record/local.h"

/* Which NAN never is. */
static void assert_near(double got, double expected, double tolerance) {
    if (!(fabs(got - expected) <= tolerance))
        fail_msg("%.9g is not %.9g +- %g", got, expected, tolerance);
}

enum { SIDE = 30, PEOPLE = SIDE * SIDE };
static const float SPACING = 0.4f; /* m: 6.25 people per m2, on 12 m x 12 m */
static const double DT = 0.1;

static struct {
    uint32_t count, key[PEOPLE];
    float x[PEOPLE], y[PEOPLE], vx[PEOPLE], vy[PEOPLE];
    JoxV2 period;
} crowd;

static float dice(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777216.0f;
}

/* A lattice about (6, 6), shaken by up to a quarter of its spacing. */
static JoxLocal *stand(int side, float spacing) {
    uint32_t chance = 11;
    memset(&crowd, 0, sizeof crowd);
    crowd.count = (uint32_t)(side * side);
    for (uint32_t i = 0; i < crowd.count; i++) {
        crowd.key[i] = i;
        crowd.x[i] = 6 + spacing * ((float)(i % (uint32_t)side) - (float)(side - 1) / 2.0f) +
                     0.5f * spacing * (dice(&chance) - 0.5f);
        crowd.y[i] = 6 + spacing * ((float)(i / (uint32_t)side) - (float)(side - 1) / 2.0f) +
                     0.5f * spacing * (dice(&chance) - 0.5f);
    }
    JoxLocal *local = jox_local_create((JoxV2){0, 0}, (JoxV2){12, 12});
    jox_local_want_pressure(local);
    return local;
}

/* Person i's velocity along x at time t. */
typedef float Motion(uint32_t i, double t);

static double greatest(const JoxLocal *local) {
    double most = NAN;
    for (size_t c = 0; c < (size_t)local->grid->columns * local->grid->rows; c++)
        most = fmax(most, jox_local_pressure(local, c));
    return most;
}

/* Moves the crowd for so long, and gives the greatest pressure of any time; NAN: not measured. */
static double move(JoxLocal *local, Motion *motion, double seconds) {
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
            most = fmax(most, greatest(local));
    }
    jox_local_free(local);
    return most;
}

static float still(uint32_t i, double t) {
    (void)i, (void)t;
    return 0.0f;
}
static float walk(uint32_t i, double t) {
    (void)i, (void)t;
    return 0.8f;
}
static float shaken(uint32_t i, double t) { /* by 0.1 m/s, two seconds each way */
    (void)i;
    return fmod(t, 4.0) < 2.0 ? 0.1f : -0.1f;
}
static float shaken_walk(uint32_t i, double t) {
    return 0.5f + shaken(i, t);
}
static float start(uint32_t i, double t) { /* a gate opens */
    (void)i;
    return t < 21.3 ? 0.0f : 0.5f;
}
static float pass(uint32_t i, double t) { /* one in twenty walks through those who stand */
    (void)t;
    return i % 40 == 7 ? 1.0f : i % 40 == 27 ? -1.0f : 0.0f;
}

static void calm_crowds_read_nothing(void **state) {
    (void)state;
    assert_true(move(stand(SIDE, SPACING), still, 40) < 1e-6);
    JoxLocal *local = stand(SIDE, SPACING);
    crowd.period = (JoxV2){12, 0};
    assert_true(move(local, walk, 40) < 1e-4);
}

static void shaken_crowds_read_density_times_variance(void **state) {
    (void)state;
    JoxLocal *local = stand(SIDE, SPACING);
    crowd.period = (JoxV2){12, 0};
    assert_near(move(local, shaken, 40), 6.25 * 0.01, 0.006); /* 3 times 0.02 */
    local = stand(SIDE, SPACING);
    crowd.period = (JoxV2){12, 0};
    assert_near(move(local, shaken_walk, 40), 6.25 * 0.01, 0.006);
}

/* Single people's velocities vary by 0.05 m2/s2, which would be 0.31 per s2. */
static void people_who_walk_through_are_no_turbulence(void **state) {
    (void)state;
    JoxLocal *local = stand(SIDE, SPACING);
    crowd.period = (JoxV2){12, 0};
    double pressure = move(local, pass, 60);
    assert_true(pressure > 0.0 && pressure < 0.01);
}

static void what_was_not_measured_has_no_number(void **state) {
    (void)state;
    assert_true(isnan(move(stand(SIDE, SPACING), shaken, 19))); /* too short */
    assert_true(isnan(move(stand(20, 0.55f), shaken, 40)));     /* 3.3 per m2 */
    assert_true(isnan(move(stand(8, SPACING), shaken, 40)));    /* 10 m2 of people */
    assert_false(isnan(move(stand(SIDE, SPACING), shaken, 40)));
    JoxLocal *local = stand(SIDE, SPACING);
    crowd.period = (JoxV2){12, 0};
    assert_true(move(local, start, 40) < 1e-4); /* before and, from 25 s on, not measured */
}

/* After a gap, it takes its time again. */
static void gaps_begin_anew(void **state) {
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
        cmocka_unit_test(calm_crowds_read_nothing),
        cmocka_unit_test(shaken_crowds_read_density_times_variance),
        cmocka_unit_test(people_who_walk_through_are_no_turbulence),
        cmocka_unit_test(what_was_not_measured_has_no_number),
        cmocka_unit_test(gaps_begin_anew),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
