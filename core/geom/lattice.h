/* Spots to stand on in a polygon: a staggered lattice, row by row from the polygon's front, clear
   of walls. Behaviours gather people on them (machine/gather.c). */
#ifndef JOX_GEOM_LATTICE_H
#define JOX_GEOM_LATTICE_H

#include "geom/place.h"
#include "geom/walls.h"

typedef struct JoxLattice {
    JoxV2 *at; /* m, row by row, in a row from right to left as one looks to the front */
    uint32_t count;
    uint32_t *row_first; /* by row, and behind the last */
    uint32_t row_count;
    size_t capacity, row_capacity;
    /* Scratch of jox_lattice_lay. */
    JoxV2 *edges; /* of walls about the polygon, two points each */
    uint32_t *part, *open;
    size_t edge_capacity, part_capacity, open_capacity;
} JoxLattice;

/* Lays spots `spacing` m apart in a polygon whose front lies in direction `ahead`, a unit vector.
   All spots are `clear` m away from walls and can be reached from each other: where walls divide
   the polygon, those of the largest part. Walls that are open do not count. */
void jox_lattice_lay(JoxLattice *spots, const JoxPlace *place, const JoxWalls *walls, JoxV2 ahead,
                     float spacing, float clear);
void jox_lattice_free(JoxLattice *spots);

#endif
