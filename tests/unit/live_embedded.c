/* The live page of a scene that the program steps: what browsers see and do between its steps. */
#include "unit/live_session.h"

static JoScene *scene;
static JoLive *live;
static JoxText told;

static void keep_told(void *context, const char *text) {
    (void)context;
    jox_text_add(&told, text);
}

static JoScene *load_scene(void) {
    JoSceneDef def = jo_default_scene_def();
    JoError error;
    def.path = test_path("scene.yaml");
    def.named_mods_only = true;
    def.message = keep_told;
    JoScene *loaded = jo_scene_load(&def, &error);
    if (!loaded)
        fail_msg("%s", error.text);
    return loaded;
}

static int open_live(void **state) {
    (void)state;
    JoLiveDef def = jo_default_live_def();
    JoError error;
    int port;
    char token[64];
    write_test_file("scene.yaml", SCENE);
    write_test_file("walker.lua", WALKER);
    scene = load_scene();
    def.page = test_folder;
    def.frame = "http://127.0.0.1:*";
    live = jo_live_open(scene, &def, &error);
    if (!live)
        fail_msg("%s", error.text);
    assert_int_equal(
        sscanf(jo_live_address(live), "http://127.0.0.1:%d/%32[0-9a-f]/", &port, token), 2);
    session.fd = open_socket(port, token);
    assert_true(session.fd >= 0);
    return 0;
}

static int close_live(void **state) {
    (void)state;
    close(session.fd);
    jo_live_close(live);
    jo_scene_free(scene);
    jox_text_free(&told);
    return 0;
}

/* Serves until a message with both texts (`second` may be NULL) has come; returns it. */
static const char *serve_until(const char *first, const char *second) {
    for (double until = clock_now() + 20.0; clock_now() < until;) {
        int kind;
        size_t length;
        jo_live_serve(live, 0.0);
        char *message = get_message(session.fd, &kind, &length, 0.02);
        if (!message)
            continue;
        const bool found =
            kind == FRAME_TEXT && strstr(message, first) && (!second || strstr(message, second));
        if (kind == FRAME_TEXT)
            snprintf(last, sizeof last, "%s", message);
        free(message);
        if (found)
            return last;
    }
    fail_msg("nothing came with %s and %s; the last was %.500s", first, second ? second : "", last);
    return NULL;
}

static void step_scene(int steps) {
    JoError error = {0};
    while (steps-- > 0)
        if (!jo_scene_step(scene, &error))
            fail_msg("%s", error.text);
}

static uint64_t find_tick(void) {
    return jo_world_tick(jo_scene_world(scene));
}

static void steps_of_the_program_are_shown(void **state) {
    (void)state;
    serve_until("\"type\": \"scene\"", "\"restarts\": false");
    assert_true(read_member(serve_until("\"type\": \"status\"", "\"paused\": true"), "tick") == 0);
    assert_int_equal(jo_live_watchers(live), 1);
    jo_live_serve(live, 0.3); /* it is paused: a page that is looked at changes nothing */
    assert_int_equal(find_tick(), 0);
    step_scene(7);
    serve_until("\"type\": \"status\"", "\"tick\": 7");
    assert_true(jo_live_serve(live, 0.0) <= 0.05);
}

static void people_let_the_scene_run_between_steps(void **state) {
    (void)state;
    step_scene(2);
    send_command("{\"do\": \"step\", \"n\": 5}");
    serve_until("\"type\": \"status\"", "\"tick\": 7");
    send_command("{\"do\": \"speed\", \"factor\": 10}");
    send_command("{\"do\": \"pause\", \"on\": false}");
    serve_until("\"type\": \"status\"", "\"paused\": false");
    jo_live_serve(live, 0.2);
    assert_true(find_tick() > 15);
    const uint64_t tick = find_tick();
    for (int i = 0; i < 20; i++) { /* only the program's steps, also while it runs */
        step_scene(1);
        jo_live_show(live);
        usleep(5000);
    }
    assert_int_equal(find_tick(), tick + 20);
    send_command("{\"do\": \"pause\", \"on\": true}");
    serve_until("\"type\": \"status\"", "\"paused\": true");
    send_command("{\"do\": \"input\", \"line\": \"signal go\"}");
    jo_live_serve(live, 0.2);
    step_scene(2); /* the signal is heard in the second */
    serve_until("\"type\": \"status\"", "\"states\": [[0, 30]]");
}

