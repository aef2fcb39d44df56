/* Recordings read as frames: each format, its header, and errors in it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <sqlite3.h>

#include "record/recorder.h"
#include "record/trajectories.h"
#include "unit/test_folder.h"

static char path[320];

static int make_recording_folder(void **state) {
    const int failed = make_test_folder(state);
    snprintf(path, sizeof path, "%s", test_path("crowd"));
    return failed;
}

static void write_recording_text(const char *text, size_t length) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}

/* Reads the file; returns NULL with the messages in `said`. */
static JoxTrajectories *read_recording(double fps, double unit, JoxText *said) {
    JoxDiagnostics diagnostics = {0};
    const JoxTrajectoryOptions options = {.fps = fps, .unit = unit};
    JoxTrajectories *t = jox_trajectories_read(path, &options, &diagnostics);
    assert_true(!t == (diagnostics.errors > 0));
    if (said)
        jox_diag_print(&diagnostics, said);
    jox_diag_free(&diagnostics);
    return t;
}

static JoxTrajectories *read_text_recording(const char *text, double fps, double unit) {
    JoxText said = {0};
    write_recording_text(text, strlen(text));
    JoxTrajectories *t = read_recording(fps, unit, &said);
    if (!t)
        fail_msg("%s", said.data);
    jox_text_free(&said);
    return t;
}

#define assert_near(value, wanted, within) assert_true(fabs((double)(value) - (wanted)) <= (within))

/* Asserts that person 7 walks at 1 m/s along x and person 3 stands at (1, 2), in frames 10 to 14 at
   10 frames per second. */
static void assert_walk(JoxTrajectories *t) {
    JoxFrame frame;
    assert_int_equal(t->people, 2);
    assert_int_equal(t->frame_count, 5);
    for (uint32_t f = 0; f < 5; f++) {
        assert_true(jox_trajectories_frame(t, f, &frame));
        assert_near(frame.time, 1.0 + 0.1 * f, 1e-9);
        assert_int_equal(frame.count, 2);
        assert_int_equal(frame.key[0], 3);
        assert_int_equal(frame.key[1], 7);
        assert_true(frame.keys > 7);
        assert_near(frame.x[0], 1, 1e-6);
        assert_near(frame.y[0], 2, 1e-6);
        assert_near(frame.vx[0], 0, 1e-6);
        assert_near(frame.x[1], 0.1 * f, 1e-6);
        assert_near(frame.y[1], -1, 1e-6);
        assert_near(frame.vx[1], 1, 1e-4);
        assert_near(frame.vy[1], 0, 1e-6);
    }
    assert_false(jox_trajectories_frame(t, 5, &frame));
    jox_trajectories_free(t);
}

static void columns_by_position(void **state) {
    (void)state;
    static const char METRES[] = "# PeTrack project: x.pet\n#framerate: 10.00 fps\n"
                                 "# id frame x/m y/m z/m\n"
                                 "7 10 0 -1 1.7\n7\t11\t0.1\t-1\t1.7\n7 12 0.2 -1 1.7\n\n"
                                 "7 13 0.3 -1 1.7\r\n7 14 0.4 -1 1.7\n"
                                 "3 14 1 2\n3 13 1 2\n3 12 1 2\n3 11 1 2\n3 10 1 2";
    static const char CENTIMETRES[] = "# framerate: 10\n# PersID Frame X [in cm] Y [in cm]\n"
                                      "7 10 0 -100\n7 11 10 -100\n7 12 20 -100\n7 13 30 -100\n"
                                      "7 14 40 -100\n3 14 100 200\n3 13 100 200\n3 12 100 200\n"
                                      "3 11 100 200\n3 10 100 200\n";
    static char marked[sizeof METRES + 3] = "\xef\xbb\xbf"; /* byte order mark of some editors */
    assert_walk(read_text_recording(METRES, 0, 0));
    assert_walk(read_text_recording(strcat(marked, METRES), 0, 0));
    assert_walk(read_text_recording(CENTIMETRES, 0, 0));
    /* No header: the options give rate and unit. */
    assert_walk(read_text_recording(strstr(CENTIMETRES, "7 10"), 10, 0.01));
    /* Options override the file. */
    JoxTrajectories *t = read_text_recording(METRES, 20, 2);
    JoxFrame frame;
    assert_true(jox_trajectories_frame(t, 0, &frame));
    assert_near(frame.time, 0.5, 1e-9);
    assert_near(frame.vx[1], 4, 1e-4);
    jox_trajectories_free(t);
}

