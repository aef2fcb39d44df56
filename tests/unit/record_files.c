/* Recordings: read back, after a crash, beside other files. Also densities, regions and joined
   summaries against plain references. */
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>
#include <sqlite3.h>

#include "record/aggregate.h"
#include "record/fields/density.h"
#include "record/recorder.h"
#include "record/regions.h"
#include "unit/test_folder.h"

static char path[320];
static const char WKT[] = "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))";

static int make_recording_folder(void **state) {
    const int failed = make_test_folder(state);
    snprintf(path, sizeof path, "%s", test_path("a.sqlite"));
    return failed;
}

/* Fails where another file is left beside the recording. */
static int remove_recording_folder(void **state) {
    (void)state;
    unlink(path);
    return rmdir(test_folder);
}

/* Submits frame f: people 0 to 2 at (f + id/4, -f), looking along +y, in state id. */
static bool submit_test_frame(JoxRecorder *r, uint32_t f, JoxText *error) {
    JoxRecordBody *bodies;
    JoxRecordRow *rows = jox_recorder_begin_frame(r, 3, 1, &bodies);
    for (uint32_t i = 0; i < 3; i++)
        rows[i] = (JoxRecordRow){i,         (float)f + 0.25f * (float)i,
                                 -(float)f, 0,
                                 1,         i,
                                 10.5f,     2.5f,
                                 3.5f,      0,
                                 0.25f,     NAN,
                                 NAN,       NAN,
                                 0};
    bodies[0] = (JoxRecordBody){7, (float)f, 2, 3, 0, 0, 0, 1};
    return jox_recorder_submit_frame(r, f, error);
}

/* Returns the first column of the first row. */
static double query_test_number(sqlite3 *db, const char *sql) {
    sqlite3_stmt *statement;
    assert_int_equal(sqlite3_prepare_v2(db, sql, -1, &statement, NULL), SQLITE_OK);
    assert_int_equal(sqlite3_step(statement), SQLITE_ROW);
    double value = sqlite3_column_double(statement, 0);
    sqlite3_finalize(statement);
    return value;
}

static void recording_reads_back(void **state) {
    (void)state;
    JoxText error = {0};
    for (int again = 0; again < 2; again++) { /* the second replaces the first */
        JoxRecorder *r = jox_recorder_open(path, 20, WKT, NULL, &error);
        assert_non_null(r);
        for (uint32_t k = 0; k < 3; k++)
            jox_recorder_state(r, k, "machine", k ? "Go" : "Wait", 0, NULL);
        for (uint32_t f = 0; f < 100; f++)
            assert_true(submit_test_frame(r, f, &error));
        assert_true(jox_recorder_close(r, &error));
    }
    assert_null(error.data);
    sqlite3 *db;
    assert_int_equal(sqlite3_open_v2(path, &db, SQLITE_OPEN_READONLY, NULL), SQLITE_OK);
    assert_true(query_test_number(db, "SELECT count(*) FROM trajectory_data") == 300);
    assert_true(query_test_number(db, "SELECT count(*) FROM frame_data") == 100);
    assert_true(query_test_number(
                    db, "SELECT count(*) FROM trajectory_data WHERE pos_x = frame + id / 4.0 AND "
                        "pos_y = -frame AND ori_x = 0 AND ori_y = 1") == 300);
    assert_true(query_test_number(
                    db,
                    "SELECT count(*) FROM trajectory_data WHERE state = id AND force = 10.5 AND "
                    "compression = 2.5 AND load = 3.5") == 300);
    assert_true(query_test_number(
                    db, "SELECT count(*) FROM jostle_body WHERE id = 7 AND x = frame AND y = 2 AND "
                        "z = 3 AND qw = 1") == 100);
    assert_true(query_test_number(db,
                                  "SELECT count(*) FROM jostle_state WHERE machine = 'machine' AND "
                                  "state = iif(number = 0, 'Wait', 'Go')") == 3);
    assert_true(query_test_number(db, "SELECT value FROM metadata WHERE key = 'version'") == 2);
    assert_true(query_test_number(db, "SELECT value FROM metadata WHERE key = 'fps'") == 20);
    assert_true(query_test_number(db, "SELECT value FROM metadata WHERE key = 'xmin'") == 0);
    assert_true(query_test_number(db, "SELECT value FROM metadata WHERE key = 'xmax'") == 99.5);
    assert_true(query_test_number(db, "SELECT value FROM metadata WHERE key = 'ymin'") == -99);
    assert_true(query_test_number(db, "SELECT value FROM metadata WHERE key = 'ymax'") == 0);
    assert_true(query_test_number(
                    db, "SELECT count(*) FROM geometry JOIN frame_data ON hash = geometry_hash "
                        "WHERE wkt = 'POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))'") == 100);
    sqlite3_close(db);
    unlink(path); /* no other file is left beside it, or remove_recording_folder would fail */
}

