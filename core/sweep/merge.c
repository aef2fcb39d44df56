/* Merges the files of a sweep whose runs were spread over machines: `jostle sweep --merge`. All
   parts are first listed in memory, to find which planned runs are missing. Then each part is
   attached to the output as the database `part`, and its runs are copied. */
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/guard.h"
#include "run/messages.h"
#include "sweep/store.h"

/* Adds the part's variants and curve names, and lists in `moved` the runs that the output lacks or
   has only as failed. The ids of variants and curves differ between files, so rows are matched by
   settings and by name. */
static const char CHOOSE[] =
    "INSERT INTO main.variant(settings, plan) SELECT settings, plan FROM part.variant WHERE true"
    " ON CONFLICT(settings) DO UPDATE SET plan = coalesce(plan, excluded.plan);"
    /* the plan of a variant is that of its run with the lowest seed */
    "UPDATE main.variant SET plan = w.plan FROM part.variant w WHERE w.settings = "
    "main.variant.settings AND w.plan NOT NULL AND"
    " (SELECT min(seed) FROM part.run WHERE variant = w.id AND summary NOT NULL) <"
    " (SELECT min(seed) FROM main.run r WHERE r.variant = main.variant.id AND summary NOT NULL);"
    "INSERT INTO main.curve_name(name, unit) SELECT name, unit FROM part.curve_name WHERE true"
    " ON CONFLICT(name) DO NOTHING;"
    "CREATE TEMP TABLE IF NOT EXISTS moved(was INTEGER, variant INTEGER, seed INTEGER,"
    " PRIMARY KEY(was, seed));"
    "DELETE FROM temp.moved;"
    "INSERT INTO temp.moved SELECT p.variant, v.id, p.seed FROM part.run p"
    " JOIN part.variant w ON w.id = p.variant JOIN main.variant v ON v.settings = w.settings"
    " LEFT JOIN main.run r ON r.variant = v.id AND r.seed = p.seed"
    " WHERE r.state IS NULL OR (r.state = 'failed' AND p.state != 'failed');"
    "DELETE FROM main.run WHERE (variant, seed) IN (SELECT variant, seed FROM temp.moved);";
/* Copies the runs that are listed in `moved`, with the output's ids. */
static const char MOVE[] =
    "INSERT INTO main.run SELECT m.variant, m.seed, p.state, p.reason, p.hash, p.steps,"
    " p.simulated_s, p.cpu_s, p.wall_s, p.summary FROM temp.moved m"
    " JOIN part.run p ON p.variant = m.was AND p.seed = m.seed;"
    "INSERT INTO main.figure SELECT m.variant, m.seed, p.name, p.value FROM temp.moved m"
    " JOIN part.figure p ON p.variant = m.was AND p.seed = m.seed;"
    "INSERT INTO main.curve_point SELECT m.variant, m.seed, n.id, p.time, p.value FROM temp.moved m"
    " JOIN part.curve_point p ON p.variant = m.was AND p.seed = m.seed"
    " JOIN part.curve_name q ON q.id = p.curve JOIN main.curve_name n ON n.name = q.name;"
    "INSERT INTO main.field SELECT m.variant, m.seed, p.name, p.unit, p.low_x, p.low_y, p.cell,"
    " p.columns, p.rows, p.cells FROM temp.moved m"
    " JOIN part.field p ON p.variant = m.was AND p.seed = m.seed;";

/* Finds a run that both files have, with different hashes. */
static const char CLASH[] =
    "SELECT v.settings, p.seed, r.hash, p.hash FROM part.run p"
    " JOIN part.variant w ON w.id = p.variant JOIN main.variant v ON v.settings = w.settings"
    " JOIN main.run r ON r.variant = v.id AND r.seed = p.seed WHERE r.hash != p.hash LIMIT 1";

/* Returns false with `error` if a run has another hash in the part than in the output. */
static bool check_hashes(const JoxSweepStore *store, const char *part, JoError *error) {
    sqlite3_stmt *s = jox_sweep_prepare(store, CLASH, error);
    if (!s)
        return false;
    const int code = sqlite3_step(s);
    if (code == SQLITE_ROW) {
        char settings[200];
        snprintf(settings, sizeof settings, "%s", (const char *)sqlite3_column_text(s, 0));
        for (char *c = settings; *c; c++)
            *c = *c == '\n' ? ' ' : *c;
        jox_error(error, JO_INPUT,
                  "%.200s: the run %s%sseed %lld ended with the state %s there, and with %s in "
                  "%.200s: the programs that made them are not the same",
                  part, settings, *settings ? " " : "", (long long)sqlite3_column_int64(s, 1),
                  (const char *)sqlite3_column_text(s, 3), (const char *)sqlite3_column_text(s, 2),
                  store->path);
    } else if (code != SQLITE_DONE) {
        jox_sweep_set_error(store, error);
    }
    jox_sweep_finalize(store, s);
    return code == SQLITE_DONE;
}

