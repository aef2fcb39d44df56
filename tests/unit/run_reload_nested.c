/* Tests of reloads of machines whose states run machines: people stay where they are, with their
 * clocks and the states to go back to. */
#include "jostle_tools.h"
#include "unit/assert_near.h"
#include "unit/scene_loader.h"

static void apply_line(JoScene *scene, const char *line) {
    JoError error;
    if (!jo_scene_input(scene, line, &error))
        fail_msg("%s", error.text);
}

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

static void check_parameter(const JoScene *scene, const char *name, double value) {
    const int p = jox_parameter_find(name);
    assert_near(jox_parameter_value((JoxParameter)p, jox_param(&scene->world->state.agents, p, 0)),
                value, 1e-6);
}

static void input_sets_parameters_of_outer_states(void **state) {
    (void)state;
    static const char MACHINE[] =
        "local mine = memory { log = 0 }\n" MACHINE_START "\"Guard\", states = {\n"
        "Guard = { push = 20, { to = \"Stop\", when = after(1) },\n"
        "  runs = machine { start = \"W\", defaults = { perception = 4 }, states = {\n"
        "    W = { { to = \"B\", when = after(0.4) } },\n"
        "    B = { speed = 0.9 } } } },\n"
        "Stop = {} } }\n";
    JoScene *scene = load_scene_text(ONE, MACHINE);
    JoError error;
    run_to(scene, 2, "Guard.W");
    check_parameter(scene, "push", 20);
    apply_line(scene, "set m Guard push 33");
    apply_line(scene, "set m Guard perception 3"); /* the inner machine's defaults come after it */
    apply_line(scene, "set m Guard speed 0.5");
    apply_line(scene, "set m Guard.W horizon 0.7"); /* set within first, it stays */
    apply_line(scene, "set m Guard horizon 0.9");
    check_parameter(scene, "push", 33);
    check_parameter(scene, "perception", 3);
    check_parameter(scene, "speed", 0.5);
    check_parameter(scene, "horizon", 0.7);
    run_to(scene, 9, "Guard.B");
    check_parameter(scene, "push", 33);
    check_parameter(scene, "speed", 0.9); /* sets it itself */
    check_parameter(scene, "horizon", 0.9);
    char *json = jo_scene_inspect(scene, 0);
    assert_non_null(strstr(json, "\"set\": \"program or page\""));
    jo_free(json);
    assert_false(jo_scene_input(scene, "set m Gard push 1", &error));
    assert_non_null(strstr(error.text, "Did you mean 'Guard'?"));
    run_to(scene, 12, "Stop");
    check_parameter(scene, "push", 0);
    assert_true(reload_behaviour(scene, 0, MACHINE)); /* ends what was set */
    put_into(scene, "Guard");
    check_parameter(scene, "push", 20);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(people_stay_in_inner_states_with_all_clocks),
        cmocka_unit_test(outer_and_inner_states_are_renamed_together),
        cmocka_unit_test(inner_machine_renames_its_own_states),
        cmocka_unit_test(state_that_begins_to_run_a_machine_goes_on_at_its_start),
        cmocka_unit_test(people_put_into_a_state_enter_all_levels),
        cmocka_unit_test(input_sets_parameters_of_outer_states)};
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