static void killed_writer_leaves_complete_frames(void **state) {
    (void)state;
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        JoxText error = {0};
        JoxRecorder *r = jox_recorder_open(path, 20, WKT, NULL, &error);
        for (uint32_t f = 0; r && f < 10000; f++) {
            submit_test_frame(r, f, &error);
            usleep(5000);
        }
        _exit(1);
    }
    usleep(2500000);
    kill(child, SIGKILL);
    int status;
    waitpid(child, &status, 0);
    assert_true(WIFSIGNALED(status));
    sqlite3 *db;
    assert_int_equal(sqlite3_open_v2(path, &db, SQLITE_OPEN_READWRITE, NULL), SQLITE_OK);
    double frames = query_test_number(db, "SELECT count(*) FROM frame_data");
    assert_true(frames > 20);
    assert_true(query_test_number(db, "SELECT max(frame) + 1 FROM frame_data") == frames);
    assert_true(query_test_number(db, "SELECT count(*) FROM trajectory_data") == 3 * frames);
    assert_true(query_test_number(db, "SELECT count(*) FROM jostle_body") == frames);
    assert_true(
        query_test_number(db, "SELECT count(*) FROM pragma_integrity_check WHERE integrity_check = "
                              "'ok'") == 1);
    assert_true(query_test_number(db, "SELECT value FROM metadata WHERE key = 'xmax'") ==
                frames - 0.5);
    sqlite3_close(db);
    JoxText error = {0};
    JoxRecorder *r = jox_recorder_open(path, 20, WKT, NULL, &error); /* it can be replaced */
    assert_non_null(r);
    assert_true(submit_test_frame(r, 0, &error) && jox_recorder_close(r, &error));
    unlink(path);
}

/* A run may pause after a frame: it must be committed before the next one. Waits at most 20 s. */
static void last_frame_is_committed_without_a_next(void **state) {
    (void)state;
    JoxText error = {0};
    JoxRecorder *r = jox_recorder_open(path, 20, WKT, NULL, &error);
    assert_non_null(r);
    assert_true(submit_test_frame(r, 0, &error));
    sqlite3 *db;
    assert_int_equal(sqlite3_open_v2(path, &db, SQLITE_OPEN_READONLY, NULL), SQLITE_OK);
    double frames = 0;
    for (int wait = 0; wait < 200 && frames < 1; wait++) {
        usleep(100000);
        frames = query_test_number(db, "SELECT count(*) FROM frame_data");
    }
    assert_true(frames == 1);
    sqlite3_close(db);
    assert_null(jox_recorder_open(path, 20, WKT, NULL, &error)); /* another run writes it */
    assert_non_null(strstr(error.data, "another run writes it"));
    jox_text_free(&error);
    assert_true(jox_recorder_close(r, &error));
    r = jox_recorder_continue(path, 0, NULL, &error);
    assert_non_null(r);
    assert_true(submit_test_frame(r, 1, &error) && jox_recorder_close(r, &error));
    r = jox_recorder_continue(path, 0, NULL, &error); /* removes the second frame again */
    assert_non_null(r);
    assert_true(jox_recorder_close(r, &error));
    assert_int_equal(sqlite3_open_v2(path, &db, SQLITE_OPEN_READONLY, NULL), SQLITE_OK);
    assert_true(query_test_number(db, "SELECT count(*) FROM frame_data") == 1);
    assert_true(query_test_number(db, "SELECT count(*) FROM trajectory_data") == 3);
    sqlite3_close(db);
    unlink(path);
    assert_null(jox_recorder_continue(path, 0, NULL, &error));
    assert_non_null(strstr(error.data, "there is no recording"));
    jox_text_free(&error);
}

