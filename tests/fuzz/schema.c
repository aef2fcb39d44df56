/* Makes a database by any SQL and reads it as a recording: hostile schemas and rows in well-formed
   files. */
#include <sqlite3.h>
#include <stdlib.h>
#include <unistd.h>

#include "support/recording.h"

/* Denies SQL that would open other files. */
static int deny_other_files(void *context, int action, const char *a, const char *b, const char *c,
                            const char *d) {
    (void)context;
    (void)a;
    (void)b;
    (void)c;
    (void)d;
    return action == SQLITE_ATTACH || action == SQLITE_DETACH ? SQLITE_DENY : SQLITE_OK;
}

/* Stops SQL that takes too long. */
static int stop_long_sql(void *context) {
    int *left = context;
    return --*left < 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const char *path = fuzz_path("s.sqlite");
    sqlite3 *db = NULL;
    int left = 200;
    unlink(path);
    if (sqlite3_open(path, &db) != SQLITE_OK)
        abort();
    char *sql = fuzz_text(data, size);
    sqlite3_limit(db, SQLITE_LIMIT_LENGTH, 1 << 20);
    sqlite3_set_authorizer(db, deny_other_files, NULL);
    sqlite3_progress_handler(db, 1000, stop_long_sql, &left);
    sqlite3_exec(db, "PRAGMA synchronous = OFF; PRAGMA journal_mode = MEMORY", NULL, NULL, NULL);
    sqlite3_exec(db, sql, NULL, NULL, NULL);
    sqlite3_exec(db, "COMMIT", NULL, NULL, NULL);
    sqlite3_close(db);
    free(sql);
    fuzz_recording(path);
    return 0;
}
