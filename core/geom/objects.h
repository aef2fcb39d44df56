/* Rigid bodies as agents see them. body/ writes the table after each of its steps; nav, force and
   machine read it. The index of a body is its row, which stays the same while the body lives. */
#ifndef JOX_GEOM_OBJECTS_H
#define JOX_GEOM_OBJECTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"

enum {
    JOX_FOOTPRINT_POINTS = 16,
    JOX_MOST_NEAREST = 24 /* bodies that one agent avoids at a time */
};

typedef struct JoxObject {
    uint32_t id;     /* identity of the body, never reused */
    bool live;       /* false: the row is free */
    bool in_band;    /* part of it is within the agents' height band and can be touched */
    bool moves;      /* pushes can move it; false: mass 0, static or kinematic */
    bool kinematic;  /* follows a prescribed velocity: pushes, and is not pushed */
    bool grounded;   /* touches the ground, or rests on a static body */
    bool held;       /* carried by an agent: touches nothing */
    uint32_t holder; /* id of that agent */
    bool swept;      /* too fast for forces: body/ sweeps it against people instead */
    uint64_t tags;
    const char *name;         /* "": none; valid while the body lives */
    JoxV3 position;           /* centre of mass, m */
    float turn[4];            /* rotation of its frame, a quaternion x, y, z, w */
    JoxV3 velocity;           /* m/s */
    JoxV3 spin;               /* angular velocity, rad/s */
    float disc;               /* radius of the projected bounding disc about position.xy, m */
    float inverse_mass;       /* 1/kg; 0 static or kinematic */
    float inverse_inertia[9]; /* world frame, row major, 1/(kg m2) */
    /* Footprint within the height band: a convex ring, counter-clockwise; or, with count 0, the
       disc of radius `round` about position.xy. */
    JoxV2 footprint[JOX_FOOTPRINT_POINTS];
    uint32_t footprint_count;
    float round;
    float low, high;    /* heights that the footprint covers within the band, m */
    float below, above; /* m: distance of its lowest and of its highest point from position.z */
    float restitution, friction;
    /* Kinematic bodies: intended velocity, m/s, and spin, rad/s, if nothing stops it (velocity and
       spin are those of the last step); greatest force on people, N, 0: no limit. */
    JoxV3 drive, drive_spin;
    float force_limit;
} JoxObject;

static const float JOX_EYE_LEVEL = 1.3f; /* m: people see over lower walls and bodies */

/* Returns whether a body blocks the view of people: above eye level and as wide as a person. */
static inline bool jox_object_hides_people(const JoxObject *body) {
    const float wide = 0.25f; /* m, bounding radius */
    return body->live && body->in_band && body->low < JOX_EYE_LEVEL &&
           body->high >= JOX_EYE_LEVEL && jox_maxf(body->disc, body->round) >= wide;
}

/* Returns whether a body is in the air: it can move, nobody carries it, and it touches neither the
   ground nor a static body. */
static inline bool jox_object_flies(const JoxObject *body) {
    return body->live && body->moves && !body->held && !body->grounded;
}

/* Returns how near to a point something passes during the next 2 s if it keeps its velocity, m;
   infinity if it moves away, or at less than 0.1 m/s. `offset` leads from the point to it. */
static inline float jox_pass_distance(JoxV2 offset, JoxV2 velocity) {
    const float speed2 = jox_length2(velocity), nearing = -jox_dot(offset, velocity);
    if (speed2 < 0.01f || nearing <= 0.0f)
        return INFINITY;
    const float when = jox_minf(nearing / speed2, 2.0f);
    return jox_length(jox_add(offset, jox_scale(velocity, when)));
}

/* An impulse on a body at a point, in world coordinates: N s and m. The share `lasting` acts evenly
   throughout the step, like the force of a person who leans on the body; the rest acts at the
   step's beginning. */
typedef struct JoxImpulse {
    uint32_t object;
    JoxV3 impulse, point;
    float lasting;
} JoxImpulse;

/* Returns the velocity that agents assume at a point of a body, m/s: its centre's; for a kinematic
   body, which also turns steadily, plus that of its rotation. */
static inline JoxV2 jox_object_velocity_at(const JoxObject *body, JoxV2 point) {
    JoxV2 v = {body->velocity.x, body->velocity.y};
    if (body->kinematic) {
        v.x -= body->spin.z * (point.y - body->position.y);
        v.y += body->spin.z * (point.x - body->position.x);
    }
    return v;
}

#define JOX_NO_OBJECT UINT32_MAX

/* A contact of a moving body with another body, the ground or a wall. */
typedef struct JoxObjectContact {
    uint32_t first, second; /* rows; the first can be pushed; second is JOX_NO_OBJECT if static */
    JoxV3 point, normal;    /* m; unit vector that points to the first */
    float gap, friction;    /* m; friction coefficient of the pair */
    float force;            /* normal force in the last step, N */
} JoxObjectContact;

/* All contacts, in Bullet's order. */
typedef struct JoxObjectContacts {
    const JoxObjectContact *items;
    uint32_t count;
} JoxObjectContacts;

