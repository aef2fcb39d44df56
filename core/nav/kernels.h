/* The kernels of navigation, one function for each instruction set, and what they share with the
   plain C around them. Each stage (perceive.c, walk.c, solve.c, move.c) calls its kernel for chunks
   of agents, on several threads. */
#ifndef JOX_NAV_KERNELS_H
#define JOX_NAV_KERNELS_H

#include "base/number/pi.h"
#include "base/number/random.h"
#include "nav/internal.h"
#include "simd/isa.h"

typedef struct JoxPerceive {
    const JoxNav *nav;
    JoxAgents *agents; /* writes search, density */
    JoxNeighbours *out;
    float sight; /* m: limit of every perception; INFINITY: none */
} JoxPerceive;

#define JOX_SEARCH_SLACK 0.03f    /* m: the first search radius exceeds the last one by this */
#define JOX_SEARCH_GROWTH 1.5f    /* growth of a radius that holds too few */
#define JOX_SEARCH_LEAST 0.01f    /* m: least radius that is stored */
#define JOX_DENSITY_LEAST 0.0025f /* m2: least squared radius in a density */

/* Finds the neighbours, the agents within touch range, `search` and `density` of agents [begin,
   end). `begin` is a multiple of JOX_LANES. */
typedef void JoxPerceiveKernel(const JoxPerceive *perceive, uint32_t begin, uint32_t end);
#define X(name, isa) JoxPerceiveKernel jox_perceive_packets_##name;
JOX_ISAS(X)
#undef X
/* Does so for one agent, with any number of candidates; searches within `radius` (m) first. */
void jox_perceive_one(const JoxPerceive *perceive, uint32_t agent, float radius);
/* Lists the agents within `range` (m) of one agent in touch_index. */
void jox_perceive_touching(const JoxPerceive *perceive, uint32_t agent, float range);

enum {
    JOX_MOST_WALLS = 16,
    JOX_MOST_OBJECTS = 24,
    JOX_MOST_CONTACTS = JOX_MOST_TOUCHED + JOX_MOST_BODIES_TOUCHED
};

typedef struct JoxSolve {
    JoxNav *nav;
    JoxAgents *agents;
    const JoxNeighbours *neighbours;
    const JoxObjects *objects;       /* NULL: none */
    const JoxContactPlanes *touched; /* NULL: contacts were not searched for */
    float planning_time;             /* s */
    bool plans;                      /* false: agents that want to get on keep their plans */
    float *clear2; /* m2, nav's: no wall hides neighbours nearer than this; NULL: unknown */
    uint64_t stream, moment; /* random stream, and moment of the draws for turning aside */
} JoxSolve;

/* Returns how far an agent that stands before others turns aside, 0 to 1: zero for the first second
   without moving JOX_STILL_REACH, then drawn anew each second from a range that widens for four
   more seconds. Always zero in literal mode. */
static inline float jox_turn_aside(const JoxSolve *s, uint32_t i) {
    const float stood = 0.25f * (s->agents->still[i] - 1.0f);
    if (!(stood > 0.0f) || s->nav->literal)
        return 0.0f;
    const uint64_t bits = jox_random_of(s->stream, s->agents->id[i], 0, s->moment);
    return jox_minf(stood, 1.0f) * (float)jox_random_share(bits);
}
/* Numbers of an agent's half-planes by kind, in the order of JoxConstraintKind and of the list. */
typedef struct JoxHalfPlaneCounts {
    uint32_t walls, contacts, agents, objects, force;
} JoxHalfPlaneCounts;

/* Plans agents [begin, end): next_x, next_y, failed. Returns how many had a hard half-plane
   relaxed. `begin` is a multiple of JOX_LANES. */
typedef uint32_t JoxSolveKernel(const JoxSolve *solve, uint32_t begin, uint32_t end);
#define X(name, isa) JoxSolveKernel jox_solve_packets_##name;
JOX_ISAS(X)
#undef X

/* Makers of the half-planes of one agent, in plain C: of walls; of contacts; of neighbours (by the
   walking law or ORCA, without those that jox_solve_passes_over skips); of bodies. Each returns how
   many it made. */
uint32_t jox_solve_walls(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);
uint32_t jox_solve_contacts(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);
uint32_t jox_solve_neighbours(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);
uint32_t jox_solve_objects(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);
uint32_t jox_solve_force(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);
/* Returns whether an agent needs no half-plane for a neighbour: it ignores or touches it, or a wall
   stands between them. */
