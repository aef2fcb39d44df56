/* The agents' columns (structure of arrays). The index of an agent is its position in memory, which
   follows its position in space: agents are sorted anew every few steps, so an index is valid
   within a step only. An `id` is valid for ever. All rooms above read the columns as plain arrays;
   parameters and own values, which are mostly equal for all agents, are read by functions. */
#ifndef JOX_AGENTS_AGENTS_H
#define JOX_AGENTS_AGENTS_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "agents/parameters.h"
#include "base/sections.h"
#include "base/vec.h"

#define JOX_NO_INDEX UINT32_MAX

enum { JOX_AGENTS_PADDING = 16 }; /* whole packets may be read past the last agent */

/* The terms of the net force, equation 10, N. Each row makes two columns, NAME_x and NAME_y, and a
   part of the force that is shown for an inspected agent; its role says how it moves the agent.
   ROW(X, keep, role, name, label): keep is STATE, carried from step to step, or SCRATCH, zero at
   the beginning of every step; role is one of JoxForceRole. The net force is summed in the order of
   the rows. To add a term, add a row here, a stage in force/ that fills its columns, and the call
   of that stage in the step. */
#define JOX_FORCE_TERMS(ROW, X)                                                                    \
    ROW(X, STATE, FREE, ext, "external")          /* given by callers and events for one step */   \
    ROW(X, STATE, BRACED, inferred, "resistance") /* filtered, eq. 8 and 9 */                      \
    ROW(X, SCRATCH, BRACED, push, "push")         /* pushes received, eq. 5 */                     \
    ROW(X, SCRATCH, CONTACT, contact, "contact")  /* with agents, walls and bodies, eq. 6, 7 */    \
    ROW(X, SCRATCH, GROUND, feet, "feet")         /* hold an agent that stands, sideways */
