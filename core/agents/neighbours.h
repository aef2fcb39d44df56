/* Each agent's nearest neighbours of the present step, nearest first, ties by id. `nav` writes
   them; force and machine read them. Stored in blocks of JOX_LANES agents, so that one lane is one
   agent: entry k of agent i is at (i / LANES * stride + k) * LANES + i % LANES. Entries beyond an
   agent's count are of no meaning, but never beyond the agents that there have been. */
#ifndef JOX_AGENTS_NEIGHBOURS_H
#define JOX_AGENTS_NEIGHBOURS_H

#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"

enum {
    JOX_LANES = 16,
    JOX_MOST_NEIGHBOURS = 16,
    JOX_CROWD_RANK = 3 /* the neighbour whose distance tells how crowded it is */
};

/* Where an agent is, m, and how it moves, m/s: one load fetches it for those who look at many. */
typedef struct JoxMotion {
    float x, y, vx, vy;
} JoxMotion;

/* All zero is a valid, empty one. */
typedef struct JoxNeighbours {
    uint32_t agents;  /* how many agents the arrays hold room for, a multiple of JOX_LANES */
    uint32_t stride;  /* entries per agent: the greatest `neighbours` of all agents */
    uint32_t *index;  /* index of the neighbour in this step's order */
    uint8_t *count;   /* per agent */
    uint8_t *close;   /* of them, the nearest whom it may touch, and perhaps some more */
    float *crowding2; /* squared distance of neighbour JOX_CROWD_RANK, m2; of those who have one */
    float widest;     /* greatest radius of an agent, m */
    JoxMotion *motions; /* of all agents, as they were perceived, until they move */
    /* Contact does not depend on who is perceived. Where the list above may lack someone within
       touching range, the JOX_MOST_NEIGHBOURS nearest within that range stand here, from
       i * JOX_MOST_NEIGHBOURS on, nearest first; elsewhere touch_count is JOX_TOUCH_IS_SEEN. NULL:
       everywhere. */
    uint32_t *touch_index;
    uint8_t *touch_count;
} JoxNeighbours;

void jox_neighbours_reserve(JoxNeighbours *neighbours, uint32_t agents, uint32_t stride);
void jox_neighbours_free(JoxNeighbours *neighbours);

enum { JOX_TOUCH_IS_SEEN = 255 };
/* m: gap between people above which no contact is looked for, however fast they approach; and the
   gap below which it always is. */
#define JOX_TOUCH_MOST 0.15f
#define JOX_TOUCH_LEAST 0.02f

/* Distance of the centres within which an agent may touch somebody in a step, m. */
static inline float jox_touch_reach(const JoxNeighbours *n, float radius) {
    return radius + n->widest + JOX_TOUCH_LEAST + JOX_TOUCH_MOST;
}

/* The same of the widest agent. */
static inline float jox_touch_most(const JoxNeighbours *n) {
    return jox_touch_reach(n, n->widest);
}

/* How many of its neighbours, the nearest, an agent may touch: those counted in `close`, unless
   somebody has grown since. */
static inline const uint8_t *jox_close_counts(const JoxNeighbours *n, float widest) {
    return widest > n->widest ? n->count : n->close;
}

static inline size_t jox_neighbour_at(const JoxNeighbours *n, uint32_t agent, uint32_t k) {
    return ((size_t)(agent / JOX_LANES) * n->stride + k) * JOX_LANES + agent % JOX_LANES;
}

#endif
