/* The agents' columns (structure of arrays). Index = place in memory, which follows space: agents
   are re-sorted every few steps, so an index holds within a step only. `id` is for ever. */
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

/* The terms of the net force, equation 10, N. Each row gives two columns, NAME_x and NAME_y, a part
   of the force that is shown of an inspected agent, and, by its role, a share in what moves the
   agent. ROW(X, keep, role, name, label): keep is STATE, carried over from step to step, or
   SCRATCH, zero at the beginning of every step; role is one of JoxForceRole. The net force is
   summed in the order of the rows. A new term is a row here, a stage in force/ that fills its
   columns, and the call of that stage in the step. */
#define JOX_FORCE_TERMS(ROW, X)                                                                    \
    ROW(X, STATE, FREE, ext, "external")          /* given by callers and events for one step */   \
    ROW(X, STATE, BRACED, inferred, "resistance") /* filtered, eq. 8 and 9 */                      \
    ROW(X, SCRATCH, BRACED, push, "push")         /* pushes received, eq. 5 */                     \
    ROW(X, SCRATCH, CONTACT, contact, "contact")  /* with agents, walls and bodies, eq. 6, 7 */
#define JOX_FORCE_TERM_COLUMNS(X, keep, role, name, label)                                         \
    X(keep, float, name##_x) X(keep, float, name##_y)

/* How a force term moves an agent. Flags, so that a sum over terms can take several. */
typedef enum JoxForceRole {
    JOX_FORCE_FREE = 1,    /* accelerates the agent whole */
    JOX_FORCE_BRACED = 2,  /* feet that brace hold up to `brace` newtons of the sum of these */
    JOX_FORCE_CONTACT = 4, /* the result of the contact solve; may raise the speed limit */
    JOX_FORCE_ALL = 7
} JoxForceRole;

/* X(keep, type, name): what it is. Units: m, m/s, N, s.
   STATE: carried from step to step, so it is hashed and saved. SCRATCH: every step writes it before
   it reads it; between steps it holds figures of the last step, which a restored world lacks until
   the next, and agents are not sorted with it. HINT: scratch that says where to begin, and changes
   no result; it follows its agent. INDEX: follows from state, kept up by the functions below. */
#define JOX_AGENT_COLUMNS(X)                                                                       \
    X(STATE, uint32_t, id)      /* counts up from 0, never reused */                               \
    X(STATE, uint32_t, slot)    /* row of the handle table */                                      \
    X(INDEX, uint32_t, rank)    /* how many living agents have smaller ids; follows from `id` */   \
    X(STATE, uint16_t, group)   /* index of the scene's group */                                   \
    X(STATE, uint16_t, machine) /* index of the machine; JOX_NO_MACHINE has none */                \
    X(STATE, uint16_t, state)   /* index of the state in the machine */                            \
    X(STATE, uint16_t, team)    /* 0 none; agents of other teams are opponents */                  \
    X(STATE, uint64_t,                                                                             \
      given) /* bit per own slot (the first 64) that the scene or a function set */                \
    X(STATE, uint64_t, tags) /* bit per tag of the world */                                        \
    X(STATE, float, x)                                                                             \
    X(STATE, float, y)                                                                             \
    X(STATE, float, vx)                                                                            \
    X(STATE, float, vy)                                                                            \
    X(STATE, float, prev_x) /* position before the last move */                                    \
    X(STATE, float, prev_y)                                                                        \
    X(STATE, float, face_x) /* unit vector the agent looks along */                                \
    X(STATE, float, face_y)                                                                        \
    X(STATE, float, pref_x) /* preferred velocity, written by `prefer` */                          \
    X(STATE, float, pref_y)                                                                        \
    X(STATE, float, eager)    /* eagerness, 0 to 1: the crowd's, within the bounds of haste */     \
    X(STATE, float, course_x) /* direction in which it has walked of late, unit or (0, 0) */       \
    X(STATE, float, course_y)                                                                      \
    X(STATE, uint32_t, bound) /* reference to the place that it is bound for by a field */         \
    X(SCRATCH, float, way)    /* way left to it, m */                                              \
    X(SCRATCH, float, aim_x)  /* direction of the preferred velocity, unit or (0, 0) */            \
    X(SCRATCH, float, aim_y)                                                                       \
    X(SCRATCH, float, walk_x) /* velocity that the walking law wants, where one plans */           \
    X(SCRATCH, float, walk_y)                                                                      \
    X(STATE, float, next_x) /* planned velocity, by `solve`; kept until people plan anew */        \
    X(STATE, float, next_y)                                                                        \
    JOX_FORCE_TERMS(JOX_FORCE_TERM_COLUMNS, X)                                                     \
    X(STATE, float, force_x) /* net force of this step, equation 10, N */                          \
    X(STATE, float, force_y)                                                                       \
    X(STATE, float, compression) /* sum of |f.n| of contacts over circumference, N/m */            \
    /* Greatest push borne from any one direction, N: over directions d, the sum of the positive   \
       parts of f.d over the contacts. */                                                          \
    X(STATE, float, load)                                                                          \
    X(SCRATCH, float, given_x) /* force from outside in the last step, N, for who looks at it */   \
    X(SCRATCH, float, given_y)                                                                     \
    X(SCRATCH, uint32_t, moved_up) /* places, since velocities were chosen: who was before left */ \
    X(SCRATCH, float, forced_x)    /* velocity that the force gives by the end of the step, m/s */ \
    X(SCRATCH, float, forced_y)                                                                    \
    X(SCRATCH, float, breadth)      /* radius at which it touches, m */                            \
    X(SCRATCH, float, half_plane_x) /* force half-plane: unit normal; (0, 0) means none */         \
    X(SCRATCH, float, half_plane_y)                                                                \
    X(SCRATCH, float, half_plane_offset) /* (v . normal) >= offset, m/s */                         \
    X(SCRATCH, float, speed_limit)       /* greatest speed in this step, m/s */                    \
    X(SCRATCH, float, density)   /* from the distance of the farthest neighbour kept, 1/m2 */      \
    X(HINT, float, search)       /* radius that held the neighbours last time; 0 unknown */        \
    X(HINT, uint32_t, cell)      /* of navigation's grid, in which it stood when that was laid */  \
    X(SCRATCH, uint8_t, failed)  /* 1 where the 2-D program was infeasible this step */            \
    X(STATE, uint8_t, contacts)  /* agents and bodies touched this step */                         \
    X(STATE, uint8_t, removed)   /* 1: leaves the world at the end of the step */                  \
    X(STATE, uint32_t, entered)  /* tick at which the state was entered */                         \
    X(STATE, float, lasts)       /* drawn duration of the state, s; INFINITY if none */            \
    X(STATE, uint32_t, was_true) /* bit per transition: its `when` held last step */               \
    X(STATE, int32_t, goal)      /* place index aimed at, or -1 */                                 \
    X(STATE, float, still)       /* seconds since it last moved 0.25 m */                          \
    X(STATE, float, still_x)     /* where that was */                                              \
    X(STATE, float, still_y)                                                                       \
    X(STATE, uint32_t, queue_at)   /* reference to the place whose queue it stands in */           \
    X(STATE, uint32_t, queued)     /* tick at which it joined that queue */                        \
    X(STATE, uint32_t, turn)       /* order among those who gather in a place; 0 has none */       \
    X(STATE, uint32_t, kicked)     /* reference to the body kicked last step */                    \
    X(STATE, uint32_t, struck)     /* reference to the fast body that hit it last step */          \
    X(STATE, uint32_t, kick_ready) /* tick from which it may kick again */                         \
    X(STATE, uint64_t, ignore)     /* tags of agents and bodies that are not avoided */            \
    X(STATE, uint64_t, push_only)  /* tags that are pushed; 0 means all */                         \
    X(STATE, uint32_t, approach)   /* reference to the body that is approached, not anticipated */ \
    X(STATE, uint32_t, approached) /* id + 1 of the agent that is approached; 0 none */            \
    X(STATE, uint32_t, grasped)    /* id + 1 of the agent that it holds; 0 none */                 \
    X(STATE, uint8_t, held)        /* agents that hold it */

#define JOX_NO_MACHINE UINT16_MAX

/* A reference in a column: index + 1, so that 0 is none, which takes no memory. */
static inline uint32_t jox_reference(int32_t index) {
    return (uint32_t)index + 1;
}
/* The index that is referred to, or -1. */
static inline int32_t jox_referred(uint32_t reference) {
    return (int32_t)(reference - 1);
}

/* Columns of what is mostly the same of all: then it is held once. Agent i's value is
   cells[i & mask]: `mask` is UINT32_MAX where there is a cell for each, else 0, and
   JOX_AGENTS_PADDING cells, all alike, are read as anybody's packet. */
typedef struct JoxParameterColumn {
    float *cells;
    uint32_t mask;
} JoxParameterColumn;
/* Values drawn once for each agent. */
typedef struct JoxOwnColumn {
    double *cells;
    uint32_t mask;
} JoxOwnColumn;

typedef struct JoxAgents {
    uint32_t count, capacity;
#define X(keep, type, name) type *name;
    JOX_AGENT_COLUMNS(X)
#undef X
    /* Read through jox_param, written through jox_param_set; angles hold the cosine. */
    JoxParameterColumn param[JOX_PARAM_COUNT];
    float *alike; /* JOX_AGENTS_PADDING cells of each parameter, for those that are held once */
    JoxOwnColumn *own; /* own_count of them; read through jox_own, written through jox_own_set */
    uint32_t own_count;
    double *memory; /* rows of memory_stride doubles */
    uint32_t memory_stride;
    uint32_t next_id;
    /* Handles: slot -> index (JOX_NO_INDEX when free) and generation. */
    uint32_t *slot_index, *slot_generation, *free_slots;
    uint32_t slot_count, slot_capacity, free_count, free_capacity;
    /* By rank, that is in ascending id: index and id. Room for `capacity`, so that they grow with
       the most who ever lived at once, not with all ids ever given. */
    uint32_t *by_rank, *rank_id;
    /* Periodic edges: who leaves at one side comes in at the other. Lengths of the period, 0 along
       an axis without; positions are kept within [origin, origin + period). */
    JoxV2 origin, period;
    void *few; /* the memory of all columns above `param` and of the next two, while there is room
                  for a few agents alone; NULL: each has its own */
    void *scratch, *spare; /* for permuting: columns of 8 and of 4 bytes an agent */
    void *row;             /* and one wider entry */
    uint32_t *order;
} JoxAgents;

/* The shortest of the ways between two points that differ by d where edges are periodic. */
static inline JoxV2 jox_wrap(const JoxAgents *agents, JoxV2 d) {
    const JoxV2 period = agents->period;
    if (period.x > 0.0f && fabsf(d.x) > 0.5f * period.x)
        d.x -= d.x > 0.0f ? period.x : -period.x;
    if (period.y > 0.0f && fabsf(d.y) > 0.5f * period.y)
        d.y -= d.y > 0.0f ? period.y : -period.y;
    return d;
}
/* Agent i's value in the column of a parameter. */
static inline float jox_at(JoxParameterColumn column, uint32_t i) {
    return column.cells[i & column.mask];
}
static inline float jox_param(const JoxAgents *agents, JoxParameter p, uint32_t i) {
    return jox_at(agents->param[p], i);
}
/* The values of a packet of agents, JOX_AGENTS_PADDING at most, from the first on. */
static inline const float *jox_params(const JoxAgents *agents, JoxParameter p, uint32_t first) {
    return agents->param[p].cells + (first & agents->param[p].mask);
}
/* An own value of an agent that runs a machine; of one that runs none they mean nothing. */
static inline double jox_own(const JoxAgents *agents, uint32_t i, uint32_t slot) {
    const JoxOwnColumn column = agents->own[slot];
    return column.cells[i & column.mask];
}
/* Whether an agent walks by the walking law (core/walking.md): it keeps a time gap. */
static inline bool jox_walks(const JoxAgents *agents, uint32_t i) {
    return jox_param(agents, JOX_PARAM_time_gap, i) > 0.0f;
}
#define JOX_STANDS 0.1f /* m/s: who wants to be slower wants to stay where they are */
static inline bool jox_stands(const JoxAgents *agents, uint32_t i) {
    float x = agents->pref_x[i], y = agents->pref_y[i];
    return x * x + y * y < JOX_STANDS * JOX_STANDS;
}
/* Whether agent i stands and feels a force, which changes in every step: then it plans in every
   step. Known once the forces are summed. */
static inline bool jox_stands_pressed(const JoxAgents *agents, uint32_t i) {
    return jox_stands(agents, i) &&
           (agents->half_plane_x[i] != 0.0f || agents->half_plane_y[i] != 0.0f);
}
/* Whether all `count` cells of a column, 1 at least, are the same to the bit. */
static inline bool jox_is_same_of_all(const void *cells, size_t size, uint32_t count) {
    return memcmp(cells, (const char *)cells + size, (count - 1) * size) == 0;
}
/* Whether an agent means to touch somebody, or is held: then some of its neighbours are none that
   it avoids. */
static inline bool jox_is_close_to_some(const JoxAgents *agents, uint32_t i) {
    return agents->approached[i] || agents->grasped[i] || agents->held[i];
}
/* Whether j is one of them. Only contacts keep them apart, where these are solved. */
static inline bool jox_is_close_to(const JoxAgents *agents, uint32_t i, uint32_t j) {
    const uint32_t other = agents->id[j] + 1;
    return agents->approached[i] == other || agents->grasped[i] == other ||
           agents->grasped[j] == agents->id[i] + 1;
}
/* From agent i to agent j, m. */
static inline JoxV2 jox_offset(const JoxAgents *agents, uint32_t i, uint32_t j) {
    return jox_wrap(agents, (JoxV2){agents->x[j] - agents->x[i], agents->y[j] - agents->y[i]});
}

/* Zero-initialised agents are empty. Own values and memory may only grow in number: new cells are
   zero. */
void jox_agents_reserve(JoxAgents *agents, uint32_t capacity);
void jox_agents_reserve_slots(JoxAgents *agents, uint32_t capacity);
void jox_agents_widen(JoxAgents *agents, uint32_t own_count, uint32_t memory_stride);
/* Adds one agent: all columns zero, parameters at their defaults, face +x, lasts infinite, goal -1,
   machine JOX_NO_MACHINE. Returns its index (valid until the next sort). Who gives it a machine
   sets all its own values. */
uint32_t jox_agents_add(JoxAgents *agents);
/* Likewise, for who sets machine and parameters next: the machine is the first, and parameters have
   any values. The way by the defaults would take memory for each agent. */
uint32_t jox_agents_add_alike(JoxAgents *agents);
/* The first agent that differs gives a column a cell for each. Not while others read the column. */
void jox_param_set(JoxAgents *agents, JoxParameter p, uint32_t i, float stored);
void jox_own_set(JoxAgents *agents, uint32_t i, uint32_t slot, double value);
/* Gives a column a cell for each agent. */
void jox_param_differ(JoxAgents *agents, JoxParameter p);
void jox_own_differ(JoxAgents *agents, uint32_t slot);
/* Gives everybody a value, which is held once. */
void jox_own_share(JoxAgents *agents, uint32_t slot, double value);
/* Gives columns of parameters and of own values that are new their first value: the default, or
   zero. */
void jox_shared_create(JoxAgents *agents);
/* Holds once again what has become the same of all. */
void jox_shared_settle(JoxAgents *agents);
/* The greatest value of a parameter, or 0. */
float jox_param_greatest(const JoxAgents *agents, JoxParameter p);
/* Takes out all agents with `removed` set, keeping the order of the rest. Returns how many. */
uint32_t jox_agents_compact(JoxAgents *agents);
/* Puts the agents in the order given: new index i is what was at order[i]; a permutation. Columns
   marked SCRATCH hold nothing afterwards. */
void jox_agents_permute(JoxAgents *agents, const uint32_t *order);
/* Writes the indices of all agents in ascending id into `out` (count entries). One at a time they
   are agents->by_rank[0 .. count - 1]. */
void jox_agents_by_id(const JoxAgents *agents, uint32_t *out);
/* Index of the living agent with an id, or JOX_NO_INDEX. At once while nobody has left, else in
   logarithmic time. */
uint32_t jox_agents_find(const JoxAgents *agents, uint32_t id);
/* Lists the agents' state. Agents come in ascending id: their order in memory is no part of it, and
   restored they lie by id. */
void jox_agents_sections(JoxAgents *agents, JoxSections *sections);
/* Overwrites the scratch columns, with NaN where they hold numbers: no later step may notice. */
void jox_agents_forget(JoxAgents *agents);
/* Called through JOX_CHECK: indices, ids, ranks and handles agree, shared cells are alike. */
void jox_agents_check(const JoxAgents *agents);
void jox_agents_free(JoxAgents *agents);

/* Where a point lies within joined edges. */
JoxV2 jox_agents_wrapped(const JoxAgents *agents, JoxV2 at);
/* Who has left over a periodic edge comes in at the other side, with where the step began beyond
   the edge. Whether agent i has, or is at no place. */
bool jox_agents_wrap(JoxAgents *agents, uint32_t i);

#endif
