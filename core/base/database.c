#include "base/database.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/mem.h"

enum {
    LONGEST = 64 << 20,     /* greatest length of a text or blob, bytes */
    LONGEST_SQL = 64 << 10, /* greatest length of a statement or schema entry, bytes */
    OPERATIONS = 100000 /* virtual machine operations between two calls of the progress handler */
};
/* Calls of the progress handler that a bounded database has: at least, and per MB of the file. A
   row takes about 10 operations and 40 bytes, so that a pass over all rows takes about 3 calls per
   MB. */
static const double LEAST_CALLS = 1000, CALLS_PER_MB = 30;

/* The progress handler: counts a call, and interrupts the statement if the bound is used up. */
static int spend_call(void *database) {
    return --((JoxDatabase *)database)->left < 0.0;
}

static void release_database(void *database) {
    JoxDatabase *db = database;
    for (int k = 0; k < JOX_DATABASE_STATEMENTS; k++)
        sqlite3_finalize(db->statements[k]);
    sqlite3_close_v2(db->sqlite);
}

/* ---- tables that statements may use ---- */

static bool is_allowed_table(const JoxDatabase *db, const char *table) {
    if (sqlite3_strnicmp(table, "sqlite_", 7) == 0) /* the schema, which is always a plain table */
        return true;
    for (size_t k = 0; db->tables && db->tables[k]; k++)
        if (sqlite3_stricmp(table, db->tables[k]) == 0)
            return true;
    return false;
}

/* SQLite's authorizer: denies tables that jox_database_allow has not checked. Temporary tables are
   this program's own. */
static int authorize(void *database, int action, const char *table, const char *column,
                     const char *schema, const char *view) {
    (void)column;
    (void)view;
    const bool names = action == SQLITE_READ || action == SQLITE_INSERT ||
                       action == SQLITE_UPDATE || action == SQLITE_DELETE;
    if (!names || !table || (schema && strcmp(schema, "temp") == 0) ||
        is_allowed_table(database, table))
        return SQLITE_OK;
    return SQLITE_DENY;
}

static bool fail_with_message(const JoxDatabase *db, JoxText *why) {
    jox_text_printf(why, "%.200s", sqlite3_errmsg(db->sqlite));
    return false;
}

/* Prepares a statement with one argument, which %Q in `format` quotes; NULL if SQLite refuses
   it. */
static sqlite3_stmt *prepare_pragma(JoxDatabase *db, const char *format, const char *argument) {
    char *sql = sqlite3_mprintf(format, argument);
    if (!sql)
        jox_out_of_memory(0);
    sqlite3_stmt *statement = jox_database_prepare(db, sql);
    sqlite3_free(sql);
    return statement;
}

/* Whether a table has no computed columns, which could call any function of SQLite. True also if
   SQLite does not know the table, or refuses it, as it does views here: it cannot be read then. */
static bool has_plain_columns(JoxDatabase *db, const char *table, JoxText *why) {
    enum { HIDDEN = 6, COMPUTED = 2 }; /* the pragma's column "hidden"; 2 and 3 are computed */
    sqlite3_stmt *columns = prepare_pragma(db, "PRAGMA main.table_xinfo(%Q)", table);
    int status = columns ? SQLITE_ROW : sqlite3_errcode(db->sqlite);
    bool plain = true;
    while (columns && plain && (status = sqlite3_step(columns)) == SQLITE_ROW)
        plain = sqlite3_column_int(columns, HIDDEN) < COMPUTED;
    if (!plain)
        jox_text_printf(why,
                        "its table '%s' has a computed column ('%.60s'), and no function of a file "
                        "is run. Copy its rows into a plain table",
                        table, (const char *)sqlite3_column_text(columns, 1));
    else if (status != SQLITE_DONE && (status & 0xff) != SQLITE_ERROR)
        plain = fail_with_message(db, why);
    jox_database_finalize(db, columns);
    return plain;
}

/* Whether a name is that of a plain table, or of nothing that can be read. A damaged schema may
   describe the table wrongly, so that its columns are checked in any case. */
static bool is_plain_table(JoxDatabase *db, const char *table, JoxText *why) {
    sqlite3_stmt *entry =
        prepare_pragma(db,
                       "SELECT 1 FROM main.sqlite_schema WHERE type = 'table' AND "
                       "lower(name) = lower(%Q) AND coalesce(rootpage, 0) <= 0",
                       table);
    const int status = entry ? sqlite3_step(entry) : SQLITE_ERROR;
    bool plain = status == SQLITE_DONE;
    if (status == SQLITE_ROW)
        jox_text_printf(why,
                        "its '%s' is a virtual table, as of FTS or R*Tree, which is not read. Copy "
                        "its rows into a plain table",
                        table);
    else if (!plain)
        fail_with_message(db, why);
    jox_database_finalize(db, entry);
    return plain && has_plain_columns(db, table, why);
}

