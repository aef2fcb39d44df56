/* Navigation's state between steps, and its stages in the order of a step. */
#ifndef JOX_NAV_NAV_H
#define JOX_NAV_NAV_H

#include "agents/agents.h"
#include "agents/contact_planes.h"
#include "agents/neighbours.h"
#include "agents/walk_law.h"
#include "geom/objects.h"
#include "geom/wall_grid.h"
#include "geom/walls.h"
#include "jostle.h"
#include "task/pool.h"
#include "task/stage_memory.h"

typedef struct JoxNav JoxNav;

/* `walk`: the constants of the walking law, not copied; NULL where nobody keeps a time gap. */
JoxNav *jox_nav_create(const JoxWalkLaw *walk);
void jox_nav_free(JoxNav *nav);
/* Equations 3 and 4 as they are printed, and no projection of overlaps. */
void jox_nav_set_literal(JoxNav *nav, bool literal);
/* The instruction set of the kernels, which changes no result; at first the widest that runs. */
void jox_nav_set_isa(JoxNav *nav, JoIsa isa);
/* Memory that the sort of agents and move share with other stages; at first their own. */
void jox_nav_set_memory(JoxNav *nav, JoxStageMemory *memory);
/* The walls, not copied; call again when they change. NULL: none. */
void jox_nav_set_walls(JoxNav *nav, const JoxWalls *walls);

/* Lists what outlasts a step: how far the grid of walls reaches. The order of the agents is no
   state, as all results are exact whatever it is. */
void jox_nav_sections(JoxNav *nav, JoxSections *sections);
/* The agents are no longer in the order in which they were sorted: the next step sorts them anew.
 */
void jox_nav_forget(JoxNav *nav);

/* Every eighth tick, or when agents came: puts the agents in the order of the grid, which depends
   on positions and ids alone. All indices change. Who left meanwhile is taken out of the grid. */
void jox_nav_sort(JoxNav *nav, JoxAgents *agents, uint64_t tick);
/* perceive: exactly the `neighbours` nearest within each agent's own `perception`, nearest first,
   ties by id; also writes `search` and `density`. Grows `out` as needed. */
void jox_nav_perceive(JoxNav *nav, JoxAgents *agents, JoxNeighbours *out, JoxPool *pool);
/* The grid of walls, serving queries as far as anyone may touch and half as far as anyone pushes or
   passes a force on, over a gap of at most `passing` metres; NULL without walls. */
const JoxWallGrid *jox_nav_touching_walls(JoxNav *nav, const JoxNeighbours *neighbours,
                                          const JoxAgents *agents, float passing);
/* jox_wall_grid_clear2 of each agent by that grid, m2, where it is known since prefer, else NULL.
 */
const float *jox_nav_clear2(const JoxNav *nav);
/* The end of prefer: aim of everybody and, of those who keep a time gap and plan in this step,
   walk: the velocity that the walking law wants among others and walls; their eagerness and course.
   `time`: simulated, s; `interval`: since people planned last, s. */
void jox_nav_walk(JoxNav *nav, JoxAgents *agents, const JoxNeighbours *neighbours, uint64_t seed,
                  double time, double interval, bool plans, JoxPool *pool);
/* When agents plan, and for when. */
typedef struct JoxPlanTime {
    uint64_t seed;        /* of random numbers */
    double time;          /* s, simulated */
    double planning_time; /* s from `time`: when the planned velocity is to be reached */
    bool plans;           /* false: agents that want to get on keep their plans */
} JoxPlanTime;
/* solve: next_x, next_y, the velocity to have `planning_time` seconds from now; sets failed where
   there is none that meets all half-planes. What agents touch is solved by its contact planes,
   which are hard as walls are, where `touched` has them. Returns how many agents had a hard
   half-plane relaxed. */
uint32_t jox_nav_solve(JoxNav *nav, JoxAgents *agents, const JoxNeighbours *neighbours,
                       const JoxObjects *objects, const JoxContactPlanes *touched,
                       const JoxPlanTime *planning, JoxPool *pool);
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
/* The half-planes that solve gave the agent at an index, in the order of solving, between solve and
   move. Returns how many. */
