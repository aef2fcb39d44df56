/* Misuse of the public interface: null and stale handles, defs made by hand, numbers out of range.
   Each must answer harmlessly and be reported. */
#include <limits.h>
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
    assert_null(jo_report(&report, NULL)); /* no recording is named */
    report.recording = "x";
    report.fps = -1;
    assert_null(jo_report(&report, NULL));
    assert_null(jo_report(&(JoReportDef){.recording = "x"}, NULL)); /* not of the default */
    assert_null(jo_report(NULL, NULL));
    JoRenderDef render = jo_default_render_def();
    assert_false(jo_render(&render, NULL)); /* neither source nor target */
    render.recording = "x";
    assert_false(jo_render(&render, NULL));
    render.out = "x.svg";
    JoSceneDef both = jo_default_scene_def();
    render.scene = &both;
    assert_false(jo_render(&render, NULL));
    render = (JoRenderDef){.recording = "x", .out = "x.svg"}; /* not of the default */
    assert_false(jo_render(&render, NULL));
    assert_false(jo_render(NULL, NULL));
    render = jo_default_render_def();
    render.recording = "x";
    render.out = "x.svg";
    const double odd[] = {NAN, INFINITY, -1, 1e300};
    for (int i = 0; i < 4; i++) {
        JoRenderDef bad = render;
        bad.recorded_fps = odd[i];
        assert_false(jo_render(&bad, NULL));
        bad = render;
        bad.unit = odd[i];
        assert_false(jo_render(&bad, NULL));
    }
    render.at = INFINITY;
    assert_false(jo_render(&render, NULL));
    JoViewRecordingDef view = jo_default_view_recording_def();
    assert_false(jo_view_recording(&view, NULL)); /* no recording is named */
    view.recording = "x";
    view.fps = -1;
    assert_false(jo_view_recording(&view, NULL));
    assert_false(jo_view_recording(&(JoViewRecordingDef){.recording = "x"}, NULL));
    assert_false(jo_view_recording(NULL, NULL));
    assert_int_equal(reports, 26);
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

static void ignore(void *context, const char *text) {
    (void)context;
    (void)text;
}

