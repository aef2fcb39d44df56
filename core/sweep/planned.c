/* The plans that a sweep's file holds, and the runs that they name and the file lacks. sweep.c
   notes the plan of each sweep; merge.c copies the plans of parts, and merges no part of a study
   without saying so. */
#include <inttypes.h>
#include <string.h>

#include "base/guard.h"
#include "base/mem.h"
#include "sweep/store.h"

enum { NAMED_RUNS = 20 }; /* missing runs that are named */

/* A file of the former format gets the table here, and becomes one of this format. */
static const char ADD_TABLE[] = JOX_SWEEP_PLANNED "PRAGMA user_version=" JOX_SWEEP_FORMAT ";";

/* Whether a file has the table of plans; one of the former format lacks it. */
static bool has_plans(const JoxSweepStore *store) {
    sqlite3_stmt *s = jox_database_prepare(
        store->db, "SELECT 1 FROM sqlite_schema WHERE type = 'table' AND name = 'planned'");
    const bool found = s && sqlite3_step(s) == SQLITE_ROW;
    jox_sweep_finalize(store, s);
    return found;
}

static bool insert_plan_row(const JoxSweepStore *store, const char *settings, int64_t first_seed,
                            int64_t seeds, JoError *error) {
    if (!has_plans(store) && !jox_sweep_execute(store, ADD_TABLE, error))
        return false;
    sqlite3_stmt *s =
        jox_sweep_prepare(store, "INSERT OR IGNORE INTO planned VALUES(?, ?, ?)", error);
    if (s) {
        sqlite3_bind_text(s, 1, settings, -1, SQLITE_STATIC);
        sqlite3_bind_int64(s, 2, first_seed);
        sqlite3_bind_int64(s, 3, seeds);
    }
    return jox_sweep_step_once(store, s, error);
}

bool jox_sweep_note_plan(const JoxSweepStore *store, const JoxSweepPlan *plan, JoError *error) {
    JoxText settings = {0};
    for (uint32_t a = 0; a < plan->axis_count; a++) {
        jox_text_printf(&settings, "%s%s=", a ? "\n" : "", plan->axes[a].path);
        for (uint32_t v = 0; v < plan->axes[a].count; v++)
            jox_text_printf(&settings, "%s%s", v ? "," : "", plan->axes[a].values[v]);
    }
    const bool good = insert_plan_row(store, settings.data ? settings.data : "",
                                      (int64_t)plan->first_seed, plan->seeds, error);
    jox_text_free(&settings);
    return good;
}

/* Prepares a query for the plans in order; *none: the file is of the former format. */
static sqlite3_stmt *select_plans(const JoxSweepStore *store, bool *none, JoError *error) {
    *none = !has_plans(store);
    return *none ? NULL
                 : jox_sweep_prepare(store,
                                     "SELECT settings, first_seed, seeds FROM planned"
                                     " ORDER BY settings, first_seed, seeds",
                                     error);
}

/* Makes the plan of a row again; false with JO_INPUT in `error` if it makes none. Free the plan
   even then. */
static bool read_plan_row(const JoxSweepStore *store, sqlite3_stmt *row, JoxSweepPlan *plan,
                          JoError *error) {
    const char *settings = (const char *)sqlite3_column_text(row, 0);
    const int64_t first_seed = sqlite3_column_int64(row, 1), seeds = sqlite3_column_int64(row, 2);
    char *text = jox_strdup(settings ? settings : "");
    const char **sets = NULL;
    size_t count = 0, capacity = 0;
    for (char *line = *text ? text : NULL, *next; line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = 0;
        JOX_RESERVE(sets, capacity, count + 1);
        sets[count++] = line;
    }
    JoError why = {0};
    *plan = (JoxSweepPlan){0};
    const bool good =
        first_seed >= 0 && seeds > 0 && seeds <= JOX_SWEEP_RUNS &&
        jox_sweep_make_plan(plan, sets, count, (uint64_t)first_seed, (uint32_t)seeds, &why);
    jox_free((void *)(uintptr_t)sets);
    jox_free(text);
    if (!good)
        jox_error(error, JO_INPUT, "%.300s: the plan of its runs cannot be read%s%.200s",
                  store->path, *why.text ? ": " : "", why.text);
    return good;
}

/* Whether a plan can be made of a row; false with `error`. */
static bool check_plan_row(const JoxSweepStore *store, sqlite3_stmt *row, JoError *error) {
    JoxSweepPlan plan;
    const bool good = read_plan_row(store, row, &plan, error);
    jox_sweep_free_plan(&plan);
    return good;
}

