/* A recursive-descent parser of well-known text that adds the geometries to walls of geom. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "geom/polygon.h"
#include "scene/wall_files/wall_file_parts.h"

enum { DEEPEST = 16 }; /* levels of nested collections */

typedef struct WktParser {
    const char *path, *text, *at, *end; /* at: the next character */
    const JoxWallFileOptions *options;
    JoxWalls *walls;
    JoxDiagnostics *diagnostics;
    JoxV2 *points;       /* m, of the ring or line that is being parsed */
    const char **places; /* where each of them stands in the text */
    uint32_t count, point_capacity, place_capacity;
    uint32_t total; /* points of the file so far */
} WktParser;

/* Reports an error at a place of the text. Returns false, for `return report_wkt_error(...)`. */
static bool report_wkt_error(WktParser *p, const char *at, const char *hint, const char *format,
                             const char *word) {
    const JoxPosition position = jox_position_in(p->path, p->text, (size_t)(at - p->text));
    jox_diag_error(p->diagnostics, position, "bad-plan", hint, format, word);
    return false;
}

static void skip_blanks(WktParser *p) {
    while (p->at < p->end && isspace((unsigned char)*p->at))
        p->at++;
}

/* Skips blanks, and the character if it comes next; whether it did. */
static bool skip_character(WktParser *p, char c) {
    skip_blanks(p);
    if (p->at >= p->end || *p->at != c)
        return false;
    p->at++;
    return true;
}

static bool expect_character(WktParser *p, char c, const char *hint) {
    char word[2] = {c, 0};
    return skip_character(p, c) || report_wkt_error(p, p->at, hint,
                                                    p->at < p->end ? "'%s' was expected here"
                                                                   : "the text ends where '%s' was "
                                                                     "expected",
                                                    word);
}

/* Parses a word, in upper case, truncated beyond any known word; "" if no letter comes next. */
static void parse_wkt_word(WktParser *p, char out[24]) {
    uint32_t n = 0;
    skip_blanks(p);
    while (p->at < p->end && isalpha((unsigned char)*p->at)) {
        if (n < 23)
            out[n++] = (char)toupper((unsigned char)*p->at);
        p->at++;
    }
    out[n] = 0;
}

static bool parse_wkt_number(WktParser *p, double *out) {
    skip_blanks(p);
    if (p->at >= p->end || !strchr("+-.0123456789", *p->at))
        return report_wkt_error(p, p->at, "Points are X Y, parted by commas",
                                "a number was expected here%s", "");
    char *end;
    *out = strtod(p->at, &end);
    bool plain = end > p->at && isfinite(*out) && !isalpha((unsigned char)*end);
    for (const char *c = p->at; c < end; c++) /* strtod takes 0x10 and nan, too */
        plain &= !isalpha((unsigned char)*c) || *c == 'e' || *c == 'E';
    if (!plain)
        return report_wkt_error(p, p->at, "Points are X Y, parted by commas", "this is no number%s",
                                "");
    p->at = end;
    return true;
}

/* Parses "X Y [Z [M]]", ignores Z and M, and appends the point unless it repeats the last one. */
static bool parse_wkt_point(WktParser *p) {
    double xy[2], other;
    skip_blanks(p);
    const char *at = p->at;
    if (!parse_wkt_number(p, &xy[0]) || !parse_wkt_number(p, &xy[1]))
        return false;
    for (int more = 0; more < 2; more++) {
        skip_blanks(p);
        if (p->at < p->end && strchr("+-.0123456789", *p->at) && !parse_wkt_number(p, &other))
            return false;
    }
    xy[0] = (xy[0] - p->options->origin_x) * p->options->unit;
    xy[1] = (xy[1] - p->options->origin_y) * p->options->unit;
    if (!(fabs(xy[0]) <= JOX_PLAN_FAR && fabs(xy[1]) <= JOX_PLAN_FAR))
        return report_wkt_error(p, at,
                                "Give `origin: [X, Y]`, a point of the plan that becomes [0, 0]",
                                "this point lies over 10 km from the origin%s", "");
    if (++p->total > JOX_PLAN_MOST_POINTS)
        return report_wkt_error(p, at, "Simplify the plan", "a plan has at most 200000 points%s",
                                "");
    JoxV2 point = {(float)xy[0], (float)xy[1]};
    if (p->count && jox_length(jox_sub(point, p->points[p->count - 1])) < JOX_PLAN_NEAR)
        return true;
    JOX_RESERVE(p->points, p->point_capacity, p->count + 1);
    JOX_RESERVE(p->places, p->place_capacity, p->count + 1);
    p->points[p->count] = point;
    p->places[p->count++] = at;
    return true;
}

static bool parse_wkt_points(WktParser *p) {
    p->count = 0;
    if (!expect_character(p, '(', "Points stand in brackets: (0 0, 1 0)"))
        return false;
    do
        if (!parse_wkt_point(p))
            return false;
    while (skip_character(p, ','));
    return expect_character(p, ')', "Points are X Y, parted by commas");
}

