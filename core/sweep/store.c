#include "sweep/store.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "base/guard.h"
#include "base/hash.h"

/* Header field of the SQLite file: the id "JSwp". */
#define APPLICATION "1246984048"
/* A format that is read, and continued: it lacks the table `planned`. */
#define FORMER_FORMAT "1"

static const char SCHEMA[] =
    "BEGIN;"
    "CREATE TABLE sweep(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;" JOX_SWEEP_PLANNED
    "CREATE TABLE input(path TEXT PRIMARY KEY, sha256 TEXT NOT NULL, text BLOB NOT NULL);"
    "CREATE TABLE variant(id INTEGER PRIMARY KEY, settings TEXT NOT NULL UNIQUE, plan TEXT);"
    "CREATE TABLE run(variant INTEGER NOT NULL, seed INTEGER NOT NULL, state TEXT NOT NULL,"
    " reason TEXT, hash TEXT, steps INTEGER, simulated_s REAL, cpu_s REAL, wall_s REAL,"
    " summary TEXT, PRIMARY KEY(variant, seed));"
    "CREATE TABLE figure(variant INTEGER NOT NULL, seed INTEGER NOT NULL, name TEXT NOT NULL,"
    " value REAL, PRIMARY KEY(variant, seed, name)) WITHOUT ROWID;"
    "CREATE TABLE curve_name(id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, unit TEXT);"
    "CREATE TABLE curve_point(variant INTEGER NOT NULL, seed INTEGER NOT NULL, curve INTEGER NOT"
    " NULL, time REAL NOT NULL, value REAL, PRIMARY KEY(variant, seed, curve, time)) WITHOUT ROWID;"
    "CREATE TABLE field(variant INTEGER NOT NULL, seed INTEGER NOT NULL, name TEXT NOT NULL,"
    " unit TEXT, low_x REAL, low_y REAL, cell REAL, columns INTEGER, rows INTEGER, cells BLOB,"
    " PRIMARY KEY(variant, seed, name));"
    "PRAGMA application_id=" APPLICATION ";PRAGMA user_version=" JOX_SWEEP_FORMAT ";"
    "COMMIT";
static const char *const TABLES[] = {"sweep",  "planned",    "input",       "variant", "run",
                                     "figure", "curve_name", "curve_point", "field",   NULL};

bool jox_sweep_set_error(const JoxSweepStore *store, JoError *error) {
    const int code = sqlite3_errcode(store->db->sqlite) & 0xff;
    const bool bad = code == SQLITE_CORRUPT || code == SQLITE_NOTADB || code == SQLITE_ERROR ||
                     code == SQLITE_MISMATCH;
    jox_error(error, bad ? JO_INPUT : JO_FAILED, "%.300s: %.150s%s", store->path,
              sqlite3_errmsg(store->db->sqlite),
              code == SQLITE_FULL || code == SQLITE_IOERR
                  ? "; finished runs are kept, and the same command continues with them"
              : bad ? "; the file is damaged: move it away, and its runs are done again"
                    : "");
    return false;
}

sqlite3_stmt *jox_sweep_prepare(const JoxSweepStore *store, const char *sql, JoError *error) {
    sqlite3_stmt *statement = jox_database_prepare(store->db, sql);
    if (!statement)
        jox_sweep_set_error(store, error);
    return statement;
}

void jox_sweep_finalize(const JoxSweepStore *store, sqlite3_stmt *statement) {
    jox_database_finalize(store->db, statement);
}

bool jox_sweep_execute(const JoxSweepStore *store, const char *sql, JoError *error) {
    return sqlite3_exec(store->db->sqlite, sql, NULL, NULL, NULL) == SQLITE_OK ||
           jox_sweep_set_error(store, error);
}

bool jox_sweep_step_once(const JoxSweepStore *store, sqlite3_stmt *statement, JoError *error) {
    const bool good = statement && sqlite3_step(statement) == SQLITE_DONE;
    if (statement && !good)
        jox_sweep_set_error(store, error);
    jox_sweep_finalize(store, statement);
    return good;
}

/* ---- opening ---- */

