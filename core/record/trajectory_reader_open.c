/* Opens a recording for the trajectory reader: finds its frames and their rows, and reads its
   properties. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "machine/machine.h"
#include "record/recorder_schema.h"
#include "record/storey_tables.h"
#include "record/table_rows.h"
#include "record/trajectory_reader_parts.h"

enum {
    MOST_FRAMES = 10000000,
    NEWEST = 2 /* newest version of the format that is read */,
    LONGEST_LOOK = 1 << 24 /* bytes */
};

static bool add_open_error(JoxDiagnostics *diagnostics, const char *path, const char *hint,
                           const char *message) {
    JoxPosition at = {path, 0, 0, 0};
    jox_diag_error(diagnostics, at, "bad-recording", hint, "%s", message);
    return false;
}

/* Returns the first column of the first row of a query in `value`; false if there is none. */
static bool query_number(JoxDatabase *db, const char *sql, double *value) {
    sqlite3_stmt *statement = jox_database_prepare(db, sql);
    bool found = statement && sqlite3_step(statement) == SQLITE_ROW &&
                 sqlite3_column_type(statement, 0) != SQLITE_NULL;
    *value = found ? sqlite3_column_double(statement, 0) : 0.0;
    jox_database_finalize(db, statement);
    return found;
}

/* ---- list of frames ---- */

static void add_listed_frame(JoxTrajectoryReader *r, int64_t number, int64_t from) {
    JOX_RESERVE(r->number, r->number_capacity, r->frames + 1);
    JOX_RESERVE(r->from, r->from_capacity, r->frames + 2);
    r->number[r->frames] = number;
    r->from[r->frames] = from;
    r->from[++r->frames] = from;
}

/* Lists frame numbers by the index, one look-up each, together with empty frames, which table
   frame_data lists. */
static bool list_frames_by_index(JoxTrajectoryReader *r) {
#define WITH_PEOPLE                                                                                \
    "WITH RECURSIVE f(n) AS (SELECT MIN(frame) FROM trajectory_data UNION ALL SELECT (SELECT "     \
    "MIN(frame) FROM trajectory_data WHERE frame > n) FROM f WHERE n IS NOT NULL) "                \
    "SELECT n FROM f WHERE n IS NOT NULL "
    sqlite3_stmt *list =
        jox_database_prepare(r->db, WITH_PEOPLE "UNION SELECT frame FROM frame_data ORDER BY 1");
    if (!list)
        list = jox_database_prepare(r->db, WITH_PEOPLE "ORDER BY 1");
#undef WITH_PEOPLE
    int status = list ? SQLITE_ROW : SQLITE_ERROR;
    while (r->frames < MOST_FRAMES && (status = list ? sqlite3_step(list) : status) == SQLITE_ROW) {
        const int64_t number = sqlite3_column_int64(list, 0);
        if (r->frames == 0 || number > r->number[r->frames - 1])
            add_listed_frame(r, number, 0);
    }
    jox_database_finalize(r->db, list);
    return r->frames > 0 && status == SQLITE_DONE;
}

/* Lists the first row of each frame in one pass. Returns false if the rows are not in order of
   frames. */
static bool list_frames_by_row(JoxTrajectoryReader *r) {
    sqlite3_stmt *rows =
        jox_database_prepare(r->db, "SELECT rowid, frame FROM trajectory_data ORDER BY rowid");
    bool ordered = rows != NULL;
    int64_t row = 0;
    int status = SQLITE_DONE;
    while (ordered && (status = sqlite3_step(rows)) == SQLITE_ROW) {
        int64_t frame = sqlite3_column_int64(rows, 1);
        row = sqlite3_column_int64(rows, 0);
        ordered = sqlite3_column_type(rows, 0) != SQLITE_NULL &&
                  (r->frames == 0 || frame >= r->number[r->frames - 1]) && r->frames < MOST_FRAMES;
        if (ordered && (r->frames == 0 || frame > r->number[r->frames - 1]))
            add_listed_frame(r, frame, row);
    }
    ordered = ordered && status == SQLITE_DONE;
    jox_database_finalize(r->db, rows);
    if (r->frames)
        r->from[r->frames] = row + 1;
    if (!ordered)
        r->frames = 0;
    return ordered && r->frames > 0;
}

