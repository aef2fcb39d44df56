/* The stage move: its kernels for each instruction set, which move.c calls for chunks of agents on
   several threads, and movement past walls. */
#ifndef JOX_NAV_MOVE_MOVE_H
#define JOX_NAV_MOVE_MOVE_H

#include "nav/nav_state.h"
#include "simd/isa.h"

typedef struct JoxMove {
    JoxNav *nav;
    JoxStep step;           /* with contact planes of this step or NULL */
    const float *unhidden2; /* m2, at the agents' old positions; NULL: unknown */
    float served;           /* m: walls are known as far as this from the old positions */
    float stiffness;        /* share of an overlap that one sweep removes */
    JoxV2 *position[2];     /* m: before and after a sweep */
    int from;               /* index of the positions that a sweep reads */
} JoxMove;

/* Returns where walls let a disc of `radius` m get on its way to a point. A way longer than
   `served` is split into pieces; pieces that cross joined edges go on at the other side. */
JoxV2 jox_nav_move_past_walls(const JoxMove *move, JoxV2 from, JoxV2 to, float radius);

#define JOX_STILL_REACH 0.25f /* m: lesser movement counts as standing still */

/* Integrates agents [begin, end): their velocity, prev_x, prev_y, and position[0]. */
typedef void JoxMoveKernel(const JoxMove *move, uint32_t begin, uint32_t end);
/* Writes x, y from position[0], still, still_x, still_y of agents [begin, end). Returns their
   drift. For both, `begin` is a multiple of JOX_LANES. */
typedef JoxDrift JoxSettleKernel(const JoxMove *move, uint32_t begin, uint32_t end);
#define X(name, isa)                                                                               \
    JoxMoveKernel jox_move_integrate_##name;                                                       \
    JoxSettleKernel jox_move_settle_##name;
JOX_ISAS(X)
#undef X

#endif
