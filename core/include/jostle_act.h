/* Part of jostle.h, which includes it: calls by which a program changes a running world.
 *
 * All of these are called between two steps and take effect in the next one. In the world of a
 * scene (jo_scene_world) each is an entry of the input log, if one is written (jo_scene_log_input):
 * played back, the log leads to the same state. `jostle reference inputs` lists the kinds of
 * entries.
 *
 * A call returns false, or a null handle, with `error` filled (it may be NULL), and changes
 * nothing: JO_INPUT if there is no such agent, body, place, state or name, or if a number is not
 * finite or out of the range given here; JO_FAILED if memory is out. */
#ifndef JOSTLE_ACT_H
#define JOSTLE_ACT_H

#include "jostle.h"
#include "jostle_read.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- people ------------------------------------------------------------------------------ */

/* Creates an agent of a scene's group at (x, y), m, within 10 km of the origin, with the group's
   behaviour, tags and team, and values drawn from its distributions. It is moved to a free spot,
   or refused, as by jo_world_add_agent. Not for groups whose goals are the points opposite to
   their starts. */
JO_API JoAgent jo_world_spawn(JoWorld *world, const char *group, double x, double y,
                              JoError *error);
/* Moves an agent to (x, y), m, or to the nearest free spot, at rest; refused if there is none,
   as by jo_world_add_agent. */
JO_API bool jo_agent_teleport(JoWorld *world, JoAgent agent, double x, double y, JoError *error);
/* The same at (x, y) in plan on a storey, counted from the lowest up (jo_world_storey_name);
   without _on it is the lowest. JO_INPUT if there is no such storey. */
JO_API JoAgent jo_world_spawn_on(JoWorld *world, const char *group, uint32_t storey, double x,
                                 double y, JoError *error);
JO_API bool jo_agent_teleport_on(JoWorld *world, JoAgent agent, uint32_t storey, double x, double y,
                                 JoError *error);
/* Makes a place of the scene the goal of an agent: `goal` of its behaviour, and `own.goal` if
   the behaviour has that value. */
JO_API bool jo_agent_set_goal(JoWorld *world, JoAgent agent, const char *place, JoError *error);
/* Puts an agent into a state of its behaviour, as if it had just entered it: the time in the
   state starts at 0, and the state's actions on entering run in the next step; a state in which
   people leave removes it at once. A state that switches to another behaviour leads to that
   one's start. */
JO_API bool jo_agent_set_state(JoWorld *world, JoAgent agent, const char *state, JoError *error);
/* Sets a value of an agent's memory by its name; truth is 0 or 1. */
JO_API bool jo_agent_set_memory(JoWorld *world, JoAgent agent, const char *name, double value,
                                JoError *error);
/* Sets a parameter of one agent ("speed", "push", ...), in the unit and range that the reference
   of behaviours gives. For an agent with a behaviour this is its own value, which holds in all
   states that do not set the parameter. */
JO_API bool jo_agent_set_parameter(JoWorld *world, JoAgent agent, const char *name, double value,
                                   JoError *error);
/* Read a value of an agent's memory, and one of its parameters. False, with *value unchanged, if
   the agent is dead or has no value of that name. */
JO_API bool jo_agent_memory(const JoWorld *world, JoAgent agent, const char *name, double *value);
JO_API bool jo_agent_parameter(const JoWorld *world, JoAgent agent, const char *name,
                               double *value);
/* ---- bodies ------------------------------------------------------------------------------ */

/* Body with a name in the scene, or the null handle. */
JO_API JoBody jo_world_find_body(const JoWorld *world, const char *name);
JO_API bool jo_body_is_live(const JoWorld *world, JoBody body);
/* Body in a slot (JoBody.slot), as events and rays give it; null if there is none. */
JO_API JoBody jo_world_body_at(const JoWorld *world, uint32_t slot);
/* Applies an impulse, N s, of up to 1e6 along each axis to a body, at a point, m (NULL: at its
   centre of mass). It changes the velocity by at most 500 m/s. Not for static bodies. */
JO_API bool jo_body_impulse(JoWorld *world, JoBody body, const double impulse[3],
                            const double point[3], JoError *error);
/* Moves a body, also a static one: puts the frame of its shape at a point, m, turned by a unit
   quaternion x, y, z, w (NULL: its turn is kept), at rest. An agent that carries it loses it. */
JO_API bool jo_body_place(JoWorld *world, JoBody body, const double at[3], const double turn[4],
                          JoError *error);
/* The same with a point whose x and y are in plan on a storey, counted from the lowest up, and
   whose z is above its floor. JO_INPUT if there is no such storey. */
JO_API bool jo_body_impulse_on(JoWorld *world, JoBody body, const double impulse[3],
                               uint32_t storey, const double point[3], JoError *error);
JO_API bool jo_body_place_on(JoWorld *world, JoBody body, uint32_t storey, const double at[3],
                             const double turn[4], JoError *error);
/* Sets the velocity of a body's centre of mass, m/s, and its spin, rad/s (NULL: none), each up to
   100 along an axis. Not for static bodies. A kinematic body keeps them until they are set anew,
   and no longer follows the path that its scene gave it. */
JO_API bool jo_body_set_velocity(JoWorld *world, JoBody body, const double velocity[3],
                                 const double spin[3], JoError *error);
/* Removes a body. */
JO_API bool jo_body_remove(JoWorld *world, JoBody body, JoError *error);

/* ---- walls and signals ------------------------------------------------------------------- */

/* Adds a wall of 2 points (thin) or 4 (a solid quadrangle), x0, y0, x1, y1, ..., m. Walls with
   the same name open, close and are removed together; the name may be that of a gate of the
   scene. Up to 4,096 walls. Before the next step agents whose centre lies in it, or nearer than
   0.7 radii to its edges, are moved to the nearest free spot within 25 m, out of the solid and
   through no other wall; the summary counts them as `moved_out`, and those without such a spot
   as `not_moved_out`. */
JO_API bool jo_world_add_wall(JoWorld *world, const char *name, const double *xy, size_t count,
                              JoError *error);
/* The same on a storey, counted from the lowest up. JO_INPUT if there is no such storey. */
JO_API bool jo_world_add_wall_on(JoWorld *world, const char *name, uint32_t storey,
                                 const double *xy, size_t count, JoError *error);
/* Removes the walls with a name that jo_world_add_wall made. */
JO_API bool jo_world_remove_wall(JoWorld *world, const char *name, JoError *error);
/* Opens or closes the walls with a name. Agents in the way of a wall that closes are moved as
   for jo_world_add_wall. */
JO_API bool jo_world_open_wall(JoWorld *world, const char *name, bool open, JoError *error);
/* Sets the mode of a lift; the name `all` means all lifts (jo_world_lift tells the modes). */
JO_API bool jo_world_set_lift_mode(JoWorld *world, const char *lift, JoLiftMode mode,
                                   JoError *error);
/* Sends a signal, which every agent hears in the next step, wherever it is. */
JO_API bool jo_world_signal(JoWorld *world, const char *name, JoError *error);

#ifdef __cplusplus
}
#endif
#endif
