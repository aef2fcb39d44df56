/* Reads the walls of a recording and builds those of one frame, which are kept until a frame
   with other rows is asked for. */
#include "record/wall_history.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "record/storey_tables.h"
#include "record/table_rows.h"

enum { MOST_POINTS = 100000, MOST_WALLS = 1000000 };

typedef struct RecordedWall {
    int64_t frame;
    uint32_t number;
    /* same_points: the points are those of the wall's previous row. */
    bool solid, closed, open, same_points, is_lift_door;
    float height; /* m */
    float drawn;  /* m: height up to which it is drawn; 0: its height */
    char *name;
    size_t first; /* index of its first point */
    uint32_t count;
} RecordedWall;

struct JoxWallHistory {
    RecordedWall *rows; /* in ascending order of frame, then number */
    uint32_t count, capacity;
    JoxV2 *points;
    size_t point_count, point_capacity;
    uint32_t *latest; /* 1 + row, by wall number; 0: none. Scratch */
    uint32_t walls;   /* wall numbers are below this */
    /* Walls of one frame; without open gates; these and the open doors of lifts. */
    JoxWalls all, standing, dividing;
    bool built, has_lifts;
    int64_t from, until; /* the walls are valid for frames from <= f < until */
};

/* ---- reading ---- */

/* Parses "x y, x y, ..." and returns how many points there are; 0 if the text is empty or has
   another form. */
static uint32_t parse_wall_points(const char *text, JoxV2 *points) {
    uint32_t count = 0;
    for (bool more = text && *text; more; text++) {
        float x, y;
        int used = 0;
        if (count == MOST_POINTS || sscanf(text, "%f %f%n", &x, &y, &used) != 2 ||
            !(fabsf(x) < 1e6f) || !(fabsf(y) < 1e6f))
            return 0;
        points[count++] = (JoxV2){x, y};
        text += used;
        more = *text == ',';
    }
    return count;
}

static void store_points(JoxWallHistory *h, RecordedWall *row, const JoxV2 *points) {
    row->first = h->point_count;
    JOX_RESERVE(h->points, h->point_capacity, h->point_count + row->count + 1);
    memcpy(h->points + h->point_count, points, row->count * sizeof *points);
    h->point_count += row->count;
}

/* Returns the previous row of a wall; NULL at its first. */
static const RecordedWall *find_previous_row(const JoxWallHistory *h, uint32_t number) {
    return number < h->walls && h->latest[number] ? &h->rows[h->latest[number] - 1] : NULL;
}

/* Adds a row of the table. A ring without points is stored as a removed wall. Returns false with a
   sentence if the row is damaged. */
static bool add_wall_row(JoxWallHistory *h, const JoxTableRow *told, JoxV2 *points,
                         size_t *latest_capacity) {
    sqlite3_stmt *list = told->values;
    const int64_t number = jox_row_whole(told, 1, 0, MOST_WALLS);
    const float given = (float)sqlite3_column_double(list, 6);
    const float drawn = (float)sqlite3_column_double(list, 8);
    const char *name = (const char *)sqlite3_column_text(list, 2);
    const char *text = (const char *)sqlite3_column_text(list, 7);
    const RecordedWall *before = find_previous_row(h, (uint32_t)number);
    RecordedWall row = {.frame = sqlite3_column_int64(list, 0),
                        .number = (uint32_t)number,
                        .solid = sqlite3_column_int(list, 3),
                        .closed = sqlite3_column_int(list, 4),
                        .open = sqlite3_column_int(list, 5),
                        .same_points = !text && before,
                        .height = given > 0.0f && given < 1e6f ? given : INFINITY,
                        .drawn = drawn > 0.0f && drawn < 1e6f ? drawn : 0.0f,
                        .name = name ? jox_strdup(name) : NULL};
    if (row.same_points) {
        row.first = before->first;
        row.count = before->count;
    } else {
        row.count = parse_wall_points(text, points);
        store_points(h, &row, points);
    }
    if (row.count < (row.solid || row.closed ? 3 : 2)) {
        row.count = 0;
        if (text && *text)
            jox_row_fail(told, 7, "it must be 'x y, x y, ...' with 2 points, of a ring 3, or more");
    }
    JOX_RESERVE(h->rows, h->capacity, h->count + 1);
    h->rows[h->count++] = row;
    JOX_RESERVE(h->latest, *latest_capacity, (size_t)number + 1);
    for (; h->walls <= (uint32_t)number; h->walls++)
        h->latest[h->walls] = 0;
    h->latest[number] = h->count;
    return jox_row_is_sound(told);
}

