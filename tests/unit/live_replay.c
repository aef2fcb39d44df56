/* Recordings on the live page: frames shown in any order match the run that was recorded, and
   damaged files give errors. */
#include "live_recording.h"

/* Shows a frame and compares it with the run's; writes the slot of each person, by id, to
   `slots`. */
static void check_frame(JoxReplay *replay, uint32_t frame, uint32_t *slots) {
    const struct Recorded *f = &recorded[frame];
    JoxBytes bytes = {0};
    JoxText told = {0};
    if (!jox_replay_show(replay, frame, &told))
        fail_msg("%s", told.data);
    jox_replay_frame(replay, JOX_LIVE_COLOUR_state, NULL, &bytes);
    const Seen seen = decode_bytes(bytes.data, bytes.length);
    const double ROUNDED = 6e-5; /* m: recordings are rounded to 0.1 mm */
    bool taken[4000] = {false};
    uint32_t people = 0;
    assert_near(seen.time, f->time, 1e-6);
    for (uint32_t s = 0; s < seen.slots; s++)
        people += seen.slot[8 * (size_t)s + 5] != 255;
    assert_int_equal(people, f->count);
    for (uint32_t p = 0; p < f->count; p++) {
        uint32_t s = 0, id = f->people[p].id;
        for (s = 0; s < seen.slots; s++)
            if (seen.slot[8 * (size_t)s + 5] != 255 && !taken[s] &&
                fabs(x_of(&seen, s) - (double)f->people[p].x) <=
                    0.501 * (double)seen.sx + ROUNDED &&
                fabs(y_of(&seen, s) - (double)f->people[p].y) <= 0.501 * (double)seen.sy + ROUNDED)
                break;
        assert_true(s < seen.slots);
        taken[s] = true;
        assert_int_equal(seen.slot[8 * (size_t)s + 5], f->people[p].state[0] == 'B');
        slots[id] = s;
    }
    assert_int_equal(seen.bodies, f->bodies);
    for (uint32_t b = 0; b < f->bodies; b++) {
        assert_near(get_float(seen.body + 20 * b), f->body[b].x, 1e-5);
        assert_near(get_float(seen.body + 20 * b + 8), f->body[b].z, 1e-5);
    }
    jox_bytes_free(&bytes);
}

static void shown_frames_match_the_recording(void **state) {
    (void)state;
    record_room();
    JoxReplay *replay = open_replay(path, NULL, 0);
    assert_int_equal(jox_replay_frames(replay), recorded_count);
    static uint32_t slots[4000], before[4000];
    for (uint32_t f = 0; f < recorded_count; f++) {
        assert_near(jox_replay_time(replay, f), recorded[f].time, 1e-9);
        assert_int_equal(jox_replay_find(replay, recorded[f].time + 0.01), f);
        memcpy(before, slots, sizeof slots);
        check_frame(replay, f, slots);
        /* People of the frame before keep their slots. */
        for (uint32_t p = 0; f > 0 && p < recorded[f - 1].count; p++)
            for (uint32_t q = 0; q < recorded[f].count; q++)
                if (recorded[f].people[q].id == recorded[f - 1].people[p].id)
                    assert_int_equal(slots[recorded[f].people[q].id],
                                     before[recorded[f].people[q].id]);
    }
    assert_int_equal(jox_replay_find(replay, -5), 0);
    assert_int_equal(jox_replay_find(replay, 1e9), recorded_count - 1);
    /* Frames in arbitrary order. */
    uint32_t at = 7;
    for (int k = 0; k < 60; k++) {
        at = (at * 37 + 11) % recorded_count;
        check_frame(replay, at, slots);
    }
    jox_replay_close(replay);
}

