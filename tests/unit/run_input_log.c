/* Tests of inputs to a running scene: they act in the next step, are written to a log, and play
 * back to the same state. */
#include <math.h>

#include "jostle_tools.h"
#include "live/inspect.h"
#include "unit/gate_ball_scene.h"

/* Loads the same scene with a log to play. */
static JoScene *play_log(const char *log, uint32_t threads) {
    JoSceneDef def = define_scene(test_path("scene.yaml"));
    def.input_log = log;
    def.threads = threads;
    return load_defined_scene(&def);
}

static void assert_input_refused(JoScene *scene, const char *line, const char *because) {
    JoError error = {0};
    uint64_t before = jo_world_hash(scene->world);
    if (jo_scene_input(scene, line, &error) || !strstr(error.text, because))
        fail_msg("%s: %s, not '%s'", line, error.text, because);
    assert_int_equal(error.code, JO_INPUT);
    assert_true(before == jo_world_hash(scene->world));
}

static char *read_log_text(const char *path) {
    char *text = jox_read_file(path, 1 << 24, NULL);
    assert_non_null(text);
    return text;
}

/* ---- the log ---- */

static void logged_session_plays_back_to_the_same_state(void **state) {
    (void)state;
    const char *first = test_path("first.input"), *second = test_path("second.input");
    JoError error = {0};
    JoScene *scene = load_gate_and_ball();
    bool bodies = jox_bodies_available();
    assert_true(jo_scene_log_input(scene, first, &error));
    step_scene(scene, 3);
    apply_input(scene, "push 1 250 -40.5");
    apply_input(scene, "set m Walk speed 0.9");
    step_scene(scene, 2);
    apply_input(scene, "open gate");
    assert_true(jo_scene_open_wall(scene, "gate", false, &error));
    if (bodies) {
        apply_input(scene, "throw ball 4 0 1.2 -6 0 1");
        assert_true(jo_scene_throw(scene, "ball", NULL, (double[]){-5.1, 0.3, 2}, NULL, &error));
        apply_input(scene, "box 5 0 1 -4 0 0 0.4 12");
        apply_input(scene, "grab 0 2 2 1");
    }
    step_scene(scene, 7);
    apply_input(scene, "signal stop");
    apply_input(scene, "player 2 1 0.3");
    apply_input(scene, "set m defaults radius 0.25");
    if (bodies)
        apply_input(scene, "drag 0 3 2 1");
    step_scene(scene, 10);
    if (bodies)
        apply_input(scene, "release 0");
    assert_true(jo_scene_signal(scene, "stop", &error));
    step_scene(scene, 20);
    uint64_t hash = jo_world_hash(scene->world);
    assert_true(jo_scene_finish(scene, &error));
    jo_scene_free(scene);

    for (uint32_t threads = 1; threads <= 4; threads *= 2) {
        JoScene *replay = play_log(first, threads);
        scene_messages.length = 0;
        if (threads == 1) { /* inputs of a played log are logged, too */
            assert_false(jo_scene_log_input(replay, first, &error));
            assert_non_null(strstr(error.text, "write the new one to another file"));
            assert_true(jo_scene_log_input(replay, second, &error));
        }
        step_scene(replay, 42);
        assert_int_equal(scene_messages.length, 0);
        assert_true(jo_world_hash(replay->world) == hash);
        jo_scene_free(replay);
    }
    char *one = read_log_text(first), *two = read_log_text(second);
    assert_string_equal(one, two);
    assert_non_null(strstr(one, "# input log of jostle "));
    assert_non_null(strstr(one, "3 push 1 250 -40.5\n3 set m Walk speed 0.9\n5 open gate\n"));
    jox_free(one);
    jox_free(two);

    JoScene *without = load_gate_and_ball();
    step_scene(without, 42);
    assert_false(jo_world_hash(without->world) == hash);
    jo_scene_free(without);
}

