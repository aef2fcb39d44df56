#include "base/database.h"

#include <errno.h>
#include <stdio.h>
#include <sys/stat.h>

#include "base/file.h"
#include "base/mem.h"

enum {
    LONGEST = 64 << 20,     /* bytes of a text */
    LONGEST_SQL = 64 << 10, /* and of a statement of the schema */
    OPERATIONS = 100000     /* of SQLite between two calls of `spend` */
};
/* How many such calls a bounded database has: in all, and for each MB of the file. A row takes some
   10 operations and 40 bytes, so that a pass over all rows takes some 3 a MB. */
static const double LEAST_CALLS = 1000, CALLS_PER_MB = 30;

/* Whether a bounded database has done all that it may. */
static int spend(void *left) {
    return --*(double *)left < 0.0;
}

static void release(void *db) {
    sqlite3_stmt *statement;
    while ((statement = sqlite3_next_stmt(db, NULL)))
        sqlite3_finalize(statement);
    sqlite3_close(db);
}

/* Held, and restricted, from here on. */
static void restrict_it(sqlite3 *db) {
    static const int OFF[] = {SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_ENABLE_TRIGGER,
                              SQLITE_DBCONFIG_TRUSTED_SCHEMA};
    if (!db)
        jox_out_of_memory(0);
    jox_hold(db, release);
    for (size_t k = 0; k < sizeof OFF / sizeof *OFF; k++)
        sqlite3_db_config(db, OFF[k], 0, NULL);
    sqlite3_db_config(db, SQLITE_DBCONFIG_DEFENSIVE, 1, NULL);
    sqlite3_busy_timeout(db, JOX_DATABASE_PATIENCE);
    sqlite3_limit(db, SQLITE_LIMIT_LENGTH, LONGEST);
    sqlite3_limit(db, SQLITE_LIMIT_SQL_LENGTH, LONGEST_SQL);
    /* What is sorted stays in memory: who is confined may write no other file. */
    sqlite3_exec(db, "PRAGMA temp_store=MEMORY", NULL, NULL, NULL);
}

bool jox_database_open(const char *path, sqlite3 **db) {
    FILE *file = jox_file_open(path, "rb"); /* SQLite would wait for a pipe */
    const bool regular = file || errno != EINVAL;
    if (file)
        jox_file_close(file);
    const bool good =
        sqlite3_open_v2(regular ? path : "", db, SQLITE_OPEN_READONLY, NULL) == SQLITE_OK;
    restrict_it(*db);
    return good && regular;
}

bool jox_database_open_to_write(const char *path, sqlite3 **db) {
    const int how = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    const bool good = sqlite3_open_v2(path ? path : ":memory:", db, how, NULL) == SQLITE_OK;
    restrict_it(*db);
    return good;
}

void jox_database_bound(sqlite3 *db, double *left) {
    struct stat info;
    const char *path = sqlite3_db_filename(db, "main");
    if (left)
        *left = LEAST_CALLS;
    if (left && path && stat(path, &info) == 0)
        *left += CALLS_PER_MB * (double)info.st_size / (1 << 20);
    sqlite3_progress_handler(db, left ? OPERATIONS : 0, left ? spend : NULL, left);
}

void jox_database_close(sqlite3 *db) {
    if (!db)
        return;
    jox_let_go(db);
    release(db);
}
