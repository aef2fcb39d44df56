/* Places: what behaviours name in the plane. */
#ifndef JOX_GEOM_PLACE_H
#define JOX_GEOM_PLACE_H

#include "base/text.h"
#include "geom/polygon.h"
#include "geom/walls.h"

/* Number of a kind: an enumerator of place_kinds.h. */
typedef int JoxPlaceKind;

/* Boxes within which all lies that four members of a set hold, a row for each coordinate of a
   corner. Where there are fewer members the others hold nothing. */
typedef struct JoxPlaceBoxes {
    float low_x[4], low_y[4], high_x[4], high_y[4]; /* m */
} JoxPlaceBoxes;

typedef struct JoxPlace {
    char *name;
    JoxPlaceKind kind;
    JoxV2 *points;
    uint32_t count;
    float radius;     /* m; points only */
    float spacing;    /* m; queues only */
    int32_t start;    /* polygon: index of the line from which circuits count, or -1 */
    int32_t *members; /* set: indices of places */
    uint32_t member_count;
    JoxPlaceBoxes *boxes; /* set: of its members, by four; NULL until it is finished */
    JoxV2 centre;         /* centroid, midpoint or head */
    JoxV2 low, high;      /* corners of the box about the points, or about all that a set holds */
    /* Orbits keep to the border of a stadium about a polygon: its axis, and its half width. */
    JoxV2 axis_a, axis_b;
    float axis_radius;
} JoxPlace;

/* How a place is drawn. */
typedef enum JoxPlaceOutline {
    JOX_OUTLINE_NONE,   /* nothing of its own */
    JOX_OUTLINE_CIRCLE, /* of `radius` about points[0] */
    JOX_OUTLINE_OPEN,   /* a polyline */
    JOX_OUTLINE_RING    /* a closed one */
} JoxPlaceOutline;

/* What one can do with a place. All of the engine but the reader of scenes asks for the form, never
   for the kind: several kinds may have one form. */
typedef enum JoxPlaceForm {
    JOX_FORM_SPOT,  /* a point with a radius: people stop at it */
    JOX_FORM_LINE,  /* two points: people cross it, from its right to its left */
    JOX_FORM_AREA,  /* a ring: people are in it, counted, gathered, mapped */
    JOX_FORM_QUEUE, /* a polyline: people stand along it, from its head on */
    JOX_FORM_SET    /* other places, its members */
} JoxPlaceForm;

/* Properties of a kind of place. A new kind is an enumerator above, its row in place.c, and its
   keys in the table of scenes. */
typedef struct JoxPlaceKindInfo {
    const char *name; /* its key in a scene */
    uint32_t least_points, most_points;
    JoxPlaceForm form;
    JoxPlaceOutline outline;
    uint32_t goal_points; /* points[0 .. n - 1] are walked to; 0: all of them */
    JoxV2 (*centre)(const JoxPlace *place);
    bool (*contains)(const JoxPlace *places, const JoxPlace *place, JoxV2 point);
    JoxV2 (*nearest)(const JoxPlace *places, const JoxPlace *place, JoxV2 point);
    const char *meaning; /* for the reference */
} JoxPlaceKindInfo;
extern const JoxPlaceKindInfo jox_place_kinds[]; /* by kind */
extern const uint32_t jox_place_kind_count;

static inline JoxPlaceForm jox_place_form(const JoxPlace *place) {
    return jox_place_kinds[place->kind].form;
}
static inline bool jox_place_is_spot(const JoxPlace *place) {
    return jox_place_form(place) == JOX_FORM_SPOT;
}
static inline bool jox_place_is_line(const JoxPlace *place) {
    return jox_place_form(place) == JOX_FORM_LINE;
}
static inline bool jox_place_is_area(const JoxPlace *place) {
    return jox_place_form(place) == JOX_FORM_AREA;
}
static inline bool jox_place_is_queue(const JoxPlace *place) {
    return jox_place_form(place) == JOX_FORM_QUEUE;
}
static inline bool jox_place_is_set(const JoxPlace *place) {
    return jox_place_form(place) == JOX_FORM_SET;
}
/* Size of the floor on which people are at a place, m2: of a line or the first stretch of a queue,
   half a metre to either side; INFINITY of a set. */
