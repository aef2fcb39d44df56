/* SQLite files that are read, held (base/mem.h) while they are open. */
#ifndef JOX_RECORD_DATABASE_H
#define JOX_RECORD_DATABASE_H

#include <sqlite3.h>
#include <stdbool.h>

/* Opens a file for reading. False where it cannot be; *db is to be closed then too, and says why.
 */
bool jox_database_open(const char *path, sqlite3 **db);
/* Closes it with the statements that are left; NULL is fine. */
void jox_database_close(sqlite3 *db);

#endif
