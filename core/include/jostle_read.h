/* Part of jostle.h, which includes it: calls by which a program reads a world between two steps.
 * They never change a run. Agents are given by their ids, which are never reused
 * (jo_world_agent_of finds the handle for an id), bodies by their slots (jo_world_body_at). */
#ifndef JOSTLE_READ_H
#define JOSTLE_READ_H

#include "jostle.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Handle of the live agent with an id, or null. */
JO_API JoAgent jo_world_agent_of(const JoWorld *world, uint32_t id);

/* ---- columns ----------------------------------------------------------------------------- */

typedef enum JoType { JO_U8, JO_U16, JO_U32, JO_I32, JO_U64, JO_F32, JO_F64 } JoType;
/* One number per agent: that of agent i is at data + i * stride. */
typedef struct JoColumn {
    const void *data; /* NULL if there is no such column, or no agent */
    size_t stride;    /* bytes; 0 if all agents share one number */
    uint32_t count;   /* agents */
    JoType type;
} JoColumn;
/* Finds a column by its name; its data is read in place, not copied.
   "id", "slot": as in JoAgentState and JoAgent
   "x", "y": position, m, with storeys a point of the plane (jo_world_wheres has plan and storey);
   "vx", "vy": velocity, m/s; "face_x", "face_y": unit vector of its look
   "chest_x", "chest_y": unit vector to which its chest points; "spin": how fast that turns
   anticlockwise, rad/s
   "axis_x", "axis_y", "contact_radius": its torso in the last step: all within contact_radius of
   the segment between its centre plus and minus the axis, m; (0, 0) of a disc. 0 before its first
   step
   "pref_x", "pref_y":
   velocity that it wants, m/s; "eager": eagerness of the walking law, 0 to 1 "force_x", "force_y",
   N, "compression", N/m, "load", N: as in JoAgentState "density": people per m2 about it;
   "contacts": number of agents and bodies that it touches "group", "machine" (its behaviour),
   "state": numbers, with names by the functions below "goal": number of a place, -1 for none;
   "team": 0 for none; "tags": a bit for each tag and each parameter ("radius", "mass", "speed",
   ...), where an angle is stored as its cosine.

   The pointer is valid until the next step and until the next call that changes the world. The
   order of agents changes from step to step: the same index may be another agent, which "id"
   identifies. */
JO_API JoColumn jo_world_column(const JoWorld *world, const char *name);
/* Name of the n-th column, from 0; NULL after the last. */
JO_API const char *jo_column_name(uint32_t n);
/* Names for the numbers in columns and events: of a group, behaviour ("machine"), state, signal,
   place or body; "" if there is none. Valid until the next step. */
JO_API const char *jo_world_group_name(const JoWorld *world, uint32_t group);
JO_API const char *jo_world_machine_name(const JoWorld *world, uint32_t machine);
JO_API const char *jo_world_state_name(const JoWorld *world, uint32_t machine, uint32_t state);
JO_API const char *jo_world_signal_name(const JoWorld *world, uint32_t name);
JO_API const char *jo_world_place_name(const JoWorld *world, uint32_t place);
JO_API const char *jo_world_body_name(const JoWorld *world, uint32_t slot);

/* ---- events ------------------------------------------------------------------------------ */

