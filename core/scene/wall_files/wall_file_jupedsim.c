/* Walls from a geometry of JuPedSim as XML, versions 0.5 to 0.8 of the format: rooms of subrooms,
   whose <polygon>s are walls (often in pieces of two points) and whose <obstacle>s are solid;
   <transition>s are doors; <crossing>s are gaps between subrooms that are always open. */
#include <expat.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/format/name.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "scene/wall_files/wall_file_parts.h"

enum { DEEPEST = 32 }; /* levels of nested elements */

/* The element that a <vertex> belongs to. */
typedef enum Inside { NOTHING, WALL, OBSTACLE, DOOR } Inside;

typedef struct Geometry {
    XML_Parser parser;
    const char *path;
    const JoxWallFileOptions *options;
    JoxWalls *walls;
    JoxDiagnostics *diagnostics;
    bool failed, any, warned; /* an error was reported; a wall was added; warned of slopes */
    int depth;                /* depth of nested elements */
    Inside inside;
    bool in_obstacle;
    float height;  /* m, of the obstacle */
    char door[64]; /* name of the transition's wall */
    JoxV2
        *points; /* m, of the current line: <polygon>s of which each begins where the last ended */
    uint32_t count, capacity;
    uint32_t total; /* points of the file so far */
    uint32_t piece; /* index of the first point of the current <polygon> */
    /* Hash table (open addressing) of the sides of walls added so far: two rooms both have the wall
       between them, which is added once. */
    struct Side {
        int32_t ax, ay, bx, by; /* mm */
        bool used;
    } * sides;
    uint32_t side_count, side_capacity;
} Geometry;

static JoxPosition get_xml_position(const Geometry *g) {
    int line = (int)XML_GetCurrentLineNumber(g->parser);
    int column = (int)XML_GetCurrentColumnNumber(g->parser) + 1;
    return (JoxPosition){g->path, line, column, column + 1};
}

static void report_xml_error(Geometry *g, const char *hint, const char *format, const char *word) {
    if (g->failed)
        return;
    g->failed = true;
    char cut[128];
    snprintf(cut, sizeof cut, "%.100s", word);
    jox_diag_error(g->diagnostics, get_xml_position(g), "bad-plan", hint, format, cut);
    XML_StopParser(g->parser, XML_FALSE);
}

static const char *find_attribute(const char **attributes, const char *name) {
    for (; *attributes; attributes += 2)
        if (strcmp(attributes[0], name) == 0)
            return attributes[1];
    return NULL;
}

/* Parses a decimal number, with blanks around it. */
static bool parse_xml_number(const char *text, double *out) {
    char *end;
    text += strspn(text, " \t\r\n");
    *out = strtod(text, &end);
    for (const char *c = text; c < end; c++)
        if (!strchr("+-.0123456789eE", *c)) /* strtod takes 0x10 and nan, too */
            return false;
    return end > text && isfinite(*out) && end[strspn(end, " \t\r\n")] == 0;
}

/* ---- from points to walls ---- */

static bool are_one_point(JoxV2 a, JoxV2 b) {
    return jox_length(jox_sub(a, b)) < JOX_PLAN_NEAR;
}

static uint32_t find_side_slot(const Geometry *g, const struct Side *side) {
    uint32_t h = 2166136261u;
    const int32_t parts[] = {side->ax, side->ay, side->bx, side->by};
    for (int k = 0; k < 4; k++)
        h = (h ^ (uint32_t)parts[k]) * 16777619u, h ^= h >> 15;
    uint32_t at = h & (g->side_capacity - 1);
    while (g->sides[at].used && (g->sides[at].ax != side->ax || g->sides[at].ay != side->ay ||
                                 g->sides[at].bx != side->bx || g->sides[at].by != side->by))
        at = (at + 1) & (g->side_capacity - 1);
    return at;
}

