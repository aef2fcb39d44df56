/* Storeys of a building and the stairs between them. The plane of a world is divided into sheets,
   one above the other along y: each storey is a sheet, and stairs between storeys lie on sheets of
   their own. A point of the plan is moved by whole pitches along y from one sheet to the next, so
   everything that works in one plane works on each sheet, and only what looks over a seam, where a
   stair meets a storey, has to know of sheets. World, nav, geom/field, scene, record and run use
   it. All points named `plan` are in plan; all others are positions in the world's plane. */
#ifndef JOX_GEOM_STOREYS_H
#define JOX_GEOM_STOREYS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"
#include "geom/walls.h"

enum { JOX_MOST_STOREYS = 200, JOX_MOST_STAIRS = 1000 };
#define JOX_SEAM_DEPTH                                                                             \
    2.0f /* m: beyond a seam, within which an agent belongs to the other sheet                     \
          */
#define JOX_LEAST_PITCH 45.0f /* m: so that people see 20 m */
#define JOX_SEAM_REACH 5.0f   /* m: walls this near to a seam are seen from its other side */

typedef struct JoxStorey {
    char *name;
    float height; /* m: elevation of its floor */
} JoxStorey;

typedef enum JoxStairKind { JOX_STAIR_STEPS, JOX_STAIR_RAMP, JOX_STAIR_ESCALATOR } JoxStairKind;
typedef enum JoxStairWay { JOX_STAIR_BOTH_WAYS, JOX_STAIR_UP, JOX_STAIR_DOWN } JoxStairWay;

/* A flat part of a stair: from one distance along its path to another, m. */
typedef struct JoxLanding {
    float from, to;
} JoxLanding;

/* A stair, ramp or escalator: a strip of `width` about a path in plan, which leads from its foot up
   to its head. It rises evenly except on landings, and on the squares where the path turns. One
   whose storeys are the same joins nothing: it is a slope on that storey. */
typedef struct JoxStair {
    char *name;
    JoxStairKind kind;
    JoxStairWay way;
    uint32_t lower, upper; /* storeys */
    JoxV2 *path;           /* m, in plan; at least two points */
    uint32_t path_count;
    float width; /* m */
    JoxLanding *landings;
    uint32_t landing_count;
    float rise; /* m; of a stair between storeys: the difference of their heights */
    float belt; /* m/s along the slope: an escalator's speed, positive upwards; else 0 */
    /* Laid out: */
    uint32_t sheet;
    JoxV2 *outline;  /* m, in plan, counter-clockwise: 2 * path_count points */
    JoxV2 low, high; /* m, in plan: its bounding box */
    uint32_t first_flight, flight_count;
    bool closed; /* nobody sets out over it; who is on it goes on. State of the world */
} JoxStair;

/* A part of a stair that rises evenly: a rectangle about a line in plan. */
typedef struct JoxFlight {
    uint32_t stair;
    JoxV2 from, along; /* m, in plan: middle of its lower end; unit vector upwards */
    float run;         /* m in plan */
    float low;         /* m: elevation of its lower end */
    float slope;       /* m of rise per m in plan */
    /* Time per metre in plan of who goes up, and down, in that on level floor; set by the world. */
    float slowness[2];
} JoxFlight;

/* One side of a seam, where a stair meets a storey: the segment a-b, in plan, that who goes from
   sheet `here` to sheet `there` crosses. Each seam is listed once from either side. */
typedef struct JoxSeam {
    uint32_t here, there; /* sheets */
    uint32_t stair;
    bool enters;  /* `there` is the stair's sheet */
    bool at_head; /* the seam is at the stair's head */
    JoxV2 a, b;   /* m, in plan; from a to b the other side is on the left */
    JoxV2 along;  /* unit vector from a to b */
    float length; /* m */
    float shift;  /* m along y, from a position on `here` to that on `there` */
} JoxSeam;

typedef struct JoxSheet {
    uint32_t first_seam, seam_count;
    uint32_t first_stair, stair_count; /* in `sheet_stairs`: those that lie on it, slopes too */
} JoxSheet;

typedef struct JoxStoreys {
    JoxStorey *storeys; /* from the lowest up; sheet k is storey k */
    uint32_t storey_count;
    JoxStair *stairs;
    uint32_t stair_count;
    /* Laid out: */
    float pitch;     /* m along y from sheet to sheet; 0: not laid out */
    float origin;    /* m: y in plan at which sheets begin */
    float low, high; /* m: extent of the plan along y */
    JoxSheet *sheets;
    uint32_t sheet_count;
    uint32_t *sheet_stairs;
    JoxSeam *seams; /* sorted by sheet */
    uint32_t seam_count;
    JoxFlight *flights;
    uint32_t flight_count;
} JoxStoreys;

/* Returns the length of a stair's path in plan, m. */
float jox_stair_length(const JoxStair *stair);
/* Lays storeys and stairs out: outlines, flights, sheets, seams and the pitch, for a plan between
   `low` and `high` (m in plan), which is widened by all stairs. Stairs whose surroundings overlap
   get different sheets. Call it once all members above "Laid out" are set, or again when they
   change. */