/* Makes a copy of the table with sorted rows, which hides the table, and lists its frames. */
static bool copy_rows_sorted(JoxTrajectoryReader *r) {
    /* Some tables have no row numbers. */
    static const char *const COLUMNS[] = {", rowid AS source", ""};
    for (int w = 0; w < 2 && !r->sorted; w++) {
        JoxText sql = {0};
        jox_text_printf(&sql,
                        "CREATE TEMP TABLE trajectory_data AS SELECT *%s FROM "
                        "main.trajectory_data ORDER BY frame, id",
                        COLUMNS[w]);
        r->sorted = sqlite3_exec(r->db->sqlite, sql.data, NULL, NULL, NULL) == SQLITE_OK;
        jox_text_free(&sql);
    }
    return r->sorted && list_frames_by_row(r);
}

/* ---- opening ---- */

static void read_state_names(JoxTrajectoryReader *r) {
    /* Older recordings have no poses, still older ones no colours. */
    static const char *const QUERIES[] = {
        "SELECT number, machine, state, colour, pose FROM jostle_state ORDER BY number",
        "SELECT number, machine, state, colour, NULL FROM jostle_state ORDER BY number",
        "SELECT number, machine, state, NULL, NULL FROM jostle_state ORDER BY number"};
    sqlite3_stmt *list = NULL;
    size_t capacity = 0;
    for (int q = 0; q < 3 && !list; q++)
        list = jox_database_prepare(r->db, QUERIES[q]);
    while (list && r->state_count < UINT16_MAX && sqlite3_step(list) == SQLITE_ROW) {
        const char *machine = (const char *)sqlite3_column_text(list, 1);
        const char *name = (const char *)sqlite3_column_text(list, 2);
        JOX_RESERVE(r->states, capacity, r->state_count + 1);
        r->states[r->state_count++] = (struct JoxTrajectoryReaderState){
            jox_strdup(machine ? machine : ""),
            jox_strdup(name ? name : ""),
            sqlite3_column_int64(list, 0),
            jox_trajectory_colour(list, 3),
            jox_trajectory_choice(list, 4, jox_poses, JOX_POSE_COUNT),
            jox_trajectory_choice(list, 4, (const char *const[]){NULL, JOX_RECORDED_LIES}, 2) > 0};
    }
    jox_database_finalize(r->db, list);
}

/* Prepares the query for the rows of a frame, by the columns that the file has. In order: our
   recordings of storeys; our others; those before falls; before torsos; before radii; before that,
   those with table jostle_agent; those before loads; files of JuPedSim; files with nothing but
   positions. */