static void columns_by_name(void **state) {
    (void)state;
    assert_walk(read_text_recording(
        "ID,Frame,x,y\n7,10,0,-1\n7,11,.1,-1\n7,12,.2,-1\n7,13,.3,-1\n7,14,.4,-1\n"
        "3,10,1,2\n3,11,1,2\n3,12,1,2\n3,13,1,2\n3,14,1,2\n",
        10, 1));
    /* The column of time gives the frame rate, the headers the unit; columns may be in any
       order. */
    assert_walk(
        read_text_recording("mass_kg;y_cm;x_cm;frame;time_s;id\n"
                            "80;-100;0;10;1.0;7\n80;-100;10;11;1.1;7\n80;-100;20;12;1.2;7\n"
                            "80;-100;30;13;1.3;7\n80;-100;40;14;1.4;7\n81;200;100;10;1.0;3\n"
                            "81;200;100;11;1.1;3\n81;200;100;12;1.2;3\n81;200;100;13;1.3;3\n"
                            "81;200;100;14;1.4;3\n",
                            0, 0));
    JoxTrajectories *t = read_text_recording("ID,Frame,x,y,v_x,v_y\n1,5,2,3,0.7,-0.2\n", 25, 1);
    JoxFrame frame;
    assert_true(t->has_velocity && jox_trajectories_frame(t, 0, &frame));
    assert_near(frame.vx[0], 0.7, 1e-6);
    assert_near(frame.vy[0], -0.2, 1e-6);
    jox_trajectories_free(t);
}

/* x = t2: the displacement over +-0.2 s is the derivative; at the ends it is one-sided. Frames
   farther apart use the next frame. */
static void velocity_is_displacement_per_time(void **state) {
    (void)state;
    JoxText text = {0};
    JoxFrame frame;
    for (int f = 0; f <= 50; f++)
        jox_text_printf(&text, "1 %d %.9f 0\n", f, 0.04 * f * 0.04 * f);
    JoxTrajectories *t = read_text_recording(text.data, 25, 1);
    for (uint32_t f = 5; f <= 45; f++) {
        assert_true(jox_trajectories_frame(t, f, &frame));
        assert_near(frame.vx[0], 2 * 0.04 * f, 1e-4);
    }
    assert_true(jox_trajectories_frame(t, 0, &frame));
    assert_near(frame.vx[0], 0.2, 1e-4); /* (0.2 s)2 in 0.2 s */
    jox_trajectories_free(t);
    jox_text_free(&text);
    t = read_text_recording("1 0 0 0\n1 20 1 0\n1 40 2 0\n2 0 5 5\n", 25, 1);
    assert_true(jox_trajectories_frame(t, 1, &frame));
    assert_near(frame.vx[0], 1.25, 1e-5);
    assert_true(jox_trajectories_frame(t, 0, &frame));
    assert_near(frame.vx[0], 1.25, 1e-5);
    assert_near(frame.vx[1], 0, 0); /* seen in one frame only */
    jox_trajectories_free(t);
}

static void any_ids_are_accepted(void **state) {
    (void)state;
    JoxTrajectories *t =
        read_text_recording("-5 0 0 0\n999999999999 0 1 0\n12 0 2 0\n12 -3 2 0\n", 10, 1);
    JoxFrame frame;
    assert_int_equal(t->people, 3);
    assert_int_equal(t->keys, 3);
    assert_true(jox_trajectories_frame(t, 0, &frame));
    assert_near(frame.time, -0.3, 1e-9);
    assert_int_equal(frame.key[0], 1);
    assert_true(jox_trajectories_frame(t, 1, &frame));
    assert_int_equal(frame.key[0], 0);
    assert_near(frame.x[2], 1, 0);
    jox_trajectories_free(t);
}

