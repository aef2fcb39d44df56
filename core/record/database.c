#include "record/database.h"

#include "base/mem.h"

static void release(void *db) {
    sqlite3_stmt *statement;
    while ((statement = sqlite3_next_stmt(db, NULL)))
        sqlite3_finalize(statement);
    sqlite3_close(db);
}

bool jox_database_open(const char *path, sqlite3 **db) {
    const bool good = sqlite3_open_v2(path, db, SQLITE_OPEN_READONLY, NULL) == SQLITE_OK;
    if (!*db)
        jox_out_of_memory(0);
    jox_hold(*db, release);
    return good;
}

void jox_database_close(sqlite3 *db) {
    if (!db)
        return;
    jox_let_go(db);
    release(db);
}
