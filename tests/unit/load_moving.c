/* The mean load of a moving crowd of 150 people, over people, time and seeds, does not depend on
   the time step: 0.05 s against 0.0125 s. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "unit/effort.h"
#include "unit/load_crowd.h"

static const int seeds[CROWD_SCENES] = {10, 10, 30}; /* people who mill about seldom touch */
static const double CHANGES = 0.10;                  /* relative change allowed from 0.05 s */

static void compare_steps(int scene) {
    const int count = seeds[scene] / EFFORT_EACH;
    static const double steps[] = {0.05, 0.0125};
    double load[2] = {0}, load2[2] = {0}, compression[2] = {0};
    for (int k = 0; k < 2; k++)
        for (int seed = 1; seed <= count; seed++) {
            CrowdMeans one = crowd_means(scene, (uint64_t)seed, steps[k]);
            load[k] += one.load / count;
            load2[k] += one.load * one.load / count;
            compression[k] += one.compression / count;
        }
    double error = 0.0; /* standard error of the ratio, from the spread over seeds */
    for (int k = 0; k < 2; k++)
        error = hypot(error, sqrt(fmax(0.0, load2[k] / (load[k] * load[k]) - 1.0) / (count - 1)));
    double change = load[1] / load[0] - 1.0, other = compression[1] / compression[0] - 1.0;
    print_message("  %s: %.1f N and %.1f N/m at .05 s, %.1f N and %.1f N/m at .0125 s: %+.1f %% "
                  "(+- %.1f) and %+.1f %%\n",
                  crowd_scenes[scene], load[0], compression[0], load[1], compression[1],
                  100.0 * change, 100.0 * error, 100.0 * other);
    assert_true(load[0] > 1.0); /* N: there is something to measure */
    const double most = EFFORT_EACH > 1 ? CHANGES + 3.0 * error : CHANGES;
    assert_true(fabs(change) <= most && fabs(other) <= most);
}

static void door_load_does_not_depend_on_step(void **state) {
    (void)state;
    compare_steps(0);
}
static void stream_load_does_not_depend_on_step(void **state) {
    (void)state;
    compare_steps(1);
}
static void milling_load_does_not_depend_on_step(void **state) {
    (void)state;
    compare_steps(2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(door_load_does_not_depend_on_step),
        cmocka_unit_test(stream_load_does_not_depend_on_step),
        cmocka_unit_test(milling_load_does_not_depend_on_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
