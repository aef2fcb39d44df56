/* What the stages of force share: scratch that grows to its peak and stays. */
#ifndef JOX_FORCE_INTERNAL_H
#define JOX_FORCE_INTERNAL_H

#include "base/number/pi.h"
#include "force/contact.h"
#include "force/equations.h"
#include "force/force.h"

enum {
    JOX_FORCE_GRAIN = 256 /* agents of a chunk; each chunk writes lists of its own */
};

/* A force that one agent gives another. */
typedef struct JoxTransfer {
    uint32_t to, from_id;
    float x, y;
} JoxTransfer;

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

struct JoxForces {
    JoxForceOptions options;
    JoxForceStep step;
    JoxForceTotals totals;
    uint32_t chunks;
    JoIsa isa;                          /* of the kernels */
    JoxDecay decay;                     /* of the first agent in a step: most have its damping */
    JoxStageMemory *memory, own_memory; /* of push; own: where it was given none */
    JoxBuild *builds;                   /* of all agents, as contacts are found */

    JoxChunkList transfers;
    uint32_t *starts; /* per receiver, and one more */
    size_t start_capacity;
    JoxTransfer *sorted;
    size_t sorted_capacity;

    bool pushed; /* `sorted` holds this step's pushes */

    /* Contacts: as found, by chunk, and where each agent's stand; then as they are solved. */
    bool contacts_known;                             /* looked for in this step */
    JoxChunkList found, slots, found_walls, touches; /* slots: as found */
    uint32_t *found_first, *wall_first;              /* wall_first: once laid out, in `wall` */
    uint8_t *found_number, *wall_number;
    size_t found_first_capacity, found_number_capacity, wall_first_capacity, wall_number_capacity;
    bool cut; /* a list of those within touching range is: contacts are found one by one */
    JoxPairs pairs;
    uint64_t *colours_of; /* per agent: bit per colour of a pair that it is in */
    JoxListed *listed;    /* per agent */
    size_t listed_capacity;
    uint32_t (*colour_sizes)[JOX_CONTACT_MOST_COLOURS]; /* per chunk; then where its next stands */
    size_t colour_size_capacity;
    JoxEnd *ends; /* of agent i: end_starts[i] to end_starts[i + 1], in an order of ids alone */
    uint32_t *end_starts;
    size_t end_capacity, end_start_capacity;
    JoxWallContact *wall; /* by agent id, then edge */
    uint32_t *wall_group; /* first of each agent that has any, and one more */
    uint32_t wall_count, wall_groups;
    size_t wall_capacity, wall_group_capacity;
    JoxTouch *touch; /* all touches, sorted by agent id, then row */
    size_t touch_capacity;
    uint32_t touch_count;
    JoxDrive *drives;
    size_t drive_capacity;
    uint32_t drive_count;
    JoxDriveLoad *drive_loads; /* of each */
    size_t drive_load_capacity;
    uint32_t *touch_first; /* per agent, valid where touch_number is not 0 */
    uint8_t *touch_number;
    size_t touch_first_capacity, touch_number_capacity;
    JoxBodyMotion *motions; /* per row of objects */
    size_t motion_capacity;
    JoxSupport *support; /* in the order of the objects' contacts */
    uint32_t support_count;
    JoxSupportWatch *watch; /* of each */
    size_t support_capacity, watch_capacity;
    JoxV2 *work;      /* velocities while contacts are solved */
    float *lightness; /* 1 / mass */
    float *residuals; /* per chunk of a pass */
    size_t residual_capacity;
    JoxV2 *braced; /* per agent: what its own pushes press it with, N */
    size_t braced_capacity;
    JoxContactPlanes planes;

    const JoxWalls *walls;
    const JoxWallImages *images; /* of these, beyond joined edges; NULL: none */
    JoxWallLoad *pieces;         /* of all edges */
    uint32_t *piece_first;       /* per edge, and one more */
    uint32_t piece_count;
    size_t piece_capacity, piece_first_capacity;

    /* State: from which the next step's solve starts. */
    JoxKeptImpulses kept_pairs, kept_walls, kept_touches;

    float widest; /* greatest radius, m */
    bool bodies;  /* some can be met */
    JoxPendingImpulse *pending;
    size_t pending_capacity;
    uint32_t pending_count, pending_sorted;
    JoxImpulse *impulses;
    size_t impulse_capacity;

    struct JoxForceChunk { /* totals of a chunk; momentum in 2^-20 N s, so that order is free */
        uint32_t pushers, overlaps;
        int64_t ground_x, ground_y;
    } * chunk;
    size_t chunk_capacity;
};

