#include "scene/walls/wall_file_parts.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/database.h"
#include "base/mem.h"
#include "geom/polygon.h"

enum { DEEPEST = 16 }; /* of collections in each other */

typedef struct Parse {
    const char *path, *text, *at, *end;
    const JoxWallFileOptions *options;
    JoxWalls *walls;
    JoxDiagnostics *diagnostics;
    JoxV2 *points;       /* of the ring or line that is read */
    const char **places; /* where each stands */
    uint32_t count, point_capacity, place_capacity;
    uint32_t total;
} Parse;

/* Always false, for `return wrong(...)`. */
static bool wrong(Parse *p, const char *at, const char *hint, const char *format,
                  const char *word) {
    JoxPosition position = {p->path, 1, 1, 0};
    for (const char *c = p->text; c < at; c++) {
        position.column = *c == '\n' ? 1 : position.column + 1;
        position.line += *c == '\n';
    }
    position.end_column = position.column + 1;
    jox_diag_error(p->diagnostics, position, "bad-plan", hint, format, word);
    return false;
}

static void skip(Parse *p) {
    while (p->at < p->end && isspace((unsigned char)*p->at))
        p->at++;
}

/* Takes the character if it comes next. */
static bool take(Parse *p, char c) {
    skip(p);
    if (p->at >= p->end || *p->at != c)
        return false;
    p->at++;
    return true;
}

static bool need(Parse *p, char c, const char *hint) {
    char word[2] = {c, 0};
    return take(p, c) || wrong(p, p->at, hint,
                               p->at < p->end ? "'%s' was expected here"
                                              : "the text ends where '%s' was "
                                                "expected",
                               word);
}

/* A word in upper case, cut where it is longer than any that is known; "" if none comes next. */
static void take_word(Parse *p, char out[24]) {
    uint32_t n = 0;
    skip(p);
    while (p->at < p->end && isalpha((unsigned char)*p->at)) {
        if (n < 23)
            out[n++] = (char)toupper((unsigned char)*p->at);
        p->at++;
    }
    out[n] = 0;
}

static bool take_number(Parse *p, double *out) {
    skip(p);
    if (p->at >= p->end || !strchr("+-.0123456789", *p->at))
        return wrong(p, p->at, "Points are X Y, parted by commas", "a number was expected here%s",
                     "");
    char *end;
    *out = strtod(p->at, &end);
    bool plain = end > p->at && isfinite(*out) && !isalpha((unsigned char)*end);
    for (const char *c = p->at; c < end; c++) /* no 0x10, no nan */
        plain &= !isalpha((unsigned char)*c) || *c == 'e' || *c == 'E';
    if (!plain)
        return wrong(p, p->at, "Points are X Y, parted by commas", "this is no number%s", "");
    p->at = end;
    return true;
}

/* X Y, and Z and M, which have no meaning here. What has come twice is one point. */
static bool take_point(Parse *p) {
    double xy[2], other;
    skip(p);
    const char *at = p->at;
    if (!take_number(p, &xy[0]) || !take_number(p, &xy[1]))
        return false;
    for (int more = 0; more < 2; more++) {
        skip(p);
        if (p->at < p->end && strchr("+-.0123456789", *p->at) && !take_number(p, &other))
            return false;
    }
    xy[0] = (xy[0] - p->options->origin_x) * p->options->unit;
    xy[1] = (xy[1] - p->options->origin_y) * p->options->unit;
    if (!(fabs(xy[0]) <= JOX_PLAN_FAR && fabs(xy[1]) <= JOX_PLAN_FAR))
        return wrong(p, at, "Give `origin: [X, Y]`, a point of the plan that becomes [0, 0]",
                     "this point lies over 10 km from the origin%s", "");
    if (++p->total > JOX_PLAN_MOST_POINTS)
        return wrong(p, at, "Simplify the plan", "a plan has at most 200000 points%s", "");
    JoxV2 point = {(float)xy[0], (float)xy[1]};
    if (p->count && jox_length(jox_sub(point, p->points[p->count - 1])) < JOX_PLAN_NEAR)
        return true;
    JOX_RESERVE(p->points, p->point_capacity, p->count + 1);
    JOX_RESERVE(p->places, p->place_capacity, p->count + 1);
    p->points[p->count] = point;
    p->places[p->count++] = at;
    return true;
}

static bool take_points(Parse *p) {
    p->count = 0;
    if (!need(p, '(', "Points stand in brackets: (0 0, 1 0)"))
        return false;
    do
        if (!take_point(p))
            return false;
    while (take(p, ','));
    return need(p, ')', "Points are X Y, parted by commas");
}

static bool take_line(Parse *p) {
    skip(p);
    const char *at = p->at;
    if (!take_points(p))
        return false;
    bool closed =
        p->count > 3 && jox_length(jox_sub(p->points[0], p->points[p->count - 1])) < JOX_PLAN_NEAR;
    if (p->count < 2)
        return wrong(p, at, NULL, "a wall has two points that lie apart%s", "");
    jox_walls_add_polyline(p->walls, p->points, p->count - closed, closed, p->options->height);
    return true;
}

