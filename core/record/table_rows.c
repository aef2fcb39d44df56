#include "record/table_rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"

enum { MOST_POINTS = 1000 };
static const double FARTHEST = 1e6; /* m: of points, along x and y */

bool jox_row_is_sound(const JoxTableRow *row) {
    return row->why->length == 0;
}

bool jox_row_fail(const JoxTableRow *row, int column, const char *must) {
    const char *text = (const char *)sqlite3_column_text(row->values, column);
    if (!jox_row_is_sound(row))
        return false;
    jox_text_printf(row->why, "table %s", row->table);
    for (int k = 0; k < row->keys; k++)
        jox_text_printf(row->why, ", %s %.20s", sqlite3_column_name(row->values, k),
                        sqlite3_column_text(row->values, k));
    jox_text_printf(row->why, ": %s is %s%.40s%s: %s", sqlite3_column_name(row->values, column),
                    text ? "'" : "", text ? text : "NULL", text ? "'" : "", must);
    return false;
}

bool jox_table_read(JoxDatabase *db, const char *table, const char *query, int keys,
                    JoxReadRow *read, void *context, JoxText *why) {
    JoxTableRow row = {jox_database_prepare(db, query), table, keys, why};
    int status = row.values ? SQLITE_ROW : SQLITE_ERROR;
    bool sound = true;
    while (sound && row.values && (status = sqlite3_step(row.values)) == SQLITE_ROW)
        sound = read(&row, context) && jox_row_is_sound(&row);
    if (sound && status != SQLITE_DONE) {
        jox_text_printf(why, "table %s cannot be read: %s", table, sqlite3_errmsg(db->sqlite));
        sound = false;
    }
    jox_database_finalize(db, row.values);
    return sound;
}

double jox_row_number(const JoxTableRow *row, int column, double least, double greatest) {
    const int type = sqlite3_column_type(row->values, column);
    const double value = sqlite3_column_double(row->values, column);
    char must[80];
    if ((type == SQLITE_FLOAT || type == SQLITE_INTEGER) && value >= least && value <= greatest)
        return value;
    snprintf(must, sizeof must, "it must be a number from %.9g to %.9g", least, greatest);
    jox_row_fail(row, column, must);
    return least;
}

int64_t jox_row_whole(const JoxTableRow *row, int column, int64_t least, int64_t greatest) {
    const int64_t value = sqlite3_column_int64(row->values, column);
    char must[80];
    if (sqlite3_column_type(row->values, column) == SQLITE_INTEGER && value >= least &&
        value <= greatest)
        return value;
    if (greatest < least)
        snprintf(must, sizeof must, "the recording has none");
    else if (least == greatest)
        snprintf(must, sizeof must, "it must be %lld", (long long)least);
    else
        snprintf(must, sizeof must, "it must be a whole number from %lld to %lld", (long long)least,
                 (long long)greatest);
    jox_row_fail(row, column, must);
    return least;
}

char *jox_row_name(const JoxTableRow *row, int column) {
    const char *text = (const char *)sqlite3_column_text(row->values, column);
    if (!text || !*text)
        jox_row_fail(row, column, "it must be a name");
    return jox_strdup(text ? text : "");
}

uint32_t jox_row_choice(const JoxTableRow *row, int column, const char *const *names,
                        uint32_t count) {
    const char *text = (const char *)sqlite3_column_text(row->values, column);
    JoxText must = {0};
    for (uint32_t n = 0; text && n < count; n++)
        if (strcmp(text, names[n]) == 0)
            return n;
    for (uint32_t n = 0; n < count; n++)
        jox_text_printf(&must, "%s%s", n == 0 ? "it must be one of " : ", ", names[n]);
    jox_row_fail(row, column, must.data);
    jox_text_free(&must);
    return 0;
}

/* Parses "x y, x y, ..."; returns false if the text has another form or a point is far away. */
static bool parse_points(const char *text, JoxV2 *points, uint32_t *count) {
    for (bool more = *text; more; text++) {
        float x, y;
        int used = 0;
        if (*count == MOST_POINTS || sscanf(text, "%f %f%n", &x, &y, &used) != 2 ||
            !(fabs((double)x) < FARTHEST) || !(fabs((double)y) < FARTHEST))
            return false;
        points[(*count)++] = jox_v2(x, y);
        text += used;
        more = *text == ',';
        if (!more)
            return *text == '\0';
    }
    return true;
}

uint32_t jox_row_points(const JoxTableRow *row, int column, uint32_t least, JoxV2 **points) {
    const char *text = (const char *)sqlite3_column_text(row->values, column);
    uint32_t count = 0;
    char must[80];
    *points = jox_alloc(MOST_POINTS, sizeof **points);
    if (parse_points(text ? text : "", *points, &count) && count >= least)
        return count;
    snprintf(must, sizeof must, "it must be 'x y, x y, ...' with %u points or more", least);
    jox_row_fail(row, column, must);
    return 0;
}
