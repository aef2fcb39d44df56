/* Recordings of worlds with storeys: written in plan, read back on sheets. */
#include "record_storeys.h"

#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "record/recorder.h"
#include "record/trajectory_reader.h"

static char path[] = "/tmp/jostle-storeys-XXXXXX";

/* Records a person who walks up the stair, 0.5 m from frame to frame, and a body on the upper
   storey. */
static void record_climb(const Plan *p) {
    JoxText error = {0};
    JoxRecorder *r =
        jox_recorder_open(path, 10, "POLYGON ((0 0, 20 0, 20 10, 0 0))", &p->storeys, &error);
    assert_non_null(r);
    jox_recorder_describe_storeys(r, &p->sheet_walls, jox_v2(0, 0), jox_v2(20, 10));
    for (uint32_t ring = 0, number = 0; ring < p->sheet_walls.ring_count; ring++) {
        bool closed, twin;
        jox_walls_given(&p->sheet_walls, ring, &closed, &twin);
        jox_recorder_wall(r, 0, number++, &p->sheet_walls, ring, true);
        ring += twin;
    }
    for (uint32_t f = 0; f < 20; f++) {
        JoxRecordBody *body;
        JoxRecordRow *row = jox_recorder_begin_frame(r, 1, 1, &body);
        const JoxV2 at = put_on_sheet(p, 6.25f + 0.5f * (float)f, 5.0f);
        const JoxV2 upstairs = jox_on_sheet(&p->storeys, 1, jox_v2(17, 3));
        *row = (JoxRecordRow){.id = 4, .x = at.x, .y = at.y, .ori_x = 1.0f, .radius = 0.2f};
        row->chest = row->breadth = row->depth = NAN;
        *body = (JoxRecordBody){7, upstairs.x, upstairs.y, 0.5f, 0, 0, 0, 1};
        assert_true(jox_recorder_submit_frame(r, f, &error));
    }
    assert_true(jox_recorder_close(r, &error));
    assert_null(error.data);
}

/* Returns the first column of the first row as text; the caller frees it. */
static char *query_text(const char *sql) {
    sqlite3 *db;
    sqlite3_stmt *statement;
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_prepare_v2(db, sql, -1, &statement, NULL), SQLITE_OK);
    assert_int_equal(sqlite3_step(statement), SQLITE_ROW);
    char *text = jox_strdup((const char *)sqlite3_column_text(statement, 0));
    sqlite3_finalize(statement);
    sqlite3_close(db);
    return text;
}

static void expect_text(const char *sql, const char *wanted) {
    char *text = query_text(sql);
    assert_string_equal(text, wanted);
    jox_free(text);
}

