#include "record/recorder.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/mem.h"
#include "record/recorder_parts.h"
#include "record/recorder_schema.h"
#include "task/thread.h"

enum { COLUMNS = 16, STOREY_COLUMNS = 18, BATCH = 50 }; /* BATCH: rows of one statement */
static const double COMMITTED = 1.0; /* s: frames are committed at least this often */

static bool execute_sql(JoxRecorder *r, const char *sql) {
    char *why = NULL;
    if (sqlite3_exec(r->db->sqlite, sql, NULL, NULL, &why) == SQLITE_OK)
        return true;
    snprintf(r->why, sizeof r->why, "%s", why ? why : sqlite3_errmsg(r->db->sqlite));
    sqlite3_free(why);
    return false;
}

bool jox_recorder_prepare(JoxRecorder *r, sqlite3_stmt **statement, const char *sql) {
    *statement = jox_database_prepare(r->db, sql);
    if (*statement)
        return true;
    snprintf(r->why, sizeof r->why, "%s", sqlite3_errmsg(r->db->sqlite));
    return false;
}

bool jox_recorder_execute(JoxRecorder *r, sqlite3_stmt *statement) {
    bool good = sqlite3_step(statement) == SQLITE_DONE;
    if (!good)
        snprintf(r->why, sizeof r->why, "%s", sqlite3_errmsg(r->db->sqlite));
    sqlite3_reset(statement);
    return good;
}

bool jox_recorder_set_metadata(JoxRecorder *r, const char *key, const char *value) {
    sqlite3_stmt *statement;
    if (!jox_recorder_prepare(r, &statement,
                              "INSERT OR REPLACE INTO metadata(key, value) VALUES(?, ?)"))
        return false;
    sqlite3_bind_text(statement, 1, key, -1, SQLITE_STATIC);
    sqlite3_bind_text(statement, 2, value, -1, SQLITE_STATIC);
    bool good = jox_recorder_execute(r, statement);
    jox_database_finalize(r->db, statement);
    return good;
}

static bool set_number(JoxRecorder *r, const char *key, double value) {
    char text[32];
    snprintf(text, sizeof text, "%.9g", isfinite(value) ? value : 0.0);
    return jox_recorder_set_metadata(r, key, text);
}

static bool write_bounds(JoxRecorder *r) {
    return set_number(r, "xmin", r->low_x) && set_number(r, "xmax", r->high_x) &&
           set_number(r, "ymin", r->low_y) && set_number(r, "ymax", r->high_y);
}

static const double PLACE_PARTS = 1e4; /* units of recorded positions in a metre */

/* Returns a position, m, rounded as a reader will get it; NAN stays NAN. */
static double round_as_recorded(float place) {
    return isfinite(place) ? (double)llround((double)place * PLACE_PARTS) / PLACE_PARTS
                           : (double)NAN;
}

/* Binds value * parts as an integer. NAN becomes NULL, which the table takes of torsos alone. */
static void bind_parts(sqlite3_stmt *to, int at, float value, double parts) {
    if (isfinite(value))
        sqlite3_bind_int64(to, at, llround((double)value * parts));
    else
        sqlite3_bind_null(to, at);
}

/* Binds the storey of a position on a sheet, and 1 + its stair or 0. */
static void bind_storey(const JoxStoreys *storeys, sqlite3_stmt *to, int first, JoxV2 at) {
    sqlite3_bind_int64(to, first, jox_storey_at(storeys, at));
    sqlite3_bind_int64(to, first + 1, jox_stair_at(storeys, at) + 1);
}

static void bind_row(const JoxRecorder *r, sqlite3_stmt *to, int first, uint32_t frame,
                     const JoxRecordRow *row) {
    const JoxV2 at = {row->x, row->y}, plan = jox_in_plan(&r->storeys, at);
    const float numbers[] = {plan.x,     plan.y,           row->ori_x, row->ori_y,
                             row->force, row->compression, row->load,  row->radius,
                             row->chest, row->breadth,     row->depth, row->fallen};
    const double parts[] = {PLACE_PARTS, PLACE_PARTS, 1e3, 1e3,         10.0,        10.0,
                            10.0,        PLACE_PARTS, 1e3, PLACE_PARTS, PLACE_PARTS, 10.0};
    sqlite3_bind_int64(to, first, frame);
    sqlite3_bind_int64(to, first + 1, row->id);
    for (int k = 0; k < 12; k++) /* state and group stand between load and radius */
        bind_parts(to, first + 2 + k + (k < 7 ? 0 : 2), numbers[k], parts[k]);
    sqlite3_bind_int64(to, first + 9, row->state);
    sqlite3_bind_int64(to, first + 10, row->group);
    if (r->columns == STOREY_COLUMNS)
        bind_storey(&r->storeys, to, first + COLUMNS, at);
}

