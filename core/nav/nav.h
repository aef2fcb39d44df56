/* Navigation: its state between steps, and its stages in the order in which world/step.c calls
   them: sort, perceive, walk, solve, move. Births and new walls are handled between two steps. The
   caller owns agents, neighbours and walls. */
#ifndef JOX_NAV_NAV_H
#define JOX_NAV_NAV_H

#include "agents/step.h"
#include "agents/walk_law.h"
#include "geom/objects.h"
#include "geom/wall_grid.h"
#include "geom/walls.h"
#include "jostle.h"
#include "task/pool.h"
#include "task/stage_memory.h"

typedef struct JoxNav JoxNav;

/* `walk`: constants of the walking law, not copied; NULL where no agent keeps a time gap. */
JoxNav *jox_nav_create(const JoxWalkLaw *walk);
void jox_nav_free(JoxNav *nav);
/* Literal mode: equations 3 and 4 as they are printed, and overlaps are not resolved. */
void jox_nav_set_literal(JoxNav *nav, bool literal);
/* Sets the instruction set of the kernels, which changes no result. Default: the widest that
   runs. */
void jox_nav_set_isa(JoxNav *nav, JoIsa isa);
/* Sets the memory that sort and move share with other stages. Default: its own. */
void jox_nav_set_memory(JoxNav *nav, JoxStageMemory *memory);
/* Sets the walls, which are not copied; call it again when they change. NULL: none. */
void jox_nav_set_walls(JoxNav *nav, const JoxWalls *walls);

/* Lists the state that outlasts a step: how far the grid of walls reaches. The order of the agents
   is not state, as results are the same in any order. */
void jox_nav_sections(JoxNav *nav, JoxSections *sections);
/* Tells that the agents' order has changed: the next step sorts them anew. */
void jox_nav_invalidate_order(JoxNav *nav);

/* Sorts the agents by the cells of the grid every eighth tick, and when agents were added; agents
   that left are taken out of the grid. The order depends on positions and ids alone. All indices
   change. */
void jox_nav_sort(JoxNav *nav, JoxAgents *agents, uint64_t tick);
/* perceive: finds exactly the `neighbours` nearest within each agent's own `perception`, nearest
   first, ties by id; also writes `search_radius` and `density`. Grows `out` as needed. */
void jox_nav_perceive(JoxNav *nav, JoxAgents *agents, JoxNeighbours *out, JoxPool *pool);
/* Returns the grid of walls, which serves queries as far as any agent touches, and half as far as
   any agent pushes or passes a force on, over a gap of at most `passing` metres; NULL without
   walls. */
const JoxWallGrid *jox_nav_touching_walls(JoxNav *nav, const JoxStep *step, float passing);
/* Returns jox_wall_grid_unhidden_distance2 of each agent by that grid, m2; NULL without walls. */
const float *jox_nav_unhidden2(const JoxNav *nav);
/* End of prefer: writes the aims of all agents; of those that keep a time gap and plan in this
   step, also walk (the velocity that the walking law wants among others and walls), eagerness and
   course. */
void jox_nav_walk(JoxNav *nav, const JoxStep *step);
/* solve: writes next_x, next_y, the velocity to have `planning_time` seconds from now, and sets
   `failed` where no velocity meets all half-planes, and `plan_notes`. Contacts in `touched` give
   hard half-planes, as walls do. Returns how many agents had a hard half-plane relaxed. */
uint32_t jox_nav_solve(JoxNav *nav, const JoxStep *step);
/* One of an agent's half-planes: it allows the velocities v with normal . v >= offset, m/s. */
typedef enum JoxConstraintKind {
    JOX_CONSTRAINT_WALL,
    JOX_CONSTRAINT_CONTACT,
    JOX_CONSTRAINT_AGENT,
    JOX_CONSTRAINT_BODY,
    JOX_CONSTRAINT_FORCE
} JoxConstraintKind;
typedef struct JoxConstraint {
    JoxConstraintKind kind;
    JoxV2 normal; /* unit */
    float offset;
} JoxConstraint;
enum { JOX_MOST_CONSTRAINTS = 93 };
/* Lists the half-planes of one agent as solve makes them, in the order of solving; valid between
   solve and move. Returns how many. */
