/* JoxForces, and small helpers on one agent, for all rooms of force. stages/forces.c creates and
   frees it. Scratch memory grows to its peak and stays; the struct that holds an array owns
   it. */
#ifndef JOX_FORCE_FORCES_H
#define JOX_FORCE_FORCES_H

#include "base/number/pi.h"
#include "force/chunk_list.h"
#include "force/equations.h"
#include "force/force.h"
#include "force/impulses.h"
#include "force/transfers.h"

/* Data of an agent, other than its motion, that contacts need: one load fetches all of it. m,
   kg. */
typedef struct JoxAgentRecord {
    float radius, outer, mass; /* radius: contact_radius; outer: of any part from the centre */
    uint32_t id;
} JoxAgentRecord;

typedef struct JoxPushes JoxPushes;     /* push/pushes.h */
typedef struct JoxSupports JoxSupports; /* support/supports.h */
typedef struct JoxContacts JoxContacts; /* contact/contacts.h */

struct JoxForces {
    JoxForceOptions options;
    JoxStep step;      /* from begin on */
    JoxForceInputs in; /* likewise */
    JoxForceTotals totals;
    uint32_t chunks;
    JoIsa isa;      /* instruction set of the kernels */
    JoxDecay decay; /* that of the first agent in a step, as most agents have its damping */
    JoxStageMemory *memory, own_memory; /* from begin on; own_memory: used where none was given */
    /* Per agent, for finding contacts; in stage memory, which the motions of the solve then use. */
    JoxAgentRecord *records;
    /* Memory that several use in turn. found_memory: the transfers of pushes until they are sorted,
       the pairs found until they are laid out, then contact planes until the next pushes.
       pair_memory: the pairs until plans are borne, then the transfers of infer. */
    JoxChunkMemory found_memory, pair_memory;
    float widest;    /* bound of the distance of surfaces from centres, m */
    bool has_bodies; /* there are bodies that agents can meet */

    JoxTransfers transfers;
    JoxImpulses impulses; /* on bodies */
    JoxPushes *pushes;
    JoxSupports *supports;
    JoxContacts *contacts;
};

/* Returns whether a wall stands between two points near an agent, no farther apart than the grid of
   walls serves: no force passes it. */
bool jox_wall_stops_force(const JoxForces *forces, JoxV2 from, JoxV2 to);

/* How an agent plans: how long it keeps a plan, s; the share of the way covered in that time; and
   how long forces count meanwhile, s (interval_forced). */
typedef struct JoxPlanning {
    float interval, response, forced;
} JoxPlanning;
static inline JoxPlanning jox_planning(const JoxTiming *t, bool each_step) {
    if (each_step)
        return (JoxPlanning){(float)t->dt, (float)t->response, (float)t->dt};
    return (JoxPlanning){(float)t->interval, (float)t->interval_response,
                         (float)t->interval_forced};
}

/* Returns the sum of an agent's force terms of some roles (flags of JoxForceRole), N, in the order
   of the table. It starts from -0, which keeps the sign of zero terms. */
static inline JoxV2 jox_sum_terms(const JoxAgents *a, uint32_t i, uint32_t roles) {
    JoxV2 sum = {-0.0f, -0.0f};
#define ADD_TERM(X, keep, role, name, label)                                                       \
    if (JOX_FORCE_##role & roles)                                                                  \
        sum = jox_add(sum, (JoxV2){a->name##_x[i], a->name##_y[i]});
    JOX_FORCE_TERMS(ADD_TERM, )
#undef ADD_TERM
    return sum;
}

/* Returns an agent's velocity before the step, m/s. */
static inline JoxV2 jox_velocity_before(const JoxForces *f, uint32_t i) {
    const JoxMotion *motion = &f->step.neighbours->motions[i];
    return (JoxV2){motion->vx, motion->vy};
}

/* Returns the most agents that any chunk has. */
static inline uint32_t jox_most_chunk_agents(const JoxForces *f) {
    const uint32_t count = f->step.agents->count;
    return count < JOX_FORCE_GRAIN ? count : JOX_FORCE_GRAIN;
}
/* literal.c: the equations as printed. (5): returns the direction of a push, from where
   the pusher will be to the target's centre. */
JoxV2 jox_literal_push_offset(const JoxForces *forces, uint32_t pusher, JoxV2 to_centre);
/* (10) to (12): writes agent i's net force, half-plane and speed limit. */
void jox_literal_sum(JoxForces *forces, uint32_t i);
/* (8), (9): adds what agent i, of a chunk, passes on. */
void jox_literal_pass_on(JoxForces *forces, uint32_t chunk, uint32_t i);

/* Returns whether agent i was under force in this step: then others feel its resistance, else its
   slowing. */
bool jox_literal_under_force(const JoxForces *forces, uint32_t i);
static inline bool jox_under_force(const JoxForces *f, uint32_t i) {
    const JoxAgents *a = f->step.agents;
    return f->options.literal ? jox_literal_under_force(f, i)
                              : a->half_plane_x[i] != 0.0f || a->half_plane_y[i] != 0.0f;
}

#endif