static void enumerations_out_of_range_are_refused_by_name(void **state) {
    const int wrong[] = {3, 99, -1, INT_MAX, INT_MIN};
    for (int i = 0; i < 5; i++) {
        JoError error = {0};
        JoWorldDef world = jo_default_world_def();
        world.lost_people = (JoLost)wrong[i];
        assert_null(jo_world_create(&world, &error));
        assert_int_equal(error.code, JO_INPUT);
        assert_non_null(strstr(error.text, "lost_people must be one of JO_LOST_END, "));
        world = jo_default_world_def();
        world.lost_bodies = (JoLost)wrong[i];
        assert_null(jo_world_create(&world, &error));
        assert_non_null(strstr(error.text, "lost_bodies must be one of JO_LOST_END, "));
        world = jo_default_world_def();
        world.isa = (JoIsa)(wrong[i] == 3 ? 7 : wrong[i]);
        assert_null(jo_world_create(&world, &error));
        assert_non_null(strstr(error.text, "does not run 'unknown'; it runs scalar"));
        assert_string_equal(jo_isa_name(world.isa), "unknown");
        JoSceneDef scene = jo_default_scene_def();
        scene.path = "no/such/scene.yaml";
        scene.message = ignore;
        scene.isa = world.isa;
        assert_null(jo_scene_load(&scene, &error));
        assert_int_equal(error.code, JO_INPUT);
        JoBodyDef body = jo_default_body_def();
        body.shape = (JoShape)wrong[i];
        assert_true(jo_world_add_body(*state, &body, &error).generation == 0);
        assert_non_null(strstr(error.text, "shape must be one of JO_SPHERE, "));
        body = jo_default_body_def();
        body.kinematic = true;
        body.path = (JoPath){.points = (double[]){1, 1, 1}, .count = 1, .end = (JoPathEnd)wrong[i]};
        assert_true(jo_world_add_body(*state, &body, &error).generation == 0);
        assert_non_null(strstr(error.text, "path.end must be one of JO_PATH_STAY, "));
    }
    assert_int_equal(reports, 0);
    const double from[] = {0, 0}, to[] = {1, 0};
    assert_false(jo_world_cast(*state, from, to, 0, JO_CAST_ALL + 1).hit);
    assert_false(jo_world_cast(*state, from, to, 0, UINT32_MAX).hit);
    assert_int_equal(reports, 2);
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
    JoError gone = {0};
    assert_false(jo_agent_set_parameter(world, agent, "turn", 0.4, &gone));
    assert_non_null(strstr(gone.text, "see breadth and depth"));
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

/* ---- scenes ---- */

static const char SCENE[] = "jostle: 1\n"
                            "groups: {one: {behaviour: own.lua, at: [[0, 0], [2, 0]]}}\n";
static const char OWN[] = "return machine { name = \"own\", version = 1, start = \"A\", states = {"
                          " A = { steer = hold, on_enter = function() print \"here\" end } } }\n";
static const JoFile FILES[] = {{"far/s.yaml", SCENE, sizeof SCENE - 1},
                               {"far/own.lua", OWN, sizeof OWN - 1}};

static JoSceneDef scene_def(JoMessage *message, void *context) {
    JoSceneDef def = jo_default_scene_def();
    def.path = "far/s.yaml";
    def.files = FILES;
    def.file_count = 2;
    def.files_only = true;
    def.threads = 1;
    def.message = message;
    def.message_context = context;
    return def;
}

typedef struct Told {
    JoScene *scene; /* NULL: not yet loaded */
    int times;
} Told;

/* Tries what changes a world, and the end of it. */
static void meddle(void *context, const char *text) {
    Told *told = context;
    JoScene *scene = told->scene;
    (void)text;
    if (!scene)
        return;
    JoWorld *world = jo_scene_world(scene);
    const JoAgentDef agent = jo_default_agent_def();
    const JoBodyDef body = jo_default_body_def();
    JoAgent first;
    told->times++;
    assert_int_equal(jo_world_agents(world, &first, 1), 1);
    assert_true(jo_agent_is_live(world, first));
    const int before = reports;
    jo_world_remove_agent(world, first);
    assert_true(jo_world_add_agent(world, &agent, NULL).generation == 0);
    assert_true(jo_world_add_body(world, &body, NULL).generation == 0);
    assert_false(jo_world_signal(world, "x", NULL));
    assert_false(jo_scene_signal(scene, "x", NULL));
    assert_false(jo_scene_input(scene, "spawn one 5 5", NULL));
    assert_false(jo_scene_step(scene, NULL));
    assert_false(jo_scene_finish(scene, NULL));
    jo_world_step(world, 1);
    jo_scene_free(scene);
    assert_int_equal(reports - before, 10);
}

static void messages_change_nothing_within_a_step(void **state) {
    (void)state;
    Told told = {0};
    const JoSceneDef def = scene_def(meddle, &told);
    JoScene *scene = jo_scene_load(&def, NULL);
    assert_non_null(scene);
    told.scene = scene;
    for (int s = 0; s < 3; s++)
        assert_true(jo_scene_step(scene, NULL));
    assert_true(told.times > 0);
    assert_int_equal(jo_world_agent_count(jo_scene_world(scene)), 2);
    assert_true(jo_scene_signal(scene, "x", NULL)); /* between steps it may */
    jo_scene_free(scene);
}

static void quiet(void *context, const char *text) {
    (void)context;
    (void)text;
}

static void ignore_run(void *context, const JoSweepRunState *run) {
    (void)context;
    (void)run;
}

static void texts_that_are_missing_are_reported(void **state) {
    (void)state;
    const char *const none[] = {NULL, "{}"};
    const JoFile nameless = {NULL, "x", 1}, textless = {"x", NULL, 1};
    const JoJobs idle = {0};
    for (int n = 0; n < 6; n++) {
        JoSceneDef def = scene_def(quiet, NULL);
        def.overrides = n == 0 ? none : NULL;
        def.override_count = n == 0 || n == 1;
        def.mods = n == 2 ? none : NULL;
        def.mod_count = n == 2;
        def.files = n == 3 ? &nameless : n == 4 ? &textless : FILES;
        def.file_count = n == 3 || n == 4 ? 1 : 2;
        def.jobs = n == 5 ? &idle : NULL;
        assert_null(jo_scene_load(&def, NULL));
    }
    assert_null(jo_summaries_aggregate(none, 2, NULL));
    assert_false(jo_write(NULL, "x", NULL));
    assert_false(jo_write("x", NULL, NULL));
    assert_int_equal(reports, 9);
    JoError error = {0};
    JoSweepDef sweep = jo_default_sweep_def();
    sweep.scene = scene_def(quiet, NULL);
    sweep.sets = none;
    sweep.set_count = 1;
    assert_int_equal(jo_sweep_runs(&sweep, &error), 0);
    assert_int_equal(error.code, JO_USAGE);
    assert_false(jo_sweep_states(&sweep, "parts", ignore_run, NULL, &error));
    assert_int_equal(error.code, JO_USAGE);
}

/* A dry scene has no agents to step. */
static void dry_scenes_do_not_run(void **state) {
    (void)state;
    JoSceneDef def = scene_def(quiet, NULL);
    def.dry = true;
    JoScene *scene = jo_scene_load(&def, NULL);
    assert_non_null(scene);
    assert_false(jo_scene_step(scene, NULL));
    assert_null(jo_scene_world(scene));
    assert_null(jo_scene_summary(scene));
    assert_null(jo_scene_inspect(scene, 0));
    assert_null(jo_scene_half_step(&def, scene, NULL));
    assert_int_equal(reports, 5);
    jo_scene_free(scene);
}

static void run_none(void *context, uint32_t count, void (*job)(void *data, uint32_t n),
                     void *data) {
    (void)context, (void)count, (void)job, (void)data;
}

static void run_more(void *context, uint32_t count, void (*job)(void *data, uint32_t n),
                     void *data) {
    (void)context;
    for (uint32_t n = 0; n < count + 70; n++)
        job(data, n);
}

static uint64_t hash_of(const JoJobs *jobs) {
    JoWorldDef def = jo_default_world_def();
    def.threads = 4;
    def.jobs = jobs;
    JoWorld *world = jo_world_create(&def, NULL);
    JoAgentDef agent = jo_default_agent_def();
    for (int n = 0; n < 3000; n++) {
        agent.x = n % 60 * 0.5;
        agent.y = n / 60 * 0.5;
        const JoAgent added = jo_world_add_agent(world, &agent, NULL);
        jo_agent_set_preferred(world, added, 1, 0);
    }
    jo_world_step(world, 3);
    const uint64_t hash = jo_world_hash(world);
    jo_world_free(world);
    return hash;
}

static void jobs_that_are_not_done_are_done(void **state) {
    (void)state;
    const JoJobs none = {run_none, NULL}, more = {run_more, NULL};
    const uint64_t hash = hash_of(NULL);
    assert_true(hash_of(&more) == hash);
    assert_int_equal(reports, 0);
    assert_true(hash_of(&none) == hash);
    assert_true(reports > 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(null_worlds_are_reported_and_harmless, set_up, tear_down),
        cmocka_unit_test_setup_teardown(defs_must_come_from_their_default, set_up, tear_down),
        cmocka_unit_test_setup_teardown(numbers_out_of_range_are_refused_by_name, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(enumerations_out_of_range_are_refused_by_name, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(huge_velocities_are_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_stale_handle_stays_stale, set_up, tear_down),
        cmocka_unit_test_setup_teardown(walls_must_make_sense, set_up, tear_down),
        cmocka_unit_test_setup_teardown(stepping_an_empty_world_is_fine, set_up, tear_down),
        cmocka_unit_test_setup_teardown(parameters_are_checked, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_missing_scene_is_an_error, set_up, tear_down),
        cmocka_unit_test_setup_teardown(messages_change_nothing_within_a_step, set_up, tear_down),
        cmocka_unit_test_setup_teardown(texts_that_are_missing_are_reported, set_up, tear_down),
        cmocka_unit_test_setup_teardown(dry_scenes_do_not_run, set_up, tear_down),
        cmocka_unit_test_setup_teardown(jobs_that_are_not_done_are_done, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