/* An agent took a transition of its behaviour. */
typedef struct JoTransitionEvent {
    uint32_t agent;    /* id, as in all events */
    uint32_t machine;  /* number of the behaviour (jo_world_machine_name) */
    uint32_t from, to; /* numbers of the states (jo_world_state_name) */
} JoTransitionEvent;
/* Kind of thing that an agent touches, or that a cast hits. */
typedef enum JoTouched { JO_TOUCHED_AGENT, JO_TOUCHED_BODY, JO_TOUCHED_WALL } JoTouched;
/* An agent and another, a body or a wall press on each other at the end of the step. */
typedef struct JoTouchEvent {
    uint32_t agent;
    uint32_t kind;  /* JoTouched */
    uint32_t other; /* the agent's id, the body's slot, or the number of the wall's edge */
    uint32_t began; /* 1: they did not touch when events were last read */
    float force;    /* magnitude, N */
} JoTouchEvent;
/* A fast body hit an agent. */
typedef struct JoHitEvent {
    uint32_t agent, body; /* id; slot */
    float impulse;        /* magnitude, N s */
    float x, y, z;        /* point of the hit, m */
} JoHitEvent;
/* Bonds of a body of blocks broke. */
typedef struct JoBreakEvent {
    uint32_t body;   /* slot */
    uint32_t bonds;  /* bonds that broke */
    uint32_t pieces; /* pieces that the body came apart into; 1: it is still whole */
} JoBreakEvent;
/* An agent entered or left the world. */
typedef struct JoPresenceEvent {
    uint32_t agent, group; /* id; number of the group (jo_world_group_name) */
    float x, y; /* m: of one that entered, its present position; of one that left, its position when
                   events were last read */
} JoPresenceEvent;
/* An agent sent a signal. */
typedef struct JoSaidEvent {
    uint32_t agent, signal; /* id; number of the signal (jo_world_signal_name) */
    float x, y;             /* position of the agent, m */
} JoSaidEvent;
/* Kind of an agent's action: it kicked or threw a body, or took hold of another agent; it fell, or
   got up again. */
typedef enum JoDone { JO_DONE_KICK, JO_DONE_GRASP, JO_DONE_FALL, JO_DONE_RISE } JoDone;
/* An agent acted on a body or on another agent, or fell or got up. */
typedef struct JoActionEvent {
    uint32_t agent;
    uint32_t kind;  /* JoDone */
    uint32_t other; /* slot of the body; id of the agent; 0 of a fall or of getting up */
    float x, y;     /* m: present position of the agent */
} JoActionEvent;

/* Events of the last step, in ascending order of agent id, then of the other's id. `entered` and
   `left`, and of `actions` all but kicks, cover the time since events were last read, and compare
   its ends: of one who fell and got up between them nothing is told. The arrays are valid until the
   next call on the world. */
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
/* Events of the last step; all zero if memory is out. Before the first step `entered` lists all
   agents present. */
JO_API JoEvents jo_world_events(JoWorld *world);

/* ---- queries ----------------------------------------------------------------------------- */

/* Finds the agents with centres within `radius`, m, of a point, the nearest first, ties by id.
   Writes up to `capacity` ids and distances (m; either may be NULL); returns how many agents
   there are. Every query visits all agents: some 20 us for 10,000. */
JO_API uint32_t jo_world_neighbours(const JoWorld *world, double x, double y, double radius,
                                    uint32_t *ids, float *distances, uint32_t capacity);

/* Kinds of things that a cast may hit, to be added up. */
enum { JO_CAST_AGENTS = 1, JO_CAST_BODIES = 2, JO_CAST_WALLS = 4, JO_CAST_ALL = 7 };
/* First thing that a ray or a moving disc meets. */
typedef struct JoCast {
    bool hit;
    JoTouched kind;
    uint32_t what; /* the agent's id, the body's slot, or the number of the wall's edge */
    double share;  /* part of the way that is free before the hit, 0 to 1; 1 without a hit */
    double x, y;   /* m: centre of the disc at the hit */
    double nx, ny; /* unit normal, from the thing that was hit to the centre */
} JoCast;
/* Casts a disc of `radius`, m (0: a ray), from one point to another in the plane and returns the
   first hit among the kinds asked for: the discs for which people keep room, not their
   torsos; the footprints of bodies between 0.05 m and 1.75 m above the ground; standing walls.
   Anything that overlaps the disc at the start is hit at share 0. */
JO_API JoCast jo_world_cast(const JoWorld *world, const double from[2], const double to[2],
                            double radius, uint32_t kinds);

