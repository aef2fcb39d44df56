/* Rewrites a sweep's file so that the same runs give the same bytes, on whatever machines and in
   whatever order they were done: jo_sweep_make_canonical, for `jostle sweep --canonical`. The new
   file gets the rows run by run in one transaction, so that SQLite lays out its pages alike. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/guard.h"
#include "record/aggregate.h"
#include "sweep/store.h"

/* ---- the summary of a run ---- */

/* Whether a member of a summary may differ between two runs of the same: what the run cost, and by
   what means it was computed. */
static bool differs_between_machines(const char *key) {
    char inner[80];
    snprintf(inner, sizeof inner, "%s.any", key);
    return !strcmp(key, "isa") || !strcmp(key, "threads") ||
           jox_summary_kind(key) == JOX_SUMMARY_COST || jox_summary_kind(inner) == JOX_SUMMARY_COST;
}

/* Copies a summary without these members. In its layout a line ` "KEY": ...` begins each member of
   the outermost object, which `}` ends. */
static void copy_summary(JoxText *out, const char *summary) {
    bool kept = true;
    for (const char *line = summary; *line;) {
        const size_t length = strcspn(line, "\n");
        char key[72];
        if (sscanf(line, " \"%71[^\"]\":", key) == 1 && line[1] == '"')
            kept = !differs_between_machines(key);
        else if (*line != ' ')
            kept = true;
        if (*line == '}' && out->length > 1 && out->data[out->length - 2] == ',')
            out->data[--out->length - 1] = '\n'; /* the last member was left out */
        if (kept)
            jox_text_append(out, line, length + (line[length] == '\n'));
        line += length + (line[length] == '\n');
    }
}

/* ---- rows ---- */

/* Copies what all runs share. */
static const char SHARED[] = "INSERT INTO main.sweep SELECT * FROM part.sweep ORDER BY key;"
                             "INSERT INTO main.input SELECT * FROM part.input ORDER BY path;"
                             "INSERT INTO main.planned SELECT * FROM part.planned"
                             " ORDER BY settings, first_seed, seeds;"
                             "INSERT INTO main.curve_name(name, unit)"
                             " SELECT name, unit FROM part.curve_name ORDER BY name;";
/* Copies a run: 1: id in the new file, 2: seed, 3: id in the former file, 4: summary. */
static const char *const RUN[] = {
    "INSERT INTO main.run SELECT ?1, ?2, state, reason, hash, steps, simulated_s, NULL, NULL, ?4"
    " FROM part.run WHERE variant = ?3 AND seed = ?2",
    "INSERT INTO main.figure SELECT ?1, ?2, name, value FROM part.figure"
    " WHERE variant = ?3 AND seed = ?2 ORDER BY name",
    "INSERT INTO main.curve_point SELECT ?1, ?2, n.id, p.time, p.value FROM part.curve_point p"
    " JOIN part.curve_name q ON q.id = p.curve JOIN main.curve_name n ON n.name = q.name"
    " WHERE p.variant = ?3 AND p.seed = ?2 ORDER BY n.id, p.time",
    "INSERT INTO main.field SELECT ?1, ?2, name, unit, low_x, low_y, cell, columns, rows, cells"
    " FROM part.field WHERE variant = ?3 AND seed = ?2 ORDER BY name"};
enum { RUN_STATEMENTS = sizeof RUN / sizeof *RUN };

typedef struct Copier {
    JoxSweepStore store; /* the new file, to which the former is attached as `part` */
    sqlite3_stmt *rank, *variants, *variant, *runs, *run[RUN_STATEMENTS];
    int64_t count; /* of variants */
} Copier;

static bool step_and_reset(const Copier *c, sqlite3_stmt *s, JoError *error) {
    const bool good = sqlite3_step(s) == SQLITE_DONE || jox_sweep_set_error(&c->store, error);
    sqlite3_reset(s);
    return good;
}

static bool prepare_copier(Copier *c, JoError *error) {
    const struct {
        sqlite3_stmt **statement;
        const char *sql;
    } all[] = {{&c->rank, "INSERT OR IGNORE INTO temp.ranked(settings) VALUES(?)"},
               {&c->variants, "SELECT w.id, w.settings, w.plan FROM part.variant w"
                              " LEFT JOIN temp.ranked r ON r.settings = w.settings"
                              " ORDER BY r.place IS NULL, r.place, w.settings"},
               {&c->variant, "INSERT INTO main.variant VALUES(?, ?, ?)"},
               {&c->runs, "SELECT seed, summary FROM part.run WHERE variant = ? ORDER BY seed"},
               {&c->run[0], RUN[0]},
               {&c->run[1], RUN[1]},
               {&c->run[2], RUN[2]},
               {&c->run[3], RUN[3]}};
    if (!jox_sweep_execute(&c->store,
                           "CREATE TEMP TABLE ranked(settings TEXT UNIQUE, place INTEGER PRIMARY "
                           "KEY)",
                           error))
        return false;
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        if (!(*all[k].statement = jox_sweep_prepare(&c->store, all[k].sql, error)))
            return false;
    return true;
}

