/* Trajectories in the JuPedSim format. Versions 1 and 2 differ in how they keep the walkable area;
   its text is in `geometry.wkt` in both. */
#include <math.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "record/database.h"
#include "record/trajectories.h"

enum { MOST_RING = 5000 };

static bool fail(JoxDiagnostics *diagnostics, const char *path, const char *hint,
                 const char *what) {
    JoxPosition at = {path, 0, 0, 0};
    jox_diag_error(diagnostics, at, "bad-recording", hint, "%s", what);
    return false;
}

static sqlite3_stmt *ask(sqlite3 *db, const char *sql) {
    sqlite3_stmt *statement = NULL;
    if (sqlite3_prepare_v2(db, sql, -1, &statement, NULL) != SQLITE_OK) {
        sqlite3_finalize(statement);
        return NULL;
    }
    return statement;
}

static double ask_number(sqlite3 *db, const char *sql) {
    sqlite3_stmt *statement = ask(db, sql);
    double value = statement && sqlite3_step(statement) == SQLITE_ROW
                       ? sqlite3_column_double(statement, 0)
                       : 0.0;
    sqlite3_finalize(statement);
    return value;
}

/* Every ring of points in a WKT text, whatever it is a part of, becomes a closed line. */
static void read_outlines(JoxTrajectories *t, const char *wkt) {
    JoxV2 ring[MOST_RING];
    while ((wkt = strchr(wkt, '('))) {
        uint32_t count = 0;
        const char *at = ++wkt;
        bool good = true;
        while (good && *at && *at != '(' && *at != ')') {
            char *end;
            double x = strtod(at, &end), y = end != at ? strtod(at = end, &end) : 0.0;
            good = end != at && isfinite(x) && isfinite(y) && count < MOST_RING;
            if (!good)
                break;
            ring[count++] = (JoxV2){(float)x, (float)y};
            at = end + strspn(end, " ,");
        }
        if (count > 1 && ring[0].x == ring[count - 1].x && ring[0].y == ring[count - 1].y)
            count--;
        if (good && count >= 3)
            jox_walls_add_polyline(&t->walls, ring, count, true, INFINITY);
    }
}

static void read_geometry(JoxTrajectories *t, sqlite3 *db) {
    sqlite3_stmt *statement = ask(db, "SELECT wkt FROM geometry LIMIT 1");
    if (statement && sqlite3_step(statement) == SQLITE_ROW && sqlite3_column_text(statement, 0))
        read_outlines(t, (const char *)sqlite3_column_text(statement, 0));
    sqlite3_finalize(statement);
}

static void read_groups(JoxTrajectories *t, sqlite3 *db) {
    sqlite3_stmt *statement = ask(db, "SELECT name FROM jostle_group ORDER BY number");
    uint32_t capacity = 0;
    while (statement && t->group_count < UINT16_MAX && sqlite3_step(statement) == SQLITE_ROW) {
        const char *name = (const char *)sqlite3_column_text(statement, 0);
        JOX_RESERVE(t->groups, capacity, t->group_count + 1);
        t->groups[t->group_count++] = jox_strdup(name ? name : "");
    }
    sqlite3_finalize(statement);
}

void jox_trajectories_plan(JoxTrajectories *t, sqlite3 *db) {
    read_geometry(t, db);
    read_groups(t, db);
}

/* Names of states, and the numbers that they have in the recording, `numbers`, ascending; the first
   name is that of people without a machine. */
static int64_t *read_states(JoxTrajectories *t, sqlite3 *db) {
    sqlite3_stmt *statement =
        ask(db, "SELECT number, machine, state, (SELECT COUNT(DISTINCT machine) FROM jostle_state) "
                "FROM jostle_state ORDER BY number");
    uint32_t capacity = 0, room = 0;
    int64_t *numbers = NULL;
    while (statement && sqlite3_step(statement) == SQLITE_ROW) {
        const char *machine = (const char *)sqlite3_column_text(statement, 1);
        const char *state = (const char *)sqlite3_column_text(statement, 2);
        JoxText name = {0};
        JOX_RESERVE(t->states, capacity, t->state_count + 2);
        JOX_RESERVE(numbers, room, t->state_count + 2);
        if (t->state_count == 0) {
            numbers[0] = INT64_MIN;
            t->states[t->state_count++] = jox_strdup("");
        }
        if (machine && sqlite3_column_int64(statement, 3) > 1)
            jox_text_printf(&name, "%s: ", machine);
        jox_text_add(&name, state ? state : "");
        numbers[t->state_count] = sqlite3_column_int64(statement, 0);
        t->states[t->state_count++] = name.data ? name.data : jox_strdup("");
    }
    sqlite3_finalize(statement);
    return numbers;
}