static void recording_is_in_plan_and_reads_back_on_sheets(void **state) {
    (void)state;
    const JoxTrajectoryOptions options = {0};
    Plan *p = make_plan(0.0f);
    JoxDiagnostics diagnostics = {0};
    JoxText why = {0};
    assert_true(mkstemp(path) >= 0);
    unlink(path);
    record_climb(p);
    /* Readers of the format find all of the way in one plane. */
    expect_text("SELECT max(abs(pos_x - 6.25 - 0.5 * frame) + abs(pos_y - 5)) < 1e-3 FROM "
                "trajectory_data",
                "1");
    expect_text("SELECT value FROM metadata WHERE key = 'ymax'", "5");
    expect_text("SELECT group_concat(storey || stair, ' ') FROM trajectory_data",
                "00 00 00 00 01 01 01 01 01 01 11 11 11 11 11 11 10 10 10 10");
    expect_text("SELECT storey || ' ' || y FROM jostle_body", "1 3.0");
    expect_text("SELECT group_concat(name || ' ' || height, ', ') FROM jostle_storey",
                "ground 0.0, first 3.0");
    expect_text("SELECT name || ' ' || kind || ' ' || path || ' ' || width FROM jostle_stair",
                "north stairs 8 5, 14 5 2.0");
    expect_text("SELECT area FROM jostle_storey WHERE number = 1",
                "POLYGON ((0 0, 20 0, 20 10, 0 10, 0 0), (8 4, 14 4, 14 6, 8 6, 8 4))");
    JoxTrajectoryReader *reader = jox_trajectory_reader_open(path, &options, &diagnostics);
    assert_non_null(reader);
    const JoxTrajectoryReaderInfo info = jox_trajectory_reader_info(reader);
    assert_non_null(info.storeys);
    assert_string_equal(info.storeys->stairs[0].name, "north");
    assert_near(info.storeys->pitch, p->storeys.pitch, 0);
    assert_near(info.storeys->stairs[0].rise, 3.0, 0);
    for (uint32_t f = 0; f < 20; f++) {
        JoxTrajectoryReaderFrame frame;
        assert_true(jox_trajectory_reader_read(reader, f, &frame, &why));
        const JoxV2 at = put_on_sheet(p, 6.25f + 0.5f * (float)f, 5.0f);
        assert_near(frame.x[0], at.x, 1e-3);
        assert_near(frame.y[0], at.y, 1e-3);
        assert_near(frame.bodies[0].y, 3 + p->storeys.pitch, 1e-3);
    }
    const JoxWalls *walls = jox_trajectory_reader_walls(reader, 0);
    assert_int_equal(walls->count, p->sheet_walls.count);
    for (uint32_t v = 0; v < walls->count; v++)
        assert_near(walls->vertices[v].point.y, p->sheet_walls.vertices[v].point.y, 1e-3);
    jox_trajectory_reader_close(reader);
    /* Nobody is fast because of a seam. */
    JoxTrajectories *t = jox_trajectories_read(path, &options, &diagnostics);
    assert_non_null(t);
    for (size_t k = 0; k < t->count; k++) {
        assert_near(t->vx[k], 5.0, 1e-2);
        assert_near(t->vy[k], 0.0, 1e-2);
    }
    jox_trajectories_free(t);
    jox_diag_free(&diagnostics);
    free_plan(p);
    unlink(path);
}

/* Changes a recording and reads it; returns the error, which the caller frees, NULL without one. */
static char *read_after(const char *sql) {
    const JoxTrajectoryOptions options = {0};
    JoxDiagnostics diagnostics = {0};
    sqlite3 *db;
    Plan *p = make_plan(0.0f);
    record_climb(p);
    free_plan(p);
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, sql, NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
    JoxTrajectories *t = jox_trajectories_read(path, &options, &diagnostics);
    assert_int_equal(t == NULL, diagnostics.errors > 0);
    char *error = t ? NULL : jox_strdup(diagnostics.items[0].message);
    if (!t)
        assert_non_null(diagnostics.items[0].hint);
    jox_trajectories_free(t);
    jox_diag_free(&diagnostics);
    return error;
}

