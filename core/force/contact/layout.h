/* Contacts with agents and walls as they are solved, in an order that depends on ids alone, and the
   impulses that are kept from step to step (layout.c). */
#ifndef JOX_FORCE_CONTACT_LAYOUT_H
#define JOX_FORCE_CONTACT_LAYOUT_H

#include "force/contact/found.h"

enum {
    JOX_CONTACT_MOST_COLOURS = 64 /* most contacts of an agent with other agents */
};

/* A contact between two agents, of which the first found it. Two agents have two contacts if they
   touch at two points. */
typedef struct JoxPair {
    uint32_t first;
    uint32_t second : 31, again : 1; /* again: as in JoxFoundPair */
    float impulse;                   /* along the normal: accumulated, not negative, N s */
    float slip;                      /* along the tangent, by friction, N s */
    JoxContactPoint at;
} JoxPair;

/* Returns the impulse of a contact on its first agent, N s. */
static inline JoxV2 jox_pair_impulse(const JoxPair *p) {
    return (JoxV2){p->at.normal.x * p->impulse - p->at.normal.y * p->slip,
                   p->at.normal.y * p->impulse + p->at.normal.x * p->slip};
}

/* One agent's end of a contact with another agent. */
typedef struct JoxPairEnd {
    uint32_t pair; /* index of the pair */
    uint32_t other;
} JoxPairEnd;

/* For an agent with contacts: the number of its first contact in ascending order of ids, and the
   index of its first kept impulse (or that of the next agent that has some). */
typedef struct JoxPairOrder {
    uint32_t first_pair, first_kept;
} JoxPairOrder;

/* Contacts between agents, sorted by colour. No agent occurs twice in a colour, so that its
   contacts may be solved in any order, on any number of threads. Zero-initialise; it owns its
   arrays, except `colours_of` and `items`, which are in shared memory (JoxForces). */
typedef struct JoxPairs {
    uint32_t count, colours;
    uint32_t starts[JOX_CONTACT_MOST_COLOURS + 1]; /* first item of each colour */
    JoxPair *items;
    JoxPairEnd *ends; /* agent i: end_starts[i] to end_starts[i + 1], ordered by ids alone */
    uint32_t *end_starts;
    uint64_t *colours_of; /* per agent: bits of the colours of its pairs; in stage memory */
    JoxPairOrder *orders; /* per agent */
    uint32_t (*colour_sizes)[JOX_CONTACT_MOST_COLOURS]; /* per chunk: numbers of pairs, then place
                                                           of the next one */
    size_t end_capacity, end_start_capacity, order_capacity, colour_size_capacity;
} JoxPairs;

/* A contact of an agent with an edge of a wall. */
typedef struct JoxWallContact {
    uint32_t agent, edge;
    JoxV2 normal;
    float along, gap, target; /* m from the start of the edge, m, m/s */
    float mass, slip_mass;    /* kg, as in JoxContactPoint */
    float lever, slip_lever;  /* likewise */
    float impulse, slip;      /* N s */
    float borne, parted;      /* N s, as in JoxContactPoint */
} JoxWallContact;

/* Returns the impulse of a wall on an agent, N s. */
static inline JoxV2 jox_wall_impulse(const JoxWallContact *w) {
    return (JoxV2){w->normal.x * w->impulse - w->normal.y * w->slip,
                   w->normal.y * w->impulse + w->normal.x * w->slip};
}

/* Zero-initialise; it owns its arrays. */
typedef struct JoxWallContacts {
    JoxWallContact *items; /* sorted by agent id, then edge */
    uint32_t *groups;      /* first contact of each agent at a wall, and the end */
    uint32_t count, group_count;
    size_t capacity, group_capacity;
} JoxWallContacts;

typedef struct JoxKeptImpulses {
    JoxKeptImpulse *items;
    size_t count, capacity;
} JoxKeptImpulses;

/* Lays out the contacts found, each with the impulse of the last step, and computes the velocities
   that the solve starts from. */
void jox_contacts_lay_out(JoxForces *forces);
/* Keeps the impulses of agents and walls for the next step; jox_touches_give_impulses keeps those
   of bodies. */
void jox_contacts_keep_impulses(JoxForces *forces);
/* Keeps, beside them, the impulses by which torsos have borne plans and part. */
void jox_contacts_keep_plans(JoxForces *forces);
void jox_pairs_free(JoxPairs *pairs);

/* Returns the kept impulses of a contact; zeros for a new one. Called in ascending order of ids;
 *at is the place in the list, 0 at first. */
const JoxKeptImpulse *jox_find_kept(const JoxKeptImpulses *kept, size_t *at, uint32_t id,
                                    uint32_t other);

#endif