/* Errors have line, column and a way out. */
static void errors_have_line_and_column(void **state) {
    (void)state;
    static const struct {
        const char *text, *said[3];
        double fps, unit;
    } BAD[] = {
        {"", {"nobody is in this recording"}, 25, 1},
        {"# only a comment\n", {"nobody is in this recording"}, 25, 1},
        {"1 0 0 0\n", {"how many frames a second", "--fps 25"}, 0, 1},
        {"1 0 0 0\n", {"the unit of its lengths", "--unit m, or --unit cm"}, 25, 0},
        {"1 0 0 0\n1 1 zero 0\n", {"crowd:2:5", "a finite number, not 'zero'"}, 25, 1},
        {"1 0 0 0\n  1 1 0 nan\n", {"crowd:2:9", "a finite number, not 'nan'"}, 25, 1},
        {"1 0 0 1e99\n", {"crowd:1:7", "a finite number"}, 25, 1},
        {"1 0.5 0 0\n", {"crowd:1:3", "a whole number, not '0.5'"}, 25, 1},
        {"1 0 0 0\n1 1 0\n", {"crowd:2:1", "this line has no y"}, 25, 1},
        {"1 0 0 0\n2 0 0 0\n1 0 4 4\n", {"crowd:3:1", "person 1 is in frame 0 twice"}, 25, 1},
        {"1 0 0 0\n1 900000000000 0 0\n", {"crowd:2:1", "more than 30 years"}, 25, 1},
        {"ID,Frame,x\n1,0,0\n", {"crowd:1:1", "no column is named 'y'"}, 25, 1},
        {"ID,Frame,x,y\n1,0,0,\"a,b\"\n", {"crowd:2:", "a finite number"}, 25, 1},
        {"\x01\x02\xff\xfe\n", {"crowd:1:1"}, 25, 1},
        {"1,0,0x10,0\n", {"crowd:1:5", "not '0x10'"}, 25, 1},
    };
    for (size_t b = 0; b < sizeof BAD / sizeof *BAD; b++) {
        JoxText said = {0};
        write_recording_text(BAD[b].text, strlen(BAD[b].text));
        assert_null(read_recording(BAD[b].fps, BAD[b].unit, &said));
        for (int s = 0; s < 3 && BAD[b].said[s]; s++)
            if (!strstr(said.data, BAD[b].said[s]))
                fail_msg("case %zu: '%s' is not in: %s", b, BAD[b].said[s], said.data);
        jox_text_free(&said);
    }
    JoxText said = {0};
    unlink(path);
    assert_null(read_recording(25, 1, &said));
    assert_non_null(strstr(said.data, "cannot be read"));
    jox_text_free(&said);
}

/* Cut or altered text is either read or refused. */
static void damaged_text_is_read_or_refused(void **state) {
    (void)state;
    static const char GOOD[] = "# framerate: 10\n# id frame x/cm y/cm\nid,frame,x,y,v_x,v_y\n"
                               "1,0,1.5,-2,0,0\n2,0,3,4e1,0,1\n1,1,1,1,1,1\n";
    char bent[sizeof GOOD];
    uint32_t random = 1;
    for (size_t cut = 0; cut < sizeof GOOD; cut++) {
        write_recording_text(GOOD, cut);
        jox_trajectories_free(read_recording(25, 1, NULL));
    }
    for (int turn = 0; turn < 2000; turn++) {
        memcpy(bent, GOOD, sizeof GOOD);
        for (int k = 0; k < 3; k++) {
            random = random * 1664525u + 1013904223u;
            bent[(random >> 8) % (sizeof GOOD - 1)] = (char)(random >> 24);
        }
        write_recording_text(bent, sizeof GOOD - 1);
        jox_trajectories_free(read_recording(25, 1, NULL));
    }
}

static void make_database(const char *sql) {
    sqlite3 *db;
    unlink(path);
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, sql, NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
}

