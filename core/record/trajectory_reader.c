/* Reads frames, walls and shapes of bodies from a recording that trajectory_reader_open.c has
   opened. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "agents/torso.h"
#include "base/mem.h"
#include "base/number/pi.h"
#include "record/storey_tables.h"
#include "record/trajectory_reader_parts.h"

static const float RADIUS = 0.2f;        /* m: where none is recorded */
static const float MOST_RADIUS = 100.0f; /* m: a plausible radius is below it */

JoxTrajectoryReaderInfo jox_trajectory_reader_info(const JoxTrajectoryReader *r) {
    const JoxTrajectories *t = r->in_memory ? r->in_memory : &r->outlines;
    uint32_t lift_count;
    const JoxLift *lifts = jox_lift_history_lifts(t->lifts, &lift_count);
    return (JoxTrajectoryReaderInfo){.fps = r->fps,
                                     .frames = r->frames,
                                     .bounded = r->bounded,
                                     .low = r->low,
                                     .high = r->high,
                                     .walls = &t->walls,
                                     .storeys = t->storeys.storey_count > 0 ? &t->storeys : NULL,
                                     .lifts = lifts,
                                     .lift_count = lift_count,
                                     .groups = (const char *const *)t->groups,
                                     .group_count = t->group_count,
                                     .group_colours = t->group_colours,
                                     .group_clothes = t->group_clothes,
                                     .look = r->look,
                                     .states = r->states,
                                     .state_count = r->state_count,
                                     .whole = r->in_memory != NULL,
                                     .has_force =
                                         r->in_memory ? r->in_memory->force != NULL : r->ours,
                                     .has_bodies = r->bodies != NULL,
                                     .has_walls = t->history != NULL};
}

double jox_trajectory_reader_time(const JoxTrajectoryReader *r, uint32_t frame) {
    return (double)(r->in_memory ? r->in_memory->number[r->in_memory->first[frame]]
                                 : r->number[frame]) /
           r->fps;
}

uint32_t jox_trajectory_reader_find(const JoxTrajectoryReader *r, double time) {
    uint32_t low = 0, high = r->frames; /* frames below `low` are at or before `time` */
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (jox_trajectory_reader_time(r, middle) <= time + 1e-9)
            low = middle + 1;
        else
            high = middle;
    }
    return low ? low - 1 : 0;
}

/* ---- frames ---- */

static bool set_damage(JoxText *why, const char *format, const char *detail) {
    jox_text_printf(why, format, detail);
    return false;
}

/* Tells that the storey in a column of a row, or the stair in the next, is not in the recording. */
static bool set_unplaced(JoxText *why, const char *table, int64_t frame, int64_t id,
                         sqlite3_stmt *row, int column) {
    jox_text_printf(why,
                    "table %s, frame %lld, id %lld: storey is '%.20s' and stair '%.20s': they must "
                    "be in tables jostle_storey and jostle_stair",
                    table, (long long)frame, (long long)id, sqlite3_column_text(row, column),
                    sqlite3_column_text(row, column + 1));
    return false;
}

static void reserve_frame_columns(JoxTrajectoryReader *r, size_t need) {
    if (need <= r->capacity)
        return;
    r->capacity = need + need / 2 + 64;
    r->id = jox_realloc(r->id, r->capacity, sizeof *r->id);
    float **columns[] = {&r->x,      &r->y,           &r->face_x,         &r->face_y,
                         &r->force,  &r->compression, &r->load,           &r->radius,
                         &r->axis_x, &r->axis_y,      &r->contact_radius, &r->fallen};
    for (size_t c = 0; c < sizeof columns / sizeof *columns; c++)
        *columns[c] = jox_realloc(*columns[c], r->capacity, sizeof(float));
    r->state = jox_realloc(r->state, r->capacity, sizeof *r->state);
    r->group = jox_realloc(r->group, r->capacity, sizeof *r->group);
}

