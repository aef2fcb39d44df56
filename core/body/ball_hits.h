/* Sweep of a fast body, taken as a sphere, against people, taken as upright cylinders: finds the
   first hit and its impulse. bullet_step.cc calls it in each substep. */
#ifndef JOX_BODY_BALL_HITS_H
#define JOX_BODY_BALL_HITS_H

#include "body/body.h"

/* Grid of discs, sorted into square cells by their position halfway through the step. Zero-
   initialise. */
typedef struct JoxDiscGrid {
    float cell, low_x, low_y;
    float reach; /* greatest sum of radius and half the displacement, m */
    uint32_t columns, rows;
    uint32_t *starts, *items;
    uint32_t start_capacity, item_capacity;
} JoxDiscGrid;

void jox_disc_grid_build(JoxDiscGrid *grid, const JoxDisc *discs, uint32_t count);
void jox_disc_grid_free(JoxDiscGrid *grid);

/* One substep of a ball: it moves from `from` with `velocity` from time `begin` to `begin +
   span` within a step of dt seconds; people are `height` tall. m, m/s, s. */
typedef struct JoxSweep {
    JoxV3 from, velocity;
    float radius, begin, span, dt, height;
    uint32_t row; /* of the ball */
} JoxSweep;

typedef struct JoxSweepHit {
    uint32_t disc;
    float time;   /* s after `begin` */
    JoxV3 normal; /* unit vector from the person to the ball; vertical for a hit from above */
} JoxSweepHit;

/* Finds the earliest hit of an approaching ball; of hits at the same time that on the lower id.
   False if there is none. */
bool jox_sweep(const JoxDiscGrid *grid, const JoxDisc *discs, const JoxSweep *sweep,
               JoxSweepHit *hit);

/* Returns the impulse on the body along `normal`, N s, that reverses the velocity of approach at
   the contact and scales it by `restitution`; 0 if body and person separate. `arm` is the
   contact point relative to the centre of mass, m. A person takes no vertical impulse: the
   ground does. */
float jox_sweep_impulse(JoxV3 velocity, JoxV3 spin, float inverse_mass,
                        const float inverse_inertia[9], JoxV3 arm, JoxV3 normal,
                        const JoxDisc *person, float restitution);

/* Assertions, in body_checks.c: on a new grid; on a hit. */
void jox_disc_grid_check(const JoxDiscGrid *grid, const JoxDisc *discs, uint32_t count);
void jox_sweep_hit_check(const JoxSweep *sweep, const JoxSweepHit *hit);

#endif