uint32_t jox_nav_constraints(const JoxNav *nav, const JoxAgents *agents,
                             const JoxNeighbours *neighbours, const JoxObjects *objects,
                             const JoxContactPlanes *touched, double planning_time, uint32_t agent,
                             JoxConstraint out[JOX_MOST_CONSTRAINTS]);
/* What an agent would choose as everything stands between two steps. */
typedef struct JoxPlan {
    JoxConstraint planes[JOX_MOST_CONSTRAINTS]; /* in the order of solving */
    uint32_t count;
    JoxV2 chosen; /* m/s */
    bool failed;  /* no velocity meets all of them */
} JoxPlan;
/* Looks for the agent's neighbours anew, and solves for it alone, whether or not `planning` says
   that agents plan, from what it prefers; what it touches and is pressed by are those of the last
   step, after which this may be called until the next one. Changes nothing. */
void jox_nav_plan(const JoxNav *nav, const JoxAgents *agents, const JoxObjects *objects,
                  const JoxContactPlanes *touched, const JoxPlanTime *planning, uint32_t agent,
                  JoxPlan *out);
/* move: velocity = forced + (next - forced) * response, the position goes by the mean of that
   approach over the step, forced + (next - forced) * on_the_way, weak projection of overlaps (of
   what is touched, where `touched` has it, else of neighbours), never through a wall; prev_x,
   prev_y keep the old position; updates still, still_x, still_y. */
void jox_nav_move(JoxNav *nav, JoxAgents *agents, const JoxNeighbours *neighbours,
                  const JoxObjects *objects, const JoxContactPlanes *touched, double dt,
                  double response, double on_the_way, JoxPool *pool);

/* Where somebody would begin. */
typedef struct JoxBirthWish {
    JoxV2 at;     /* m */
    float radius; /* m */
    /* Their place, within a box: they are shifted within it if it has room, and those who stay
       nowhere else. Its number, from 1 on, tells it from others in the same step. NULL and 0: none.
     */
    bool (*holds)(const void *place, JoxV2 spot);
    const void *place;
    JoxV2 low, high; /* m */
    uint32_t place_number;
    bool stays;
} JoxBirthWish;
typedef enum JoxBirthSpot {
    JOX_BIRTH_AS_WISHED,
    JOX_BIRTH_SHIFTED, /* out of walls that are nearer than 0.99 radii, and of agents that it would
                          overlap by more than a quarter of the smaller diameter */
    JOX_BIRTH_NO_ROOM, /* there is no free spot within 25 m */
    JOX_BIRTH_NOT_FOUND, /* the search was ended by its bound: there may be one */
    JOX_BIRTH_IN_SOLID   /* the point lies in a wall */
} JoxBirthSpot;
static inline bool jox_birth_succeeds(JoxBirthSpot spot) {
    return spot == JOX_BIRTH_AS_WISHED || spot == JOX_BIRTH_SHIFTED;
}
/* Finds the nearest free spot of a spiral, with no wall between it and the point; *spot is the
   point itself where there is none. All searches of births between two steps look at 5 million
   spots, and those that come after at 1,000 each. Changes nothing; whoever is born there is told to
   jox_nav_born before the next call. */
JoxBirthSpot jox_nav_find_birth(JoxNav *nav, const JoxAgents *agents, const JoxBirthWish *wish,
                                JoxV2 *spot);
/* The last agent was added, on the spot that was found for it. */
void jox_nav_born(JoxNav *nav, const JoxAgents *agents, uint32_t agent);
/* Forgets what the searches found, and their memory: people move. */
void jox_nav_end_births(JoxNav *nav);
/* The same of the agent at an index, who would stand at *at. */
JoxBirthSpot jox_nav_free_spot(JoxNav *nav, const JoxAgents *agents, uint32_t agent, JoxV2 *at);

/* How agents in whose way walls came were moved. */
typedef struct JoxCleared {
    uint32_t moved;
    uint32_t stuck;       /* agents for whom there is no free spot within 25 m */
    uint32_t first_stuck; /* index of the first of them */
} JoxCleared;
/* Moves agents whose centre lies in a solid that came, or nearer than 0.7 radii to an edge that
   did, in ascending id, to the nearest free spot of a spiral. No wall lies on the way, but for
   solids that came over the centre: out of these it leads. */
JoxCleared jox_nav_clear_new_walls(JoxNav *nav, JoxAgents *agents);

#endif