/* Adds the side between a and b to the table; false if it is there, in either direction. */
static bool add_wall_side(Geometry *g, JoxV2 a, JoxV2 b) {
    struct Side side = {(int32_t)lroundf(a.x * 1000), (int32_t)lroundf(a.y * 1000),
                        (int32_t)lroundf(b.x * 1000), (int32_t)lroundf(b.y * 1000), true};
    if (side.ax > side.bx || (side.ax == side.bx && side.ay > side.by))
        side = (struct Side){side.bx, side.by, side.ax, side.ay, true};
    if (2 * g->side_count >= g->side_capacity) {
        struct Side *before = g->sides;
        uint32_t many = g->side_capacity;
        g->side_capacity = many ? 2 * many : 256;
        g->sides = jox_alloc(g->side_capacity, sizeof *g->sides);
        for (uint32_t s = 0; s < many; s++)
            if (before[s].used)
                g->sides[find_side_slot(g, &before[s])] = before[s];
        jox_free(before);
    }
    uint32_t at = find_side_slot(g, &side);
    if (g->sides[at].used)
        return false;
    g->sides[at] = side;
    g->side_count++;
    return true;
}

/* Adds walls for those sides of the current line that no wall has yet; a closed wall if all sides
   of a ring are new. */
static void add_new_sides(Geometry *g, bool closed) {
    uint32_t from = 0, sides = closed ? g->count : g->count - 1, fresh = 0;
    bool *new = jox_alloc(sides + 1, sizeof *new);
    for (uint32_t s = 0; s < sides; s++)
        fresh += new[s] = add_wall_side(g, g->points[s], g->points[(s + 1) % g->count]);
    if (closed && fresh == sides) {
        jox_walls_add_polyline(g->walls, g->points, g->count, true, g->options->height);
        jox_free(new);
        return;
    }
    if (closed) /* the last side ends at the first point: add_vertex has left room for it */
        g->points[g->count] = g->points[0];
    for (uint32_t s = 0; s <= sides; s++)
        if (!new[s]) { /* new[sides] is false: it ends the last stretch of new sides */
            if (s > from)
                jox_walls_add_polyline(g->walls, g->points + from, s - from + 1, false,
                                       g->options->height);
            from = s + 1;
        }
    jox_free(new);
}

/* Adds the current line as walls, or as an obstacle, and begins another. */
static void add_current_line(Geometry *g) {
    uint32_t a, b;
    if (g->count < 2) {
        g->count = 0;
        return;
    }
    bool closed = g->count > 3 && are_one_point(g->points[0], g->points[g->count - 1]);
    g->count -= closed;
    if (closed && g->in_obstacle && g->count <= JOX_PLAN_MOST_TESTED &&
        jox_polygon_self_crosses(g->points, g->count, &a, &b))
        report_xml_error(g, "Put its corners in order", "this obstacle crosses or touches itself%s",
                         "");
    else if (closed && fabs(jox_polygon_area(g->points, g->count)) < 1e-6)
        report_xml_error(g, NULL, "this line goes there and back: it encloses no area%s", "");
    else if (closed && g->in_obstacle)
        jox_walls_add_solid(g->walls, g->points, g->count, g->height);
    else
        add_new_sides(g, closed);
    g->count = 0;
    g->any = true;
}

static void begin_piece(Geometry *g) {
    JOX_RESERVE(g->points, g->capacity, g->count + 1);
    g->piece = g->count;
}

/* Ends a <polygon>: joins it to the current line if it begins where that ends; else adds that line
   and begins another with it. */
static void end_piece(Geometry *g) {
    uint32_t fresh = g->count - g->piece;
    if (fresh < 2) {
        report_xml_error(
            g, "<polygon><vertex px=\"0\" py=\"0\"/><vertex px=\"4\" py=\"0\"/></polygon>",
            "a wall has two points that lie apart%s", "");
        return;
    }
    if (g->piece == 0)
        return;
    if (are_one_point(g->points[g->piece - 1], g->points[g->piece])) {
        memmove(g->points + g->piece, g->points + g->piece + 1, (fresh - 1) * sizeof *g->points);
        g->count--;
        return;
    }
    JoxV2 *kept = jox_alloc(fresh, sizeof *kept);
    memcpy(kept, g->points + g->piece, fresh * sizeof *kept);
    g->count = g->piece;
    add_current_line(g);
    memcpy(g->points, kept, fresh * sizeof *kept);
    g->count = fresh;
    jox_free(kept);
}

