/* The nearest neighbours of each agent in the present step, nearest first, ties by id. `nav` writes
   them; force and machine read them. They are stored in blocks of JOX_LANES agents, one agent per
   lane: entry k of agent i is at (i / LANES * stride + k) * LANES + i % LANES. Entries beyond an
   agent's count have no meaning, but are valid indices. */
#ifndef JOX_AGENTS_NEIGHBOURS_H
#define JOX_AGENTS_NEIGHBOURS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"

enum {
    JOX_LANES = 16,
    JOX_MOST_NEIGHBOURS = 16,
    JOX_CROWD_RANK = 3 /* rank of the neighbour whose distance measures crowding */
};

/* Position, m, and velocity, m/s, of an agent in one place, so that lookups of many neighbours need
   one load each. */
typedef struct JoxMotion {
    float x, y, vx, vy;
} JoxMotion;

/* The torso of an agent in one place: its axis and its radius, m, and the inverse of the square of
   the axis' length, 1/m2 (0: a disc). */
typedef struct JoxTorsoShape {
    float axis_x, axis_y, radius, inverse_half2;
} JoxTorsoShape;

/* Zero-initialise for an empty table. */
typedef struct JoxNeighbours {
    uint32_t agents;    /* room in the arrays, in agents; a multiple of JOX_LANES */
    uint32_t stride;    /* entries per agent: the greatest `neighbours` of all agents */
    uint32_t *index;    /* index of the neighbour in this step */
    uint8_t *count;     /* per agent: number of neighbours */
    uint8_t *close;     /* per agent: of these, how many it may touch, at least */
    float *crowding2;   /* squared distance of neighbour JOX_CROWD_RANK, m2, where there is one */
    float widest;       /* greatest distance of a surface from its agent's centre, m */
    JoxMotion *motions; /* motion per agent, as perceived, on a belt with the belt's; valid until
                           they move */
    JoxTorsoShape *shapes;  /* torso per agent; likewise */
    bool has_torsos;        /* some agent is no disc */
    bool has_belts;         /* some escalator runs; then: */
    float *belt_x, *belt_y; /* per agent: velocity at which a belt carries it, m/s in plan; its own
                               velocity leaves it out */
    /* Contacts do not depend on perception. If the list above may lack an agent within touching
       range, the JOX_MOST_NEIGHBOURS that reach nearest to its centre, within that range, are
       stored here, from i * JOX_MOST_NEIGHBOURS on, nearest first; else touch_count[i] is
       JOX_TOUCH_AMONG_NEIGHBOURS. NULL: the list above suffices for all agents. */
    uint32_t *touch_index;
    uint8_t *touch_count;
} JoxNeighbours;

/* Makes room; the contents are lost if it grows. */
void jox_neighbours_reserve(JoxNeighbours *neighbours, uint32_t agents, uint32_t stride);
/* Makes room for the velocities of belts, for as many agents. */
void jox_neighbours_reserve_belts(JoxNeighbours *neighbours);
void jox_neighbours_free(JoxNeighbours *neighbours);

enum { JOX_TOUCH_AMONG_NEIGHBOURS = 255 };
/* m: greatest gap of two agents at which a contact is considered, however fast they approach; and
   the gap below which it always is. */
#define JOX_TOUCH_MOST 0.15f
#define JOX_TOUCH_LEAST 0.02f

/* Returns the distance of the centres within which an agent may touch another in a step, m. */
static inline float jox_touch_reach(const JoxNeighbours *n, float radius) {
    return radius + n->widest + JOX_TOUCH_LEAST + JOX_TOUCH_MOST;
}

/* Returns that distance for the widest agent, m. */
static inline float jox_touch_most(const JoxNeighbours *n) {
    return jox_touch_reach(n, n->widest);
}

/* Returns, per agent, how many of its nearest neighbours it may touch: `close`, unless an agent has
   become wider since it was computed. */
static inline const uint8_t *jox_touch_candidate_counts(const JoxNeighbours *n, float widest) {
    return widest > n->widest ? n->count : n->close;
}

static inline size_t jox_neighbour_at(const JoxNeighbours *n, uint32_t agent, uint32_t k) {
    return ((size_t)(agent / JOX_LANES) * n->stride + k) * JOX_LANES + agent % JOX_LANES;
}

#endif
