/* What agents see of rigid bodies: written by body/ after each of its steps, read by nav, force and
   machine. Indices are rows of this table and stay as long as the body lives. */
#ifndef JOX_GEOM_OBJECTS_H
#define JOX_GEOM_OBJECTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"

enum {
    JOX_FOOTPRINT_POINTS = 16,
    JOX_MOST_NEAREST = 24 /* bodies that one agent minds at a time */
};

typedef struct JoxObject {
    uint32_t id;     /* of the body, never reused */
    bool live;       /* false: the row is free */
    bool in_band;    /* some of it is within the agents' height band: can be touched */
    bool moves;      /* by what pushes it; false: mass 0, static or kinematic */
    bool kinematic;  /* moves by a velocity of its own: pushes, and is not pushed */
    bool grounded;   /* touches the ground or rests upon something static */
    bool held;       /* carried by an agent: touches nothing */
    uint32_t holder; /* its id */
    bool swept;      /* fast: body/ itself sweeps it against people; forces leave it out */
    uint64_t tags;
    JoxV3 position;           /* centre of mass, m */
    JoxV3 velocity;           /* m/s */
    JoxV3 spin;               /* angular velocity, rad/s */
    float disc;               /* radius of the projected bounding disc about position.xy, m */
    float sphere;             /* radius of the bounding sphere about position, m */
    float inverse_mass;       /* 1/kg; 0 static or kinematic */
    float inverse_inertia[9]; /* world frame, row major, 1/(kg m2) */
    /* Footprint within the height band: a convex ring, counter-clockwise, or, with count 0, the
       disc of radius `round` about position.xy. */
    JoxV2 footprint[JOX_FOOTPRINT_POINTS];
    uint32_t footprint_count;
    float round;
    float low, high;    /* heights that the footprint covers within the band, m */
    float below, above; /* m: of its lowest and highest point, from position.z */
    float restitution, friction;
    /* Of one that is kinematic: how it goes on if nothing holds it up, m/s and rad/s (velocity and
       spin are how it went in the last step); what it presses people with at most, N, 0: no limit.
     */
    JoxV3 drive, drive_spin;
    float force_limit;
} JoxObject;

static const float JOX_EYE_LEVEL = 1.3f; /* m: lower walls and bodies are looked over */

/* Whether a body is as tall as walls that are not looked over, and as wide as people are. */
static inline bool jox_object_hides_people(const JoxObject *body) {
    const float wide = 0.25f; /* m, bounding radius */
    return body->live && body->in_band && body->low < JOX_EYE_LEVEL &&
           body->high >= JOX_EYE_LEVEL && jox_maxf(body->disc, body->round) >= wide;
}

/* An impulse on a body at a point, both in world coordinates: N s and m. The share `lasting` acts
   evenly throughout the step, as the force of somebody who leans on what is held does; the rest at
   its beginning. */
typedef struct JoxImpulse {
    uint32_t object;
    JoxV3 impulse, point;
    float lasting;
} JoxImpulse;

/* The velocity that people reckon with at a point of a body, m/s: that of its centre; of one that
   is kinematic, which turns as steadily as it goes, with its turning. */
static inline JoxV2 jox_object_velocity_at(const JoxObject *body, JoxV2 point) {
    JoxV2 v = {body->velocity.x, body->velocity.y};
    if (body->kinematic) {
        v.x -= body->spin.z * (point.y - body->position.y);
        v.y += body->spin.z * (point.x - body->position.x);
    }
    return v;
}

#define JOX_NO_OBJECT UINT32_MAX

/* A point at which a moving body touches another, or ground, wall or a static body. */
typedef struct JoxObjectContact {
    uint32_t first, second; /* rows, the first of a body that can be pushed; second is JOX_NO_OBJECT
                               where it is static */
    JoxV3 point, normal;    /* m; unit, it points to the first */
    float gap, friction;    /* m; coefficient of the two together */
    float force;            /* along the normal in the step before, N */
} JoxObjectContact;

/* All of them, in an order of Bullet's. */
typedef struct JoxObjectContacts {
    const JoxObjectContact *items;
    uint32_t count;
} JoxObjectContacts;

/* What a body covers in the plane, m, and the cells that this reaches into, all inclusive; none
   where agents cannot meet it: `left` is beyond `right`. */
typedef struct JoxCover {
    JoxV2 low, high;
    uint32_t left, bottom, right, top;
} JoxCover;

