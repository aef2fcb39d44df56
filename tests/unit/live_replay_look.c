/* Looks of recordings besides people: walls, floor, scenery, clothes, poses and camera. */
#include "live_recording.h"

/* A scene with all that is drawn besides people; a train that moves carries scenery. */
#define DRESSED                                                                                    \
    "jostle: 1\n"                                                                                  \
    "title: Dressed\n"                                                                             \
    "about: It has scenery.\n"                                                                     \
    "floor: marble\n"                                                                              \
    "view: {colour: speed, field: density}\n"                                                      \
    "camera: {position: [1.5, -9, 7], target: [0, 2, 0.5]}\n"                                      \
    "places: {spot: {point: [2, 3], radius: 1}, hall: {polygon: [[0, 0], [7, 0], [7, 6]]}}\n"      \
    "walls: [{line: [[8, 0], [8, 6]], name: gate, drawn: 0.4}, {line: [[9, 0], [9, 6]]}]\n"        \
    "bodies:\n"                                                                                    \
    "  - {shape: {box: {size: [1, 1, 1]}}, mass: 9, at: [40, 6, 0.5]}\n"                           \
    "  - {name: train, shape: {box: {size: [20, 3, 3]}}, kinematic: true, at: [-30, 20, 1.5],\n"   \
    "     path: {through: [[0, 20, 1.5]], speed: 5}}\n"                                            \
    "scenery:\n"                                                                                   \
    "  - {kind: bench, at: [[1, 12], [4, 12.25]], faces: [0, 0], turn: 5, colour: \"#102030\"}\n"  \
    "  - {kind: area, through: [[0, 10], [5, 10], [5, 14]]}\n"                                     \
    "  - {kind: train, at: [0, 0], body: train, doors: [-4, 4.5], size: [20, 2.8, 3.4]}\n"         \
    "groups:\n"                                                                                    \
    "  plain: {behaviour: own.lua, at: [[1, 3]]}\n"                                                \
    "  team: {behaviour: own.lua, at: [[3, 3]], clothes: sport}\n"
#define POSED                                                                                      \
    MACHINE_START "\"A\", states = { A = { steer = hold, pose = \"raise\", { to = \"B\", when = "  \
                  "after(0.5) } }, B = { steer = hold, lies = true } } }\n"

/* Returns the part of a scene message from one key up to another, to be freed. */
static char *cut_message(const JoxText *text, const char *from, const char *to) {
    const char *begin = strstr(text->data, from), *end = begin ? strstr(begin, to) : NULL;
    if (!end)
        fail_msg("no %s and %s in %s", from, to, text->data);
    return jox_strndup(begin, (size_t)(end - begin));
}

/* Asserts that two scene messages agree on title, walls, states, colouring, and all from the camera
   to the colours. */
static void check_same_looks(const JoxText *a, const JoxText *b) {
    static const char *const PARTS[][2] = {{"\"title\"", "\"file\""},
                                           {"\"walls\"", "\"regions\""},
                                           {"\"states\"", "\"machines\""},
                                           {"\"camera\"", "\"colours\""},
                                           {"\"view\"", "}"}};
    for (int p = 0; p < 5; p++) {
        char *one = cut_message(a, PARTS[p][0], PARTS[p][1]);
        char *other = cut_message(b, PARTS[p][0], PARTS[p][1]);
        assert_string_equal(one, other);
        jox_free(one);
        jox_free(other);
    }
}

static JoxText show_and_tell(JoxReplay *replay, uint32_t frame) {
    JoxText text = {0}, told = {0};
    assert_true(jox_replay_show(replay, frame, &told));
    jox_replay_scene(replay, &text);
    return text;
}