static bool prepare_frame_queries(JoxTrajectoryReader *r) {
    static const char *const WAYS[] = {"WHERE d.frame = ?1 ORDER BY d.id",
                                       "WHERE d.rowid >= ?2 AND d.rowid < ?3 ORDER BY d.id"};
#define PLACED "SELECT d.id, d.pos_x, d.pos_y, d.ori_x, d.ori_y"
#define OURS PLACED ", a.state, a.force, a.compression, a.member"
#define OF_AGENTS                                                                                  \
    " FROM trajectory_data d LEFT JOIN jostle_agent a ON a.rowid = d.%s AND a.id = d.id"           \
    " AND a.frame = d.frame"
    static const char *const COLUMNS[] = {
        PLACED ", d.state, d.force, d.compression, d.member, d.load, d.radius, d.chest, d.breadth, "
               "d.depth, d.fallen, d.storey, d.stair FROM trajectory_data d",
        PLACED ", d.state, d.force, d.compression, d.member, d.load, d.radius, d.chest, d.breadth, "
               "d.depth, d.fallen FROM trajectory_data d",
        PLACED ", d.state, d.force, d.compression, d.member, d.load, d.radius, d.chest, d.breadth, "
               "d.depth FROM trajectory_data d",
        PLACED
        ", d.state, d.force, d.compression, d.member, d.load, d.radius FROM trajectory_data d",
        PLACED ", d.state, d.force, d.compression, d.member, d.load FROM trajectory_data d",
        OURS ", a.load" OF_AGENTS,
        OURS OF_AGENTS,
        PLACED " FROM trajectory_data d",
        "SELECT d.id, d.pos_x, d.pos_y FROM trajectory_data d"};
    const int first = r->outlines.storeys.storey_count > 0 ? 0 : 1;
    for (int c = first; c < (int)(sizeof COLUMNS / sizeof *COLUMNS) && !r->rows; c++) {
        JoxText sql = {0};
        jox_text_printf(&sql, COLUMNS[c], r->sorted ? "source" : "rowid");
        jox_text_printf(&sql, " %s", WAYS[r->way]);
        r->rows = jox_database_prepare(r->db, sql.data);
        r->placed = c < 1;
        r->falls = c < 2;
        r->torsos = c < 3;
        r->radii = c < 4;
        r->loads = c < 6;
        r->ours = c < 7;
        r->facing = c < 8;
        jox_text_free(&sql);
    }
    double last;
    if (query_number(r->db, "SELECT MAX(rowid) FROM jostle_body", &last)) {
        r->last_body = (int64_t)last;
        r->body_at = jox_database_prepare(r->db, "SELECT frame FROM jostle_body WHERE rowid = ?");
#define BODIES_WITH(more)                                                                          \
    "SELECT frame, id, x, y, z, qx, qy, qz, qw" more                                               \
    " FROM jostle_body WHERE rowid >= ? ORDER BY "                                                 \
    "rowid"
        r->bodies = jox_database_prepare(r->db, r->placed ? BODIES_WITH(", storey, stair")
                                                          : BODIES_WITH(""));
    }
#define PART_WITH(name)                                                                            \
    "SELECT kind, size_x, size_y, size_z, x, y, z, qx, qy, qz, qw, corners, " name                 \
    " FROM jostle_part WHERE id = ?1 AND part = ?3 AND frame = (SELECT MAX(frame) FROM "           \
    "jostle_part WHERE id = ?1 AND frame <= ?2)"
    r->part = jox_database_prepare(r->db, PART_WITH("name"));
    if (!r->part) /* an older recording, without names */
        r->part = jox_database_prepare(r->db, PART_WITH("NULL"));
    sqlite3_stmt *list =
        jox_database_prepare(r->db, "SELECT DISTINCT frame FROM jostle_part ORDER BY frame");
    while (list && sqlite3_step(list) == SQLITE_ROW) {
        JOX_RESERVE(r->changes, r->change_capacity, r->change_count + 1);
        r->changes[r->change_count++] = sqlite3_column_int64(list, 0);
    }
    jox_database_finalize(r->db, list);
    return r->rows != NULL;
}

/* Reads the bounding box of all people from the metadata; older files of other programs may lack
   it. */
static void read_bounds(JoxTrajectoryReader *r) {
#define BOUND(key) "SELECT CAST(value AS REAL) FROM metadata WHERE key = '" key "'"
    static const char *const QUESTIONS[] = {BOUND("xmin"), BOUND("ymin"), BOUND("xmax"),
                                            BOUND("ymax")};
#undef BOUND
    double bounds[4];
    r->bounded = true;
    for (int k = 0; k < 4; k++)
        r->bounded &= query_number(r->db, QUESTIONS[k], &bounds[k]) && fabs(bounds[k]) < 1e6;
    r->bounded = r->bounded && bounds[0] <= bounds[2] && bounds[1] <= bounds[3];
    if (r->bounded) {
        r->low = (JoxV2){(float)bounds[0], (float)bounds[1]};
        r->high = (JoxV2){(float)bounds[2], (float)bounds[3]};
        const JoxStoreys *storeys = &r->outlines.storeys;
        if (jox_has_storeys(storeys)) /* the bounds are in plan */
            r->high = jox_on_sheet(storeys, storeys->sheet_count - 1, r->high);
    }
}

/* Reads the text that tells what the scene shows besides, unless it is longer than a scene's can
   be. */
static void read_look(JoxTrajectoryReader *r) {
    sqlite3_stmt *row = jox_database_prepare(
        r->db, "SELECT value FROM metadata WHERE key = '" JOX_RECORDED_LOOK "'");
    const char *text =
        row && sqlite3_step(row) == SQLITE_ROW ? (const char *)sqlite3_column_text(row, 0) : NULL;
    if (text && sqlite3_column_bytes(row, 0) <= LONGEST_LOOK)
        r->look = jox_strdup(text);
    jox_database_finalize(r->db, row);
}

/* Returns whether the version of the file is missing or supported; false adds an error. */
static bool has_known_version(const JoxTrajectoryReader *r, const char *path,
                              JoxDiagnostics *diagnostics) {
    double version;
    char message[100];
    if (!query_number(r->db, "SELECT CAST(value AS REAL) FROM metadata WHERE key = 'version'",
                      &version) ||
        version < NEWEST + 1)
        return true;
    snprintf(message, sizeof message, "this recording is of version %.9g of the JuPedSim format",
             version);
    return add_open_error(diagnostics, path, "Versions 1 and 2 are read", message);
}