/* Speeds come from displacements and densities from positions, whichever frame is shown first. */
static void speeds_and_densities_match_the_frames(void **state) {
    (void)state;
    JoxReplay *replay = open_replay(path, NULL, 0), *other = open_replay(path, NULL, 0);
    JoxBytes bytes = {0}, more = {0};
    JoxText told = {0}, text = {0};
    for (uint32_t f = 0; f < 30; f++)
        assert_true(jox_replay_show(replay, f, &told));
    assert_true(jox_replay_show(other, 29, &told));
    jox_replay_frame(replay, JOX_LIVE_COLOUR_speed, NULL, &bytes);
    jox_replay_frame(other, JOX_LIVE_COLOUR_speed, NULL, &more);
    uint32_t histogram[2][256] = {{0}};
    for (int k = 0; k < 2; k++) {
        const JoxBytes *b = k ? &more : &bytes;
        const Seen seen = decode_bytes(b->data, b->length);
        for (uint32_t s = 0; s < seen.slots; s++)
            if (seen.slot[8 * (size_t)s + 5] != 255)
                histogram[k][seen.slot[8 * (size_t)s + 6]]++;
    }
    assert_memory_equal(histogram[0], histogram[1], sizeof histogram[0]);
    assert_true(histogram[0][0] < recorded[29].count); /* some people walk */
    JoxLiveSession session = {.speed = 2, .jumps = 7};
    jox_replay_forget(other); /* speeds are known right after a jump; not in the first frame */
    assert_true(jox_replay_show(other, 29, &told));
    jox_replay_status(other, &session, 1.5, &text);
    parse_numbers(&text);
    const double speed = number_at("mean_speed", 0, 0, 0);
    assert_true(speed > 0.0);
    assert_near(number_at("jumps", 0, 0, 0), 7, 0);
    assert_true(jox_replay_show(other, 0, &told));
    text.length = 0;
    jox_replay_status(other, &session, 1.5, &text);
    assert_non_null(strstr(text.data, "\"mean_speed\": null"));
    text.length = 0;
    jox_replay_status(replay, &session, 1.5, &text);
    parse_numbers(&text);
    assert_near(number_at("mean_speed", 0, 0, 0), speed, 1e-6);
    assert_near(number_at("agents", 0, 0, 0), recorded[29].count, 0);
    assert_near(number_at("time", 0, 0, 0), recorded[29].time, 1e-6);
    assert_near(number_at("states.0.0", 0, 0, 0) + number_at("states.0.1", 0, 0, 0),
                recorded[29].count, 0);
    const double most = number_at("density_max", 0, 0, 0);
    jox_replay_field(replay, JOX_LIVE_DENSITY, NULL, &bytes);
    assert_near(get_float(bytes.data + 28), most, 1e-3);
    assert_true(most > 0.5);
    jox_replay_field(replay, JOX_LIVE_PRESSURE, NULL, &bytes);
    assert_true(get_float(bytes.data + 28) > 0.0f);
    assert_true(jox_replay_people(replay, &bytes));
    assert_false(jox_replay_people(replay, &bytes));
    assert_int_equal(bytes.data[16], 20);
    jox_bytes_free(&bytes);
    jox_bytes_free(&more);
    jox_text_free(&text);
    jox_text_free(&told);
    jox_replay_close(replay);
    jox_replay_close(other);
}