/* Moves the points of a wall from plan to the sheet of its row. Returns false with a sentence if
   the recording lacks that. */
static bool place_wall(JoxWallHistory *h, const JoxTableRow *told, const JoxStoreys *storeys) {
    const RecordedWall *row = &h->rows[h->count - 1];
    const int64_t storey = jox_row_whole(told, 9, 0, (int64_t)storeys->storey_count - 1);
    const int64_t stair = jox_row_whole(told, 10, 0, storeys->stair_count);
    for (uint32_t k = 0; jox_row_is_sound(told) && k < row->count && !row->same_points; k++)
        jox_storey_tables_place(storeys, storey, stair, &h->points[row->first + k].y);
    return jox_row_is_sound(told);
}

/* Marks the walls that are doors of lifts. */
static void mark_lift_doors(JoxWallHistory *h, const JoxLift *lifts, uint32_t count) {
    h->has_lifts = count > 0;
    for (uint32_t r = 0; r < h->count; r++)
        for (uint32_t l = 0; h->rows[r].name && l < count; l++)
            for (uint32_t s = 0; s < lifts[l].stop_count; s++)
                h->rows[r].is_lift_door |= strcmp(lifts[l].stops[s].name, h->rows[r].name) == 0;
}

JoxWallHistory *jox_wall_history_read(JoxDatabase *db, const JoxStoreys *storeys,
                                      const JoxLift *lifts, uint32_t lift_count, JoxText *why) {
    /* Older recordings have no drawn heights, still older ones no frames. */
    static const char *const QUERIES[] = {
        "SELECT frame, number, name, solid, closed, open, height, points, drawn, storey, stair "
        "FROM jostle_wall ORDER BY frame, number",
        "SELECT frame, number, name, solid, closed, open, height, points, drawn FROM jostle_wall "
        "ORDER BY frame, number",
        "SELECT frame, number, name, solid, closed, open, height, points, NULL FROM jostle_wall "
        "ORDER BY frame, number",
        "SELECT 0 AS frame, rowid - 1 AS number, name, solid, closed, open, height, points, NULL "
        "FROM jostle_wall "
        "ORDER BY rowid"};
    sqlite3_stmt *list = NULL;
    const bool placed = storeys->storey_count > 0;
    for (int q = placed ? 0 : 1; q < (placed ? 1 : 4) && !list; q++)
        list = jox_database_prepare(db, QUERIES[q]);
    if (!list && placed)
        jox_text_printf(why, "table jostle_wall cannot be read: %s", sqlite3_errmsg(db->sqlite));
    if (!list)
        return NULL;
    JoxWallHistory *h = jox_alloc(1, sizeof *h);
    JoxV2 *points = jox_alloc(MOST_POINTS, sizeof *points);
    size_t latest_capacity = 0;
    const JoxTableRow told = {list, "jostle_wall", 2, why};
    bool good = true;
    while (good && sqlite3_step(list) == SQLITE_ROW)
        good = add_wall_row(h, &told, points, &latest_capacity) &&
               (!placed || place_wall(h, &told, storeys));
    jox_free(points);
    jox_database_finalize(db, list);
    if (!good) {
        jox_wall_history_free(h);
        return NULL;
    }
    mark_lift_doors(h, lifts, lift_count);
    return h;
}