static void refused_inputs_are_not_logged(void **state) {
    (void)state;
    const char *path = test_path("bad.input");
    JoError error = {0};
    JoScene *scene = load_gate_and_ball();
    assert_true(jo_scene_log_input(scene, path, &error));
    step_scene(scene, 1);
    assert_input_refused(scene, "push 4 1 1", "there is no agent 4; ids go up to 3");
    assert_input_refused(scene, "player 77 1 1", "there is no agent 77");
    assert_input_refused(scene, "open gaet", "Did you mean 'gate'?");
    assert_input_refused(scene, "shove 1 2 3", "there is no verb 'shove'");
    assert_input_refused(scene, "set m Walk speed 21", "speed must be from 0 to 20 m/s, not 21");
    assert_input_refused(scene, "set m Walk sped 1", "Did you mean 'speed'?");
    assert_input_refused(scene, "set m Wlak speed 1", "Did you mean 'Walk'?");
    assert_input_refused(scene, "set n Walk speed 1", "there is no machine 'n'");
    assert_input_refused(scene, "files 1", "files stands in logs alone");
    if (jox_bodies_available()) {
        assert_input_refused(scene, "throw pillar here 1 1 1", "is static");
        assert_input_refused(scene, "grab 1 0 0 1", "is static");
        assert_input_refused(scene, "grab 9 0 0 1", "there is no body 9");
        assert_input_refused(scene, "drag 0 0 0 1", "grab it first");
        assert_input_refused(scene, "release 0", "is not held");
    } else {
        assert_input_refused(scene, "box 0 0 1 0 0 0 0.4 10", "no Bullet");
    }
    assert_false(jo_scene_signal(scene, "a\nb", &error));
    jo_scene_free(scene);
    char *text = read_log_text(path);
    assert_null(strstr(text, "\n1 ")); /* it only lists the files of the scene */
    assert_non_null(strstr(text, "\n0 began 1 0.05\n0 made "));
    jox_free(text);
}

static void half_step_run_refuses_scenes_that_people_acted_on(void **state) {
    (void)state;
    JoError error = {0};
    JoScene *scene = load_gate_and_ball();
    step_scene(scene, 2);
    JoScene *half = jo_scene_half_step(&scene->def, scene, &error);
    assert_non_null(half);
    jo_scene_free(half);
    apply_input(scene, "push 1 10 0");
    assert_null(jo_scene_half_step(&scene->def, scene, &error));
    assert_non_null(strstr(error.text, "people acted on it"));
    jo_scene_free(scene);
}

static void log_that_cannot_be_written_is_an_error(void **state) {
    (void)state;
    JoError error = {0};
    JoScene *scene = load_gate_and_ball();
    assert_false(jo_scene_log_input(scene, "/nowhere/at/all.input", &error));
    assert_int_equal(error.code, JO_FAILED);
    assert_non_null(strstr(error.text, "/nowhere/at/all.input"));
    if (access("/dev/full", W_OK) == 0) {
        assert_false(jo_scene_log_input(scene, "/dev/full", &error) &&
                     jo_scene_step(scene, &error));
        assert_non_null(strstr(error.text, "cannot write the input log '/dev/full'"));
    }
    jo_scene_free(scene);
}

/* ---- pushes ---- */

static void push_acts_for_one_step(void **state) {
    (void)state;
    JoScene *pushed = load_gate_and_ball(), *pair = load_gate_and_ball();
    step_scene(pushed, 20);
    step_scene(pair, 20);
    apply_input(pushed, "push 3 800 0");
    step_scene(pushed, 1);
    step_scene(pair, 1);
    const JoxAgents *a = &pushed->world->state.agents, *b = &pair->world->state.agents;
    double gain = (double)(a->vx[jox_agents_find(a, 3)] - b->vx[jox_agents_find(b, 3)]);
    assert_true(gain > 0.35 && gain < 0.5); /* m/s: 800 N on 80 kg for 0.05 s, less damping */
    assert_true(a->ext_x[jox_agents_find(a, 3)] == 0.0f);
    jo_scene_free(pushed);
    jo_scene_free(pair);
}

/* ---- parameters ---- */

static double read_parameter(const JoScene *scene, uint32_t id, JoxParameter p) {
    const JoxAgents *a = &scene->world->state.agents;
    return (double)jox_param(a, p, jox_agents_find(a, id));
}

static void parameter_is_set_for_all_agents_of_a_state(void **state) {
    (void)state;
    JoScene *scene = load_gate_and_ball();
    step_scene(scene, 2);
    assert_false(read_parameter(scene, 0, JOX_PARAM_speed) == 0.9f);
    apply_input(scene, "set m Walk speed 0.9"); /* it was an expression */
    for (uint32_t id = 0; id < 4; id++)
        assert_true((float)read_parameter(scene, id, JOX_PARAM_speed) == 0.9f);
    step_scene(scene, 5);
    assert_true((float)read_parameter(scene, 0, JOX_PARAM_speed) == 0.9f);
    apply_input(scene, "set m Wait max_speed 0.7"); /* a state without agents */
    apply_input(scene, "set m Wait push_angle 30");
    assert_true((float)read_parameter(scene, 0, JOX_PARAM_max_speed) == 1.8f);
    apply_input(scene, "signal stop");
    step_scene(scene, 2);
    assert_true((float)read_parameter(scene, 0, JOX_PARAM_max_speed) == 0.7f);
    assert_true(fabs(read_parameter(scene, 0, JOX_PARAM_push_angle) - 0.8660254) < 1e-6);
    uint32_t i = jox_world_add_agent(scene->world, 9.0f, 9.0f); /* also for later agents */
    jox_machines_spawn(&scene->world->machines, i, 0, NULL, NULL);
    assert_true((float)read_parameter(scene, 4, JOX_PARAM_speed) == 0.9f);
    jo_scene_free(scene);
}

