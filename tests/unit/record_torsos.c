/* Torsos and falls in recordings: read back, and missing in older files. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <unistd.h>

#include <cmocka.h>
#include <sqlite3.h>

#include "record/recorder.h"
#include "record/trajectories.h"
#include "unit/assert_near.h"
#include "unit/test_folder.h"

static char path[320];

static int make_folder(void **state) {
    const int failed = make_test_folder(state);
    snprintf(path, sizeof path, "%s", test_path("a.sqlite"));
    return failed;
}

static int remove_folder(void **state) {
    (void)state;
    unlink(path);
    return rmdir(test_folder);
}

/* Reads the recording, of one frame, into *frame. */
static JoxTrajectories *read_frame(JoxFrame *frame) {
    JoxTrajectoryOptions options = {0};
    JoxDiagnostics said = {0};
    JoxTrajectories *t = jox_trajectories_read(path, &options, &said);
    assert_non_null(t);
    jox_diag_free(&said);
    assert_true(jox_trajectories_frame(t, 0, frame));
    return t;
}

/* Changes the recording by a statement. */
static void change_recording(const char *sql) {
    sqlite3 *db;
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, sql, NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
}

static void torsos_and_falls_are_recorded(void **state) {
    (void)state;
    JoxText error = {0};
    JoxRecorder *r =
        jox_recorder_open(path, 10, "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0))", NULL, &error);
    assert_non_null(r);
    JoxRecordBody *bodies;
    JoxRecordRow *rows = jox_recorder_begin_frame(r, 2, 0, &bodies);
    rows[0] = (JoxRecordRow){.id = 1, .radius = 0.2f, .chest = NAN, .breadth = NAN, .depth = NAN};
    rows[1] = (JoxRecordRow){.id = 2,
                             .x = 1.0f,
                             .radius = 0.2f,
                             .chest = 1.5708f,
                             .breadth = 0.45f,
                             .depth = 0.25f,
                             .fallen = 2.5f};
    assert_true(jox_recorder_submit_frame(r, 0, &error));
    assert_true(jox_recorder_close(r, &error));
    JoxFrame frame;
    JoxTrajectories *t = read_frame(&frame);
    assert_near(frame.axis_x[0], 0.0, 0);
    assert_near(frame.contact_radius[0], 0.2, 1e-6);
    assert_near(frame.axis_x[1], -0.1, 1e-4); /* the chest points to +y: the left is -x */
    assert_near(frame.contact_radius[1], 0.125, 1e-6);
    assert_near(frame.fallen[0], 0.0, 0);
    assert_near(frame.fallen[1], 2.5, 1e-6);
    jox_trajectories_free(t);
    /* Written by versions without falls, and without torsos. */
    change_recording("DROP VIEW trajectory_data; ALTER TABLE jostle_row DROP COLUMN fallen");
    t = read_frame(&frame);
    assert_null(frame.fallen);
    assert_near(frame.contact_radius[1], 0.125, 1e-6);
    jox_trajectories_free(t);
    change_recording("ALTER TABLE jostle_row DROP COLUMN chest;"
                     "ALTER TABLE jostle_row DROP COLUMN breadth;"
                     "ALTER TABLE jostle_row DROP COLUMN depth");
    t = read_frame(&frame);
    assert_null(frame.axis_x);
    assert_near(frame.radius[1], 0.2, 1e-6);
    jox_trajectories_free(t);
    jox_text_free(&error);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(torsos_and_falls_are_recorded)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