/* Returns the position of the train in the shown frame: of the body row that has its name. */
static JoxV3 find_train(JoxReplay *replay, JoxText *scene) {
    JoxBytes bytes = {0};
    jox_replay_frame(replay, JOX_LIVE_COLOUR_state, NULL, &bytes);
    const Seen seen = decode_bytes(bytes.data, bytes.length);
    assert_true(seen.bodies == 2);
    assert_non_null(strstr(scene->data, "\"bodies\": [{\"name\": null"));
    assert_non_null(strstr(scene->data, "\"name\": \"train\""));
    assert_int_equal((seen.slot[7] & JOX_LIVE_LIES) == JOX_LIVE_LIES, seen.slot[5] == 1);
    const JoxV3 at = {get_float(seen.body + 20), get_float(seen.body + 24),
                      get_float(seen.body + 28)};
    jox_bytes_free(&bytes);
    return at;
}

/* A recording shows what its scene shows, without the scene: also what a body carries. */
static void recording_shows_what_its_scene_shows(void **state) {
    (void)state;
    if (!jox_bodies_available()) /* scenes with bodies are refused */
        skip();
    JoScene *scene = load_scene_text(DRESSED, POSED);
    JoError error = {0};
    JoxText live = {0};
    const char *file = test_path("dressed.sqlite");
    assert_true(jo_scene_record(scene, file, 0.0, &error));
    step_scene(scene, 40);
    jox_live_scene(scene, true, &live);
    JoxPose pose = {0};
    assert_true(jox_bodies_pose(scene->world->state.bodies, 1, &pose));
    assert_true(jo_scene_finish(scene, &error));
    jo_scene_free(scene);
    JoxReplay *alone = open_replay(file, NULL, 0);
    JoxReplay *with = open_replay(file, test_path("scene.yaml"), 0);
    const uint32_t last = jox_replay_frames(alone) - 1;
    JoxText one = show_and_tell(alone, last), other = show_and_tell(with, last);
    check_same_looks(&live, &one);
    check_same_looks(&live, &other);
    assert_non_null(strstr(one.data, "\"floor\": \"marble\""));
    assert_non_null(strstr(one.data, "\"clothes\": {\"team\": \"sport\"}"));
    assert_non_null(strstr(one.data, "\"pose\": \"raise\""));
    const JoxV3 at = find_train(alone, &one);
    assert_near(at.x, pose.position.x, 1e-4);
    assert_near(at.z, pose.position.z, 1e-4);
    assert_true(at.x > -25.0f); /* it has moved */
    JoxText told = {0};
    assert_true(jox_replay_show(alone, 0, &told));
    assert_true(find_train(alone, &one).x < -29.0f);
    jox_text_free(&live);
    jox_text_free(&one);
    jox_text_free(&other);
    jox_replay_close(alone);
    jox_replay_close(with);
}