static void set_default_reaches_states_without_a_value(void **state) {
    (void)state;
    JoScene *scene = load_gate_and_ball();
    apply_input(scene, "signal stop");
    step_scene(scene, 2);
    apply_input(scene, "set m defaults speed 1.7");
    for (uint32_t id = 0; id < 4; id++) {
        assert_true((float)read_parameter(scene, id, JOX_PARAM_speed) == 1.7f);
        assert_true((float)read_parameter(scene, id, JOX_PARAM_push) == 1.7f); /* own.speed */
    }
    apply_input(scene, "set m defaults mass 60"); /* overrides the scene's value */
    assert_true((float)read_parameter(scene, 0, JOX_PARAM_mass) == 60.0f);
    apply_input(scene, "set m defaults max_speed 0.5"); /* the state sets its own value */
    assert_true((float)read_parameter(scene, 0, JOX_PARAM_max_speed) == 1.0f);
    jo_scene_free(scene);
}

static void reload_restores_the_written_parameters(void **state) {
    (void)state;
    JoScene *scene = load_gate_and_ball(), *other = load_gate_and_ball();
    step_scene(scene, 2);
    step_scene(other, 2);
    apply_input(scene, "set m Wait max_speed 0.7");
    apply_input(scene, "set m defaults speed 1.7");
    apply_input(scene, "set m defaults mass 60");
    if (!reload_behaviour(scene, 0, WALKER "-- saved once more\n"))
        fail_msg("%s", refusal);
    step_scene(scene, 5);
    step_scene(other, 5);
    for (uint32_t id = 0; id < 4; id++)
        for (int p = 0; p < JOX_PARAM_COUNT; p++)
            if (p != JOX_PARAM_speed) /* follows the present speed */
                assert_true(read_parameter(scene, id, (JoxParameter)p) ==
                            read_parameter(other, id, (JoxParameter)p));
    jo_scene_free(scene);
    jo_scene_free(other);
}

static void graph_names_the_source_of_each_value(void **state) {
    (void)state;
    JoScene *scene = load_gate_and_ball();
    JoxText text = {0};
    char wanted[400];
    apply_input(scene, "set m Wait max_speed 0.7");
    JoxJson json = jox_json_begin(&text, 0);
    jox_live_add_machines(scene, &json, NULL);
    snprintf(wanted, sizeof wanted,
             "{\"name\": \"speed\", \"value\": null, \"text\": \"0.5 * now.speed + 0.4\", "
             "\"set\": \"state Walk %s/own.lua:3\", \"least\": 0, \"most\": 20, \"unit\": \"m/s\"}",
             test_folder);
    assert_non_null(strstr(text.data, wanted));
    snprintf(wanted, sizeof wanted,
             "\"text\": \"normal(1.2, 0.2)\", \"set\": \"defaults %s/own.lua:2", test_folder);
    assert_non_null(strstr(text.data, wanted));
    assert_non_null(strstr(text.data,
                           "{\"name\": \"max_speed\", \"value\": 0.7, \"text\": \"0.7\", "
                           "\"set\": \"program or page\""));
    assert_non_null(strstr(text.data, "{\"name\": \"yield\", \"value\": 0.5, \"text\": \"\", "
                                      "\"set\": \"engine\""));
    assert_non_null(
        strstr(text.data,
               "{\"id\": \"Wait\", \"from\": \"Walk\", \"to\": \"Wait\", \"text\": \"heard "
               "\\\"stop\\\" & ~mine.met & mine.laps:above(1)\", \"line\": 4, \"chance\": null}"));
    assert_non_null(strstr(text.data, "\"text\": \"after(60)\", \"line\": 6, \"chance\": 0.5}"));
    jox_text_free(&text);
    assert_true(jox_live_lua_line(scene, "m", "Wait", "max_speed", 0.7, &text));
    snprintf(wanted, sizeof wanted,
             "Wait = { max_speed = 0.7, ... },   -- %s/own.lua:5, where it is 1", test_folder);
    assert_string_equal(text.data, wanted);
    jox_text_free(&text);
    assert_true(jox_live_lua_line(scene, "m", "defaults", "horizon", 1, &text));
    assert_non_null(strstr(text.data, "defaults = { horizon = 1, ... },   -- "));
    assert_non_null(strstr(text.data, "own.lua:2"));
    jox_text_free(&text);
    assert_false(jox_live_lua_line(scene, "m", "Wait", "max_speed", 70, &text));
    assert_string_equal(text.data, "max_speed must be from 0 to 30 m/s, not 70");
    jox_text_free(&text);
    jo_scene_free(scene);
}

