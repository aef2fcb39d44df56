/* Places: what behaviours name in the plane. */
#ifndef JOX_GEOM_PLACE_H
#define JOX_GEOM_PLACE_H

#include "base/text.h"
#include "geom/polygon.h"
#include "geom/walls.h"

/* Number of a kind, an enumerator of place_kinds.h. */
typedef int JoxPlaceKind;

/* Bounding boxes of four members of a set, one array per coordinate of the corners. Boxes of
   missing members contain nothing. */
typedef struct JoxPlaceBoxes {
    float low_x[4], low_y[4], high_x[4], high_y[4]; /* m */
} JoxPlaceBoxes;

typedef struct JoxPlace {
    char *name;
    JoxPlaceKind kind;
    JoxV2 *points;
    uint32_t count;
    float radius;  /* m; points only */
    float spacing; /* m; queues only */
    bool refuge;   /* agents that cannot use stairs wait here while no lift takes them */
    JoxV2 landing; /* m: floor of a lift's car: the point before its door where people arrive who
                      walk there; they enter the car if they ride */
    float landing_radius; /* m; 0: no such floor */
    int32_t start;        /* polygon: index of the line at which circuits begin to count, or -1 */
    int32_t *members;     /* set: indices of places */
    uint32_t member_count;
    JoxPlaceBoxes *boxes; /* set: boxes of its members by fours; NULL until it is finished */
    JoxV2 centre;         /* centroid, midpoint or head */
    JoxV2 low, high;      /* corners of the bounding box of the points, or of all members of a
                             set */
    /* Polygons: a stadium around it that orbits follow, by its axis and its half width, m. */
    JoxV2 axis_a, axis_b;
    float axis_radius;
} JoxPlace;

/* How a place is drawn. */
typedef enum JoxPlaceOutline {
    JOX_OUTLINE_NONE,   /* nothing of its own */
    JOX_OUTLINE_CIRCLE, /* a circle of `radius` about points[0] */
    JOX_OUTLINE_OPEN,   /* a polyline */
    JOX_OUTLINE_RING    /* a closed polyline */
} JoxPlaceOutline;

/* The uses of a place. All of the engine except the reader of scenes tests the form,
   never the kind, as several kinds may share a form. */
typedef enum JoxPlaceForm {
    JOX_FORM_SPOT,  /* a point with a radius: people stop at it */
    JOX_FORM_LINE,  /* two points: people cross it, from its right to its left */
    JOX_FORM_AREA,  /* a ring: people are inside it, counted, gathered, mapped */
    JOX_FORM_QUEUE, /* a polyline: people stand along it, from its head */
    JOX_FORM_SET    /* a collection of other places, its members */
} JoxPlaceForm;

/* Properties of a kind of place. A new kind needs an enumerator in place_kinds.h, a row in place.c,
   and its keys in the table of scenes. */
