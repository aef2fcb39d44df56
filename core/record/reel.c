#include "record/reel.h"

#include <math.h>
#include <sqlite3.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"

enum { MOST_FRAMES = 10000000 };

/* How the rows of a frame are found. */
typedef enum { BY_INDEX, BY_ROW, WHOLE } Way;

struct JoxReel {
    Way way;
    double fps;
    sqlite3 *db;
    sqlite3_stmt *rows, *body_at, *bodies;
    bool ours;              /* with states, forces and groups */
    bool facing;            /* with the way people look */
    int64_t *number, *from; /* of each frame; BY_ROW: its first row, and one more at the end */
    uint32_t frames;
    size_t number_capacity, from_capacity;
    int64_t last_body; /* row */
    sqlite3_stmt *part;
    int64_t *changes; /* numbers of the frames in which shapes changed */
    uint32_t change_count;
    size_t change_capacity;
    JoxV3 *corners;
    size_t corner_capacity;
    JoxTrajectories *all;
    JoxTrajectories outlines; /* walls and groups as they are read from SQLite */
    struct JoxReelState *states;
    uint32_t state_count;
    bool bounded;
    JoxV2 low, high;
    /* The frame that was read last. */
    int64_t *id;
    float *x, *y, *face_x, *face_y, *force, *compression;
    uint32_t *state;
    uint16_t *group;
    JoxRecordBody *body;
    size_t capacity, body_capacity;
};

static bool wrong(JoxDiagnostics *diagnostics, const char *path, const char *hint,
                  const char *what) {
    JoxPosition at = {path, 0, 0, 0};
    jox_diag_error(diagnostics, at, "bad-recording", hint, "%s", what);
    return false;
}

static sqlite3_stmt *prepare(sqlite3 *db, const char *sql) {
    sqlite3_stmt *statement = NULL;
    if (sqlite3_prepare_v2(db, sql, -1, &statement, NULL) == SQLITE_OK)
        return statement;
    sqlite3_finalize(statement);
    return NULL;
}

/* The first column of the first row; false where there is none. */
static bool ask(sqlite3 *db, const char *sql, double *value) {
    sqlite3_stmt *statement = prepare(db, sql);
    bool found = statement && sqlite3_step(statement) == SQLITE_ROW &&
                 sqlite3_column_type(statement, 0) != SQLITE_NULL;
    *value = found ? sqlite3_column_double(statement, 0) : 0.0;
    sqlite3_finalize(statement);
    return found;
}

/* ---- which frames there are ---- */

static void add_frame(JoxReel *r, int64_t number, int64_t from) {
    JOX_RESERVE(r->number, r->number_capacity, r->frames + 1);
    JOX_RESERVE(r->from, r->from_capacity, r->frames + 2);
    r->number[r->frames] = number;
    r->from[r->frames] = from;
    r->from[++r->frames] = from;
}

/* Numbers of frames by the index, one look-up each; those without anybody too, where a table lists
   them. */
static bool list_by_index(JoxReel *r) {
    sqlite3_stmt *list = prepare(r->db, "SELECT DISTINCT frame FROM frame_data ORDER BY frame");
    while (list && r->frames < MOST_FRAMES && sqlite3_step(list) == SQLITE_ROW)
        add_frame(r, sqlite3_column_int64(list, 0), 0);
    sqlite3_finalize(list);
    if (r->frames)
        return true;
    sqlite3_stmt *next =
        prepare(r->db, "SELECT frame FROM trajectory_data WHERE frame > ? ORDER BY frame LIMIT 1");
    int64_t last = INT64_MIN;
    while (next && r->frames < MOST_FRAMES) {
        sqlite3_bind_int64(next, 1, last);
        if (sqlite3_step(next) != SQLITE_ROW)
            break;
        last = sqlite3_column_int64(next, 0);
        sqlite3_reset(next);
        add_frame(r, last, 0);
    }
    sqlite3_finalize(next);
    return r->frames > 0;
}