/* ---- bodies ---- */

static JoxPose read_body_pose(const JoScene *scene, uint32_t row) {
    JoxPose pose;
    assert_true(jox_bodies_pose(scene->world->state.bodies, row, &pose));
    return pose;
}

static void held_body_is_pulled_to_the_target(void **state) {
    (void)state;
    if (!jox_bodies_available())
        return;
    JoScene *scene = load_gate_and_ball();
    apply_input(scene, "grab 0 9 3 1.5");
    float fastest = 0.0f;
    for (int n = 0; n < 60; n++) {
        step_scene(scene, 1);
        JoxPose pose = read_body_pose(scene, 0);
        fastest = jox_maxf(fastest, fabsf(pose.velocity.y));
    }
    JoxPose pose = read_body_pose(scene, 0);
    assert_true(fabsf(pose.centre.x - 9) < 0.05f && fabsf(pose.centre.y - 3) < 0.05f);
    assert_true(fabsf(pose.centre.z - 1.5f) < 0.05f); /* the pull bears its weight */
    assert_true(fastest < 6.1f);
    apply_input(scene, "drag 0 9 4 1.5");
    step_scene(scene, 60);
    assert_true(fabsf(read_body_pose(scene, 0).centre.y - 4) < 0.05f);
    apply_input(scene, "release 0");
    step_scene(scene, 40);
    assert_true(read_body_pose(scene, 0).centre.z < 0.2f);
    apply_input(scene, "grab 0 9 4 -60"); /* towards a point below the ground: it stays above */
    step_scene(scene, 20);
    assert_true(read_body_pose(scene, 0).centre.z > 0.0f);
    jo_scene_free(scene);
}

static void oldest_box_is_removed_for_a_new_one(void **state) {
    (void)state;
    if (!jox_bodies_available())
        return;
    JoScene *scene = load_gate_and_ball();
    JoWorld *world = scene->world;
    uint32_t before = jo_world_body_count(world);
    for (int n = 0; n < JOX_MOST_BOXES + 7; n++) {
        char line[100];
        snprintf(line, sizeof line, "box %d %d 0 0 0 0 0.3 4", 40 + n % 15, 20 + n / 15);
        apply_input(scene, line);
        if (n % 50 == 0)
            step_scene(scene, 1);
    }
    assert_int_equal(jo_world_body_count(world), before + JOX_MOST_BOXES);
    assert_int_equal(world->state.drags.boxes[0], before + 7); /* ids are not reused */
    assert_int_equal(jox_bodies_find(world->state.bodies, before + 6), JOX_NO_BODY);
    step_scene(scene, 3);
    JoxPose pose = read_body_pose(scene, jox_bodies_find(world->state.bodies, before + 7));
    assert_true(fabsf(pose.centre.z - 0.15f) < 0.02f); /* lifted out of the ground */
    for (uint32_t o = 0; o < 2; o++)
        assert_true(world->scratch.objects.rows[o].live); /* the scene's own bodies stay */
    jo_scene_free(scene);
}

/* ---- reloaded files ---- */