/* Stores what the runs of a part share; differences from the output go to `differences`. */
static bool compare_notes(const JoxSweepStore *store, const JoxSweepStore *part,
                          JoxText *differences, JoError *error) {
    sqlite3_stmt *s = jox_sweep_prepare(part, "SELECT key, value FROM sweep", error);
    int code = SQLITE_ERROR;
    bool good = s != NULL;
    while (good && (code = sqlite3_step(s)) == SQLITE_ROW) {
        const char *key = (const char *)sqlite3_column_text(s, 0);
        const char *value = (const char *)sqlite3_column_text(s, 1);
        good = key && value ? jox_sweep_note_value(store, key, value, differences, error)
                            : jox_sweep_refuse_damaged(part, error);
    }
    good = good && (code == SQLITE_DONE || jox_sweep_set_error(part, error));
    jox_sweep_finalize(part, s);
    if (!good || !(s = jox_sweep_prepare(part, "SELECT path, text FROM input", error)))
        return false;
    while (good && (code = sqlite3_step(s)) == SQLITE_ROW) {
        const char *path = (const char *)sqlite3_column_text(s, 0);
        const void *text = sqlite3_column_blob(s, 1);
        good = path ? jox_sweep_note_input(store, path, text, (size_t)sqlite3_column_bytes(s, 1),
                                           differences, error)
                    : jox_sweep_refuse_damaged(part, error);
    }
    good = good && (code == SQLITE_DONE || jox_sweep_set_error(part, error));
    jox_sweep_finalize(part, s);
    return good && jox_sweep_copy_plans(part, store, error);
}

/* Checks that a part belongs to the same sweep, and takes over what its runs share, and its plans.
 */
static bool is_same_sweep(const JoxSweepStore *store, const char *path, JoError *error) {
    JoxSweepStore part;
    JoxText differences = {0};
    bool good = jox_sweep_open_to_read(&part, path, error) && jox_sweep_is_whole(&part, error) &&
                compare_notes(store, &part, &differences, error);
    if (good && differences.length) {
        differences.data[differences.length - 1] = 0; /* the last end of line */
        jox_error(error, JO_INPUT, "%.200s belongs to another sweep than %.200s:\n%.500s", path,
                  store->path, differences.data);
        good = false;
    }
    jox_sweep_close(&part);
    jox_text_free(&differences);
    return good;
}

/* Merges one part: checks that it belongs to the same sweep, then copies its runs, each in a
   transaction. */
static bool merge_part(const JoxSweepStore *store, const char *path, JoError *error) {
    JoError ignored;
    bool good = jox_sweep_execute(store, "BEGIN IMMEDIATE", error) &&
                is_same_sweep(store, path, error) && jox_sweep_execute(store, "COMMIT", error);
    if (!good) {
        jox_sweep_execute(store, "ROLLBACK", &ignored);
        return false;
    }
    if (!jox_sweep_attach_part(store, path, error))
        return false;
    good = jox_sweep_execute(store, "BEGIN IMMEDIATE", error) && check_hashes(store, path, error) &&
           jox_sweep_execute(store, CHOOSE, error) && jox_sweep_execute(store, MOVE, error) &&
           jox_sweep_execute(store, "COMMIT", error);
    if (!good)
        jox_sweep_execute(store, "ROLLBACK", &ignored);
    jox_sweep_execute(store, "DETACH part", &ignored);
    return good;
}

static bool count_runs(const JoxSweepStore *store, JoxSweepState state, uint32_t *out,
                       JoError *error) {
    sqlite3_stmt *s = jox_sweep_prepare(store, "SELECT count(*) FROM run WHERE state = ?", error);
    if (!s)
        return false;
    sqlite3_bind_text(s, 1, jox_sweep_states[state], -1, SQLITE_STATIC);
    const bool good = sqlite3_step(s) == SQLITE_ROW || jox_sweep_set_error(store, error);
    *out = good ? (uint32_t)sqlite3_column_int64(s, 0) : 0;
    jox_sweep_finalize(store, s);
    return good;
}

/* ---- missing runs ---- */

/* Adds the runs that a part has to a list, which has their settings, seeds and states alone. Fails
   also if the part lacks another column that MOVE reads. */
static const char LIST[] =
    "SELECT reason, hash, steps, simulated_s, cpu_s, wall_s, summary FROM part.run LIMIT 0;"
    "SELECT variant, seed, name, value FROM part.figure LIMIT 0;"
    "SELECT id, name, unit FROM part.curve_name LIMIT 0;"
    "SELECT variant, seed, curve, time, value FROM part.curve_point LIMIT 0;"
    "SELECT variant, seed, name, unit, low_x, low_y, cell, columns, rows, cells FROM part.field"
    " LIMIT 0; SELECT plan FROM part.variant LIMIT 0;"
    "INSERT OR IGNORE INTO main.variant(settings) SELECT settings FROM part.variant;"
    "INSERT OR IGNORE INTO main.run(variant, seed, state) SELECT v.id, p.seed, p.state"
    " FROM part.run p JOIN part.variant w ON w.id = p.variant"
    " JOIN main.variant v ON v.settings = w.settings;";