/* Reads a pragma that returns a whole number; -1 if it returns none. */
static int64_t read_pragma(const JoxSweepStore *store, const char *pragma) {
    sqlite3_stmt *s = jox_database_prepare(store->db, pragma);
    int64_t value = -1;
    if (s && sqlite3_step(s) == SQLITE_ROW)
        value = sqlite3_column_int64(s, 0);
    jox_sweep_finalize(store, s);
    return value;
}

static bool check_format(const JoxSweepStore *store, JoError *error) {
    char text[24];
    snprintf(text, sizeof text, "%lld", (long long)read_pragma(store, "PRAGMA application_id"));
    if (strcmp(text, APPLICATION) != 0) {
        const int code = sqlite3_errcode(store->db->sqlite) & 0xff;
        if (code == SQLITE_CORRUPT)
            return jox_sweep_set_error(store, error);
        jox_error(error, JO_INPUT, "%.300s is no file of `jostle sweep`%s; it is left as it is",
                  store->path, code == SQLITE_NOTADB ? ", nor any SQLite database" : "");
        return false;
    }
    snprintf(text, sizeof text, "%lld", (long long)read_pragma(store, "PRAGMA user_version"));
    if (strcmp(text, JOX_SWEEP_FORMAT) == 0 || strcmp(text, FORMER_FORMAT) == 0)
        return true;
    jox_error(error, JO_INPUT, "%.300s is a sweep's file of format %s, and this program has %s",
              store->path, text, JOX_SWEEP_FORMAT);
    return false;
}

/* Opens the database; false with `error`. */
static bool connect_database(JoxSweepStore *store, const char *path, JoxDatabaseUse use,
                             JoError *error) {
    JoxText why = {0};
    store->db = jox_database_open(path, use, &why);
    if (!store->db)
        jox_error(error, use == JOX_DATABASE_READ ? JO_INPUT : JO_FAILED, "cannot %s '%.300s': %s",
                  use == JOX_DATABASE_READ ? "read" : "write", store->path, why.data);
    jox_text_free(&why);
    return store->db != NULL;
}

/* Restricts statements to the tables of a sweep; false with `error`. */
static bool restrict_tables(const JoxSweepStore *store, JoError *error) {
    JoxText why = {0};
    const bool good = jox_database_allow(store->db, TABLES, &why);
    if (!good)
        jox_error(error, JO_INPUT, "%.300s: %s", store->path, why.data);
    jox_text_free(&why);
    return good;
}

/* Creates the tables in an empty file; checks the format of any other. */
static bool prepare_tables(const JoxSweepStore *store, JoError *error) {
    if (read_pragma(store, "PRAGMA schema_version") == 0 &&
        read_pragma(store, "PRAGMA application_id") == 0)
        return restrict_tables(store, error) && jox_sweep_execute(store, SCHEMA, error);
    return check_format(store, error) && restrict_tables(store, error);
}

bool jox_sweep_open(JoxSweepStore *store, const char *path, JoError *error) {
    struct stat info;
    *store = (JoxSweepStore){.path = jox_strdup(path ? path : "")};
    if (path && lstat(path, &info) == 0 && !S_ISREG(info.st_mode)) {
        jox_error(error, JO_FAILED, "cannot write '%.300s': it is no regular file", path);
        return false;
    }
    if (path && !(store->claim = jox_file_open(path, "a"))) {
        jox_error(error, JO_FAILED, "cannot write '%.300s': %s", path,
                  errno == EBUSY ? "another sweep writes it" : jox_file_error_text(errno));
        return false;
    }
    return connect_database(store, path, JOX_DATABASE_WRITE, error) && prepare_tables(store, error);
}

bool jox_sweep_open_to_read(JoxSweepStore *store, const char *path, JoError *error) {
    *store = (JoxSweepStore){.path = jox_strdup(path)};
    return connect_database(store, path, JOX_DATABASE_READ, error) && check_format(store, error) &&
           restrict_tables(store, error);
}