/* Finds the way that a person of radius 0.25 m walks from (x, y) to a place of the scene, round
   standing walls, but not round people or bodies. If the scene joins edges, the way may cross
   one, and its next point lies at the other edge. Points x0, y0, x1, y1, ... are about 0.25 m
   apart from (x, y) on. Writes up to `capacity` points (2 numbers each) and the length of the
   whole way, m (INFINITY: there is none). Returns how many points there are. The first query for
   a place after walls changed computes a distance field, which takes milliseconds to seconds. */
JO_API uint32_t jo_world_path(JoWorld *world, double x, double y, const char *place, double *xy,
                              uint32_t capacity, double *length);

/* Density of people at a point, 1/m2: each is spread by the Gaussian exp(-d2 / R2) / (pi R2), R
   = 1 m, of Helbing, Johansson and Al-Abideen (2007); people behind standing walls do not count. */
JO_API double jo_world_density(const JoWorld *world, double x, double y);

/* Lists the edges of standing walls: writes up to `capacity` of them as x0, y0, x1, y1, m;
   returns how many there are. The position in this list is not the edge number of events and
   casts, which counts the edges of open walls too. */
JO_API uint32_t jo_world_walls(const JoWorld *world, double *out, uint32_t capacity);
/* Footprint of a body between 0.05 and 1.75 m above the ground, as a ring of points x, y, m:
   writes up to `capacity` of them and returns how many there are; 0 if it has none. A round one
   has 24. */
JO_API uint32_t jo_body_outline(const JoWorld *world, JoBody body, double *xy, uint32_t capacity);

/* Reads what people did to a body in the last step by pressing, hitting and kicking: the total
   impulse, N s, and the angular impulse about its centre of mass, N m s (either may be NULL). A
   kinematic body does not move by it; for a static one both are zero. False, and zeros, for a stale
   handle.

   This lets people push bodies of another physics world: the program gives each a counterpart
   here, moves that to the body's pose before each step (jo_body_place, jo_body_set_velocity),
   and applies the impulse read here to the body after the step. jostle_bullet.hpp does so for a
   btDynamicsWorld. */
JO_API bool jo_body_pushed(const JoWorld *world, JoBody body, double impulse[3], double turn[3]);

/* ---- storeys -----------------------------------------------------------------------------

   People read and write points as x, y in plan, with a storey beside them. The engine keeps storeys
   apart in one plane, in which each storey, and each stair between storeys, is moved along y. So in
   a world with storeys, columns "x" and "y", events, walls, casts and ways of this header give
   points of that plane, which jo_world_where turns into plan and storey; calls that take a point
   mean the lowest storey, and those that end in _on the storey that they are given. The states of
   agents and bodies are in plan. Without storeys all of these are the same, and the storey is 0.
   Storeys are counted from the lowest up. */

JO_API uint32_t jo_world_storey_count(const JoWorld *world); /* 0: the world has none */
/* Name of a storey, "" if there is no such; height of its floor, m, NAN likewise. The name is valid
   as long as the world. */
JO_API const char *jo_world_storey_name(const JoWorld *world, uint32_t storey);
JO_API double jo_world_storey_height(const JoWorld *world, uint32_t storey);
/* Index of a storey by its name; JO_NO_STOREY if there is no such. */
#define JO_NO_STOREY UINT32_MAX
JO_API uint32_t jo_world_find_storey(const JoWorld *world, const char *name);
/* A stair, ramp or escalator. */
typedef struct JoStairState {
    const char *name;      /* "" if there is no such stair; valid as long as the world */
    uint32_t lower, upper; /* storeys; the same of steps on one storey */
    double width, length;  /* m; length in plan, from foot to head */
    double rise;           /* m */
    double belt;           /* m/s along the slope, positive upwards: of an escalator, else 0 */
    bool closed;           /* nobody sets out over it */
} JoStairState;
JO_API uint32_t jo_world_stair_count(const JoWorld *world);
JO_API JoStairState jo_world_stair(const JoWorld *world, uint32_t stair);
/* The use of a lift. */
typedef enum JoLiftMode {
    JO_LIFT_IN_USE,     /* serves calls in the direction of travel */
    JO_LIFT_OUT_OF_USE, /* lets riders out at the next storey, and stands */
    JO_LIFT_FIREMEN     /* fetches people storey by storey, and takes them to its home storey */
} JoLiftMode;
/* A lift and its car. */
typedef struct JoLiftState {
    const char *name; /* "" if there is no such lift; valid as long as the world */
    JoLiftMode mode;
    uint32_t capacity; /* people */
    uint32_t people;   /* in the car */
    uint32_t waiting;  /* people who have called it and wait before a door */
    uint32_t storey;   /* where the car stands, or which it left: the storey of its riders */
    bool moves;        /* the car is on its way */
    double height;     /* m: elevation of the car's floor */
    double open;       /* share of the door's width that is open, 0 to 1 */
} JoLiftState;
JO_API uint32_t jo_world_lift_count(const JoWorld *world);
JO_API JoLiftState jo_world_lift(const JoWorld *world, uint32_t lift);

