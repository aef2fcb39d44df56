/* Frames of worlds with storeys: positions on sheets in, figures as of one plane out. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <sqlite3.h>

#include "assert_near.h"
#include "base/mem.h"
#include "geom/storeys.h"
#include "record/fields/density.h"
#include "record/fields/voronoi_people.h"
#include "record/frame_track.h"
#include "record/probes/probe.h"
#include "record/recorder.h"
#include "record/trajectory_reader.h"

/* Lays out two storeys, 3 m apart, on a plan of 20 m x 10 m. A stair leads from x = 8 up to x = 14,
   about y = 5, 2 m wide. */
static JoxStoreys lay_out_two_storeys(void) {
    JoxStoreys s = {.storey_count = 2, .stair_count = 1};
    s.storeys = jox_alloc(2, sizeof *s.storeys);
    s.storeys[0] = (JoxStorey){jox_strdup("ground"), 0.0f};
    s.storeys[1] = (JoxStorey){jox_strdup("first"), 3.0f};
    s.stairs = jox_alloc(1, sizeof *s.stairs);
    s.stairs[0] = (JoxStair){.name = jox_strdup("north"), .upper = 1, .width = 2.0f};
    s.stairs[0].path = jox_alloc(2, sizeof *s.stairs[0].path);
    s.stairs[0].path[0] = jox_v2(8, 5);
    s.stairs[0].path[1] = jox_v2(14, 5);
    s.stairs[0].path_count = 2;
    jox_storeys_lay_out(&s, jox_v2(0, 0), jox_v2(20, 10));
    return s;
}

/* ---- tracks ---- */

static void agent_over_a_seam_walks_on_and_crosses_each_line_once(void **state) {
    (void)state;
    JoxStoreys storeys = lay_out_two_storeys();
    const uint32_t stair = storeys.stairs[0].sheet, key[1] = {0};
    const JoxV2 at[] = {jox_v2(7.95f, 5.2f), jox_on_sheet(&storeys, stair, jox_v2(8.1f, 5.1f))};
    const JoxV2 below[2] = {jox_v2(7.97f, 6), jox_v2(7.97f, 4)};
    const JoxV2 above[2] = {jox_on_sheet(&storeys, stair, jox_v2(8.02f, 6)),
                            jox_on_sheet(&storeys, stair, jox_v2(8.02f, 4))};
    JoxTrack track = {0};
    JoxStretch way;
    for (int k = 0; k < 2; k++) {
        const JoxFrame frame = {.time = 0.1 * k,
                                .count = 1,
                                .keys = 1,
                                .key = key,
                                .x = &at[k].x,
                                .y = &at[k].y,
                                .storeys = &storeys};
        jox_track_reserve(&track, &frame);
        assert_int_equal(jox_track_step(&track, &frame, 0, &way), k);
    }
    assert_near(way.by.x, 0.15, 1e-5);
    assert_near(way.by.y, -0.1, 1e-4);
    double time = 0.0;
    assert_int_equal(jox_stretch_crosses(&way, below[0], below[1], &time), 1);
    assert_near(time, 0.1 * 0.02 / 0.15, 1e-4);
    assert_int_equal(jox_stretch_crosses(&way, above[0], above[1], &time), 1);
    assert_near(time, 0.1 * 0.07 / 0.15, 1e-4);
    jox_free(track.items);
    jox_storeys_free(&storeys);
}

/* ---- densities ---- */

enum { CROWD = 800 };
static const float WEST = 8.0f, EAST = 14.0f; /* m: x of the foot and the head of the stair */

/* A crowd in a room west of x = 8, on the stair and in a room east of x = 14: in one plane, and on
   the sheets of storeys. */
typedef struct Plan {
    float turn; /* rad: all of the plan is turned by it */
    uint32_t count;
    float x[CROWD], flat[CROWD], sheets[CROWD];
    JoxWalls flat_walls, sheet_walls;
    JoxStoreys storeys;
} Plan;

static JoxV2 turn_point(const Plan *p, float x, float y) {
    return jox_v2(x * cosf(p->turn) - y * sinf(p->turn), x * sinf(p->turn) + y * cosf(p->turn));
}

/* Returns the position on its sheet of a point that was not turned yet. */
static JoxV2 put_on_sheet(const Plan *p, float x, float y) {
    const uint32_t sheet = x < WEST ? 0 : x < EAST ? p->storeys.stairs[0].sheet : 1;
    return jox_on_sheet(&p->storeys, sheet, turn_point(p, x, y));
}

