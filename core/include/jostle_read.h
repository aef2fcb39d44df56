/* Part of jostle.h, which includes it: what a program reads of a world between two steps. Nothing
 * here changes what a run does. Agents are named by their ids, which are never used again
 * (jo_world_agent_of finds the handle of one), bodies by their slots (jo_world_body_at).
 */
#ifndef JOSTLE_READ_H
#define JOSTLE_READ_H

#include "jostle.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The living agent with an id, or null. */
JO_API JoAgent jo_world_agent_of(const JoWorld *world, uint32_t id);

/* ---- columns ----------------------------------------------------------------------------- */

typedef enum JoType { JO_U8, JO_U16, JO_U32, JO_I32, JO_U64, JO_F32, JO_F64 } JoType;
/* One number of every agent: that of agent i is at data + i * stride. */
typedef struct JoColumn {
    const void *data; /* NULL where there is no such column, or no agent */
    size_t stride;    /* bytes; 0 where one number is that of all */
    uint32_t count;   /* agents */
    JoType type;
} JoColumn;
/* A column by its name, in place and not copied: "id", "x", "y" (m), "vx", "vy" (m/s), "force_x",
   "force_y" (N), "compression" (N/m), "load" (N), "density" (1/m2), "face_x", "face_y", "pref_x",
   "pref_y" (m/s), "eager", "contacts", "group", "machine", "state", "team", "goal", "slot", "tags";
   and parameters: "radius", "mass", "speed" and so on, of which angles are held as cosines.

   The pointer holds until the next step and until the next call that changes the world. Agents
   change their places as they walk: the same index is somebody else after a step, and "id" says
   who. */
JO_API JoColumn jo_world_column(const JoWorld *world, const char *name);
/* Names of columns, the n-th from 0; NULL behind the last. */
JO_API const char *jo_column_name(uint32_t n);
/* What numbers in columns and events mean: the group, behaviour, state or signal of a number; ""
   where there is none. Valid until the next step. */
JO_API const char *jo_world_group_name(const JoWorld *world, uint32_t group);
JO_API const char *jo_world_machine_name(const JoWorld *world, uint32_t machine);
JO_API const char *jo_world_state_name(const JoWorld *world, uint32_t machine, uint32_t state);
JO_API const char *jo_world_signal_name(const JoWorld *world, uint32_t name);
JO_API const char *jo_world_place_name(const JoWorld *world, uint32_t place);
JO_API const char *jo_world_body_name(const JoWorld *world, uint32_t slot);

/* ---- events ------------------------------------------------------------------------------ */

/* An agent took a transition of its behaviour: the number of that, and of the states. */
typedef struct JoTransitionEvent {
    uint32_t agent, machine, from, to;
} JoTransitionEvent;
typedef enum JoTouched { JO_TOUCHED_AGENT, JO_TOUCHED_BODY, JO_TOUCHED_WALL } JoTouched;
/* An agent and another, a body or a wall press on each other at the end of the step. */
typedef struct JoTouchEvent {
    uint32_t agent;
    uint32_t kind;  /* JoTouched */
    uint32_t other; /* id, slot, or number of the wall's edge */
    uint32_t began; /* 1: they did not when events were read last */
    float force;    /* N */
} JoTouchEvent;
/* A fast body hit an agent. */
typedef struct JoHitEvent {
    uint32_t agent, body;
    float impulse; /* N s */
    float x, y, z; /* m */
} JoHitEvent;
/* Bonds of a body of blocks broke. */
typedef struct JoBreakEvent {
    uint32_t body;
    uint32_t bonds;  /* that broke */
    uint32_t pieces; /* that it came apart into; 1: it is still whole */
} JoBreakEvent;
/* An agent came in, or left: where it is, or was when events were read last, m. */
typedef struct JoPresenceEvent {
    uint32_t agent, group;
    float x, y;
} JoPresenceEvent;
/* An agent called out a signal, by its number. */
typedef struct JoSaidEvent {
    uint32_t agent, signal;
    float x, y; /* m */
} JoSaidEvent;
/* What an agent did: it kicked or threw a body, or took hold of another agent. */
typedef enum JoDone { JO_DONE_KICK, JO_DONE_GRASP } JoDone;
typedef struct JoActionEvent {
    uint32_t agent;
    uint32_t kind;  /* JoDone */
    uint32_t other; /* slot of the body; id of the agent */
    float x, y;     /* m: where it was done from */
} JoActionEvent;

/* What happened in the last step, in ascending ids of agents, then of what they met; `entered` and
   `left`: since events were read last. The arrays hold until the next call on the world. */
