/* Part of jostle.h, which includes it: what a program does to a world that runs.
 *
 * All of these are called between two steps and take effect in the next one. In the world of a
 * scene (jo_scene_world) each is an entry of the input log, if one is written
 * (jo_scene_log_input): played back, the log leads to the same state. `jostle reference inputs`
 * lists the lines.
 *
 * False, or a null handle, with `error` filled (it may be NULL) where nothing was done: JO_INPUT
 * where there is no such agent, body, place, state or name, or where a number is not finite or out
 * of the range that is given here; JO_FAILED where memory is out. */
#ifndef JOSTLE_ACT_H
#define JOSTLE_ACT_H

#include "jostle.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- people ------------------------------------------------------------------------------ */

/* A new agent of a scene's group, at (x, y), m, within 10 km of the origin: with the group's
   behaviour, tags, team, and values drawn from its distributions. Shifted to a free spot, or
   refused, as by jo_world_add_agent. Not for groups that are bound for points opposite to where
   they begin. */
JO_API JoAgent jo_world_spawn(JoWorld *world, const char *group, double x, double y,
                              JoError *error);
/* Moves an agent to (x, y), m, or to the nearest free spot, at rest; refused where there is none,
   as by jo_world_add_agent. */
JO_API bool jo_agent_teleport(JoWorld *world, JoAgent agent, double x, double y, JoError *error);
/* Has an agent aim at a place of the scene: `goal` of its behaviour, and `own.goal` where there is
   such a value. */
JO_API bool jo_agent_set_goal(JoWorld *world, JoAgent agent, const char *place, JoError *error);
/* Puts an agent into a state of its behaviour, as if it had just entered it: its time begins, what
   it does on entering is done in the next step; a state in which people leave takes it out at once.
   A state that becomes another behaviour leads to that one's start. */
JO_API bool jo_agent_set_state(JoWorld *world, JoAgent agent, const char *state, JoError *error);
/* Sets a value of an agent's memory by its name; truth is 0 or 1. */
JO_API bool jo_agent_set_memory(JoWorld *world, JoAgent agent, const char *name, double value,
                                JoError *error);
/* Sets a parameter of one agent ("speed", "push", ...), in the unit and range that the reference of
   behaviours gives: with a behaviour its own value, which holds in all states that set none. */
JO_API bool jo_agent_set_parameter(JoWorld *world, JoAgent agent, const char *name, double value,
                                   JoError *error);
/* What these two set, and a scene or a behaviour: false, and *value as it was, where the agent is
   dead or has none of that name. */
JO_API bool jo_agent_memory(const JoWorld *world, JoAgent agent, const char *name, double *value);
JO_API bool jo_agent_parameter(const JoWorld *world, JoAgent agent, const char *name,
                               double *value);
/* ---- bodies ------------------------------------------------------------------------------ */

/* The body of a name in a scene, or null. */
JO_API JoBody jo_world_find_body(const JoWorld *world, const char *name);
JO_API bool jo_body_is_live(const JoWorld *world, JoBody body);
/* The body in a slot (JoBody.slot), as of an event or a ray; null where there is none. */
JO_API JoBody jo_world_body_at(const JoWorld *world, uint32_t slot);
/* Gives a body an impulse of up to 1e6 N s along each axis, at a point, m; NULL: at its centre of
   mass. It changes the velocity by at most 500 m/s. Not for static bodies. */
JO_API bool jo_body_impulse(JoWorld *world, JoBody body, const double impulse[3],
                            const double point[3], JoError *error);
/* Moves a body: its shape's own frame to a point, m, turned by a unit quaternion x, y, z, w (NULL:
   as it is), at rest. Static bodies too. Who carries it loses it. */
JO_API bool jo_body_place(JoWorld *world, JoBody body, const double at[3], const double turn[4],
                          JoError *error);
/* Sets the velocity of a body's centre of mass, m/s, and its spin, rad/s (NULL: none), each up to
   100 along an axis. Not for static bodies. A kinematic body keeps them until they are set anew,
   and no longer follows the path that its scene gave it. */
JO_API bool jo_body_set_velocity(JoWorld *world, JoBody body, const double velocity[3],
                                 const double spin[3], JoError *error);
/* Takes a body out. */
JO_API bool jo_body_remove(JoWorld *world, JoBody body, JoError *error);

/* ---- walls and signals ------------------------------------------------------------------- */

/* A new wall from 2 points (thin) or 4 (a solid quadrangle), x0, y0, x1, y1, ..., m. Several may
   have one name: together they open, close and go. It may have the name of a gate of the scene.
   Up to 4,096 of them. Before the next step agents whose centre lies in it, or nearer than 0.7
   radii to its edges, are moved to the nearest free spot within 25 m, out of the solid and through
   no other wall; the summary counts them as `moved_out`, and those without such a spot as
   `not_moved_out`. */
JO_API bool jo_world_add_wall(JoWorld *world, const char *name, const double *xy, size_t count,
                              JoError *error);
/* Takes out the walls of a name that jo_world_add_wall made. */
JO_API bool jo_world_remove_wall(JoWorld *world, const char *name, JoError *error);
/* Opens or closes the walls of a name. Agents in the way of a wall that closes are
   moved as for jo_world_add_wall. */
JO_API bool jo_world_open_wall(JoWorld *world, const char *name, bool open, JoError *error);
/* Calls a name out, which everybody hears in the next step, wherever they are. */
JO_API bool jo_world_signal(JoWorld *world, const char *name, JoError *error);

#ifdef __cplusplus
}
#endif
#endif
