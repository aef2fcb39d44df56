/* The mean load of a moving crowd of 150 does not depend on the step: .05 s against .0125 s, over
   people, time and seeds. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "unit/effort.h"
#include "unit/load_crowd.h"

static const int seeds[CROWD_SCENES] = {10, 10, 30}; /* who mill about touch seldom */
static const double CHANGES = 0.10;                  /* at most, of that at .05 s */

static void compare(int scene) {
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
    double error = 0.0; /* of the ratio, by the spread over seeds */
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

static void people_who_press_to_a_door(void **state) {
    (void)state;
    compare(0);
}
static void a_stream_in_a_periodic_corridor(void **state) {
    (void)state;
    compare(1);
}
static void people_who_mill_about(void **state) {
    (void)state;
    compare(2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(people_who_press_to_a_door),
        cmocka_unit_test(a_stream_in_a_periodic_corridor),
        cmocka_unit_test(people_who_mill_about),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