/* A run that was only shown has the state of one without a page. */
static void looking_changes_nothing(void **state) {
    (void)state;
    JoScene *alone = load_scene();
    JoError error;
    serve_until("\"type\": \"scene\"", NULL);
    for (int i = 0; i < 40; i++) {
        step_scene(1);
        jo_live_serve(live, 0.0);
        assert_true(jo_scene_step(alone, &error));
    }
    assert_true(jo_world_hash(jo_scene_world(scene)) == jo_world_hash(jo_scene_world(alone)));
    jo_scene_free(alone);
}

static void plan_names_what_pictures_show(void **state) {
    (void)state;
    const uint64_t before = jo_world_hash(jo_scene_world(scene));
    char *plan = jo_scene_plan(scene);
    assert_non_null(plan);
    static const char *const PARTS[] = {"\"name\": \"yard\"", "\"gate\"",
                                        "\"name\": \"Walk\", \"colour\": \"#"};
    for (size_t i = 0; i < sizeof PARTS / sizeof *PARTS; i++)
        if (!strstr(plan, PARTS[i]))
            fail_msg("no %s in %s", PARTS[i], plan);
    jo_free(plan);
    assert_true(jo_world_hash(jo_scene_world(scene)) == before);
}

static void edited_files_are_loaded_and_their_errors_shown(void **state) {
    (void)state;
    char edited[sizeof WALKER];
    serve_until("\"type\": \"errors\"", "\"errors\": []");
    snprintf(edited, sizeof edited, "%s", WALKER);
    memcpy(strstr(edited, "hold"), "hald", 4);
    write_test_file("walker.lua", edited);
    serve_until("\"type\": \"errors\"", "hald");
    write_test_file("walker.lua", WALKER);
    serve_until("\"type\": \"errors\"", "\"errors\": []");
}

static void scene_stays_with_its_program(void **state) {
    (void)state;
    JoError error;
    send_command("{\"do\": \"restart\"}");
    serve_until("\"refused\"", "the program that shows this scene begins it anew");
    assert_true(jo_scene_finish(scene, &error));
    serve_until("\"say\"", "the program has finished the scene");
    send_command("{\"do\": \"pause\", \"on\": false}");
    serve_until("\"refused\"", "cannot go on");
    jo_live_close(live);
    live = NULL;
    assert_true(find_tick() == 0); /* the scene is still there */
}

static void wrong_frames_are_refused(void **state) {
    (void)state;
    static const char *const WRONG[] = {"http://a; script-src *", "a,b", "", "'unsafe-inline'",
                                        "http://a\r\nx: y"};
    for (size_t i = 0; i < sizeof WRONG / sizeof *WRONG; i++) {
        JoLiveDef def = jo_default_live_def();
        JoError error = {0};
        def.page = test_folder;
        def.frame = WRONG[i];
        assert_null(jo_live_open(scene, &def, &error));
        assert_non_null(strstr(error.text, "does not name pages"));
    }
}

#define WITH_LIVE(test) cmocka_unit_test_setup_teardown(test, open_live, close_live)

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_LIVE(steps_of_the_program_are_shown),
        WITH_LIVE(people_let_the_scene_run_between_steps),
        WITH_LIVE(looking_changes_nothing),
        WITH_LIVE(plan_names_what_pictures_show),
        WITH_LIVE(edited_files_are_loaded_and_their_errors_shown),
        WITH_LIVE(scene_stays_with_its_program),
        WITH_LIVE(wrong_frames_are_refused),
    };
    return cmocka_run_group_tests(tests, make_session_folder, remove_test_folder);
}
