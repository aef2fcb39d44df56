/* Points of the plane and points on storeys, for public calls (storey_calls.c). */
#ifndef JOX_WORLD_EMBED_STOREY_POINTS_H
#define JOX_WORLD_EMBED_STOREY_POINTS_H

#include "world/world.h"

/* Returns where a position is in plan. */
JoWhere jox_world_where(const JoWorld *world, JoxV2 at);
/* Returns whether a world has a storey; without storeys it has the storey 0. */
bool jox_world_has_storey(const JoWorld *world, uint32_t storey);
/* The same; false with `error`. */
bool jox_world_check_storey(const JoWorld *world, uint32_t storey, JoError *error);
/* Returns y of the position of a point in plan on a storey, m. */
double jox_world_move_to_storey(const JoWorld *world, uint32_t storey, double y);

#endif
