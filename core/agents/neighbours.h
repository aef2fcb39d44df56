/* Each agent's nearest neighbours of the present step, nearest first, ties by id. `nav` writes
   them; force and machine read them. Stored in blocks of JOX_LANES agents, so that one lane is one
   agent: entry k of agent i is at (i / LANES * stride + k) * LANES + i % LANES. */
#ifndef JOX_AGENTS_NEIGHBOURS_H
#define JOX_AGENTS_NEIGHBOURS_H

#include <stddef.h>
#include <stdint.h>

enum { JOX_LANES = 16, JOX_MOST_NEIGHBOURS = 16 };

typedef struct JoxNeighbours {
    uint32_t agents;  /* how many agents the arrays hold room for, a multiple of JOX_LANES */
    uint32_t stride;  /* entries per agent: the greatest `neighbours` of all agents */
    uint32_t *index;  /* index of the neighbour in this step's order */
    float *distance2; /* squared distance of the centres, m2 */
    uint8_t *count;   /* per agent */
} JoxNeighbours;

static inline size_t jox_neighbour_at(const JoxNeighbours *n, uint32_t agent, uint32_t k) {
    return ((size_t)(agent / JOX_LANES) * n->stride + k) * JOX_LANES + agent % JOX_LANES;
}

#endif