static void assert_refused(const char *where, const char *why) {
    JoxText error = {0};
    assert_null(jox_recorder_open(where, 20, WKT, NULL, &error));
    assert_non_null(error.data);
    assert_non_null(strstr(error.data, where));
    assert_non_null(strstr(error.data, why));
    jox_text_free(&error);
}

static void other_files_are_not_replaced(void **state) {
    (void)state;
    assert_refused("/nowhere/at/all.sqlite", "cannot record to");
    assert_refused(test_folder, "not a recording");
    assert_refused("/dev/null", "not a recording");
    FILE *file = fopen(path, "w");
    fputs("dear diary", file);
    fclose(file);
    assert_refused(path, "not a recording");
    struct stat info;
    assert_true(stat(path, &info) == 0 && info.st_size == 10);
    unlink(path);
    sqlite3 *db;
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, "CREATE TABLE diary(day)", NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
    assert_refused(path, "not a recording");
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    assert_true(query_test_number(db, "SELECT count(*) FROM diary") == 0);
    sqlite3_close(db);
    unlink(path);
}

static void nan_position_is_an_error(void **state) {
    (void)state;
    JoxText error = {0};
    JoxRecorder *r = jox_recorder_open(path, 20, WKT, NULL, &error);
    assert_non_null(r);
    assert_true(submit_test_frame(r, 0, &error));
    JoxRecordBody *bodies;
    JoxRecordRow *rows = jox_recorder_begin_frame(r, 1, 0, &bodies);
    rows[0] = (JoxRecordRow){.x = NAN};
    jox_recorder_submit_frame(r, 1, &error);
    for (uint32_t f = 2; f < 20; f++) /* goes round the ring buffer */
        submit_test_frame(r, f, &error);
    jox_text_free(&error);
    assert_false(jox_recorder_close(r, &error));
    assert_non_null(strstr(error.data, "recording failed"));
    jox_text_free(&error);
    unlink(path);
}

/* Another program has the recording open when the run ends: nothing is lost, and nothing fails. */
static void recording_ends_while_another_reads(void **state) {
    (void)state;
    JoxText message = {0};
    JoxRecorder *r = jox_recorder_open(path, 20, WKT, NULL, &message);
    assert_non_null(r);
    for (uint32_t f = 0; f < 5; f++)
        assert_true(submit_test_frame(r, f, &message));
    assert_true(jox_recorder_commit(r, &message));
    sqlite3 *other;
    sqlite3_stmt *reading;
    assert_int_equal(sqlite3_open(path, &other), SQLITE_OK);
    sqlite3_prepare_v2(other, "SELECT frame FROM trajectory_data", -1, &reading, NULL);
    assert_int_equal(sqlite3_step(reading), SQLITE_ROW);
    assert_true(submit_test_frame(r, 5, &message));
    assert_true(jox_recorder_close(r, &message));
    assert_non_null(strstr(message.data, "is whole, but another program has it open"));
    jox_text_free(&message);
    /* Refused: a program that still reads the recording would delete the next run's log at its end.
     */
    JoxRecorder *next = jox_recorder_open(path, 20, WKT, NULL, &message);
    assert_null(next);
    assert_non_null(strstr(message.data, "another program reads the recording"));
    jox_text_free(&message);
    sqlite3_finalize(reading);
    sqlite3_prepare_v2(other, "SELECT max(frame) FROM frame_data", -1, &reading, NULL);
    assert_int_equal(sqlite3_step(reading), SQLITE_ROW);
    assert_int_equal(sqlite3_column_int(reading, 0), 5);
    sqlite3_finalize(reading);
    sqlite3_close(other);
    char beside[340];
    snprintf(beside, sizeof beside, "%s-wal", path);
    assert_int_equal(access(beside, F_OK), -1);
    unlink(path);
}

enum { PEOPLE = 60 };

