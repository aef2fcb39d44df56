/* Reasons why an action of a state does not reach its target. act.c and grasp.c decide by them,
   why_deeds.c tells them. */
#ifndef JOX_MACHINE_OBSTACLES_H
#define JOX_MACHINE_OBSTACLES_H

#include "machine/machine_parts.h"

typedef enum JoxObstacle {
    JOX_OBSTACLE_NONE,
    JOX_OBSTACLE_ABSENT, /* the target is not found */
    JOX_OBSTACLE_KIND,   /* it is no body, or of `grasp` no agent */
    JOX_OBSTACLE_FIXED,  /* a body that never moves */
    JOX_OBSTACLE_HELD,   /* a body that an agent holds */
    JOX_OBSTACLE_FAR,    /* beyond reach */
    JOX_OBSTACLE_HIGH,   /* too high above the ground */
    JOX_OBSTACLE_FAST,   /* too fast to be caught */
    JOX_OBSTACLE_BLOCKED /* a wall or a fixed body is between */
} JoxObstacle;

/* Greatest gaps, m, over which a body is picked up and kicked, and an agent taken hold of; m/s from
   which on a body is not caught. */
#define JOX_TAKE_REACH 0.6f
#define JOX_KICK_REACH 0.05f
#define JOX_GRASP_REACH 0.5f
#define JOX_CATCHABLE 8.0f

/* Return what keeps an agent from its state's `take`, `kick` or `grasp`, and the target in *spot.
   That the agent holds it already, or has just kicked it, is no obstacle. */
JoxObstacle jox_find_take_obstacle(const JoxMachineRun *run, const JoxState *state, uint32_t agent,
                                   JoxSpot *spot);
JoxObstacle jox_find_kick_obstacle(const JoxMachineRun *run, const JoxState *state, uint32_t agent,
                                   JoxSpot *spot);
JoxObstacle jox_find_grasp_obstacle(const JoxMachineRun *run, const JoxState *state, uint32_t agent,
                                    JoxSpot *spot);

#endif
