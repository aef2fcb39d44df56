/* The stage walk: its kernels for each instruction set, which walk.c calls for chunks of agents on
   several threads. */
#ifndef JOX_NAV_WALK_WALK_H
#define JOX_NAV_WALK_WALK_H

#include "nav/nav_state.h"
#include "simd/isa.h"

/* Inputs of the walking law in a step (core/walking.md). */
typedef struct JoxWalk {
    JoxNav *nav;
    JoxStep step;
    const JoxWalkLaw *law;
    /* Random walk of time gaps: the random stream, the moments of the knots before and after the
       present time and of the agents' own draws, and how far time is between the knots, 0 to 1. */
    uint64_t stream, knots[2], own;
    double between;
    float rise, fall, course; /* shares covered from plan to plan: eagerness up, down; course */
    float start, stop;        /* shares covered from plan to plan: speed up; slowing and turning */
} JoxWalk;

/* Directions that are judged: straight on, and 15 to 75 degrees to the left and right. */
enum { JOX_WALK_DIRECTIONS = 11 };

/* Speed that walls allow in each direction, m/s, by lane; INFINITY without walls. */
typedef struct JoxWalkTable {
    float allowed[JOX_WALK_DIRECTIONS][JOX_LANES];
} JoxWalkTable;

/* Computes aim_x, aim_y of agents [begin, end). Returns how far away walls matter to walkers, m; -1
   without walkers. */
typedef float JoxAimKernel(const JoxWalk *walk, uint32_t begin, uint32_t end);
/* Walks agents [begin, end) that keep a time gap: walk_x, walk_y, course_x, course_y, eager.
   `begin` is a multiple of JOX_LANES. */
typedef void JoxWalkKernel(const JoxWalk *walk, uint32_t begin, uint32_t end);
#define X(name, isa)                                                                               \
    JoxAimKernel jox_walk_aim_##name;                                                              \
    JoxWalkKernel jox_walk_packets_##name;
JOX_ISAS(X)
#undef X

/* torso_wide.c: gives the torsos of agents [begin, end) the spin that they want; after aim. */
#define X(name, isa) JoxWalkKernel jox_torso_packets_##name;
JOX_ISAS(X)
#undef X

/* Fills one lane of the table with what walls allow one agent. Straight on is left out, as the way
   itself leads around walls. Speeds above the wanted one have no effect. */
typedef void JoxWalkWallsKernel(const JoxWalk *walk, uint32_t agent, uint32_t lane,
                                JoxWalkTable *table);
#define X(name, isa) JoxWalkWallsKernel jox_walk_mind_walls_##name;
JOX_ISAS(X)
#undef X

#endif
