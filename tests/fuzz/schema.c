/* Any SQL as the schema and the rows of a recording: what a hostile database can hold, in files of
   good form. */
#include <sqlite3.h>
#include <stdlib.h>
#include <unistd.h>

#include "support/recording.h"

/* The making of the file is no part of the test: it may touch no other file, and is short. */
static int allow(void *context, int action, const char *a, const char *b, const char *c,
                 const char *d) {
    (void)context;
    (void)a;
    (void)b;
    (void)c;
    (void)d;
    return action == SQLITE_ATTACH || action == SQLITE_DETACH ? SQLITE_DENY : SQLITE_OK;
}

static int give_up(void *context) {
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
    sqlite3_set_authorizer(db, allow, NULL);
    sqlite3_progress_handler(db, 1000, give_up, &left);
    sqlite3_exec(db, "PRAGMA synchronous = OFF; PRAGMA journal_mode = MEMORY", NULL, NULL, NULL);
    sqlite3_exec(db, sql, NULL, NULL, NULL);
    sqlite3_exec(db, "COMMIT", NULL, NULL, NULL);
    sqlite3_close(db);
    free(sql);
    fuzz_recording(path);
    return 0;
}