static bool write_rows(JoxRecorder *r, const JoxRecorderFrame *f) {
    for (uint32_t i = 0; i < f->row_count;) {
        const uint32_t count = f->row_count - i >= BATCH ? BATCH : 1;
        sqlite3_stmt *const to = count == BATCH ? r->batch : r->row;
        for (uint32_t k = 0; k < count; k++, i++) {
            const JoxRecordRow *row = &f->rows[i];
            const JoxV2 plan = jox_in_plan(&r->storeys, (JoxV2){row->x, row->y});
            bind_row(r, to, 1 + (int)k * r->columns, f->number, row);
            const double x = round_as_recorded(plan.x), y = round_as_recorded(plan.y);
            r->low_x = fmin(r->low_x, x), r->high_x = fmax(r->high_x, x);
            r->low_y = fmin(r->low_y, y), r->high_y = fmax(r->high_y, y);
        }
        if (!jox_recorder_execute(r, to))
            return false;
    }
    return true;
}

/* Returns false with the reason in `why` if the file was removed or replaced: nobody could read
   what is written to it from then on. */
static bool check_file_name(JoxRecorder *r) {
    const bool good = jox_recording_has_name(r->claimed, r->db);
    if (!good)
        snprintf(r->why, sizeof r->why, "the file was removed or replaced while it was written");
    return good;
}

static bool commit_frames(JoxRecorder *r) {
    r->committed = jox_clock_wall();
    return write_bounds(r) && execute_sql(r, "COMMIT") && check_file_name(r);
}

/* Writes the cars of a frame. */
static bool write_cars(JoxRecorder *r, const JoxRecorderFrame *f) {
    bool good = true;
    for (uint32_t k = 0; good && k < f->car_count; k++) {
        const JoxRecordCar *car = &f->cars[k];
        sqlite3_bind_int64(r->car, 1, f->number);
        sqlite3_bind_int64(r->car, 2, car->lift);
        sqlite3_bind_double(r->car, 3, round((double)car->look.height * 1e3) / 1e3);
        sqlite3_bind_double(r->car, 4, round((double)car->look.open * 1e3) / 1e3);
        sqlite3_bind_int64(r->car, 5, car->storey);
        sqlite3_bind_int64(r->car, 6, car->look.people);
        sqlite3_bind_text(r->car, 7, jox_lift_mode_names[car->look.mode], -1, SQLITE_STATIC);
        good = jox_recorder_execute(r, r->car);
    }
    return good;
}

static bool write_frame(JoxRecorder *r, const JoxRecorderFrame *f) {
    if (sqlite3_get_autocommit(r->db->sqlite) && !execute_sql(r, "BEGIN"))
        return false;
    sqlite3_bind_int64(r->frame, 1, f->number);
    sqlite3_bind_int64(r->frame, 2, (sqlite3_int64)r->geometry);
    if (!jox_recorder_execute(r, r->frame) || !write_rows(r, f))
        return false;
    for (uint32_t i = 0; i < f->body_count; i++) {
        const JoxRecordBody *b = &f->bodies[i];
        const JoxV2 at = {b->x, b->y}, plan = jox_in_plan(&r->storeys, at);
        const float numbers[] = {plan.x, plan.y, b->z, b->qx, b->qy, b->qz, b->qw};
        sqlite3_bind_int64(r->body, 1, f->number);
        sqlite3_bind_int64(r->body, 2, b->id);
        for (int k = 0; k < 7; k++)
            sqlite3_bind_double(r->body, 3 + k, numbers[k]);
        if (r->columns == STOREY_COLUMNS)
            bind_storey(&r->storeys, r->body, 10, at);
        if (!jox_recorder_execute(r, r->body))
            return false;
    }
    if (!write_cars(r, f))
        return false;
    return jox_clock_wall() - r->committed < COMMITTED || commit_frames(r);
}

