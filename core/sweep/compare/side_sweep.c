/* Reads the variants of a sweep's file as sides. Files may come from elsewhere, so numbers of rows
   are bounded. */
#include <math.h>
#include <string.h>

#include "base/database.h"
#include "base/format/json.h"
#include "base/guard.h"
#include "sweep/compare/compare.h"

enum { MOST_RUNS = JOX_SWEEP_RUNS, MOST_FIGURES = 20000, MOST_SIDES = 1000, MOST_NOTES = 1000 };

static char *copy_column_text(sqlite3_stmt *s, int column) {
    const char *text = (const char *)sqlite3_column_text(s, column);
    return jox_strdup(text ? text : "");
}

/* Finalizes a statement whose last step returned `code`; false with `error` unless it was done. */
static bool finish_statement(const JoxSweepStore *store, sqlite3_stmt *s, int code,
                             JoError *error) {
    const bool good = code == SQLITE_DONE || jox_sweep_set_error(store, error);
    jox_sweep_finalize(store, s);
    return good;
}

static sqlite3_stmt *prepare_for_variant(const JoxSweepStore *store, const char *sql,
                                         int64_t variant, JoError *error) {
    sqlite3_stmt *s = jox_sweep_prepare(store, sql, error);
    if (s)
        sqlite3_bind_int64(s, 1, variant);
    return s;
}

/* Reads the states of all runs of a variant; those that are done are compared. */
static bool read_side_runs(const JoxSweepStore *store, int64_t variant, JoxSide *side,
                           JoError *error) {
    sqlite3_stmt *s = prepare_for_variant(
        store, "SELECT seed, state, reason, hash FROM run WHERE variant = ? ORDER BY seed", variant,
        error);
    int code = SQLITE_DONE;
    if (!s)
        return false;
    while ((code = sqlite3_step(s)) == SQLITE_ROW && side->runs < MOST_RUNS) {
        char *name = copy_column_text(s, 1);
        JoxSweepState state = JOX_SWEEP_DONE;
        while (state < JOX_SWEEP_FAILED && strcmp(name, jox_sweep_states[state]) != 0)
            state++;
        jox_free(name);
        JOX_RESERVE(side->all, side->all_capacity, side->all_count + 1);
        side->all[side->all_count++] = (JoxSideRun){(uint64_t)sqlite3_column_int64(s, 0), state,
                                                    copy_column_text(s, 2), copy_column_text(s, 3)};
        if (state == JOX_SWEEP_DONE) {
            JOX_RESERVE(side->seeds, side->run_capacity, side->runs + 1);
            side->seeds[side->runs++] = (uint64_t)sqlite3_column_int64(s, 0);
        } else {
            side->left_out++;
        }
    }
    return finish_statement(store, s, code, error);
}

/* Returns the index of the run with a seed, by bisection; `runs` if there is none. */
static uint32_t find_run_by_seed(const JoxSide *side, uint64_t seed) {
    uint32_t low = 0, high = side->runs;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (side->seeds[middle] < seed)
            low = middle + 1;
        else
            high = middle;
    }
    return low < side->runs && side->seeds[low] == seed ? low : side->runs;
}

/* Reads the figures of the compared runs. */
static bool read_side_figures(const JoxSweepStore *store, int64_t variant, JoxSide *side,
                              JoError *error) {
    sqlite3_stmt *s = prepare_for_variant(
        store, "SELECT name, seed, value FROM figure WHERE variant = ? ORDER BY name", variant,
        error);
    JoxSideFigure *figure = NULL;
    int code = SQLITE_DONE;
    if (!s)
        return false;
    while ((code = sqlite3_step(s)) == SQLITE_ROW) {
        const char *name = (const char *)sqlite3_column_text(s, 0);
        const uint32_t run = find_run_by_seed(side, (uint64_t)sqlite3_column_int64(s, 1));
        if (!name || run == side->runs)
            continue;
        if (!figure || strcmp(figure->name, name) != 0) {
            if (side->figure_count == MOST_FIGURES)
                continue;
            figure = jox_side_add_figure(side, name);
        }
        if (sqlite3_column_type(s, 2) != SQLITE_NULL)
            figure->values[run] = sqlite3_column_double(s, 2);
    }
    return finish_statement(store, s, code, error);
}

/* Appends mean and spread of the runs' values at one time, if at least half of the runs have one. A
   run without the curve of an exit counts as 0: nobody left by it. */
static void add_moment(JoxSide *side, JoxSideCurve *curve, double time, double *values,
                       size_t count) {
    static const char EXIT[] = "left by ";
    while (count < side->runs && strncmp(curve->name, EXIT, sizeof EXIT - 1) == 0)
        values[count++] = 0;
    if (count == 0 || 2 * count < side->runs)
        return;
    jox_side_add_point(curve, time, values, count);
}

