/* Falls (world/falls.c): who loses balance and who does not, how the fallen lie and get up. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "simd/isa.h"
#include "world/world.h"

static const double STEPS[] = {0.05, 0.02, 0.01};
enum { STEP_COUNT = 3 };

/* m: the step of a young adult: sin 30.7 degrees times 1 m. */
static const double BALANCE = 0.51;

static JoWorld *make_world(double dt) {
    JoWorldDef def = jo_default_world_def();
    def.dt = dt;
    return jo_world_create(&def, NULL);
}

/* Adds an agent that faces +x and may fall. */
static JoAgent add_agent(JoWorld *w, double x, double y) {
    JoAgentDef def = jo_default_agent_def();
    def.x = x;
    def.y = y;
    const JoAgent one = jo_world_add_agent(w, &def, NULL);
    jo_agent_set_parameter(w, one, "balance", BALANCE, NULL);
    jo_agent_set_parameter(w, one, "breadth", 0.45, NULL);
    jo_agent_set_parameter(w, one, "depth", 0.25, NULL);
    return one;
}

static void run(JoWorld *w, double seconds) {
    jo_world_step(w, (uint32_t)(seconds / w->model.def.dt + 0.5));
}

static bool lies(const JoWorld *w, JoAgent one) {
    const JoxAgents *a = &w->state.agents;
    return a->fallen[a->slot_index[one.slot]] > 0.0f;
}

/* Pushes an agent along x. */
static void push(JoWorld *w, JoAgent one, double force, double seconds) {
    for (int step = 0; step < (int)(seconds / w->model.def.dt + 0.5); step++) {
        jo_agent_apply_force(w, one, force, 0);
        jo_world_step(w, 1);
    }
}

/* An impulse that gives 1 m/s is stepped off, one that gives 2.2 m/s is not: the limit is 0.51 m
   times 3.13 1/s, 1.6 m/s. Older women step 0.28 m (16.2 degrees). */
static void hard_push_throws_down(void **state) {
    (void)state;
    for (int k = 0; k < STEP_COUNT; k++) {
        JoWorld *w = make_world(STEPS[k]);
        JoAgent one = add_agent(w, 0, 0), other = add_agent(w, 0, 5), old = add_agent(w, 0, 10);
        jo_agent_set_parameter(w, old, "balance", 0.28, NULL);
        for (int step = 0; step < (int)(0.1 / STEPS[k] + 0.5); step++) {
            jo_agent_apply_force(w, one, 700, 0);
            jo_agent_apply_force(w, other, 1800, 0);
            jo_agent_apply_force(w, old, 1000, 0);
            jo_world_step(w, 1);
        }
        run(w, 0.2);
        assert_false(lies(w, one));
        assert_true(lies(w, other) && lies(w, old));
        assert_int_equal(w->state.statistics.falls, 2);
        assert_int_equal(w->state.statistics.most_fallen, 2);
        jo_world_free(w);
    }
}

static void nobody_falls_by_default(void **state) {
    (void)state;
    JoWorld *w = make_world(0.05);
    JoAgent one = add_agent(w, 0, 0);
    jo_agent_set_parameter(w, one, "balance", 0, NULL);
    push(w, one, 3000, 0.3);
    run(w, 1.0);
    assert_false(lies(w, one));
    jo_world_free(w);
}

/* An agent that runs, and stops, is not thrown. */
static void own_motion_throws_nobody(void **state) {
    (void)state;
    JoWorld *w = make_world(0.05);
    JoAgent one = add_agent(w, 0, 0);
    jo_agent_set_parameter(w, one, "max_speed", 6, NULL);
    jo_agent_set_preferred(w, one, 5.0, 0);
    run(w, 2.0);
    jo_agent_set_preferred(w, one, 0, 0);
    run(w, 2.0);
    assert_int_equal(w->state.statistics.falls, 0);
    jo_world_free(w);
}

/* The fallen lies still, whatever it wants, for `rise` seconds, and then goes on. */
static void fallen_gets_up(void **state) {
    (void)state;
    JoWorld *w = make_world(0.05);
    JoAgent one = add_agent(w, 0, 0);
    push(w, one, 2000, 0.1);
    run(w, 0.5);
    assert_true(lies(w, one));
    const double x = jo_agent_state(w, one).x;
    for (int step = 0; step < 60; step++) {
        jo_agent_set_preferred(w, one, 1.0, 0);
        run(w, 0.05);
    }
    assert_true(lies(w, one) && fabs(jo_agent_state(w, one).x - x) < 0.02);
    for (int step = 0; step < 60; step++) {
        jo_agent_set_preferred(w, one, 1.0, 0);
        run(w, 0.05);
    }
    assert_true(!lies(w, one) && jo_agent_state(w, one).x > x + 0.5);
    jo_world_free(w);
}

