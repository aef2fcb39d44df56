/* Routes over joined (periodic) edges. A distance field knows no joined edges: it is made over the
   bounds and as much again beyond each joined edge, with images of all walls and of the goal. */
#ifndef JOX_WORLD_JOINED_EDGES_H
#define JOX_WORLD_JOINED_EDGES_H

#include "agents/agents.h"
#include "geom/field/field.h"
#include "geom/place.h"
#include "geom/walls.h"

/* Returns whether routes lead over edges: some are joined, and there are walls. */
bool jox_routes_lead_over_edges(const JoxAgents *agents, const JoxWalls *walls);
/* Adds the images of walls a period beyond joined edges. */
void jox_routes_add_wall_images(const JoxAgents *agents, JoxWalls *walls);
/* Adds the images of the goal, places[0], or of its members, which are the other places: it becomes
   a set of them all. A place that lies across a joined edge, or beyond, has none there. */
void jox_routes_add_goal_images(const JoxAgents *agents, JoxPlace **places, uint32_t *count);
/* Adds the images of people who are held up. */
void jox_routes_add_crowd_images(const JoxAgents *agents, JoxFieldCrowd *crowd);
/* Sets a box along joined axes to the bounds and a period beyond them, less `spare` m: no way leads
   round the ends of images. */
void jox_routes_box_over_edges(const JoxAgents *agents, float spare, JoxV2 *low, JoxV2 *high);

#endif
