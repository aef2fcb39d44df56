/* What a run left, as rows. */
#include <math.h>
#include <string.h>

#include "base/format/json.h"
#include "base/format/pieces.h"
#include "base/guard.h"
#include "record/aggregate.h"
#include "sweep/store.h"

typedef struct Putting {
    const JoxSweepStore *store;
    int64_t variant;
    uint64_t seed;
    JoError *error;
    sqlite3_stmt *figure;
    bool good;
} Putting;

static void bind_run(sqlite3_stmt *s, const Putting *p) {
    sqlite3_bind_int64(s, 1, p->variant);
    sqlite3_bind_int64(s, 2, (sqlite3_int64)p->seed);
}

static void bind_number(sqlite3_stmt *s, int at, double value) {
    if (isfinite(value))
        sqlite3_bind_double(s, at, value);
    else
        sqlite3_bind_null(s, at);
}

/* Steps a statement that returns nothing, to be stepped again. */
static bool step(Putting *p, sqlite3_stmt *s) {
    p->good = p->good && (sqlite3_step(s) == SQLITE_DONE || jox_sweep_broken(p->store, p->error));
    sqlite3_reset(s);
    return p->good;
}

static bool put_figure(void *context, const JoxJsonItem *item) {
    Putting *p = context;
    if ((item->kind != JOX_JSON_NUMBER && item->kind != JOX_JSON_NULL) ||
        jox_summary_kind(item->path) != JOX_SUMMARY_FIGURE)
        return true;
    sqlite3_bind_text(p->figure, 3, item->path, -1, SQLITE_TRANSIENT);
    bind_number(p->figure, 4, item->kind == JOX_JSON_NUMBER ? item->number : NAN);
    return step(p, p->figure);
}

static bool put_figures(Putting *p, const char *summary) {
    p->figure =
        jox_sweep_ask(p->store, "INSERT OR REPLACE INTO figure VALUES(?, ?, ?, ?)", p->error);
    if (!p->figure)
        return false;
    bind_run(p->figure, p);
    if (!jox_json_read(summary, jox_json_own_files, put_figure, p) && p->good) {
        jox_error(p->error, JO_FAILED, "the figures of a run cannot be read");
        p->good = false;
    }
    jox_sweep_end(p->store, p->figure);
    return p->good;
}

static bool name_curve(Putting *p, const JoxSweepCurve *curve, int64_t *id) {
    sqlite3_stmt *s = jox_sweep_ask(
        p->store, "INSERT INTO curve_name(name, unit) VALUES(?, ?) ON CONFLICT DO NOTHING",
        p->error);
    if (s) {
        sqlite3_bind_text(s, 1, curve->name, -1, SQLITE_STATIC);
        sqlite3_bind_text(s, 2, curve->unit, -1, SQLITE_STATIC);
    }
    if (!jox_sweep_finish(p->store, s, p->error) ||
        !(s = jox_sweep_ask(p->store, "SELECT id FROM curve_name WHERE name = ?", p->error)))
        return false;
    sqlite3_bind_text(s, 1, curve->name, -1, SQLITE_STATIC);
    const bool good = sqlite3_step(s) == SQLITE_ROW || jox_sweep_broken(p->store, p->error);
    *id = good ? sqlite3_column_int64(s, 0) : 0;
    jox_sweep_end(p->store, s);
    return good;
}

static bool put_curve(Putting *p, const JoxSweepCurve *curve) {
    int64_t id = 0;
    p->good = p->good && name_curve(p, curve, &id);
    sqlite3_stmt *s =
        p->good
            ? jox_sweep_ask(p->store, "INSERT OR REPLACE INTO curve_point VALUES(?, ?, ?, ?, ?)",
                            p->error)
            : NULL;
    if (!s)
        return p->good = false;
    bind_run(s, p);
    sqlite3_bind_int64(s, 3, id);
    for (size_t k = 0; k < curve->count && p->good; k++) {
        sqlite3_bind_double(s, 4, curve->points[2 * k]);
        bind_number(s, 5, curve->points[2 * k + 1]);
        step(p, s);
    }
    jox_sweep_end(p->store, s);
    return p->good;
}