/* Bounds of a body in the plane, m, and the grid cells that they overlap, inclusive; empty (`left`
   > `right`) if agents cannot meet the body. */
typedef struct JoxCover {
    JoxV2 low, high;
    uint32_t left, bottom, right, top;
} JoxCover;

/* A grid of bodies: each cell lists the rows of bodies whose bounds overlap it. */
typedef struct JoxObjectGrid {
    JoxV2 low, high;
    float cell;
    uint32_t laid;          /* number of rows when it was made */
    uint32_t columns, rows; /* 0: no body can be met */
    bool hides_people;      /* some body blocks the view of people */
    uint32_t *starts;       /* per cell, and one more: its first index in members */
    uint32_t *members;      /* rows of bodies, ascending within a cell */
    JoxCover *covers;       /* per row of the table */
    size_t start_capacity, member_capacity, cover_capacity;
} JoxObjectGrid;

/* A convex part of a body, as its bounding sphere seen from above. */
typedef struct JoxObjectPart {
    JoxV2 at, velocity; /* position and velocity of the sphere's centre, m and m/s */
    float radius;       /* m */
} JoxObjectPart;

/* An iterator over the parts of a body whose spheres come within reach of a point. */
typedef struct JoxPartWalk {
    uint32_t row, next; /* row of the body, and number of its next part */
    JoxV2 point;        /* m */
    float reach;        /* m */
} JoxPartWalk;

typedef struct JoxObjects {
    JoxObject *rows;
    uint32_t count, capacity;
    /* Advances to the next part that is within the agents' height band; false at the end. Parts are
       computed on demand, as literal mode alone asks for them; several threads may call this. */
    bool (*next_part)(const void *bodies, JoxPartWalk *walk, JoxObjectPart *part);
    /* Contacts of bodies, computed on demand for the bodies' present positions, as few steps need
       them. NULL: they are in `contacts`. */
    JoxObjectContacts (*list_contacts)(void *bodies);
    void *bodies;
    JoxObjectContacts contacts;
    float gravity; /* m/s2, downwards */
    JoxObjectGrid grid;
} JoxObjects;

static inline JoxObjectContacts jox_objects_contacts(const JoxObjects *objects) {
    return objects->list_contacts ? objects->list_contacts(objects->bodies) : objects->contacts;
}

/* Makes the grid of live bodies in the agents' height band; call it again after bodies have
   moved. */
void jox_objects_lay(JoxObjects *objects);
void jox_objects_free_grid(JoxObjects *objects);

/* An iterator over bodies whose bounds come within reach of a point along both axes. It may yield
   others too, but each body once, in an order that depends on the bodies and the point alone. */
typedef struct JoxObjectWalk {
    const JoxObjectGrid *grid;
    uint32_t left, bottom, right, top; /* cells, inclusive */
    uint32_t column, row;
    uint32_t at, end; /* members of the present cell that are left */
} JoxObjectWalk;

JoxObjectWalk jox_objects_near(const JoxObjects *objects, JoxV2 point, float reach);

/* Advances to the next row; false at the end. */
static inline bool jox_objects_next(JoxObjectWalk *walk, uint32_t *row) {
    const JoxObjectGrid *g = walk->grid;
    for (;;) {
        while (walk->at < walk->end) {
            uint32_t found = g->members[walk->at++];
            /* a body in several cells is yielded in the first of them */
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

/* Returns whether a body's bounding disc comes within reach of a point. */
static inline bool jox_object_reaches(const JoxObject *body, JoxV2 point, float reach) {
    float most = reach + jox_maxf(body->disc, body->round);
    return jox_length2(jox_v2(body->position.x - point.x, body->position.y - point.y)) <=
           most * most;
}

/* The nearest of the bodies offered, at most `most` of them (up to JOX_MOST_NEAREST). */
typedef struct JoxNearest {
    uint32_t most, count;
    uint32_t rows[JOX_MOST_NEAREST];
    float gaps[JOX_MOST_NEAREST]; /* m, ascending; ties by row */
} JoxNearest;

/* Empties the list; the arrays are not written. */
static inline void jox_nearest_begin(JoxNearest *nearest, uint32_t most) {
    nearest->most = most;
    nearest->count = 0;
}
void jox_nearest_offer(JoxNearest *nearest, float gap, uint32_t row);
/* Returns whether a body at least `gap` away could still enter the list. */
static inline bool jox_nearest_takes(const JoxNearest *nearest, float gap) {
    return nearest->count < nearest->most || gap <= nearest->gaps[nearest->count - 1];
}
/* Sorts the rows; the gaps do not belong to them any more. */
void jox_nearest_by_row(JoxNearest *nearest);

typedef struct JoxFootprintPoint {
    JoxV2 normal; /* unit vector from the footprint to the given point */
    JoxV2 point;  /* nearest point on the border */
    float gap;    /* m; negative inside */
} JoxFootprintPoint;

/* Finds the nearest point of a body's footprint. A point inside is led out over the nearest
   edge. */
JoxFootprintPoint jox_footprint_nearest(const JoxObject *body, JoxV2 point);

#endif
