/* Supports of bodies: their contacts with what holds them, and the motions of bodies while contacts
   are solved. contact/bodies_solve.c calls begin, then a pass in each pass over all contacts, then
   finish; supports.c makes the supports, solve.c solves them. */
#ifndef JOX_FORCE_SUPPORT_SUPPORTS_H
#define JOX_FORCE_SUPPORT_SUPPORTS_H

#include "force/body_touch.h"
#include "force/forces.h"
#include "simd/four.h"

/* One direction of a contact between two bodies: lever and effect on each body of an impulse along
   it. The effect on a body that is not solved for is 0. */
typedef struct JoxSupportAxis {
    JoxFour along;                /* unit */
    JoxFour lever[2], turning[2]; /* m: arm x along; change of spin by 1 N s, 1/(kg m) */
    float inverse_mass[2];        /* 1/kg */
    float sway[2]; /* root of the speed that 1 N s gives the point along the axis, root of 1/kg */
    float mass, impulse; /* kg; impulse on the first body, N s */
} JoxSupportAxis;

/* A contact of a body with its support: solved along the normal and, for friction, across it. */
typedef struct JoxSupport {
    uint32_t rows[2];       /* indices of motions */
    float target, friction; /* m/s */
    JoxSupportAxis normal, across[2];
} JoxSupport;

/* Decides whether a support has to be solved again (support/solve.c). */
typedef struct JoxSupportWatch {
    uint32_t rows[2];
    float most_per_unrest[2]; /* greatest impulse per unrest of each body, root of kg */
    float tested_unrest[2];   /* unrest of each body when the support was tested last */
    float remaining;          /* N s: change that was left then */
} JoxSupportWatch;

/* Motion of a body while contacts are solved. */
typedef struct JoxBodyMotion {
    JoxFour velocity, spin;
    JoxV3 given, given_turn; /* by the agents that touch it, N s and N m s */
    float held;              /* share of `given` that its supports took */
    float unrest;            /* sum of all impulses times their sways: N s / root of kg */
    bool solved, touched;    /* solved: impulses change its motion; touched by agents */
    uint8_t link;            /* number of bodies between it and the nearest touched one */
} JoxBodyMotion;

/* Zero-initialise; it owns its arrays. */
typedef struct JoxSupports {
    JoxBodyMotion *motions;   /* per row of objects; then one of the static world, at rest */
    JoxSupport *items;        /* sorted as the objects' contacts */
    JoxSupportWatch *watches; /* per support */
    uint32_t count;
    size_t motion_capacity, capacity, watch_capacity;
} JoxSupports;

/* Loads the motions of all bodies, makes the supports of those that the touches press on, and
   applies the first impulses. */
void jox_supports_start_solve(JoxForces *forces, const JoxTouch *touches, uint32_t count);
/* Solves the supports once; returns the greatest change of an impulse, N s. */
float jox_supports_solve_once(JoxForces *forces);
/* Finds the share of the touches' impulses that supports held. */
void jox_supports_find_held_shares(JoxForces *forces, const JoxTouch *touches, uint32_t count);
void jox_supports_free(JoxSupports *supports);
/* solve.c: applies the impulses that the supports start with. */
void jox_supports_apply_first_impulses(JoxSupports *supports);

/* Returns the velocity of a point of a body while contacts are solved, m/s. */
JoxV3 jox_body_velocity(const JoxForces *forces, uint32_t row, JoxV3 point);
/* Applies an impulse, N s, at a point of a body while contacts are solved. */
void jox_body_apply_impulse(JoxForces *forces, uint32_t row, JoxV3 point, JoxV3 impulse);

#endif
