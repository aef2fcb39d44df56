/* Misuse of the public interface: null and stale handles, defs made by hand, numbers out of range.
   Each must answer harmlessly and be reported. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "jostle_tools.h"

static int reports;

static void count_report(const char *condition, const char *file, int line) {
    (void)condition;
    (void)file;
    (void)line;
    reports++;
}

static int set_up(void **state) {
    reports = 0;
    jo_set_assert_handler(count_report);
    JoWorldDef def = jo_default_world_def();
    *state = jo_world_create(&def, NULL);
    return *state ? 0 : -1;
}

static int tear_down(void **state) {
    jo_world_free(*state);
    jo_set_assert_handler(NULL);
    return 0;
}

static void null_worlds_are_reported_and_harmless(void **state) {
    (void)state;
    JoAgentDef agent = jo_default_agent_def();
    jo_world_step(NULL, 3);
    assert_true(jo_world_add_agent(NULL, &agent, NULL).generation == 0);
    assert_int_equal(jo_world_agent_count(NULL), 0);
    assert_true(jo_world_hash(NULL) == 0);
    assert_true(jo_world_time(NULL) == 0.0);
    assert_false(jo_agent_is_live(NULL, (JoAgent){1, 1}));
    assert_int_equal(reports, 6);
    jo_world_free(NULL);
    assert_int_equal(reports, 6);
}

static void defs_must_come_from_their_default(void **state) {
    JoWorldDef world = {.dt = 0.05, .threads = 1};
    assert_null(jo_world_create(&world, NULL));
    JoAgentDef agent = {.radius = 0.2};
    assert_true(jo_world_add_agent(*state, &agent, NULL).generation == 0);
    JoBodyDef body = {.mass = 1};
    assert_true(jo_world_add_body(*state, &body, NULL).generation == 0);
    JoSceneDef scene = {.path = "x.yaml"};
    assert_null(jo_scene_load(&scene, NULL));
    JoReportDef report = jo_default_report_def();
    assert_null(jo_report(&report, NULL)); /* of no recording */
    report.recording = "x";
    report.fps = -1;
    assert_null(jo_report(&report, NULL));
    assert_null(jo_report(&(JoReportDef){.recording = "x"}, NULL)); /* not of the default */
    assert_null(jo_report(NULL, NULL));
    JoRenderDef render = jo_default_render_def();
    assert_false(jo_render(&render, NULL)); /* of nothing, to nowhere */
    render.recording = "x";
    assert_false(jo_render(&render, NULL));
    render.out = "x.svg";
    JoSceneDef both = jo_default_scene_def();
    render.scene = &both;
    assert_false(jo_render(&render, NULL));
    render = (JoRenderDef){.recording = "x", .out = "x.svg"}; /* not of the default */
    assert_false(jo_render(&render, NULL));
    assert_false(jo_render(NULL, NULL));
    JoViewRecordingDef view = jo_default_view_recording_def();
    assert_false(jo_view_recording(&view, NULL)); /* of no recording */
    view.recording = "x";
    view.fps = -1;
    assert_false(jo_view_recording(&view, NULL));
    assert_false(jo_view_recording(&(JoViewRecordingDef){.recording = "x"}, NULL));
    assert_false(jo_view_recording(NULL, NULL));
    assert_int_equal(reports, 17);
}

static void numbers_out_of_range_are_refused_by_name(void **state) {
    const double wrong[] = {NAN, INFINITY, -1.0, 1e300};
    for (int i = 0; i < 4; i++) {
        JoError error = {0};
        JoWorldDef world = jo_default_world_def();
        world.dt = wrong[i];
        assert_null(jo_world_create(&world, &error));
        assert_int_equal(error.code, JO_INPUT);
        assert_non_null(strstr(error.text, "dt"));
        JoAgentDef agent = jo_default_agent_def();
        agent.mass = wrong[i];
        assert_true(jo_world_add_agent(*state, &agent, &error).generation == 0);
        assert_non_null(strstr(error.text, "mass"));
        agent = jo_default_agent_def();
        agent.time_gap = wrong[i];
        assert_true(jo_world_add_agent(*state, &agent, &error).generation == 0);
        assert_non_null(strstr(error.text, "time_gap"));
        agent = jo_default_agent_def();
        agent.haste = i == 0 ? 1.5 : wrong[i];
        assert_true(jo_world_add_agent(*state, &agent, &error).generation == 0);
        assert_non_null(strstr(error.text, "haste"));
        agent = jo_default_agent_def();
        agent.x = i == 2 ? -1e9 : wrong[i];
        assert_true(jo_world_add_agent(*state, &agent, &error).generation == 0);
    }
    JoWorldDef zero = jo_default_world_def();
    zero.dt = 0.0;
    assert_null(jo_world_create(&zero, NULL));
    assert_int_equal(jo_world_agent_count(*state), 0);
}

