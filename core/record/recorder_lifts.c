/* Writes the lifts of a recording: shafts and doors in plan. recorder.c writes their cars. */
#include "record/recorder_parts.h"

static bool write_lift(JoxRecorder *r, uint32_t number, const JoxLift *lift) {
    JoxText points = {0};
    sqlite3_stmt *row;
    if (!jox_recorder_prepare(r, &row, "INSERT INTO jostle_lift VALUES(?, ?, ?, ?)"))
        return false;
    jox_recorder_write_points(&points, lift->outline, lift->point_count);
    sqlite3_bind_int64(row, 1, number);
    sqlite3_bind_text(row, 2, lift->name, -1, SQLITE_STATIC);
    sqlite3_bind_int64(row, 3, lift->capacity);
    sqlite3_bind_text(row, 4, points.data, -1, SQLITE_STATIC);
    const bool good = jox_recorder_execute(r, row);
    jox_database_finalize(r->db, row);
    jox_text_free(&points);
    return good;
}

static bool write_stop(JoxRecorder *r, uint32_t lift, const JoxLiftStop *stop) {
    JoxText door = {0};
    sqlite3_stmt *row;
    if (!jox_recorder_prepare(r, &row, "INSERT INTO jostle_stop VALUES(?, ?, ?)"))
        return false;
    jox_recorder_write_points(&door, stop->door, 2);
    sqlite3_bind_int64(row, 1, lift);
    sqlite3_bind_int64(row, 2, stop->storey);
    sqlite3_bind_text(row, 3, door.data, -1, SQLITE_STATIC);
    const bool good = jox_recorder_execute(r, row);
    jox_database_finalize(r->db, row);
    jox_text_free(&door);
    return good;
}

void jox_recorder_describe_lifts(JoxRecorder *r, const JoxLift *lifts, uint32_t count) {
    jox_recorder_borrow(r);
    bool good = true;
    for (uint32_t l = 0; good && l < count; l++) {
        good = write_lift(r, l, &lifts[l]);
        for (uint32_t s = 0; good && s < lifts[l].stop_count; s++)
            good = write_stop(r, l, &lifts[l].stops[s]);
    }
    r->failed |= !good;
    jox_recorder_return(r);
}
