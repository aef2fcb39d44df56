/* Ways round walls: the walking distance to a place on a grid, and the direction of the shortest
   way from everywhere. Immutable once made; sampled by many threads. */
#ifndef JOX_GEOM_FIELD_H
#define JOX_GEOM_FIELD_H

#include "geom/place.h"
#include "geom/walls.h"

typedef struct JoxField JoxField;

/* The field to a place of any kind (a set: to its nearest member; a queue: its head) over the box
   low..high, by the fast marching method (Sethian 1996), first order. People keep `clearance` m off
   walls, and walk more slowly within 0.5 m of them, so that ways keep clear where there is room.
   `cell` is in metres, and grows so that at most 4,000,000 cells are made. Never NULL. */
JoxField *jox_field_create(const JoxWalls *walls, const JoxPlace *places, uint32_t place, JoxV2 low,
                           JoxV2 high, float cell, float clearance);
/* Distance that is walked from a point, m, a little more where it passes walls closely; INFINITY
   where no way leads. Outside the box: that of the box's nearest point and the way there. */
float jox_field_distance(const JoxField *field, JoxV2 point);
/* Unit vector of the shortest way, even between cells; away from the wall for a point closer to it
   than the clearance; (0, 0) where no way leads. */
JoxV2 jox_field_direction(const JoxField *field, JoxV2 point);
void jox_field_free(JoxField *field);

#endif
