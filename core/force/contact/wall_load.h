/* Loads of walls: edges are cut into pieces, and the forces of contacts are summed by piece. */
#ifndef JOX_FORCE_CONTACT_WALL_LOAD_H
#define JOX_FORCE_CONTACT_WALL_LOAD_H

#include "force/forces.h"

/* Zero-initialise; it owns its arrays, not the walls. */
typedef struct JoxWallLoads {
    const JoxWalls *walls;
    const JoxWallImages *images; /* images of the walls beyond joined edges; NULL: none */
    JoxWallLoad *items;          /* pieces of all edges */
    uint32_t *first_piece;       /* per edge, plus one */
    uint32_t count;
    size_t capacity, first_piece_capacity;
} JoxWallLoads;

/* Measures the loads of all walls from the impulses of the contacts. */
void jox_wall_loads_measure(JoxForces *forces);
void jox_wall_loads_free(JoxWallLoads *loads);

#endif
