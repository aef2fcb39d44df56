/* Reads storeys and stairs of a recording. */
#include "record/storey_tables.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/database.h"
#include "base/mem.h"
#include "record/recorder_schema.h"

enum { MOST_POINTS = 1000 };
static const double FARTHEST = 1e5; /* m: of heights, of where sheets begin, and of the pitch */

const char *const jox_stair_kind_names[] = {"stairs", "ramp", "escalator"};
const char *const jox_stair_way_names[] = {"both", "up", "down"};

uint32_t jox_storey_tables_points(const char *text, JoxV2 **pairs) {
    uint32_t count = 0;
    JoxV2 *read = jox_alloc(MOST_POINTS, sizeof *read);
    for (bool more = text != NULL && *text; more; text++) {
        int used = 0;
        if (count == MOST_POINTS ||
            sscanf(text, "%f %f%n", &read[count].x, &read[count].y, &used) != 2) {
            count = 0;
            break;
        }
        count++;
        text += used;
        more = *text == ',';
    }
    *pairs = read;
    return count;
}

static uint32_t find_name(const char *text, const char *const *names, uint32_t count) {
    uint32_t found = 0;
    for (uint32_t n = 0; text && n < count; n++)
        found = strcmp(text, names[n]) == 0 ? n : found;
    return found;
}

static char *copy_column(sqlite3_stmt *row, int column) {
    const char *text = (const char *)sqlite3_column_text(row, column);
    return jox_strdup(text ? text : "");
}

static bool read_storey_row(sqlite3_stmt *row, JoxStoreys *s, size_t *capacity) {
    const double height = sqlite3_column_double(row, 2);
    const bool sound =
        s->storey_count < JOX_MOST_STOREYS && sqlite3_column_int64(row, 0) == s->storey_count &&
        fabs(height) < FARTHEST &&
        (s->storey_count == 0 || height > (double)s->storeys[s->storey_count - 1].height);
    if (!sound)
        return false;
    JOX_RESERVE(s->storeys, *capacity, s->storey_count + 1);
    s->storeys[s->storey_count++] = (JoxStorey){copy_column(row, 1), (float)height};
    return true;
}

/* Reads the landings of a stair. Returns false unless they ascend. */
static bool read_landings(sqlite3_stmt *row, int column, JoxStair *stair) {
    JoxV2 *pairs;
    bool sound = true;
    stair->landing_count =
        jox_storey_tables_points((const char *)sqlite3_column_text(row, column), &pairs);
    stair->landings = jox_alloc((size_t)stair->landing_count + 1, sizeof *stair->landings);
    for (uint32_t k = 0; k < stair->landing_count; k++) {
        stair->landings[k] = (JoxLanding){pairs[k].x, pairs[k].y};
        sound = sound && pairs[k].x < pairs[k].y && (k == 0 || pairs[k].x >= pairs[k - 1].y);
    }
    jox_free(pairs);
    return sound;
}

static bool read_stair_row(sqlite3_stmt *row, JoxStoreys *s, size_t *capacity) {
    const int64_t lower = sqlite3_column_int64(row, 4), upper = sqlite3_column_int64(row, 5);
    const double rise = sqlite3_column_double(row, 9), belt = sqlite3_column_double(row, 10);
    if (s->stair_count >= JOX_MOST_STAIRS || sqlite3_column_int64(row, 0) != s->stair_count ||
        lower < 0 || lower > upper || upper >= s->storey_count || !(fabs(rise) < FARTHEST) ||
        !(fabs(belt) < FARTHEST))
        return false;
    JOX_RESERVE(s->stairs, *capacity, s->stair_count + 1);
    JoxStair *stair = &s->stairs[s->stair_count++];
    *stair = (JoxStair){.name = copy_column(row, 1),
                        .lower = (uint32_t)lower,
                        .upper = (uint32_t)upper,
                        .width = (float)sqlite3_column_double(row, 7),
                        .rise = (float)rise,
                        .belt = (float)belt};
    stair->kind =
        (JoxStairKind)find_name((const char *)sqlite3_column_text(row, 2), jox_stair_kind_names, 3);
    stair->way =
        (JoxStairWay)find_name((const char *)sqlite3_column_text(row, 3), jox_stair_way_names, 3);
    stair->path_count =
        jox_storey_tables_points((const char *)sqlite3_column_text(row, 6), &stair->path);
    return read_landings(row, 8, stair) && jox_stair_is_sound(stair);
}

/* Reads all rows of a query. Returns false at the first unsound one. */
static bool read_rows(struct JoxDatabase *db, const char *sql, JoxStoreys *out,
                      bool (*read)(sqlite3_stmt *, JoxStoreys *, size_t *)) {
    sqlite3_stmt *rows = jox_database_prepare(db, sql);
    size_t capacity = 0;
    bool sound = rows != NULL;
    while (sound && sqlite3_step(rows) == SQLITE_ROW)
        sound = read(rows, out, &capacity);
    jox_database_finalize(db, rows);
    return sound;
}

/* Reads a number of the metadata. Returns false unless it is there and finite. */
static bool read_number(struct JoxDatabase *db, const char *key, float *out) {
    sqlite3_stmt *row =
        jox_database_prepare(db, "SELECT CAST(value AS REAL) FROM metadata WHERE key = ?");
    if (row)
        sqlite3_bind_text(row, 1, key, -1, SQLITE_STATIC);
    const bool found = row && sqlite3_step(row) == SQLITE_ROW;
    *out = found ? (float)sqlite3_column_double(row, 0) : NAN;
    jox_database_finalize(db, row);
    return fabs((double)*out) < FARTHEST;
}

bool jox_storey_tables_read(struct JoxDatabase *db, JoxStoreys *out, JoxText *why) {
    sqlite3_stmt *there = jox_database_prepare(db, "SELECT number FROM jostle_storey LIMIT 1");
    float origin, pitch;
    *out = (JoxStoreys){0};
    const bool any = there && sqlite3_step(there) == SQLITE_ROW;
    jox_database_finalize(db, there);
    if (!any)
        return true;
    bool sound = read_rows(db, "SELECT number, name, height FROM jostle_storey ORDER BY number",
                           out, read_storey_row) &&
                 read_rows(db,
                           "SELECT number, name, kind, way, lower, upper, path, width, landings, "
                           "rise, belt FROM jostle_stair ORDER BY number",
                           out, read_stair_row);
    sound = sound && read_number(db, JOX_RECORDED_ORIGIN, &origin) &&
            read_number(db, JOX_RECORDED_PITCH, &pitch) && pitch > 1.0f;
    if (sound)
        jox_storeys_lay_out_again(out, origin, pitch);
    else
        jox_text_add(why, "its storeys or stairs are damaged");
    return sound;
}

bool jox_storey_tables_place(const JoxStoreys *s, int64_t storey, int64_t stair, float *y) {
    if (storey < 0 || storey >= s->storey_count || stair < 0 || stair > s->stair_count)
        return false;
    const uint32_t sheet = stair > 0 ? s->stairs[stair - 1].sheet : (uint32_t)storey;
    *y += (float)sheet * s->pitch;
    return true;
}
