/* Claims, replaces and closes the file of a recording, and holds its schema. */
#include "record/recorder_schema.h"

#include <errno.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"

enum {
    FOLD_PATIENCE = 500
}; /* ms: how long to wait at the end for other programs to close the file */

bool jox_is_recording(const char *path) {
    JoxText why = {0};
    JoxDatabase *db = jox_database_open(path, JOX_DATABASE_READ, &why);
    const bool found = db && jox_database_allow(db, jox_recording_tables, &why) &&
                       jox_database_prepare(db, "SELECT number FROM jostle_state LIMIT 1");
    jox_database_close(db); /* finalizes the statement, too */
    jox_text_free(&why);
    return found;
}

/* Returns whether another program reads a recording that an ended run left with a write-ahead log
   beside it. When that program closes the file, SQLite deletes the log by its name, which would
   then be the log of the next run. */
static bool is_read_elsewhere(const char *path) {
    JoxText why = {0};
    JoxDatabase *db = jox_database_open(path, JOX_DATABASE_WRITE, &why);
    if (db)
        sqlite3_busy_timeout(db->sqlite, 0);
    const bool busy = db && sqlite3_exec(db->sqlite, "PRAGMA journal_mode=DELETE", NULL, NULL,
                                         NULL) == SQLITE_BUSY;
    jox_database_close(db);
    jox_text_free(&why);
    return busy;
}

void jox_recording_remove(const char *path) {
    static const char *const BESIDE[] = {"wal", "shm", "journal"};
    for (size_t k = 0; k < sizeof BESIDE / sizeof *BESIDE; k++) {
        JoxText name = {0};
        jox_text_printf(&name, "%s-%s", path, BESIDE[k]);
        unlink(name.data);
        jox_text_free(&name);
    }
    unlink(path);
}

FILE *jox_recording_claim(const char *path, JoxText *error) {
    struct stat info;
    const bool there = lstat(path, &info) == 0;
    if (there && (!S_ISREG(info.st_mode) || (info.st_size > 0 && !jox_is_recording(path)))) {
        jox_text_printf(error, "'%s' is not a recording of Jostle's and is not replaced", path);
        return NULL;
    }
    FILE *file = jox_file_open(path, "a");
    if (file && there && info.st_size > 0 && is_read_elsewhere(path)) {
        jox_text_printf(error,
                        "another program reads the recording '%s': close it there, or record to "
                        "another file",
                        path);
        jox_file_close(file);
        return NULL;
    }
    if (file && there) {
        jox_recording_remove(path); /* and journals that a killed run left */
        FILE *fresh = jox_file_open(path, "a");
        jox_file_close(file);
        file = fresh;
    }
    if (!file)
        jox_text_printf(error, "cannot record to '%s': %s", path, jox_file_error_text(errno));
    return file;
}

bool jox_recording_has_name(FILE *claimed, const JoxDatabase *db) {
    const char *path = sqlite3_db_filename(db->sqlite, "main");
    return path && jox_file_has_name(claimed, path);
}

/* Journal mode OFF: if the run is killed now, no journal is left, which a reader without write
   access could not roll back. */
bool jox_recording_merge_log(JoxDatabase *database, JoxText *message) {
    sqlite3 *db = database->sqlite;
    /* Defensive mode would keep a journal. */
    sqlite3_db_config(db, SQLITE_DBCONFIG_DEFENSIVE, 0, NULL);
    sqlite3_busy_timeout(db, FOLD_PATIENCE);
    if (sqlite3_exec(db, "PRAGMA journal_mode=OFF", NULL, NULL, NULL) == SQLITE_OK)
        return true;
    const char *path = sqlite3_db_filename(db, "main");
    if (sqlite3_errcode(db) != SQLITE_BUSY || !path)
        return false;
    sqlite3_wal_checkpoint_v2(db, NULL, SQLITE_CHECKPOINT_FULL, NULL, NULL);
    jox_text_printf(message,
                    "the recording '%s' is whole, but another program has it open: keep '%s-wal' "
                    "beside it until that program closes it\n",
                    path, path);
    return true;
}

const char *const jox_recording_tables[] = {
    "trajectory_data", "metadata",     "geometry",    "frame_data",  "jostle_row",  "jostle_agent",
    "jostle_group",    "jostle_state", "jostle_body", "jostle_part", "jostle_wall", "jostle_storey",
    "jostle_stair",    "jostle_lift",  "jostle_stop", "jostle_car",  NULL};