static void density_is_sum_over_people(void **state) {
    (void)state;
    float x[PEOPLE], y[PEOPLE];
    uint32_t dice = 5;
    for (int i = 0; i < PEOPLE; i++) {
        dice = dice * 1664525u + 1013904223u;
        x[i] = 2 + 10 * (float)(dice >> 8) / 16777216.0f;
        dice = dice * 1664525u + 1013904223u;
        y[i] = -8 + 9 * (float)(dice >> 8) / 16777216.0f;
    }
    JoxDensity *d = jox_density_create((JoxV2){-5, -15}, (JoxV2){20, 9}, JOX_DENSITY_CELL, 1.5f);
    jox_density_want_mean(d);
    jox_density_add(d, (JoxV2){0, 0}, x, y, PEOPLE, 3);
    const double R = 1.5, PI = 3.14159265358979323846;
    double whole = 0, most = 0, worst = 0;
    JoxV2 most_at = {0, 0};
    for (uint32_t r = 0; r < d->rows; r++)
        for (uint32_t c = 0; c < d->columns; c++) {
            double px = -5 + (c + 0.5) * d->cell, py = -15 + (r + 0.5) * d->cell, here = 0;
            for (int i = 0; i < PEOPLE; i++) {
                double d2 = (px - x[i]) * (px - x[i]) + (py - y[i]) * (py - y[i]);
                here += exp(-d2 / (2 * R * R)) / (2 * PI * R * R);
            }
            double got = d->now[(size_t)r * d->columns + c];
            assert_true(got == jox_density_mean(d, c, r));
            whole += got * d->cell * d->cell;
            worst = fmax(worst, fabs(got - here));
            if (here > most) {
                most = here;
                most_at = (JoxV2){(float)px, (float)py};
            }
        }
    assert_true(fabs(whole - PEOPLE) < 1e-3 * PEOPLE);
    assert_true(most > 0.5 && fabs(d->most - most) < 0.015 * most && worst < 0.02 * most);
    assert_true(fabsf(d->most_at.x - most_at.x) < 0.5f && fabsf(d->most_at.y - most_at.y) < 0.5f);
    assert_true(d->most_time == 3);
    float first = d->most, far_x[] = {NAN, INFINITY, 1e30f, -300}, far_y[] = {0, 0, 0, 0};
    /* Nobody within reach: the mean halves. */
    jox_density_add(d, (JoxV2){0, 0}, far_x, far_y, 4, 4);
    assert_true(d->most == first && d->most_time == 3);
    uint32_t column = (uint32_t)((d->most_at.x + 5) / d->cell);
    uint32_t row = (uint32_t)((d->most_at.y + 15) / d->cell);
    assert_true(fabs(jox_density_mean(d, column, row) - first / 2) < 1e-6);
    jox_density_free(d);
}

static void walkable_area_as_text(void **state) {
    (void)state;
    JoxWalls walls = {0};
    JoxText out = {0};
    JoxV2 square[] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}}, line[] = {{2, 0}, {2, 1}};
    jox_walls_add_solid(&walls, square, 4, 3);
    jox_walls_add_polyline(&walls, line, 2, false, 3);
    jox_wkt(&walls, (JoxV2){-1, -2.5f}, (JoxV2){5, 6}, &out);
    assert_string_equal(out.data, "POLYGON ((-1 -2.5, 5 -2.5, 5 6, -1 6, -1 -2.5), "
                                  "(1 0, 1 1, 0 1, 0 0, 1 0))");
    jox_text_free(&out);
    jox_walls_free(&walls);
}

/* Outlines are written as given; solids that are not inside one are left out. */
static void walkable_area_of_outlines(void **state) {
    (void)state;
    JoxWalls all = {0}, walls = {0};
    JoxText out = {0};
    JoxV2 hall[] = {{0, 0}, {0, 9}, {9, 9}, {12, 0}}, yard[] = {{20, 0}, {30, 0}, {25, 8}};
    JoxV2 desk[] = {{1, 1}, {2, 1}, {2, 2}}, far[] = {{15, 1}, {16, 1}, {16, 2}};
    JoxV2 through[] = {{8, 8}, {8, 20}, {12, 20}}, post[] = {{24, 1}, {25, 1}, {25, 2}};
    JoxV2 loop[] = {{3, 3}, {4, 3}, {4, 4}};
    jox_walls_add_polyline(&all, loop, 3, true, 3); /* a loop of wall bounds no area */
    jox_walls_add_outline(&all, hall, 4, 3);
    jox_walls_add_solid(&all, desk, 3, 3);
    jox_walls_add_solid(&all, far, 3, 3);
    jox_walls_add_solid(&all, through, 3, 3);
    jox_walls_standing(&walls, &all, true);
    jox_wkt_outlines(&walls, &out);
    assert_string_equal(out.data, "POLYGON ((12 0, 9 9, 0 9, 0 0, 12 0), (1 1, 2 1, 2 2, 1 1))");
    out.length = 0;
    jox_walls_add_outline(&walls, yard, 3, 3);
    jox_walls_add_solid(&walls, post, 3, 3);
    jox_wkt_outlines(&walls, &out);
    assert_string_equal(out.data,
                        "MULTIPOLYGON (((12 0, 9 9, 0 9, 0 0, 12 0), (1 1, 2 1, 2 2, 1 1)), "
                        "((20 0, 30 0, 25 8, 20 0), (24 1, 25 1, 25 2, 24 1)))");
    const JoxV2 people[] = {{25, 7}, {1, 8}, {15, 5}};
    assert_true(jox_walls_outline_all(&walls, people, 2));
    assert_false(jox_walls_outline_all(&walls, people, 3));
    jox_text_free(&out);
    jox_walls_free(&walls);
    jox_walls_free(&all);
}