/* Waits until there is a frame to write or the recorder ends. Commits written frames within
   COMMITTED seconds even if no frame follows: a run may pause, or be killed in a pause. */
static void wait_for_frames(JoxRecorder *r) {
    while (r->count == 0 && !r->ending) {
        if (r->failed || sqlite3_get_autocommit(r->db->sqlite)) {
            pthread_cond_wait(&r->filled, &r->lock);
            continue;
        }
        const double then = jox_clock_date() + COMMITTED;
        const struct timespec until = {(time_t)then, (long)((then - floor(then)) * 1e9)};
        if (pthread_cond_timedwait(&r->filled, &r->lock, &until) == ETIMEDOUT && r->count == 0 &&
            !r->borrowed &&
            !sqlite3_get_autocommit(r->db->sqlite)) /* the stepping thread may have committed */
            r->failed |= !commit_frames(r);
    }
}

static void *write_until_end(void *argument) {
    JoxRecorder *r = argument;
    pthread_mutex_lock(&r->lock);
    for (;;) {
        wait_for_frames(r);
        if (r->count == 0)
            break;
        const JoxRecorderFrame *frame = &r->frames[r->first];
        bool skip = r->failed;
        pthread_mutex_unlock(&r->lock);
        bool good = skip || write_frame(r, frame);
        pthread_mutex_lock(&r->lock);
        r->failed |= !good;
        r->first = (r->first + 1) % JOX_RECORDER_FRAMES;
        r->count--;
        pthread_cond_signal(&r->emptied);
    }
    pthread_mutex_unlock(&r->lock);
    return NULL;
}

static bool start_recording(JoxRecorder *r, double fps, const char *wkt) {
    sqlite3_stmt *geometry = NULL;
    const bool storeys = r->storeys.storey_count > 0;
    bool good = execute_sql(r, storeys ? jox_recording_storey_schema : jox_recording_schema) &&
                jox_recorder_set_metadata(r, "version", "2") && set_number(r, "fps", fps) &&
                write_bounds(r) &&
                jox_recorder_prepare(r, &geometry, "INSERT INTO geometry(hash, wkt) VALUES(?, ?)");
    if (good) {
        sqlite3_bind_int64(geometry, 1, (sqlite3_int64)r->geometry);
        sqlite3_bind_text(geometry, 2, wkt, -1, SQLITE_STATIC);
        good = jox_recorder_execute(r, geometry);
    }
    jox_database_finalize(r->db, geometry);
    return good && execute_sql(r, "COMMIT");
}

/* Deletes everything recorded after frame `last`, and reads the bounds of the rest. */
static bool resume_recording(JoxRecorder *r, uint32_t last) {
    static const char *const TABLES[] = {"jostle_row",  "jostle_body", "jostle_part",
                                         "jostle_wall", "frame_data",  "jostle_car"};
    static const char *const BOUNDS[] = {"MIN(pos_x)", "MAX(pos_x)", "MIN(pos_y)", "MAX(pos_y)"};
    double *const to[] = {&r->low_x, &r->high_x, &r->low_y, &r->high_y};
    char sql[400];
    bool good = execute_sql(r, "PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL; BEGIN");
    /* the last table is one of recordings with storeys */
    const size_t tables = sizeof TABLES / sizeof *TABLES - (r->storeys.storey_count ? 0 : 1);
    for (size_t t = 0; good && t < tables; t++) {
        snprintf(sql, sizeof sql, "DELETE FROM %s WHERE frame > %u", TABLES[t], last);
        good = execute_sql(r, sql);
    }
    for (int k = 0; good && k < 4; k++) {
        sqlite3_stmt *bound = NULL;
        snprintf(sql, sizeof sql, "SELECT %s FROM (" JOX_RECORDED_ROWS ")", BOUNDS[k]);
        good = jox_recorder_prepare(r, &bound, sql);
        if (good && sqlite3_step(bound) == SQLITE_ROW &&
            sqlite3_column_type(bound, 0) != SQLITE_NULL)
            *to[k] = sqlite3_column_double(bound, 0);
        jox_database_finalize(r->db, bound);
    }
    return good && execute_sql(r, "COMMIT");
}