void jox_storeys_lay_out(JoxStoreys *storeys, JoxV2 low, JoxV2 high);
/* Lays storeys and stairs out again as they were, with the same origin and pitch: of a recording.
 */
void jox_storeys_lay_out_again(JoxStoreys *storeys, float origin, float pitch);
/* Returns whether a stair's members are as a layout needs them: points apart and finite, and a
   width that fits, so that its outline encloses an area. */
bool jox_stair_is_sound(const JoxStair *stair);
/* Appends the walls of all stairs: their sides, and, on each storey that they pass, what encloses
   their footprints except at seams (storey_walls.c). */
void jox_storeys_add_walls(const JoxStoreys *storeys, JoxWalls *walls);
/* Copies `from` into memory of its own; frees it. */
void jox_storeys_copy(JoxStoreys *to, const JoxStoreys *from);
void jox_storeys_free(JoxStoreys *storeys);

/* Returns whether a stair leads from storey to storey; else it is a slope on one. */
static inline bool jox_stair_joins(const JoxStair *stair) {
    return stair->lower != stair->upper;
}
/* Returns whether a world has several sheets. */
static inline bool jox_has_storeys(const JoxStoreys *storeys) {
    return storeys && storeys->sheet_count > 1;
}
/* Returns the sheet of a position, the nearest one if it lies beyond all. */
static inline uint32_t jox_sheet_of(const JoxStoreys *s, float y) {
    const float at = (y - s->origin) / s->pitch; /* NAN: the last */
    return (uint32_t)jox_minf(jox_maxf(0.0f, at), (float)(s->sheet_count - 1));
}
/* Returns the position of a point of the plan on a sheet, and the point of a position. */
static inline JoxV2 jox_on_sheet(const JoxStoreys *s, uint32_t sheet, JoxV2 plan) {
    return (JoxV2){plan.x, plan.y + (float)sheet * s->pitch};
}
static inline JoxV2 jox_in_plan(const JoxStoreys *s, JoxV2 at) {
    return jox_has_storeys(s) ? (JoxV2){at.x, at.y - (float)jox_sheet_of(s, at.y) * s->pitch} : at;
}
/* Returns the flight at a position, NULL where the floor is level. */
const JoxFlight *jox_flight_at(const JoxStoreys *storeys, JoxV2 at);
/* Returns whether an escalator runs; and the velocity at which a running one carries who is at a
   position, m/s in plan. */
bool jox_has_belts(const JoxStoreys *storeys);
JoxV2 jox_belt_at(const JoxStoreys *storeys, JoxV2 at);
/* Returns the stair between storeys on whose sheet a position is, -1 on a storey. */
int32_t jox_stair_at(const JoxStoreys *storeys, JoxV2 at);
/* Returns the elevation of the floor at a position, m. */
float jox_floor_height(const JoxStoreys *storeys, JoxV2 at);
/* Returns the storey of a position; on a stair, that which is nearer in height. */
uint32_t jox_storey_at(const JoxStoreys *storeys, JoxV2 at);
/* Returns whether there is floor at a position: within the outline of a stair on its sheet, outside
   the footprints of stairs on a storey. */
bool jox_is_floor(const JoxStoreys *storeys, JoxV2 at);
bool jox_is_floor_of(const JoxStoreys *storeys, uint32_t sheet, JoxV2 plan);
/* Returns the seam beyond which a position lies: an agent there belongs to the sheet `there`, and
   has to be moved by `shift`. NULL if it belongs where it is. */
const JoxSeam *jox_find_crossed_seam(const JoxStoreys *storeys, JoxV2 at);
/* Returns whether the straight way from a point before a seam to one beyond it crosses the seam. */
static inline bool jox_seam_lets_see(const JoxSeam *seam, JoxV2 from_plan, JoxV2 to_plan) {
    const JoxV2 from = jox_sub(from_plan, seam->a), to = jox_sub(to_plan, seam->a);
    const float before = -jox_det(seam->along, from), beyond = jox_det(seam->along, to);
    const float from_along = jox_dot(seam->along, from), to_along = jox_dot(seam->along, to);
    const float sum = before + beyond;
    const float at = from_along * beyond + to_along * before; /* where it crosses, times sum */
    return before >= 0.0f && beyond >= 0.0f && at >= 0.0f && at <= seam->length * sum;
}
/* Returns the seam through which two positions see each other, seen from the first: NULL if they
   are on one sheet, or none joins their sheets in line. */
const JoxSeam *jox_find_seam_between(const JoxStoreys *storeys, JoxV2 from, JoxV2 to);
/* Returns whether the straight way between two positions leaves the sheet of the first. */
bool jox_leads_off_sheet(const JoxStoreys *storeys, JoxV2 from, JoxV2 to);
/* Sets *offset to the way from one position to another, m in plan: straight on one sheet, else over
   a seam through which they see each other. Returns false if there is none. */
bool jox_plan_offset(const JoxStoreys *storeys, JoxV2 from, JoxV2 to, JoxV2 *offset);
/* Returns the distance between two positions, m: straight, through floors if they are on different
   storeys. */
float jox_distance_between(const JoxStoreys *storeys, JoxV2 from, JoxV2 to);

#endif
