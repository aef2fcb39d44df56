/* Contacts of a step: of agents with agents ("pairs"), walls and bodies ("touches"), and the
   impulses that keep them from moving into each other. stage.c runs the files of this room in
   order: find, lay out, solve, measure. */
#ifndef JOX_FORCE_CONTACT_CONTACTS_H
#define JOX_FORCE_CONTACT_CONTACTS_H

#include <math.h>

#include "agents/contact_planes.h"
#include "force/contact/bodies.h"
#include "force/contact/found.h"
#include "force/contact/layout.h"
#include "force/contact/wall_load.h"

/* Motion of an agent while contacts are solved: velocity, and spin times the radius of gyration of
   the torso, m/s, so that one mass serves both. 1/kg. */
typedef struct JoxContactMotion {
    float x, y, spin, inverse_mass;
} JoxContactMotion;

typedef struct JoxContactSolve {
    JoxContactMotion *motions; /* per agent, in stage memory */
    float *residuals;          /* per chunk of a pass: greatest change of an impulse, N s */
    size_t residual_capacity;
} JoxContactSolve;

/* Hold of an agent's feet on the ground: an impulse of at most `most` either way along `side`,
   which keeps the speed along it between 0 and what it was before the step. kg, N s. */
typedef struct JoxFoothold {
    uint32_t agent;
    JoxV2 side; /* unit vector across the chest */
    float least_speed, most_speed, mass, most, impulse;
} JoxFoothold;
typedef struct JoxFeet {
    JoxFoothold *items; /* ascending agents */
    uint32_t count;
    size_t capacity;
} JoxFeet;

/* Each part belongs to the files named. stages/forces.c creates and frees the whole. */
struct JoxContacts {
    bool known;              /* they were searched for in this step */
    JoxFoundContacts found;  /* find.c, find_alone.c */
    JoxPairs pairs;          /* layout.c */
    JoxWallContacts walls;   /* layout.c */
    JoxTouches touches;      /* bodies_find.c, bodies_solve.c */
    JoxDrives drives;        /* bodies_driven.c */
    JoxFeet feet;            /* feet.c */
    JoxContactSolve solve;   /* solve.c, motions_wide.c */
    JoxWallLoads wall_loads; /* wall_load.c */
    JoxContactPlanes planes; /* planes.c */
    JoxKeptImpulses kept[3]; /* state, by JoxKeptKind: the impulses from which the next step's solve
                                starts */
};

/* motions_wide.c: between the motions and the columns of agents [begin, end); both have room for
   whole packets. One function for each instruction set. */
typedef void JoxMotionKernel(JoxForces *forces, uint32_t begin, uint32_t end);
#define X(name, isa)                                                                               \
    JoxMotionKernel jox_start_motions_##name, jox_end_motions_##name, jox_start_bearing_##name,    \
        jox_end_bearing_##name, jox_end_parting_##name;
JOX_ISAS(X)
#undef X
/* solve_wide.c: solves contacts once whose agents are all different; their motions are below
   `motions`. `friction`: 0 leaves slips alone. `relaxation`: factor of corrections. Returns the
   greatest change of an impulse, N s. One function for each instruction set. */
typedef float JoxSolvePairsKernel(JoxPair *pairs, uint32_t count, JoxContactMotion *motions,
                                  float friction, float relaxation);
#define X(name, isa) JoxSolvePairsKernel jox_solve_pairs_##name;
JOX_ISAS(X)
#undef X
/* feet.c: returns whether feet may hold anybody. */
bool jox_feet_matter(const JoxForces *forces);
/* feet.c: lists the feet that may hold in this step, once contacts are laid out. */
void jox_feet_list(JoxForces *forces);
/* feet.c: solves the feet [begin, end) once; returns the greatest change of an impulse, N s. */
float jox_feet_solve_once(JoxForces *forces, uint32_t begin, uint32_t end);
/* feet.c: writes the forces of the feet. */
void jox_feet_write_forces(JoxForces *forces);
/* solve.c: solves all impulses. */
void jox_contacts_solve(JoxForces *forces);
/* literal_contacts.c: equations 6 and 7 as printed: solves all pairs and touches, each by itself.
 */
void jox_literal_contacts(JoxForces *forces);
/* crush_load.c: measures compression and load of one agent from the impulses. */
void jox_load_measure(JoxForces *forces, uint32_t agent);
/* crush_load_wide.c: returns the greatest length, N, over half-planes, of the sum of the forces
   within; the lists are padded with zeros to whole packets. */
typedef float JoxGreatestPushKernel(const float *x, const float *y, uint32_t count);
#define X(name, isa) JoxGreatestPushKernel jox_greatest_push_##name;
JOX_ISAS(X)
#undef X
/* crush_load.c: returns whether neither walls nor pushes press on any of agents [begin, end). */
bool jox_have_no_loads(const JoxForces *forces, uint32_t begin, uint32_t end);
/* planes.c: makes the half-planes of contacts. */
void jox_contact_planes_make(JoxForces *forces);
/* check.c asserts that no agent occurs twice in a colour, that no contact pulls, and that the
   forces of contacts between agents cancel out. */
void jox_contacts_check(const JoxForces *forces);
void jox_contacts_free(JoxContacts *contacts);

#define JOX_PARTS 0.2f         /* share of an overlap that a step removes */
#define JOX_OVERLAP_LEFT 2e-3f /* m: overlap that stays, so that contacts last */
#define JOX_PARTING_MOST 0.3f  /* m/s */
/* Returns the speed, m/s, at which two surfaces with a gap of so many m (negative: they overlap)
   part at least; -INFINITY unless they overlap too far. */
static inline float jox_parting_speed(const JoxForces *f, float gap) {
    const float depth = -gap - JOX_OVERLAP_LEFT;
    if (!(depth > 0.0f))
        return -INFINITY;
    return jox_minf(JOX_PARTS * depth / (float)f->step.timing.dt, JOX_PARTING_MOST);
}

static inline float jox_speed_along(const JoxContactMotion *m, JoxV2 direction, float lever) {
    return m->x * direction.x + m->y * direction.y + m->spin * lever;
}
/* Adds an impulse, N s, along a direction, with a lever (JoxContactPoint). */
static inline void jox_add_impulse(JoxContactMotion *m, JoxV2 direction, float lever,
                                   float impulse) {
    const float change = impulse * m->inverse_mass;
    m->x += direction.x * change;
    m->y += direction.y * change;
    m->spin += lever * change;
}

/* Returns whether agents [begin, end), at most JOX_LANES, have no contact with agents or bodies. */
static inline bool jox_have_no_contacts(const JoxContacts *c, uint32_t begin, uint32_t end) {
    uint32_t touches = c->pairs.end_starts[end] - c->pairs.end_starts[begin];
    for (uint32_t i = begin; c->touches.count && i < end; i++)
        touches |= c->touches.number[i];
    return touches == 0;
}

#endif