/* Where each frame begins, in one pass; false where the rows are not in the order of frames. */
static bool list_by_row(JoxReel *r) {
    sqlite3_stmt *rows = prepare(r->db, "SELECT rowid, frame FROM trajectory_data ORDER BY rowid");
    bool ordered = rows != NULL;
    int64_t row = 0;
    while (ordered && sqlite3_step(rows) == SQLITE_ROW) {
        int64_t frame = sqlite3_column_int64(rows, 1);
        row = sqlite3_column_int64(rows, 0);
        ordered = (r->frames == 0 || frame >= r->number[r->frames - 1]) && r->frames < MOST_FRAMES;
        if (ordered && (r->frames == 0 || frame > r->number[r->frames - 1]))
            add_frame(r, frame, row);
    }
    sqlite3_finalize(rows);
    if (r->frames)
        r->from[r->frames] = row + 1;
    if (!ordered)
        r->frames = 0;
    return ordered && r->frames > 0;
}

/* ---- opening ---- */

static void read_states(JoxReel *r) {
    sqlite3_stmt *list =
        prepare(r->db, "SELECT number, machine, state FROM jostle_state ORDER BY number");
    size_t capacity = 0;
    while (list && r->state_count < UINT16_MAX && sqlite3_step(list) == SQLITE_ROW) {
        const char *machine = (const char *)sqlite3_column_text(list, 1);
        const char *name = (const char *)sqlite3_column_text(list, 2);
        JOX_RESERVE(r->states, capacity, r->state_count + 1);
        r->states[r->state_count++] =
            (struct JoxReelState){jox_strdup(machine ? machine : ""), jox_strdup(name ? name : ""),
                                  sqlite3_column_int64(list, 0)};
    }
    sqlite3_finalize(list);
}

/* The columns that there are: of ours; of JuPedSim; of whoever writes no more than places. */
static bool prepare_rows(JoxReel *r) {
    static const char *const WAYS[] = {"WHERE d.frame = ?1 ORDER BY d.id",
                                       "WHERE d.rowid >= ?2 AND d.rowid < ?3 ORDER BY d.id"};
    static const char *const COLUMNS[] = {
        "SELECT d.id, d.pos_x, d.pos_y, d.ori_x, d.ori_y, a.state, a.force, a.compression, a.member"
        " FROM trajectory_data d LEFT JOIN jostle_agent a ON a.rowid = d.rowid AND a.id = d.id"
        " AND a.frame = d.frame",
        "SELECT d.id, d.pos_x, d.pos_y, d.ori_x, d.ori_y FROM trajectory_data d",
        "SELECT d.id, d.pos_x, d.pos_y FROM trajectory_data d"};
    for (int c = 0; c < 3 && !r->rows; c++) {
        JoxText sql = {0};
        jox_text_printf(&sql, "%s %s", COLUMNS[c], WAYS[r->way]);
        r->rows = prepare(r->db, sql.data);
        r->ours = c == 0;
        r->facing = c < 2;
        jox_text_free(&sql);
    }
    double last;
    if (ask(r->db, "SELECT MAX(rowid) FROM jostle_body", &last)) {
        r->last_body = (int64_t)last;
        r->body_at = prepare(r->db, "SELECT frame FROM jostle_body WHERE rowid = ?");
        r->bodies = prepare(r->db, "SELECT frame, id, x, y, z, qx, qy, qz, qw FROM jostle_body "
                                   "WHERE rowid >= ? ORDER BY rowid");
    }
    r->part = prepare(r->db, "SELECT kind, size_x, size_y, size_z, x, y, z, qx, qy, qz, qw, corners"
                             " FROM jostle_part WHERE id = ?1 AND part = ?3 AND frame = (SELECT "
                             "MAX(frame) FROM jostle_part WHERE id = ?1 AND frame <= ?2)");
    sqlite3_stmt *list = prepare(r->db, "SELECT DISTINCT frame FROM jostle_part ORDER BY frame");
    while (list && sqlite3_step(list) == SQLITE_ROW) {
        JOX_RESERVE(r->changes, r->change_capacity, r->change_count + 1);
        r->changes[r->change_count++] = sqlite3_column_int64(list, 0);
    }
    sqlite3_finalize(list);
    return r->rows != NULL;
}

