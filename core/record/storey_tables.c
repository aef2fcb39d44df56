/* Reads storeys and stairs of a recording. */
#include "record/storey_tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "record/recorder_schema.h"
#include "record/table_rows.h"

static const double FARTHEST = 1e5;     /* m: of heights, of where sheets begin, and of the pitch */
static const double FASTEST_BELT = 100; /* m/s */

const char *const jox_stair_kind_names[] = {"stairs", "ramp", "escalator"};
const char *const jox_stair_way_names[] = {"both", "up", "down"};

/* Storeys or stairs that are being read. */
typedef struct Reading {
    JoxStoreys *out;
    size_t capacity;
} Reading;

static bool read_storey(JoxTableRow *row, void *context) {
    Reading *reading = context;
    JoxStoreys *s = reading->out;
    const uint32_t n = s->storey_count;
    if (n >= JOX_MOST_STOREYS)
        return jox_row_fail(row, 0, "there must be at most 200 storeys");
    jox_row_whole(row, 0, n, n);
    JOX_RESERVE(s->storeys, reading->capacity, n + 1);
    s->storeys[s->storey_count++] =
        (JoxStorey){jox_row_name(row, 1), (float)jox_row_number(row, 2, -FARTHEST, FARTHEST)};
    for (uint32_t k = 0; k < n; k++)
        if (strcmp(s->storeys[k].name, s->storeys[n].name) == 0)
            return jox_row_fail(row, 1, "no other storey must have this name");
    return n == 0 || s->storeys[n].height > s->storeys[n - 1].height ||
           jox_row_fail(row, 2, "it must be above the storey before");
}

/* Reads the landings of a stair, from one length along its path to another each. */
static void read_landings(JoxTableRow *row, int column, JoxStair *stair) {
    JoxV2 *pairs;
    float end = 0.0f;
    stair->landing_count = jox_row_points(row, column, 0, &pairs);
    stair->landings = jox_alloc((size_t)stair->landing_count + 1, sizeof *stair->landings);
    for (uint32_t k = 0; k < stair->landing_count; k++) {
        stair->landings[k] = (JoxLanding){pairs[k].x, pairs[k].y};
        if (!(pairs[k].x >= end && pairs[k].x < pairs[k].y))
            jox_row_fail(row, column, "each landing must begin after the one before it");
        end = pairs[k].y;
    }
    jox_free(pairs);
}

static bool read_stair(JoxTableRow *row, void *context) {
    Reading *reading = context;
    JoxStoreys *s = reading->out;
    const uint32_t n = s->stair_count, top = s->storey_count - 1;
    if (n >= JOX_MOST_STAIRS)
        return jox_row_fail(row, 0, "there must be at most 1000 stairs");
    jox_row_whole(row, 0, n, n);
    JOX_RESERVE(s->stairs, reading->capacity, n + 1);
    JoxStair *stair = &s->stairs[s->stair_count++];
    *stair = (JoxStair){.name = jox_row_name(row, 1)};
    stair->kind = (JoxStairKind)jox_row_choice(row, 2, jox_stair_kind_names, 3);
    stair->way = (JoxStairWay)jox_row_choice(row, 3, jox_stair_way_names, 3);
    stair->lower = (uint32_t)jox_row_whole(row, 4, 0, top);
    stair->upper = (uint32_t)jox_row_whole(row, 5, 0, top);
    stair->path_count = jox_row_points(row, 6, 2, &stair->path);
    stair->width = (float)jox_row_number(row, 7, 0.0, FARTHEST);
    read_landings(row, 8, stair);
    stair->rise = (float)jox_row_number(row, 9, -FARTHEST, FARTHEST);
    stair->belt = (float)jox_row_number(row, 10, -FASTEST_BELT, FASTEST_BELT);
    if (stair->lower > stair->upper)
        return jox_row_fail(row, 5, "it must not be below `lower`");
    if ((stair->kind == JOX_STAIR_ESCALATOR) != (stair->belt != 0.0f))
        return jox_row_fail(row, 10, "it must be a speed of an escalator, and 0 of others");
    return jox_row_is_sound(row) &&
           (jox_stair_is_sound(stair) ||
            jox_row_fail(row, 6, "a strip of the stair's width about it must enclose an area"));
}