static void add_walls(const Plan *p, const float (*points)[2], uint32_t count, bool closed,
                      uint32_t sheet, JoxWalls *walls) {
    JoxV2 at[4];
    for (uint32_t k = 0; k < count; k++)
        at[k] = jox_on_sheet(&p->storeys, sheet, turn_point(p, points[k][0], points[k][1]));
    jox_walls_add_polyline(walls, at, count, closed, INFINITY);
}

/* Adds an outer wall and, at x, a wall with an opening for the stair. */
static void add_room(const Plan *p, float x, uint32_t sheet, JoxWalls *walls) {
    add_walls(p, (const float[][2]){{0, 0}, {20, 0}, {20, 10}, {0, 10}}, 4, true, sheet, walls);
    add_walls(p, (const float[][2]){{x, 0}, {x, 4}}, 2, false, sheet, walls);
    add_walls(p, (const float[][2]){{x, 6}, {x, 10}}, 2, false, sheet, walls);
}

/* Adds people 0.5 m apart, and twice as many beside each other in the middle of the stair. */
static void add_crowd(Plan *p) {
    for (float x = 0.25f; x < 20.0f; x += 0.5f)
        for (float y = 0.2f; y<10.0f; y += x> 10.0f && x < 12.0f ? 0.25f : 0.5f) {
            if (x > WEST && x < EAST && (y < 4.0f || y > 6.0f))
                continue;
            p->x[p->count] = turn_point(p, x, y).x;
            p->flat[p->count] = turn_point(p, x, y).y;
            p->sheets[p->count++] = put_on_sheet(p, x, y).y;
        }
}

static Plan *make_plan(float turn) {
    Plan *p = jox_alloc(1, sizeof *p);
    p->turn = turn;
    p->storeys = lay_out_two_storeys();
    JoxStair *stair = &p->storeys.stairs[0];
    for (uint32_t k = 0; k < 2; k++)
        stair->path[k] = turn_point(p, stair->path[k].x, stair->path[k].y);
    jox_storeys_lay_out(&p->storeys, jox_v2(-10, -10), jox_v2(20, 25));
    add_crowd(p);
    add_room(p, WEST, 0, &p->flat_walls);
    add_room(p, EAST, 0, &p->flat_walls);
    add_walls(p, (const float[][2]){{WEST, 4}, {EAST, 4}}, 2, false, 0, &p->flat_walls);
    add_walls(p, (const float[][2]){{WEST, 6}, {EAST, 6}}, 2, false, 0, &p->flat_walls);
    add_room(p, WEST, 0, &p->sheet_walls);
    add_room(p, EAST, 1, &p->sheet_walls);
    jox_storeys_add_walls(&p->storeys, &p->sheet_walls);
    return p;
}

static void free_plan(Plan *p) {
    jox_walls_free(&p->flat_walls);
    jox_walls_free(&p->sheet_walls);
    jox_storeys_free(&p->storeys);
    jox_free(p);
}

/* Fails where the densities of a floor, 1/m2, differ by more than `within`, between x = from and
   x = to. */
static void compare_floors(const Plan *p, const JoxDensity *flat, const JoxDensity *sheets,
                           float from, float to, double within) {
    double most = 0.0;
    for (float x = from + 0.1f; x < to; x += 0.2f)
        for (float y = 0.3f; y < 9.8f; y += 0.2f) {
            const JoxV2 plan = turn_point(p, x, y), at = put_on_sheet(p, x, y);
            size_t a, b;
            if (x > WEST - 0.3f && x < EAST + 0.3f && (y < 4.4f || y > 5.6f))
                continue;
            assert_true(jox_density_cell_of(flat, plan.x, plan.y, &a));
            assert_true(jox_density_cell_of(sheets, at.x, at.y, &b));
            most = fmax(most, fabs((double)flat->now[a] - (double)sheets->now[b]));
        }
    if (most > within)
        fail_msg("densities differ by %g", most);
}

static double count_people(const JoxDensity *d) {
    double people = 0.0;
    for (size_t k = 0; k < (size_t)d->columns * d->rows; k++)
        people += (double)d->now[k] * (double)jox_density_area(d, k);
    return people;
}