/* Returns whether a table has an index whose first column is the frame. */
static bool has_frame_index(JoxDatabase *db, const char *table) {
    bool indexed = false;
    char *sql = sqlite3_mprintf("PRAGMA main.index_list(%Q)", table);
    sqlite3_stmt *indices = sql ? jox_database_prepare(db, sql) : NULL;
    sqlite3_free(sql);
    while (!indexed && indices && sqlite3_step(indices) == SQLITE_ROW) {
        sql = sqlite3_mprintf("PRAGMA main.index_info(%Q)", sqlite3_column_text(indices, 1));
        sqlite3_stmt *columns = sql ? jox_database_prepare(db, sql) : NULL;
        sqlite3_free(sql);
        while (!indexed && columns && sqlite3_step(columns) == SQLITE_ROW) {
            const char *name = (const char *)sqlite3_column_text(columns, 2);
            indexed = sqlite3_column_int(columns, 0) == 0 && name && !strcmp(name, "frame");
        }
        jox_database_finalize(db, columns);
    }
    jox_database_finalize(db, indices);
    return indexed;
}

/* Returns whether the rows of our recording have a column. */
static bool has_column(JoxDatabase *db, const char *name) {
    char *sql = sqlite3_mprintf("SELECT %w FROM jostle_row LIMIT 0", name);
    sqlite3_stmt *found = sql ? jox_database_prepare(db, sql) : NULL;
    sqlite3_free(sql);
    jox_database_finalize(db, found);
    return found != NULL;
}

/* Finds the table of the rows. In our recordings trajectory_data is a view, which is created anew
   over our table; any other view of that name could be any query and is refused. Returns false with
   an error. */
static bool find_row_table(JoxTrajectoryReader *r, const char *path, const char **table,
                           JoxDiagnostics *diagnostics) {
    double found;
    *table = "trajectory_data";
    if (query_number(r->db,
                     "SELECT 1 FROM sqlite_schema WHERE type = 'table' AND name = 'jostle_row'",
                     &found)) {
        *table = "jostle_row";
        static const char *const VIEWS[] = {
            "CREATE TEMP VIEW trajectory_data AS " JOX_RECORDED_STOREY_ROWS,
            "CREATE TEMP VIEW trajectory_data AS " JOX_RECORDED_ROWS,
            "CREATE TEMP VIEW trajectory_data AS " JOX_RECORDED_BEFORE_FALLS,
            "CREATE TEMP VIEW trajectory_data AS " JOX_RECORDED_BEFORE_TORSOS,
            "CREATE TEMP VIEW trajectory_data AS " JOX_RECORDED_BEFORE_RADII};
        const int version = has_column(r->db, "storey")   ? 0
                            : has_column(r->db, "fallen") ? 1
                            : has_column(r->db, "chest")  ? 2
                            : has_column(r->db, "radius") ? 3
                                                          : 4;
        sqlite3_exec(r->db->sqlite, VIEWS[version], NULL, NULL, NULL);
    } else if (query_number(
                   r->db,
                   "SELECT 1 FROM sqlite_schema WHERE type = 'view' AND name = 'trajectory_data'",
                   &found)) {
        return add_open_error(diagnostics, path, "Copy its rows into a plain table of that name",
                              "its trajectory_data is a view, and views of a file are not run");
    }
    return true;
}

/* Lists the frames, prepares the queries, and reads frame rate, bounds, states, walls and groups.
   Returns false with an error. */
