/* Spots to stand on in a polygon: a staggered lattice, row by row from the polygon's front, clear
   of walls. Agents that gather stand on them (machine/steering/gather.c). */
#ifndef JOX_GEOM_LATTICE_H
#define JOX_GEOM_LATTICE_H

#include "geom/ground/standable.h"
#include "geom/place.h"

typedef struct JoxLattice {
    JoxV2 *at; /* m; by row, in a row from right to left as seen towards the front */
    uint32_t count;
    uint32_t *row_first; /* row_count + 1 indices into `at` */
    uint32_t row_count;
    size_t capacity, row_capacity;
} JoxLattice;

/* Fills a polygon whose front is in direction `ahead`, a unit vector, with spots `spacing` m apart:
   all that lie in one part of the ground and at least `clear` m from walls and fixed bodies. */
void jox_lattice_lay(JoxLattice *spots, const JoxPlace *place, const JoxStandable *ground,
                     uint32_t part, JoxV2 ahead, float spacing, float clear);
void jox_lattice_free(JoxLattice *spots);

#endif