bool jox_sweep_open_in_memory(JoxSweepStore *store, const char *path, JoError *error) {
    *store = (JoxSweepStore){.path = jox_strdup(path)};
    if (!jox_file_can_be_written(path)) {
        jox_error(error, JO_FAILED, "cannot write '%.300s': %s", path, jox_file_error_text(errno));
        return false;
    }
    return connect_database(store, NULL, JOX_DATABASE_WRITE, error) && prepare_tables(store, error);
}

bool jox_sweep_write_file(const JoxSweepStore *store, JoError *error) {
    sqlite3_int64 size = 0;
    unsigned char *bytes = sqlite3_serialize(store->db->sqlite, "main", &size, 0);
    if (!bytes)
        return jox_sweep_set_error(store, error);
    FILE *file = jox_file_replace(store->path);
    bool good = file && fwrite(bytes, 1, (size_t)size, file) == (size_t)size;
    good = good && fflush(file) == 0 && fsync(fileno(file)) == 0;
    const int why = errno;
    if (file && (good ? jox_file_close(file) : jox_file_drop(file)) != 0 && good)
        good = false;
    else
        errno = why;
    sqlite3_free(bytes);
    if (!good)
        jox_error(error, JO_FAILED, "cannot write '%.300s': %s", store->path,
                  jox_file_error_text(errno));
    return good;
}

bool jox_sweep_attach_part(const JoxSweepStore *store, const char *path, JoError *error) {
    sqlite3_stmt *s = jox_sweep_prepare(store, "ATTACH ? AS part", error);
    if (s)
        sqlite3_bind_text(s, 1, path, -1, SQLITE_STATIC);
    return jox_sweep_step_once(store, s, error);
}

bool jox_sweep_refuse_damaged(const JoxSweepStore *part, JoError *error) {
    jox_error(error, JO_INPUT, "%.300s: the file is damaged: remove it, and do its runs again",
              part->path);
    return false;
}

bool jox_sweep_is_whole(const JoxSweepStore *part, JoError *error) {
    sqlite3_stmt *s = jox_sweep_prepare(part, "PRAGMA quick_check(1)", error);
    const int code = s ? sqlite3_step(s) : SQLITE_ERROR;
    const bool good = code == SQLITE_ROW && !strcmp((const char *)sqlite3_column_text(s, 0), "ok");
    if (s && !good)
        jox_sweep_refuse_damaged(part, error);
    jox_sweep_finalize(part, s);
    return good;
}

void jox_sweep_close(JoxSweepStore *store) {
    jox_database_close(store->db);
    /* Closed after the database, because closing any descriptor of a file drops the process's locks
       on it. */
    if (store->claim)
        jox_file_close(store->claim);
    jox_free(store->path);
    *store = (JoxSweepStore){0};
}

/* ---- what all runs share ---- */

/* Runs a query for one text by its key. *found is to be freed; NULL: no row. Returns false with
   `error`. */
static bool find_text(const JoxSweepStore *store, const char *sql, const char *key, char **found,
                      JoError *error) {
    sqlite3_stmt *s = jox_sweep_prepare(store, sql, error);
    *found = NULL;
    if (!s)
        return false;
    sqlite3_bind_text(s, 1, key, -1, SQLITE_STATIC);
    const int code = sqlite3_step(s);
    const char *text = code == SQLITE_ROW ? (const char *)sqlite3_column_text(s, 0) : NULL;
    if (text)
        *found = jox_strdup(text);
    const bool good =
        code == SQLITE_ROW || code == SQLITE_DONE || jox_sweep_set_error(store, error);
    jox_sweep_finalize(store, s);
    return good;
}

bool jox_sweep_note_value(const JoxSweepStore *store, const char *key, const char *value,
                          JoxText *differences, JoError *error) {
    char *found;
    if (!find_text(store, "SELECT value FROM sweep WHERE key = ?", key, &found, error))
        return false;
    if (found && strcmp(found, value) != 0)
        jox_text_printf(differences, "  %s: %s there, %s now\n", key, *found ? found : "none",
                        *value ? value : "none");
    const bool there = found != NULL;
    jox_free(found);
    if (there)
        return true;
    sqlite3_stmt *s = jox_sweep_prepare(store, "INSERT INTO sweep VALUES(?, ?)", error);
    if (s) {
        sqlite3_bind_text(s, 1, key, -1, SQLITE_STATIC);
        sqlite3_bind_text(s, 2, value, -1, SQLITE_STATIC);
    }
    return jox_sweep_step_once(store, s, error);
}