bool jox_solve_passes_over(const JoxSolve *solve, uint32_t agent, uint32_t other);
/* Makes all half-planes of an agent, that of force last. */
JoxHalfPlaneCounts jox_solve_half_planes(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);
/* Returns whether an agent walks by the walking law. */
static inline bool jox_solve_walks(const JoxSolve *solve, uint32_t agent) {
    return !solve->nav->literal && jox_walks(solve->agents, agent);
}
/* Plans one agent with the half-planes given, which it may lower. Returns whether a hard one was
   relaxed. */
bool jox_solve_one(const JoxSolve *solve, uint32_t agent, const JoxHalfPlaneCounts *made,
                   JoxHalfPlane *half_planes, JoxV2 wanted);

typedef struct JoxMove {
    JoxNav *nav;
    JoxAgents *agents;
    const JoxNeighbours *neighbours;
    const JoxObjects *objects;
    const JoxContactPlanes *touched; /* NULL: contacts were not searched for */
    const float *clear2;             /* m2, at the agents' old positions; NULL: unknown */
    float served;                    /* m: walls are known as far as this from the old positions */
    float dt;                        /* s */
    float response, on_the_way;      /* shares of the way to the planned velocity: at the end of the
                                        step; mean over the step */
    float stiffness;                 /* share of an overlap that one sweep removes */
    JoxV2 *position[2];              /* m: before and after a sweep */
    int from;                        /* index of the positions that a sweep reads */
} JoxMove;

/* Returns where walls let a disc of `radius` m get on its way to a point. A way longer than
   `served` is split into pieces; pieces that cross joined edges go on at the other side. */
JoxV2 jox_nav_move_past_walls(const JoxMove *move, JoxV2 from, JoxV2 to, float radius);

#define JOX_STILL_REACH 0.25f /* m: lesser movement counts as standing still */

/* Integrates agents [begin, end): their velocity, prev_x, prev_y, and position[0]. */
typedef void JoxMoveKernel(const JoxMove *move, uint32_t begin, uint32_t end);
/* Writes x, y from position[0], still, still_x, still_y of agents [begin, end). Returns their
   drift. For both, `begin` is a multiple of JOX_LANES. */
typedef JoxDrift JoxSettleKernel(const JoxMove *move, uint32_t begin, uint32_t end);
#define X(name, isa)                                                                               \
    JoxMoveKernel jox_move_integrate_##name;                                                       \
    JoxSettleKernel jox_move_settle_##name;
JOX_ISAS(X)
#undef X

/* Inputs of the walking law in a step (core/walking.md). */
typedef struct JoxWalk {
    JoxNav *nav;
    JoxAgents *agents;
    const JoxNeighbours *neighbours;
    const JoxWalkLaw *law;
    double interval; /* s: since agents planned last */
    /* Random walk of time gaps: the random stream, the moments of the knots before and after the
       present time and of the agents' own draws, and how far time is between the knots, 0 to 1. */
    uint64_t stream, knots[2], own;
    double between;
    float rise, fall, course; /* shares covered in `interval`: eagerness up, down; course */
    float start, stop;        /* shares covered in `interval`: speed up; slowing and turning */
} JoxWalk;

/* Directions that are judged: straight on, and 15 to 75 degrees to the left and right. */
enum { JOX_WALK_DIRECTIONS = 11 };

/* Speed that walls allow in each direction, m/s, by lane; INFINITY without walls. */
typedef struct JoxWalkTable {
    float allowed[JOX_WALK_DIRECTIONS][JOX_LANES];
} JoxWalkTable;

/* Computes aim_x, aim_y of agents [begin, end). Returns how far away walls matter to walkers, m; -1
   without walkers. */
typedef float JoxAimKernel(const JoxWalk *walk, uint32_t begin, uint32_t end);
/* Walks agents [begin, end) that keep a time gap: walk_x, walk_y, course_x, course_y, eager.
   `begin` is a multiple of JOX_LANES. */
typedef void JoxWalkKernel(const JoxWalk *walk, uint32_t begin, uint32_t end);
#define X(name, isa)                                                                               \
    JoxAimKernel jox_walk_aim_##name;                                                              \
    JoxWalkKernel jox_walk_packets_##name;
JOX_ISAS(X)
#undef X

/* Fills one lane of the table with what walls allow one agent. Straight on is left out, as the way
   itself leads around walls. Speeds above the wanted one have no effect. */
typedef void JoxWalkWallsKernel(const JoxWalk *walk, uint32_t agent, uint32_t lane,
                                JoxWalkTable *table);
#define X(name, isa) JoxWalkWallsKernel jox_walk_mind_walls_##name;
JOX_ISAS(X)
#undef X

#endif