/* A double may be finite and yet no finite float. */
static void huge_velocities_are_refused(void **state) {
    JoWorld *world = *state;
    JoAgentDef def = jo_default_agent_def();
    JoAgent agent = jo_world_add_agent(world, &def, NULL);
    jo_agent_set_preferred(world, agent, 1e300, 0.0);
    jo_agent_set_preferred(world, agent, 0.0, -1e39);
    assert_int_equal(reports, 2);
    jo_world_step(world, 3);
    assert_null(jo_world_failure(world));
    assert_true(jo_agent_state(world, agent).x == 0.0);
}

static void a_stale_handle_stays_stale(void **state) {
    JoWorld *world = *state;
    JoAgentDef def = jo_default_agent_def();
    JoAgent first = jo_world_add_agent(world, &def, NULL);
    assert_true(jo_agent_is_live(world, first));
    jo_world_remove_agent(world, first);
    assert_false(jo_agent_is_live(world, first));
    def.x = 5;
    JoAgent second = jo_world_add_agent(world, &def, NULL);
    assert_int_equal(second.slot, first.slot); /* the slot is used again, the handle is not */
    assert_false(jo_agent_is_live(world, first));
    assert_true(jo_agent_state(world, first).radius == 0.0);
    assert_true(jo_agent_state(world, second).x == 5.0);
    jo_world_remove_agent(world, first);
    jo_agent_apply_force(world, first, 10, 0);
    assert_int_equal(jo_world_agent_count(world), 1);
    assert_false(jo_agent_is_live(world, (JoAgent){12345, 1}));
    assert_int_equal(reports, 0);
}

static void walls_must_make_sense(void **state) {
    JoWorld *world = *state;
    const double bow[] = {0, 0, 2, 2, 2, 0, 0, 2}, flat[] = {0, 0, 1, 0, 2, 0};
    const double nan[] = {0, 0, NAN, 1, 2, 0}, good[] = {0, 0, 1, 0, 1, 1};
    JoError error = {0};
    assert_false(jo_world_add_solid(world, bow, 4, &error));
    assert_false(jo_world_add_solid(world, flat, 3, &error));
    assert_false(jo_world_add_solid(world, nan, 3, &error));
    assert_false(jo_world_add_line(world, good, 1, &error));
    assert_int_equal(error.code, JO_INPUT);
    assert_true(jo_world_add_solid(world, good, 3, &error));
    jo_world_step(world, 1);
    assert_false(jo_world_add_solid(world, good, 3, &error));
    assert_non_null(strstr(error.text, "first step"));
}

static void stepping_an_empty_world_is_fine(void **state) {
    jo_world_step(*state, 10);
    assert_int_equal(jo_world_tick(*state), 10);
    assert_true(fabs(jo_world_time(*state) - 0.5) < 1e-12);
}

static void parameters_are_checked(void **state) {
    JoWorld *world = *state;
    JoAgentDef def = jo_default_agent_def();
    JoAgent agent = jo_world_add_agent(world, &def, NULL);
    assert_true(jo_agent_set_parameter(world, agent, "push", 100, NULL));
    assert_false(jo_agent_set_parameter(world, agent, "pushh", 100, NULL));
    assert_false(jo_agent_set_parameter(world, agent, "push", -5, NULL));
    assert_false(jo_agent_set_parameter(world, agent, "mass", NAN, NULL));
    jo_agent_set_preferred(world, agent, NAN, 0);
    jo_agent_apply_force(world, agent, INFINITY, 0);
    assert_int_equal(reports, 2);
    jo_world_step(world, 5);
    JoAgentState s = jo_agent_state(world, agent);
    assert_true(isfinite(s.x) && s.vx == 0.0);
}

static void a_missing_scene_is_an_error(void **state) {
    (void)state;
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    def.path = "no/such/scene.yaml";
    assert_null(jo_scene_load(&def, &error));
    assert_int_equal(error.code, JO_INPUT);
    assert_non_null(strstr(error.file, "scene.yaml"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(null_worlds_are_reported_and_harmless, set_up, tear_down),
        cmocka_unit_test_setup_teardown(defs_must_come_from_their_default, set_up, tear_down),
        cmocka_unit_test_setup_teardown(numbers_out_of_range_are_refused_by_name, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(huge_velocities_are_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_stale_handle_stays_stale, set_up, tear_down),
        cmocka_unit_test_setup_teardown(walls_must_make_sense, set_up, tear_down),
        cmocka_unit_test_setup_teardown(stepping_an_empty_world_is_fine, set_up, tear_down),
        cmocka_unit_test_setup_teardown(parameters_are_checked, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_missing_scene_is_an_error, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
