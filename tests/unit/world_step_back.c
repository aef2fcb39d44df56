/* Agents that stand step back to where they stood before a force moved them
   (nav/step_back_lanes.h): how far, when, and when not. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "world/world.h"

static const double STEPS[] = {0.1, 0.05, 0.02, 0.01};
enum { STEP_COUNT = 4 };

static JoWorld *make_world(double dt) {
    JoWorldDef def = jo_default_world_def();
    def.dt = dt;
    return jo_world_create(&def, NULL);
}

static JoAgent add_agent(JoWorld *w, double x) {
    JoAgentDef def = jo_default_agent_def();
    def.x = x;
    return jo_world_add_agent(w, &def, NULL);
}

static double find_x(const JoWorld *w, JoAgent one) {
    return jo_agent_state(w, one).x;
}

static void run(JoWorld *w, double seconds) {
    jo_world_step(w, (uint32_t)(seconds / w->model.def.dt + 0.5));
}

/* Pushes an agent to +x for a second. Returns where it comes to rest, m. */
static double push_agent(JoWorld *w, JoAgent one, double force) {
    double peak = find_x(w, one);
    for (int step = 0; step < (int)(1.0 / w->model.def.dt + 0.5); step++) {
        jo_agent_apply_force(w, one, force, 0);
        jo_world_step(w, 1);
        peak = fmax(peak, find_x(w, one));
    }
    return peak;
}

/* A push of 0.3 m: the agent stays for the time of its reaction, goes back at no more than its
   speed, and ends behind where it stood, by some 0.3 of the way. */
static void pushed_agent_steps_back(void **state) {
    (void)state;
    for (int k = 0; k < STEP_COUNT; k++) {
        JoWorld *w = make_world(STEPS[k]);
        JoAgent one = add_agent(w, 0);
        double x = push_agent(w, one, 75);
        const double peak = x;
        assert_true(peak > 0.25 && peak < 0.35);
        run(w, 0.2);
        assert_true(find_x(w, one) >= peak - 1e-6);
        for (int tenth = 0; tenth < 100; tenth++) {
            run(w, 0.1);
            const double now = find_x(w, one);
            assert_true(x - now < 0.1 * 0.11 + 1e-3);
            x = now;
        }
        assert_true(x < -0.1 * peak && x > -0.32 * peak);
        run(w, 5.0);
        assert_true(fabs(find_x(w, one) - x) < 1e-3);
        jo_world_free(w);
    }
}

/* With the parameter 0 it stays where the push left it. */
static void agent_without_steps_stays(void **state) {
    (void)state;
    JoWorld *w = make_world(0.05);
    JoAgent one = add_agent(w, 0);
    jo_agent_set_parameter(w, one, "step_back", 0, NULL);
    const double peak = push_agent(w, one, 120);
    run(w, 10.0);
    assert_true(find_x(w, one) >= peak - 1e-3);
    jo_world_free(w);
}

/* Pushed by two metres, it goes back by one at most. */
static void far_displacement_is_left(void **state) {
    (void)state;
    JoWorld *w = make_world(0.05);
    JoAgent one = add_agent(w, 0);
    const double peak = push_agent(w, one, 700);
    assert_true(peak > 1.5);
    run(w, 20.0);
    assert_true(find_x(w, one) > peak - 1.05 && find_x(w, one) < peak - 0.5);
    jo_world_free(w);
}

/* An agent that walks has no place to step back to, pushed or not. */
static void agent_that_walked_stays_where_it_stops(void **state) {
    (void)state;
    JoWorld *w = make_world(0.05);
    JoAgent one = add_agent(w, 0);
    jo_agent_set_preferred(w, one, 1.0, 0);
    push_agent(w, one, 120);
    run(w, 1.0);
    jo_agent_set_preferred(w, one, 0, 0);
    run(w, 1.0);
    const double x = find_x(w, one);
    run(w, 5.0);
    assert_true(fabs(find_x(w, one) - x) < 1e-4);
    jo_world_free(w);
}

/* It does not drive away an agent that has taken its place. */
static void taken_place_is_not_retaken(void **state) {
    (void)state;
    for (int k = 0; k < STEP_COUNT; k++) {
        JoWorld *w = make_world(STEPS[k]);
        JoAgent one = add_agent(w, 0);
        push_agent(w, one, 300);
        JoAgent other = add_agent(w, 0);
        run(w, 15.0);
        assert_true(fabs(find_x(w, other)) < 0.02);
        assert_true(find_x(w, one) > 0.38 && find_x(w, one) < 0.6);
        jo_world_free(w);
    }
}

/* It looks where it looked, and its chest stays where it points, whichever way it is moved. */
static void agent_that_steps_back_keeps_its_face(void **state) {
    (void)state;
    JoWorld *w = make_world(0.05);
    JoAgent one = add_agent(w, 0);
    jo_agent_set_parameter(w, one, "breadth", 0.45, NULL);
    jo_agent_set_parameter(w, one, "depth", 0.25, NULL);
    const double peak = push_agent(w, one, -75);
    run(w, 2.0);
    assert_true(find_x(w, one) > peak - 0.35 && w->state.agents.face_x[0] == 1.0f);
    assert_true(fabsf(w->state.agents.chest_y[0]) < 0.01f);
    jo_world_free(w);
}

/* A step that is divided knows of no force but its own: agents whom a force moved in the step
   before, and that stop now, go on alike in the world and in one restored from it. */
static void stop_after_a_push_goes_on_alike_when_restored(void **state) {
    (void)state;
    enum { PEOPLE = 5 };
    uint64_t hashes[2];
    size_t size;
    JoAgent row[PEOPLE];
    JoWorld *w = make_world(0.2);
    for (int i = 0; i < PEOPLE; i++) {
        row[i] = add_agent(w, 0.45 * i);
        jo_agent_set_preferred(w, row[i], 1.0, 0);
    }
    jo_world_step(w, 3);
    for (int i = 0; i < PEOPLE; i++)
        jo_agent_apply_force(w, row[i], i ? 1 : 300, 0);
    jo_world_step(w, 1);
    void *snapshot = jo_world_snapshot(w, &size, NULL);
    for (int restored = 0; restored < 2; restored++) {
        if (restored)
            assert_true(jo_world_restore(w, snapshot, size, NULL));
        for (int i = 0; i < PEOPLE; i++)
            jo_agent_set_preferred(w, row[i], 0, 0);
        jo_world_step(w, 1);
        hashes[restored] = jo_world_hash(w);
    }
    assert_true(hashes[0] == hashes[1]);
    jo_free(snapshot);
    jo_world_free(w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pushed_agent_steps_back),
        cmocka_unit_test(agent_without_steps_stays),
        cmocka_unit_test(far_displacement_is_left),
        cmocka_unit_test(agent_that_walked_stays_where_it_stops),
        cmocka_unit_test(taken_place_is_not_retaken),
        cmocka_unit_test(agent_that_steps_back_keeps_its_face),
        cmocka_unit_test(stop_after_a_push_goes_on_alike_when_restored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
