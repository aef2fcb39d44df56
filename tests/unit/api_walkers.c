/* People of a C program may walk by the walking law: a time gap and haste of their own. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "jostle.h"

/* How far somebody comes to be behind a slower one whom they cannot pass, m: the mean of 20 s, as
   time gaps wander. */
static double apart(double time_gap, double haste, bool by_name) {
    JoWorldDef def = jo_default_world_def();
    JoWorld *world = jo_world_create(&def, NULL);
    const double sides[] = {0.22, -0.22};
    for (int k = 0; k < 2; k++)
        assert_true(jo_world_add_line(world, (double[]){-2, sides[k], 60, sides[k]}, 2, NULL));
    JoAgent people[2];
    for (int k = 0; k < 2; k++) {
        JoAgentDef person = jo_default_agent_def();
        person.x = 3.0 * k;
        person.time_gap = by_name ? person.time_gap : time_gap;
        person.haste = by_name ? person.haste : haste;
        people[k] = jo_world_add_agent(world, &person, NULL);
        jo_agent_set_preferred(world, people[k], k ? 0.6 : 1.4, 0.0);
        if (by_name)
            assert_true(jo_agent_set_parameter(world, people[k], "time_gap", time_gap, NULL) &&
                        jo_agent_set_parameter(world, people[k], "haste", haste, NULL));
    }
    jo_world_step(world, 600);
    double gaps = 0.0, faster = 0.0;
    for (int n = 0; n < 400; n++) {
        jo_world_step(world, 1);
        JoAgentState behind = jo_agent_state(world, people[0]),
                     ahead = jo_agent_state(world, people[1]);
        gaps += ahead.x - behind.x;
        faster += behind.vx - ahead.vx;
    }
    assert_true(fabs(faster / 400) < 0.02);
    jo_world_free(world);
    return gaps / 400;
}

static void longer_time_gap_keeps_farther_behind(void **state) {
    (void)state;
    double orca = apart(0.0, 0.5, false), near = apart(0.8, 0.5, false),
           far = apart(1.6, 0.5, false);
    assert_true(orca < near - 0.05 && near < far - 0.1);
}

static void the_keen_follow_more_closely_than_the_calm(void **state) {
    (void)state;
    double calm = apart(1.5, 0.0, false), keen = apart(1.5, 1.0, false);
    assert_true(keen < calm - 0.1);
}

static void parameters_by_name_do_the_same(void **state) {
    (void)state;
    assert_true(apart(1.2, 0.2, true) == apart(1.2, 0.2, false));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(longer_time_gap_keeps_farther_behind),
        cmocka_unit_test(the_keen_follow_more_closely_than_the_calm),
        cmocka_unit_test(parameters_by_name_do_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
