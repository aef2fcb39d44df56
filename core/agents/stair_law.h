/* How people walk on slopes: the share of their level speed that they walk at, and the share by
   which their time gap grows, by the slope of the floor in the direction of walking.
   core/walking.md has the sources. The stage prefer uses the speeds (machine/steering/stairs.c),
   the walking law the time gaps (nav/walk/walk_wide.c), and distance fields the slowness. */
#ifndef JOX_AGENTS_STAIR_LAW_H
#define JOX_AGENTS_STAIR_LAW_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "agents/walk_law.h"

/* A speed in plan, as a share of that on level ground, at a slope (m of rise per m in plan). */
typedef struct JoxSlopeSpeed {
    float slope, up, down;
} JoxSlopeSpeed;

/* Level ground to 45 degrees; linear in between, constant beyond. Up: no effect to 0.05, 11.5 %
   slower at 0.1, 25 % at 0.2 (grades, in Fruin 1971). Stairs: the mean of Weidmann 1993 and Fruin
   1971 at 30 degrees, and Fruin's change from 0.5 to 0.622; 1 is extrapolated. Down, between level
   ground and stairs: our interpolation. */
static const JoxSlopeSpeed jox_slope_speeds[] = {
    {0.0f, 1.0f, 1.0f},     {0.05f, 1.0f, 1.0f},      {0.1f, 0.885f, 0.952f}, {0.2f, 0.75f, 0.857f},
    {0.5f, 0.456f, 0.570f}, {0.622f, 0.407f, 0.494f}, {1.0f, 0.256f, 0.260f},
};

/* Returns the share of the level speed at which people walk in plan, on a floor that rises by
   `slope` m per m in plan in their direction; negative downwards. */
static inline float jox_slope_speed(float slope) {
    const uint32_t last = sizeof jox_slope_speeds / sizeof *jox_slope_speeds - 1;
    const float steep = fabsf(slope);
    for (uint32_t k = 0; k < last; k++) {
        const JoxSlopeSpeed *a = &jox_slope_speeds[k], *b = &jox_slope_speeds[k + 1];
        if (steep > b->slope)
            continue;
        const float share = (steep - a->slope) / (b->slope - a->slope);
        const float from = slope > 0.0f ? a->up : a->down, to = slope > 0.0f ? b->up : b->down;
        return from + (to - from) * share;
    }
    return slope > 0.0f ? jox_slope_speeds[last].up : jox_slope_speeds[last].down;
}

/* Returns how many times as long the way in plan over a flight takes as on level ground. `slope`:
   not negative; m of rise per m in plan. */
static inline float jox_stair_slowness(float slope, bool up) {
    return 1.0f / jox_slope_speed(up ? slope : -slope);
}

/* Returns the same for a belt that carries at `belt` m/s along the slope, and people who stand on
   it. */
static inline float jox_belt_slowness(float slope, float belt) {
    const float level = 1.34f; /* m/s: mean of Weidmann 1993 */
    return level * sqrtf(1.0f + slope * slope) / fabsf(belt);
}

#define JOX_STAIR_SLOPE 0.57735f /* m per m in plan: 30 degrees, at which `stair_gap_` hold */

/* Returns the factor of the time gap on a floor that rises by `slope` m per m in plan in the
   direction of walking; negative downwards. It grows with the slope, from 1 on level ground. */
static inline float jox_slope_gap(const JoxWalkLaw *law, float slope) {
    const float steep = fminf(fabsf(slope), 1.0f) / JOX_STAIR_SLOPE;
    const double at_stair = slope > 0.0f ? law->stair_gap_up : law->stair_gap_down;
    return fmaxf(1.0f + (float)(at_stair - 1.0) * steep, 0.1f);
}

#endif
