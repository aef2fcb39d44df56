/* SQLite files of strangers: only plain tables are read, and no code in a file runs. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/database.h"

static char folder[] = "/tmp/jostle-database-XXXXXX";
static char path[128];
static const char *const TABLES[] = {"t", "u", NULL};

static int make_database_folder(void **state) {
    (void)state;
    const bool made = mkdtemp(folder) != NULL;
    snprintf(path, sizeof path, "%s/file", folder);
    return made ? 0 : -1;
}

static int remove_database_folder(void **state) {
    (void)state;
    unlink(path);
    return rmdir(folder);
}

/* Makes a database file by SQL; false if this SQLite lacks a module that it uses. */
static bool make_database_file(const char *sql) {
    sqlite3 *db;
    unlink(path);
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    char *why = NULL;
    const int status = sqlite3_exec(db, sql, NULL, NULL, &why);
    const bool lacks = status != SQLITE_OK && strstr(why, "no such module");
    if (status != SQLITE_OK && !lacks)
        fail_msg("%s: %s", sql, why);
    sqlite3_free(why);
    sqlite3_close(db);
    return !lacks;
}

static double select_number(JoxDatabase *db, const char *sql) {
    sqlite3_stmt *statement = jox_database_prepare(db, sql);
    const bool found = statement && sqlite3_step(statement) == SQLITE_ROW;
    const double value = found ? sqlite3_column_double(statement, 0) : -1.0;
    jox_database_finalize(db, statement);
    return value;
}

/* Opens the file and allows its tables; writes the reason of a failure, or "", to `said`. */
static void allow_tables(JoxDatabaseUse use, char said[300]) {
    JoxText why = {0};
    JoxDatabase *db = jox_database_open(path, use, &why);
    if (db && jox_database_allow(db, TABLES, &why)) {
        select_number(db, "SELECT count(*) FROM t");
        select_number(db, "SELECT count(*) FROM u");
    }
    jox_database_close(db);
    snprintf(said, 300, "%s", why.length ? why.data : "");
    jox_text_free(&why);
}

static void tables_that_are_not_plain_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *sql, *said;
    } CASES[] = {
        {"CREATE VIRTUAL TABLE t USING fts5(a, b)", "'t' is a virtual table"},
        {"CREATE VIRTUAL TABLE t USING fts4(a, b)", "'t' is a virtual table"},
        {"CREATE TABLE t(a); CREATE VIRTUAL TABLE U USING rtree(id, low, high)",
         "'u' is a virtual table"},
        {"CREATE TABLE t(a, b AS (hex(zeroblob(100000))))", "'t' has a computed column ('b')"},
        {"CREATE TABLE T(a, b TEXT AS (a || a) STORED)", "'t' has a computed column ('b')"},
        /* A schema entry whose name differs from that in its SQL; newer SQLite refuses it
           itself. */
        {"CREATE TABLE t(a, b AS (a + 1)); PRAGMA writable_schema = ON; UPDATE sqlite_schema SET "
         "name = 'other', tbl_name = 'other'",
         ""},
        {"CREATE TABLE t(a); PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = 'CREATE "
         "TABLE t(a, b AS (a + 1))'",
         "'t' has a computed column ('b')"},
        {"CREATE TABLE t(a); PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = 'CREATE "
         "nonsense'",
         "malformed"},
    };
    char said[300];
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++)
        if (make_database_file(CASES[c].sql))
            for (int use = JOX_DATABASE_READ; use <= JOX_DATABASE_WRITE; use++) {
                allow_tables((JoxDatabaseUse)use, said);
                if (!*said || !strstr(said, CASES[c].said))
                    fail_msg("%s: '%s'", CASES[c].sql, said);
            }
}

