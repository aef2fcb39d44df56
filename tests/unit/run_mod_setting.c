/* Tests of settings of mods that are changed while a scene runs: behaviours are loaded with the new
   value and keep their people's states; refusals; input logs; checkpoints; watched files. */
#include <sys/stat.h>
#include <unistd.h>

#include "unit/scene_loader.h"

#define YARD                                                                                       \
    "jostle: 1\nstep: 0.05\nplaces: {goal: {point: [900, 0]}}\n"                                   \
    "groups: {one: {behaviour: own.lua, at: [[0, 0], [0, 4]]},"                                    \
    " two: {behaviour: other.lua, at: [[0, 8]]}}\nmods: {calm: {}}\n"
#define WALK(name)                                                                                 \
    "return machine { name = '" name "', start = 'Go', defaults = { speed = 1 }, states = {\n"     \
    "  Go = { steer = drift(1, 0), { to = 'On', when = after(0.2) } }, On = { steer = drift(1, "   \
    "0) "                                                                                          \
    "} } }\n"
#define SHEET                                                                                      \
    "name: calm\nversion: 1.0\napi: 1\nsettings:\n"                                                \
    "  pace: {value: 1, unit: m/s, least: 0.1, greatest: 9}\n"                                     \
    "  still: {value: false}\n  manner: {value: polite, choices: [polite, quite rude]}\n"
#define PATCH(name)                                                                                \
    "return patch '" name "' { defaults = { speed = settings.pace,\n"                              \
    "  radius = settings.manner == 'polite' and 0.2 or 0.3 },\n"                                   \
    "  states = { On = { steer = drift(settings.still and 0 or 1, 0) } } }\n"

static JoError error;

static const char *write_yard(void) {
    char folder[1024];
    write_test_file("own.lua", WALK("own"));
    write_test_file("other.lua", WALK("other"));
    const char *scene = write_test_file("scene.yaml", YARD);
    snprintf(folder, sizeof folder, "%.*s", (int)(strrchr(scene, '/') - scene), scene);
    for (const char *const *part = (const char *const[]){"/mods", "/calm", "/patches", NULL}; *part;
         part++) {
        strcat(folder, *part);
        mkdir(folder, 0700);
    }
    write_test_file("mods/calm/mod.yaml", SHEET);
    write_test_file("mods/calm/patches/own.lua", PATCH("own"));
    write_test_file("mods/calm/patches/other.lua", PATCH("other"));
    return scene;
}

static JoScene *load_yard(const char *input) {
    JoSceneDef def = define_scene(write_yard());
    def.input_log = input;
    def.resumable = true;
    return load_defined_scene(&def);
}

static double find_parameter(JoScene *scene, uint32_t rank, const char *name) {
    JoAgent all[8];
    double value = -1.0;
    assert_true(rank < jo_world_agents(jo_scene_world(scene), all, 8));
    assert_true(jo_agent_parameter(jo_scene_world(scene), all[rank], name, &value));
    return value;
}

static void settings_change_while_the_scene_runs(void **state) {
    (void)state;
    JoScene *scene = load_yard(NULL);
    step_scene(scene, 20);
    assert_float_equal(find_parameter(scene, 0, "speed"), 1.0, 1e-6);
    assert_true(jo_scene_input(scene, "setting calm pace 2.5", &error));
    step_scene(scene, 1);
    for (uint32_t rank = 0; rank < 3; rank++) /* both behaviours */
        assert_float_equal(find_parameter(scene, rank, "speed"), 2.5, 1e-6);
    assert_string_equal(
        jo_agent_state(jo_scene_world(scene), jo_world_agent_of(jo_scene_world(scene), 0)).state,
        "On"); /* nobody begins again */
    assert_non_null(
        strstr(scene_messages.data, "mod calm: pace is 2.5 m/s from t = 1.00 s (it was 1)"));
    assert_true(jo_scene_input(scene, "setting calm manner \"quite rude\"", &error));
    assert_true(jo_scene_input(scene, "setting calm still true", &error));
    step_scene(scene, 1);
    assert_float_equal(find_parameter(scene, 1, "radius"), 0.3, 1e-6);
    assert_non_null(strstr(scene_messages.data, "mod calm: still is true from"));
    jo_scene_free(scene);
}