/* How an agent uses a lift. */
typedef enum JoRide {
    JO_RIDE_NONE,
    JO_RIDE_APPROACHES, /* it is on its way to the door */
    JO_RIDE_WAITS,      /* before the door: it has called the lift */
    JO_RIDE_RIDES       /* in the car */
} JoRide;
#define JO_NO_STAIR 4294967295u
#define JO_NO_LIFT 4294967295u
/* A point in plan; of an agent also the lift that it uses. */
typedef struct JoWhere {
    double x, y;     /* m, in plan */
    double height;   /* m: elevation of the floor there; of an agent in a lift, of its car */
    uint32_t storey; /* on a stair: the storey that is nearer in height */
    uint32_t stair;  /* JO_NO_STAIR: on a storey */
    uint32_t lift;   /* JO_NO_LIFT: none */
    JoRide ride;
    double since; /* s of simulated time: when it called the lift, or came into the car; else NAN */
} JoWhere;
/* Where a point of the plane is in plan; where an agent is (all 0 for a stale handle). */
JO_API JoWhere jo_world_where(const JoWorld *world, double x, double y);
JO_API JoWhere jo_agent_where(const JoWorld *world, JoAgent agent);
/* Where all agents are, in the order of the columns: writes up to `capacity`; returns how many
   agents there are. */
JO_API uint32_t jo_world_wheres(const JoWorld *world, JoWhere *out, uint32_t capacity);
/* The queries above, of a point in plan on a storey. Neighbours, and people who count for a
   density, may be beyond the foot or head of a stair; a cast meets them there, too, but walls and
   bodies on its own storey alone. Points of a way are in plan, on the storeys and stairs that it
   leads over; a cast's x and y are in plan. */
JO_API uint32_t jo_world_neighbours_on(const JoWorld *world, uint32_t storey, double x, double y,
                                       double radius, uint32_t *ids, float *distances,
                                       uint32_t capacity);
JO_API double jo_world_density_on(const JoWorld *world, uint32_t storey, double x, double y);
JO_API JoCast jo_world_cast_on(const JoWorld *world, uint32_t storey, const double from[2],
                               const double to[2], double radius, uint32_t kinds);
JO_API uint32_t jo_world_path_on(JoWorld *world, uint32_t storey, double x, double y,
                                 const char *place, JoWhere *out, uint32_t capacity,
                                 double *length);

/* ---- snapshots --------------------------------------------------------------------------- */

/* Saves the complete state of a world as bytes; free with jo_free. NULL with `error`: a world
   with bodies can be saved only if its scene is loaded `resumable`, and only after each 128th
   step. Recordings, logs and measurements of a scene are not part of it. */
JO_API void *jo_world_snapshot(JoWorld *world, size_t *size, JoError *error);
/* Restores a saved state into the same world, or another one made in the same way: it then goes
   on as the saved one did, bit for bit. False with `error`, and nothing changed, if the bytes
   are of something else. */
JO_API bool jo_world_restore(JoWorld *world, const void *data, size_t size, JoError *error);

#ifdef __cplusplus
}
#endif
#endif