/* Checks that a part is whole and belongs to the same sweep as those listed before, and lists its
   runs. */
static bool list_part(const JoxSweepStore *list, const char *path, JoError *error) {
    JoError ignored;
    JoxText name = {0};
    jox_text_add(&name, path);
    JoxSweepStore named = *list; /* errors name the part */
    named.path = name.data;
    bool good = is_same_sweep(list, path, error) && jox_sweep_attach_part(&named, path, error);
    if (good) {
        good = jox_sweep_execute(&named, LIST, error);
        jox_sweep_execute(list, "DETACH part", &ignored);
    }
    jox_text_free(&name);
    return good;
}

/* Counts the planned runs that neither the output nor a part has; their names are sent as a
   message. */
static bool find_missing_of_merge(const JoSweepMergeDef *def, uint32_t *missing, JoError *error) {
    JoxSweepStore list;
    JoxText lines = {0};
    struct stat info;
    bool good = jox_sweep_open(&list, NULL, error);
    const bool has_out = stat(def->out, &info) == 0 && info.st_size > 0;
    if (good) { /* for errors: the file that the others are compared with */
        jox_free(list.path);
        list.path = jox_strdup(has_out ? def->out : def->parts[0]);
        good = !has_out || list_part(&list, def->out, error);
    }
    for (size_t p = 0; good && p < def->part_count; p++)
        good = list_part(&list, def->parts[p], error);
    good = good && jox_sweep_find_missing(&list, missing, &lines, error);
    if (good && *missing) {
        JoxText text = {0};
        jox_text_printf(&text, "missing:\n%s", lines.data);
        jox_run_send_message(def->message, def->message_context, text.data);
        jox_text_free(&text);
    }
    jox_text_free(&lines);
    jox_sweep_close(&list);
    return good;
}

/* Brings a file to the disk; false with `error`. */
static bool sync_file(const char *path, JoError *error) {
    const int number = open(path, O_RDONLY | O_CLOEXEC);
    const bool good = number >= 0 && fsync(number) == 0;
    if (!good)
        jox_error(error, JO_FAILED, "cannot write '%.300s': %s", path, strerror(errno));
    if (number >= 0)
        close(number);
    return good;
}

/* Whether two paths name one file. */
static bool is_same_file(const char *one, const char *two) {
    struct stat a, b;
    return stat(one, &a) == 0 && stat(two, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/* Merges the parts, unless runs are missing and the def does not allow that. A new file is brought
   to the disk once, at its end, and not after each part: until then the parts have all runs. */
static bool merge_parts(const JoSweepMergeDef *def, JoSweepCounts *counts, JoError *error) {
    JoxSweepStore store;
    uint32_t done = 0;
    if (!find_missing_of_merge(def, &counts->missing, error))
        return false;
    if (counts->missing && !def->partial) {
        jox_error(error, JO_INPUT,
                  "%u planned %s missing, and nothing was merged into %.300s: do %s first, or "
                  "merge what there is by --partial",
                  counts->missing, counts->missing == 1 ? "run is" : "runs are", def->out,
                  counts->missing == 1 ? "it" : "them");
        return false;
    }
    struct stat info;
    const bool is_new = stat(def->out, &info) != 0 || info.st_size == 0;
    const bool opened = jox_sweep_open(&store, def->out, error);
    bool good = opened && (!is_new || jox_sweep_execute(&store, "PRAGMA synchronous=OFF", error));
    for (size_t p = 0; good && p < def->part_count; p++)
        good = is_same_file(def->parts[p], def->out) || merge_part(&store, def->parts[p], error);
    good = good && count_runs(&store, JOX_SWEEP_DONE, &done, error) &&
           count_runs(&store, JOX_SWEEP_TROUBLED, &counts->troubled, error) &&
           count_runs(&store, JOX_SWEEP_FAILED, &counts->failed, error);
    if (opened && !good && is_new)
        unlink(def->out); /* the parts have all runs */
    counts->done = done + counts->troubled;
    counts->runs = counts->done + counts->failed + counts->missing;
    jox_sweep_close(&store);
    return good && (!is_new || sync_file(def->out, error));
}

enum { MERGE_COOKIE = 0x4a4f4d47 };

JoSweepMergeDef jo_default_sweep_merge_def(void) {
    return (JoSweepMergeDef){.cookie = MERGE_COOKIE};
}

bool jo_sweep_merge(const JoSweepMergeDef *def, JoSweepCounts *counts, JoError *error) {
    JOX_REQUIRE(def && def->cookie == MERGE_COOKIE && def->out && counts, false);
    JOX_REQUIRE(def->parts && def->part_count > 0, false);
    JOX_GUARD (NULL, error)
        return false;
    *counts = (JoSweepCounts){0};
    return merge_parts(def, counts, error);
}