/* Makes room for `need` bytes of items in all. */
void jox_chunks_grow(JoxChunkList *list, uint32_t chunks, size_t need);
/* Makes room for `room` items of `size` bytes in every chunk. Who then goes through the chunks
   empties the list of each before anything is put into it. */
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
/* Agents in reach of agent i within its cone about `axis`: their indices, in the order of nearness.
 */
uint32_t jox_people_in_cone(const JoxForces *forces, uint32_t i, JoxV2 axis, uint32_t *found);
/* Whether a wall stands between two points of an agent's surroundings that are no farther apart
   than the walls' grid serves: no force goes through it. */
bool jox_force_is_walled_off(const JoxForces *forces, JoxV2 from, JoxV2 to);
/* Makes room for forces between agents. */
void jox_transfers_begin(JoxForces *forces);
/* Lists a force that agent i, of that chunk, gives agent `to`. */
void jox_transfer_give(JoxForces *forces, uint32_t chunk, uint32_t i, uint32_t to, JoxV2 force);
/* Sorts the transfers by receiver: those of agent i are sorted[starts[i]] to sorted[starts[i + 1]].
   Returns how many there are; with none, nothing is written. */
uint32_t jox_transfers_sort(JoxForces *forces);
/* Adds the transfers of all agents, in ascending id of the giver, into two columns. */
void jox_transfers_sum(JoxForces *forces, float *x, float *y);
void jox_force_add_impulse(JoxForces *forces, uint32_t agent_id, uint32_t object, JoxV3 impulse,
                           JoxV3 point, float lasting);

/* Length of the agent's outline, over which forces are spread, m. */
static inline float jox_circumference(float radius) {
    return (float)JOX_TURN * radius;
}

/* Height at which an agent meets a body: the chest's, kept within what the body covers. */
float jox_touch_height(const JoxObject *body);

/* How long an agent goes on with what it plans, s, the share of the way gone in that time, and for
   how long forces count that act meanwhile, s (interval_forced). */
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

/* Sum of an agent's force terms of some roles (flags of JoxForceRole), N, in the order of the
   table. -0 is the neutral element: it keeps the sign of a zero. */
