/* Spots to stand on in a polygon: a staggered lattice, row by row from the polygon's front, clear
   of walls. Behaviours gather people on them (machine/steering/gather.c). */
#ifndef JOX_GEOM_LATTICE_H
#define JOX_GEOM_LATTICE_H

#include "geom/ground/standable.h"
#include "geom/place.h"

typedef struct JoxLattice {
    JoxV2 *at; /* m, row by row, in a row from right to left as one looks to the front */
    uint32_t count;
    uint32_t *row_first; /* by row, and behind the last */
    uint32_t row_count;
    size_t capacity, row_capacity;
} JoxLattice;

/* Lays spots `spacing` m apart in a polygon whose front lies in direction `ahead`, a unit vector:
   all of one part of the ground about it, `clear` m away from walls and fixed bodies. */
void jox_lattice_lay(JoxLattice *spots, const JoxPlace *place, const JoxStandable *ground,
                     uint32_t part, JoxV2 ahead, float spacing, float clear);
void jox_lattice_free(JoxLattice *spots);

#endif