static void triggers_and_views_of_a_file_never_run(void **state) {
    (void)state;
    static const char *const CASES[] = {
        "CREATE INDEX i ON t(a); CREATE INDEX j ON t(a + 1) WHERE a > 0; CREATE TABLE other(a)",
        ("CREATE TABLE u(a PRIMARY KEY) WITHOUT ROWID; CREATE TRIGGER g AFTER INSERT ON t BEGIN "
         "DELETE FROM t; END"),
        "CREATE VIEW u AS SELECT * FROM t; CREATE TABLE c(a, b AS (a + 1)); ANALYZE",
        "CREATE VIRTUAL TABLE notes USING fts5(x); INSERT INTO notes VALUES('here')",
        "CREATE VIRTUAL TABLE boxes USING rtree(id, low, high)",
    };
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) {
        char sql[400];
        JoxText why = {0};
        snprintf(sql, sizeof sql,
                 "CREATE TABLE t(a INTEGER, b DEFAULT 1); INSERT INTO t(a) "
                 "VALUES(7); %s",
                 CASES[c]);
        if (!make_database_file(sql))
            continue;
        JoxDatabase *db = jox_database_open(path, JOX_DATABASE_WRITE, &why);
        assert_non_null(db);
        if (!jox_database_allow(db, TABLES, &why))
            fail_msg("%s: %s", CASES[c], why.data);
        assert_true(select_number(db, "SELECT a FROM t") == 7.0);
        select_number(db, "INSERT INTO t(a) VALUES(8)");
        assert_true(select_number(db, "SELECT count(*) FROM t") == 2.0); /* no trigger ran */
        jox_database_close(db);
    }
}

static void statements_cannot_use_other_tables(void **state) {
    (void)state;
    JoxText why = {0};
    assert_true(
        make_database_file("CREATE TABLE t(a); CREATE TABLE other(a); INSERT INTO t VALUES(7); "
                           "INSERT INTO other VALUES(8); CREATE VIEW u AS SELECT a FROM other"));
    JoxDatabase *db = jox_database_open(path, JOX_DATABASE_WRITE, &why);
    assert_non_null(db);
    assert_null(jox_database_prepare(db, "SELECT a FROM t")); /* not allowed yet */
    assert_true(jox_database_allow(db, TABLES, &why));
    assert_true(select_number(db, "SELECT a FROM t") == 7.0);
    static const char *const REFUSED[] = {
        "SELECT a FROM other",
        "SELECT count(*) FROM other",
        "SELECT a FROM u",
        "DELETE FROM other",
        "INSERT INTO other VALUES(1)",
        "UPDATE other SET a = 2",
        "SELECT * FROM t, other",
        "SELECT * FROM json_each('[1]')",
        "SELECT * FROM dbstat",
        "SELECT (SELECT a FROM other) FROM t",
    };
    for (size_t k = 0; k < sizeof REFUSED / sizeof *REFUSED; k++)
        if (jox_database_prepare(db, REFUSED[k]))
            fail_msg("prepared: %s", REFUSED[k]);
    jox_database_close(db);
}

/* Closing finalizes statements that their callers left, and no others. */
static void closing_finalizes_own_statements(void **state) {
    (void)state;
    JoxText why = {0};
    assert_true(make_database_file("CREATE TABLE t(a); INSERT INTO t VALUES(1), (2)"));
    for (int left = 0; left < JOX_DATABASE_STATEMENTS; left++) {
        JoxDatabase *db = jox_database_open(path, JOX_DATABASE_READ, &why);
        assert_non_null(db);
        assert_true(jox_database_allow(db, TABLES, &why));
        for (int k = 0; k < left; k++)
            assert_int_equal(sqlite3_step(jox_database_prepare(db, "SELECT a FROM t")), SQLITE_ROW);
        jox_database_close(db);
    }
}

static void file_that_is_no_database_gives_an_error(void **state) {
    (void)state;
    char said[300];
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(
        "no database, but as long as one would have to be, at the least .....................\n"
        "........................................................................................",
        file);
    fclose(file);
    allow_tables(JOX_DATABASE_READ, said);
    assert_string_equal(said, "file is not a database");
    unlink(path);
    allow_tables(JOX_DATABASE_READ, said);
    assert_string_equal(said, "No such file or directory");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_that_are_not_plain_are_refused),
        cmocka_unit_test(triggers_and_views_of_a_file_never_run),
        cmocka_unit_test(statements_cannot_use_other_tables),
        cmocka_unit_test(closing_finalizes_own_statements),
        cmocka_unit_test(file_that_is_no_database_gives_an_error),
    };
    return cmocka_run_group_tests(tests, make_database_folder, remove_database_folder);
}