static inline JoxV2 jox_sum_terms(const JoxAgents *a, uint32_t i, uint32_t roles) {
    JoxV2 sum = {-0.0f, -0.0f};
#define ADD_TERM(X, keep, role, name, label)                                                       \
    if (JOX_FORCE_##role & roles)                                                                  \
        sum = jox_add(sum, (JoxV2){a->name##_x[i], a->name##_y[i]});
    JOX_FORCE_TERMS(ADD_TERM, )
#undef ADD_TERM
    return sum;
}

/* The part of the pushes of others that an agent's feet do not hold, N. */
static inline JoxV2 jox_unheld_pushes(const JoxAgents *a, uint32_t i) {
    JoxV2 others = jox_sum_terms(a, i, JOX_FORCE_BRACED);
    float size = jox_length(others),
          held = jox_stands(a, i) ? 0.0f : jox_param(a, JOX_PARAM_brace, i);
    return jox_scale(others, size > held ? (size - held) / size : 0.0f);
}

/* Velocity of an agent before the step, m/s. */
static inline JoxV2 jox_velocity_before(const JoxForces *f, uint32_t i) {
    const JoxMotion *motion = &f->step.neighbours->motions[i];
    return (JoxV2){motion->vx, motion->vy};
}

/* Force that moves an agent before contacts are solved, N: the free terms, and of the others'
   pushes what the feet do not hold. */
static inline JoxV2 jox_moving_force(const JoxAgents *a, uint32_t i) {
    return jox_add(jox_sum_terms(a, i, JOX_FORCE_FREE), jox_unheld_pushes(a, i));
}

/* contact_find.c: what each agent touches. */
void jox_contacts_find(JoxForces *forces);
/* contact_near.c: the same of one agent. Those that it touches and it is for it to find, by
   ascending id: the one of lesser id finds a contact, or, in a heap of people where its list is
   cut, the other. `walls`: some are near. */
uint32_t jox_contacts_of(JoxForces *forces, uint32_t agent, bool walls, JoxFoundPair *out);
/* Edges that it touches, the nearest of them. */
uint32_t jox_contacts_walls_of(const JoxForces *forces, uint32_t agent,
                               JoxFoundWall out[JOX_CONTACT_MOST_WALLS]);
/* Puts a contact into a list of `count` by ascending ids. */
static inline void jox_pair_insert(JoxFoundPair *list, uint32_t count, const JoxFoundPair *pair) {
    for (; count > 0 && list[count - 1].other_id > pair->other_id; count--)
        list[count] = list[count - 1];
    list[count] = *pair;
}
/* N/m: what shoulders that are turned to each other press with, until the bodies themselves meet.
 */
#define JOX_SQUEEZE 2000.0f
/* contact_layout.c: the contacts found, in the order of ids, with the impulses of the last step;
   and what the solve begins with. */
void jox_contacts_lay(JoxForces *forces);
void jox_contacts_keep(JoxForces *forces);
/* Impulse kept of a contact; asked for by ascending ids, with the place in the list that the last
   question left. 0 where there was none. */
float jox_kept_impulse(const JoxKeptImpulses *kept, size_t *at, uint32_t id, uint32_t other);
/* Least normal velocity after a contact, m/s: the gap (m) may close within the step, no more, and
   what meets within it bounces. `speed`: normal velocity before. */
float jox_contact_target(float gap, float speed, float restitution, float dt);
/* Agents of the chunk that has most of them. */
static inline uint32_t jox_chunk_agents(const JoxForces *f) {
    const uint32_t count = f->step.agents->count;
    return count < JOX_FORCE_GRAIN ? count : JOX_FORCE_GRAIN;
}
/* m: bodies that are nearer than this touch. They tremble in Bullet by tenths of a millimetre,
   which in a short step would be a part of the force that presses people on them. */
#define JOX_BODY_SLACK 1e-3f
/* contact_solve.c: all impulses. */
void jox_contacts_solve(JoxForces *forces);
/* contact_planes.c: half-planes of what is touched. */
void jox_contact_planes_make(JoxForces *forces);
/* load.c: compression and load of one agent, and of all walls, by the impulses found. */
void jox_load_measure(JoxForces *forces, uint32_t agent);
/* Whether neither walls nor what was passed on press on any of agents [begin, end). */
bool jox_loads_are_none(const JoxForces *forces, uint32_t begin, uint32_t end);
void jox_wall_loads_measure(JoxForces *forces);

/* touch.c: contacts with bodies. begin: velocities of bodies, first impulses; pass: one over all
   touches, which returns the greatest change of an impulse, N s; finish: impulses for the bodies.
 */
void jox_touches_find(JoxForces *forces, uint32_t begin, uint32_t end);
void jox_touches_collect(JoxForces *forces);
void jox_touches_begin(JoxForces *forces);
float jox_touches_pass(JoxForces *forces);
void jox_touches_finish(JoxForces *forces);
static inline uint32_t jox_touches_of(const JoxForces *forces, uint32_t agent) {
    return forces->touch_count ? forces->touch_number[agent] : 0;
}
/* Whether agents [begin, end), JOX_LANES at most, touch neither people nor bodies. */
static inline bool jox_touch_nothing(const JoxForces *f, uint32_t begin, uint32_t end) {
    uint32_t touches = f->end_starts[end] - f->end_starts[begin];
    for (uint32_t i = begin; f->touch_count && i < end; i++)
        touches |= f->touch_number[i];
    return touches == 0;
}
/* Normal velocity of a body where it is touched, m/s: before the contacts, and after them. */
float jox_touch_speed_before(const JoxForces *forces, const JoxTouch *touch);
float jox_touch_speed_after(const JoxForces *forces, const JoxTouch *touch);

/* support.c: what holds the bodies that are touched. begin: motions of all bodies, and first
   impulses; pass: as of touches; finish: how much of what the touches gave was held. */
void jox_supports_begin(JoxForces *forces);
void jox_supports_warm(JoxForces *forces); /* support_solve.c: gives the impulses begun with */
float jox_supports_pass(JoxForces *forces);
void jox_supports_finish(JoxForces *forces);
/* Velocity of a point of a body, m/s, and an impulse there, N s, while contacts are solved. */
JoxV3 jox_body_velocity(const JoxForces *forces, uint32_t row, JoxV3 point);
void jox_body_give(JoxForces *forces, uint32_t row, JoxV3 point, JoxV3 impulse);

/* Equations as they are printed, literal.c. (5): from where the pusher will be to the one pushed.
 */
JoxV2 jox_literal_push_offset(const JoxForces *forces, uint32_t pusher, JoxV2 to_centre);
/* (6): impulses of all pairs and touches. */
void jox_literal_contacts(JoxForces *forces);
/* (10) to (12): agent i's net force, its half-plane, and the speed limit. */
void jox_literal_sum(JoxForces *forces, uint32_t i);
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