static void densities_over_seams_are_those_of_one_plane(void **state) {
    (void)state;
    const struct {
        float turn;
        double within; /* 1/m2: rows of a turned stair lie between those of the one plane */
    } CASES[] = {{0.0f, 0.001}, {0.5f, 0.1}, {2.0f, 0.1}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; k++) {
        Plan *p = make_plan(CASES[k].turn);
        const JoxV2 low = {-21, -11}, high = {21, 26};
        JoxDensity *flat = jox_density_create(low, high, 0.2f, JOX_DENSITY_KERNEL);
        JoxDensity *sheets =
            jox_density_create_on_storeys(low, high, 0.2f, JOX_DENSITY_KERNEL, &p->storeys);
        jox_density_walls(flat, &p->flat_walls);
        jox_density_walls(sheets, &p->sheet_walls);
        jox_density_add(flat, jox_v2(0, 0), p->x, p->flat, p->count, 0.0);
        jox_density_add(sheets, jox_v2(0, 0), p->x, p->sheets, p->count, 0.0);
        compare_floors(p, flat, sheets, 0, WEST + 1, CASES[k].within);
        compare_floors(p, flat, sheets, EAST - 1, 20, CASES[k].within);
        assert_near(count_people(sheets), p->count, 0.5);
        jox_density_free(sheets);
        /* A map of one storey counts who is on the stair near it. */
        for (uint32_t storey = 0; storey < 2; storey++) {
            sheets = jox_density_create(jox_on_sheet(&p->storeys, storey, low),
                                        jox_on_sheet(&p->storeys, storey, high), 0.2f,
                                        JOX_DENSITY_KERNEL);
            jox_density_storeys(sheets, &p->storeys);
            jox_density_walls(sheets, &p->sheet_walls);
            jox_density_add(sheets, jox_v2(0, 0), p->x, p->sheets, p->count, 0.0);
            compare_floors(p, flat, sheets, storey ? EAST : 0, storey ? 20 : WEST, CASES[k].within);
            jox_density_free(sheets);
        }
        jox_density_free(flat);
        free_plan(p);
    }
}

static void rows_of_a_density_leave_out_what_is_not_floor(void **state) {
    (void)state;
    JoxStoreys near = lay_out_two_storeys(), far = lay_out_two_storeys();
    const JoxV2 low = {-1, -1}, high = {21, 11};
    jox_storeys_lay_out(&far, jox_v2(0, -500), jox_v2(20, 500));
    assert_true(far.pitch > 20 * near.pitch);
    JoxDensity *d = jox_density_create_on_storeys(low, high, 0.2f, JOX_DENSITY_KERNEL, &near);
    JoxDensity *e = jox_density_create_on_storeys(low, high, 0.2f, JOX_DENSITY_KERNEL, &far);
    assert_int_equal(d->rows, 60 + 1 + 60 + 1 + 14);
    assert_int_equal(e->rows, d->rows);
    JoxWalls walls = {0};
    jox_storeys_add_walls(&far, &walls);
    jox_density_walls(e, &walls);
    double area = 0.0;
    for (size_t k = 0; k < (size_t)e->columns * e->rows; k++)
        area += (double)jox_density_area(e, k);
    assert_near(area, 2 * (22 * 12 - 12) + 12, 0.1); /* two storeys without the stair; the stair */
    for (uint32_t sheet = 0; sheet < 3; sheet++) {
        size_t cell;
        const JoxV2 at = jox_on_sheet(&far, sheet, jox_v2(9.1f, 5.1f));
        assert_true(jox_density_cell_of(e, at.x, at.y, &cell));
        assert_near(jox_density_middle(e, cell).x, at.x, 0.1001);
        assert_near(jox_density_middle(e, cell).y, at.y, 0.1001);
    }
    jox_walls_free(&walls);
    jox_density_free(d);
    jox_density_free(e);
    jox_storeys_free(&near);
    jox_storeys_free(&far);
}

/* ---- Voronoi cells ---- */

static void voronoi_cells_over_seams_are_those_of_one_plane(void **state) {
    (void)state;
    for (float turn = 0.0f; turn < 3.0f; turn += 0.7f) {
        Plan *p = make_plan(turn);
        float *here = jox_alloc(p->count, sizeof *here), *of[2];
        for (uint32_t i = 0; i < p->count; i++)
            here[i] = 5.0f;
        for (int k = 0; k < 2; k++) {
            JoxVoronoiPeople voronoi = {0};
            const JoxDensityCrowd crowd = {.count = p->count,
                                           .x = p->x,
                                           .y = k ? p->sheets : p->flat,
                                           .storeys = k ? &p->storeys : NULL};
            of[k] = jox_alloc(p->count, sizeof *here);
            jox_voronoi_people_measure(&voronoi, &crowd, k ? &p->sheet_walls : &p->flat_walls, 1,
                                       here, of[k]);
            jox_voronoi_people_free(&voronoi);
        }
        for (uint32_t i = 0; i < p->count; i++)
            assert_near(of[1][i] / of[0][i], 1.0, 1e-3);
        jox_free(here);
        jox_free(of[0]);
        jox_free(of[1]);
        free_plan(p);
    }
}

