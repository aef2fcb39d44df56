#include "record/lift_history.h"

#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "geom/polygon.h"
#include "record/table_rows.h"

enum { MOST_PEOPLE = UINT16_MAX };
static const double BEYOND = 1.0;     /* m: that a car may be above or below all its storeys */
static const float NARROWEST = 0.01f; /* m: of doors */

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

/* Lifts that are being read, and the storeys of the recording. */
typedef struct Reading {
    JoxLiftHistory *history;
    const JoxStoreys *storeys;
} Reading;

static bool read_lift(JoxTableRow *row, void *context) {
    JoxLiftHistory *h = ((Reading *)context)->history;
    const uint32_t n = h->lift_count;
    if (n >= JOX_MOST_LIFTS)
        return jox_row_fail(row, 0, "there must be at most 100 lifts");
    jox_row_whole(row, 0, n, n);
    JOX_RESERVE(h->lifts, h->lift_capacity, n + 1);
    JoxLift *lift = &h->lifts[h->lift_count++];
    *lift = (JoxLift){.name = jox_row_name(row, 1),
                      .capacity = (uint32_t)jox_row_whole(row, 2, 1, MOST_PEOPLE),
                      .first = -1};
    lift->stops = jox_alloc(JOX_MOST_STOREYS, sizeof *lift->stops);
    lift->point_count = jox_row_points(row, 3, 3, &lift->outline);
    for (uint32_t k = 0; k < n; k++)
        if (strcmp(h->lifts[k].name, lift->name) == 0)
            return jox_row_fail(row, 1, "no other lift must have this name");
    return jox_row_is_sound(row) &&
           (jox_polygon_area(lift->outline, lift->point_count) > 0.0 ||
            jox_row_fail(row, 3, "it must go round an area counter-clockwise"));
}

/* Reads the lift of a row, and a storey of the recording. Returns NULL at damage. */
static JoxLift *find_lift(JoxTableRow *row, const Reading *reading, int lift, int storey,
                          uint32_t *at) {
    const JoxLiftHistory *h = reading->history;
    const int64_t number = jox_row_whole(row, lift, 0, (int64_t)h->lift_count - 1);
    *at = (uint32_t)jox_row_whole(row, storey, 0, (int64_t)reading->storeys->storey_count - 1);
    return jox_row_is_sound(row) ? &h->lifts[number] : NULL;
}

static bool read_stop(JoxTableRow *row, void *context) {
    const Reading *reading = context;
    uint32_t storey;
    JoxV2 *door;
    JoxLift *lift = find_lift(row, reading, 0, 1, &storey);
    if (!lift)
        return false;
    const uint32_t ends = jox_row_points(row, 2, 2, &door);
    const bool sound = ends == 2 && jox_length(jox_sub(door[1], door[0])) >= NARROWEST;
    if (sound)
        lift->stops[lift->stop_count++] = (JoxLiftStop){
            .storey = storey,
            .door = {door[0], door[1]},
            .place = -1,
            .name = jox_lift_stop_name(lift->name, reading->storeys->storeys[storey].name)};
    jox_free(door);
    return sound || jox_row_fail(row, 2, "it must be the two ends of a door");
}

static bool read_car(JoxTableRow *row, void *context) {
    const Reading *reading = context;
    JoxLiftHistory *h = reading->history;
    uint32_t storey;
    const JoxLift *lift = find_lift(row, reading, 1, 4, &storey);
    const int32_t stop = lift ? jox_lift_stop_at(lift, storey) : -1;
    if (stop < 0)
        return jox_row_fail(row, 4, "it must be one that the lift serves");
    const double lowest = (double)lift->stops[0].height,
                 highest = (double)lift->stops[lift->stop_count - 1].height;
    JOX_RESERVE(h->rows, h->capacity, h->count + 1);
    h->rows[h->count++] = (CarRow){
        jox_row_whole(row, 0, INT64_MIN, INT64_MAX), (uint32_t)(lift - h->lifts),
        (JoxCarLook){.height = (float)jox_row_number(row, 2, lowest - BEYOND, highest + BEYOND),
                     .open = (float)jox_row_number(row, 3, 0.0, 1.0),
                     .stop = (uint32_t)stop,
                     .people = (uint32_t)jox_row_whole(row, 5, 0, MOST_PEOPLE),
                     .mode = jox_row_choice(row, 6, jox_lift_mode_names, JOX_LIFT_MODES)}};
    return jox_row_is_sound(row);
}

/* Lays the lifts out. Returns false with a sentence if one has no stops. */
static bool lay_lifts_out(JoxLiftHistory *h, const JoxStoreys *storeys, JoxText *why) {
    for (uint32_t l = 0; l < h->lift_count; l++) {
        if (h->lifts[l].stop_count == 0) {
            jox_text_printf(why, "table jostle_stop has no storeys of lift %u, '%.60s'", l,
                            h->lifts[l].name);
            return false;
        }
        jox_lift_lay_out(&h->lifts[l], storeys);
    }
    return true;
}

/* Returns whether the rows of all three tables make sense. */
static bool read_tables(JoxLiftHistory *h, struct JoxDatabase *db, const JoxStoreys *storeys,
                        JoxText *why) {
    Reading reading = {h, storeys};
    return jox_table_read(db, "jostle_lift",
                          "SELECT number, name, capacity, points FROM jostle_lift ORDER BY number",
                          1, read_lift, &reading, why) &&
           jox_table_read(db, "jostle_stop",
                          "SELECT lift, storey, door FROM jostle_stop ORDER BY lift, storey", 2,
                          read_stop, &reading, why) &&
           lay_lifts_out(h, storeys, why) &&
           jox_table_read(db, "jostle_car",
                          "SELECT frame, lift, height, open, storey, people, mode FROM "
                          "jostle_car ORDER BY frame, lift",
                          2, read_car, &reading, why);
}

JoxLiftHistory *jox_lift_history_read(struct JoxDatabase *db, const JoxStoreys *storeys,
                                      JoxText *why) {
    JoxLiftHistory *h = jox_alloc(1, sizeof *h);
    const bool good = storeys->storey_count == 0 || read_tables(h, db, storeys, why);
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