static void damaged_storeys_are_refused_with_table_row_and_column(void **state) {
    (void)state;
#define STOREY(set) "UPDATE jostle_storey SET " set " WHERE number = 1"
#define STAIR(set) "UPDATE jostle_stair SET " set
    static const struct {
        const char *sql, *says;
    } DAMAGES[] = {
        {"UPDATE jostle_row SET storey = 2 WHERE frame = 3",
         "table jostle_row, frame 3, id 4: storey is '2'"},
        {"UPDATE jostle_row SET stair = -1 WHERE frame = 3",
         "table jostle_row, frame 3, id 4: storey is '0' and stair '-1'"},
        {"UPDATE jostle_wall SET storey = 9 WHERE number = 1",
         "table jostle_wall, frame 0, number 1: storey is '9'"},
        {"UPDATE jostle_wall SET points = '1 2, x' WHERE number = 1",
         "table jostle_wall, frame 0, number 1: points is '1 2, x'"},
        {"DELETE FROM jostle_storey", "table jostle_storey has no rows"},
        {"DELETE FROM jostle_storey WHERE number = 1",
         "table jostle_stair, number 0: upper is '1'"},
        {"DELETE FROM jostle_stair", "number 6: stair is '1'"},
        {"DROP TABLE jostle_stair", "table jostle_stair cannot be read"},
        {"DROP TABLE jostle_car", "table jostle_car cannot be read"},
        {STOREY("height = 0"), "table jostle_storey, number 1: height is '0.0'"},
        {STOREY("height = 'nan'"), "number 1: height is 'nan'"},
        {STOREY("name = NULL"), "number 1: name is NULL"},
        {STOREY("name = 'ground'"), "number 1: name is 'ground'"},
        {"UPDATE jostle_storey SET number = number + 5", "number 5: number is '5'"},
        {STAIR("kind = 55"), "table jostle_stair, number 0: kind is '55'"},
        {STAIR("way = -8"), "way is '-8'"},
        {STAIR("upper = 9"), "upper is '9'"},
        {STAIR("lower = 1, upper = 0"), "upper is '0'"},
        {STAIR("path = '8 5'"), "path is '8 5'"},
        {STAIR("path = '8 5, 8 5'"), "path is '8 5, 8 5'"},
        {STAIR("path = '8 5, nan 5'"), "path is '8 5, nan 5'"},
        {STAIR("path = '8 5, 14 5 and'"), "path is '8 5, 14 5 and'"},
        {STAIR("width = 0"), "path is '8 5, 14 5'"},
        {STAIR("width = 'wide'"), "width is 'wide'"},
        {STAIR("landings = '3 2'"), "landings is '3 2'"},
        {STAIR("landings = 'garbage'"), "landings is 'garbage'"},
        {STAIR("belt = 'inf'"), "belt is 'inf'"},
        {STAIR("belt = 9e999"), "belt is 'Inf'"},
        {STAIR("belt = 0.5"), "belt is '0.5'"},
        {STAIR("kind = 'escalator'"), "belt is '0.0'"},
        {STAIR("rise = 'high'"), "rise is 'high'"},
        {"UPDATE metadata SET value = 'x' WHERE key = 'jostle_origin'",
         "table metadata, key jostle_origin: value is 'x'"},
        {"UPDATE metadata SET value = 7 WHERE key = 'jostle_origin'",
         "the stair north lies outside"},
        {"DELETE FROM metadata WHERE key = 'jostle_pitch'", "jostle_pitch: value is missing"},
        {"UPDATE metadata SET value = 0 WHERE key = 'jostle_pitch'", "jostle_pitch: value is '0'"},
        {"UPDATE metadata SET value = '45 m' WHERE key = 'jostle_pitch'", "value is '45 m'"},
    };
    assert_null(read_after("SELECT 1"));
    for (size_t k = 0; k < sizeof DAMAGES / sizeof *DAMAGES; k++) {
        char *error = read_after(DAMAGES[k].sql);
        if (!error || !strstr(error, DAMAGES[k].says))
            fail_msg("%s: %s", DAMAGES[k].sql, error ? error : "read");
        jox_free(error);
    }
    unlink(path);
}

/* Writes a recording of another program and reads it. */
static JoxTrajectories *read_text(const char *text, JoxDiagnostics *diagnostics) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    return jox_trajectories_read(path, &(JoxTrajectoryOptions){.fps = 2.0, .unit = 1.0},
                                 diagnostics);
}

static void recordings_of_others_may_have_a_column_of_storeys(void **state) {
    (void)state;
    JoxDiagnostics diagnostics = {0};
    JoxTrajectories *t = read_text("id,frame,x,y,level\n"
                                   "1,0,1,2,10\n1,1,2,2,9\n2,0,5,5,9\n2,1,5,6,9\n",
                                   &diagnostics);
    assert_non_null(t);
    assert_int_equal(t->storeys.storey_count, 2);
    assert_string_equal(t->storeys.storeys[0].name, "9");
    assert_near(jox_in_plan(&t->storeys, jox_v2(t->x[0], t->y[0])).y, 2.0, 1e-4);
    assert_int_equal(jox_storey_at(&t->storeys, jox_v2(t->x[0], t->y[0])), 1);
    assert_near(t->vx[0], 2.0, 1e-4); /* a change of storey is no way */
    assert_near(t->vy[0], 0.0, 1e-4);
    jox_trajectories_free(t);
    assert_null(read_text("id,frame,x,y,floor\n1,0,1,2,0\n1,1,2,2,\n", &diagnostics));
    t = read_text("id,frame,x,y,floor\n1,0,1,2,ground\n1,1,2,2,ground\n", &(JoxDiagnostics){0});
    assert_int_equal(t->storeys.storey_count, 0); /* one plane */
    jox_trajectories_free(t);
    jox_diag_free(&diagnostics);
    unlink(path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(recording_is_in_plan_and_reads_back_on_sheets),
        cmocka_unit_test(damaged_storeys_are_refused_with_table_row_and_column),
        cmocka_unit_test(recordings_of_others_may_have_a_column_of_storeys),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