bool jox_database_allow(JoxDatabase *db, const char *const *tables, JoxText *why) {
    db->tables = NULL;
    for (size_t k = 0; tables[k]; k++)
        if (!is_plain_table(db, tables[k], why))
            return false;
    db->tables = tables;
    return true;
}

/* ---- opening and closing ---- */

static void restrict_connection(JoxDatabase *db) {
    static const int OFF[] = {SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_ENABLE_TRIGGER,
                              SQLITE_DBCONFIG_TRUSTED_SCHEMA};
    for (size_t k = 0; k < sizeof OFF / sizeof *OFF; k++)
        sqlite3_db_config(db->sqlite, OFF[k], 0, NULL);
    sqlite3_db_config(db->sqlite, SQLITE_DBCONFIG_DEFENSIVE, 1, NULL);
    sqlite3_drop_modules(db->sqlite, NULL); /* no virtual table can be connected */
    sqlite3_set_authorizer(db->sqlite, authorize, db);
    sqlite3_busy_timeout(db->sqlite, JOX_DATABASE_PATIENCE);
    sqlite3_limit(db->sqlite, SQLITE_LIMIT_LENGTH, LONGEST);
    sqlite3_limit(db->sqlite, SQLITE_LIMIT_SQL_LENGTH, LONGEST_SQL);
    /* Sorting must not write temporary files: a confined process cannot. */
    sqlite3_exec(db->sqlite, "PRAGMA temp_store=MEMORY", NULL, NULL, NULL);
}

JoxDatabase *jox_database_open(const char *path, JoxDatabaseUse use, JoxText *why) {
    static const int HOW[] = {SQLITE_OPEN_READONLY, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE};
    if (path && use == JOX_DATABASE_READ) { /* refuses pipes, for whose data SQLite would wait */
        FILE *file = jox_file_open(path, "rb");
        if (!file) {
            jox_text_printf(why, "%s", jox_file_error_text(errno));
            return NULL;
        }
        jox_file_close(file);
    }
    JoxDatabase *db = jox_alloc(1, sizeof *db);
    const int status = sqlite3_open_v2(path ? path : ":memory:", &db->sqlite,
                                       HOW[use] | SQLITE_OPEN_NOMUTEX, NULL);
    if (!db->sqlite)
        jox_out_of_memory(0);
    jox_heap_register(db, release_database);
    if (status == SQLITE_OK) {
        restrict_connection(db);
        return db;
    }
    fail_with_message(db, why);
    jox_database_close(db);
    return NULL;
}

void jox_database_bound(JoxDatabase *db, bool bounded) {
    struct stat info;
    const char *path = sqlite3_db_filename(db->sqlite, "main");
    db->left = LEAST_CALLS;
    if (bounded && path && stat(path, &info) == 0)
        db->left += CALLS_PER_MB * (double)info.st_size / (1 << 20);
    sqlite3_progress_handler(db->sqlite, bounded ? OPERATIONS : 0, bounded ? spend_call : NULL, db);
}

void jox_database_close(JoxDatabase *db) {
    if (!db)
        return;
    jox_heap_unregister(db);
    release_database(db);
    jox_free(db);
}

/* ---- statements ---- */

/* Returns the place of a statement in the list, or the first free place for NULL; NULL if there is
   none. */
static sqlite3_stmt **find_statement_place(JoxDatabase *db, const sqlite3_stmt *statement) {
    for (int k = 0; k < JOX_DATABASE_STATEMENTS; k++)
        if (db->statements[k] == statement)
            return &db->statements[k];
    JOX_ASSERT(false);
    return NULL;
}

sqlite3_stmt *jox_database_prepare(JoxDatabase *db, const char *sql) {
    sqlite3_stmt **place = find_statement_place(db, NULL);
    if (!place)
        return NULL;
    sqlite3_prepare_v2(db->sqlite, sql, -1, place, NULL);
    return *place;
}

void jox_database_finalize(JoxDatabase *db, sqlite3_stmt *statement) {
    sqlite3_stmt **place = statement ? find_statement_place(db, statement) : NULL;
    if (place)
        *place = NULL;
    sqlite3_finalize(statement);
}