/* Which bodies are where: cells that list the rows of those whose bounds reach into them. */
typedef struct JoxObjectGrid {
    JoxV2 low, high;
    float cell;
    uint32_t laid;          /* rows that there were when it was laid */
    uint32_t columns, rows; /* 0: no body can be met */
    bool hides_people;      /* some body does */
    uint32_t *starts;       /* per cell, and one more */
    uint32_t *members;      /* rows of bodies, ascending within a cell */
    JoxCover *covers;       /* per row of bodies */
    size_t start_capacity, member_capacity, cover_capacity;
} JoxObjectGrid;

typedef struct JoxObjects {
    JoxObject *rows;
    uint32_t count, capacity;
    /* What holds bodies: listed for who asks, as few steps need it, as the bodies stand then. NULL:
       they are in `contacts`. */
    JoxObjectContacts (*list_contacts)(void *bodies);
    void *bodies;
    JoxObjectContacts contacts;
    float gravity; /* m/s2, downwards */
    JoxObjectGrid grid;
} JoxObjects;

static inline JoxObjectContacts jox_objects_contacts(const JoxObjects *objects) {
    return objects->list_contacts ? objects->list_contacts(objects->bodies) : objects->contacts;
}

/* Lays the grid over the bodies that are live and in the agents' band; call it again when they have
   moved. */
void jox_objects_lay(JoxObjects *objects);
void jox_objects_free_grid(JoxObjects *objects);

/* A walk over the bodies whose bounds come within reach of a point along both axes: at least over
   those, each once, in an order that depends on the bodies and the point alone. */
typedef struct JoxObjectWalk {
    const JoxObjectGrid *grid;
    uint32_t left, bottom, right, top; /* cells, all inclusive */
    uint32_t column, row;
    uint32_t at, end; /* members of the present cell that are left */
} JoxObjectWalk;

JoxObjectWalk jox_objects_near(const JoxObjects *objects, JoxV2 point, float reach);

/* The next row; false at the end. */
static inline bool jox_objects_next(JoxObjectWalk *walk, uint32_t *row) {
    const JoxObjectGrid *g = walk->grid;
    for (;;) {
        while (walk->at < walk->end) {
            uint32_t found = g->members[walk->at++];
            /* A body that is in several of the cells counts in the first of them. */
            uint32_t column = g->covers[found].left, line = g->covers[found].bottom;
            if ((column > walk->left ? column : walk->left) == walk->column &&
                (line > walk->bottom ? line : walk->bottom) == walk->row) {
                *row = found;
                return true;
            }
        }
        if (walk->column < walk->right) {
            walk->column++;
        } else if (walk->row < walk->top) {
            walk->column = walk->left;
            walk->row++;
        } else {
            return false;
        }
        const uint32_t *starts = g->starts + (size_t)walk->row * g->columns + walk->column;
        walk->at = starts[0];
        walk->end = starts[1];
    }
}

/* Whether a body's bounding disc comes within reach of a point. */
static inline bool jox_object_reaches(const JoxObject *body, JoxV2 point, float reach) {
    float most = reach + jox_maxf(body->disc, body->round);
    return jox_length2(jox_v2(body->position.x - point.x, body->position.y - point.y)) <=
           most * most;
}

/* The nearest of the bodies that are offered, at most `most` (JOX_MOST_NEAREST). */
typedef struct JoxNearest {
    uint32_t most, count;
    uint32_t rows[JOX_MOST_NEAREST];
    float gaps[JOX_MOST_NEAREST]; /* ascending; of equals the lesser row is first */
} JoxNearest;

/* Makes it empty; what lists no body is not written. */
static inline void jox_nearest_begin(JoxNearest *nearest, uint32_t most) {
    nearest->most = most;
    nearest->count = 0;
}
void jox_nearest_offer(JoxNearest *nearest, float gap, uint32_t row);
/* Whether something that is at least `gap` away might still be among them. */
static inline bool jox_nearest_takes(const JoxNearest *nearest, float gap) {
    return nearest->count < nearest->most || gap <= nearest->gaps[nearest->count - 1];
}
/* Puts the rows in ascending order, so that the gaps no longer belong to them. */
void jox_nearest_by_row(JoxNearest *nearest);

typedef struct JoxFootprintPoint {
    JoxV2 normal; /* unit, from the footprint to the point asked for */
    JoxV2 point;  /* on the border */
    float gap;    /* negative inside, m */
} JoxFootprintPoint;

/* Nearest point of a body's footprint. A point inside is led out by the nearest edge. */
JoxFootprintPoint jox_footprint_nearest(const JoxObject *body, JoxV2 point);

#endif
