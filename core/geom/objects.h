/* What agents see of rigid bodies: written by body/ after each of its steps, read by nav, force and
   machine. Indices are rows of this table and stay as long as the body lives. */
#ifndef JOX_GEOM_OBJECTS_H
#define JOX_GEOM_OBJECTS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

enum { JOX_FOOTPRINT_POINTS = 16 };

typedef struct JoxObject {
    uint32_t id;     /* of the body, never reused */
    bool live;       /* false: the row is free */
    bool in_band;    /* some of it is within the agents' height band: can be touched */
    bool moves;      /* false: mass 0, static */
    bool grounded;   /* touches the ground or rests upon something static */
    bool held;       /* carried by an agent: touches nothing */
    uint32_t holder; /* its id */
    bool swept;      /* fast: body/ itself sweeps it against people; forces leave it out */
    uint64_t tags;
    JoxV3 position;           /* centre of mass, m */
    JoxV3 velocity;           /* m/s */
    JoxV3 spin;               /* angular velocity, rad/s */
    float disc;               /* radius of the projected bounding disc about position.xy, m */
    float inverse_mass;       /* 1/kg; 0 static */
    float inverse_inertia[9]; /* world frame, row major, 1/(kg m2) */
    /* Footprint within the height band: a convex ring, counter-clockwise, or, with count 0, the
       disc of radius `round` about position.xy. */
    JoxV2 footprint[JOX_FOOTPRINT_POINTS];
    uint32_t footprint_count;
    float round;
    float low, high; /* heights that the footprint covers within the band, m */
    float restitution, friction;
} JoxObject;

/* An impulse on a body at a point, both in world coordinates: N s and m. */
typedef struct JoxImpulse {
    uint32_t object;
    JoxV3 impulse, point;
} JoxImpulse;

typedef struct JoxObjects {
    JoxObject *rows;
    uint32_t count, capacity;
} JoxObjects;

#endif