typedef struct JoxPlaceKindInfo {
    const char *name; /* its key in a scene */
    uint32_t least_points, most_points;
    JoxPlaceForm form;
    JoxPlaceOutline outline;
    uint32_t goal_points; /* people walk to points[0 .. n - 1]; 0: to all of them */
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
/* Returns the size of the floor at a place, m2; a line or a queue's first segment counts half a
   metre to either side; INFINITY for a set. */
double jox_place_floor(const JoxPlace *place);
/* Turn a place with room for the points into a spot, or into a line from points[0] to points[1].
   Call jox_place_finish afterwards. */
void jox_place_make_spot(JoxPlace *place, JoxV2 at, float radius);
void jox_place_make_line(JoxPlace *place);
/* Makes a place with at least three points, counter-clockwise, an area. */
void jox_place_make_area(JoxPlace *place);
/* Makes a place a set of the places [first, first + count). Finish it by jox_place_finish_set. */
void jox_place_make_set(JoxPlace *place, uint32_t first, uint32_t count);

JoxPlaceOutline jox_place_outline(const JoxPlace *place);
/* Returns how many of its points, from the first, people walk to. */
uint32_t jox_place_goal_points(const JoxPlace *place);
/* Returns its radius in m, 0 if it has none. */
float jox_place_radius(const JoxPlace *place);
/* Computes centre, low, high, axis_a, axis_b and axis_radius from kind and points. The axis is the
   polygon's principal direction through its centroid, shortened at both ends by half its width. */
void jox_place_finish(JoxPlace *place);
/* Computes low and high of a set, whose members are finished, and stores their boxes in `boxes`, of
   which there are JOX_PLACE_FOURS(member_count). */
void jox_place_finish_set(const JoxPlace *places, JoxPlace *set, JoxPlaceBoxes *boxes);
#define JOX_PLACE_FOURS(members) (((size_t)(members) + 3) / 4)
/* Copies a place into memory of its own; `to` may be uninitialised. The name may be NULL. */
void jox_place_copy(JoxPlace *to, const JoxPlace *from);
void jox_place_free(JoxPlace *place);
/* Copies a place as a goal of ways, followed by its members: *count places, freed by
   jox_places_free_goal. */
JoxPlace *jox_places_copy_goal(const JoxPlace *places, uint32_t place, uint32_t *count);
void jox_places_free_goal(JoxPlace *places, uint32_t count);
/* Returns whether a point is at a place: inside a polygon, within a point's radius, within half a
   spacing of a queue's head, within 0.5 m of a line; a set: at any member. `places` is the table
   that members index. */
bool jox_place_contains(const JoxPlace *places, uint32_t place, JoxV2 point);
/* Does the same for `count` points: in[k] for points[k]. */
void jox_place_contains_each(const JoxPlace *places, uint32_t place, const JoxV2 *points,
                             uint32_t count, bool *in);
/* Returns the distance to the place, m: 0 inside; a set: to its nearest member; a queue: to its
   head. */
float jox_place_distance(const JoxPlace *places, uint32_t place, JoxV2 point);
/* Returns the nearest point of the place (the point itself if it is inside a polygon). */
JoxV2 jox_place_nearest(const JoxPlace *places, uint32_t place, JoxV2 point);
/* Returns the point of a queue `distance` m behind its head; beyond its end it is extended
   straight. */
JoxV2 jox_place_queue_point(const JoxPlace *place, float distance);
int jox_place_find(const JoxPlace *places, uint32_t count, const char *name);

/* ---- arrival (place_reach.c): at a place, with no wall between ----
   Conditions of behaviours, sinks and steering use these; measurements (density, probes) use the
   functions above, which ignore walls. `walls` holds all walls, open gates too; NULL: none. */

/* Whether no standing wall cuts the straight way from a point, which a place contains, to the
   place: see jox_place_is_reached. */
bool jox_place_has_way(const JoxPlace *places, uint32_t place, const JoxWalls *walls, JoxV2 point);
/* Returns whether a point is at a place (jox_place_contains) and no closed wall cuts the segment to
   the place's nearest point; a set: to that of a member. Ignores solids that contain the nearest
   point and walls on which it lies, but not closed gates, as nobody leaves through a closed door.
   Areas need no free segment. */
static inline bool jox_place_is_reached(const JoxPlace *places, uint32_t place,
                                        const JoxWalls *walls, JoxV2 point) {
    return jox_place_contains(places, place, point) &&
           (!walls || walls->ring_count == 0 || jox_place_has_way(places, place, walls, point));
}
/* Does the same for `count` points: in[k] for points[k]. */
void jox_place_is_reached_each(const JoxPlace *places, uint32_t place, const JoxWalls *walls,
                               const JoxV2 *points, uint32_t count, bool *in);
/* Returns whether a point is where people arrive who walk to a place: jox_place_is_reached, but on
   the landing of a floor of a lift's car, with no closed wall on the way there. */
bool jox_place_is_arrival(const JoxPlace *places, uint32_t place, const JoxWalls *walls,
                          JoxV2 point);
/* Does the same for `count` points: in[k] for points[k]. */
void jox_place_is_arrival_each(const JoxPlace *places, uint32_t place, const JoxWalls *walls,
                               const JoxV2 *points, uint32_t count, bool *in);
/* Returns whether the place's nearest point is nearer than `distance` m and no closed wall cuts the
   segment to it. Ignores solids that contain it, and walls and gates on which it lies: people wait
   in front of a gate with a place on it. */
bool jox_place_is_near(const JoxPlace *places, uint32_t place, const JoxWalls *walls, JoxV2 point,
                       double distance);

/* Appends ", in NAME" for the smallest polygon that contains the point; with `near`, if there is
   none, ", 3.2 m from NAME" for the nearest place within 10 m. */
void jox_place_where(const JoxPlace *places, uint32_t count, JoxV2 at, bool near, JoxText *out);

/* Returns whether two places have the same kind, points, measures, members and boxes. */
bool jox_place_same(const JoxPlace *a, const JoxPlace *b);

#endif