static bool parse_wkt_line(WktParser *p) {
    skip_blanks(p);
    const char *at = p->at;
    if (!parse_wkt_points(p))
        return false;
    bool closed =
        p->count > 3 && jox_length(jox_sub(p->points[0], p->points[p->count - 1])) < JOX_PLAN_NEAR;
    if (p->count < 2)
        return report_wkt_error(p, at, NULL, "a wall has two points that lie apart%s", "");
    jox_walls_add_polyline(p->walls, p->points, p->count - closed, closed, p->options->height);
    return true;
}

/* Parses a ring of a polygon and adds it: the first ring, which bounds the floor, as an outline; a
   hole as a solid. */
static bool parse_wkt_ring(WktParser *p, bool hole) {
    uint32_t a, b;
    skip_blanks(p);
    const char *at = p->at;
    if (!parse_wkt_points(p))
        return false;
    bool closed = jox_length(jox_sub(p->points[0], p->points[p->count - 1])) < JOX_PLAN_NEAR;
    if (!closed)
        return report_wkt_error(p, at, "Repeat its first point at its end",
                                "this ring does not end where it begins%s", "");
    if (--p->count < 3)
        return report_wkt_error(p, at, NULL, "a ring has at least three corners%s", "");
    if (p->count <= JOX_PLAN_MOST_TESTED && jox_polygon_self_crosses(p->points, p->count, &a, &b))
        return report_wkt_error(
            p, p->places[b], "Put the corners in order",
            "this ring crosses or touches itself, by the edge that begins here%s", "");
    if (fabs(jox_polygon_area(p->points, p->count)) < 1e-6)
        return report_wkt_error(p, at, NULL, "this ring encloses no area%s", "");
    if (hole)
        jox_walls_add_solid(p->walls, p->points, p->count, p->options->height);
    else
        jox_walls_add_outline(p->walls, p->points, p->count, p->options->height);
    return true;
}

static bool parse_wkt_polygon(WktParser *p) {
    if (!expect_character(p, '(', "POLYGON ((0 0, 4 0, 4 3, 0 0))"))
        return false;
    for (uint32_t ring = 0; ring == 0 || skip_character(p, ','); ring++)
        if (!parse_wkt_ring(p, ring > 0))
            return false;
    return expect_character(p, ')', "A polygon's rings are parted by commas");
}

/* Parses "(", items separated by commas, ")". */
static bool parse_wkt_list(WktParser *p, bool (*item)(WktParser *)) {
    if (!expect_character(p, '(', NULL))
        return false;
    do
        if (!item(p))
            return false;
    while (skip_character(p, ','));
    return expect_character(p, ')', NULL);
}

static bool parse_wkt_geometry(WktParser *p, int depth) {
    char word[24], empty[24];
    skip_blanks(p);
    const char *at = p->at;
    parse_wkt_word(p, word);
    const char *before = p->at;
    parse_wkt_word(p, empty);
    if (!strcmp(empty, "Z") || !strcmp(empty, "M") || !strcmp(empty, "ZM")) {
        before = p->at;
        parse_wkt_word(p, empty);
    }
    if (strcmp(empty, "EMPTY") == 0)
        return true;
    p->at = before;
    if (!strcmp(word, "POLYGON"))
        return parse_wkt_polygon(p);
    if (!strcmp(word, "MULTIPOLYGON"))
        return parse_wkt_list(p, parse_wkt_polygon);
    if (!strcmp(word, "LINESTRING"))
        return parse_wkt_line(p);
    if (!strcmp(word, "MULTILINESTRING"))
        return parse_wkt_list(p, parse_wkt_line);
    if (strcmp(word, "GEOMETRYCOLLECTION") != 0)
        return report_wkt_error(
            p, at,
            "POLYGON, MULTIPOLYGON, LINESTRING, MULTILINESTRING and GEOMETRYCOLLECTION are "
            "walls",
            *word ? "'%s' is no geometry that can be walls"
                  : "a plan of walls begins with the name of a geometry%s",
            word);
    if (depth >= DEEPEST)
        return report_wkt_error(p, at, NULL, "collections lie too deep in each other%s", "");
    if (!expect_character(p, '(', NULL))
        return false;
    do
        if (!parse_wkt_geometry(p, depth + 1))
            return false;
    while (skip_character(p, ','));
    return expect_character(p, ')', NULL);
}

bool jox_wall_file_read_wkt(const char *path, const char *text, size_t length,
                            const JoxWallFileOptions *options, JoxWalls *walls,
                            JoxDiagnostics *diagnostics) {
    WktParser p = {.path = path,
                   .text = text,
                   .at = text,
                   .end = text + length,
                   .options = options,
                   .walls = walls,
                   .diagnostics = diagnostics};
    uint32_t before = walls->ring_count;
    bool good = true;
    p.at += jox_byte_order_mark_length(text, length);
    do { /* a file may hold several geometries, one a line */
        good = good && parse_wkt_geometry(&p, 0);
        skip_blanks(&p);
    } while (good && p.at < p.end);
    if (good && walls->ring_count == before)
        good = report_wkt_error(&p, p.at, NULL, "there are no walls in this plan%s", "");
    jox_free(p.points);
    jox_free(p.places);
    return good;
}