bool jox_sweep_note_input(const JoxSweepStore *store, const char *path, const char *text,
                          size_t length, JoxText *differences, JoError *error) {
    char *found, sha256[65];
    jox_sha256_hex(text, length, sha256);
    if (!find_text(store, "SELECT sha256 FROM input WHERE path = ?", path, &found, error))
        return false;
    if (found && strcmp(found, sha256) != 0)
        jox_text_printf(differences, "  %s has changed: SHA-256 %.12s... there, %.12s... now\n",
                        path, found, sha256);
    const bool there = found != NULL;
    jox_free(found);
    if (there)
        return true;
    sqlite3_stmt *s = jox_sweep_prepare(store, "INSERT INTO input VALUES(?, ?, ?)", error);
    if (s) {
        sqlite3_bind_text(s, 1, path, -1, SQLITE_STATIC);
        sqlite3_bind_text(s, 2, sha256, -1, SQLITE_STATIC);
        sqlite3_bind_blob(s, 3, text ? text : "", (int)length, SQLITE_STATIC);
    }
    return jox_sweep_step_once(store, s, error);
}

bool jox_sweep_find_variant(const JoxSweepStore *store, const char *key, int64_t *id,
                            JoError *error) {
    sqlite3_stmt *s = jox_sweep_prepare(
        store, "INSERT INTO variant(settings) VALUES(?) ON CONFLICT DO NOTHING", error);
    if (s)
        sqlite3_bind_text(s, 1, key, -1, SQLITE_STATIC);
    if (!jox_sweep_step_once(store, s, error) ||
        !(s = jox_sweep_prepare(store, "SELECT id FROM variant WHERE settings = ?", error)))
        return false;
    sqlite3_bind_text(s, 1, key, -1, SQLITE_STATIC);
    const bool good = sqlite3_step(s) == SQLITE_ROW || jox_sweep_set_error(store, error);
    *id = good ? sqlite3_column_int64(s, 0) : 0;
    jox_sweep_finalize(store, s);
    return good;
}

/* Reads the state that a statement finds, and finalizes it. */
static bool read_state(const JoxSweepStore *store, sqlite3_stmt *s, int *state, JoError *error) {
    const int code = sqlite3_step(s);
    const char *text = code == SQLITE_ROW ? (const char *)sqlite3_column_text(s, 0) : NULL;
    for (int k = 0; text && k < 3; k++)
        if (strcmp(text, jox_sweep_states[k]) == 0)
            *state = k;
    const bool good =
        code == SQLITE_ROW || code == SQLITE_DONE || jox_sweep_set_error(store, error);
    jox_sweep_finalize(store, s);
    return good;
}

bool jox_sweep_find_state(const JoxSweepStore *store, int64_t variant, uint64_t seed, int *state,
                          JoError *error) {
    sqlite3_stmt *s =
        jox_sweep_prepare(store, "SELECT state FROM run WHERE variant = ? AND seed = ?", error);
    *state = -1;
    if (!s)
        return false;
    sqlite3_bind_int64(s, 1, variant);
    sqlite3_bind_int64(s, 2, (sqlite3_int64)seed);
    return read_state(store, s, state, error);
}

bool jox_sweep_find_run(const JoxSweepStore *store, const char *key, uint64_t seed, int *state,
                        JoError *error) {
    sqlite3_stmt *s = jox_sweep_prepare(store,
                                        "SELECT r.state FROM run r JOIN variant v ON v.id = "
                                        "r.variant WHERE v.settings = ? AND r.seed = ?",
                                        error);
    *state = -1;
    if (!s)
        return false;
    sqlite3_bind_text(s, 1, key, -1, SQLITE_STATIC);
    sqlite3_bind_int64(s, 2, (sqlite3_int64)seed);
    return read_state(store, s, state, error);
}