/* ---- walls of a frame ---- */

/* Adds the wall of a row to `walls`, unless it is removed. */
static void build_recorded_wall(JoxWalls *walls, const RecordedWall *row, const JoxV2 *points) {
    const uint32_t first = walls->ring_count;
    if (row->count == 0)
        return;
    if (row->solid)
        jox_walls_add_solid(walls, points, row->count, row->height);
    else
        jox_walls_add_polyline(walls, points, row->count, row->closed, row->height);
    for (uint32_t ring = first; ring < walls->ring_count; ring++) {
        walls->rings[ring].drawn = row->drawn;
        walls->rings[ring].is_lift_door = row->is_lift_door;
    }
    if (row->name)
        jox_walls_name(walls, first, row->name, row->open);
}

/* Sets `latest` to the row of each wall that holds in a frame, and the range of frames, from <= f <
   until, with the same rows. */
static void find_wall_rows(JoxWallHistory *h, int64_t frame, int64_t *from, int64_t *until) {
    *from = INT64_MIN;
    *until = INT64_MAX;
    if (h->walls == 0)
        return;
    memset(h->latest, 0, h->walls * sizeof *h->latest);
    /* Rows of the first frame hold for earlier frames, too. */
    for (uint32_t r = 0; r < h->count; r++) {
        const bool later = h->rows[r].frame > h->rows[0].frame;
        if (later && h->rows[r].frame > frame) {
            *until = h->rows[r].frame;
            return;
        }
        h->latest[h->rows[r].number] = r + 1;
        *from = later ? h->rows[r].frame : INT64_MIN;
    }
}

static void build_frame_walls(JoxWallHistory *h, int64_t frame, JoxWalls *out, int64_t *from,
                              int64_t *until) {
    find_wall_rows(h, frame, from, until);
    jox_walls_free(out);
    for (uint32_t n = 0; n < h->walls; n++)
        if (h->latest[n])
            build_recorded_wall(out, &h->rows[h->latest[n] - 1],
                                h->points + h->rows[h->latest[n] - 1].first);
}

static void update_frame_walls(JoxWallHistory *h, int64_t frame) {
    if (h->built && frame >= h->from && frame < h->until)
        return;
    build_frame_walls(h, frame, &h->all, &h->from, &h->until);
    jox_walls_standing(&h->standing, &h->all, true);
    if (h->has_lifts)
        jox_walls_dividing(&h->dividing, &h->all);
    h->built = true;
}

void jox_wall_history_first(JoxWallHistory *h, JoxWalls *out) {
    int64_t from, until;
    build_frame_walls(h, INT64_MIN, out, &from, &until);
}

const JoxWalls *jox_wall_history_at(JoxWallHistory *h, int64_t frame) {
    update_frame_walls(h, frame);
    return &h->all;
}

const JoxWalls *jox_wall_history_standing(JoxWallHistory *h, int64_t frame) {
    update_frame_walls(h, frame);
    return &h->standing;
}

const JoxWalls *jox_wall_history_dividing(JoxWallHistory *h, int64_t frame) {
    update_frame_walls(h, frame);
    return h->has_lifts ? &h->dividing : NULL;
}

uint32_t jox_wall_history_changes(const JoxWallHistory *h, int64_t frame) {
    uint32_t changes = 0;
    for (uint32_t r = 0; r < h->count && h->rows[r].frame <= frame; r++)
        changes += h->rows[r].frame > h->rows[0].frame && !h->rows[r].same_points;
    return changes;
}

void jox_wall_history_free(JoxWallHistory *h) {
    if (!h)
        return;
    for (uint32_t r = 0; r < h->count; r++)
        jox_free(h->rows[r].name);
    jox_free(h->rows);
    jox_free(h->points);
    jox_free(h->latest);
    jox_walls_free(&h->all);
    jox_walls_free(&h->standing);
    jox_walls_free(&h->dividing);
    jox_free(h);
}
