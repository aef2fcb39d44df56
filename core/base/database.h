/* SQLite files, held (mem.h) while they are open. */
#ifndef JOX_BASE_DATABASE_H
#define JOX_BASE_DATABASE_H

#include <sqlite3.h>
#include <stdbool.h>

/* How long a statement waits for another program that has the file locked, ms: one reads it or, of
   a file that this program reads, writes it. Behind that it fails with SQLITE_BUSY. */
enum { JOX_DATABASE_PATIENCE = 5000 };
/* Opens a file for reading, of which nothing is believed: views, triggers and functions of its
   schema are not run, and texts are limited. False where it cannot be opened; *db is to be closed
   then too, and says why. */
bool jox_database_open(const char *path, sqlite3 **db);
/* The same for reading and writing; made where there is no file. NULL as the path is a database in
   memory. */
bool jox_database_open_to_write(const char *path, sqlite3 **db);
/* From here on, until it is called with NULL, all statements together do no more work than reading
   the whole file some times takes: behind that they fail as interrupted. `left` is the caller's,
   and holds what is left of it. */
void jox_database_bound(sqlite3 *db, double *left);
/* Closes it with the statements that are left; NULL is fine. */
void jox_database_close(sqlite3 *db);

#endif