/* Reads the curves of the compared runs, point by point in order of time, and reduces each point
   over the runs. */
static bool read_curves(const JoxSweepStore *store, int64_t variant, JoxSide *side,
                        JoError *error) {
    sqlite3_stmt *s =
        prepare_for_variant(store,
                            "SELECT p.curve, p.time, p.value, c.name, c.unit FROM curve_point p"
                            " JOIN curve_name c ON c.id = p.curve"
                            " JOIN run r ON r.variant = p.variant AND r.seed = p.seed"
                            " WHERE p.variant = ? AND r.state = 'done' ORDER BY p.curve, p.time",
                            variant, error);
    double *values = jox_alloc(side->runs + 1, sizeof *values), time = NAN;
    JoxSideCurve *curve = NULL;
    int64_t last = -1;
    size_t count = 0;
    int code = SQLITE_ERROR;
    while (s && (code = sqlite3_step(s)) == SQLITE_ROW) {
        const int64_t number = sqlite3_column_int64(s, 0);
        const double now = sqlite3_column_double(s, 1);
        if (number != last || now != time) {
            if (curve)
                add_moment(side, curve, time, values, count);
            count = 0;
            time = now;
        }
        if (number != last)
            curve = jox_side_add_curve(side, (const char *)sqlite3_column_text(s, 3),
                                       (const char *)sqlite3_column_text(s, 4));
        last = number;
        if (sqlite3_column_type(s, 2) != SQLITE_NULL && count < side->runs)
            values[count++] = sqlite3_column_double(s, 2);
    }
    if (curve)
        add_moment(side, curve, time, values, count);
    jox_free(values);
    return s && finish_statement(store, s, code, error);
}

/* Reads rows of two texts, key and value. */
static bool read_notes(const JoxSweepStore *store, const char *sql, JoxSideNotes *notes,
                       JoError *error) {
    sqlite3_stmt *s = jox_sweep_prepare(store, sql, error);
    int code;
    if (!s)
        return false;
    while ((code = sqlite3_step(s)) == SQLITE_ROW && notes->count < MOST_NOTES) {
        JOX_RESERVE(notes->items, notes->capacity, notes->count + 1);
        notes->items[notes->count++] =
            (JoxSideNote){copy_column_text(s, 0), copy_column_text(s, 1)};
    }
    return finish_statement(store, s, code == SQLITE_ROW ? SQLITE_DONE : code, error);
}

/* Finds the title in the JSON of a plan. */
static bool find_title(void *context, const JoxJsonItem *item) {
    JoxSide *side = context;
    if (item->kind == JOX_JSON_TEXT && !strcmp(item->path, "title") && !side->title)
        side->title = jox_strdup(item->text);
    return true;
}

bool jox_sides_add_sweep(JoxSides *sides, const char *path, JoError *error) {
    JoxSweepStore store;
    bool good = jox_sweep_open_to_read(&store, path, error);
    if (good)
        jox_database_bound(store.db, true);
    sqlite3_stmt *s =
        good
            ? jox_sweep_prepare(&store, "SELECT id, settings, plan FROM variant ORDER BY id", error)
            : NULL;
    const uint32_t before = sides->count;
    int code = SQLITE_DONE;
    good = s != NULL;
    while (good && (code = sqlite3_step(s)) == SQLITE_ROW && sides->count < MOST_SIDES) {
        const int64_t id = sqlite3_column_int64(s, 0);
        JoxSide *side = jox_sides_add(sides, path);
        side->settings = copy_column_text(s, 1);
        side->plan = sqlite3_column_type(s, 2) == SQLITE_NULL ? NULL : copy_column_text(s, 2);
        if (side->plan)
            jox_json_read(side->plan, jox_json_own_files, find_title, side);
        good = read_notes(&store, "SELECT key, value FROM sweep", &side->notes, error) &&
               read_notes(&store, "SELECT path, sha256 FROM input ORDER BY path", &side->inputs,
                          error) &&
               read_side_runs(&store, id, side, error) &&
               read_side_figures(&store, id, side, error) && read_curves(&store, id, side, error) &&
               jox_side_read_fields(&store, id, side, error);
    }
    if (s && good && code != SQLITE_DONE && code != SQLITE_ROW)
        good = jox_sweep_set_error(&store, error);
    if (store.db) {
        jox_sweep_finalize(&store, s);
        jox_database_bound(store.db, false);
    }
    jox_sweep_close(&store);
    if (good && sides->count == before) {
        jox_error(error, JO_INPUT, "%.300s has no runs as yet", path);
        return false;
    }
    return good;
}