static void scene_message_of_a_recording(void **state) {
    (void)state;
    const char *scene = test_path("scene.yaml");
    for (int k = 0; k < 2; k++) {
        JoxReplay *replay = open_replay(path, k ? scene : NULL, 0);
        JoxText text = {0}, told = {0};
        assert_true(jox_replay_show(replay, 0, &told));
        jox_replay_scene(replay, &text);
        parse_numbers(&text);
        check_name_in(&text, "replay");
        check_name_in(&text, "people");
        check_name_in(&text, "more");
        check_name_in(&text, "A");
        assert_non_null(strstr(text.data, "\"throw\": false"));
        assert_near(number_at("dt", 0, 0, 0), 0.1, 1e-9);
        assert_near(number_at("duration", 0, 0, 0), 10, 1e-6);
        if (recorded[0].bodies) {
            assert_near(number_at("bodies.0.parts.0.size.0", 0, 0, 0), 0.3, 1e-6);
            /* Parts of the compound body, whose axes of inertia differ from its own axes. */
            static const double TABLE[2][6] = {{1.5, 1, 0.5, 0, 0, 0},
                                               {0.2, 0.8, NAN, 0.5, 0.3, 0.65}};
            for (int part = 0; part < 2; part++)
                for (int n = 0; n < 6 - part; n++) {
                    const int of = n < 3 - part ? n : n - 3 + part;
                    const bool size = n < 3 - part;
                    assert_near(
                        number_at(size ? "bodies.1.parts.%d.size.%d" : "bodies.1.parts.%d.at.%d",
                                  part, of, 0),
                        TABLE[part][size ? of : 3 + of], 1e-5);
                }
            assert_near(number_at("bodies.1.parts.1.turn.3", 0, 0, 0), 1, 1e-6);
            double highest = 0; /* greatest z of the pyramid's five corners */
            for (int c = 0; c < 5; c++)
                highest = fmax(highest, number_at("bodies.2.parts.0.points.%d.2", c, 0, 0) +
                                            number_at("bodies.2.parts.0.at.2", 0, 0, 0));
            assert_near(highest, 1.5, 1e-3);
            assert_true(isnan(number_at("bodies.2.parts.0.points.5.0", 0, 0, 0)));
        }
        if (k)
            check_name_in(&text, "west");
        assert_near(number_at("walls.0.points.1.0", 0, 0, 0), 14, 1e-5);
        assert_true(isnan(number_at("walls.0.points.2.0", 0, 0, 0)));
        assert_near(number_at("walls.1.points.2.1", 0, 0, 0), 14, 1e-5);
        assert_near(number_at("walls.2.points.4.0", 0, 0, 0), -10, 1e-5); /* closed */
        assert_near(number_at("walls.2.height", 0, 0, 0), 1.5, 1e-5);
        check_name_in(&text, "gate");
        assert_true(isnan(number_at("walls.3.height", 0, 0, 0)));
        jox_text_free(&text);
        jox_replay_close(replay);
    }
}

/* ---- other files ---- */

/* The density of two people at both sides of a periodic edge is the same in the recording as in the
   run. */
static void density_wraps_at_periodic_edges(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\n"
        "bounds: [[0, 0], [20, 6]]\n"
        "periodic: x\n"
        "groups: {people: {behaviour: own.lua, at: [[0.3, 3], [19.7, "
        "3]]}}\n",
        MACHINE_START "\"A\", states = { A = { steer = hold, radius = 0.3, { to = \"B\", "
                      "when = after(0.5) } }, B = { steer = hold, radius = 0.6 } } "
                      "}\n");
    JoError error = {0};
    JoxText text = {0}, told = {0};
    const char *file = test_path("other.sqlite"), *plan = test_path("scene.yaml");
    unlink(file);
    assert_true(jo_scene_record(scene, file, 0.0, &error));
    step_scene(scene, 4);
    jox_live_status(scene, &(JoxLiveSession){.speed = 1}, &text);
    parse_numbers(&text);
    const double most = number_at("density_max", 0, 0, 0);
    assert_true(jo_scene_finish(scene, &error));
    jo_scene_free(scene);
    JoxReplay *replay = open_replay(file, plan, 0);
    assert_true(jox_replay_show(replay, 1, &told));
    text.length = 0;
    jox_replay_status(replay, &(JoxLiveSession){.speed = 1}, 1, &text);
    parse_numbers(&text);
    assert_near(number_at("density_max", 0, 0, 0), most, 0.05 * most);
    jox_replay_close(replay);
    jox_text_free(&text);
}

/* An open gate and a changed radius are shown as of each frame, in any order of frames. */
static void gates_and_radii_follow_the_shown_frame(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text("jostle: 1\n"
                        "walls: [{line: [[8, 0], [8, 6]], name: gate}]\n"
                        "groups: {people: {behaviour: own.lua, at: [[1, 3]]}}\n",
                        MACHINE_START "\"A\", states = { A = { steer = hold, radius = 0.3, { to "
                                      "= \"B\", when = after(0.5) } }, B = { steer = hold, "
                                      "radius = 0.6 } } }\n");
    JoError error = {0};
    JoxText text = {0}, told = {0};
    JoxBytes people = {0};
    const char *file = test_path("other.sqlite");
    unlink(file);
    assert_true(jo_scene_record(scene, file, 0.0, &error));
    step_scene(scene, 20);
    assert_true(jo_scene_input(scene, "open gate", &error));
    step_scene(scene, 20);
    assert_true(jo_scene_finish(scene, &error));
    jo_scene_free(scene);
    JoxReplay *replay = open_replay(file, NULL, 0);
    for (int k = 0; k < 3; k++) {
        const uint32_t last = jox_replay_frames(replay) - 1;
        const bool late = k == 1;
        assert_true(jox_replay_show(replay, late ? last : 1, &told));
        text.length = 0;
        jox_replay_status(replay, &(JoxLiveSession){.speed = 1}, 1, &text);
        check_name_in(&text, "walls");
        assert_non_null(strstr(text.data, late ? "\"gate\": true" : "\"gate\": false"));
        jox_replay_people(replay, &people);
        assert_int_equal(people.data[16], late ? 60 : 30);  /* cm */
        assert_true(jox_replay_version(replay) >> 32 == 0); /* gates need no new scene message */
    }
    jox_replay_close(replay);
    jox_bytes_free(&people);
    jox_text_free(&text);
}