#define JOX_FORCE_TERM_COLUMNS(X, keep, role, name, label)                                         \
    X(keep, float, name##_x) X(keep, float, name##_y)

/* How a force term moves an agent. Flags, so that a sum over terms can take several. */
typedef enum JoxForceRole {
    JOX_FORCE_FREE = 1,    /* accelerates the agent whole */
    JOX_FORCE_BRACED = 2,  /* feet that brace hold up to `brace` newtons of the sum of these */
    JOX_FORCE_CONTACT = 4, /* the result of the contact solve; may raise the speed limit */
    JOX_FORCE_GROUND = 8,  /* found by the contact solve as well, but touches nobody */
    JOX_FORCE_ALL = 15
} JoxForceRole;

/* X(keep, type, name): meaning. Units: m, m/s, N, s. STATE: carried from step to step, so it is
   hashed and saved. RARE: state that is 0 in most worlds, and hashed where it is not. SCRATCH:
   written by every step before it is read; between steps it holds values of the last step, which a
   restored world lacks until the next, and sorting drops them. HINT: scratch that tells where to
   begin and changes no result; sorting keeps it with its agent. INDEX: derived from state, kept up
   by the functions below. */
#define JOX_AGENT_COLUMNS(X)                                                                       \
    X(STATE, uint32_t, id)      /* counts up from 0, never reused */                               \
    X(STATE, uint32_t, slot)    /* row of the handle table */                                      \
    X(INDEX, uint32_t, rank)    /* number of living agents with smaller ids */                     \
    X(STATE, uint16_t, group)   /* index of the scene's group */                                   \
    X(STATE, uint16_t, machine) /* index of the machine; JOX_NO_MACHINE: none */                   \
    X(STATE, uint16_t, state)   /* index of the state in the machine */                            \
    X(STATE, uint16_t, team)    /* 0: none; agents of other teams are opponents */                 \
    X(STATE, uint64_t, given) /* bit per own slot (the first 64) set by the scene or a function */ \
    X(STATE, uint64_t, tags)  /* bit per tag of the world */                                       \
    X(STATE, float, x)                                                                             \
    X(STATE, float, y)                                                                             \
    X(STATE, float, vx)                                                                            \
    X(STATE, float, vy)                                                                            \
    X(STATE, float, prev_x) /* position before the last move */                                    \
    X(STATE, float, prev_y)                                                                        \
    X(STATE, float, face_x) /* unit vector in which the agent looks */                             \
    X(STATE, float, face_y)                                                                        \
    X(STATE, float, chest_x) /* unit vector to which the chest points */                           \
    X(STATE, float, chest_y)                                                                       \
    X(STATE, float, spin)   /* angular velocity of the torso, rad/s */                             \
    X(STATE, float, pref_x) /* preferred velocity, written by `prefer` */                          \
    X(STATE, float, pref_y)                                                                        \
    X(STATE, float, eager)    /* eagerness, 0 to 1, raised by the crowd */                         \
    X(STATE, float, course_x) /* course: recent direction of walking, unit or (0, 0) */            \
    X(STATE, float, course_y)                                                                      \
    X(STATE, uint32_t, bound)   /* reference to the place it heads for by a field; 0: none */      \
    X(SCRATCH, float, way_left) /* length of the way to that place, m */                           \
    X(SCRATCH, float, aim_x)    /* direction of the preferred velocity, unit or (0, 0) */          \
    X(SCRATCH, float, aim_y)                                                                       \
    X(SCRATCH, float, walk_x) /* velocity chosen by the walking law */                             \
    X(SCRATCH, float, walk_y)                                                                      \
    X(STATE, float, next_x) /* planned velocity, by `solve`; kept between plans */                 \
    X(STATE, float, next_y)                                                                        \
    JOX_FORCE_TERMS(JOX_FORCE_TERM_COLUMNS, X)                                                     \
    X(STATE, float, force_x) /* net force of this step, equation 10, N */                          \
    X(STATE, float, force_y)                                                                       \
    X(STATE, float, compression) /* sum of |f.n| of contacts over circumference, N/m */            \
    /* greatest push from any one direction, N: the most, over directions d, of sum max(f.d, 0) */ \
    X(STATE, float, load)                                                                          \
    X(SCRATCH, float, last_ext_x) /* external force of the last substep, N */                      \
    X(SCRATCH, float, last_ext_y)                                                                  \
    X(SCRATCH, uint32_t, index_drop) /* index when velocities were chosen, minus present index */  \
    X(SCRATCH, float, forced_x)      /* velocity that the forces yield by the end of the step */   \
    X(SCRATCH, float, forced_y)                                                                    \
    X(SCRATCH, float, borne_x) /* change of velocity by contacts that plans press on, m/s */       \
    X(SCRATCH, float, borne_y)                                                                     \
    X(SCRATCH, float, parted_x) /* m/s within the step alone, by contacts that overlap */          \
    X(SCRATCH, float, parted_y)                                                                    \
    X(SCRATCH, float, parted_spin) /* rad/s, likewise */                                           \
    X(SCRATCH, float, axis_x) /* from the centre of the torso to its left end, m; 0: a disc */     \
    X(SCRATCH, float, axis_y)                                                                      \
    X(SCRATCH, float, contact_radius) /* distance of the surface from the axis, m */               \
    X(SCRATCH, float, half_plane_x)   /* force half-plane: unit normal; (0, 0): none */            \
    X(SCRATCH, float, half_plane_y)                                                                \
    X(SCRATCH, float, half_plane_offset) /* (v . normal) >= offset, m/s */                         \
    X(SCRATCH, float, speed_limit)       /* greatest speed in this step, m/s */                    \
    X(SCRATCH, float, density)      /* 1/m2, from the distance of the farthest neighbour kept */   \
    X(HINT, float, search_radius)   /* m, held the neighbours last time; 0: unknown */             \
    X(HINT, uint32_t, cell)         /* cell of navigation's grid when agents were sorted */        \
    X(SCRATCH, uint8_t, failed)     /* 1 if the linear program was infeasible */                   \
    X(SCRATCH, uint8_t, plan_notes) /* JoxPlanNote: what else acted on the plan of this step */    \
    X(STATE, uint8_t, contacts)     /* agents and bodies touched this step */                      \
    X(STATE, uint8_t, removed)      /* 1: leaves the world at the end of the step */               \
    X(STATE, uint32_t, entered)     /* tick at which the state was entered */                      \
    X(STATE, float, lasts)          /* drawn duration of the state, s; INFINITY if none */         \
    X(STATE, uint32_t, was_true)    /* bit per transition: its condition held in the last step */  \
    X(STATE, int32_t, goal)         /* index of the place aimed at, or -1 */                       \
    X(STATE, float, still)          /* time since it last moved 0.25 m, s */                       \
    X(STATE, float, still_x)        /* position when it last had moved so far */                   \
    X(STATE, float, still_y)                                                                       \
    X(STATE, float, displaced_x) /* from where it stood before others moved it, m */               \
    X(STATE, float, displaced_y)                                                                   \
    X(STATE, float, settled) /* time since it was last moved away from there, s */                 \
    X(RARE, float, fallen)   /* time since it fell, s; 0: it stands */                             \
    X(RARE, float, lean_x)   /* where feet would have to be against forces, m from it */           \
    X(RARE, float, lean_y)                                                                         \
    X(STATE, uint32_t, queue_at)   /* reference to the place whose queue it stands in */           \
    X(STATE, uint32_t, queued)     /* tick at which it took its place there; JOX_NO_TURN */        \
    X(RARE, uint32_t, arrived_at)  /* reference to the place where it arrived in a crowd */        \
    X(RARE, float, kept_off)       /* time for which a crowd has kept it off a place, s */         \
    X(STATE, uint32_t, turn)       /* order among agents that gather in a place; 0: none */        \
    X(STATE, uint32_t, kicked)     /* reference to the body kicked last step */                    \
    X(STATE, uint32_t, struck)     /* reference to the fast body that hit it last step */          \
    X(STATE, uint32_t, kick_ready) /* tick from which it may kick again */                         \
    X(RARE, uint32_t, parting)     /* reference to the body that it kicked and still passes */     \
    X(STATE, uint64_t, ignore)     /* tags of agents and bodies that are not avoided */            \
    X(STATE, uint64_t, push_only)  /* tags that are pushed; 0: all */                              \
    X(STATE, uint32_t, approach)   /* reference to the body approached, not anticipated */         \
    X(STATE, uint32_t, approached) /* 1 + id of the agent that it approaches; 0: none */           \
    X(STATE, uint32_t, grasped)    /* 1 + id of the agent that it holds on to; 0: none */          \
    X(STATE, uint8_t, held)        /* how many agents hold on to it (`grasped`) */

#define JOX_NO_MACHINE UINT16_MAX
#define JOX_NO_TURN UINT32_MAX /* in `queued`: it is on its way to the end of the queue */

/* Bits of the column plan_notes: what acted on an agent's plan that no equation of the paper
   prints. The first two are rules of the default mode, the third a limit of literal mode. */
typedef enum JoxPlanNote {
    JOX_NOTE_TURNED_ASIDE = 1, /* it stood before others, and wanted to go more to its right */
    JOX_NOTE_BOUNDED =
        2, /* half-planes of contacts or force were lowered to what is within reach */
    JOX_NOTE_PARTS_LEFT_OUT = 4 /* more parts of bodies were near than it has half-planes for */
} JoxPlanNote;

/* Returns the reference to an index, as columns store it: index + 1, 0 for none. Columns that are 0
   take no memory. */
static inline uint32_t jox_reference(int32_t index) {
    return (uint32_t)index + 1;
}
/* Returns the index that a reference stands for, or -1. */
static inline int32_t jox_referred(uint32_t reference) {
    return (int32_t)(reference - 1);
}

/* A column that is stored once while its value is the same for all agents. Agent i's value is
   cells[i & mask]. `mask` is UINT32_MAX if there is a cell for each agent; else it is 0, and
   JOX_AGENTS_PADDING equal cells can be read as the packet of any agents. */
typedef struct JoxParameterColumn {
    float *cells;
    uint32_t mask;
} JoxParameterColumn;
/* Like JoxParameterColumn, for own values: drawn once for each agent. */
typedef struct JoxOwnColumn {
    double *cells;
    uint32_t mask;
} JoxOwnColumn;

typedef struct JoxAgents {
    uint32_t count, capacity;
#define X(keep, type, name) type *name;
    JOX_AGENT_COLUMNS(X)
#undef X
    /* Read by jox_param, written by jox_param_set; angles are stored as their cosine. */
    JoxParameterColumn param[JOX_PARAM_COUNT];
    float *alike;      /* JOX_AGENTS_PADDING cells per parameter, for those stored once */
    JoxOwnColumn *own; /* own_count columns; read by jox_own, written by jox_own_set */
    uint32_t own_count;
    double *memory; /* rows of memory_stride doubles */
    uint32_t memory_stride;
    uint32_t next_id;
    /* Handles: slot -> index (JOX_NO_INDEX if free) and generation. */
    uint32_t *slot_index, *slot_generation, *free_slots;
    uint32_t slot_count, slot_capacity, free_count;
    /* Tables by rank, that is, by ascending id: index and id. They have room for `capacity` agents,
       so they grow with the greatest number that lived at once, not with all ids given. */
    uint32_t *by_rank, *rank_id;
    /* Periodic edges: agents that leave at one side come in at the other. Origin and lengths of the
       period, m; 0 along an axis without. Positions stay within [origin, origin + period). */
    JoxV2 origin, period;
    /* Storeys, if a world has several sheets (geom/storeys.h, which the rooms above include), else
       NULL; and the pitch, m along y from sheet to sheet, else 0. Agents that see each other over a
       seam stand whole pitches apart. Borrowed. */
    const struct JoxStoreys *storeys;
    float pitch;
    /* The same, if a floor has a slope: some stair, ramp or escalator has flights; else NULL. */
    const struct JoxStoreys *flights;
    void *spare; /* for permuting: a column of 4 bytes per agent */
    void *row;   /* for permuting: one wider entry */
    uint32_t *order;
} JoxAgents;

/* Returns the shortest vector between two points that differ by d, across periodic edges. */
static inline JoxV2 jox_wrap(const JoxAgents *agents, JoxV2 d) {
    const JoxV2 period = agents->period;
    if (period.x > 0.0f && fabsf(d.x) > 0.5f * period.x)
        d.x -= d.x > 0.0f ? period.x : -period.x;
    if (period.y > 0.0f && fabsf(d.y) > 0.5f * period.y)
        d.y -= d.y > 0.0f ? period.y : -period.y;
    return d;
}
/* Returns the vector between two agents that see each other and whose positions differ by d, across
   periodic edges and seams between sheets. */
static inline JoxV2 jox_fold(const JoxAgents *agents, JoxV2 d) {
    d = jox_wrap(agents, d);
    if (agents->pitch > 0.0f)
        d.y -= agents->pitch * rintf(d.y / agents->pitch);
    return d;
}
/* Returns agent i's value of a parameter. */
static inline float jox_at(JoxParameterColumn column, uint32_t i) {
    return column.cells[i & column.mask];
}
static inline float jox_param(const JoxAgents *agents, JoxParameter p, uint32_t i) {
    return jox_at(agents->param[p], i);
}
/* Returns the values of a packet of agents, at most JOX_AGENTS_PADDING, from `first` on. */
static inline const float *jox_params(const JoxAgents *agents, JoxParameter p, uint32_t first) {
    return agents->param[p].cells + (first & agents->param[p].mask);
}
/* Returns an own value of an agent; it has no meaning for agents without a machine. */
static inline double jox_own(const JoxAgents *agents, uint32_t i, uint32_t slot) {
    const JoxOwnColumn column = agents->own[slot];
    return column.cells[i & column.mask];
}
/* Returns whether an agent is under the walking law (core/walking.md): it keeps a time gap. */
static inline bool jox_walks(const JoxAgents *agents, uint32_t i) {
    return jox_param(agents, JOX_PARAM_time_gap, i) > 0.0f;
}
#define JOX_STANDS 0.1f /* m/s: agents that prefer to be slower than this want to stand */
static inline bool jox_stands(const JoxAgents *agents, uint32_t i) {
    float x = agents->pref_x[i], y = agents->pref_y[i];
    return x * x + y * y < JOX_STANDS * JOX_STANDS;
}
#define JOX_STEP_REACTION 0.3f /* s from when an agent rests to its first step back */
#define JOX_STEP_LOAD 10.0f    /* N: an agent that others press harder takes no steps */
/* Returns whether agent i, which stands, steps back to where it stood before others moved it. */
static inline bool jox_steps_back(const JoxAgents *agents, uint32_t i) {
    return agents->settled[i] > JOX_STEP_REACTION && agents->load[i] <= JOX_STEP_LOAD &&
           jox_stands(agents, i);
}
/* Returns whether agent i stands and feels a force: it then plans its velocity in every step, as
   the force changes in every step. Known once the forces are summed. */
static inline bool jox_stands_pressed(const JoxAgents *agents, uint32_t i) {
    return jox_stands(agents, i) &&
           (agents->half_plane_x[i] != 0.0f || agents->half_plane_y[i] != 0.0f);
}
/* Returns whether all `count` cells of a column (at least 1) are bitwise equal. */
static inline bool jox_is_same_of_all(const void *cells, size_t size, uint32_t count) {
    return memcmp(cells, (const char *)cells + size, (count - 1) * size) == 0;
}
/* Returns whether agent i approaches agent j, or one of them holds the other: then i does not avoid
   j, and only contacts keep them apart. */
static inline bool jox_approaches_or_holds(const JoxAgents *agents, uint32_t i, uint32_t j) {
    const uint32_t other = agents->id[j] + 1;
    return agents->approached[i] == other || agents->grasped[i] == other ||
           agents->grasped[j] == agents->id[i] + 1;
}
/* Returns the vector from agent i to agent j, which see each other, m. */
static inline JoxV2 jox_offset(const JoxAgents *agents, uint32_t i, uint32_t j) {
    return jox_fold(agents, (JoxV2){agents->x[j] - agents->x[i], agents->y[j] - agents->y[i]});
}

/* Grow the columns; zero-initialised agents are empty. Own values and memory can only grow in
   number, and new cells are zero. */
void jox_agents_reserve(JoxAgents *agents, uint32_t capacity);
void jox_agents_reserve_slots(JoxAgents *agents, uint32_t capacity);
void jox_agents_widen(JoxAgents *agents, uint32_t own_count, uint32_t memory_stride);
/* Adds one agent: all columns zero, parameters at their defaults, face +x, lasts infinite, goal -1,
   machine JOX_NO_MACHINE. Returns its index, valid until the next sort. A caller that gives it a
   machine must set all its own values. */
uint32_t jox_agents_add(JoxAgents *agents);
/* Adds one agent for a caller that sets machine and parameters next: the machine is the first,
   parameters have any values. Writing defaults first would give each column a cell per agent. */
uint32_t jox_agents_add_alike(JoxAgents *agents);
/* Set the value of one agent. The first value that differs gives the column a cell per agent, so no
   other thread may read the column meanwhile. */
void jox_param_set(JoxAgents *agents, JoxParameter p, uint32_t i, float stored);
void jox_own_set(JoxAgents *agents, uint32_t i, uint32_t slot, double value);
/* Give a column a cell for each agent. */
void jox_param_differ(JoxAgents *agents, JoxParameter p);
void jox_own_differ(JoxAgents *agents, uint32_t slot);
/* Gives all agents the same value, stored once. */
void jox_own_share(JoxAgents *agents, uint32_t slot, double value);
/* Initialises new columns of parameters and own values with the default, or zero. */
void jox_shared_create(JoxAgents *agents);
/* Stores once each column that has become the same for all agents. */
void jox_shared_settle(JoxAgents *agents);
/* Returns the greatest value of a parameter, or 0 without agents. */
float jox_param_greatest(const JoxAgents *agents, JoxParameter p);
/* Deletes all agents with `removed` set and keeps the order of the others. Returns how many. */
uint32_t jox_agents_compact(JoxAgents *agents);
/* Permutes the agents: the new agent i is the old agent order[i]. Columns marked SCRATCH hold
   nothing afterwards. `room`: 8 bytes per agent, aligned to 8, to work in. */
void jox_agents_permute(JoxAgents *agents, const uint32_t *order, void *room);
/* Writes the indices of all agents by ascending id to out[0 .. count - 1]. For single ranks read
   agents->by_rank. */
void jox_agents_by_id(const JoxAgents *agents, uint32_t *out);
/* Returns the index of the living agent with an id, or JOX_NO_INDEX. Takes constant time if no
   agent was removed, else logarithmic time. */
uint32_t jox_agents_find(const JoxAgents *agents, uint32_t id);
/* Lists the agents' state, by ascending id: their order in memory is no part of it, and a restored
   world has them in order of id. */
void jox_agents_sections(JoxAgents *agents, JoxSections *sections);
/* Overwrites the scratch columns (numbers with NaN), to prove that no later step reads them. */
void jox_agents_forget(JoxAgents *agents);
void jox_agents_free(JoxAgents *agents);

/* Returns a point moved into the period, where edges are joined. */
JoxV2 jox_agents_wrapped(const JoxAgents *agents, JoxV2 at);
/* Moves agent i to the other side if it crossed a periodic edge, together with the positions of the
   step's beginning. Returns whether it moved or has no finite position. */
bool jox_agents_wrap(JoxAgents *agents, uint32_t i);

#endif