static void figures_of_runs_are_joined(void **state) {
    (void)state;
    const char *runs[] = {
        "{\"agents\": 1, \"probes\": {\"c\": [10, -2.5e1]}, \"s\": \"x \\\" 5\", \"t\": true, "
        "\"bodies\": 4}",
        "{\"t\": null, \"lua\": {\"late\": 2}, \"probes\": {\"c\": [30, -25]}, \"agents\": 3, "
        "\"agents\": 99}",
        " {\"agents\" : 2 ,\"probes\":{\"c\":[20,-25]},\"lua\":{\"late\":2,\"late\":2,\"late\":3}} "
        "\n"};
    JoxText out = {0};
    assert_true(jox_aggregate(runs, 3, &out));
    assert_non_null(strstr(out.data, "\"runs\": 3"));
    assert_non_null(strstr(out.data, "\"agents\": {\"mean\": 2, \"p5\": 1.1, \"p95\": 2.9}"));
    assert_non_null(strstr(out.data, "\"probes.c.0\": {\"mean\": 20, \"p5\": 11, \"p95\": 29}"));
    assert_non_null(strstr(out.data, "\"probes.c.1\": {\"mean\": -25, \"p5\": -25, \"p95\": -25}"));
    assert_null(strstr(out.data, "bodies"));
    assert_null(strstr(out.data, "late"));
    assert_non_null(strstr(out.data, "\"s\": [\"x \\\" 5\", null, null]"));
    jox_text_free(&out);
    const char *bad[] = {"",
                         "5",
                         "{",
                         "{\"a\": nan}",
                         "{\"a\": 0x10}",
                         "[1]",
                         "{\"a\": 1,}",
                         "{\"a\": [1}",
                         "{\"a\": tru}",
                         "{\"a\": -inf}",
                         "{a: 1}",
                         "{\"a\" 1}",
                         "{\"a\": 1} 2",
                         "{\"a\": 1e999}",
                         "{\"a\": \"x}"};
    for (size_t b = 0; b < sizeof bad / sizeof *bad; b++) {
        if (jox_aggregate(&bad[b], 1, &out))
            fail_msg("this is no JSON object: %s", bad[b]);
        jox_text_free(&out);
    }
    char deep[2000];
    memset(deep, '[', sizeof deep);
    memcpy(deep, "{\"a\":", 5);
    deep[1999] = 0;
    const char *nested = deep;
    assert_false(jox_aggregate(&nested, 1, &out));
    jox_text_free(&out);
}

