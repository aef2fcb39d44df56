/* Pushes of a step (push.c), as later stages read them: the sorted transfers of JoxForces have the
   forces on agents until infer, this has the rest; and the kernel of push, which push.c calls. */
#ifndef JOX_FORCE_PUSH_PUSHES_H
#define JOX_FORCE_PUSH_PUSHES_H

#include "force/cones.h"
#include "simd/isa.h"

/* A push on a body. */
typedef struct JoxBodyPush {
    uint32_t agent, row; /* index of the agent, row of the body */
    JoxV2 force;         /* N */
    JoxV3 point;         /* m */
} JoxBodyPush;

/* Totals of a chunk; momentum in 2^-20 N s, as integers, so that the order of the sum does not
   matter. */
typedef struct JoxPushTotals {
    uint32_t pushers;
    int64_t ground_x, ground_y;
} JoxPushTotals;

/* Pushes of the agents of a chunk, and the agents in their way: the direction of each agent's push,
   a unit vector; (0, 0): it does not push, and `people` has no meaning. */
typedef struct JoxPushing {
    float aim_x[JOX_FORCE_GRAIN], aim_y[JOX_FORCE_GRAIN];
    JoxFound people;
} JoxPushing;
/* Finds it for agents [begin, end) of one chunk. Returns false if none push. */
typedef bool JoxPushKernel(const JoxForces *forces, uint32_t begin, uint32_t end,
                           JoxPushing *pushing);
#define X(name, isa) JoxPushKernel jox_push_packets_##name;
JOX_ISAS(X)
#undef X

/* Zero-initialise; it owns its arrays. */
typedef struct JoxPushes {
    bool any;         /* agents were pushed: the sorted transfers are this step's pushes */
    JoxV2 *reactions; /* per agent: reaction of its own pushes, N; zero since the step began */
    JoxChunkList on_bodies; /* items are JoxBodyPush */
    JoxPushTotals *totals;  /* per chunk */
    size_t reaction_capacity, total_capacity;
} JoxPushes;

/* Starts a step: makes room for its agents. stages/forces.c zeroes the reactions. */
void jox_pushes_start_step(JoxForces *forces);
void jox_pushes_free(JoxPushes *pushes);

#endif