#define TRAJECTORIES                                                                               \
    "CREATE TABLE trajectory_data(frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT "    \
    "NULL, pos_y REAL NOT NULL, ori_x REAL NOT NULL, ori_y REAL NOT NULL);"                        \
    "INSERT INTO trajectory_data VALUES(10,7,0,-1,1,0),(11,7,.1,-1,1,0),(12,7,.2,-1,1,0),"         \
    "(13,7,.3,-1,1,0),(14,7,.4,-1,1,0),(10,3,1,2,1,0),(11,3,1,2,1,0),(12,3,1,2,1,0),"              \
    "(13,3,1,2,1,0),(14,3,1,2,1,0);"                                                               \
    "CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);"

static void both_jupedsim_versions_are_read(void **state) {
    (void)state;
    make_database(
        TRAJECTORIES
        "INSERT INTO metadata VALUES('version','1'),('fps','10.0');"
        "CREATE TABLE geometry(wkt TEXT NOT NULL);"
        "INSERT INTO geometry VALUES('GEOMETRYCOLLECTION (POLYGON ((0 0, 4 0, 4 4, 0 4, 0 "
        "0), (1 1, 2 1, 2 2, 1 1)))');");
    JoxTrajectories *t = read_recording(0, 0, NULL);
    assert_non_null(t);
    assert_int_equal(t->walls.ring_count, 4); /* a closed line has two sides */
    assert_walk(t);
    make_database(TRAJECTORIES
                  "INSERT INTO metadata VALUES('version','2'),('fps','10.0');"
                  "CREATE TABLE geometry(hash INTEGER NOT NULL UNIQUE, wkt TEXT NOT NULL);"
                  "CREATE TABLE frame_data(frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);"
                  "INSERT INTO geometry VALUES(1,'POLYGON ((0 0, 4 0, 4 4))');");
    t = read_recording(0, 0, NULL);
    assert_non_null(t);
    assert_int_equal(t->walls.ring_count, 2);
    assert_walk(t);
    JoxText said = {0};
    make_database(TRAJECTORIES
                  "INSERT INTO metadata VALUES('fps','10');"
                  "UPDATE trajectory_data SET frame = -9223372036854775807 WHERE id = 3;");
    assert_null(read_recording(0, 0, &said));
    assert_non_null(strstr(said.data, "more than 30 years"));
    make_database(TRAJECTORIES);
    assert_null(read_recording(0, 0, &said));
    assert_non_null(strstr(said.data, "--fps 25"));
    assert_walk(read_recording(10, 0, NULL));
    make_database(TRAJECTORIES "INSERT INTO metadata VALUES('version','3'),('fps','10');");
    assert_null(read_recording(0, 0, &said));
    assert_non_null(strstr(said.data, "version 3 of the JuPedSim format. Versions 1 and 2 are"));
    make_database("CREATE TABLE other(x)");
    assert_null(read_recording(0, 0, &said));
    assert_non_null(strstr(said.data, "a table trajectory_data"));
    jox_text_free(&said);
}

/* Rows are read whatever the index, the list of frames or their order. */
static void rows_in_any_order_are_read(void **state) {
    (void)state;
    static const char *const CASES[] = {
        "CREATE INDEX i ON trajectory_data(frame)",
        "CREATE INDEX i ON trajectory_data(frame); CREATE TABLE frame_data(frame INTEGER, "
        "geometry_hash INTEGER); INSERT INTO frame_data VALUES(11,0),(12,0)",
        "CREATE TABLE t AS SELECT * FROM trajectory_data ORDER BY id DESC, frame DESC; DROP TABLE "
        "trajectory_data; ALTER TABLE t RENAME TO trajectory_data",
        "CREATE TABLE t(frame INTEGER, id INTEGER, pos_x REAL, pos_y REAL, PRIMARY KEY(id, frame)) "
        "WITHOUT ROWID; INSERT INTO t SELECT frame, id, pos_x, pos_y FROM trajectory_data; DROP "
        "TABLE trajectory_data; ALTER TABLE t RENAME TO trajectory_data"};
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) {
        JoxText sql = {0};
        jox_text_printf(&sql, "%sINSERT INTO metadata VALUES('fps','10');%s", TRAJECTORIES,
                        CASES[c]);
        make_database(sql.data);
        jox_text_free(&sql);
        JoxTrajectories *t = read_recording(0, 0, NULL);
        assert_non_null(t);
        assert_walk(t);
    }
    JoxText said = {0};
    make_database(TRAJECTORIES "INSERT INTO metadata VALUES('fps','10');"
                               "INSERT INTO trajectory_data VALUES(12,3,5,5,1,0)");
    assert_null(read_recording(0, 0, &said));
    assert_non_null(strstr(said.data, "person 3 is in frame 12 twice"));
    jox_text_free(&said);
}

