/* Types and helpers that the files of force share. Scratch memory grows to its peak and stays;
   JoxForces owns all of it. */
#ifndef JOX_FORCE_FORCES_H
#define JOX_FORCE_FORCES_H

#include "base/number/pi.h"
#include "force/contact.h"
#include "force/equations.h"
#include "force/force.h"

enum {
    JOX_FORCE_GRAIN = 256 /* agents of a chunk; each chunk fills lists of its own */
};

/* A force that one agent gives another. */
typedef struct JoxTransfer {
    uint32_t to, from_id;
    float x, y;
} JoxTransfer;

/* An impulse on a body with its sort key: agent id, then row. Impulses of equal keys keep their
   order. */
typedef struct JoxPendingImpulse {
    uint64_t key;
    JoxImpulse impulse;
} JoxPendingImpulse;

/* A list that chunks fill in parallel: chunk c owns the items from c * room on. Only the memory in
   use is touched. */
typedef struct JoxChunkList {
    void *items;
    uint32_t *counts;
    uint32_t room; /* items per chunk */
    size_t capacity, chunk_capacity;
} JoxChunkList;

struct JoxForces {
    JoxForceOptions options;
    JoxForceStep step;
    JoxForceTotals totals;
    uint32_t chunks;
    JoIsa isa;      /* instruction set of the kernels */
    JoxDecay decay; /* that of the first agent in a step, as most agents have its damping */
    JoxStageMemory *memory, own_memory; /* from begin on; own_memory: used where none was given */
    JoxBuild *builds;                   /* per agent, for finding contacts */

    JoxChunkList transfers;
    uint32_t *starts; /* per receiver, plus one: first of its transfers in `sorted` */
    size_t start_capacity;
    JoxTransfer *sorted;
    size_t sorted_capacity;

    bool pushed; /* `sorted` holds this step's pushes */

    /* Contacts: as found, by chunk, with the first one and the number of each agent; then as laid
       out for the solve. */
    bool contacts_known;                             /* they were searched for in this step */
    JoxChunkList found, slots, found_walls, touches; /* slots: parallel to `found` */
    uint32_t *found_first, *wall_first; /* wall_first: after the layout an index into `wall` */
    uint8_t *found_number, *wall_number;
    size_t found_first_capacity, found_number_capacity, wall_first_capacity, wall_number_capacity;
    bool has_full_list; /* some touch list is full: contacts are found agent by agent */
    JoxPairs pairs;
    uint64_t *colours_of; /* per agent: bits of the colours of its pairs */
    JoxListed *listed;    /* per agent */
    size_t listed_capacity;
    uint32_t (*colour_sizes)[JOX_CONTACT_MOST_COLOURS]; /* per chunk: numbers of pairs, then place
                                                           of the next one */
    size_t colour_size_capacity;
    JoxEnd *ends; /* agent i: end_starts[i] to end_starts[i + 1], ordered by ids alone */
    uint32_t *end_starts;
    size_t end_capacity, end_start_capacity;
    JoxWallContact *wall; /* sorted by agent id, then edge */
    uint32_t *wall_group; /* first contact of each agent at a wall, and the end */
    uint32_t wall_count, wall_groups;
    size_t wall_capacity, wall_group_capacity;
    JoxTouch *touch; /* all touches, sorted by agent id, then row */
    size_t touch_capacity;
    uint32_t touch_count;
    JoxDrive *drives;
    size_t drive_capacity;
    uint32_t drive_count;
    JoxDriveLoad *drive_loads; /* per drive */
    size_t drive_load_capacity;
    uint32_t *touch_first; /* per agent, valid where touch_number is not 0 */
    uint8_t *touch_number;
    size_t touch_first_capacity, touch_number_capacity;
    JoxBodyMotion *motions; /* per row of objects */
    size_t motion_capacity;
    JoxSupport *support; /* sorted as the objects' contacts */
    uint32_t support_count;
    JoxSupportWatch *watch; /* per support */
    size_t support_capacity, watch_capacity;
    JoxV2 *velocities;   /* m/s, while contacts are solved */
    float *inverse_mass; /* 1 / mass, 1/kg */
    float *residuals;    /* per chunk of a pass */
    size_t residual_capacity;
    JoxV2 *braced; /* per agent: reaction of its own pushes, N */
    size_t braced_capacity;
    JoxContactPlanes planes;

    const JoxWalls *walls;
    const JoxWallImages *images; /* images of the walls beyond joined edges; NULL: none */
    JoxWallLoad *pieces;         /* pieces of all edges */
    uint32_t *piece_first;       /* per edge, plus one */
    uint32_t piece_count;
    size_t piece_capacity, piece_first_capacity;

    /* State: the impulses from which the next step's solve starts. */
    JoxKeptImpulses kept_pairs, kept_walls, kept_touches;

    float widest;    /* greatest radius, m */
    bool has_bodies; /* there are bodies that agents can meet */
    JoxPendingImpulse *pending;
    size_t pending_capacity;
    uint32_t pending_count, pending_sorted;
    JoxImpulse *impulses;
    size_t impulse_capacity;

