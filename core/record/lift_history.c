#include "record/lift_history.h"

#include <math.h>
#include <string.h>

#include "base/database.h"
#include "base/mem.h"
#include "record/storey_tables.h"

static const double FARTHEST = 1e5; /* m: of heights */

/* A car from a frame on. */
typedef struct CarRow {
    int64_t frame;
    uint32_t lift;
    JoxCarLook look;
} CarRow;

struct JoxLiftHistory {
    JoxLift *lifts;
    JoxCarLook *cars; /* in the frame that was asked for last */
    uint32_t lift_count;
    size_t lift_capacity, capacity;
    CarRow *rows; /* in ascending order of frames */
    uint32_t count;
    uint32_t applied; /* rows that `cars` have */
};

static bool read_lift(JoxLiftHistory *h, sqlite3_stmt *row) {
    const int64_t capacity = sqlite3_column_int64(row, 2);
    const char *name = (const char *)sqlite3_column_text(row, 1);
    if (h->lift_count >= JOX_MOST_LIFTS || sqlite3_column_int64(row, 0) != h->lift_count || !name ||
        capacity < 1 || capacity > UINT16_MAX)
        return false;
    JOX_RESERVE(h->lifts, h->lift_capacity, h->lift_count + 1);
    JoxLift *lift = &h->lifts[h->lift_count++];
    *lift = (JoxLift){.name = jox_strdup(name), .capacity = (uint32_t)capacity, .first = -1};
    lift->stops = jox_alloc(JOX_MOST_STOREYS, sizeof *lift->stops);
    lift->point_count =
        jox_storey_tables_points((const char *)sqlite3_column_text(row, 3), &lift->outline);
    return lift->point_count >= 3;
}

static bool read_stop(JoxLiftHistory *h, const JoxStoreys *storeys, sqlite3_stmt *row) {
    const int64_t number = sqlite3_column_int64(row, 0), storey = sqlite3_column_int64(row, 1);
    if (number < 0 || number >= h->lift_count || storey < 0 || storey >= storeys->storey_count)
        return false;
    JoxLift *lift = &h->lifts[number];
    JoxV2 *door;
    const uint32_t ends =
        jox_storey_tables_points((const char *)sqlite3_column_text(row, 2), &door);
    const bool sound = ends == 2 && jox_lift_stop_at(lift, (uint32_t)storey) < 0;
    if (sound)
        lift->stops[lift->stop_count++] =
            (JoxLiftStop){.storey = (uint32_t)storey,
                          .door = {door[0], door[1]},
                          .place = -1,
                          .name = jox_lift_stop_name(lift->name, storeys->storeys[storey].name)};
    jox_free(door);
    return sound;
}

static bool read_car(JoxLiftHistory *h, const JoxStoreys *storeys, sqlite3_stmt *row) {
    const int64_t number = sqlite3_column_int64(row, 1), storey = sqlite3_column_int64(row, 4);
    const int64_t people = sqlite3_column_int64(row, 5);
    const double height = sqlite3_column_double(row, 2), open = sqlite3_column_double(row, 3);
    const char *mode = (const char *)sqlite3_column_text(row, 6);
    if (number < 0 || number >= h->lift_count || storey < 0 || storey >= storeys->storey_count ||
        !(fabs(height) < FARTHEST) || !(open >= 0.0 && open <= 1.0) || people < 0 ||
        people > UINT32_MAX)
        return false;
    const int32_t stop = jox_lift_stop_at(&h->lifts[number], (uint32_t)storey);
    JOX_RESERVE(h->rows, h->capacity, h->count + 1);
    CarRow *car = &h->rows[h->count++];
    *car = (CarRow){sqlite3_column_int64(row, 0), (uint32_t)number,
                    (JoxCarLook){(float)height, (float)open, (uint32_t)stop, (uint32_t)people, 0}};
    for (uint32_t m = 0; mode && m < JOX_LIFT_MODES; m++)
        if (strcmp(mode, jox_lift_mode_names[m]) == 0)
            car->look.mode = m;
    return stop >= 0;
}

/* Returns whether the rows of all three tables make sense. */
static bool read_tables(JoxLiftHistory *h, struct JoxDatabase *db, const JoxStoreys *storeys) {
    bool good = true;
    sqlite3_stmt *rows = jox_database_prepare(
        db, "SELECT number, name, capacity, points FROM jostle_lift ORDER BY number");
    while (good && rows && sqlite3_step(rows) == SQLITE_ROW)
        good = read_lift(h, rows);
    jox_database_finalize(db, rows);
    rows = jox_database_prepare(db,
                                "SELECT lift, storey, door FROM jostle_stop ORDER BY lift, storey");
    while (good && rows && sqlite3_step(rows) == SQLITE_ROW)
        good = read_stop(h, storeys, rows);
    jox_database_finalize(db, rows);
    for (uint32_t l = 0; good && l < h->lift_count; l++) {
        good = h->lifts[l].stop_count > 0;
        if (good)
            jox_lift_lay_out(&h->lifts[l], storeys);
    }
    rows = jox_database_prepare(db, "SELECT frame, lift, height, open, storey, people, mode FROM "
                                    "jostle_car ORDER BY frame, lift");
    while (good && rows && sqlite3_step(rows) == SQLITE_ROW)
        good = read_car(h, storeys, rows);
    jox_database_finalize(db, rows);
    return good;
}

JoxLiftHistory *jox_lift_history_read(struct JoxDatabase *db, const JoxStoreys *storeys,
                                      JoxText *why) {
    JoxLiftHistory *h = jox_alloc(1, sizeof *h);
    const bool good = !jox_has_storeys(storeys) || read_tables(h, db, storeys);
    if (!good)
        jox_text_add(why, "its lifts are damaged");
    if (!good || !h->lift_count) {
        jox_lift_history_free(h);
        return NULL;
    }
    h->cars = jox_alloc(h->lift_count, sizeof *h->cars);
    jox_lift_history_cars(h, INT64_MIN);
    return h;
}

const JoxLift *jox_lift_history_lifts(const JoxLiftHistory *h, uint32_t *count) {
    *count = h ? h->lift_count : 0;
    return h ? h->lifts : NULL;
}

const JoxCarLook *jox_lift_history_cars(JoxLiftHistory *h, int64_t frame) {
    if (!h)
        return NULL;
    if (h->applied == 0 || h->rows[h->applied - 1].frame > frame) { /* begins anew */
        h->applied = 0;
        for (uint32_t l = 0; l < h->lift_count; l++)
            h->cars[l] = (JoxCarLook){.height = h->lifts[l].stops[0].height};
    }
    /* Rows of the first frame hold for earlier frames, too. */
    while (h->applied < h->count &&
           (h->rows[h->applied].frame <= frame || h->rows[h->applied].frame == h->rows[0].frame)) {
        h->cars[h->rows[h->applied].lift] = h->rows[h->applied].look;
        h->applied++;
    }
    return h->cars;
}

void jox_lift_history_free(JoxLiftHistory *h) {
    if (!h)
        return;
    for (uint32_t l = 0; l < h->lift_count; l++)
        jox_lift_free(&h->lifts[l]);
    jox_free(h->lifts);
    jox_free(h->cars);
    jox_free(h->rows);
    jox_free(h);
}
