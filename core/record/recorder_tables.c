/* Writes what holds for many frames of a recording: names of states and groups, walls, shapes of
   bodies, and what the scene shows besides. */
#include <math.h>

#include "record/recorder_parts.h"

/* Writes texts as a row of a table: a number and the texts, of which NULL stays NULL. */
static void write_texts(JoxRecorder *r, const char *sql, uint32_t number, const char *const *texts,
                        int count) {
    sqlite3_stmt *statement;
    jox_recorder_borrow(r);
    if (jox_recorder_prepare(r, &statement, sql)) {
        sqlite3_bind_int64(statement, 1, number);
        for (int t = 0; t < count; t++)
            sqlite3_bind_text(statement, 2 + t, texts[t], -1, SQLITE_STATIC);
        jox_recorder_execute(r, statement);
        jox_database_finalize(r->db, statement);
    }
    jox_recorder_return(r);
}

/* Writes a colour to `text` and returns it; NULL where there is none. */
static const char *write_given_colour(JoxColour colour, char text[8]) {
    jox_colour_write(colour, text);
    return colour ? text : NULL;
}

void jox_recorder_state(JoxRecorder *r, uint32_t number, const char *machine, const char *state,
                        JoxColour colour, const char *pose) {
    char text[8];
    const char *const texts[] = {machine, state, write_given_colour(colour, text), pose};
    write_texts(r, "INSERT OR REPLACE INTO jostle_state VALUES(?, ?, ?, ?, ?)", number, texts, 4);
}

void jox_recorder_group(JoxRecorder *r, uint32_t number, const char *name, JoxColour colour,
                        const char *clothes) {
    char text[8];
    const char *const texts[] = {name, write_given_colour(colour, text), clothes};
    write_texts(r, "INSERT OR REPLACE INTO jostle_group VALUES(?, ?, ?, ?)", number, texts, 3);
}

void jox_recorder_look(JoxRecorder *r, const char *look) {
    jox_recorder_borrow(r);
    jox_recorder_set_metadata(r, JOX_RECORDED_LOOK, look);
    jox_recorder_return(r);
}

void jox_recorder_wall(JoxRecorder *r, uint32_t frame, uint32_t number, const JoxWalls *walls,
                       uint32_t at, bool points) {
    sqlite3_stmt *statement;
    JoxText text = {0};
    jox_text_add(&text, "");
    const bool storeys = r->storeys.storey_count > 0;
    jox_recorder_borrow(r);
    if (jox_recorder_prepare(
            r, &statement,
            storeys ? "INSERT OR REPLACE INTO jostle_wall VALUES(?,?,?,?,?,?,?,?,?,?,?)"
                    : "INSERT OR REPLACE INTO jostle_wall VALUES(?,?,?,?,?,?,?,?,?)")) {
        const struct JoxWallRing *ring = walls ? &walls->rings[at] : &(struct JoxWallRing){0};
        bool closed = false, twin;
        const uint32_t count = walls ? jox_walls_given(walls, at, &closed, &twin) : 0;
        for (uint32_t i = 0; i < count; i++) {
            const JoxV2 point = jox_in_plan(&r->storeys, walls->vertices[ring->first + i].point);
            jox_text_printf(&text, "%s%.9g %.9g", i ? ", " : "", (double)point.x, (double)point.y);
        }
        sqlite3_bind_int64(statement, 1, frame);
        sqlite3_bind_int64(statement, 2, number);
        sqlite3_bind_text(statement, 3, ring->name, -1, SQLITE_STATIC);
        sqlite3_bind_int(statement, 4, ring->solid);
        sqlite3_bind_int(statement, 5, closed);
        sqlite3_bind_int(statement, 6, ring->open);
        sqlite3_bind_double(statement, 7, isfinite(ring->height) ? (double)ring->height : 0.0);
        sqlite3_bind_double(statement, 9, (double)ring->drawn);
        if (storeys) {
            const JoxV2 first =
                count ? walls->vertices[ring->first].point : (JoxV2){0.0f, r->storeys.origin};
            sqlite3_bind_int64(statement, 10, jox_storey_at(&r->storeys, first));
            sqlite3_bind_int64(statement, 11, jox_stair_at(&r->storeys, first) + 1);
        }
        if (points)
            sqlite3_bind_text(statement, 8, text.data, -1, SQLITE_STATIC);
        jox_recorder_execute(r, statement);
        jox_database_finalize(r->db, statement);
    }
    jox_recorder_return(r);
    jox_text_free(&text);
}

void jox_recorder_part(JoxRecorder *r, uint32_t frame, uint32_t body, uint32_t part,
                       const char *name, const JoxBodyLook *look) {
    const float numbers[] = {look->size[0], look->size[1], look->size[2], look->at.x,
                             look->at.y,    look->at.z,    look->turn[0], look->turn[1],
                             look->turn[2], look->turn[3]};
    JoxText corners = {0};
    for (uint32_t c = 0; c < look->corner_count; c++)
        jox_text_printf(&corners, "%s%.6g %.6g %.6g", c ? ", " : "", (double)look->corners[c].x,
                        (double)look->corners[c].y, (double)look->corners[c].z);
    sqlite3_stmt *statement;
    jox_recorder_borrow(r);
    if (jox_recorder_prepare(
            r, &statement,
            "INSERT OR REPLACE INTO jostle_part VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")) {
        const uint32_t whole[] = {frame, body, part, (uint32_t)look->kind};
        for (int k = 0; k < 4; k++)
            sqlite3_bind_int64(statement, 1 + k, whole[k]);
        for (int k = 0; k < 10; k++)
            sqlite3_bind_double(statement, 5 + k, (double)numbers[k]);
        sqlite3_bind_text(statement, 15, corners.data, -1, SQLITE_STATIC);
        sqlite3_bind_text(statement, 16, name && *name ? name : NULL, -1, SQLITE_STATIC);
        jox_recorder_execute(r, statement);
        jox_database_finalize(r->db, statement);
    }
    jox_recorder_return(r);
    jox_text_free(&corners);
}
