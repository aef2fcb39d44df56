/* Contacts of agents with bodies ("touches"), and the bodies that move by themselves and press
   agents ("drives"). stage.c and solve.c call these in the order of the list. */
#ifndef JOX_FORCE_CONTACT_BODIES_H
#define JOX_FORCE_CONTACT_BODIES_H

#include "force/body_touch.h"
#include "force/forces.h"

/* Zero-initialise; it owns its arrays. */
typedef struct JoxTouches {
    JoxChunkList found; /* items are JoxTouch, in the order in memory */
    JoxTouch *items;    /* sorted by agent id, then row */
    uint32_t *first;    /* per agent, valid where `number` is not 0 */
    uint8_t *number;    /* per agent; valid where there is any touch */
    uint32_t count;
    size_t capacity, first_capacity, number_capacity;
} JoxTouches;

/* A kinematic body that moves and touches agents. */
typedef struct JoxDrive {
    uint32_t row;
    float speed;   /* m/s: greatest towards an agent that it touches, or of its centre */
    float most;    /* N s: greatest impulse per step */
    float pressed; /* N s: present impulse */
} JoxDrive;

/* Zero-initialise; it owns its arrays. */
typedef struct JoxDrives {
    JoxDrive *items;
    JoxDriveLoad *loads; /* per drive */
    uint32_t count;
    size_t capacity, load_capacity;
} JoxDrives;

/* ---- bodies_find.c ---- */

/* Makes room for the touches of the step's agents. */
void jox_touches_reserve(JoxForces *forces);
/* Finds the touches of agents [begin, end) of one chunk. */
void jox_touches_find(JoxForces *forces, uint32_t begin, uint32_t end);
/* Sorts those of all chunks. */
void jox_touches_sort(JoxForces *forces);
void jox_touches_free(JoxTouches *touches, JoxDrives *drives);

static inline uint32_t jox_touch_number_of(const JoxTouches *touches, uint32_t agent) {
    return touches->count ? touches->number[agent] : 0;
}

/* ---- bodies_solve.c ---- */

/* Starts the solve: supports and motions of bodies, targets, first impulses. */
void jox_touches_start_solve(JoxForces *forces);
/* Solves all touches once; returns the greatest change of an impulse, N s. */
float jox_touches_solve_once(JoxForces *forces);
/* Starts the solve of plans (jox_force_bear), in which bodies keep the motion that forces gave
   them. */
void jox_touches_start_bearing(JoxForces *forces);
/* Raises the targets of touches that overlap to their parting speeds; returns whether any does. */
bool jox_touches_start_parting(JoxForces *forces);
/* Gives the bodies the opposite of the impulses that agents got, and keeps these. */
void jox_touches_give_impulses(JoxForces *forces);

/* ---- bodies_driven.c ---- */

/* Finds the drives of the touched bodies, and scales kept impulses down to the limits. */
void jox_drives_find(JoxForces *forces);
/* Scales the impulses ahead of drives over their limit down, after each pass. */
void jox_drives_limit_impulses(JoxForces *forces);
/* Writes the loads of all drives, and slows bodies that reached their limit. */
void jox_drives_slow_bodies(JoxForces *forces);

/* ---- bodies_motion.c ---- */

/* Returns the normal velocity of a body at a touch, m/s, before the contacts act. */
float jox_touch_speed_before(const JoxForces *forces, const JoxTouch *touch);
/* The same, as the contacts have changed it so far. */
float jox_touch_speed_after(const JoxForces *forces, const JoxTouch *touch);
/* Applies an impulse, N s, to the agent and the opposite one to the body of a touch. */
void jox_touch_apply_impulse(JoxForces *forces, const JoxTouch *touch, float impulse);

#endif