static void end_door(Geometry *g) {
    uint32_t first = g->walls->ring_count;
    if (g->count < 2) {
        report_xml_error(g, "<vertex px=\"0\" py=\"0\"/><vertex px=\"1\" py=\"0\"/>",
                         "a transition has two points that lie apart%s", "");
        return;
    }
    jox_walls_add_polyline(g->walls, g->points, g->count, false, g->options->height);
    jox_walls_name(g->walls, first, g->door, true);
    g->count = 0;
    g->any = true;
}

/* ---- elements ---- */

static void add_vertex(Geometry *g, const char **attributes) {
    static const char *const NAMES[] = {"px", "py"};
    double xy[2];
    for (int k = 0; k < 2; k++) {
        const char *text = find_attribute(attributes, NAMES[k]);
        if (!text || !parse_xml_number(text, &xy[k])) {
            report_xml_error(g, "<vertex px=\"1.5\" py=\"-2\"/>",
                             text ? "'%s' is no number" : "a vertex needs px and py%s",
                             text ? text : "");
            return;
        }
    }
    xy[0] = (xy[0] - g->options->origin_x) * g->options->unit;
    xy[1] = (xy[1] - g->options->origin_y) * g->options->unit;
    if (!(fabs(xy[0]) <= JOX_PLAN_FAR && fabs(xy[1]) <= JOX_PLAN_FAR)) {
        report_xml_error(g, "Give `origin: [X, Y]`, a point of the plan that becomes [0, 0]",
                         "this point lies over 10 km from the origin%s", "");
        return;
    }
    if (++g->total > JOX_PLAN_MOST_POINTS) {
        report_xml_error(g, "Simplify the plan", "a plan has at most 200000 points%s", "");
        return;
    }
    JoxV2 point = {(float)xy[0], (float)xy[1]};
    if (g->count > g->piece && are_one_point(point, g->points[g->count - 1]))
        return;
    JOX_RESERVE(g->points, g->capacity, g->count + 2); /* one more for add_new_sides */
    g->points[g->count++] = point;
}

/* Warns once if a subroom is not level: all floors are projected into one plane. */
static void warn_of_slope(Geometry *g, const char **attributes) {
    static const char *const SLOPES[] = {"A_x", "B_y", "C", "C_z"};
    const char *kind = find_attribute(attributes, "class");
    bool level = !kind || (!strstr(kind, "stair") && !strstr(kind, "escalator"));
    for (int k = 0; k < 4; k++) {
        const char *text = find_attribute(attributes, SLOPES[k]);
        level &= !text || atof(text) == 0.0;
    }
    if (level || g->warned)
        return;
    g->warned = true;
    jox_diag_warn(g->diagnostics, get_xml_position(g), "flattened-plan",
                  "Make a scene of each floor where they lie one above the other",
                  "stairs and raised floors are laid into one plane");
}

static void begin_obstacle(Geometry *g, const char **attributes) {
    double height;
    const char *text = find_attribute(attributes, "height");
    add_current_line(g); /* the walls before it */
    g->in_obstacle = true;
    g->height = g->options->height;
    if (text && parse_xml_number(text, &height) && height > 0.0 &&
        height * g->options->unit < 1000.0)
        g->height = (float)(height * g->options->unit);
}

static void begin_door(Geometry *g, const char **attributes) {
    const char *id = find_attribute(attributes, "id");
    add_current_line(g);
    if (!id || !jox_name_is_plain(id) || strlen(id) > 40) {
        report_xml_error(g, "<transition id=\"1\" ...>",
                         "a transition needs an id: letters and digits%s", "");
        return;
    }
    snprintf(g->door, sizeof g->door, "door-%s", id);
    g->inside = DOOR;
    begin_piece(g);
}

