/* Tests of reloads of machines whose states run machines: people stay where they are, with their
 * clocks and the states to go back to. */
#include "unit/scene_loader.h"

#define ONE "jostle: 1\ngroups: {p: {behaviour: own.lua, at: [[0, 0]]}}\n"
/* A machine whose state `outer` runs one with the states `first` and B. */
#define NESTED(outer, first, more)                                                                 \
    "local mine = memory { log = 0 }\n" MACHINE_START "\"A\", " more " states = {\n"               \
    "A = { { to = \"" outer "\", when = after(0.2) } },\n" outer                                   \
    " = { { to = \"Stop\", when = after(1) }, runs = machine { start = \"" first                   \
    "\", states = {\n" first " = { { to = \"B\", when = after(0.4) } },\n"                         \
    "B = { { to = back, when = after(0.3) } } } } },\n"                                            \
    "Stop = { { to = back, when = after(0.2) } } } }\n"

static const char *state_name(const JoScene *scene) {
    const JoxAgents *a = &scene->world->state.agents;
    return scene->world->machines.set->items[a->machine[0]]->states[a->state[0]].name;
}

static void run_to(JoScene *scene, int steps, const char *state) {
    step_scene(scene, steps);
    assert_string_equal(state_name(scene), state);
}

static void people_stay_in_inner_states_with_all_clocks(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(ONE, NESTED("Guard", "W", ""));
    run_to(scene, 5, "Guard.W");
    run_to(scene, 9, "Guard.B"); /* 0.4 s later */
    assert_true(reload_behaviour(scene, 0, NESTED("Guard", "W", "defaults = { push = 9 },")));
    assert_string_equal(state_name(scene), "Guard.B");
    run_to(scene, 6, "Guard.W"); /* goes back after 0.3 s, whatever was reloaded */
    assert_true(reload_behaviour(scene, 0, NESTED("Guard", "W", "")));
    run_to(scene, 6, "Stop"); /* 1 s after it entered Guard */
    assert_true(reload_behaviour(scene, 0, NESTED("Guard", "W", "")));
    run_to(scene, 5, "Guard.W"); /* back to where it was */
    jo_scene_free(scene);
}

static void outer_and_inner_states_are_renamed_together(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(ONE, NESTED("Guard", "W", ""));
    run_to(scene, 14, "Guard.B");
    assert_false(reload_behaviour(scene, 0, NESTED("Watch", "W", "")));
    assert_non_null(strstr(refusal, "renamed = { [\"Guard.B\"] ="));
    assert_true(
        reload_behaviour(scene, 0, NESTED("Watch", "W", "renamed = { Guard = \"Watch\" },")));
    assert_string_equal(state_name(scene), "Watch.B");
    assert_true(reload_behaviour(
        scene, 0,
        NESTED("Watch", "S", "renamed = { Guard = \"Watch\", [\"Watch.W\"] = \"Watch.S\" },")));
    assert_string_equal(state_name(scene), "Watch.B");
    run_to(scene, 6, "Watch.S"); /* the state to go back to is kept by its new name */
    jo_scene_free(scene);
}

static void inner_machine_renames_its_own_states(void **state) {
    (void)state;
#define RUNS(outer, inner, states)                                                                 \
    MACHINE_START "\"" outer "\", " states " states = { " outer                                    \
                  " = { runs = machine { start = \"" inner "\", renamed = { One = \"Two\" }, "     \
                  "states = { " inner " = { steer = hold } } } } } }\n"
    JoScene *scene = load_scene_text(ONE, RUNS("A", "One", ""));
    run_to(scene, 1, "A.One");
    assert_true(reload_behaviour(scene, 0, RUNS("B", "Two", "renamed = { A = \"B\" },")));
    assert_string_equal(state_name(scene), "B.Two");
    jo_scene_free(scene);
}

static void state_that_begins_to_run_a_machine_goes_on_at_its_start(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(ONE, MACHINE_START "\"A\", states = { A = { steer = hold } } }\n");
    step_scene(scene, 10);
    assert_true(reload_behaviour(scene, 0,
                                 MACHINE_START
                                 "\"A\", states = { A = { runs = machine { start = \"I\", states = "
                                 "{ I = { steer = hold } } }, { to = \"C\", when = after(0.6) } }, "
                                 "C = { steer = hold } } }\n"));
    assert_string_equal(state_name(scene), "A.I");
    run_to(scene, 1, "A.I");
    run_to(scene, 3, "C"); /* the time in A counts from when it entered A */
    jo_scene_free(scene);
}

static void put_into(JoScene *scene, const char *name) {
    JoxMachineRun *run = &scene->world->machines;
    const JoxMachine *machine = run->set->items[0];
    const int state = jox_machine_entry(machine, name);
    assert_true(state >= 0);
    jox_machines_set_state(run, 0, (uint16_t)state);
}

static void people_put_into_a_state_enter_all_levels(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(ONE, NESTED("Guard", "W", ""));
    step_scene(scene, 1);
    put_into(scene, "Guard.B");
    assert_string_equal(state_name(scene), "Guard.B");
    run_to(scene, 8, "Guard.W"); /* nothing to go back to: where the machine begins */
    put_into(scene, "Guard");
    assert_string_equal(state_name(scene), "Guard.W");
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(people_stay_in_inner_states_with_all_clocks),
        cmocka_unit_test(outer_and_inner_states_are_renamed_together),
        cmocka_unit_test(inner_machine_renames_its_own_states),
        cmocka_unit_test(state_that_begins_to_run_a_machine_goes_on_at_its_start),
        cmocka_unit_test(people_put_into_a_state_enter_all_levels)};
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