double jox_place_floor(const JoxPlace *place);
/* Makes a place that has room for its points a spot, or a line from points[0] to points[1]. Finish
   it afterwards. */
void jox_place_make_spot(JoxPlace *place, JoxV2 at, float radius);
void jox_place_make_line(JoxPlace *place);
/* Makes a place a set of the places [first, first + count). Finish it by jox_place_finish_set. */
void jox_place_make_set(JoxPlace *place, uint32_t first, uint32_t count);

JoxPlaceOutline jox_place_outline(const JoxPlace *place);
/* How many of its points, from the first, are walked to. */
uint32_t jox_place_goal_points(const JoxPlace *place);
/* Its radius in metres where it has one, else 0. */
float jox_place_radius(const JoxPlace *place);
/* Fills centre, low, high, axis_a, axis_b and axis_radius from kind and points. The axis is the
   polygon's principal direction through its centroid, shortened at both ends by half its width. */
void jox_place_finish(JoxPlace *place);
/* Fills low and high of a set, whose members are finished, and gives it their boxes:
   JOX_PLACE_FOURS of member_count. */
void jox_place_finish_set(const JoxPlace *places, JoxPlace *set, JoxPlaceBoxes *boxes);
#define JOX_PLACE_FOURS(members) (((size_t)(members) + 3) / 4)
/* A place with memory of its own; `to` needs not be initialised. The name of a copy may be NULL. */
void jox_place_copy(JoxPlace *to, const JoxPlace *from);
void jox_place_free(JoxPlace *place);
/* Inside a polygon, within a point's radius, within half a spacing of a queue's head, within 0.5 m
   of a line; a set: inside any member. `places` is the table that members index. */
bool jox_place_contains(const JoxPlace *places, uint32_t place, JoxV2 point);
/* The same of `count` points: in[k] of points[k]. */
void jox_place_contains_each(const JoxPlace *places, uint32_t place, const JoxV2 *points,
                             uint32_t count, bool *in);
/* Distance in metres to the place: 0 inside; a set: to its nearest member; a queue: its head. */
float jox_place_distance(const JoxPlace *places, uint32_t place, JoxV2 point);
/* Nearest point of the place (the point itself when inside a polygon). */
JoxV2 jox_place_nearest(const JoxPlace *places, uint32_t place, JoxV2 point);
/* Point of a queue's polyline `distance` metres behind its head (extended straight at its end). */
JoxV2 jox_place_queue_point(const JoxPlace *place, float distance);
int jox_place_find(const JoxPlace *places, uint32_t count, const char *name);

/* ---- arrival (place_reach.c): being there, with no wall between ----
   Conditions of behaviours, sinks and steering ask this; measurements (density, probes) ask the
   calls above, which know no walls. `walls` are all, with those that are open; NULL: none. */

/* Whether a point is in a place (jox_place_contains) and no standing wall cuts the straight way to
   the place's nearest point; a set: to that of a member. Solids that hold the nearest point do not
   count, and neither do walls on which it lies; closed gates do, as nobody leaves by a doorway that
   is shut. Of an area no way is asked. */
bool jox_place_is_reached(const JoxPlace *places, uint32_t place, const JoxWalls *walls,
                          JoxV2 point);
/* The same of `count` points: in[k] of points[k]. */
void jox_place_is_reached_each(const JoxPlace *places, uint32_t place, const JoxWalls *walls,
                               const JoxV2 *points, uint32_t count, bool *in);
/* Whether the place's nearest point is nearer than `distance` m and no standing wall cuts the way
   to it. Solids that hold it, and walls and gates on which it lies, do not count: people wait
   before a gate whose place lies on it. */
bool jox_place_is_near(const JoxPlace *places, uint32_t place, const JoxWalls *walls, JoxV2 point,
                       double distance);

/* Appends ", in NAME" of the smallest polygon in which the point lies; with `near`, where there is
   none, ", 3.2 m from NAME" of the nearest place within 10 m. */
void jox_place_where(const JoxPlace *places, uint32_t count, JoxV2 at, bool near, JoxText *out);

/* Whether two are of one kind and have the same points, measures and members, in the same boxes. */
bool jox_place_same(const JoxPlace *a, const JoxPlace *b);

#endif