/* SQLite stores small integers in one to four bytes and other numbers in eight. So jostle_row has
   positions, radii, breadths and depths in 0.1 mm, directions and angles in thousandths, and
   forces, compressions, loads and times since falls in tenths; the table of the format is a view of
   it, which its readers cannot tell from a table. Our columns stand beside those of the format. The
   primary key replaces the index of the format: rows are found by it and lie in its order. */
#define ON_STOREYS ", storey INTEGER NOT NULL, stair INTEGER NOT NULL"
#define SCHEMA(rows, more)                                                                         \
    "PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL; BEGIN;"                                   \
    "CREATE TABLE jostle_row(frame INTEGER NOT NULL, id INTEGER NOT NULL, x INTEGER NOT NULL,"     \
    " y INTEGER NOT NULL, facing_x INTEGER NOT NULL, facing_y INTEGER NOT NULL, force INTEGER,"    \
    " compression INTEGER, load INTEGER, state INTEGER, member INTEGER, radius INTEGER,"           \
    " chest INTEGER, breadth INTEGER, depth INTEGER, fallen INTEGER" more                          \
    ", PRIMARY KEY(frame, id))"                                                                    \
    " WITHOUT ROWID;"                                                                              \
    "CREATE VIEW trajectory_data AS " rows ";"                                                     \
    "CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);"            \
    "CREATE TABLE geometry(hash INTEGER NOT NULL UNIQUE, wkt TEXT NOT NULL);"                      \
    "CREATE TABLE frame_data(frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);"             \
    "CREATE TABLE jostle_group(number INTEGER PRIMARY KEY, name TEXT, colour TEXT, clothes TEXT);" \
    "CREATE TABLE jostle_state(number INTEGER PRIMARY KEY, machine TEXT, state TEXT, colour TEXT," \
    " pose TEXT);"                                                                                 \
    "CREATE TABLE jostle_body(frame INTEGER, id INTEGER, x REAL, y REAL, z REAL, qx REAL, qy "     \
    "REAL,"                                                                                        \
    " qz REAL, qw REAL" more ");"                                                                  \
    "CREATE TABLE jostle_part(frame INTEGER, id INTEGER, part INTEGER, kind INTEGER, size_x REAL," \
    " size_y REAL, size_z REAL, x REAL, y REAL, z REAL, qx REAL, qy REAL, qz REAL, qw REAL,"       \
    " corners TEXT, name TEXT, PRIMARY KEY(id, frame, part));"                                     \
    "CREATE TABLE jostle_wall(frame INTEGER, number INTEGER, name TEXT, solid INTEGER, closed "    \
    "INTEGER,"                                                                                     \
    " open INTEGER, height REAL, points TEXT, drawn REAL" more ", PRIMARY KEY(frame, number));"

const char jox_recording_schema[] = SCHEMA(JOX_RECORDED_ROWS, "");
const char jox_recording_storey_schema[] =
    SCHEMA(JOX_RECORDED_STOREY_ROWS, ON_STOREYS) "CREATE TABLE jostle_storey(number INTEGER "
                                                 "PRIMARY KEY, name TEXT, height REAL, area TEXT);"
                                                 "CREATE TABLE jostle_stair(number INTEGER PRIMARY "
                                                 "KEY, name TEXT, kind INTEGER, way INTEGER,"
                                                 " lower INTEGER, upper INTEGER, path TEXT, width "
                                                 "REAL, landings TEXT, rise REAL, belt REAL,"
                                                 " area TEXT);"
                                                 "CREATE TABLE jostle_lift(number INTEGER PRIMARY "
                                                 "KEY, name TEXT, capacity INTEGER, points TEXT);"
                                                 "CREATE TABLE jostle_stop(lift INTEGER, storey "
                                                 "INTEGER, door TEXT, PRIMARY KEY(lift, storey)) "
                                                 "WITHOUT ROWID;"
                                                 "CREATE TABLE jostle_car(frame INTEGER, lift "
                                                 "INTEGER, height REAL, open REAL, storey INTEGER,"
                                                 " people INTEGER, mode TEXT, PRIMARY KEY(frame, "
                                                 "lift)) WITHOUT ROWID;";