static void copy_recording(const char *from, const char *to) {
    size_t length;
    char *text = jox_read_file(from, 1 << 30, &length);
    FILE *file = fopen(to, "wb");
    assert_non_null(text);
    assert_int_equal(fwrite(text, 1, length, file), length);
    fclose(file);
    jox_free(text);
}

/* Puts the same rows into a table without a key. */
#define WITHOUT_KEY                                                                                \
    "CREATE TABLE t AS SELECT * FROM trajectory_data ORDER BY frame, id;"                          \
    "DROP VIEW trajectory_data; DROP TABLE jostle_row; ALTER TABLE t RENAME TO trajectory_data;"

/* Recordings of other programs, without the index and without sorted rows, give the same frames. */
static void recordings_without_index_or_order_are_read(void **state) {
    (void)state;
    static uint32_t slots[4000];
    const char *other = test_path("other.sqlite");
    copy_recording(path, other);
    run_sql(other, WITHOUT_KEY "DROP TABLE frame_data");
    JoxReplay *replay = open_replay(other, NULL, 0);
    assert_int_equal(jox_replay_frames(replay), recorded_count);
    check_frame(replay, 60, slots);
    check_frame(replay, 3, slots);
    check_frame(replay, recorded_count - 1, slots);
    jox_replay_close(replay);
    run_sql(other,
            "CREATE TABLE t AS SELECT frame, id, pos_x, pos_y FROM trajectory_data ORDER BY id;"
            "DROP TABLE trajectory_data; ALTER TABLE t RENAME TO trajectory_data;"
            "DROP TABLE jostle_state; DROP TABLE jostle_body; DROP TABLE "
            "jostle_part");
    replay = open_replay(other, NULL, 0);
    assert_int_equal(jox_replay_frames(replay), recorded_count);
    JoxBytes bytes = {0};
    JoxText told = {0};
    assert_true(jox_replay_show(replay, 50, &told));
    jox_replay_frame(replay, JOX_LIVE_COLOUR_state, NULL, &bytes);
    Seen seen = decode_bytes(bytes.data, bytes.length);
    uint32_t people = 0;
    for (uint32_t s = 0; s < seen.slots; s++)
        people += seen.slot[8 * (size_t)s + 5] == 254; /* their states are unknown */
    assert_int_equal(people, recorded[50].count);
    jox_replay_close(replay);
    write_test_file(
        "walk.txt",
        "#framerate: 10\n# id frame x/m y/m\n7 10 0 -1\n7 11 0.1 -1\n7 12 0.2 -1\n3 12 5 5\n");
    replay = open_replay(test_path("walk.txt"), NULL, 0);
    assert_int_equal(jox_replay_frames(replay), 3);
    assert_true(jox_replay_show(replay, 2, &told));
    jox_replay_frame(replay, JOX_LIVE_COLOUR_speed, NULL, &bytes);
    seen = decode_bytes(bytes.data, bytes.length);
    assert_near(seen.time, 1.2, 1e-9);
    for (uint32_t s = 0; s < 2; s++) {
        bool walks = y_of(&seen, s) < 0;
        assert_near(x_of(&seen, s), walks ? 0.2 : 5, 1e-3);
        assert_near(seen.slot[8 * s + 6] / 255.0 * 2, walks ? 1 : 0, 0.02);
    }
    jox_bytes_free(&bytes);
    jox_replay_close(replay);
}

