/* Stores the results of a run as rows of a sweep's file, in one transaction. */
#include <math.h>
#include <string.h>

#include "base/format/json.h"
#include "base/format/piece_file.h"
#include "base/guard.h"
#include "record/aggregate.h"
#include "sweep/store.h"

typedef struct RunWriter {
    const JoxSweepStore *store;
    int64_t variant;
    uint64_t seed;
    JoError *error;
    sqlite3_stmt *figure;
    bool good;
} RunWriter;

static void bind_run(sqlite3_stmt *s, const RunWriter *p) {
    sqlite3_bind_int64(s, 1, p->variant);
    sqlite3_bind_int64(s, 2, (sqlite3_int64)p->seed);
}

/* Binds a number; NULL if it is not finite. */
static void bind_number(sqlite3_stmt *s, int at, double value) {
    if (isfinite(value))
        sqlite3_bind_double(s, at, value);
    else
        sqlite3_bind_null(s, at);
}

/* Steps an INSERT and resets it for the next row. */
static bool step_insert(RunWriter *p, sqlite3_stmt *s) {
    p->good =
        p->good && (sqlite3_step(s) == SQLITE_DONE || jox_sweep_set_error(p->store, p->error));
    sqlite3_reset(s);
    return p->good;
}

/* Inserts a figure of a summary; called for each item of its JSON. */
static bool insert_figure(void *context, const JoxJsonItem *item) {
    RunWriter *p = context;
    if ((item->kind != JOX_JSON_NUMBER && item->kind != JOX_JSON_NULL) ||
        jox_summary_kind(item->path) != JOX_SUMMARY_FIGURE)
        return true;
    sqlite3_bind_text(p->figure, 3, item->path, -1, SQLITE_TRANSIENT);
    bind_number(p->figure, 4, item->kind == JOX_JSON_NUMBER ? item->number : NAN);
    return step_insert(p, p->figure);
}

static bool insert_figures(RunWriter *p, const char *summary) {
    p->figure =
        jox_sweep_prepare(p->store, "INSERT OR REPLACE INTO figure VALUES(?, ?, ?, ?)", p->error);
    if (!p->figure)
        return false;
    bind_run(p->figure, p);
    if (!jox_json_read(summary, jox_json_own_files, insert_figure, p) && p->good) {
        jox_error(p->error, JO_FAILED, "the figures of a run cannot be read");
        p->good = false;
    }
    jox_sweep_finalize(p->store, p->figure);
    return p->good;
}

/* Finds the id of a curve's name, and adds the name if it is missing. */
static bool find_curve_id(RunWriter *p, const JoxSweepCurve *curve, int64_t *id) {
    sqlite3_stmt *s = jox_sweep_prepare(
        p->store, "INSERT INTO curve_name(name, unit) VALUES(?, ?) ON CONFLICT DO NOTHING",
        p->error);
    if (s) {
        sqlite3_bind_text(s, 1, curve->name, -1, SQLITE_STATIC);
        sqlite3_bind_text(s, 2, curve->unit, -1, SQLITE_STATIC);
    }
    if (!jox_sweep_step_once(p->store, s, p->error) ||
        !(s = jox_sweep_prepare(p->store, "SELECT id FROM curve_name WHERE name = ?", p->error)))
        return false;
    sqlite3_bind_text(s, 1, curve->name, -1, SQLITE_STATIC);
    const bool good = sqlite3_step(s) == SQLITE_ROW || jox_sweep_set_error(p->store, p->error);
    *id = good ? sqlite3_column_int64(s, 0) : 0;
    jox_sweep_finalize(p->store, s);
    return good;
}

static bool insert_curve(RunWriter *p, const JoxSweepCurve *curve) {
    int64_t id = 0;
    p->good = p->good && find_curve_id(p, curve, &id);
    sqlite3_stmt *s =
        p->good ? jox_sweep_prepare(p->store,
                                    "INSERT OR REPLACE INTO curve_point VALUES(?, ?, ?, ?, ?)",
                                    p->error)
                : NULL;
    if (!s)
        return p->good = false;
    bind_run(s, p);
    sqlite3_bind_int64(s, 3, id);
    for (size_t k = 0; k < curve->count && p->good; k++) {
        sqlite3_bind_double(s, 4, curve->points[2 * k]);
        bind_number(s, 5, curve->points[2 * k + 1]);
        step_insert(p, s);
    }
    jox_sweep_finalize(p->store, s);
    return p->good;
}

