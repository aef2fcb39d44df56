/* Writes storeys and stairs of a recording: names, heights, shapes and walkable areas, in plan. */
#include <math.h>

#include "base/mem.h"
#include "geom/polygon.h"
#include "record/recorder_parts.h"
#include "record/storey_tables.h"

void jox_recorder_write_points(JoxText *out, const JoxV2 *points, uint32_t count) {
    for (uint32_t k = 0; k < count; k++)
        jox_text_printf(out, "%s%.9g %.9g", k ? ", " : "", (double)points[k].x,
                        (double)points[k].y);
}

/* Adds a wall ring of a storey to walls in plan. */
static void add_ring_in_plan(JoxWalls *out, const JoxStoreys *storeys, const JoxWalls *walls,
                             uint32_t ring) {
    const struct JoxWallRing *r = &walls->rings[ring];
    JoxV2 *points = jox_walls_ring_points(walls, ring);
    for (uint32_t k = 0; k < r->count; k++)
        points[k] = jox_in_plan(storeys, points[k]);
    if (r->solid)
        jox_walls_add_solid(out, points, r->count, r->height);
    else if (r->outline)
        jox_walls_add_outline(out, points, r->count, r->height);
    jox_free(points);
}

/* Appends the walkable area of a storey: without its solid walls and the footprints of stairs that
   begin, end or pass there. */
static void write_storey_area(JoxText *out, const JoxStoreys *storeys, uint32_t storey,
                              const JoxWalls *walls, JoxV2 low, JoxV2 high) {
    JoxWalls here = {0};
    bool outlined = false;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        if (!(ring->solid || ring->outline) ||
            jox_sheet_of(storeys, walls->vertices[ring->first].point.y) != storey)
            continue;
        add_ring_in_plan(&here, storeys, walls, r);
        outlined |= ring->outline;
    }
    for (uint32_t k = 0; k < storeys->stair_count; k++) {
        const JoxStair *stair = &storeys->stairs[k];
        if (stair->lower < stair->upper && stair->lower <= storey && storey <= stair->upper)
            jox_walls_add_solid(&here, stair->outline, 2 * stair->path_count, INFINITY);
    }
    if (outlined)
        jox_wkt_outlines(&here, out);
    else
        jox_wkt(&here, low, high, out);
    jox_walls_free(&here);
}

/* Appends the outline of a stair. */
static void write_stair_area(JoxText *out, const JoxStair *stair) {
    jox_text_add(out, "POLYGON ((");
    jox_recorder_write_points(out, stair->outline, 2 * stair->path_count);
    jox_text_printf(out, ", %.9g %.9g))", (double)stair->outline[0].x, (double)stair->outline[0].y);
}

static bool write_storey(JoxRecorder *r, uint32_t number, const char *area) {
    const JoxStorey *storey = &r->storeys.storeys[number];
    sqlite3_stmt *row;
    if (!jox_recorder_prepare(r, &row, "INSERT INTO jostle_storey VALUES(?, ?, ?, ?)"))
        return false;
    sqlite3_bind_int64(row, 1, number);
    sqlite3_bind_text(row, 2, storey->name, -1, SQLITE_STATIC);
    sqlite3_bind_double(row, 3, (double)storey->height);
    sqlite3_bind_text(row, 4, area, -1, SQLITE_STATIC);
    const bool good = jox_recorder_execute(r, row);
    jox_database_finalize(r->db, row);
    return good;
}

static bool write_stair(JoxRecorder *r, uint32_t number) {
    const JoxStair *stair = &r->storeys.stairs[number];
    JoxText path = {0}, landings = {0}, area = {0};
    sqlite3_stmt *row;
    if (!jox_recorder_prepare(
            r, &row, "INSERT INTO jostle_stair VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"))
        return false;
    jox_recorder_write_points(&path, stair->path, stair->path_count);
    for (uint32_t k = 0; k < stair->landing_count; k++)
        jox_text_printf(&landings, "%s%.9g %.9g", k ? ", " : "", (double)stair->landings[k].from,
                        (double)stair->landings[k].to);
    write_stair_area(&area, stair);
    const int64_t whole[] = {number, 0, stair->kind, stair->way, stair->lower, stair->upper};
    for (int k = 0; k < 6; k++)
        sqlite3_bind_int64(row, 1 + k, whole[k]);
    sqlite3_bind_text(row, 2, stair->name, -1, SQLITE_STATIC);
    sqlite3_bind_text(row, 3, jox_stair_kind_names[stair->kind], -1, SQLITE_STATIC);
    sqlite3_bind_text(row, 4, jox_stair_way_names[stair->way], -1, SQLITE_STATIC);
    sqlite3_bind_text(row, 7, path.data, -1, SQLITE_STATIC);
    sqlite3_bind_double(row, 8, (double)stair->width);
    sqlite3_bind_text(row, 9, landings.data, -1, SQLITE_STATIC);
    sqlite3_bind_double(row, 10, (double)stair->rise);
    sqlite3_bind_double(row, 11, (double)stair->belt);
    sqlite3_bind_text(row, 12, area.data, -1, SQLITE_STATIC);
    const bool good = jox_recorder_execute(r, row);
    jox_database_finalize(r->db, row);
    jox_text_free(&path);
    jox_text_free(&landings);
    jox_text_free(&area);
    return good;
}

/* Writes a number so that it is read back exactly. */
static bool write_exactly(JoxRecorder *r, const char *key, float value) {
    char text[32];
    snprintf(text, sizeof text, "%.9g", (double)value);
    return jox_recorder_set_metadata(r, key, text);
}

void jox_recorder_describe_storeys(JoxRecorder *r, const JoxWalls *walls, JoxV2 low, JoxV2 high) {
    jox_recorder_borrow(r);
    bool good = write_exactly(r, JOX_RECORDED_ORIGIN, r->storeys.origin) &&
                write_exactly(r, JOX_RECORDED_PITCH, r->storeys.pitch);
    for (uint32_t k = 0; good && k < r->storeys.storey_count; k++) {
        JoxText area = {0};
        write_storey_area(&area, &r->storeys, k, walls, low, high);
        good = write_storey(r, k, area.data);
        jox_text_free(&area);
    }
    for (uint32_t k = 0; good && k < r->storeys.stair_count; k++)
        good = write_stair(r, k);
    r->failed |= !good;
    jox_recorder_return(r);
}