/* A program hears of a fall, and of getting up, once each. */
static void falls_are_told(void **state) {
    (void)state;
    JoWorld *w = make_world(0.05);
    JoAgent one = add_agent(w, 0, 0);
    int falls = 0, rises = 0;
    add_agent(w, 0, 3);
    for (int step = 0; step < 140; step++) {
        jo_agent_apply_force(w, one, step < 2 ? 2000 : 0, 0);
        jo_world_step(w, 1);
        const JoEvents e = jo_world_events(w);
        for (uint32_t k = 0; k < e.action_count; k++) {
            assert_int_equal(e.actions[k].agent, 0);
            falls += e.actions[k].kind == JO_DONE_FALL && lies(w, one);
            rises += e.actions[k].kind == JO_DONE_RISE && !lies(w, one);
        }
    }
    assert_int_equal(falls, 1);
    assert_int_equal(rises, 1);
    jo_world_free(w);
}

/* An agent that is pressed onto one that lies falls, too, as its feet are stopped; one that stands
   holds it up. */
static void pressed_agent_falls_onto_the_fallen(void **state) {
    (void)state;
    for (int k = 0; k < STEP_COUNT * 2; k++) {
        const double walls[2][4] = {{-3, 0.26, 3, 0.26}, {-3, -0.26, 3, -0.26}};
        JoWorld *w = make_world(STEPS[k / 2]);
        for (int side = 0; side < 2; side++)
            assert_true(jo_world_add_line(w, walls[side], 2, NULL));
        JoAgent ahead = add_agent(w, 0, 0);
        if (k % 2)
            push(w, ahead, 2000, 0.1);
        run(w, 0.4);
        const double x = jo_agent_state(w, ahead).x;
        JoAgent middle = add_agent(w, x - 0.27, 0);
        push(w, middle, 150, 0.8);
        assert_true(lies(w, ahead) == (k % 2 == 1));
        assert_true(lies(w, middle) == (k % 2 == 1));
        jo_world_free(w);
    }
}

/* Walkers come round one who lies. */
static void walkers_step_round_the_fallen(void **state) {
    (void)state;
    JoWorld *w = make_world(0.05);
    JoAgent fallen = add_agent(w, 0, 0);
    jo_agent_set_parameter(w, fallen, "rise", 60, NULL);
    push(w, fallen, 2000, 0.1);
    JoAgent walker = add_agent(w, -4, 0.05);
    for (int step = 0; step < 200; step++) {
        jo_agent_set_preferred(w, walker, 1.2, 0);
        run(w, 0.05);
    }
    assert_true(lies(w, fallen) && !lies(w, walker));
    assert_true(jo_agent_state(w, walker).x > 2.0);
    jo_world_free(w);
}

/* Fills a world with 240 people in a dense block, of whom those behind are pushed forward, and
 * those ahead thrown. */
static JoWorld *make_crowd(JoIsa isa, uint32_t threads) {
    JoWorldDef def = jo_default_world_def();
    def.dt = 0.05;
    def.isa = isa;
    def.threads = threads;
    JoWorld *w = jo_world_create(&def, NULL);
    for (int n = 0; n < 240; n++)
        add_agent(w, -0.35 * (n / 10), 0.5 * (n % 10));
    return w;
}

static void press_crowd(JoWorld *w, int steps) {
    for (int step = 0; step < steps; step++) {
        const JoxAgents *a = &w->state.agents;
        for (uint32_t id = 0; id < 240; id++) {
            const uint32_t i = jox_agents_find(a, id);
            w->state.agents.ext_x[i] += id >= 40 ? 100.0f : 0.0f;
            w->state.agents.ext_x[i] += id < 10 && w->state.tick < 2 ? 2500.0f : 0.0f;
        }
        jo_world_step(w, 1);
    }
}

/* Falls are the same on all instruction sets and any number of threads, and after a restore. */
static void falls_are_reproducible(void **state) {
    (void)state;
    JoWorld *first = make_crowd(JO_ISA_SCALAR, 1);
    press_crowd(first, 60);
    const uint64_t falls = first->state.statistics.falls;
    assert_true(falls > 20);
    for (JoIsa isa = JO_ISA_SCALAR; isa <= JO_ISA_NEON; isa++) {
        if (!jox_isa_runs(isa))
            continue;
        JoWorld *w = make_crowd(isa, 3);
        press_crowd(w, 60);
        assert_true(jo_world_hash(w) == jo_world_hash(first));
        jo_world_free(w);
    }
    JoWorld *saved = make_crowd(JO_ISA_SCALAR, 1);
    press_crowd(saved, 30);
    size_t size;
    void *snapshot = jo_world_snapshot(saved, &size, NULL);
    press_crowd(saved, 30);
    assert_true(jo_world_restore(saved, snapshot, size, NULL));
    press_crowd(saved, 30);
    assert_true(jo_world_hash(saved) == jo_world_hash(first));
    jo_free(snapshot);
    jo_world_free(saved);
    jo_world_free(first);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hard_push_throws_down),
        cmocka_unit_test(nobody_falls_by_default),
        cmocka_unit_test(own_motion_throws_nobody),
        cmocka_unit_test(fallen_gets_up),
        cmocka_unit_test(falls_are_told),
        cmocka_unit_test(pressed_agent_falls_onto_the_fallen),
        cmocka_unit_test(walkers_step_round_the_fallen),
        cmocka_unit_test(falls_are_reproducible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