static void XMLCALL begin_element(void *context, const char *name, const char **attributes) {
    Geometry *g = context;
    if (g->failed)
        return;
    if (++g->depth > DEEPEST) {
        report_xml_error(g, NULL, "elements lie too deep in each other%s", "");
    } else if (g->depth == 1) {
        const char *unit = find_attribute(attributes, "unit");
        if (strcmp(name, "geometry") != 0)
            report_xml_error(
                g, "Well-known text (WKT) and the <geometry> of JuPedSim are plans of walls",
                "this XML is a <%s>, not a plan of walls", name);
        else if (unit && strcmp(unit, "m") != 0)
            report_xml_error(g, "unit=\"m\"", "lengths are in metres, not in '%s'", unit);
    } else if (strcmp(name, "subroom") == 0) {
        warn_of_slope(g, attributes);
    } else if (strcmp(name, "obstacle") == 0 && g->inside == NOTHING) {
        begin_obstacle(g, attributes);
    } else if (strcmp(name, "polygon") == 0 && g->inside == NOTHING) {
        g->inside = g->in_obstacle ? OBSTACLE : WALL;
        begin_piece(g);
    } else if (strcmp(name, "transition") == 0 && g->inside == NOTHING) {
        begin_door(g, attributes);
    } else if (strcmp(name, "vertex") == 0 && g->inside != NOTHING) {
        add_vertex(g, attributes);
    } else if (strcmp(name, "file") == 0) {
        jox_diag_warn(g->diagnostics, get_xml_position(g), "flattened-plan",
                      "Copy its transitions into this file",
                      "the file that is named here is not read");
    }
}

static void XMLCALL end_element(void *context, const char *name) {
    Geometry *g = context;
    if (g->failed)
        return;
    g->depth--;
    if (strcmp(name, "polygon") == 0 && (g->inside == WALL || g->inside == OBSTACLE)) {
        g->inside = NOTHING;
        end_piece(g);
    } else if (strcmp(name, "transition") == 0 && g->inside == DOOR) {
        g->inside = NOTHING;
        end_door(g);
    } else if (g->inside == NOTHING && (!strcmp(name, "obstacle") || !strcmp(name, "subroom") ||
                                        !strcmp(name, "geometry"))) {
        add_current_line(g);
        g->in_obstacle = false;
    }
}

static void XMLCALL refuse_doctype(void *context, const char *name, const char *system,
                                   const char *public, int internal) {
    (void)name, (void)system, (void)public, (void)internal;
    report_xml_error(context, "Take the <!DOCTYPE> out", "a plan has no document type%s", "");
}

static void free_xml_parser(void *parser) {
    XML_ParserFree(parser);
}

bool jox_wall_file_read_jupedsim(const char *path, const char *text, size_t length,
                                 const JoxWallFileOptions *options, JoxWalls *walls,
                                 JoxDiagnostics *diagnostics) {
    Geometry g = {.path = path, .options = options, .walls = walls, .diagnostics = diagnostics};
    g.parser = XML_ParserCreate(NULL);
    if (!g.parser)
        jox_out_of_memory(0);
    jox_heap_register(g.parser, free_xml_parser);
    XML_SetUserData(g.parser, &g);
    XML_SetElementHandler(g.parser, begin_element, end_element);
    XML_SetStartDoctypeDeclHandler(g.parser, refuse_doctype);
    const bool parsed = XML_Parse(g.parser, text, (int)length, 1) == XML_STATUS_OK;
    if (!parsed && XML_GetErrorCode(g.parser) == XML_ERROR_NO_MEMORY)
        jox_out_of_memory(0);
    if (!parsed)
        report_xml_error(&g,
                         XML_GetErrorCode(g.parser) == XML_ERROR_INVALID_TOKEN
                             ? "A file that is not UTF-8 names its encoding in its first line"
                             : NULL,
                         "this is no XML: %s", XML_ErrorString(XML_GetErrorCode(g.parser)));
    else if (!g.any)
        report_xml_error(&g, "<geometry><rooms><room><subroom><polygon>...",
                         "there are no walls in this plan%s", "");
    jox_heap_unregister(g.parser);
    XML_ParserFree(g.parser);
    jox_free(g.points);
    jox_free(g.sides);
    return !g.failed;
}