typedef struct JoEvents {
    const JoTransitionEvent *transitions;
    const JoTouchEvent *touches;
    const JoHitEvent *hits;
    const JoBreakEvent *breaks;
    const JoPresenceEvent *entered, *left;
    const JoSaidEvent *said;
    const JoActionEvent *actions;
    uint32_t transition_count, touch_count, hit_count, break_count, entered_count, left_count,
        said_count, action_count;
} JoEvents;
/* All zero where memory is out. Before the first step `entered` has all who are there. */
JO_API JoEvents jo_world_events(JoWorld *world);

/* ---- queries ----------------------------------------------------------------------------- */

/* Agents about a point, those with centres within `radius` m, the nearest first, ties by id.
   Writes up to `capacity` ids and distances (m; either may be NULL); returns how many there are.
   Every query looks at all agents: some 20 us for 10,000. */
JO_API uint32_t jo_world_neighbours(const JoWorld *world, double x, double y, double radius,
                                    uint32_t *ids, float *distances, uint32_t capacity);

enum { JO_CAST_AGENTS = 1, JO_CAST_BODIES = 2, JO_CAST_WALLS = 4, JO_CAST_ALL = 7 };
/* What a ray or disc met first. */
typedef struct JoCast {
    bool hit;
    JoTouched kind;
    uint32_t what; /* id, slot, or number of the wall's edge */
    double share;  /* of the way that is free, 0 to 1 */
    double x, y;   /* m: the centre there */
    double nx, ny; /* unit, from what was met to the centre */
} JoCast;
/* Moves a disc of `radius` m (0: a ray) from one point to another, in the plane, and says what it
   meets first of the kinds asked for: people's discs, the footprints of bodies between 0.05 m and
   1.75 m above the ground, walls that stand. Who overlaps it at the start is met at 0. */
JO_API JoCast jo_world_cast(const JoWorld *world, const double from[2], const double to[2],
                            double radius, uint32_t kinds);

/* The way that somebody who is 0.25 m in radius walks from (x, y) to a place of the scene, round
   walls that stand, not round people or bodies; where edges are joined, perhaps over one, with the
   next point at the other side: points x0, y0, x1, y1, ... about 0.25 m apart from
   (x, y) on. Writes up to `capacity` points (2 numbers each) and the length of the whole way, m
   (INFINITY: there is none). Returns how many points there are. The first question about a place
   after walls changed takes as long as the making of a distance field, milliseconds to seconds. */
JO_API uint32_t jo_world_path(JoWorld *world, double x, double y, const char *place, double *xy,
                              uint32_t capacity, double *length);

/* People per m2 at a point: each spread by the Gaussian exp(-d2 / R2) / (pi R2), R = 1 m, of
   Helbing, Johansson and Al-Abideen (2007); those behind walls that stand do not count. */
JO_API double jo_world_density(const JoWorld *world, double x, double y);

/* Edges of the walls that stand: writes up to `capacity` of them as x0, y0, x1, y1, m; returns how
   many there are. The n-th has not the number n: numbers of edges count those of open walls too. */
JO_API uint32_t jo_world_walls(const JoWorld *world, double *out, uint32_t capacity);
/* The footprint of a body between 0.05 and 1.75 m above the ground, as a ring of points x, y, m:
   writes up to `capacity` of them and returns how many there are; 0 where it has none. A round one
   has 24. */
JO_API uint32_t jo_body_outline(const JoWorld *world, JoBody body, double *xy, uint32_t capacity);

/* What people gave a body in the last step by pressing, hitting and kicking: the impulse, N s, and
   the angular impulse about its centre of mass, N m s (either may be NULL). A kinematic body
   does not move by it; of a static one zeros. False, and zeros, for a stale handle.

   So a program whose bodies move in a world of its own lets people push them: each has a like body
   here, which is put where it is before each step (jo_body_place, jo_body_set_velocity), and gives
   it what came of it. jostle_bullet.hpp does so for a btDynamicsWorld. */
JO_API bool jo_body_pushed(const JoWorld *world, JoBody body, double impulse[3], double turn[3]);

/* ---- snapshots --------------------------------------------------------------------------- */

/* All that the future of a world depends on, as bytes; free with jo_free. NULL with `error`: with
   bodies this can be had only of a scene that is loaded `resumable`, after each 128th step. What a
   scene records, logs and measures is no part of it. */
JO_API void *jo_world_snapshot(JoWorld *world, size_t *size, JoError *error);
/* Puts the world, or another one made in the same way, into that state: it goes on as that one did,
   to the bit. False with `error`, and nothing changed, where the bytes are of something else. */
JO_API bool jo_world_restore(JoWorld *world, const void *data, size_t size, JoError *error);

#ifdef __cplusplus
}
#endif
#endif