static bool read_properties(JoxTrajectoryReader *r, const char *path,
                            const JoxTrajectoryOptions *options, JoxDiagnostics *diagnostics) {
    static const char *const HINT = "It must be of the JuPedSim format: a table trajectory_data";
    const char *table;
    double found;
    JoxText why = {0};
    bool placed = jox_storey_tables_read(r->db, &r->outlines.storeys, &why);
    if (placed) {
        r->outlines.lifts = jox_lift_history_read(r->db, &r->outlines.storeys, &why);
        placed = why.length == 0;
    }
    if (!placed) {
        add_open_error(diagnostics, path, JOX_ROW_HINT, why.data);
        jox_text_free(&why);
        return false;
    }
    if (!has_known_version(r, path, diagnostics) || !find_row_table(r, path, &table, diagnostics))
        return false;
    sqlite3_stmt *probe =
        jox_database_prepare(r->db, "SELECT frame, id, pos_x, pos_y FROM trajectory_data "
                                    "LIMIT 1");
    const int status = probe ? sqlite3_step(probe) : SQLITE_ERROR;
    if (!probe || (status != SQLITE_ROW && status != SQLITE_DONE))
        add_open_error(diagnostics, path, HINT, sqlite3_errmsg(r->db->sqlite));
    else if (status == SQLITE_DONE)
        add_open_error(diagnostics, path, NULL, "nobody is in this recording");
    jox_database_finalize(r->db, probe);
    if (status != SQLITE_ROW)
        return false;
    const bool indexed = has_frame_index(r->db, table);
    r->way = indexed ? JOX_READ_BY_INDEX : JOX_READ_BY_ROW;
    if (!(indexed ? list_frames_by_index(r) : list_frames_by_row(r) || copy_rows_sorted(r)))
        return add_open_error(diagnostics, path, HINT, sqlite3_errmsg(r->db->sqlite));
    r->fps = options->fps;
    if (r->fps <= 0.0 &&
        !query_number(r->db, "SELECT CAST(value AS REAL) FROM metadata WHERE key = 'fps'", &r->fps))
        r->fps = 0.0;
    if (!(r->fps > 0.0 && r->fps <= 1e5))
        return add_open_error(diagnostics, path,
                              options->fps_option ? options->fps_option : "--fps 25",
                              "this recording does not say how many frames a second it has");
    if (!prepare_frame_queries(r))
        return add_open_error(diagnostics, path, HINT, sqlite3_errmsg(r->db->sqlite));
    for (uint32_t f = 0; f < r->frames; f++)
        if (!(fabs((double)r->number[f]) / r->fps <= 1e9))
            return add_open_error(diagnostics, path, "Are id and frame exchanged?",
                                  "a frame is more than 30 years from the first");
    if (query_number(r->db, "SELECT MAX(frame) FROM frame_data", &found))
        r->last = (int64_t)found;
    read_bounds(r);
    read_look(r);
    read_state_names(r);
    if (!jox_trajectories_read_walls(&r->outlines, r->db, &why))
        add_open_error(diagnostics, path, JOX_ROW_HINT, why.data);
    const bool good = why.length == 0;
    jox_text_free(&why);
    return good;
}

static bool open_sqlite_recording(JoxTrajectoryReader *r, const char *path,
                                  const JoxTrajectoryOptions *options,
                                  JoxDiagnostics *diagnostics) {
    JoxText why = {0};
    r->db = jox_database_open(path, JOX_DATABASE_READ, &why);
    if (r->db)
        jox_database_bound(r->db, true);
    bool good = r->db && jox_database_allow(r->db, jox_recording_tables, &why);
    if (!good)
        add_open_error(diagnostics, path, NULL, why.data);
    good = good && read_properties(r, path, options, diagnostics);
    if (r->db)
        jox_database_bound(r->db, false);
    jox_text_free(&why);
    return good;
}

static bool open_text_recording(JoxTrajectoryReader *r, const char *path,
                                const JoxTrajectoryOptions *options, JoxDiagnostics *diagnostics) {
    r->way = JOX_READ_WHOLE;
    r->in_memory = jox_trajectories_read_text(path, options, diagnostics);
    if (!r->in_memory)
        return false;
    r->fps = r->in_memory->fps;
    r->frames = r->in_memory->frame_count;
    r->bounded = true;
    r->low = r->in_memory->low;
    r->high = r->in_memory->high;
    return true;
}

bool jox_is_sqlite(const char *path) {
    char start[16] = "";
    FILE *file = jox_file_open(path, "rb");
    size_t got = file ? fread(start, 1, sizeof start, file) : 0;
    if (file)
        jox_file_close(file);
    return got == sizeof start && memcmp(start, "SQLite format 3", 16) == 0;
}

JoxTrajectoryReader *jox_trajectory_reader_open(const char *path,
                                                const JoxTrajectoryOptions *options,
                                                JoxDiagnostics *diagnostics) {
    JoxTrajectoryReader *r = jox_alloc(1, sizeof *r);
    if (jox_is_sqlite(path) ? open_sqlite_recording(r, path, options, diagnostics)
                            : open_text_recording(r, path, options, diagnostics))
        return r;
    jox_trajectory_reader_close(r);
    return NULL;
}