bool jox_sweep_copy_plans(const JoxSweepStore *from, const JoxSweepStore *to, JoError *error) {
    bool none, good = true;
    int code = SQLITE_ERROR;
    sqlite3_stmt *s = select_plans(from, &none, error);
    if (!s)
        return none;
    while (good && (code = sqlite3_step(s)) == SQLITE_ROW) {
        const char *settings = (const char *)sqlite3_column_text(s, 0);
        good = insert_plan_row(to, settings ? settings : "", sqlite3_column_int64(s, 1),
                               sqlite3_column_int64(s, 2), error) &&
               (sqlite3_changes(to->db->sqlite) == 0 || check_plan_row(from, s, error));
    }
    good = good && (code == SQLITE_DONE || jox_sweep_set_error(from, error));
    jox_sweep_finalize(from, s);
    return good;
}

bool jox_sweep_visit_plans(const JoxSweepStore *store, JoxSweepVisitPlan *visit, void *context,
                           JoError *error) {
    bool none, good = true;
    int code = SQLITE_ERROR;
    sqlite3_stmt *s = select_plans(store, &none, error);
    if (!s)
        return none;
    while (good && (code = sqlite3_step(s)) == SQLITE_ROW) {
        JoxSweepPlan plan;
        good = read_plan_row(store, s, &plan, error) && visit(context, &plan, error);
        jox_sweep_free_plan(&plan);
    }
    good = good && (code == SQLITE_DONE || jox_sweep_set_error(store, error));
    jox_sweep_finalize(store, s);
    return good;
}

/* ---- missing runs ---- */

typedef struct Missing {
    const JoxSweepStore *store;
    sqlite3_stmt *insert; /* into `absent`, which has each missing run once */
    uint32_t count;
    JoxText *lines;
} Missing;

/* Counts a missing run, unless another plan named it before; false with `error`. */
static bool add_missing_run(Missing *m, const JoxSweepPlan *plan, uint32_t variant, uint32_t n,
                            const char *name, JoError *error) {
    const uint64_t seed = plan->first_seed + n;
    sqlite3_bind_text(m->insert, 1, plan->variants[variant].key, -1, SQLITE_STATIC);
    sqlite3_bind_int64(m->insert, 2, (sqlite3_int64)seed);
    const bool good =
        sqlite3_step(m->insert) == SQLITE_DONE || jox_sweep_set_error(m->store, error);
    sqlite3_reset(m->insert);
    if (!good || sqlite3_changes(m->store->db->sqlite) == 0)
        return good;
    if (m->count++ < NAMED_RUNS)
        jox_text_printf(m->lines, "  run %u: %s%sseed %" PRIu64 "\n", 1 + variant * plan->seeds + n,
                        name, *name ? ", " : "", seed);
    return true;
}

static bool find_missing_of_plan(void *context, const JoxSweepPlan *plan, JoError *error) {
    Missing *m = context;
    char **names = jox_sweep_name_plan(plan);
    bool good = true;
    for (uint32_t v = 0; v < plan->variant_count; v++) {
        for (uint32_t n = 0; good && n < plan->seeds; n++) {
            int state;
            good = jox_sweep_find_run(m->store, plan->variants[v].key, plan->first_seed + n, &state,
                                      error) &&
                   (state >= 0 || add_missing_run(m, plan, v, n, names[v], error));
        }
        jox_free(names[v]);
    }
    jox_free(names);
    return good;
}

bool jox_sweep_find_missing(const JoxSweepStore *store, uint32_t *missing, JoxText *lines,
                            JoError *error) {
    *missing = 0;
    if (!jox_sweep_execute(store,
                           "CREATE TEMP TABLE IF NOT EXISTS absent(settings TEXT, seed INTEGER,"
                           " PRIMARY KEY(settings, seed)) WITHOUT ROWID; DELETE FROM temp.absent",
                           error))
        return false;
    Missing m = {.store = store, .lines = lines};
    m.insert = jox_sweep_prepare(store, "INSERT OR IGNORE INTO temp.absent VALUES(?, ?)", error);
    const bool good = m.insert && jox_sweep_visit_plans(store, find_missing_of_plan, &m, error);
    jox_sweep_finalize(store, m.insert);
    if (m.count > NAMED_RUNS)
        jox_text_printf(lines, "  and %u more\n", m.count - NAMED_RUNS);
    *missing = m.count;
    return good;
}
