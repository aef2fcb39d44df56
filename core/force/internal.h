/* What the stages of force share: scratch that grows to its peak and stays. */
#ifndef JOX_FORCE_INTERNAL_H
#define JOX_FORCE_INTERNAL_H

#include "force/force.h"

enum {
    JOX_FORCE_GRAIN = 256,     /* agents of a chunk; each chunk writes lists of its own */
    JOX_FORCE_MOST_TOUCHES = 4 /* bodies that one agent pushes or touches at a time */
};

/* A force that one agent gives another. */
typedef struct JoxTransfer {
    uint32_t to, from_id;
    float x, y;
} JoxTransfer;

/* Two overlapping agents, the one of lesser id first; the normal points to it. */
typedef struct JoxPair {
    uint32_t first, second;
    float nx, ny;
    float bounce;  /* normal velocity wanted at the end, m/s, at least 0 */
    float stiff;   /* the split masses of both, as one, kg */
    float impulse; /* accumulated, N s */
} JoxPair;

/* An agent on a body; the normal points to the agent. A push on a body uses the normal's place
   for its force. */
typedef struct JoxTouch {
    uint32_t agent, object;
    JoxV2 normal;
    JoxV3 point;
    float bounce, give, impulse;
} JoxTouch;

/* An agent's end of a pair. */
typedef struct JoxEnd {
    uint32_t other_id;
    uint32_t pair;
} JoxEnd;

/* An impulse on a body with the key that sorts it: agent id, then row. Those of one key stay in the
   order in which they were given. */
typedef struct JoxPendingImpulse {
    uint64_t key;
    JoxImpulse impulse;
} JoxPendingImpulse;

/* Lists written chunk by chunk: chunk c owns the items from c * room on. The memory is touched
   only as far as it is used. */
typedef struct JoxChunkList {
    void *items;
    uint32_t *counts;
    uint32_t room; /* items of a chunk */
    size_t capacity, chunk_capacity;
} JoxChunkList;

/* Velocity and spin of a body while contacts are solved. */
typedef struct JoxBodyMotion {
    JoxV3 velocity, spin;
    uint32_t touches;
} JoxBodyMotion;

struct JoxForces {
    JoxForceOptions options;
    JoxForceStep step;
    JoxForceTotals totals;
    uint32_t chunks;

    JoxChunkList transfers;
    uint32_t *starts; /* per receiver, and one more */
    size_t start_capacity;
    JoxTransfer *sorted;
    size_t sorted_capacity;

    JoxChunkList pairs, touches;
    JoxEnd *ends;
    size_t end_capacity;
    JoxTouch *touch; /* all touches, sorted by agent id, then row */
    size_t touch_capacity;
    uint32_t touch_count;
    uint32_t *first_touch; /* per agent, valid where touch_number is not 0 */
    uint8_t *touch_number;
    size_t first_touch_capacity, touch_number_capacity;
    JoxBodyMotion *motions; /* per row of objects */
    size_t motion_capacity;
    float *work_x, *work_y; /* velocities while contacts are solved */
    size_t work_x_capacity, work_y_capacity;

    float widest; /* greatest radius, m */
    bool bodies;  /* some can be met */
    JoxPendingImpulse *pending;
    size_t pending_capacity;
    uint32_t pending_count, pending_sorted;
    JoxImpulse *impulses;
    size_t impulse_capacity;

    float *old_x, *old_y; /* velocities that sum saw */
    size_t old_x_capacity, old_y_capacity;

    struct JoxForceChunk { /* totals of a chunk; momentum in 2^-20 N s, so that order is free */
        uint32_t pushers, approaching;
        int64_t ground_x, ground_y;
    } * chunk;
    size_t chunk_capacity;
};

/* Makes room for `room` items of `size` bytes in every chunk and empties the list. */
void jox_chunks_begin(JoxChunkList *list, uint32_t chunks, uint32_t room, size_t size);
/* Agents in reach of agent i within its cone about `axis`: their indices, in the order of nearness.
 */
uint32_t jox_people_in_cone(const JoxForces *forces, uint32_t i, JoxV2 axis, uint32_t *found);
/* Lists a force that agent i, of that chunk, gives agent `to`. */
void jox_transfer_give(JoxForces *forces, uint32_t chunk, uint32_t i, uint32_t to, JoxV2 force);
/* Sorts the transfers by receiver: those of agent i are sorted[starts[i]] to sorted[starts[i + 1]].
   Returns how many there are; with none, nothing is written. */
uint32_t jox_transfers_sort(JoxForces *forces);
/* Adds the transfers of all agents, in ascending id of the giver, into two columns, and their
   magnitudes, over the circumference, into a third unless it is NULL. */
void jox_transfers_sum(JoxForces *forces, float *x, float *y, float *compression);
void jox_force_add_impulse(JoxForces *forces, uint32_t agent_id, uint32_t object, JoxV3 impulse,
                           JoxV3 point);

/* Length of the agent's outline, over which forces are spread, m. */
static inline float jox_circumference(float radius) {
    return 6.28318531f * radius;
}

/* Height at which an agent meets a body: the chest's, kept within what the body covers. */
float jox_touch_height(const JoxObject *body);

/* Contacts with bodies, for the passes of jox_force_contact. */
void jox_touches_find(JoxForces *forces, uint32_t begin, uint32_t end);
void jox_touches_collect(JoxForces *forces);
void jox_touches_prepare(JoxForces *forces);
void jox_touches_pass(JoxForces *forces);
void jox_touches_finish(JoxForces *forces);

/* Equations as they are printed, literal.c. (5): from where the pusher will be to the one pushed.
 */
JoxV2 jox_literal_push_offset(const JoxForces *forces, uint32_t pusher, JoxV2 to_centre);
/* (6): impulses of all pairs and touches. */
void jox_literal_contacts(JoxForces *forces);
/* (11), (12): the half-plane of agent i's net force, and its speed limit. */
void jox_literal_bound(JoxForces *forces, uint32_t i);
/* (8), (9): what agent i, of that chunk, passes on. */
void jox_literal_pass_on(JoxForces *forces, uint32_t chunk, uint32_t i);

/* Whether agent i was under force in this step: then its neighbours feel its resistance, otherwise
   its slowing down. */
bool jox_literal_under_force(const JoxForces *forces, uint32_t i);
static inline bool jox_under_force(const JoxForces *f, uint32_t i) {
    const JoxAgents *a = f->step.agents;
    return f->options.literal ? jox_literal_under_force(f, i)
                              : a->half_plane_x[i] != 0.0f || a->half_plane_y[i] != 0.0f;
}

/* Assertions: transfers lie sorted by receiver, from givers that live; the contacts between agents
   add up to no force. */
void jox_transfers_check(const JoxForces *forces);
void jox_contacts_check(const JoxForces *forces);

#endif
