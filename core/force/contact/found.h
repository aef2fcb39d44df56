/* Contacts with agents and walls as they are found, chunk by chunk, in the order in memory. find.c
   leads; layout.c then puts them into the order of the solve. */
#ifndef JOX_FORCE_CONTACT_FOUND_H
#define JOX_FORCE_CONTACT_FOUND_H

#include "force/forces.h"
#include "simd/isa.h"

enum {
    JOX_NO_COLOUR = 255,        /* a contact that is left out */
    JOX_CONTACT_MOST_WALLS = 8, /* most points at which one agent touches walls */
    JOX_CONTACT_MOST_FOUND =
        2 * JOX_MOST_NEIGHBOURS,           /* most contacts that one agent finds with others */
    JOX_FOUND_RUN = JOX_CONTACT_MOST_FOUND /* length of the runs of pairs and slots */
};

#define JOX_SECOND_APART 0.02f /* m: least distance of two points at which the same two touch */

/* A point at which two agents touch. The normal points to the first, the tangent to the left of it.
   A lever is that of an impulse on the agent about its centre, in its radii of gyration; 0 of a
   disc, which does not turn. Kernels read and write rows of four numbers. */
typedef struct JoxContactPoint {
    JoxV2 normal;
    float levers[2];       /* of both agents, along the normal */
    float target;          /* least normal velocity of the first relative to the second, m/s */
    float mass, slip_mass; /* kg: what the point opposes to impulses along normal and tangent */
    float gap;             /* m */
    float slips[2];        /* levers along the tangent */
    float borne, parted;   /* N s: impulses of the last step (JoxKeptImpulse); layout.c adds them */
} JoxContactPoint;

/* A contact that an agent was found to have; the normal points to the agent. One of the two agents
   finds a contact between them. */
typedef struct JoxFoundPair {
    uint32_t other : 31,
        again : 1; /* again: the two touch at another point, too, which is nearer */
    uint32_t other_id;
    JoxContactPoint at;
} JoxFoundPair;
/* The part of a found pair that its layout needs, in few bytes: the other agent, its colour, and
   its number among the contacts of either agent. */
typedef struct JoxPairSlot {
    uint32_t other;
    uint8_t colour, first_end, second_end;
} JoxPairSlot;
typedef struct JoxFoundWall {
    uint32_t edge;
    JoxV2 normal;
    float gap, along; /* m; along: from the start of the edge */
    JoxV2 own;        /* point of the agent's axis that is nearest, from its centre, m */
} JoxFoundWall;

/* Zero-initialise; it owns its arrays. */
typedef struct JoxFoundContacts {
    /* pairs: in runs, none of which ends among the pairs of one agent; in shared
       memory (JoxForces). slots: parallel to `pairs`. */
    JoxChunkList pairs, slots, walls;
    uint32_t *first_pair, *first_wall; /* per agent: first one in all chunks' items; first_wall:
                                          after the layout an index into the contacts with walls */
    uint8_t *pair_count, *wall_count;  /* per agent */
    uint32_t *overlaps;                /* per chunk: overlapping pairs of agents */
    bool has_full_list; /* some touch list is full: contacts are found agent by agent */
    size_t first_pair_capacity, pair_count_capacity, first_wall_capacity, wall_count_capacity;
    size_t overlap_capacity;
} JoxFoundContacts;

/* Finds the contacts of all agents: with agents and walls, and by jox_touches_find with bodies. */
void jox_contacts_find(JoxForces *forces);
void jox_found_contacts_free(JoxFoundContacts *found);

/* find_wide.c: finds the contacts of agents [begin, end) of one chunk with agents and walls.
   `begin` is a multiple of JOX_LANES. One function for each instruction set. */
typedef void JoxFindKernel(JoxForces *forces, uint32_t begin, uint32_t end);
#define X(name, isa) JoxFindKernel jox_find_packets_##name;
JOX_ISAS(X)
#undef X

/* find_alone.c: finds the contacts with other agents that one agent has to find, by ascending id;
   returns how many. The agent of lesser id finds a contact, or the other one where the list of the
   first is full. `walls`: some are near. */
uint32_t jox_find_contacts_alone(JoxForces *forces, uint32_t agent, bool walls, JoxFoundPair *out);
/* find_alone.c: finds the nearest edges that an agent touches; returns how many. */
uint32_t jox_find_wall_contacts(const JoxForces *forces, uint32_t agent,
                                JoxFoundWall out[JOX_CONTACT_MOST_WALLS]);
/* Inserts a contact into a list of `count`, sorted by id. */
static inline void jox_insert_pair(JoxFoundPair *list, uint32_t count, const JoxFoundPair *pair) {
    for (; count > 0 && list[count - 1].other_id > pair->other_id; count--)
        list[count] = list[count - 1];
    list[count] = *pair;
}

#endif