    struct JoxForceChunk { /* totals per chunk; momentum in 2^-20 N s, as integers, so that the
                              order of the sum does not matter */
        uint32_t pushers, overlaps;
        int64_t ground_x, ground_y;
    } * chunk;
    size_t chunk_capacity;
};

/* Grows a list to `need` bytes in all. */
void jox_chunks_grow(JoxChunkList *list, uint32_t chunks, size_t need);
/* Makes room for `room` items of `size` bytes in every chunk. The caller then empties each chunk's
   list before adding to it. */
static inline void jox_chunks_begin(JoxChunkList *list, uint32_t chunks, uint32_t room,
                                    size_t size) {
    const size_t need = (size_t)chunks * room * size;
    if (need > list->capacity || chunks > list->chunk_capacity)
        jox_chunks_grow(list, chunks, need);
    list->room = room;
}
static inline void jox_chunk_empty(JoxChunkList *list, uint32_t chunk) {
    list->counts[chunk] = 0;
}
/* Finds the agents in reach of agent i within its bracing cone about `axis`: their indices, nearest
   first. Returns how many. */
uint32_t jox_people_in_cone(const JoxForces *forces, uint32_t i, JoxV2 axis, uint32_t *found);
/* Returns whether a wall stands between two points near an agent, no farther apart than the grid of
   walls serves: no force passes it. */
bool jox_force_is_walled_off(const JoxForces *forces, JoxV2 from, JoxV2 to);
/* Makes room for transfers between agents. */
void jox_transfers_begin(JoxForces *forces);
/* Adds a force, N, that agent i of a chunk gives agent `to`. */
void jox_transfers_add(JoxForces *forces, uint32_t chunk, uint32_t i, uint32_t to, JoxV2 force);
/* Sorts the transfers by receiver: those of agent i become sorted[starts[i]] to sorted[starts[i +
   1]]. Returns how many there are; with none nothing is written. */
uint32_t jox_transfers_sort(JoxForces *forces);
/* Adds each agent's transfers to two columns, in ascending id of the giver. */
void jox_transfers_sum(JoxForces *forces, float *x, float *y);
void jox_force_add_impulse(JoxForces *forces, uint32_t agent_id, uint32_t object, JoxV3 impulse,
                           JoxV3 point, float lasting);

/* Returns the circumference of an agent, over which forces are spread, m. */
static inline float jox_circumference(float radius) {
    return (float)JOX_TURN * radius;
}

#define JOX_CHEST 1.1f /* m: height at which agents push and are hit */
/* Returns the height at which an agent meets a body, m: chest height, clamped to the body's
   extent. */
static inline float jox_touch_height(const JoxObject *body) {
    return jox_minf(jox_maxf(JOX_CHEST, body->low), body->high);
}

/* How an agent plans: how long it keeps a plan, s; the share of the way covered in that time; and
   how long forces count meanwhile, s (interval_forced). */