static void wrong_changes_are_refused(void **state) {
    (void)state;
    static const char *const WRONG[][2] = {
        {"setting clam pace 2", "the scene has no mod 'clam'. Did you mean 'calm'?"},
        {"setting calm pase 2", "mod calm has no setting 'pase'. Did you mean 'pace'?"},
        {"setting calm pace 12", "setting 'pace' of mod calm must be from 0.1 to 9, not 12"},
        {"setting calm pace fast", "must be a number, not 'fast'"},
        {"setting calm still 1", "setting 'still' of mod calm must be true or false, not '1'"},
        {"setting calm manner rude", "must be polite or quite rude, not 'rude'"}};
    JoScene *scene = load_yard(NULL);
    step_scene(scene, 2);
    for (size_t w = 0; w < sizeof WRONG / sizeof *WRONG; w++) {
        error = (JoError){0};
        assert_false(jo_scene_input(scene, WRONG[w][0], &error));
        if (!strstr(error.text, WRONG[w][1]))
            fail_msg("%s: %s", WRONG[w][0], error.text);
    }
    jo_scene_free(scene);
}

/* A value with which a behaviour does not load is taken back, and leaves what runs alone. */
static void values_that_do_not_load_are_taken_back(void **state) {
    (void)state;
    JoScene *scene = load_yard(NULL);
    write_test_file(
        "mods/calm/patches/other.lua",
        "return patch 'other' { defaults = { speed = settings.pace > 2 and {} or 1 } }\n");
    step_scene(scene, 2);
    error = (JoError){0};
    assert_false(jo_scene_input(scene, "setting calm pace 2.5", &error));
    assert_non_null(strstr(error.text, "they go on as they were"));
    step_scene(scene, 1);
    assert_float_equal(find_parameter(scene, 0, "speed"), 1.0, 1e-6);
    assert_true(jo_scene_input(scene, "setting calm pace 1.5", &error));
    step_scene(scene, 1);
    assert_float_equal(find_parameter(scene, 0, "speed"), 1.5, 1e-6);
    assert_non_null(strstr(scene_messages.data, "pace is 1.5 m/s from t = 0.15 s (it was 1)"));
    jo_scene_free(scene);
}

static void logs_and_checkpoints_keep_changes(void **state) {
    (void)state;
    JoScene *scene = load_yard(NULL);
    const char *log = write_test_file("changes.log", "");
    char folder[1024];
    assert_true(jo_scene_log_input(scene, log, &error));
    step_scene(scene, 10);
    assert_true(jo_scene_input(scene, "setting calm pace 2.5", &error));
    step_scene(scene, 10);
    snprintf(folder, sizeof folder, "%.*s", (int)(strrchr(log, '/') - log), log);
    assert_true(jo_scene_checkpoint(scene, folder, 0.5, "", &error));
    step_scene(scene, 20);
    const uint64_t hash = jo_world_hash(jo_scene_world(scene));
    assert_true(jo_scene_finish(scene, &error));
    jo_scene_free(scene);

    scene = load_yard(log);
    step_scene(scene, 40);
    assert_true(hash == jo_world_hash(jo_scene_world(scene)));
    jo_scene_free(scene);

    JoSceneDef def = define_scene("unused");
    char *note;
    scene = jo_scene_resume(&def, folder, &note, &error);
    if (!scene)
        fail_msg("%s", error.text);
    jo_free(note);
    while (jo_world_time(jo_scene_world(scene)) < 1.999)
        step_scene(scene, 1);
    assert_true(hash == jo_world_hash(jo_scene_world(scene)));
    jo_scene_free(scene);
}

/* While files are watched, a thread loads the behaviours. */
static void watched_scenes_change_settings_too(void **state) {
    (void)state;
    JoScene *scene = load_yard(NULL);
    assert_true(jo_scene_watch(scene, &error));
    step_scene(scene, 2);
    assert_true(jo_scene_input(scene, "setting calm pace 2.5", &error));
    for (int i = 0; i < 500 && find_parameter(scene, 2, "speed") < 2.0; i++) {
        usleep(10000);
        step_scene(scene, 1);
    }
    assert_float_equal(find_parameter(scene, 0, "speed"), 2.5, 1e-6);
    assert_float_equal(find_parameter(scene, 2, "speed"), 2.5, 1e-6);
    assert_non_null(strstr(scene_messages.data, "mod calm: pace is 2.5 m/s from"));
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(settings_change_while_the_scene_runs),
        cmocka_unit_test(wrong_changes_are_refused),
        cmocka_unit_test(values_that_do_not_load_are_taken_back),
        cmocka_unit_test(logs_and_checkpoints_keep_changes),
        cmocka_unit_test(watched_scenes_change_settings_too),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
