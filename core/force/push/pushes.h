/* Pushes of a step (push.c), as later stages read them: the sorted transfers of JoxForces have the
   forces on agents until infer, this has the rest. */
#ifndef JOX_FORCE_PUSH_PUSHES_H
#define JOX_FORCE_PUSH_PUSHES_H

#include "force/forces.h"

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
