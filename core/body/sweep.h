/* Where a fast body, taken as a sphere, first meets a person, taken as an upright cylinder. */
#ifndef JOX_BODY_SWEEP_H
#define JOX_BODY_SWEEP_H

#include "body/body.h"

/* Discs by square cells of their place halfway through the step. Zero-initialise. */
typedef struct JoxDiscGrid {
    float cell, low_x, low_y;
    float reach; /* greatest radius plus half a way, m */
    uint32_t columns, rows;
    uint32_t *starts, *items;
    uint32_t start_capacity, item_capacity;
} JoxDiscGrid;

void jox_disc_grid_build(JoxDiscGrid *grid, const JoxDisc *discs, uint32_t count);
void jox_disc_grid_free(JoxDiscGrid *grid);

/* One substep of a ball: from `from` with `velocity`, during seconds `begin` to `begin + span` of a
   step of dt seconds; people are `height` tall. */
typedef struct JoxSweep {
    JoxV3 from, velocity;
    float radius, begin, span, dt, height;
} JoxSweep;

typedef struct JoxSweepHit {
    uint32_t disc;
    float time;   /* s after `begin` */
    JoxV3 normal; /* unit, from the person to the ball; vertical upon a head */
} JoxSweepHit;

/* The earliest hit of a ball that approaches; ties go to the lower id. */
bool jox_sweep(const JoxDiscGrid *grid, const JoxDisc *discs, const JoxSweep *sweep,
               JoxSweepHit *hit);

/* The impulse along `normal` on the body (N s) that turns the approach of body and person at the
   contact into `restitution` times its opposite; 0 where they part. `arm` from the centre of mass.
   A person takes nothing vertical: the ground does. */
float jox_sweep_impulse(JoxV3 velocity, JoxV3 spin, float inverse_mass,
                        const float inverse_inertia[9], JoxV3 arm, JoxV3 normal,
                        const JoxDisc *person, float restitution);

/* body_checks.c: a grid that was just built; a hit that was just found. */
void jox_disc_grid_check(const JoxDiscGrid *grid, const JoxDisc *discs, uint32_t count);
void jox_sweep_hit_check(const JoxSweep *sweep, const JoxSweepHit *hit);

#endif