static bool prepare_inserts(JoxRecorder *r) {
    static const char INSERT[] = "INSERT INTO jostle_row VALUES";
    static const char ROW[] = "(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?),";
    static const char STOREY_ROW[] = "(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?),";
    const bool storeys = r->storeys.storey_count > 0;
    const char *row = storeys ? STOREY_ROW : ROW;
    char one[sizeof INSERT + sizeof STOREY_ROW], batch[sizeof INSERT + BATCH * sizeof STOREY_ROW];
    char *end = stpcpy(batch, INSERT);
    r->columns = storeys ? STOREY_COLUMNS : COLUMNS;
    for (int k = 0; k < BATCH; k++)
        end = stpcpy(end, row);
    end[-1] = '\0'; /* drop the last comma */
    snprintf(one, sizeof one, "%s%.*s", INSERT, (int)strlen(row) - 1, row);
    return jox_recorder_prepare(r, &r->batch, batch) && jox_recorder_prepare(r, &r->row, one) &&
           jox_recorder_prepare(
               r, &r->body,
               storeys ? "INSERT INTO jostle_body VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"
                       : "INSERT INTO jostle_body VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)") &&
           jox_recorder_prepare(r, &r->frame, "INSERT INTO frame_data VALUES(?, ?)") &&
           (!storeys ||
            jox_recorder_prepare(r, &r->car, "INSERT INTO jostle_car VALUES(?, ?, ?, ?, ?, ?, ?)"));
}

static void free_recorder(JoxRecorder *r) {
    jox_database_close(r->db);
    /* The file last: closing it earlier would release the locks of the database. */
    if (r->claimed)
        jox_file_close(r->claimed);
    for (int i = 0; i < JOX_RECORDER_FRAMES; i++) {
        jox_free(r->frames[i].rows);
        jox_free(r->frames[i].bodies);
        jox_free(r->frames[i].cars);
    }
    jox_storeys_free(&r->storeys);
    pthread_mutex_destroy(&r->lock);
    pthread_cond_destroy(&r->filled);
    pthread_cond_destroy(&r->emptied);
    jox_free(r);
}

/* Ends the writer thread. It writes the frames submitted before, uncommitted. */
static void stop_writer(JoxRecorder *r) {
    pthread_mutex_lock(&r->lock);
    r->ending = true;
    pthread_cond_signal(&r->filled);
    pthread_mutex_unlock(&r->lock);
    pthread_join(r->thread, NULL);
}

static void abandon_recorder(void *recorder) {
    stop_writer(recorder);
    free_recorder(recorder);
}

/* Creates a recorder on a claimed file. With `wkt` it starts a new recording; with NULL it
   continues the one in the file after frame `last`. */
static JoxRecorder *create_recorder(const char *path, FILE *file, double fps, const char *wkt,
                                    uint32_t last, const JoxStoreys *storeys, JoxText *error) {
    JoxRecorder *r = jox_alloc(1, sizeof *r);
    if (storeys && storeys->storey_count)
        jox_storeys_copy(&r->storeys, storeys);
    pthread_mutex_init(&r->lock, NULL);
    pthread_cond_init(&r->filled, NULL);
    pthread_cond_init(&r->emptied, NULL);
    r->low_x = r->low_y = INFINITY;
    r->high_x = r->high_y = -INFINITY;
    r->geometry = 1;
    r->committed = jox_clock_wall();
    r->claimed = file;
    /* One thread at a time uses it: the writer, or another while the writer is idle. */
    JoxText why = {0};
    r->db = jox_database_open(path, JOX_DATABASE_WRITE, &why);
    bool good = r->db && jox_database_allow(r->db, jox_recording_tables, &why);
    if (!good)
        snprintf(r->why, sizeof r->why, "%s", why.data);
    jox_text_free(&why);
    good = good && (wkt ? start_recording(r, fps, wkt) : resume_recording(r, last)) &&
           prepare_inserts(r);
    if (good && !jox_thread_start(&r->thread, write_until_end, r)) {
        good = false;
        snprintf(r->why, sizeof r->why, "no thread can be started");
    }
    if (good)
        return jox_heap_register(r, abandon_recorder);
    jox_text_printf(error, "cannot record to '%s': %s", path, r->why);
    if (wkt) /* the file has no schema yet, so the next run would refuse to replace it */
        jox_recording_remove(path);
    free_recorder(r);
    return NULL;
}