static void finalize_copier(Copier *c) {
    sqlite3_stmt *const all[] = {c->rank,   c->variants, c->variant, c->runs,
                                 c->run[0], c->run[1],   c->run[2],  c->run[3]};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        jox_sweep_finalize(&c->store, all[k]);
}

/* Notes the order of a plan's variants. */
static bool rank_variants(void *context, const JoxSweepPlan *plan, JoError *error) {
    const Copier *c = context;
    for (uint32_t v = 0; v < plan->variant_count; v++) {
        sqlite3_bind_text(c->rank, 1, plan->variants[v].key, -1, SQLITE_STATIC);
        if (!step_and_reset(c, c->rank, error))
            return false;
    }
    return true;
}

static bool copy_run(const Copier *c, int64_t id, int64_t was, JoError *error) {
    const int64_t seed = sqlite3_column_int64(c->runs, 0);
    const char *text = (const char *)sqlite3_column_text(c->runs, 1);
    JoxText summary = {0};
    bool good = true;
    if (text)
        copy_summary(&summary, text);
    for (int k = 0; good && k < RUN_STATEMENTS; k++) {
        sqlite3_bind_int64(c->run[k], 1, id);
        sqlite3_bind_int64(c->run[k], 2, seed);
        sqlite3_bind_int64(c->run[k], 3, was);
        if (k == 0)
            sqlite3_bind_text(c->run[k], 4, text ? summary.data : NULL, -1, SQLITE_STATIC);
        good = step_and_reset(c, c->run[k], error);
    }
    jox_text_free(&summary);
    return good;
}

/* Copies the variant that `variants` is at, with its runs. */
static bool copy_variant(Copier *c, JoError *error) {
    const int64_t was = sqlite3_column_int64(c->variants, 0), id = ++c->count;
    sqlite3_bind_int64(c->variant, 1, id);
    sqlite3_bind_value(c->variant, 2, sqlite3_column_value(c->variants, 1));
    sqlite3_bind_value(c->variant, 3, sqlite3_column_value(c->variants, 2));
    if (!step_and_reset(c, c->variant, error))
        return false;
    sqlite3_bind_int64(c->runs, 1, was);
    int code;
    while ((code = sqlite3_step(c->runs)) == SQLITE_ROW)
        if (!copy_run(c, id, was, error))
            return false;
    sqlite3_reset(c->runs);
    return code == SQLITE_DONE || jox_sweep_set_error(&c->store, error);
}

static bool copy_rows(Copier *c, const JoxSweepStore *former, JoError *error) {
    int code = SQLITE_ERROR;
    if (!jox_sweep_execute(&c->store, SHARED, error) || !prepare_copier(c, error) ||
        !jox_sweep_visit_plans(former, rank_variants, c, error))
        return false;
    while ((code = sqlite3_step(c->variants)) == SQLITE_ROW)
        if (!copy_variant(c, error))
            return false;
    return code == SQLITE_DONE || jox_sweep_set_error(&c->store, error);
}

/* Fills the new file `path` from the former one. */
static bool write_new_file(const JoxSweepStore *former, const char *path, JoError *error) {
    Copier c = {0};
    if (!jox_sweep_open(&c.store, path, error)) {
        jox_sweep_close(&c.store);
        return false;
    }
    const bool good = jox_sweep_attach_part(&c.store, former->path, error) &&
                      jox_sweep_execute(&c.store, "BEGIN IMMEDIATE", error) &&
                      copy_rows(&c, former, error);
    finalize_copier(&c);
    const bool whole = good && jox_sweep_execute(&c.store, "COMMIT", error);
    jox_sweep_close(&c.store);
    return whole;
}

/* Called when memory is out: removes the file that was begun. */
static void remove_new_file(void *path) {
    unlink(path);
}

bool jo_sweep_make_canonical(const char *path, JoError *error) {
    JOX_REQUIRE(path, false);
    JOX_GUARD (NULL, error)
        return false;
    JoxSweepStore former;
    JoxText fresh = {0};
    jox_text_printf(&fresh, "%s.part", path);
    bool good = jox_sweep_open(&former, path, error) &&
                jox_sweep_execute(&former, JOX_SWEEP_PLANNED, error);
    if (good) {
        unlink(fresh.data); /* a process that was killed may have left it */
        jox_heap_register(fresh.data, remove_new_file);
        good = write_new_file(&former, fresh.data, error);
        if (good && rename(fresh.data, path) != 0) {
            jox_error(error, JO_FAILED, "cannot replace '%.300s': %s", path, strerror(errno));
            good = false;
        }
        if (!good)
            unlink(fresh.data);
        jox_heap_unregister(fresh.data);
    }
    jox_sweep_close(&former);
    jox_text_free(&fresh);
    return good;
}