/* Reads a number of the metadata. Returns false unless it is a number from `least` on. */
static bool read_metadata(JoxDatabase *db, const char *key, double least, float *out,
                          JoxText *why) {
    sqlite3_stmt *row = jox_database_prepare(db, "SELECT value FROM metadata WHERE key = ?");
    if (row)
        sqlite3_bind_text(row, 1, key, -1, SQLITE_STATIC);
    const char *text =
        row && sqlite3_step(row) == SQLITE_ROW ? (const char *)sqlite3_column_text(row, 0) : NULL;
    char *end = NULL;
    const double value = text ? strtod(text, &end) : 0.0;
    const bool sound = end && end != text && !*end && value >= least && value <= FARTHEST;
    *out = (float)value;
    if (!sound)
        jox_text_printf(why,
                        "table metadata, key %s: value is %s%.40s%s: it must be a number from "
                        "%.9g to %.9g",
                        key, text ? "'" : "", text ? text : "missing", text ? "'" : "", least,
                        FARTHEST);
    jox_database_finalize(db, row);
    return sound;
}

/* Returns whether all stairs lie on the sheets that the metadata give them. */
static bool check_layout(const JoxStoreys *s, JoxText *why) {
    for (uint32_t k = 0; k < s->stair_count; k++) {
        const JoxStair *stair = &s->stairs[k];
        if (stair->low.y >= s->origin && stair->high.y < s->origin + s->pitch)
            continue;
        jox_text_printf(why,
                        "table metadata: keys " JOX_RECORDED_ORIGIN " and " JOX_RECORDED_PITCH
                        " give storeys from y = %g to %g m: the stair %.60s lies outside",
                        (double)s->origin, (double)(s->origin + s->pitch), stair->name);
        return false;
    }
    return true;
}

/* Returns whether a query can be prepared and has a row, or, if `any` is false, can be prepared. */
static bool answers(JoxDatabase *db, const char *query, bool any) {
    sqlite3_stmt *row = jox_database_prepare(db, query);
    const bool found = row && (!any || sqlite3_step(row) == SQLITE_ROW);
    jox_database_finalize(db, row);
    return found;
}

bool jox_storey_tables_read(JoxDatabase *db, JoxStoreys *out, JoxText *why) {
    float origin, pitch;
    Reading storeys = {.out = out}, stairs = {.out = out};
    *out = (JoxStoreys){0};
    if (!answers(db, "SELECT number FROM jostle_storey LIMIT 1", true)) {
        if (answers(db, "SELECT storey FROM jostle_row", false))
            jox_text_add(why, "table jostle_storey has no rows, though people stand on storeys");
        return why->length == 0;
    }
    if (!jox_table_read(db, "jostle_storey",
                        "SELECT number, name, height FROM jostle_storey ORDER BY number", 1,
                        read_storey, &storeys, why) ||
        !jox_table_read(db, "jostle_stair",
                        "SELECT number, name, kind, way, lower, upper, path, width, landings, "
                        "rise, belt FROM jostle_stair ORDER BY number",
                        1, read_stair, &stairs, why) ||
        !read_metadata(db, JOX_RECORDED_ORIGIN, -FARTHEST, &origin, why) ||
        !read_metadata(db, JOX_RECORDED_PITCH, (double)JOX_LEAST_PITCH, &pitch, why))
        return false;
    jox_storeys_lay_out_again(out, origin, pitch);
    return check_layout(out, why);
}

bool jox_storey_tables_place(const JoxStoreys *s, int64_t storey, int64_t stair, float *y) {
    if (storey < 0 || storey >= s->storey_count || stair < 0 || stair > s->stair_count)
        return false;
    const uint32_t sheet = stair > 0 ? s->stairs[stair - 1].sheet : (uint32_t)storey;
    *y += (float)sheet * s->pitch;
    return true;
}