/* The look in a recording may be any text, and older ones have none. */
static void looks_of_recordings_are_checked(void **state) {
    (void)state;
    if (!jox_bodies_available()) /* there is no recording to damage */
        skip();
    static const char *const WRONG[] = {
        "marble",
        "{\"floor\": \"lava\"}",
        "{\"view\": {\"colour\": \"taste\"}}",
        "{\"places\": [{\"name\": \"a\", \"kind\": \"polygon\", \"radius\": 0, \"points\": [[0, "
        "0], [1, "
        "0]]}]}",
        "{\"places\": [{\"kind\": \"point\", \"radius\": 1, \"points\": [[0, 0]]}]}",
        "{\"places\": [{\"name\": \"a\", \"kind\": \"swamp\", \"radius\": 1, \"points\": [[0, "
        "0]]}]}",
        "{\"places\": [{\"name\": \"a\", \"kind\": \"point\", \"radius\": -1, \"points\": [[0, "
        "0]]}]}",
        "{\"view\": {\"field\": \"meadow\"}}",
        "{\"camera\": {\"at\": [1, 2, 3], \"look\": [1, 2, 3]}}",
        "{\"camera\": {\"at\": [1, 2, 3, 4], \"look\": [1, 2, 2]}}",
        "{\"camera\": {\"at\": [1e9, 2, 3], \"look\": [1, 2, 2]}}",
        "{\"scenery\": [{\"kind\": \"tree\"}]}",
        "{\"scenery\": [{\"kind\": \"dragon\", \"at\": [[0, 0]], \"turns\": [0], \"size\": [1, 1, "
        "1]}]}",
        "{\"scenery\": [{\"kind\": \"tree\", \"at\": [[0, 0]], \"turns\": [], \"size\": [1, 1, "
        "1]}]}",
        "{\"scenery\": [{\"kind\": \"tree\", \"at\": [[0, 0]], \"turns\": [0], \"size\": [1, 1]}]}",
        "{\"scenery\": [{\"kind\": \"tree\", \"at\": [[0, 1e999]], \"turns\": [0], \"size\": [1, "
        "1, 1]}]}",
        "{\"scenery\": [{\"kind\": \"tree\", \"at\": [[0, 0, 0]], \"turns\": [0], \"size\": [1, 1, "
        "1]}]}",
        "{\"scenery\": [{\"kind\": \"tree\", \"at\": {\"7\": {\"1\": 0}}, \"turns\": [0], "
        "\"size\": [1, 1, "
        "1]}]}",
        "{\"scenery\": [{\"kind\": \"tree\", \"at\": [[0, 0]], \"turns\": [0], \"size\": [1, -1, "
        "1]}]}",
        "{\"scenery\": [{\"kind\": \"line\", \"through\": [[0, 0]], \"turns\": [], \"size\": [0, "
        "1, 1]}]}",
        "{\"scenery\": [{\"kind\": \"tree\", \"at\": [[0, 0]], \"turns\": [0], \"size\": [1, 1, "
        "1], "
        "\"colour\": \"dull\"}]}",
        "{\"scenery\": [3]}",
        "{\"scenery\": {\"x\": {}}}"};
    const char *file = test_path("dressed.sqlite");
    for (size_t w = 0; w < sizeof WRONG / sizeof *WRONG; w++) {
        JoxText sql = {0}, text = {0}, told = {0};
        JoxDiagnostics diagnostics = {0};
        jox_text_printf(&sql, "UPDATE metadata SET value = '%s' WHERE key = 'jostle_look'",
                        WRONG[w]);
        run_sql(file, sql.data);
        JoxReplay *replay = jox_replay_open(&(JoxReplayDef){.recording = file}, &diagnostics);
        assert_non_null(replay);
        if (diagnostics.count != 1)
            fail_msg("no warning of %s", WRONG[w]);
        assert_non_null(strstr(diagnostics.items[0].message, "damaged"));
        assert_true(jox_replay_show(replay, 0, &told));
        jox_replay_scene(replay, &text);
        assert_non_null(
            strstr(text.data, "\"camera\": null, \"floor\": \"plain\", \"scenery\": []"));
        jox_replay_close(replay);
        jox_diag_free(&diagnostics);
        jox_text_free(&sql);
        jox_text_free(&text);
    }
    run_sql(file,
            "UPDATE jostle_state SET pose = 'fly'; UPDATE jostle_group SET clothes = 'none';"
            "UPDATE jostle_wall SET drawn = 9e99; DELETE FROM metadata WHERE key = 'jostle_look'");
    for (int old = 0; old < 2; old++) {
        JoxReplay *replay = open_replay(file, NULL, 0);
        JoxText text = show_and_tell(replay, 0);
        assert_non_null(strstr(text.data, "\"clothes\": {}"));
        assert_null(strstr(text.data, "\"pose\""));
        check_name_in(&text, "gate");
        check_name_in(&text, "team");
        check_name_in(&text, "B");
        jox_text_free(&text);
        jox_replay_close(replay);
        if (!old)
            run_sql(file,
                    "ALTER TABLE jostle_state DROP COLUMN pose; ALTER TABLE jostle_group DROP "
                    "COLUMN clothes; ALTER TABLE jostle_wall DROP COLUMN drawn; ALTER TABLE "
                    "jostle_part DROP COLUMN name");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(recording_shows_what_its_scene_shows),
        cmocka_unit_test(looks_of_recordings_are_checked),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
