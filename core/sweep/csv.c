/* Writes the runs of a sweep as a CSV table for spreadsheets and scripts: `jostle sweep --csv`. */
#include <errno.h>
#include <string.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/format/quote.h"
#include "base/guard.h"
#include "sweep/store.h"

typedef struct Names {
    char **items;
    size_t count, capacity;
} Names;

static void add_column_name(Names *names, const char *name, size_t length) {
    for (size_t n = 0; n < names->count; n++)
        if (strlen(names->items[n]) == length && strncmp(names->items[n], name, length) == 0)
            return;
    JOX_RESERVE(names->items, names->capacity, names->count + 1);
    names->items[names->count++] = jox_strndup(name, length);
}

static void free_names(Names *names) {
    for (size_t n = 0; n < names->count; n++)
        jox_free(names->items[n]);
    jox_free(names->items);
}

static const char *get_column_text(sqlite3_stmt *s, int column) {
    const char *text = (const char *)sqlite3_column_text(s, column);
    return text ? text : "";
}

/* Collects the columns: every path that a variant sets, in order of appearance, and the names of
   all figures, sorted by bytes. */
static bool find_columns(const JoxSweepStore *store, Names *paths, Names *figures, JoError *error) {
    sqlite3_stmt *s = jox_sweep_prepare(store, "SELECT settings FROM variant ORDER BY id", error);
    int code = SQLITE_ERROR;
    while (s && (code = sqlite3_step(s)) == SQLITE_ROW)
        for (const char *line = get_column_text(s, 0); *line;) {
            add_column_name(paths, line, strcspn(line, "="));
            line += strcspn(line, "\n");
            line += *line == '\n';
        }
    jox_sweep_finalize(store, s);
    if (code != SQLITE_DONE ||
        !(s = jox_sweep_prepare(store, "SELECT DISTINCT name FROM figure ORDER BY name", error)))
        return s && jox_sweep_set_error(store, error);
    while ((code = sqlite3_step(s)) == SQLITE_ROW) {
        JOX_RESERVE(figures->items, figures->capacity, figures->count + 1);
        figures->items[figures->count++] = jox_strdup(get_column_text(s, 0));
    }
    jox_sweep_finalize(store, s);
    return code == SQLITE_DONE || jox_sweep_set_error(store, error);
}

static void write_head_row(FILE *out, const Names *paths, const Names *figures) {
    for (size_t p = 0; p < paths->count; p++) {
        jox_quote_put(out, jox_quote_csv, paths->items[p]);
        fputc(',', out);
    }
    fputs("seed,state,reason,hash,steps,simulated_s", out);
    for (size_t f = 0; f < figures->count; f++) {
        fputc(',', out);
        jox_quote_put(out, jox_quote_csv, figures->items[f]);
    }
    fputc('\n', out);
}

/* Writes the value that the settings of a variant (one a line) give to `path`; nothing if none. */
static void write_setting(FILE *out, const char *settings, const char *path) {
    const size_t n = strlen(path);
    for (const char *line = settings; *line;) {
        const size_t all = strcspn(line, "\n");
        if (strncmp(line, path, n) == 0 && line[n] == '=') {
            char *value = jox_strndup(line + n + 1, all - n - 1);
            jox_quote_put(out, jox_quote_csv, value);
            jox_free(value);
            return;
        }
        line += all;
        line += *line == '\n';
    }
}

/* Writes the figures of one run, one cell each. The rows of `figure` and the columns have the same
   order. */
static bool write_figure_cells(const JoxSweepStore *store, FILE *out, sqlite3_stmt *figure,
                               const Names *figures, JoError *error) {
    int code = sqlite3_step(figure);
    for (size_t f = 0; f < figures->count; f++) {
        fputc(',', out);
        if (code != SQLITE_ROW || strcmp(get_column_text(figure, 0), figures->items[f]) != 0)
            continue;
        if (sqlite3_column_type(figure, 1) != SQLITE_NULL)
            fprintf(out, "%.9g", sqlite3_column_double(figure, 1));
        code = sqlite3_step(figure);
    }
    sqlite3_reset(figure);
    fputc('\n', out);
    return code == SQLITE_ROW || code == SQLITE_DONE || jox_sweep_set_error(store, error);
}

static bool write_run_rows(const JoxSweepStore *store, FILE *out, const Names *paths,
                           const Names *figures, JoError *error) {
    sqlite3_stmt *run = jox_sweep_prepare(
        store,
        "SELECT v.settings, r.variant, r.seed, r.state, r.reason, r.hash, r.steps, r.simulated_s"
        " FROM run r JOIN variant v ON v.id = r.variant ORDER BY r.variant, r.seed",
        error);
    sqlite3_stmt *figure =
        run ? jox_sweep_prepare(store,
                                "SELECT name, value FROM figure WHERE variant = ? AND seed = ?"
                                " ORDER BY name",
                                error)
            : NULL;
    int code = SQLITE_DONE;
    bool good = figure != NULL;
    while (good && (code = sqlite3_step(run)) == SQLITE_ROW) {
        for (size_t p = 0; p < paths->count; p++) {
            write_setting(out, get_column_text(run, 0), paths->items[p]);
            fputc(',', out);
        }
        for (int c = 2; c < 8; c++) {
            fputs(c > 2 ? "," : "", out);
            jox_quote_put(out, jox_quote_csv, get_column_text(run, c));
        }
        sqlite3_bind_int64(figure, 1, sqlite3_column_int64(run, 1));
        sqlite3_bind_int64(figure, 2, sqlite3_column_int64(run, 2));
        good = write_figure_cells(store, out, figure, figures, error);
    }
    good = good && (code == SQLITE_DONE || jox_sweep_set_error(store, error));
    jox_sweep_finalize(store, run);
    jox_sweep_finalize(store, figure);
    return good;
}

/* Writes a row for each run, with a column for each setting and figure. */
static bool write_csv(const JoxSweepStore *store, FILE *out, JoError *error) {
    Names paths = {0}, figures = {0};
    bool good = find_columns(store, &paths, &figures, error);
    if (good)
        write_head_row(out, &paths, &figures);
    good = good && write_run_rows(store, out, &paths, &figures, error);
    free_names(&paths);
    free_names(&figures);
    return good;
}

bool jo_sweep_csv(const char *sweep, const char *csv, JoError *error) {
    JOX_REQUIRE(sweep && csv, false);
    JOX_GUARD (NULL, error)
        return false;
    JoxSweepStore store;
    const bool prints = strcmp(csv, "-") == 0;
    bool good = jox_sweep_open_to_read(&store, sweep, error);
    FILE *out = !good ? NULL : prints ? stdout : jox_file_replace(csv);
    if (good && !out)
        jox_error(error, JO_FAILED, "cannot write '%.300s': %s", csv, jox_file_error_text(errno));
    good = out && write_csv(&store, out, error);
    if (out && !prints && (good ? jox_file_close(out) : jox_file_drop(out)) != 0 && good) {
        jox_error(error, JO_FAILED, "cannot write '%.300s': %s", csv, strerror(errno));
        good = false;
    }
    jox_sweep_close(&store);
    return good;
}