static void read_bounds(JoxReel *r) {
    static const char *const KEYS[] = {"xmin", "ymin", "xmax", "ymax"};
    double bounds[4];
    r->bounded = true;
    for (int k = 0; k < 4; k++) {
        JoxText sql = {0};
        jox_text_printf(&sql, "SELECT CAST(value AS REAL) FROM metadata WHERE key = '%s'", KEYS[k]);
        r->bounded &= ask(r->db, sql.data, &bounds[k]) && fabs(bounds[k]) < 1e6;
        jox_text_free(&sql);
    }
    r->bounded = r->bounded && bounds[0] <= bounds[2] && bounds[1] <= bounds[3];
    if (r->bounded) {
        r->low = (JoxV2){(float)bounds[0], (float)bounds[1]};
        r->high = (JoxV2){(float)bounds[2], (float)bounds[3]};
    }
}

/* False with an error; *whole: the rows are in no order, so that all must be read. */
static bool open_sqlite(JoxReel *r, const char *path, const JoxTrajectoryOptions *options,
                        bool *whole, JoxDiagnostics *diagnostics) {
    static const char *const HINT = "It must be of the JuPedSim format: a table trajectory_data";
    double found;
    if (sqlite3_open_v2(path, &r->db, SQLITE_OPEN_READONLY, NULL) != SQLITE_OK)
        return wrong(diagnostics, path, NULL, sqlite3_errmsg(r->db));
    sqlite3_stmt *probe = prepare(r->db, "SELECT frame, id, pos_x, pos_y FROM trajectory_data "
                                         "LIMIT 1");
    const int status = probe ? sqlite3_step(probe) : SQLITE_ERROR;
    if (!probe || (status != SQLITE_ROW && status != SQLITE_DONE))
        wrong(diagnostics, path, HINT, sqlite3_errmsg(r->db));
    else if (status == SQLITE_DONE)
        wrong(diagnostics, path, NULL, "nobody is in this recording");
    sqlite3_finalize(probe);
    if (status != SQLITE_ROW)
        return false;
    bool indexed = ask(r->db,
                       "SELECT 1 FROM pragma_index_list('trajectory_data') l, "
                       "pragma_index_info(l.name) i WHERE i.seqno = 0 AND i.name = 'frame'",
                       &found);
    r->way = indexed ? BY_INDEX : BY_ROW;
    if (!(indexed ? list_by_index(r) : list_by_row(r))) {
        *whole = true;
        return true;
    }
    r->fps = options->fps;
    if (r->fps <= 0.0 &&
        !ask(r->db, "SELECT CAST(value AS REAL) FROM metadata WHERE key = 'fps'", &r->fps))
        r->fps = 0.0;
    if (!(r->fps > 0.0 && r->fps <= 1e5))
        return wrong(diagnostics, path, "--fps 25",
                     "this recording does not say how many frames a second it has");
    if (!prepare_rows(r))
        return wrong(diagnostics, path, HINT, sqlite3_errmsg(r->db));
    for (uint32_t f = 0; f < r->frames; f++)
        if (!(fabs((double)r->number[f]) / r->fps <= 1e9))
            return wrong(diagnostics, path, "Are id and frame exchanged?",
                         "a frame is more than 30 years from the first");
    read_bounds(r);
    read_states(r);
    jox_trajectories_plan(&r->outlines, r->db);
    return true;
}

