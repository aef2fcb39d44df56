/* Stands in for SQLite, which would be a third of the module: no database can be opened, so that
   recordings and their readers fail with a message. The other functions are never called. */
#include <sqlite3.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

static char nothing; /* stands for a database that could not be opened */

int sqlite3_open_v2(const char *path, sqlite3 **database, int flags, const char *system) {
    (void)path, (void)flags, (void)system;
    *database = (sqlite3 *)(void *)&nothing;
    return SQLITE_CANTOPEN;
}

const char *sqlite3_errmsg(sqlite3 *database) {
    (void)database;
    return "this build has no SQLite: recordings are made and read by the program jostle";
}

int sqlite3_stricmp(const char *a, const char *b) {
    return strcmp(a, b);
}

int sqlite3_strnicmp(const char *a, const char *b, int count) {
    return strncmp(a, b, (size_t)count);
}

/* Functions that return a status, a number or a pointer, all of them without a database. */
#define FAILS(name, ...)                                                                           \
    int name(__VA_ARGS__) {                                                                        \
        return SQLITE_MISUSE;                                                                      \
    }
#define GIVES(type, name, ...)                                                                     \
    type name(__VA_ARGS__) {                                                                       \
        return (type)0;                                                                            \
    }
#pragma clang diagnostic ignored "-Wunused-parameter"
FAILS(sqlite3_bind_blob, sqlite3_stmt *s, int n, const void *v, int c, void (*f)(void *))
FAILS(sqlite3_bind_blob64, sqlite3_stmt *s, int n, const void *v, sqlite3_uint64 c,
      void (*f)(void *))
FAILS(sqlite3_bind_double, sqlite3_stmt *s, int n, double v)
FAILS(sqlite3_bind_int, sqlite3_stmt *s, int n, int v)
FAILS(sqlite3_bind_int64, sqlite3_stmt *s, int n, sqlite3_int64 v)
FAILS(sqlite3_bind_null, sqlite3_stmt *s, int n)
FAILS(sqlite3_bind_text, sqlite3_stmt *s, int n, const char *v, int c, void (*f)(void *))
FAILS(sqlite3_busy_timeout, sqlite3 *d, int ms)
FAILS(sqlite3_db_config, sqlite3 *d, int op, ...)
FAILS(sqlite3_drop_modules, sqlite3 *d, const char **keep)
FAILS(sqlite3_errcode, sqlite3 *d)
FAILS(sqlite3_exec, sqlite3 *d, const char *sql, int (*f)(void *, int, char **, char **), void *c,
      char **why)
FAILS(sqlite3_limit, sqlite3 *d, int id, int value)
FAILS(sqlite3_prepare_v2, sqlite3 *d, const char *sql, int n, sqlite3_stmt **s, const char **rest)
FAILS(sqlite3_set_authorizer, sqlite3 *d,
      int (*f)(void *, int, const char *, const char *, const char *, const char *), void *c)
FAILS(sqlite3_step, sqlite3_stmt *s)
FAILS(sqlite3_wal_checkpoint_v2, sqlite3 *d, const char *name, int mode, int *log, int *done)
GIVES(int, sqlite3_close_v2, sqlite3 *d)
GIVES(int, sqlite3_finalize, sqlite3_stmt *s)
GIVES(int, sqlite3_reset, sqlite3_stmt *s)
GIVES(int, sqlite3_get_autocommit, sqlite3 *d)
GIVES(int, sqlite3_column_bytes, sqlite3_stmt *s, int n)
GIVES(int, sqlite3_column_int, sqlite3_stmt *s, int n)
GIVES(int, sqlite3_column_type, sqlite3_stmt *s, int n)
GIVES(sqlite3_int64, sqlite3_column_int64, sqlite3_stmt *s, int n)
GIVES(double, sqlite3_column_double, sqlite3_stmt *s, int n)
GIVES(const void *, sqlite3_column_blob, sqlite3_stmt *s, int n)
GIVES(const unsigned char *, sqlite3_column_text, sqlite3_stmt *s, int n)
GIVES(const char *, sqlite3_db_filename, sqlite3 *d, const char *name)
GIVES(char *, sqlite3_mprintf, const char *format, ...)

void sqlite3_free(void *memory) {
    (void)memory;
}

void sqlite3_progress_handler(sqlite3 *database, int operations, int (*handler)(void *),
                              void *context) {
    (void)database, (void)operations, (void)handler, (void)context;
}