static bool insert_field(RunWriter *p, const JoxSweepField *field) {
    sqlite3_stmt *s = jox_sweep_prepare(
        p->store, "INSERT OR REPLACE INTO field VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", p->error);
    if (!s)
        return p->good = false;
    bind_run(s, p);
    sqlite3_bind_text(s, 3, field->name, -1, SQLITE_STATIC);
    sqlite3_bind_text(s, 4, field->unit, -1, SQLITE_STATIC);
    sqlite3_bind_double(s, 5, field->low_x);
    sqlite3_bind_double(s, 6, field->low_y);
    sqlite3_bind_double(s, 7, field->cell);
    sqlite3_bind_int64(s, 8, field->columns);
    sqlite3_bind_int64(s, 9, field->rows);
    sqlite3_bind_blob64(s, 10, field->values, sizeof(float) * field->columns * field->rows,
                        SQLITE_STATIC);
    return p->good = jox_sweep_step_once(p->store, s, p->error);
}

/* Stores the plan with the variant, unless the file has that of a run with a lower seed: which run
   ended first must not matter. */
static bool insert_plan(RunWriter *p, const char *plan) {
    sqlite3_stmt *s = jox_sweep_prepare(
        p->store,
        "UPDATE variant SET plan = ? WHERE id = ?2 AND (plan IS NULL OR NOT EXISTS("
        "SELECT 1 FROM run WHERE variant = ?2 AND seed < ?3 AND summary NOT NULL))",
        p->error);
    if (s) {
        sqlite3_bind_text(s, 1, plan, -1, SQLITE_STATIC);
        sqlite3_bind_int64(s, 2, p->variant);
        sqlite3_bind_int64(s, 3, (sqlite3_int64)p->seed);
    }
    return p->good = jox_sweep_step_once(p->store, s, p->error);
}

/* Tables whose rows belong to a run */
static const char *const TABLES[] = {"figure", "curve_point", "field", "run"};
enum { TABLE_COUNT = sizeof TABLES / sizeof *TABLES };

bool jox_sweep_keep_seeds(const JoxSweepStore *store, uint64_t first, uint32_t count,
                          JoError *error) {
    bool good = jox_sweep_execute(store, JOX_SWEEP_PLANNED "DELETE FROM planned", error);
    for (size_t t = 0; good && t < TABLE_COUNT; t++) {
        char text[100];
        snprintf(text, sizeof text, "DELETE FROM %s WHERE seed < ? OR seed >= ?", TABLES[t]);
        sqlite3_stmt *s = jox_sweep_prepare(store, text, error);
        if (s) {
            sqlite3_bind_int64(s, 1, (sqlite3_int64)first);
            sqlite3_bind_int64(s, 2, (sqlite3_int64)(first + count));
        }
        good = jox_sweep_step_once(store, s, error);
    }
    return good;
}

/* Deletes all rows of the run and inserts its row in `run`. */
static bool replace_run_row(RunWriter *p, const char *state, const char *reason,
                            const JoxSweepNumbers *numbers, const char *summary) {
    char text[100];
    for (size_t t = 0; t < TABLE_COUNT; t++) {
        snprintf(text, sizeof text, "DELETE FROM %s WHERE variant = ? AND seed = ?", TABLES[t]);
        sqlite3_stmt *s = jox_sweep_prepare(p->store, text, p->error);
        if (s)
            bind_run(s, p);
        if (!jox_sweep_step_once(p->store, s, p->error))
            return p->good = false;
    }
    sqlite3_stmt *s = jox_sweep_prepare(
        p->store, "INSERT OR REPLACE INTO run VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", p->error);
    if (!s)
        return p->good = false;
    bind_run(s, p);
    sqlite3_bind_text(s, 3, state, -1, SQLITE_STATIC);
    sqlite3_bind_text(s, 4, reason, -1, SQLITE_STATIC);
    if (numbers) {
        snprintf(text, sizeof text, "%016llx", (unsigned long long)numbers->hash);
        sqlite3_bind_text(s, 5, text, -1, SQLITE_STATIC);
        sqlite3_bind_int64(s, 6, (sqlite3_int64)numbers->steps);
        sqlite3_bind_double(s, 7, numbers->simulated_s);
        sqlite3_bind_double(s, 8, numbers->cpu_s);
        sqlite3_bind_double(s, 9, numbers->wall_s);
    }
    sqlite3_bind_text(s, 10, summary, -1, SQLITE_STATIC);
    return p->good = jox_sweep_step_once(p->store, s, p->error);
}

