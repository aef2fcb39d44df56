/* Lifts on the live page and in recordings: shafts in the scene message, cars in each frame, of the
   run and of its recording in any order. */
#include "live_recording.h"

static const char SCENE[] =
    "jostle: 1\n"
    "storeys: {ground: {height: 0}, first: {height: 4}, second: {height: 8}}\n"
    "lifts:\n"
    "  west: {area: [[1, 5], [2.6, 6.8]], door: [[1.35, 5], [2.25, 5]], storeys: [first, second]}\n"
    "  east: {area: [[10, 5], [11.6, 6.8]], door: [[10.35, 5], [11.25, 5]], capacity: 5}\n"
    "walls:\n"
    "  - {line: [[0, 0], [16, 0], [16, 8], [0, 8]], closed: true, storey: [ground, first, "
    "second]}\n"
    "places: {high: {polygon: [[1, 1], [7, 1], [7, 4], [1, 4]], storey: second}}\n"
    "groups: {people: {behaviour: own.lua, count: 6, in: high}}\n"
    "events: [{at: 40, lift: west, mode: out_of_use}]\n";
static const char RIDERS[] = MACHINE_START "\"Ride\", states = {\n"
                                           "  Ride = { steer = ride \"east.ground\", { to = "
                                           "\"Off\", when = rode } },\n"
                                           "  Off = { steer = hold } } }\n";

enum { LIFTS = 2, FRAMES = 500 };
static JoxCarLook seen_cars[FRAMES][LIFTS];

/* Compares the end of a frame message with cars. */
static void check_cars(const JoxBytes *bytes, const JoxCarLook *cars) {
    const uint8_t *at = bytes->data + bytes->length - LIFTS * JOX_LIVE_CAR;
    for (int l = 0; l < LIFTS; l++, at += JOX_LIVE_CAR) {
        assert_near(get_float(at), cars[l].height, 6e-4);
        assert_near(at[4], 255.0 * (double)cars[l].open, 0.7);
        assert_int_equal(at[5], cars[l].stop);
        assert_int_equal(at[6], cars[l].people);
        assert_int_equal(at[7], cars[l].mode);
    }
}

static void check_scene_message(const JoxText *text) {
    parse_numbers(text);
    check_name_in(text, "west");
    check_name_in(text, "east.second");
    assert_near(number_at("lifts.%d.capacity", 1, 0, 0), 5, 0);
    assert_near(number_at("lifts.%d.outline.%d.%d", 1, 2, 0), 11.6, 1e-5);
    assert_near(number_at("lifts.%d.stops.%d.storey", 0, 0, 0), 1, 0);
    assert_near(number_at("lifts.%d.stops.%d.height", 0, 1, 0), 8, 1e-6);
    assert_near(number_at("lifts.1.stops.%d.door.%d.%d", 2, 1, 0), 11.25, 1e-5);
}

/* Runs and records the scene; keeps the cars of each recorded frame. */
static void record_lifts(void) {
    JoScene *scene = load_scene_text(SCENE, RIDERS);
    JoError error = {0};
    JoxBytes bytes = {0};
    JoxText text = {0};
    snprintf(path, sizeof path, "%s/lifts.sqlite", test_folder);
    assert_true(jo_scene_record(scene, path, 0.1, &error));
    jox_live_scene(scene, false, &text);
    check_scene_message(&text);
    bool rode = false, opened = false;
    for (uint32_t f = 0; f < FRAMES; f++) {
        step_scene(scene, 2);
        for (uint32_t l = 0; l < LIFTS; l++)
            seen_cars[f][l] = jox_world_car_look(scene->world, l);
        jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &bytes);
        check_cars(&bytes, seen_cars[f]);
        rode |= seen_cars[f][1].people == 5 && seen_cars[f][1].height > 1.0f;
        opened |= seen_cars[f][1].open > 0.2f && seen_cars[f][1].open < 0.8f;
    }
    assert_true(rode && opened);
    assert_int_equal(seen_cars[FRAMES - 1][0].mode, JOX_LIFT_OUT_OF_USE);
    JoxLiveSession session = {.speed = 1};
    text.length = 0;
    jox_live_status(scene, &session, &text);
    parse_numbers(&text);
    assert_near(number_at("lifts.1.let_out", 0, 0, 0),
                (double)scene->world->state.lifts.figures[1].let_out, 0);
    assert_true(jo_scene_finish(scene, &error));
    jo_scene_free(scene);
    jox_bytes_free(&bytes);
    jox_text_free(&text);
}