/* Returns the index of a state number by bisection, or JOX_NO_RECORDED_STATE. */
static uint32_t find_state_row(const JoxTrajectoryReader *r, int64_t number) {
    uint32_t low = 0, high = r->state_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (r->states[middle].number < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low < r->state_count && r->states[low].number == number ? low : JOX_NO_RECORDED_STATE;
}

/* Returns whether a row has an integer id and a numeric position. SQLite would convert texts and
   NULL to 0. */
static bool has_numeric_position(sqlite3_stmt *row) {
    bool placed = sqlite3_column_type(row, 0) == SQLITE_INTEGER;
    for (int c = 1; c <= 2; c++) {
        const int type = sqlite3_column_type(row, c);
        placed = placed && (type == SQLITE_FLOAT || type == SQLITE_INTEGER);
    }
    return placed;
}

/* Returns the radius in a column, m; RADIUS where it is missing or implausible. */
static float read_radius(sqlite3_stmt *row, int column) {
    const float radius = (float)sqlite3_column_double(row, column);
    return radius > 0.0f && radius < MOST_RADIUS ? radius : RADIUS;
}

/* Reads the torso of person n: breadth and depth in columns from 12 on, the chest's angle before.
   A disc where they are missing or implausible. */
static void read_torso(JoxTrajectoryReader *r, uint32_t n) {
    const double chest = sqlite3_column_double(r->rows, 11);
    const float breadth = (float)sqlite3_column_double(r->rows, 12),
                depth = (float)sqlite3_column_double(r->rows, 13);
    const bool known = breadth > 0.0f && depth > 0.0f && breadth < 2.0f * MOST_RADIUS &&
                       depth < 2.0f * MOST_RADIUS && fabs(chest) <= JOX_TURN;
    const JoxTorso torso =
        known ? jox_torso_of(breadth, depth, r->radius[n]) : (JoxTorso){r->radius[n], 0.0f};
    r->axis_x[n] = -(float)sin(chest) * torso.half;
    r->axis_y[n] = (float)cos(chest) * torso.half;
    r->contact_radius[n] = torso.radius;
    r->torso |= torso.half > 0.0f;
}

/* Copies the current row of the query into element n of the columns. */
static void store_person_row(JoxTrajectoryReader *r, uint32_t n) {
    reserve_frame_columns(r, (size_t)n + 1);
    r->id[n] = sqlite3_column_int64(r->rows, 0);
    r->x[n] = (float)sqlite3_column_double(r->rows, 1);
    r->y[n] = (float)sqlite3_column_double(r->rows, 2);
    if (r->facing) {
        r->face_x[n] = (float)sqlite3_column_double(r->rows, 3);
        r->face_y[n] = (float)sqlite3_column_double(r->rows, 4);
    }
    if (!r->ours)
        return;
    const bool known = sqlite3_column_type(r->rows, 5) != SQLITE_NULL;
    r->state[n] =
        known ? find_state_row(r, sqlite3_column_int64(r->rows, 5)) : JOX_NO_RECORDED_STATE;
    r->force[n] = (float)sqlite3_column_double(r->rows, 6);
    r->compression[n] = (float)sqlite3_column_double(r->rows, 7);
    r->group[n] = (uint16_t)sqlite3_column_int64(r->rows, 8);
    if (r->loads)
        r->load[n] = (float)sqlite3_column_double(r->rows, 9);
    if (r->radii)
        r->radius[n] = read_radius(r->rows, 10);
    if (r->torsos)
        read_torso(r, n);
    if (r->placed &&
        !jox_storey_tables_place(&r->outlines.storeys, sqlite3_column_int64(r->rows, 15),
                                 sqlite3_column_int64(r->rows, 16), &r->y[n]))
        r->y[n] = NAN; /* no such storey */
    r->fallen[n] = r->falls ? (float)sqlite3_column_double(r->rows, 14) : 0.0f;
}

bool jox_trajectory_reader_read_people(JoxTrajectoryReader *r, uint32_t frame,
                                       JoxTrajectoryReaderFrame *out, JoxText *why) {
    uint32_t n = 0;
    int status;
    *out = (JoxTrajectoryReaderFrame){.time = jox_trajectory_reader_time(r, frame)};
    r->torso = false;
    sqlite3_reset(r->rows);
    sqlite3_bind_int64(r->rows, 1, r->number[frame]);
    sqlite3_bind_int64(r->rows, 2, r->from[frame]);
    sqlite3_bind_int64(r->rows, 3, r->from[frame + 1]);
    while ((status = sqlite3_step(r->rows)) == SQLITE_ROW) {
        if (!has_numeric_position(r->rows)) {
            jox_text_printf(why, "in frame %lld a person's id or position is not a number",
                            (long long)r->number[frame]);
            return false;
        }
        store_person_row(r, n);
        if (isnan(r->y[n]))
            return set_unplaced(why, "jostle_row", r->number[frame], r->id[n], r->rows, 15);
        if (!(fabsf(r->x[n]) < 1e6f && fabsf(r->y[n]) < 1e6f))
            return set_damage(why, "%s is more than 1000 km from the origin", "a person");
        if (n > 0 && r->id[n] <= r->id[n - 1]) { /* smaller ids come from a damaged index */
            jox_text_printf(why, "person %lld is in frame %lld twice", (long long)r->id[n],
                            (long long)r->number[frame]);
            return false;
        }
        n++;
    }
    if (status != SQLITE_DONE)
        return set_damage(why, "the recording cannot be read: %s", sqlite3_errmsg(r->db->sqlite));
    out->count = n;
    out->id = r->id;
    out->x = r->x;
    out->y = r->y;
    out->face_x = r->facing ? r->face_x : NULL;
    out->face_y = r->facing ? r->face_y : NULL;
    out->state = r->ours && r->state_count ? r->state : NULL;
    out->force = r->ours ? r->force : NULL;
    out->compression = r->ours ? r->compression : NULL;
    out->load = r->loads ? r->load : NULL;
    out->radius = r->radii ? r->radius : NULL;
    out->axis_x = r->torso ? r->axis_x : NULL;
    out->axis_y = r->torso ? r->axis_y : NULL;
    out->contact_radius = r->torso ? r->contact_radius : NULL;
    out->fallen = r->falls ? r->fallen : NULL;
    out->group = r->ours ? r->group : NULL;
    return true;
}

/* Returns the first row of the bodies of a frame by bisection: they were written in order of
   frames, without an index. */
static int64_t find_first_body(JoxTrajectoryReader *r, int64_t number) {
    int64_t low = 1, high = r->last_body + 1;
    while (low < high) {
        int64_t middle = low + (high - low) / 2;
        sqlite3_reset(r->body_at);
        sqlite3_bind_int64(r->body_at, 1, middle);
        if (sqlite3_step(r->body_at) == SQLITE_ROW && sqlite3_column_int64(r->body_at, 0) < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Reads the bodies of a frame. Returns false with a sentence if a number is not finite. */
static bool read_bodies(JoxTrajectoryReader *r, uint32_t frame, JoxTrajectoryReaderFrame *out,
                        JoxText *why) {
    if (!r->bodies || !r->body_at)
        return true;
    uint32_t n = 0;
    int status;
    const int64_t number = r->number[frame], first = find_first_body(r, number);
    sqlite3_reset(r->bodies);
    sqlite3_bind_int64(r->bodies, 1, first);
    while ((status = sqlite3_step(r->bodies)) == SQLITE_ROW &&
           sqlite3_column_int64(r->bodies, 0) == number) {
        float values[7];
        for (int k = 0; k < 7; k++)
            values[k] = (float)sqlite3_column_double(r->bodies, 2 + k);
        JOX_RESERVE(r->body, r->body_capacity, n + 1);
        JoxRecordBody *body = &r->body[n];
        *body = (JoxRecordBody){(uint32_t)sqlite3_column_int64(r->bodies, 1),
                                values[0],
                                values[1],
                                values[2],
                                values[3],
                                values[4],
                                values[5],
                                values[6]};
        if (r->placed &&
            !jox_storey_tables_place(&r->outlines.storeys, sqlite3_column_int64(r->bodies, 9),
                                     sqlite3_column_int64(r->bodies, 10), &body->y))
            return set_unplaced(why, "jostle_body", number, body->id, r->bodies, 9);
        for (int k = 0; k < 7; k++)
            if (!isfinite(values[k]))
                return set_damage(why, "the %s of a body is not finite", "position or turn");
        n++;
    }
    if (status != SQLITE_ROW && status != SQLITE_DONE)
        return set_damage(why, "the recording cannot be read: %s", sqlite3_errmsg(r->db->sqlite));
    out->body_count = n;
    out->bodies = r->body;
    return true;
}

/* Sets `out` to a frame of a text file, which is in memory. */
static bool read_frame_in_memory(JoxTrajectoryReader *r, uint32_t frame,
                                 JoxTrajectoryReaderFrame *out) {
    JoxFrame stored;
    *out = (JoxTrajectoryReaderFrame){.time = jox_trajectory_reader_time(r, frame)};
    jox_trajectories_frame(r->in_memory, frame, &stored);
    reserve_frame_columns(r, stored.count);
    for (uint32_t i = 0; i < stored.count; i++)
        r->id[i] = stored.key[i];
    out->count = stored.count;
    out->id = r->id;
    out->x = stored.x;
    out->y = stored.y;
    out->face_x = stored.vx; /* people look in the direction of their velocity */
    out->face_y = stored.vy;
    out->force = stored.force;
    out->compression = stored.compression;
    out->load = stored.load;
    out->group = stored.group;
    return true;
}

bool jox_trajectory_reader_read(JoxTrajectoryReader *r, uint32_t frame,
                                JoxTrajectoryReaderFrame *out, JoxText *why) {
    if (r->in_memory)
        return read_frame_in_memory(r, frame, out);
    return jox_trajectory_reader_read_people(r, frame, out, why) && read_bodies(r, frame, out, why);
}

/* ---- walls ---- */

const JoxWalls *jox_trajectory_reader_walls(const JoxTrajectoryReader *r, uint32_t frame) {
    if (r->in_memory)
        return jox_trajectories_walls(r->in_memory, frame);
    return r->outlines.history ? jox_wall_history_at(r->outlines.history, r->number[frame])
                               : &r->outlines.walls;
}

const JoxWalls *jox_trajectory_reader_standing(const JoxTrajectoryReader *r, uint32_t frame) {
    return !r->in_memory && r->outlines.history
               ? jox_wall_history_standing(r->outlines.history, r->number[frame])
               : jox_trajectory_reader_walls(r, frame);
}

uint32_t jox_trajectory_reader_wall_changes(const JoxTrajectoryReader *r, uint32_t frame) {
    return !r->in_memory && r->outlines.history
               ? jox_wall_history_changes(r->outlines.history, r->number[frame])
               : 0;
}

const JoxCarLook *jox_trajectory_reader_cars(const JoxTrajectoryReader *r, uint32_t frame) {
    return jox_lift_history_cars(r->outlines.lifts, r->in_memory ? 0 : r->number[frame]);
}

/* ---- shapes ---- */

uint32_t jox_trajectory_reader_changes(const JoxTrajectoryReader *r, uint32_t frame) {
    uint32_t count = 0;
    while (count < r->change_count && r->changes[count] <= r->number[frame])
        count++;
    return count;
}

/* Parses "x y z, x y z, ..." into the corners of a hull. */
static void read_corners(JoxTrajectoryReader *r, const char *text, JoxBodyLook *out) {
    uint32_t count = 0;
    for (int more = 1; text && more && count < 256;) {
        float at[3] = {0};
        int used = 0;
        if (sscanf(text, "%f %f %f%n", &at[0], &at[1], &at[2], &used) != 3)
            break;
        JOX_RESERVE(r->corners, r->corner_capacity, count + 1);
        r->corners[count++] = (JoxV3){at[0], at[1], at[2]};
        text += used;
        more = *text++ == ',';
    }
    out->corners = r->corners;
    out->corner_count = count;
}

bool jox_trajectory_reader_part(JoxTrajectoryReader *r, uint32_t frame, uint32_t body,
                                uint32_t part, JoxBodyLook *out) {
    *out = (JoxBodyLook){0};
    if (!r->part)
        return false;
    sqlite3_reset(r->part);
    sqlite3_bind_int64(r->part, 1, body);
    sqlite3_bind_int64(r->part, 2, r->number[frame]);
    sqlite3_bind_int64(r->part, 3, part);
    if (sqlite3_step(r->part) != SQLITE_ROW)
        return false;
    float numbers[10];
    bool finite = true;
    for (int k = 0; k < 10; k++) {
        numbers[k] = (float)sqlite3_column_double(r->part, 1 + k);
        finite &= isfinite(numbers[k]);
    }
    const int kind = sqlite3_column_int(r->part, 0);
    if (!finite || kind < JOX_SHAPE_BOX || kind > JOX_SHAPE_HULL)
        return false;
    out->kind = (JoxShapeKind)kind;
    memcpy(out->size, numbers, sizeof out->size);
    out->at = (JoxV3){numbers[3], numbers[4], numbers[5]};
    memcpy(out->turn, numbers + 6, sizeof out->turn);
    if (kind == JOX_SHAPE_HULL)
        read_corners(r, (const char *)sqlite3_column_text(r->part, 11), out);
    return true;
}

const char *jox_trajectory_reader_body_name(JoxTrajectoryReader *r, uint32_t frame, uint32_t body) {
    JoxBodyLook look;
    return jox_trajectory_reader_part(r, frame, body, 0, &look)
               ? (const char *)sqlite3_column_text(r->part, 12)
               : NULL;
}

void jox_trajectory_reader_close(JoxTrajectoryReader *r) {
    if (!r)
        return;
    jox_database_close(r->db); /* finalizes its statements, too */
    jox_trajectories_free(r->in_memory);
    for (uint32_t g = 0; g < r->outlines.group_count; g++)
        jox_free(r->outlines.groups[g]);
    jox_free(r->outlines.groups);
    jox_free(r->outlines.group_colours);
    jox_free(r->outlines.group_clothes);
    jox_free(r->look);
    jox_walls_free(&r->outlines.walls);
    jox_wall_history_free(r->outlines.history);
    jox_storeys_free(&r->outlines.storeys);
    jox_lift_history_free(r->outlines.lifts);
    for (uint32_t s = 0; s < r->state_count; s++) {
        jox_free(r->states[s].machine);
        jox_free(r->states[s].name);
    }
    jox_free(r->states);
    void *columns[] = {r->fallen,      r->axis_x, r->axis_y, r->contact_radius, r->number, r->from,
                       r->id,          r->x,      r->y,      r->face_x,         r->face_y, r->force,
                       r->compression, r->load,   r->radius, r->state,          r->group,  r->body,
                       r->changes,     r->corners};
    for (size_t c = 0; c < sizeof columns / sizeof *columns; c++)
        jox_free(columns[c]);
    jox_free(r);
}