/* Measures a square of 1 m beside a seam, before it or beyond, in one plane or on its sheet. */
static JoxFigures measure_square(Plan *p, float x, bool on_sheets) {
    JoxV2 square[4];
    uint32_t key[CROWD];
    float still[CROWD] = {0};
    const float corners[4][2] = {
        {x - 0.5f, 4.5f}, {x + 0.5f, 4.5f}, {x + 0.5f, 5.5f}, {x - 0.5f, 5.5f}};
    for (int k = 0; k < 4; k++)
        square[k] =
            jox_on_sheet(&p->storeys, on_sheets && x > WEST ? p->storeys.stairs[0].sheet : 0,
                         turn_point(p, corners[k][0], corners[k][1]));
    for (uint32_t i = 0; i < p->count; i++)
        key[i] = i;
    JoxProbeDef def = {.name = "square",
                       .kind = JOX_PROBE_MEASURE,
                       .points = square,
                       .count = 4,
                       .every = 1.0,
                       .cutoff = 1.0,
                       .until = INFINITY};
    const JoxFrame frame = {.time = 0.5,
                            .count = p->count,
                            .keys = p->count,
                            .key = key,
                            .x = p->x,
                            .y = on_sheets ? p->sheets : p->flat,
                            .vx = still,
                            .vy = still,
                            .walls = on_sheets ? &p->sheet_walls : &p->flat_walls,
                            .storeys = on_sheets ? &p->storeys : NULL};
    JoxProbe *probe = jox_probe_create(&def);
    jox_probe_frame(probe, &frame);
    const JoxFigures figures = jox_probe_figures(probe);
    jox_probe_free(probe);
    return figures;
}

static void measured_squares_beside_a_seam_are_those_of_one_plane(void **state) {
    (void)state;
    Plan *p = make_plan(0.4f);
    for (int beyond = 0; beyond < 2; beyond++) {
        const float x = beyond ? WEST + 0.5f : WEST - 0.5f;
        const JoxFigures flat = measure_square(p, x, false), sheets = measure_square(p, x, true);
        assert_true(flat.count > 5 && flat.items[3].value > 3.0);
        for (uint32_t f = 0; f < 7; f++)
            assert_near(sheets.items[f].value, flat.items[f].value, 1e-3);
    }
    free_plan(p);
}

/* ---- recordings ---- */

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

/* Changes a recording and returns whether it can still be read, with errors if not. */
static bool reads_after(const char *sql) {
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
    const bool read = t != NULL;
    jox_trajectories_free(t);
    jox_diag_free(&diagnostics);
    return read;
}

static void damaged_storeys_are_refused(void **state) {
    (void)state;
    static const char *const DAMAGES[] = {
        "UPDATE jostle_row SET storey = 2 WHERE frame = 3",
        "UPDATE jostle_row SET stair = -1 WHERE frame = 3",
        "UPDATE jostle_storey SET height = 0",
        "UPDATE jostle_storey SET number = number + 5",
        "UPDATE jostle_stair SET upper = 9",
        "UPDATE jostle_stair SET path = '8 5'",
        "UPDATE jostle_stair SET path = '8 5, 8 5'",
        "UPDATE jostle_stair SET path = '8 5, nan 5'",
        "UPDATE jostle_stair SET width = 0",
        "UPDATE jostle_stair SET landings = '3 2'",
        "DELETE FROM metadata WHERE key = 'jostle_pitch'",
        "UPDATE metadata SET value = 0 WHERE key = 'jostle_pitch'",
    };
    assert_true(reads_after("SELECT 1"));
    for (size_t k = 0; k < sizeof DAMAGES / sizeof *DAMAGES; k++)
        if (reads_after(DAMAGES[k]))
            fail_msg("read after %s", DAMAGES[k]);
    unlink(path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agent_over_a_seam_walks_on_and_crosses_each_line_once),
        cmocka_unit_test(densities_over_seams_are_those_of_one_plane),
        cmocka_unit_test(rows_of_a_density_leave_out_what_is_not_floor),
        cmocka_unit_test(voronoi_cells_over_seams_are_those_of_one_plane),
        cmocka_unit_test(recording_is_in_plan_and_reads_back_on_sheets),
        cmocka_unit_test(damaged_storeys_are_refused),
        cmocka_unit_test(measured_squares_beside_a_seam_are_those_of_one_plane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