static bool put_field(Putting *p, const JoxSweepField *field) {
    sqlite3_stmt *s = jox_sweep_ask(
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
    return p->good = jox_sweep_finish(p->store, s, p->error);
}

static bool put_plan(Putting *p, const char *plan) {
    sqlite3_stmt *s = jox_sweep_ask(
        p->store, "UPDATE variant SET plan = ? WHERE id = ? AND plan IS NULL", p->error);
    if (s) {
        sqlite3_bind_text(s, 1, plan, -1, SQLITE_STATIC);
        sqlite3_bind_int64(s, 2, p->variant);
    }
    return p->good = jox_sweep_finish(p->store, s, p->error);
}

static const char *const TABLES[] = {"figure", "curve_point", "field", "run"}; /* by seed */
enum { TABLE_COUNT = sizeof TABLES / sizeof *TABLES };

bool jox_sweep_keep_seeds(const JoxSweepStore *store, uint64_t first, uint32_t count,
                          JoError *error) {
    bool good = true;
    for (size_t t = 0; good && t < TABLE_COUNT; t++) {
        char text[100];
        snprintf(text, sizeof text, "DELETE FROM %s WHERE seed < ? OR seed >= ?", TABLES[t]);
        sqlite3_stmt *s = jox_sweep_ask(store, text, error);
        if (s) {
            sqlite3_bind_int64(s, 1, (sqlite3_int64)first);
            sqlite3_bind_int64(s, 2, (sqlite3_int64)(first + count));
        }
        good = jox_sweep_finish(store, s, error);
    }
    return good;
}

/* The row of the run, and none of its other rows. */
static bool put_row(Putting *p, const char *state, const char *reason,
                    const JoxSweepNumbers *numbers, const char *summary) {
    char text[100];
    for (size_t t = 0; t < TABLE_COUNT; t++) {
        snprintf(text, sizeof text, "DELETE FROM %s WHERE variant = ? AND seed = ?", TABLES[t]);
        sqlite3_stmt *s = jox_sweep_ask(p->store, text, p->error);
        if (s)
            bind_run(s, p);
        if (!jox_sweep_finish(p->store, s, p->error))
            return p->good = false;
    }
    sqlite3_stmt *s = jox_sweep_ask(
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
    return p->good = jox_sweep_finish(p->store, s, p->error);
}

/* One of the pieces that become rows of their own. */
static bool put_piece(Putting *p, const JoxPiece *piece) {
    JoxSweepCurve curve;
    JoxSweepField field;
    if (!strcmp(piece->name, "plan"))
        return put_plan(p, piece->data);
    if (!strcmp(piece->name, "curve") && jox_sweep_get_curve(piece->data, piece->length, &curve)) {
        put_curve(p, &curve);
        jox_sweep_free_curve(&curve);
    }
    if (!strcmp(piece->name, "field") && jox_sweep_get_field(piece->data, piece->length, &field)) {
        put_field(p, &field);
        jox_sweep_free_field(&field);
    }
    return p->good;
}

static bool put_all(Putting *p, const JoxText *pieces) {
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
    if (!put_row(p, jox_sweep_states[state], reason, ended ? &numbers : NULL, summary) ||
        (summary && !put_figures(p, summary)))
        return false;
    for (size_t at = 0; p->good && jox_pieces_next(pieces, &at, &piece, why);)
        put_piece(p, &piece);
    return p->good;
}

/* In one transaction: all of it, or nothing. */
static bool put(Putting *p, const JoxText *pieces, const char *failure) {
    JoError ignored;
    p->good = jox_sweep_do_sql(p->store, "BEGIN IMMEDIATE", p->error);
    if (!p->good)
        return false;
    const bool good = pieces ? put_all(p, pieces)
                             : put_row(p, jox_sweep_states[JOX_SWEEP_FAILED], failure, NULL, NULL);
    if (good && jox_sweep_do_sql(p->store, "COMMIT", p->error))
        return true;
    jox_sweep_do_sql(p->store, "ROLLBACK", &ignored);
    return false;
}

bool jox_sweep_put_run(const JoxSweepStore *store, int64_t variant, uint64_t seed,
                       const JoxText *pieces, JoError *error) {
    return put(&(Putting){.store = store, .variant = variant, .seed = seed, .error = error}, pieces,
               NULL);
}

bool jox_sweep_put_failure(const JoxSweepStore *store, int64_t variant, uint64_t seed,
                           const char *why, JoError *error) {
    return put(&(Putting){.store = store, .variant = variant, .seed = seed, .error = error}, NULL,
               why);
}