/* The first ring of a polygon bounds what can be walked; the others are holes in it. */
static bool take_ring(Parse *p, bool hole) {
    uint32_t a, b;
    skip(p);
    const char *at = p->at;
    if (!take_points(p))
        return false;
    bool closed = jox_length(jox_sub(p->points[0], p->points[p->count - 1])) < JOX_PLAN_NEAR;
    if (!closed)
        return wrong(p, at, "Repeat its first point at its end",
                     "this ring does not end where it begins%s", "");
    if (--p->count < 3)
        return wrong(p, at, NULL, "a ring has at least three corners%s", "");
    if (p->count <= JOX_PLAN_MOST_TESTED && jox_polygon_self_crosses(p->points, p->count, &a, &b))
        return wrong(p, p->places[b], "Put the corners in order",
                     "this ring crosses or touches itself, by the edge that begins here%s", "");
    if (fabs(jox_polygon_area(p->points, p->count)) < 1e-6)
        return wrong(p, at, NULL, "this ring encloses no area%s", "");
    if (hole)
        jox_walls_add_solid(p->walls, p->points, p->count, p->options->height);
    else
        jox_walls_add_outline(p->walls, p->points, p->count, p->options->height);
    return true;
}

static bool take_polygon(Parse *p) {
    if (!need(p, '(', "POLYGON ((0 0, 4 0, 4 3, 0 0))"))
        return false;
    for (uint32_t ring = 0; ring == 0 || take(p, ','); ring++)
        if (!take_ring(p, ring > 0))
            return false;
    return need(p, ')', "A polygon's rings are parted by commas");
}

/* "(", items parted by commas, ")". */
static bool take_several(Parse *p, bool (*item)(Parse *)) {
    if (!need(p, '(', NULL))
        return false;
    do
        if (!item(p))
            return false;
    while (take(p, ','));
    return need(p, ')', NULL);
}

static bool take_geometry(Parse *p, int depth) {
    char word[24], empty[24];
    skip(p);
    const char *at = p->at;
    take_word(p, word);
    const char *before = p->at;
    take_word(p, empty);
    if (!strcmp(empty, "Z") || !strcmp(empty, "M") || !strcmp(empty, "ZM")) {
        before = p->at;
        take_word(p, empty);
    }
    if (strcmp(empty, "EMPTY") == 0)
        return true;
    p->at = before;
    if (!strcmp(word, "POLYGON"))
        return take_polygon(p);
    if (!strcmp(word, "MULTIPOLYGON"))
        return take_several(p, take_polygon);
    if (!strcmp(word, "LINESTRING"))
        return take_line(p);
    if (!strcmp(word, "MULTILINESTRING"))
        return take_several(p, take_line);
    if (strcmp(word, "GEOMETRYCOLLECTION") != 0)
        return wrong(
            p, at,
            "POLYGON, MULTIPOLYGON, LINESTRING, MULTILINESTRING and GEOMETRYCOLLECTION are "
            "walls",
            *word ? "'%s' is no geometry that can be walls"
                  : "a plan of walls begins with the name of a geometry%s",
            word);
    if (depth >= DEEPEST)
        return wrong(p, at, NULL, "collections lie too deep in each other%s", "");
    if (!need(p, '(', NULL))
        return false;
    do
        if (!take_geometry(p, depth + 1))
            return false;
    while (take(p, ','));
    return need(p, ')', NULL);
}

bool jox_wall_file_read_wkt(const char *path, const char *text, size_t length,
                            const JoxWallFileOptions *options, JoxWalls *walls,
                            JoxDiagnostics *diagnostics) {
    Parse p = {.path = path,
               .text = text,
               .at = text,
               .end = text + length,
               .options = options,
               .walls = walls,
               .diagnostics = diagnostics};
    uint32_t before = walls->ring_count;
    bool good = true;
    p.at += jox_byte_order_mark_length(text, length);
    do { /* several geometries, one a line, are fine */
        good = good && take_geometry(&p, 0);
        skip(&p);
    } while (good && p.at < p.end);
    if (good && walls->ring_count == before)
        good = wrong(&p, p.at, NULL, "there are no walls in this plan%s", "");
    jox_free(p.points);
    jox_free(p.places);
    return good;
}

bool jox_wall_file_read(const char *path, const char *text, size_t length,
                        const JoxWallFileOptions *options, JoxWalls *walls,
                        JoxDiagnostics *diagnostics) {
    size_t at = jox_byte_order_mark_length(text, length);
    while (at < length && isspace((unsigned char)text[at]))
        at++;
    return (at < length && text[at] == '<' ? jox_wall_file_read_xml : jox_wall_file_read_wkt)(
        path, text, length, options, walls, diagnostics);
}

char *jox_wall_file_recorded(const char *path, JoxDiagnostics *diagnostics) {
    static const char *const TABLES[] = {"geometry", NULL};
    const JoxPosition at = {path, 0, 0, 0};
    JoxText why = {0};
    char *text = NULL;
    JoxDatabase *db = jox_database_open(path, JOX_DATABASE_READ, &why);
    if (db)
        jox_database_bound(db, true);
    if (!db || !jox_database_allow(db, TABLES, &why)) {
        jox_diag_error(diagnostics, at, "bad-plan", NULL, "%s", why.data);
    } else {
        sqlite3_stmt *plan = jox_database_prepare(db, "SELECT wkt FROM geometry LIMIT 1");
        if (plan && sqlite3_step(plan) == SQLITE_ROW && sqlite3_column_text(plan, 0))
            text = jox_strdup((const char *)sqlite3_column_text(plan, 0));
        else
            jox_diag_error(diagnostics, at, "bad-plan",
                           "A recording of JuPedSim or of `jostle run --record` has one",
                           "this database has no table 'geometry' with a plan: %.200s",
                           sqlite3_errmsg(db->sqlite));
    }
    jox_database_close(db);
    jox_text_free(&why);
    return text;
}