JoxRecorder *jox_recorder_open(const char *path, double fps, const char *wkt,
                               const JoxStoreys *storeys, JoxText *error) {
    FILE *file = jox_recording_claim(path, error);
    return file ? create_recorder(path, file, fps, wkt, 0, storeys, error) : NULL;
}

JoxRecorder *jox_recorder_continue(const char *path, uint32_t last, const JoxStoreys *storeys,
                                   JoxText *error) {
    struct stat info;
    const bool ours = lstat(path, &info) == 0 && S_ISREG(info.st_mode) && jox_is_recording(path);
    FILE *file = ours ? jox_file_open(path, "a") : NULL;
    if (file)
        return create_recorder(path, file, 0.0, NULL, last, storeys, error);
    jox_text_printf(error, "cannot continue the recording '%s': %s", path,
                    ours ? jox_file_error_text(errno) : "there is no recording of Jostle's");
    return NULL;
}

void jox_recorder_borrow(JoxRecorder *r) {
    pthread_mutex_lock(&r->lock);
    while (r->count > 0)
        pthread_cond_wait(&r->emptied, &r->lock);
    r->borrowed = true;
    pthread_mutex_unlock(&r->lock);
}

void jox_recorder_return(JoxRecorder *r) {
    pthread_mutex_lock(&r->lock);
    r->borrowed = false;
    pthread_mutex_unlock(&r->lock);
}

JoxRecordRow *jox_recorder_begin_frame(JoxRecorder *r, uint32_t rows, uint32_t bodies,
                                       JoxRecordBody **body_rows) {
    pthread_mutex_lock(&r->lock);
    while (r->count == JOX_RECORDER_FRAMES)
        pthread_cond_wait(&r->emptied, &r->lock);
    JoxRecorderFrame *f = &r->frames[(r->first + r->count) % JOX_RECORDER_FRAMES];
    pthread_mutex_unlock(&r->lock);
    JOX_RESERVE(f->rows, f->row_capacity, rows + 1);
    JOX_RESERVE(f->bodies, f->body_capacity, bodies + 1);
    f->row_count = rows;
    f->body_count = bodies;
    f->car_count = 0;
    *body_rows = f->bodies;
    return f->rows;
}

JoxRecordCar *jox_recorder_add_cars(JoxRecorder *r, uint32_t count) {
    pthread_mutex_lock(&r->lock);
    JoxRecorderFrame *f = &r->frames[(r->first + r->count) % JOX_RECORDER_FRAMES];
    pthread_mutex_unlock(&r->lock);
    JOX_RESERVE(f->cars, f->car_capacity, count + 1);
    f->car_count = count;
    return f->cars;
}

bool jox_recorder_submit_frame(JoxRecorder *r, uint32_t frame, JoxText *error) {
    pthread_mutex_lock(&r->lock);
    r->frames[(r->first + r->count) % JOX_RECORDER_FRAMES].number = frame;
    r->count++;
    bool good = !r->failed;
    pthread_cond_signal(&r->filled);
    pthread_mutex_unlock(&r->lock);
    if (!good)
        jox_text_printf(error, "recording failed: %s", r->why);
    return good;
}

bool jox_recorder_commit(JoxRecorder *r, JoxText *error) {
    jox_recorder_borrow(r);
    const bool good = !r->failed && (sqlite3_get_autocommit(r->db->sqlite) || commit_frames(r));
    jox_recorder_return(r);
    if (!good)
        jox_text_printf(error, "recording failed: %s", r->why);
    return good;
}

bool jox_recorder_close(JoxRecorder *r, JoxText *message) {
    jox_heap_unregister(r);
    stop_writer(r);
    bool good = !r->failed && write_bounds(r);
    if (good && !sqlite3_get_autocommit(r->db->sqlite))
        good = execute_sql(r, "COMMIT");
    good = good && check_file_name(r);
    if (good && !jox_recording_merge_log(r->db, message)) {
        snprintf(r->why, sizeof r->why, "%s", sqlite3_errmsg(r->db->sqlite));
        good = false;
    }
    if (!good)
        jox_text_printf(message, "recording failed: %s", r->why);
    free_recorder(r);
    return good;
}