static void files_of_a_log_go_live(void **state) {
    (void)state;
    char text[4000];
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(20),
                                     STANDING_AT_SPEED("1.5", "")); /* the text on the disk */
    jo_scene_free(scene);
    static const char BEGAN[] = STANDING_AT_SPEED("0.7", ""), LIVE[] = STANDING_AT_SPEED("0.9", ""),
                      BAD[] = "return 7\n";
    snprintf(text, sizeof text,
             "# a session\n3 before 1\n%s/own.lua %zu\n%s\n3 files 1\n%s/own.lua %zu\n%s\n"
             "6 files 1\n%s/own.lua %zu\n%s\n",
             test_folder, sizeof BEGAN - 1, BEGAN, test_folder, sizeof LIVE - 1, LIVE, test_folder,
             sizeof BAD - 1, BAD);
    scene = play_log(write_test_file("files.input", text), 1);
    assert_true((float)read_wanted_speed(scene, 0) == 0.7f);
    step_scene(scene, 3);
    assert_true((float)read_wanted_speed(scene, 0) == 0.7f);
    step_scene(scene, 1);
    assert_true((float)read_wanted_speed(scene, 0) == 0.9f);
    assert_non_null(strstr(scene_messages.data, "reload 1 is live from t = 0.15 s\n"));
    assert_null(strstr(scene_messages.data, "ms ago"));
    step_scene(scene, 3);
    assert_non_null(
        strstr(scene_messages.data, "files.input:10: t = 0.30 s: the files that follow were not"));
    assert_non_null(strstr(scene_messages.data, "Reload 1 keeps running"));
    assert_true((float)read_wanted_speed(scene, 0) == 0.9f);
    JoError error = {0};
    assert_false(jo_scene_watch(scene, &error));
    assert_non_null(strstr(error.text, "cannot be watched besides"));
    jo_scene_free(scene);
}

static void file_of_a_log_that_nothing_reads_is_told(void **state) {
    (void)state;
    static const char LIVE[] = STANDING_AT_SPEED("0.9", "");
    char text[4000];
    jo_scene_free(load_scene_text(YARD_WITH_PEOPLE(20), STANDING_AT_SPEED("1.5", "")));
    snprintf(text, sizeof text, "3 files 2\n%s/own.lua %zu\n%s\n%s/owm.lua %zu\n%s\n", test_folder,
             sizeof LIVE - 1, LIVE, test_folder, sizeof LIVE - 1, LIVE);
    JoScene *scene = play_log(write_test_file("unread.input", text), 1);
    step_scene(scene, 5);
    assert_true((float)read_wanted_speed(scene, 0) == 0.9f);
    assert_non_null(strstr(scene_messages.data, "unread.input:1: t = 0.15 s: no behaviour or scene "
                                                "of this run reads '"));
    assert_non_null(strstr(scene_messages.data, "/owm.lua': its text has no effect. Did you mean"));
    assert_null(strstr(scene_messages.data, "reads 'own.lua'"));
    jo_scene_free(scene);
}

static void log_of_another_run_is_warned_of(void **state) {
    (void)state;
    char text[1000];
    jo_scene_free(load_gate_and_ball());
    snprintf(text, sizeof text, "0 began 7 0.02\n0 made %s/own.lua 0c8e\n5 began 1 0.05\n",
             test_folder);
    jo_scene_free(play_log(write_test_file("else.input", text), 1));
    assert_non_null(strstr(scene_messages.data,
                           "else.input:1: the log was written with seed 7 and steps of "
                           "0.02 s, not 1 and 0.05 s"));
    assert_non_null(strstr(scene_messages.data, "else.input:2: "));
    assert_non_null(strstr(scene_messages.data, "own.lua has changed since the log was written"));
    assert_non_null(
        strstr(scene_messages.data, "else.input:3: the log was begun 5 steps into the run"));
}

static void invalid_log_is_an_error_with_file_and_line(void **state) {
    (void)state;
    jo_scene_free(load_gate_and_ball());
    const char *log = write_test_file("wrong.input", "# x\n2 push 0 1 1\n3 shove 0\n");
    JoSceneDef def = define_scene(test_path("scene.yaml"));
    JoError error = {0};
    def.input_log = log;
    assert_null(jo_scene_load(&def, &error));
    assert_int_equal(error.line, 3);
    assert_int_equal(error.column, 3);
    assert_string_equal(error.file, log);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(logged_session_plays_back_to_the_same_state),
        cmocka_unit_test(refused_inputs_are_not_logged),
        cmocka_unit_test(half_step_run_refuses_scenes_that_people_acted_on),
        cmocka_unit_test(log_that_cannot_be_written_is_an_error),
        cmocka_unit_test(push_acts_for_one_step),
        cmocka_unit_test(parameter_is_set_for_all_agents_of_a_state),
        cmocka_unit_test(set_default_reaches_states_without_a_value),
        cmocka_unit_test(reload_restores_the_written_parameters),
        cmocka_unit_test(graph_names_the_source_of_each_value),
        cmocka_unit_test(held_body_is_pulled_to_the_target),
        cmocka_unit_test(oldest_box_is_removed_for_a_new_one),
        cmocka_unit_test(files_of_a_log_go_live),
        cmocka_unit_test(file_of_a_log_that_nothing_reads_is_told),
        cmocka_unit_test(log_of_another_run_is_warned_of),
        cmocka_unit_test(invalid_log_is_an_error_with_file_and_line),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
