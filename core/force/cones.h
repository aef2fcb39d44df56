/* Agents in the cone of an agent, in which a force of it reaches others. Kernels of push/ find them
   by cone_lanes.h, and literal.c by people_in_cone.c. */
#ifndef JOX_FORCE_CONES_H
#define JOX_FORCE_CONES_H

#include "force/forces.h"

/* Angle and reach of the cones of a search. */
typedef struct JoxConeReach {
    JoxParameter angle; /* parameter that is the half-angle */
    float gap;          /* reach beyond the edges of both agents, m */
    bool moved;         /* agents have moved since their neighbours were listed */
} JoxConeReach;

/* The agents in the cone of each agent of a chunk. Bit k of `found` is set if entry k of the
   agent's neighbours is in the cone; of `doubtful`, if moreover a wall may stand between. */
typedef struct JoxFound {
    uint32_t found[JOX_FORCE_GRAIN], doubtful[JOX_FORCE_GRAIN];
} JoxFound;

/* Returns those of `doubtful` that a wall separates from agent i. */
uint32_t jox_find_walled_off(const JoxForces *forces, uint32_t i, uint32_t doubtful);
/* Returns those in the cone of agent i, entry `at` of its chunk, from which no wall separates it.
 */
static inline uint32_t jox_find_reached(const JoxForces *f, uint32_t i, const JoxFound *people,
                                        uint32_t at) {
    const uint32_t found = people->found[at], doubtful = people->doubtful[at];
    return doubtful ? found & ~jox_find_walled_off(f, i, doubtful) : found;
}
/* Returns `found` of agent i in literal mode: those in the cone about `axis`, at any distance. */
uint32_t jox_literal_people_in_cone(const JoxForces *forces, uint32_t i, JoxV2 axis);

/* Returns how many agents were found. */
static inline uint32_t jox_count_found(uint32_t found) {
    uint32_t n = 0;
    for (; found; found &= found - 1)
        n++;
    return n;
}
/* Removes the nearest of those that agent i found; returns its index. */
static inline uint32_t jox_take_found(const JoxForces *f, uint32_t i, uint32_t *found) {
    const JoxNeighbours *near = f->step.neighbours;
    const uint32_t k = (uint32_t)__builtin_ctz(*found);
    *found &= *found - 1;
    return near->index[jox_neighbour_at(near, i, k)];
}

#endif