static bool open_whole(JoxReel *r, const char *path, const JoxTrajectoryOptions *options,
                       JoxDiagnostics *diagnostics) {
    r->way = WHOLE;
    r->all = jox_trajectories_read(path, options, diagnostics);
    if (!r->all)
        return false;
    r->fps = r->all->fps;
    r->frames = r->all->frame_count;
    r->bounded = true;
    r->low = r->all->low;
    r->high = r->all->high;
    return true;
}

JoxReel *jox_reel_open(const char *path, const JoxTrajectoryOptions *options,
                       JoxDiagnostics *diagnostics) {
    JoxReel *r = jox_alloc(1, sizeof *r);
    bool whole = !jox_is_sqlite(path), good = true;
    if (!whole)
        good = open_sqlite(r, path, options, &whole, diagnostics);
    if (good && whole)
        good = open_whole(r, path, options, diagnostics);
    if (good)
        return r;
    jox_reel_close(r);
    return NULL;
}

JoxReelInfo jox_reel_info(const JoxReel *r) {
    const JoxTrajectories *t = r->all ? r->all : &r->outlines;
    return (JoxReelInfo){.fps = r->fps,
                         .frames = r->frames,
                         .bounded = r->bounded,
                         .low = r->low,
                         .high = r->high,
                         .walls = &t->walls,
                         .groups = (const char *const *)t->groups,
                         .group_count = t->group_count,
                         .states = r->states,
                         .state_count = r->state_count,
                         .whole = r->all != NULL,
                         .has_force = r->all ? r->all->force != NULL : r->ours,
                         .has_bodies = r->bodies != NULL};
}

double jox_reel_time(const JoxReel *r, uint32_t frame) {
    return (double)(r->all ? r->all->number[r->all->first[frame]] : r->number[frame]) / r->fps;
}

uint32_t jox_reel_find(const JoxReel *r, double time) {
    uint32_t low = 0, high = r->frames; /* the frames below `low` are not later */
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (jox_reel_time(r, middle) <= time + 1e-9)
            low = middle + 1;
        else
            high = middle;
    }
    return low ? low - 1 : 0;
}

/* ---- frames ---- */

static bool damaged(JoxText *why, const char *format, const char *what) {
    jox_text_printf(why, format, what);
    return false;
}

static void widen(JoxReel *r, size_t need) {
    if (need <= r->capacity)
        return;
    r->capacity = need + need / 2 + 64;
    r->id = jox_realloc(r->id, r->capacity, sizeof *r->id);
    float **columns[] = {&r->x, &r->y, &r->face_x, &r->face_y, &r->force, &r->compression};
    for (int c = 0; c < 6; c++)
        *columns[c] = jox_realloc(*columns[c], r->capacity, sizeof(float));
    r->state = jox_realloc(r->state, r->capacity, sizeof *r->state);
    r->group = jox_realloc(r->group, r->capacity, sizeof *r->group);
}