/* Input of a run, and coordinates, have no mean. */
static void input_and_coordinates_are_listed(void **state) {
    (void)state;
    const char *runs[] = {"{\"scene\": \"a b\", \"seed\": 1, \"dt\": 0.05, \"steps\": 40, "
                          "\"overlap_p99\": 0.1, \"danger\": "
                          "{\"samples\": 9, \"density_max\": 3, \"density_max_x\": 1, \"limits\": "
                          "{\"load\": {\"limit\": "
                          "700, \"people\": 2, \"first_y\": null}}}, \"states\": {\"m\": "
                          "{\"go_x\": 2}}, \"probes\": {\"map_y\": "
                          "{\"density_max_y\": 1, \"flow\": 1}}, \"future\": 1, \"threads\": 2, "
                          "\"hash\": \"0a\", \"mods\": "
                          "[\"m 1\"]}",
                          "{\"scene\": \"a b\", \"seed\": 2, \"dt\": 0.05, \"steps\": 40, "
                          "\"overlap_p99\": 0.3, \"danger\": "
                          "{\"samples\": 9, \"density_max\": 5, \"density_max_x\": 8, \"limits\": "
                          "{\"load\": {\"limit\": "
                          "700, \"people\": 4, \"first_y\": 5}}}, \"states\": {\"m\": {\"go_x\": "
                          "4}}, \"probes\": {\"map_y\": "
                          "{\"density_max_y\": 2, \"flow\": 3}}, \"future\": 3, \"threads\": 2, "
                          "\"hash\": \"0b\", \"mods\": "
                          "[\"m 1\"]}"};
    JoxText out = {0};
    assert_true(jox_aggregate(runs, 2, &out));
    char *figures = strstr(out.data, "\"figures\"");
    assert_non_null(figures);
    static const char *const MEANS[] = {
        "overlap_p99\": {\"mean\": 0.2,", "danger.density_max\": {\"mean\": 4,",
        "danger.limits.load.people\": {\"mean\": 3,", "states.m.go_x\": {\"mean\": 3,",
        "probes.map_y.flow\": {\"mean\": 2,"};
    for (size_t m = 0; m < sizeof MEANS / sizeof *MEANS; m++)
        assert_non_null(strstr(figures, MEANS[m]));
    static const char *const GIVEN[] = {"\"scene\": \"a b\"",
                                        "\"seed\": [1, 2]",
                                        "\"dt\": 0.05",
                                        "\"steps\": 40",
                                        "\"danger.samples\": 9",
                                        "\"danger.density_max_x\": [1, 8]",
                                        "\"danger.limits.load.limit\": 700",
                                        "\"danger.limits.load.first_y\": [null, 5]",
                                        "\"probes.map_y.density_max_y\": [1, 2]",
                                        "\"future\": [1, 3]",
                                        "\"threads\": 2",
                                        "\"hash\": [\"0a\", \"0b\"]",
                                        "\"mods.0\": \"m 1\""};
    for (size_t g = 0; g < sizeof GIVEN / sizeof *GIVEN; g++) {
        const char *at = strstr(out.data, GIVEN[g]);
        if (!at || at > figures)
            fail_msg("not given: %s in %s", GIVEN[g], out.data);
    }
    jox_text_free(&out);
}

static void speeds_per_region(void **state) {
    (void)state;
    JoxRegions *r = jox_regions_create();
    JoxV2 left[] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, right[] = {{4, 0}, {8, 0}, {8, 4}, {4, 4}};
    jox_regions_add(r, "left", left, 4);
    jox_regions_add(r, "right", right, 4);
    const float x[] = {1, 2, 20}, y[] = {1, 2, 1};
    const float before_x[] = {0.94f, 2, 0}, before_y[] = {0.92f, 2, 0};
    jox_regions_frame(r, x, y, before_x, before_y, 3, 0.05); /* 2 m/s and 0; one person far away */
    jox_regions_frame(r, x + 2, y, before_x, before_y, 1, 0.05);
    jox_regions_frame(r, x, y, before_x, before_y, 1, 0.05); /* 2 m/s alone */
    assert_true(fabs(jox_region_speed(&r->items[0]) - 1.5) < 1e-5);
    assert_int_equal(r->items[0].frames, 2);
    assert_int_equal(r->items[0].people, 3);
    assert_true(isnan(jox_region_speed(&r->items[1])) && r->items[1].frames == 0);
    jox_regions_free(r);
    jox_regions_free(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(recording_reads_back),
                                       cmocka_unit_test(killed_writer_leaves_complete_frames),
                                       cmocka_unit_test(last_frame_is_committed_without_a_next),
                                       cmocka_unit_test(other_files_are_not_replaced),
                                       cmocka_unit_test(nan_position_is_an_error),
                                       cmocka_unit_test(density_is_sum_over_people),
                                       cmocka_unit_test(walkable_area_as_text),
                                       cmocka_unit_test(walkable_area_of_outlines),
                                       cmocka_unit_test(recording_ends_while_another_reads),
                                       cmocka_unit_test(figures_of_runs_are_joined),
                                       cmocka_unit_test(input_and_coordinates_are_listed),
                                       cmocka_unit_test(speeds_per_region)};
    return cmocka_run_group_tests(tests, make_recording_folder, remove_recording_folder);
}