static void frames_have_the_cars_of_the_run_and_of_its_recording(void **state) {
    (void)state;
    record_lifts();
    JoxReplay *replay = open_replay(path, NULL, 0);
    JoxBytes bytes = {0};
    JoxText text = {0};
    assert_int_equal(jox_replay_frames(replay), FRAMES);
    jox_replay_scene(replay, &text);
    check_scene_message(&text);
    for (uint32_t k = 0; k < 2 * FRAMES; k++) { /* in order, then in any order */
        const uint32_t f = k < FRAMES ? k : (k * 37 + 11) % FRAMES;
        if (!jox_replay_show(replay, f, &text))
            fail_msg("%s", text.data);
        jox_replay_frame(replay, JOX_LIVE_COLOUR_state, NULL, &bytes);
        check_cars(&bytes, seen_cars[f]);
    }
    jox_bytes_free(&bytes);
    jox_text_free(&text);
    jox_replay_close(replay);
}

static void recorded_lifts_are_checked(void **state) {
    (void)state;
    static const struct {
        const char *sql, *says;
    } DAMAGES[] = {
        {"UPDATE jostle_lift SET points = '1 2' WHERE number = 0",
         "table jostle_lift, number 0: points is '1 2'"},
        {"UPDATE jostle_lift SET points = '0 0, 0 2, 2 0' WHERE number = 0", "number 0: points is"},
        {"UPDATE jostle_lift SET capacity = 0 WHERE number = 1",
         "table jostle_lift, number 1: capacity is '0'"},
        {"UPDATE jostle_lift SET capacity = 'many' WHERE number = 1", "capacity is 'many'"},
        {"UPDATE jostle_lift SET number = 9 WHERE number = 1", "number is '9'"},
        {"UPDATE jostle_lift SET name = ''", "table jostle_lift, number 0: name is ''"},
        {"UPDATE jostle_lift SET name = 'same'", "number 1: name is 'same'"},
        {"DELETE FROM jostle_lift", "storey 1: lift is '0': the recording has none"},
        {"UPDATE jostle_stop SET storey = 7 WHERE lift = 0 AND storey = 2",
         "table jostle_stop, lift 0, storey 7: storey is '7'"},
        {"UPDATE jostle_stop SET door = '1 1, nan 1' WHERE lift = 1", "door is '1 1, nan 1'"},
        {"UPDATE jostle_stop SET door = '1 1, 1 1' WHERE lift = 1", "door is '1 1, 1 1'"},
        {"DELETE FROM jostle_stop WHERE lift = 1", "table jostle_stop has no storeys of lift 1"},
        {"UPDATE jostle_car SET height = 1e9 WHERE lift = 1",
         "table jostle_car, frame 1, lift 1: height is '1000000000.0'"},
        {"UPDATE jostle_car SET height = 'nan' WHERE lift = 1", "height is 'nan'"},
        {"UPDATE jostle_car SET storey = 0 WHERE lift = 0", "lift 0: storey is '0'"},
        {"UPDATE jostle_car SET storey = 99 WHERE lift = 0", "lift 0: storey is '99'"},
        {"UPDATE jostle_car SET open = -1 WHERE lift = 0", "open is '-1.0'"},
        {"UPDATE jostle_car SET mode = 'zzz' WHERE lift = 0", "mode is 'zzz'"},
        {"UPDATE jostle_car SET people = -4 WHERE lift = 0", "people is '-4'"},
    };
    for (size_t k = 0; k < sizeof DAMAGES / sizeof *DAMAGES; k++) {
        char copy[320];
        JoxDiagnostics diagnostics = {0};
        char sql[400];
        snprintf(copy, sizeof copy, "%s/damaged.sqlite", test_folder);
        snprintf(sql, sizeof sql, "VACUUM INTO '%s'", copy);
        unlink(copy);
        run_sql(path, sql);
        run_sql(copy, DAMAGES[k].sql);
        const JoxReplayDef def = {.recording = copy};
        if (jox_replay_open(&def, &diagnostics))
            fail_msg("read after %s", DAMAGES[k].sql);
        if (!strstr(diagnostics.items[0].message, DAMAGES[k].says))
            fail_msg("%s: %s", DAMAGES[k].sql, diagnostics.items[0].message);
        assert_non_null(diagnostics.items[0].hint);
        jox_diag_free(&diagnostics);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_have_the_cars_of_the_run_and_of_its_recording),
        cmocka_unit_test(recorded_lifts_are_checked),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