/* Inserts the rows of one piece; pieces of other kinds are ignored. */
static bool insert_piece(RunWriter *p, const JoxPiece *piece) {
    JoxSweepCurve curve;
    JoxSweepField field;
    if (!strcmp(piece->name, "plan"))
        return insert_plan(p, piece->data);
    if (!strcmp(piece->name, "curve") && jox_sweep_get_curve(piece->data, piece->length, &curve)) {
        insert_curve(p, &curve);
        jox_sweep_free_curve(&curve);
    }
    if (!strcmp(piece->name, "field") && jox_sweep_get_field(piece->data, piece->length, &field)) {
        insert_field(p, &field);
        jox_sweep_free_field(&field);
    }
    return p->good;
}

/* Replaces the rows of the run by those of its pieces. Without a valid "state" the run counts as
   failed. */
static bool insert_pieces(RunWriter *p, const JoxText *pieces) {
    uint32_t state = JOX_SWEEP_FAILED;
    JoxSweepNumbers numbers = {0};
    const char *reason = NULL, *summary = NULL;
    bool ended = false;
    JoxPiece piece;
    char why[200];
    for (size_t at = 0; jox_pieces_next(pieces, &at, &piece, why);) {
        if (!strcmp(piece.name, "state") && piece.length == sizeof state)
            memcpy(&state, piece.data, sizeof state);
        else if (!strcmp(piece.name, "numbers") && piece.length == sizeof numbers) {
            memcpy(&numbers, piece.data, sizeof numbers);
            ended = true;
        } else if (!strcmp(piece.name, "reason"))
            reason = piece.data;
        else if (!strcmp(piece.name, "summary"))
            summary = piece.data;
    }
    if (*why) {
        jox_error(p->error, JO_FAILED, "what a run left cannot be read: %s", why);
        return false;
    }
    state = state > JOX_SWEEP_FAILED ? JOX_SWEEP_FAILED : state;
    if (!replace_run_row(p, jox_sweep_states[state], reason, ended ? &numbers : NULL, summary) ||
        (summary && !insert_figures(p, summary)))
        return false;
    for (size_t at = 0; p->good && jox_pieces_next(pieces, &at, &piece, why);)
        insert_piece(p, &piece);
    return p->good;
}

/* Stores a run in one transaction: its pieces, or if these are NULL only that it failed and why. */
static bool store_run(RunWriter *p, const JoxText *pieces, const char *failure) {
    JoError ignored;
    p->good = jox_sweep_execute(p->store, "BEGIN IMMEDIATE", p->error);
    if (!p->good)
        return false;
    const bool good =
        pieces ? insert_pieces(p, pieces)
               : replace_run_row(p, jox_sweep_states[JOX_SWEEP_FAILED], failure, NULL, NULL);
    if (good && jox_sweep_execute(p->store, "COMMIT", p->error))
        return true;
    jox_sweep_execute(p->store, "ROLLBACK", &ignored);
    return false;
}

bool jox_sweep_put_run(const JoxSweepStore *store, int64_t variant, uint64_t seed,
                       const JoxText *pieces, JoError *error) {
    return store_run(&(RunWriter){.store = store, .variant = variant, .seed = seed, .error = error},
                     pieces, NULL);
}

bool jox_sweep_put_failure(const JoxSweepStore *store, int64_t variant, uint64_t seed,
                           const char *why, JoError *error) {
    return store_run(&(RunWriter){.store = store, .variant = variant, .seed = seed, .error = error},
                     NULL, why);
}