static void own_recordings_keep_forces_and_walls(void **state) {
    (void)state;
    JoxText error = {0};
    unlink(path);
    JoxRecorder *r = jox_recorder_open(path, 10, "POLYGON ((0 0, 1 0, 1 1, 0 0))", NULL, &error);
    assert_non_null(r);
    jox_recorder_group(r, 0, "red", 0, NULL);
    jox_recorder_group(r, 1, "blue", JOX_COLOUR_GIVEN | 0x123456, NULL);
    JoxWalls walls = {0};
    jox_walls_add_polyline(&walls, (const JoxV2[]){{0, 1}, {2, 1}, {2, 3}}, 3, false, 2.5f);
    jox_recorder_wall(r, 0, 0, &walls, 0, true);
    /* A gate that opens, then another wall that is added and removed. */
    jox_walls_add_polyline(&walls, (const JoxV2[]){{0, 1}, {0, 3}}, 2, false, INFINITY);
    jox_walls_name(&walls, 1, "gate", false);
    jox_recorder_wall(r, 0, 1, &walls, 1, true);
    walls.rings[1].open = true;
    jox_recorder_wall(r, 1, 1, &walls, 1, false);
    jox_walls_add_solid(&walls, (const JoxV2[]){{5, 1}, {6, 1}, {6, 3}}, 3, INFINITY);
    jox_recorder_wall(r, 1, 2, &walls, 2, true);
    jox_recorder_wall(r, 2, 2, NULL, 0, true);
    jox_walls_free(&walls);
    for (uint32_t f = 0; f < 3; f++) {
        JoxRecordBody *bodies;
        JoxRecordRow *rows = jox_recorder_begin_frame(r, 2, 0, &bodies);
        for (uint32_t i = 0; i < 2; i++)
            rows[i] = (JoxRecordRow){.id = 4 - i, /* not in order */
                                     .x = 0.1f * (float)f,
                                     .force = (float)(10 * i + f),
                                     .compression = (float)(100 * i + f),
                                     .load = (float)(1000 * i + f),
                                     .group = (uint16_t)i,
                                     .radius = i ? 0.35f : 0.2f + 0.05f * (float)f};
        assert_true(jox_recorder_submit_frame(r, f, &error));
    }
    assert_true(jox_recorder_close(r, &error));
    JoxTrajectories *t = read_recording(0, 0, NULL);
    JoxFrame frame;
    assert_non_null(t);
    assert_int_equal(t->group_count, 2);
    assert_int_equal(t->group_colours[0], 0);
    assert_int_equal(t->group_colours[1], JOX_COLOUR_GIVEN | 0x123456);
    assert_true(jox_trajectories_frame(t, 2, &frame));
    assert_int_equal(frame.key[0], 3);
    assert_string_equal(frame.groups[frame.group[0]], "blue");
    assert_string_equal(frame.groups[frame.group[1]], "red");
    assert_near(frame.force[0], 12, 0);
    assert_near(frame.compression[0], 102, 0);
    assert_near(frame.compression[1], 2, 0);
    assert_near(frame.load[0], 1002, 0);
    assert_near(frame.load[1], 2, 0);
    assert_near(frame.vx[1], 1, 1e-5);
    assert_near(frame.radius[0], 0.35, 1e-6);
    assert_near(frame.radius[1], 0.3, 1e-6);
    /* Gates and walls in each frame, read in any order. */
    const uint32_t order[] = {2, 0, 1}, rings[] = {2, 2, 3}, stand[] = {1, 2, 2};
    for (uint32_t k = 0; k < 3; k++) {
        assert_true(jox_trajectories_frame(t, order[k], &frame));
        const JoxWalls *all = jox_trajectories_walls(t, order[k]);
        assert_int_equal(all->ring_count, rings[k]);
        assert_string_equal(all->rings[1].name, "gate");
        assert_int_equal(all->rings[1].open, order[k] > 0);
        assert_int_equal(frame.walls->ring_count, stand[k]);
        assert_int_equal(jox_wall_history_changes(t->history, order[k]), order[k]);
    }
    assert_true(jox_trajectories_frame(t, 0, &frame));
    assert_near(frame.radius[1], 0.2, 1e-6);
    /* The walls, not the outline of the walkable area, which need not be a wall. */
    assert_int_equal(t->walls.count, 6); /* there and back */
    for (uint32_t v = 0; v < t->walls.count; v++)
        assert_true(t->walls.vertices[v].point.y >= 1 && t->walls.vertices[v].point.y <= 3);
    assert_near(t->walls.rings[0].height, 2.5, 0);
    jox_trajectories_free(t);
    /* Written by older versions: no loads, everything else. */
    sqlite3 *db;
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    assert_int_equal(
        sqlite3_exec(db,
                     "CREATE TABLE jostle_agent AS SELECT frame, id, state, force, compression, "
                     "member FROM trajectory_data ORDER BY frame, id;"
                     "CREATE TABLE placed AS SELECT frame, id, pos_x, pos_y, ori_x, ori_y FROM "
                     "trajectory_data ORDER BY frame, id; DROP VIEW trajectory_data; DROP TABLE "
                     "jostle_row;"
                     "CREATE TABLE w AS SELECT name, solid, closed, open, height, points FROM "
                     "jostle_wall WHERE frame = 0; DROP TABLE jostle_wall;"
                     "ALTER TABLE w RENAME TO jostle_wall;"
                     "ALTER TABLE placed RENAME TO trajectory_data;"
                     "CREATE INDEX frame_id_idx ON trajectory_data(frame, id)",
                     NULL, NULL, NULL),
        SQLITE_OK);
    sqlite3_close(db);
    t = read_recording(0, 0, NULL);
    assert_non_null(t);
    assert_true(jox_trajectories_frame(t, 2, &frame));
    assert_null(frame.load);
    assert_null(frame.radius);
    assert_int_equal(jox_trajectories_walls(t, 2)->ring_count, 2);
    assert_near(frame.compression[0], 102, 0);
    jox_trajectories_free(t);
    jox_text_free(&error);
}