typedef struct JoxPlanning {
    float interval, response, forced;
} JoxPlanning;
static inline JoxPlanning jox_planning(const JoxForceStep *step, bool each_step) {
    if (each_step)
        return (JoxPlanning){(float)step->dt, (float)step->response, (float)step->dt};
    return (JoxPlanning){(float)step->interval, (float)step->interval_response,
                         (float)step->interval_forced};
}
static inline JoxPlanning jox_planning_of(const JoxForceStep *step, uint32_t i) {
    return jox_planning(step, jox_stands_pressed(step->agents, i));
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

/* Returns the part of others' pushes that an agent's feet do not hold, N. */
static inline JoxV2 jox_unheld_pushes(const JoxAgents *a, uint32_t i) {
    JoxV2 others = jox_sum_terms(a, i, JOX_FORCE_BRACED);
    float size = jox_length(others),
          held = jox_stands(a, i) ? 0.0f : jox_param(a, JOX_PARAM_brace, i);
    return jox_scale(others, size > held ? (size - held) / size : 0.0f);
}

/* Returns an agent's velocity before the step, m/s. */
static inline JoxV2 jox_velocity_before(const JoxForces *f, uint32_t i) {
    const JoxMotion *motion = &f->step.neighbours->motions[i];
    return (JoxV2){motion->vx, motion->vy};
}

/* Returns the force that moves an agent before contacts are solved, N: the free terms, plus the
   pushes of others that its feet do not hold. */
static inline JoxV2 jox_moving_force(const JoxAgents *a, uint32_t i) {
    return jox_add(jox_sum_terms(a, i, JOX_FORCE_FREE), jox_unheld_pushes(a, i));
}

/* contact/find.c: finds the contacts of all agents. */
void jox_contacts_find(JoxForces *forces);
/* contact/find_alone.c: finds the contacts with other agents that one agent has to find, by
   ascending id; returns how many. The agent of lesser id finds a contact, or the other one where
   the list of the first is full. `walls`: some are near. */
uint32_t jox_find_contacts_alone(JoxForces *forces, uint32_t agent, bool walls, JoxFoundPair *out);
/* contact/find_alone.c: finds the nearest edges that an agent touches; returns how many. */
uint32_t jox_find_wall_contacts(const JoxForces *forces, uint32_t agent,
                                JoxFoundWall out[JOX_CONTACT_MOST_WALLS]);
/* Inserts a contact into a list of `count`, sorted by id. */
static inline void jox_pair_insert(JoxFoundPair *list, uint32_t count, const JoxFoundPair *pair) {
    for (; count > 0 && list[count - 1].other_id > pair->other_id; count--)
        list[count] = list[count - 1];
    list[count] = *pair;
}
/* N/m: stiffness of turned shoulders, until the bodies themselves meet */
#define JOX_SQUEEZE 2000.0f
/* contact/layout.c: lays out the contacts found, in the order of ids, with the impulses of the last
   step, and computes the start of the solve (lay); keeps the impulses for the next step (keep). */
void jox_contacts_lay_out(JoxForces *forces);
void jox_contacts_keep(JoxForces *forces);
/* Returns the kept impulse of a contact, N s; 0 for a new one. Called in ascending order of ids;
 *at is the place in the list, 0 at first. */
float jox_kept_impulse(const JoxKeptImpulses *kept, size_t *at, uint32_t id, uint32_t other);
/* Returns the most agents that any chunk has. */
static inline uint32_t jox_chunk_agents(const JoxForces *f) {
    const uint32_t count = f->step.agents->count;
    return count < JOX_FORCE_GRAIN ? count : JOX_FORCE_GRAIN;
}
/* m: bodies nearer than this touch. Bullet lets them tremble by tenths of a millimetre, which in a
   short step would alter the force between them noticeably. */
#define JOX_BODY_SLACK 1e-3f
/* contact/solve.c: solves all impulses. */
void jox_contacts_solve(JoxForces *forces);
/* contact/planes.c: makes the half-planes of contacts. */
void jox_contact_planes_make(JoxForces *forces);
/* contact/crush_load.c: measures compression and load of one agent, and the loads of all walls,
   from the impulses. */
void jox_load_measure(JoxForces *forces, uint32_t agent);
/* Returns whether neither walls nor pushes press on any of agents [begin, end). */
bool jox_loads_are_none(const JoxForces *forces, uint32_t begin, uint32_t end);
void jox_wall_loads_measure(JoxForces *forces);

/* contact/bodies.c: contacts with bodies. find: of agents [begin, end); collect: sorts those of all
   chunks; begin: motions of bodies, first impulses; pass: one pass over all touches, which returns
   the greatest change of an impulse, N s; finish: impulses on the bodies. */
void jox_touches_find(JoxForces *forces, uint32_t begin, uint32_t end);
void jox_touches_collect(JoxForces *forces);
void jox_touches_begin(JoxForces *forces);
float jox_touches_pass(JoxForces *forces);
void jox_touches_finish(JoxForces *forces);
static inline uint32_t jox_touches_of(const JoxForces *forces, uint32_t agent) {
    return forces->touch_count ? forces->touch_number[agent] : 0;
}
/* Returns whether agents [begin, end), at most JOX_LANES, have no contact with agents or bodies. */
static inline bool jox_have_no_contacts(const JoxForces *f, uint32_t begin, uint32_t end) {
    uint32_t touches = f->end_starts[end] - f->end_starts[begin];
    for (uint32_t i = begin; f->touch_count && i < end; i++)
        touches |= f->touch_number[i];
    return touches == 0;
}
/* Returns the normal velocity of a body at a contact, m/s, before and after the contacts act. */
float jox_touch_speed_before(const JoxForces *forces, const JoxTouch *touch);
float jox_touch_speed_after(const JoxForces *forces, const JoxTouch *touch);

/* support/supports.c: supports of the touched bodies. begin: motions of all bodies, first impulses;
   pass: as for touches; finish: the share of the touches' impulses that supports held. */
void jox_supports_begin(JoxForces *forces);
void jox_supports_warm(JoxForces *forces); /* support/solve.c: applies the first impulses */
float jox_supports_pass(JoxForces *forces);
void jox_supports_finish(JoxForces *forces);
/* Velocity of a point of a body, m/s; and applying an impulse there, N s, while contacts are
   solved. */
JoxV3 jox_body_velocity(const JoxForces *forces, uint32_t row, JoxV3 point);
void jox_body_apply_impulse(JoxForces *forces, uint32_t row, JoxV3 point, JoxV3 impulse);

/* literal.c: the equations as printed. (5): returns the direction of a push, from where the pusher
   will be to the target's centre. */
JoxV2 jox_literal_push_offset(const JoxForces *forces, uint32_t pusher, JoxV2 to_centre);
/* (6): solves all pairs and touches, each by itself. */
void jox_literal_contacts(JoxForces *forces);
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

/* Assertions: transfers are sorted by receiver and come from agents that exist; the forces of
   contacts between agents cancel out. */
void jox_transfers_check(const JoxForces *forces);
void jox_contacts_check(const JoxForces *forces);

#endif