/* The row of the state with a number; that of nobody's where there is none. */
static uint32_t find_state(const JoxTrajectories *t, const int64_t *numbers, int64_t number) {
    uint32_t low = 0, high = t->state_count;
    while (low + 1 < high) {
        uint32_t middle = (low + high) / 2;
        if (numbers[middle] <= number)
            low = middle;
        else
            high = middle;
    }
    return numbers[low] == number ? low : 0;
}

/* Rows, with force, compression, group, state and heading where the recording is one of ours: then
   both tables have been written row by row. */
static bool read_rows(JoxTrajectories *t, sqlite3 *db, JoxDiagnostics *diagnostics,
                      const char *path) {
    sqlite3_stmt *rows =
        ask(db, "SELECT d.frame, d.id, d.pos_x, d.pos_y, a.force, a.compression, a.member, "
                "a.state, d.ori_x, d.ori_y FROM trajectory_data d LEFT JOIN jostle_agent a ON "
                "a.rowid = d.rowid");
    bool ours = rows != NULL, good = true;
    if (!ours)
        rows = ask(db, "SELECT frame, id, pos_x, pos_y FROM trajectory_data");
    if (!rows)
        return fail(diagnostics, path, "It must be of the JuPedSim format: a table trajectory_data",
                    sqlite3_errmsg(db));
    int64_t *numbers = ours ? read_states(t, db) : NULL;
    size_t capacities[6] = {0};
    int status;
    while ((status = sqlite3_step(rows)) == SQLITE_ROW && good) {
        double x = sqlite3_column_double(rows, 2), y = sqlite3_column_double(rows, 3);
        good = fabs(x) < 1e6 && fabs(y) < 1e6;
        size_t row = jox_trajectories_add(t);
        t->number[row] = sqlite3_column_int64(rows, 0);
        t->id[row] = sqlite3_column_int64(rows, 1);
        t->line[row] = 0;
        t->x[row] = (float)x;
        t->y[row] = (float)y;
        t->vx[row] = t->vy[row] = 0.0f;
        if (!ours)
            continue;
        JOX_RESERVE(t->force, capacities[0], row + 1);
        JOX_RESERVE(t->compression, capacities[1], row + 1);
        JOX_RESERVE(t->group, capacities[2], row + 1);
        t->force[row] = (float)sqlite3_column_double(rows, 4);
        t->compression[row] = (float)sqlite3_column_double(rows, 5);
        t->group[row] = (uint16_t)sqlite3_column_int64(rows, 6);
        JOX_RESERVE(t->face_x, capacities[3], row + 1);
        JOX_RESERVE(t->face_y, capacities[4], row + 1);
        t->face_x[row] = (float)sqlite3_column_double(rows, 8);
        t->face_y[row] = (float)sqlite3_column_double(rows, 9);
        if (!numbers)
            continue;
        JOX_RESERVE(t->state, capacities[5], row + 1);
        t->state[row] = find_state(t, numbers, sqlite3_column_int64(rows, 7));
    }
    jox_free(numbers);
    sqlite3_finalize(rows);
    if (!good)
        return fail(diagnostics, path, NULL, "somebody is more than 1000 km from the origin");
    if (status != SQLITE_DONE)
        return fail(diagnostics, path, NULL, sqlite3_errmsg(db));
    return t->count > 0 || fail(diagnostics, path, NULL, "nobody is in this recording");
}

bool jox_trajectories_sqlite(JoxTrajectories *t, const char *path,
                             const JoxTrajectoryOptions *options, JoxDiagnostics *diagnostics) {
    sqlite3 *db = NULL;
    bool good = jox_database_open(path, &db);
    if (!good)
        fail(diagnostics, path, NULL, sqlite3_errmsg(db));
    good = good && read_rows(t, db, diagnostics, path);
    if (good) {
        t->fps = options->fps > 0.0
                     ? options->fps
                     : ask_number(db, "SELECT CAST(value AS REAL) FROM metadata WHERE key = 'fps'");
        if (!(t->fps > 0.0 && t->fps <= 1e5))
            good = fail(diagnostics, path, options->fps_option ? options->fps_option : "--fps 25",
                        "this recording does not say how many frames a second it has");
        t->last = (int64_t)ask_number(db, "SELECT MAX(frame) FROM frame_data");
        jox_trajectories_plan(t, db);
    }
    jox_database_close(db);
    return good;
}