/* Texts with zero bytes, which C strings cannot hold. */
static void zero_bytes_are_located(void **state) {
    (void)state;
    static const struct {
        const char *text;
        size_t length;
        const char *said;
    } BAD[] = {{"1 0 0 0\n1 1 0.1 0\0\n", 18, "crowd:2:10: a text has no zero byte"},
               {"1 0 0 0\n\0\0\n1 1 0 0\n", 19, "crowd:2:1: a text has no zero byte"},
               {"\xff\xfe"
                "1\0 \0",
                6, "crowd:1:1: this file is UTF-16. Save it as UTF-8"}};
    for (size_t b = 0; b < sizeof BAD / sizeof *BAD; b++) {
        JoxText said = {0};
        write_recording_text(BAD[b].text, BAD[b].length);
        assert_null(read_recording(25, 1, &said));
        if (!strstr(said.data, BAD[b].said))
            fail_msg("%s", said.data);
        jox_text_free(&said);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_by_position),
        cmocka_unit_test(columns_by_name),
        cmocka_unit_test(velocity_is_displacement_per_time),
        cmocka_unit_test(any_ids_are_accepted),
        cmocka_unit_test(errors_have_line_and_column),
        cmocka_unit_test(zero_bytes_are_located),
        cmocka_unit_test(damaged_text_is_read_or_refused),
        cmocka_unit_test(both_jupedsim_versions_are_read),
        cmocka_unit_test(own_recordings_keep_forces_and_walls),
        cmocka_unit_test(rows_in_any_order_are_read),
    };
    return cmocka_run_group_tests(tests, make_recording_folder, remove_test_folder);
}
