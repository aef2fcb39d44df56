/* Which file a recording is written to. */
#include "record/recorder_file.h"

#include <errno.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/database.h"
#include "base/file.h"

bool jox_is_recording(const char *path) {
    sqlite3 *db = NULL;
    sqlite3_stmt *statement = NULL;
    bool found = jox_database_open(path, &db) &&
                 sqlite3_prepare_v2(db, "SELECT number FROM jostle_state LIMIT 1", -1, &statement,
                                    NULL) == SQLITE_OK;
    jox_database_close(db); /* and its statement */
    return found;
}

FILE *jox_claim_recording(const char *path, JoxText *error) {
    struct stat info;
    const bool there = lstat(path, &info) == 0;
    if (there && (!S_ISREG(info.st_mode) || (info.st_size > 0 && !jox_is_recording(path)))) {
        jox_text_printf(error, "'%s' is not a recording of Jostle's and is not replaced", path);
        return NULL;
    }
    FILE *file = jox_file_open(path, "a");
    if (file && there) {
        for (int i = 0; i < 2; i++) { /* what a run that was killed left beside it */
            JoxText side = {0};
            jox_text_printf(&side, "%s-%s", path, i ? "shm" : "wal");
            unlink(side.data);
            jox_text_free(&side);
        }
        unlink(path);
        FILE *fresh = jox_file_open(path, "a");
        jox_file_close(file);
        file = fresh;
    }
    if (!file)
        jox_text_printf(error, "cannot record to '%s': %s", path, jox_file_why(errno));
    return file;
}