static uint32_t state_row(const JoxReel *r, int64_t number) {
    uint32_t low = 0, high = r->state_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (r->states[middle].number < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low < r->state_count && r->states[low].number == number ? low : JOX_REEL_NO_STATE;
}

static void take_row(JoxReel *r, uint32_t n) {
    widen(r, (size_t)n + 1);
    r->id[n] = sqlite3_column_int64(r->rows, 0);
    r->x[n] = (float)sqlite3_column_double(r->rows, 1);
    r->y[n] = (float)sqlite3_column_double(r->rows, 2);
    if (r->facing) {
        r->face_x[n] = (float)sqlite3_column_double(r->rows, 3);
        r->face_y[n] = (float)sqlite3_column_double(r->rows, 4);
    }
    if (!r->ours)
        return;
    const bool known = sqlite3_column_type(r->rows, 5) != SQLITE_NULL;
    r->state[n] = known ? state_row(r, sqlite3_column_int64(r->rows, 5)) : JOX_REEL_NO_STATE;
    r->force[n] = (float)sqlite3_column_double(r->rows, 6);
    r->compression[n] = (float)sqlite3_column_double(r->rows, 7);
    r->group[n] = (uint16_t)sqlite3_column_int64(r->rows, 8);
}

static bool read_people(JoxReel *r, uint32_t frame, JoxReelFrame *out, JoxText *why) {
    uint32_t n = 0;
    int status;
    sqlite3_reset(r->rows);
    sqlite3_bind_int64(r->rows, 1, r->number[frame]);
    sqlite3_bind_int64(r->rows, 2, r->from[frame]);
    sqlite3_bind_int64(r->rows, 3, r->from[frame + 1]);
    while ((status = sqlite3_step(r->rows)) == SQLITE_ROW) {
        take_row(r, n);
        if (!(fabsf(r->x[n]) < 1e6f && fabsf(r->y[n]) < 1e6f))
            return damaged(why, "%s is more than 1000 km from the origin", "somebody");
        if (n > 0 && r->id[n] == r->id[n - 1])
            return damaged(why, "%s is in a frame twice", "somebody");
        n++;
    }
    if (status != SQLITE_DONE)
        return damaged(why, "the recording cannot be read: %s", sqlite3_errmsg(r->db));
    out->count = n;
    out->id = r->id;
    out->x = r->x;
    out->y = r->y;
    out->face_x = r->facing ? r->face_x : NULL;
    out->face_y = r->facing ? r->face_y : NULL;
    out->state = r->ours && r->state_count ? r->state : NULL;
    out->force = r->ours ? r->force : NULL;
    out->compression = r->ours ? r->compression : NULL;
    out->group = r->ours ? r->group : NULL;
    return true;
}

/* First row of the bodies of a frame: they were written frame by frame, without an index. */
static int64_t first_body(JoxReel *r, int64_t number) {
    int64_t low = 1, high = r->last_body + 1;
    while (low < high) {
        int64_t middle = low + (high - low) / 2;
        sqlite3_reset(r->body_at);
        sqlite3_bind_int64(r->body_at, 1, middle);
        if (sqlite3_step(r->body_at) == SQLITE_ROW && sqlite3_column_int64(r->body_at, 0) < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static bool read_bodies(JoxReel *r, uint32_t frame, JoxReelFrame *out, JoxText *why) {
    if (!r->bodies || !r->body_at)
        return true;
    uint32_t n = 0;
    int status;
    const int64_t number = r->number[frame], first = first_body(r, number);
    sqlite3_reset(r->bodies);
    sqlite3_bind_int64(r->bodies, 1, first);
    while ((status = sqlite3_step(r->bodies)) == SQLITE_ROW &&
           sqlite3_column_int64(r->bodies, 0) == number) {
        float values[7];
        for (int k = 0; k < 7; k++)
            values[k] = (float)sqlite3_column_double(r->bodies, 2 + k);
        JOX_RESERVE(r->body, r->body_capacity, n + 1);
        JoxRecordBody *body = &r->body[n];
        *body = (JoxRecordBody){(uint32_t)sqlite3_column_int64(r->bodies, 1),
                                values[0],
                                values[1],
                                values[2],
                                values[3],
                                values[4],
                                values[5],
                                values[6]};
        for (int k = 0; k < 7; k++)
            if (!isfinite(values[k]))
                return damaged(why, "%s is nowhere", "a body");
        n++;
    }
    if (status != SQLITE_ROW && status != SQLITE_DONE)
        return damaged(why, "the recording cannot be read: %s", sqlite3_errmsg(r->db));
    out->body_count = n;
    out->bodies = r->body;
    return true;
}

static bool read_whole(JoxReel *r, uint32_t frame, JoxReelFrame *out) {
    JoxFrame all;
    jox_trajectories_frame(r->all, frame, &all);
    widen(r, all.count);
    for (uint32_t i = 0; i < all.count; i++)
        r->id[i] = all.key[i];
    out->count = all.count;
    out->id = r->id;
    out->x = all.x;
    out->y = all.y;
    out->face_x = all.vx; /* people look where they go */
    out->face_y = all.vy;
    out->force = all.force;
    out->compression = all.compression;
    out->group = all.group;
    return true;
}

bool jox_reel_read(JoxReel *r, uint32_t frame, JoxReelFrame *out, JoxText *why) {
    *out = (JoxReelFrame){.time = jox_reel_time(r, frame)};
    if (r->all)
        return read_whole(r, frame, out);
    return read_people(r, frame, out, why) && read_bodies(r, frame, out, why);
}

/* ---- shapes ---- */

uint32_t jox_reel_changes(const JoxReel *r, uint32_t frame) {
    uint32_t count = 0;
    while (count < r->change_count && r->changes[count] <= r->number[frame])
        count++;
    return count;
}

/* "x y z, x y z, ..." */
static void read_corners(JoxReel *r, const char *text, JoxBodyLook *out) {
    uint32_t count = 0;
    for (int more = 1; text && more && count < 256;) {
        float at[3] = {0};
        int used = 0;
        if (sscanf(text, "%f %f %f%n", &at[0], &at[1], &at[2], &used) != 3)
            break;
        JOX_RESERVE(r->corners, r->corner_capacity, count + 1);
        r->corners[count++] = (JoxV3){at[0], at[1], at[2]};
        text += used;
        more = *text++ == ',';
    }
    out->corners = r->corners;
    out->corner_count = count;
}

bool jox_reel_part(JoxReel *r, uint32_t frame, uint32_t body, uint32_t part, JoxBodyLook *out) {
    *out = (JoxBodyLook){0};
    if (!r->part)
        return false;
    sqlite3_reset(r->part);
    sqlite3_bind_int64(r->part, 1, body);
    sqlite3_bind_int64(r->part, 2, r->number[frame]);
    sqlite3_bind_int64(r->part, 3, part);
    if (sqlite3_step(r->part) != SQLITE_ROW)
        return false;
    float numbers[10];
    bool finite = true;
    for (int k = 0; k < 10; k++) {
        numbers[k] = (float)sqlite3_column_double(r->part, 1 + k);
        finite &= isfinite(numbers[k]);
    }
    const int kind = sqlite3_column_int(r->part, 0);
    if (!finite || kind < JOX_SHAPE_BOX || kind > JOX_SHAPE_HULL)
        return false;
    out->kind = (JoxShapeKind)kind;
    memcpy(out->size, numbers, sizeof out->size);
    out->at = (JoxV3){numbers[3], numbers[4], numbers[5]};
    memcpy(out->turn, numbers + 6, sizeof out->turn);
    if (kind == JOX_SHAPE_HULL)
        read_corners(r, (const char *)sqlite3_column_text(r->part, 11), out);
    return true;
}

void jox_reel_close(JoxReel *r) {
    if (!r)
        return;
    sqlite3_finalize(r->part);
    sqlite3_finalize(r->rows);
    sqlite3_finalize(r->body_at);
    sqlite3_finalize(r->bodies);
    sqlite3_close(r->db);
    jox_trajectories_free(r->all);
    for (uint32_t g = 0; g < r->outlines.group_count; g++)
        jox_free(r->outlines.groups[g]);
    jox_free(r->outlines.groups);
    jox_walls_free(&r->outlines.walls);
    for (uint32_t s = 0; s < r->state_count; s++) {
        jox_free(r->states[s].machine);
        jox_free(r->states[s].name);
    }
    jox_free(r->states);
    void *columns[] = {r->number, r->from,   r->id,      r->x,           r->y,
                       r->face_x, r->face_y, r->force,   r->compression, r->state,
                       r->group,  r->body,   r->changes, r->corners};
    for (size_t c = 0; c < sizeof columns / sizeof *columns; c++)
        jox_free(columns[c]);
    jox_free(r);
}