/* Opens a file with any content and shows all its frames; false with errors in `told`. */
static bool show_all_frames(const char *file, JoxText *told) {
    JoxDiagnostics diagnostics = {0};
    const JoxReplayDef def = {.recording = file};
    JoxReplay *replay = jox_replay_open(&def, &diagnostics);
    JoxBytes bytes = {0};
    assert_int_equal(replay == NULL, diagnostics.errors > 0);
    if (!replay)
        jox_diag_print(&diagnostics, told);
    bool good = replay != NULL;
    for (uint32_t f = 0; replay && f < jox_replay_frames(replay) && f < 500; f++) {
        const size_t said_before = told->length;
        const bool shown = jox_replay_show(replay, f, told);
        assert_int_equal(shown, told->length == said_before);
        good &= shown;
        jox_replay_frame(replay, JOX_LIVE_COLOUR_density, NULL, &bytes);
    }
    jox_bytes_free(&bytes);
    jox_diag_free(&diagnostics);
    jox_replay_close(replay);
    return good;
}

static void damaged_recordings_give_errors(void **state) {
    (void)state;
    const char *other = test_path("broken.sqlite");
    size_t length;
    char *text = jox_read_file(path, 1 << 30, &length);
    uint32_t wrong = 0;
    for (int k = 0; k < 60; k++) {
        JoxText told = {0};
        char *bad = jox_alloc(length, 1);
        memcpy(bad, text, length);
        size_t kept = k < 20 ? length * (size_t)k / 20 : length;
        for (size_t n = 0; k >= 20 && n < 400; n++) /* 400 bytes of noise */
            bad[((size_t)(k - 19) * 7919 * 64 + n) % length] = (char)(n * 151 + (size_t)k * 17);
        FILE *file = fopen(other, "wb");
        fwrite(bad, 1, kept, file);
        fclose(file);
        wrong += !show_all_frames(other, &told);
        jox_text_free(&told);
        jox_free(bad);
    }
    jox_free(text);
    assert_true(wrong >= 20); /* all that were cut and some with noise */
    static const struct {
        const char *sql, *says;
    } CASES[] = {
        {"UPDATE jostle_row SET x = 1e34 WHERE frame = 20 AND id = 3", "1000 km"},
        {WITHOUT_KEY "CREATE INDEX i ON trajectory_data(frame, id);"
                     "INSERT INTO trajectory_data SELECT * FROM trajectory_data WHERE frame = 9 "
                     "AND id = 4",
         "twice"},
        {"DELETE FROM metadata", "how many frames"},
        {"UPDATE metadata SET value = '-3' WHERE key = 'fps'", "how many frames"},
        {"DELETE FROM jostle_row", "nobody"},
        {"UPDATE frame_data SET frame = 1e17 WHERE frame = 1", "30 years"},
        {"ALTER TABLE jostle_row RENAME TO t", "trajectory_data"},
        {"UPDATE jostle_body SET x = 9e999 WHERE frame = 5",
         "the position or turn of a body is not finite"},
    };
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) {
        JoxText told = {0};
        copy_recording(path, other);
        if (recorded[0].bodies == 0 && strstr(CASES[c].sql, "jostle_body"))
            continue;
        run_sql(other, CASES[c].sql);
        assert_false(show_all_frames(other, &told));
        if (!strstr(told.data, CASES[c].says))
            fail_msg("%s: %s", CASES[c].sql, told.data);
        jox_text_free(&told);
    }
    JoxText told = {0};
    assert_false(show_all_frames("/nowhere/at.all", &told));
    assert_non_null(strstr(told.data, "cannot be read"));
    jox_text_free(&told);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shown_frames_match_the_recording),
        cmocka_unit_test(speeds_and_densities_match_the_frames),
        cmocka_unit_test(scene_message_of_a_recording),
        cmocka_unit_test(recordings_without_index_or_order_are_read),
        cmocka_unit_test(density_wraps_at_periodic_edges),
        cmocka_unit_test(gates_and_radii_follow_the_shown_frame),
        cmocka_unit_test(damaged_recordings_give_errors),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
