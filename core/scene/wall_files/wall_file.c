/* Chooses the reader of a text with walls, and takes the text out of a recording. */
#include "scene/wall_files/wall_file.h"

#include <ctype.h>

#include "base/database.h"
#include "base/mem.h"
#include "scene/wall_files/wall_file_parts.h"

bool jox_wall_file_read(const char *path, const char *text, size_t length,
                        const JoxWallFileOptions *options, JoxWalls *walls,
                        JoxDiagnostics *diagnostics) {
    size_t at = jox_byte_order_mark_length(text, length);
    while (at < length && isspace((unsigned char)text[at]))
        at++;
    return (at < length && text[at] == '<' ? jox_wall_file_read_jupedsim : jox_wall_file_read_wkt)(
        path, text, length, options, walls, diagnostics);
}

char *jox_wall_file_read_recorded(const char *path, JoxDiagnostics *diagnostics) {
    static const char *const TABLES[] = {"geometry", NULL};
    const JoxPosition at = {path, 0, 0, 0};
    JoxText why = {0};
    char *text = NULL;
    JoxDatabase *db = jox_database_open(path, JOX_DATABASE_READ, &why);
    if (db)
        jox_database_bound(db, true);
    if (!db || !jox_database_allow(db, TABLES, &why)) {
        jox_diag_error(diagnostics, at, "bad-plan", NULL, "%s", why.data);
    } else {
        sqlite3_stmt *query = jox_database_prepare(db, "SELECT wkt FROM geometry LIMIT 1");
        if (query && sqlite3_step(query) == SQLITE_ROW && sqlite3_column_text(query, 0))
            text = jox_strdup((const char *)sqlite3_column_text(query, 0));
        else
            jox_diag_error(diagnostics, at, "bad-plan",
                           "A recording of JuPedSim or of `jostle run --record` has one",
                           "this database has no table 'geometry' with a plan: %.200s",
                           sqlite3_errmsg(db->sqlite));
    }
    jox_database_close(db);
    jox_text_free(&why);
    return text;
}
