/* Reads walls, or the outlines of the walkable area, and groups from a recording in the JuPedSim
   format. Versions 1 and 2 store the area differently; both have its text in `geometry.wkt`. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/database.h"
#include "base/format/colour.h"
#include "base/mem.h"
#include "record/trajectories.h"
#include "world/population.h"

enum { MOST_RING = 5000 };

/* Adds every ring of points in a well-known text as a closed line, whatever geometry it belongs
   to. */
static void read_outlines(JoxTrajectories *t, const char *wkt) {
    JoxV2 ring[MOST_RING];
    while ((wkt = strchr(wkt, '('))) {
        uint32_t count = 0;
        const char *at = ++wkt;
        bool good = true;
        while (good && *at && *at != '(' && *at != ')') {
            char *end;
            double x = strtod(at, &end), y = end != at ? strtod(at = end, &end) : 0.0;
            good = end != at && isfinite(x) && isfinite(y) && count < MOST_RING;
            if (!good)
                break;
            ring[count++] = (JoxV2){(float)x, (float)y};
            at = end + strspn(end, " ,");
        }
        if (count > 1 && ring[0].x == ring[count - 1].x && ring[0].y == ring[count - 1].y)
            count--;
        if (good && count >= 3)
            jox_walls_add_polyline(&t->walls, ring, count, true, INFINITY);
    }
}

static void read_geometry(JoxTrajectories *t, JoxDatabase *db) {
    sqlite3_stmt *statement = jox_database_prepare(db, "SELECT wkt FROM geometry LIMIT 1");
    if (statement && sqlite3_step(statement) == SQLITE_ROW && sqlite3_column_text(statement, 0))
        read_outlines(t, (const char *)sqlite3_column_text(statement, 0));
    jox_database_finalize(db, statement);
}

JoxColour jox_trajectory_colour(sqlite3_stmt *row, int column) {
    const char *text = (const char *)sqlite3_column_text(row, column);
    JoxColour colour = 0;
    return text && jox_colour_read(text, &colour) ? colour : 0;
}

uint32_t jox_trajectory_choice(sqlite3_stmt *row, int column, const char *const *names,
                               uint32_t count) {
    const char *text = (const char *)sqlite3_column_text(row, column);
    uint32_t found = 0;
    for (uint32_t n = 0; text && n < count && !found; n++)
        found = names[n] && strcmp(text, names[n]) == 0 ? n : 0;
    return found;
}

/* Reads names, colours and clothes of groups from our own recordings. */
static void read_groups(JoxTrajectories *t, JoxDatabase *db) {
    /* Older recordings have no clothes, still older ones no colours. */
    static const char *const QUERIES[] = {
        "SELECT name, colour, clothes FROM jostle_group ORDER BY number",
        "SELECT name, colour, NULL FROM jostle_group ORDER BY number",
        "SELECT name, NULL, NULL FROM jostle_group ORDER BY number"};
    sqlite3_stmt *statement = NULL;
    size_t capacity = 0, colour_capacity = 0, clothes_capacity = 0;
    for (int q = 0; q < 3 && !statement; q++)
        statement = jox_database_prepare(db, QUERIES[q]);
    while (statement && t->group_count < UINT16_MAX && sqlite3_step(statement) == SQLITE_ROW) {
        const char *name = (const char *)sqlite3_column_text(statement, 0);
        JOX_RESERVE(t->groups, capacity, t->group_count + 1);
        JOX_RESERVE(t->group_colours, colour_capacity, t->group_count + 1);
        JOX_RESERVE(t->group_clothes, clothes_capacity, t->group_count + 1);
        t->group_colours[t->group_count] = jox_trajectory_colour(statement, 1);
        t->group_clothes[t->group_count] =
            jox_trajectory_choice(statement, 2, jox_clothes_names, jox_clothes_count);
        t->groups[t->group_count++] = jox_strdup(name ? name : "");
    }
    jox_database_finalize(db, statement);
}

bool jox_trajectories_read_walls(JoxTrajectories *t, JoxDatabase *db, JoxText *why) {
    uint32_t lift_count;
    const JoxLift *lifts = jox_lift_history_lifts(t->lifts, &lift_count);
    t->history = jox_wall_history_read(db, &t->storeys, lifts, lift_count, why);
    if (t->history)
        jox_wall_history_first(t->history, &t->walls);
    else if (why->length == 0)
        read_geometry(t, db);
    read_groups(t, db);
    return why->length == 0;
}
