/* SQLite files that strangers may have written. Tables alone are read: no view, trigger, virtual
   table or computed column of a file runs. Recordings are read and written through it. A connection
   is held by the heap in use (jox_heap_register) while it is open. */
#ifndef JOX_BASE_DATABASE_H
#define JOX_BASE_DATABASE_H

#include <sqlite3.h>
#include <stdbool.h>

#include "base/text.h"

enum {
    /* How long a statement waits while another program has the file locked, ms; then it fails with
       SQLITE_BUSY. */
    JOX_DATABASE_PATIENCE = 5000,
    JOX_DATABASE_STATEMENTS = 16 /* the most statements of a connection at a time */
};

typedef enum JoxDatabaseUse { JOX_DATABASE_READ, JOX_DATABASE_WRITE } JoxDatabaseUse;

/* One connection, used by one thread at a time. */
typedef struct JoxDatabase {
    sqlite3 *sqlite;
    sqlite3_stmt *statements[JOX_DATABASE_STATEMENTS]; /* prepared ones; NULL: a free place */
    const char *const *tables; /* names of tables that statements may use, up to a NULL */
    double left;               /* calls of the progress handler until a bounded database gives up */
} JoxDatabase;

/* Opens a file. JOX_DATABASE_WRITE makes it if it does not exist; a NULL path is a database in
   memory. Statements can use tables after jox_database_allow has checked them. NULL with a sentence
   in `why` if the file cannot be opened. */
JoxDatabase *jox_database_open(const char *path, JoxDatabaseUse use, JoxText *why);
/* Lets statements use these tables (names up to a NULL; the list must outlive the connection),
   whether or not the file has them. False with a sentence in `why`, and no table allowed, if one of
   them is a virtual table or has a computed column, or if the file cannot be read. A view counts as
   missing. */
bool jox_database_allow(JoxDatabase *db, const char *const *tables, JoxText *why);
/* Prepares a statement; NULL if SQLite refuses it, for a reason that sqlite3_errmsg gives.
   Allocates by SQLite alone, so that it never leaves by a recovery point. */
sqlite3_stmt *jox_database_prepare(JoxDatabase *db, const char *sql);
/* Finalizes a statement of jox_database_prepare; NULL is fine. */
void jox_database_finalize(JoxDatabase *db, sqlite3_stmt *statement);
/* Turns a bound on work on or off. All statements together may then do as much work as reading the
   whole file about ten times; beyond that they fail with SQLITE_INTERRUPT. */
void jox_database_bound(JoxDatabase *db, bool bounded);
/* Finalizes the statements that are left and closes the connection; NULL is fine. */
void jox_database_close(JoxDatabase *db);

#endif