uint32_t jox_nav_constraints(const JoxNav *nav, const JoxStep *step, uint32_t agent,
                             JoxConstraint out[JOX_MOST_CONSTRAINTS]);
/* The choice of an agent in the state between two steps. */
typedef struct JoxPlan {
    JoxConstraint planes[JOX_MOST_CONSTRAINTS]; /* in the order of solving */
    uint32_t count;
    JoxV2 chosen; /* m/s */
    bool failed;  /* no velocity meets all of them */
} JoxPlan;
/* Finds the neighbours of one agent anew and solves for it alone, from its preferred velocity,
   whether or not agents plan in the step. Contacts and forces are those of the last step; call it
   between that step and the next. Changes nothing. */
void jox_nav_plan(const JoxNav *nav, const JoxStep *step, uint32_t agent, JoxPlan *out);
/* move: sets the velocity to forced + (next - forced) * response; moves by the mean of that
   approach over the step, forced + (next - forced) * on_the_way; resolves overlaps weakly (of
   contacts where `touched` has them, else of neighbours); passes no wall. prev_x, prev_y keep the
   old position; updates still, still_x, still_y. */
void jox_nav_move(JoxNav *nav, const JoxStep *step);

/* Where an agent is to be born. */
typedef struct JoxBirthWish {
    JoxV2 at;     /* m */
    float radius; /* m */
    /* Place of the birth, within a box. An agent is shifted within it if it has room; one that
       `stays`, nowhere else. Places in the same step have different numbers from 1 on. NULL and 0:
       no place. */
    bool (*contains)(const void *place, JoxV2 spot);
    const void *place;
    JoxV2 low, high; /* m */
    uint32_t place_number;
    bool stays;
} JoxBirthWish;
typedef enum JoxBirthSpot {
    JOX_BIRTH_AS_WISHED,
    JOX_BIRTH_SHIFTED,   /* out of walls nearer than 0.99 radii, and of agents that it would overlap
                            by more than a quarter of the smaller diameter */
    JOX_BIRTH_NO_ROOM,   /* no free spot within 25 m */
    JOX_BIRTH_NOT_FOUND, /* the search reached its bound: there may be a spot */
    JOX_BIRTH_IN_SOLID   /* the point lies in a wall */
} JoxBirthSpot;
static inline bool jox_birth_succeeds(JoxBirthSpot spot) {
    return spot == JOX_BIRTH_AS_WISHED || spot == JOX_BIRTH_SHIFTED;
}
/* Finds the nearest free spot on a spiral, with no wall between it and the point; without one *spot
   is the point itself. All searches of births between two steps look at 5 million spots together,
   later ones at 1,000 each. Changes nothing; call jox_nav_note_birth for an agent that is born
   there before the next call. */
JoxBirthSpot jox_nav_find_birth(JoxNav *nav, const JoxAgents *agents, const JoxBirthWish *wish,
                                JoxV2 *spot);
/* Enters the agent that was added last, on the spot found for it, in the table of the searches. */
void jox_nav_note_birth(JoxNav *nav, const JoxAgents *agents, uint32_t agent);
/* Frees the tables of the searches, before agents move. */
void jox_nav_end_births(JoxNav *nav);
/* Finds a free spot for an existing agent, which is to stand at *at. */
JoxBirthSpot jox_nav_free_spot(JoxNav *nav, const JoxAgents *agents, uint32_t agent, JoxV2 *at);

/* How agents in the way of new walls were moved. */
typedef struct JoxCleared {
    uint32_t moved;
    uint32_t stuck;       /* agents without a free spot within 25 m */
    uint32_t first_stuck; /* index of the first of these */
} JoxCleared;
/* Moves agents whose centre lies in a new solid, or nearer than 0.7 radii to a new edge, in
   ascending id, to the nearest free spot on a spiral. The way to it crosses no wall, except out of
   new solids that cover the centre. */
JoxCleared jox_nav_clear_new_walls(JoxNav *nav, JoxAgents *agents);

#endif
