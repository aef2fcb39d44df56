/* Behaviour hardly depends on the length of the world's step: ways, times of plans, and how an
   agent that pushes passes another straight ahead. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "world/world.h"

static const double STEPS[] = {0.1, 0.05, 0.025, 0.0125, 0.00625};
enum { STEP_COUNT = 5 };

static JoWorld *make(double dt, bool forces) {
    JoWorldDef def = jo_default_world_def();
    def.dt = dt;
    def.forces = forces;
    return jo_world_create(&def, NULL);
}

static JoAgent add(JoWorld *w, double x, double y, double push) {
    JoAgentDef def = jo_default_agent_def();
    def.x = x;
    def.y = y;
    def.push = push;
    const JoAgent one = jo_world_add_agent(w, &def, NULL);
    jo_agent_set_parameter(w, one, "breadth", 2.0 * def.radius, NULL); /* a disc */
    jo_agent_set_parameter(w, one, "depth", 2.0 * def.radius, NULL);
    return one;
}

static void run(JoWorld *w, double seconds) {
    jo_world_step(w, (uint32_t)(seconds / w->model.def.dt + 0.5));
}

/* Feet approach 1.3 m/s with a time constant of 0.05 s, so whoever starts from rest is behind by
   1.3 * 0.05 m for good; and who stops goes on as far. */
static void planned_way_does_not_depend_on_step(void **state) {
    (void)state;
    for (int k = 0; k < STEP_COUNT; k++) {
        JoWorld *w = make(STEPS[k], true);
        JoAgent one = add(w, 0, 0, 0);
        jo_agent_set_preferred(w, one, 1.3, 0);
        run(w, 1.0);
        assert_true(fabs(jo_agent_state(w, one).x - 1.3 * 0.95) < 1e-4);
        jo_agent_set_preferred(w, one, 0, 0);
        run(w, 1.0);
        assert_true(fabs(jo_agent_state(w, one).x - 1.3) < 1e-4);
        jo_world_free(w);
    }
}

/* Standing agents step aside equally far at any length of step, as they plan equally often. */
static void standing_agents_give_way_alike(void **state) {
    (void)state;
    double aside[STEP_COUNT];
    for (int k = 0; k < STEP_COUNT; k++) {
        JoWorld *w = make(STEPS[k], false);
        JoAgent stands = add(w, 0, 0, 0), walks = add(w, -3, 0.1, 0);
        jo_agent_set_preferred(w, walks, 1.3, 0);
        run(w, 4.0);
        aside[k] = jo_agent_state(w, stands).y;
        assert_true(jo_agent_state(w, walks).x > 1.0); /* past */
        assert_true(aside[k] < -0.1);
        assert_true(fabs(aside[k] - aside[0]) < 1e-3);
        jo_world_free(w);
    }
}

/* Straight behind somebody who stands, who pushes gets past on the right and does not drive them
   along. */
static void agent_that_pushes_passes_one_ahead(void **state) {
    (void)state;
    for (int k = 0; k < STEP_COUNT; k++) {
        JoWorld *w = make(STEPS[k], true);
        JoAgent stands = add(w, 0, 0, 0), pushes = add(w, -2, 0, 250);
        jo_agent_set_parameter(w, pushes, "horizon", 0.2, NULL);
        jo_agent_set_parameter(w, stands, "horizon", 0.2, NULL);
        jo_agent_set_preferred(w, pushes, 1.6, 0);
        run(w, 8.0);
        JoAgentState ahead = jo_agent_state(w, stands), past = jo_agent_state(w, pushes);
        assert_true(past.x > ahead.x + 0.4 && past.y < ahead.y);
        assert_true(ahead.x < 2.0); /* m; driven on for all of the eight seconds it were 11 */
        jo_world_free(w);
    }
}

/* Straight at a wall nobody is turned aside: what they are slowed down by presses them against the
   wall, and may not throw them along it. */
static void agent_that_walks_at_wall_stays(void **state) {
    (void)state;
    static const double ends[] = {2, -20, 2, 20};
    for (int k = 0; k < 4 * STEP_COUNT; k++) {
        JoWorld *w = make(STEPS[k / 4], true);
        assert_true(jo_world_add_line(w, ends, 2, NULL));
        JoAgent one = add(w, 0, 0, 0);
        if (k % 2)
            jo_agent_set_parameter(w, one, "time_gap", 0.5, NULL);
        jo_agent_set_preferred(w, one, k / 2 % 2 ? 1.3 : 0.3, 0);
        for (int second = 0; second < 12; second++) {
            run(w, 1.0);
            JoAgentState at = jo_agent_state(w, one);
            assert_true(at.x < 2.0 && fabs(at.y) < 0.02 && fabs(at.vy) < 0.02);
        }
        assert_true(jo_agent_state(w, one).x > 1.75);
        jo_world_free(w);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planned_way_does_not_depend_on_step),
        cmocka_unit_test(standing_agents_give_way_alike),
        cmocka_unit_test(agent_that_pushes_passes_one_ahead),
        cmocka_unit_test(agent_that_walks_at_wall_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
