/* SQLite files that others may have written, held (mem.h) while they are open. Tables alone are
   read: no view, trigger, virtual table or computed column of a file runs. */
#ifndef JOX_BASE_DATABASE_H
#define JOX_BASE_DATABASE_H

#include <sqlite3.h>
#include <stdbool.h>

#include "base/text.h"

enum {
    /* How long a statement waits for another program that has the file locked, ms: one reads it
       or, of a file that this program reads, writes it. Behind that it fails with SQLITE_BUSY. */
    JOX_DATABASE_PATIENCE = 5000,
    JOX_DATABASE_STATEMENTS = 16 /* that are prepared at once, at most */
};

typedef enum JoxDatabaseUse { JOX_DATABASE_READ, JOX_DATABASE_WRITE } JoxDatabaseUse;

/* One connection, used by one thread at a time. */
typedef struct JoxDatabase {
    sqlite3 *sqlite;
    sqlite3_stmt *statements[JOX_DATABASE_STATEMENTS]; /* those of this program; others are NULL */
    const char *const *tables;                         /* that statements may name, up to a NULL */
    double left; /* calls of the progress handler until a bounded database gives up */
} JoxDatabase;

/* Opens a file; to write, also one that is not there yet, and with the path NULL one in memory.
   Statements may name tables once jox_database_allow has seen them. NULL with a sentence in `why`
   where the file cannot be opened. */
JoxDatabase *jox_database_open(const char *path, JoxDatabaseUse use, JoxText *why);
/* Lets statements name these tables (up to a NULL; the list is kept by its address), whether or not
   the file has them. False with a sentence in `why`, and no table allowed, where one of them is a
   virtual table or has a computed column, or where the file cannot be read. A view counts as
   missing. */
bool jox_database_allow(JoxDatabase *db, const char *const *tables, JoxText *why);
/* Prepares a statement; NULL where SQLite refuses it: sqlite3_errmsg says why. Allocates nothing of
   this program's. */
sqlite3_stmt *jox_database_prepare(JoxDatabase *db, const char *sql);
/* Finalizes a statement of jox_database_prepare; NULL is fine. */
void jox_database_finalize(JoxDatabase *db, sqlite3_stmt *statement);
/* Begins or ends a bound: while it holds, all statements together do no more work than reading the
   whole file some times takes; behind that they fail as interrupted. */
void jox_database_bound(JoxDatabase *db, bool bounded);
/* Closes it, and finalizes the statements that are left; NULL is fine. */
void jox_database_close(JoxDatabase *db);

#endif
