/* Periodic edges: a crowd across the seam moves as one in the middle, and no agent is lost. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "world/world.h"

enum { PEOPLE = 40 };

static JoWorld *make_seam_world(float period_x, float shift, JoAgent *people) {
    JoWorldDef def = jo_default_world_def();
    def.dt = 0.05;
    JoWorld *w = jo_world_create(&def, NULL);
    w->state.agents.period = (JoxV2){period_x, 0.0f};
    for (int i = 0; i < PEOPLE; i++) {
        JoAgentDef a = jo_default_agent_def();
        a.x = fmod(8.0 + 0.5 * (i % 8) + 0.07 * (i / 8) + shift, period_x > 0 ? period_x : 1e9);
        a.y = 0.5 * (i / 8) + 0.05 * (i * 7 % 5); /* no agent is exactly ahead of another */
        people[i] = jo_world_add_agent(w, &a, NULL);
        /* two halves walk against each other */
        jo_agent_set_preferred(w, people[i], i % 8 < 4 ? 1.3 : -1.3, 0.0);
    }
    return w;
}

/* The same crowd in the middle of the period and across its seam keeps the same relative
   positions. */
static void crowd_across_the_seam_moves_as_in_the_middle(void **state) {
    (void)state;
    JoAgent middle[PEOPLE], seam[PEOPLE];
    JoWorld *a = make_seam_world(16.0f, 0.0f, middle), *b = make_seam_world(16.0f, 6.0f, seam);
    for (int step = 0; step < 24; step++) {
        jo_world_step(a, 1);
        jo_world_step(b, 1);
    }
    for (int i = 0; i < PEOPLE; i++) {
        JoAgentState p = jo_agent_state(a, middle[i]), q = jo_agent_state(b, seam[i]);
        double dx = fmod(q.x - p.x - 6.0 + 32.0, 16.0);
        assert_true(fmin(dx, 16.0 - dx) < 0.01); /* float sums differ between places */
        assert_true(fabs(p.y - q.y) < 0.01);
        assert_true(q.x >= 0.0 && q.x < 16.0);
    }
    jo_world_free(a);
    jo_world_free(b);
}

/* Without the period the same crowd does not meet, so that the test above can fail. */
static void crowd_moves_differently_without_a_period(void **state) {
    (void)state;
    JoAgent middle[PEOPLE], open[PEOPLE];
    JoWorld *a = make_seam_world(16.0f, 0.0f, middle), *b = make_seam_world(16.0f, 6.0f, open);
    b->state.agents.period = (JoxV2){0.0f, 0.0f};
    jo_world_step(a, 60);
    jo_world_step(b, 60);
    double farthest = 0.0;
    for (int i = 0; i < PEOPLE; i++) {
        double dx =
            fmod(jo_agent_state(b, open[i]).x - jo_agent_state(a, middle[i]).x - 6.0 + 32.0, 16.0);
        farthest = fmax(farthest, fmin(dx, 16.0 - dx));
    }
    assert_true(farthest > 0.5);
    jo_world_free(a);
    jo_world_free(b);
}

/* One walker goes round and round, and its velocity never jumps. */
static void walker_goes_round_the_period(void **state) {
    (void)state;
    JoWorldDef def = jo_default_world_def();
    JoWorld *w = jo_world_create(&def, NULL);
    w->state.agents.period = (JoxV2){5.0f, 3.0f};
    JoAgentDef one = jo_default_agent_def();
    one.x = 1.0;
    one.y = 1.0;
    JoAgent walker = jo_world_add_agent(w, &one, NULL);
    jo_agent_set_preferred(w, walker, 1.0, -0.5);
    jo_world_step(w, 1000); /* 50 s: 50 m along x, 25 m back along y, less while it speeds up */
    JoAgentState s = jo_agent_state(w, walker);
    assert_true(fabs(s.x - 1.0) < 0.06 || fabs(s.x - 6.0) < 0.06);
    assert_true(fabs(s.y - 0.0) < 0.06 ||
                fabs(s.y - 3.0) < 0.06); /* 1 - 25 = -24, a multiple of 3 */
    assert_true(fabs(s.vx - 1.0) < 1e-3 && fabs(s.vy + 0.5) < 1e-3);
    assert_true(s.y >= 0.0 && s.y < 3.0 && s.x >= 0.0 && s.x < 5.0);
    jo_world_free(w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crowd_across_the_seam_moves_as_in_the_middle),
        cmocka_unit_test(crowd_moves_differently_without_a_period),
        cmocka_unit_test(walker_goes_round_the_period),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
