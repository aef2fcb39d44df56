/* The kernels of navigation, one function for each instruction set, and what they share with the
   plain C about them. */
#ifndef JOX_NAV_KERNELS_H
#define JOX_NAV_KERNELS_H

#include "base/number/pi.h"
#include "base/number/random.h"
#include "nav/internal.h"
#include "simd/isa.h"

typedef struct JoxPerceive {
    const JoxNav *nav;
    JoxAgents *agents; /* search, density */
    JoxNeighbours *out;
    float sight; /* m: the farthest that anybody sees; INFINITY: as far as `perception` */
} JoxPerceive;

#define JOX_SEARCH_SLACK 0.03f    /* m: growth of the last search radius that is tried first */
#define JOX_SEARCH_GROWTH 1.5f    /* of a radius that held too few */
#define JOX_SEARCH_LEAST 0.01f    /* m, remembered */
#define JOX_DENSITY_LEAST 0.0025f /* m2: of the squared distance that density is computed from */

/* Agents [begin, end): their neighbours, those who may touch them, `search` and `density`. `begin`
   is a multiple of JOX_LANES. */
typedef void JoxPerceiveKernel(const JoxPerceive *perceive, uint32_t begin, uint32_t end);
#define X(name, isa) JoxPerceiveKernel jox_perceive_packets_##name;
JOX_ISAS(X)
#undef X
/* The same of one agent, whoever is about, searching within `radius` first. */
void jox_perceive_one(const JoxPerceive *perceive, uint32_t agent, float radius);
/* Those within touching range. */
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
    const JoxContactPlanes *touched; /* NULL: contacts were not looked for */
    float planning_time;             /* s */
    bool plans;              /* else those who want to get on go on with what they planned */
    float *clear2;           /* nav's, m2: no wall hides who is nearer; NULL: it is not known */
    uint64_t stream, moment; /* random stream and moment of the draws for turning aside */
} JoxSolve;

/* How far an agent that stands before others turns aside, 0 to 1. Zero for the first second
   without moving JOX_STILL_REACH, then drawn anew each second from a range that widens for four
   seconds more. Always zero as printed. */
static inline float jox_turn_aside(const JoxSolve *s, uint32_t i) {
    const float stood = 0.25f * (s->agents->still[i] - 1.0f);
    if (!(stood > 0.0f) || s->nav->literal)
        return 0.0f;
    const uint64_t bits = jox_random_of(s->stream, s->agents->id[i], 0, s->moment);
    return jox_minf(stood, 1.0f) * (float)jox_random_share(bits);
}
/* How many half-planes of each kind an agent has, in their order, which is that of
   JoxConstraintKind. */
typedef struct JoxHalfPlaneCounts {
    uint32_t walls, contacts, agents, objects, force;
} JoxHalfPlaneCounts;

/* Plans agents [begin, end): next_x, next_y, failed; counts those of whom a hard half-plane was
   relaxed. `begin` is a multiple of JOX_LANES. */
typedef uint32_t JoxSolveKernel(const JoxSolve *solve, uint32_t begin, uint32_t end);
#define X(name, isa) JoxSolveKernel jox_solve_packets_##name;
JOX_ISAS(X)
#undef X

/* In plain C, for one agent: its half-planes of walls, of what it touches, of those of its
   neighbours that it does not pass over, by the walking law or by ORCA, of bodies and of force.
   They return how many. */
uint32_t jox_solve_walls(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);
uint32_t jox_solve_contacts(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);
uint32_t jox_solve_neighbours(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);
uint32_t jox_solve_objects(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);
uint32_t jox_solve_force(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);
/* Whether an agent has no half-plane for a neighbour: it ignores or touches it, or a wall stands
   between them. */
bool jox_solve_passes_over(const JoxSolve *solve, uint32_t agent, uint32_t other);
/* All of them. */
JoxHalfPlaneCounts jox_solve_half_planes(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);
/* Whether it walks by the walking law. */
static inline bool jox_solve_walks(const JoxSolve *solve, uint32_t agent) {
    return !solve->nav->literal && jox_walks(solve->agents, agent);
}
/* Plans an agent of which these are the half-planes, and what it wants; they may be lowered.
   Returns whether a hard one was relaxed. */
bool jox_solve_one(const JoxSolve *solve, uint32_t agent, const JoxHalfPlaneCounts *made,
                   JoxHalfPlane *half_planes, JoxV2 wanted);

typedef struct JoxMove {
    JoxNav *nav;
    JoxAgents *agents;
    const JoxNeighbours *neighbours;
    const JoxObjects *objects;
    const JoxContactPlanes *touched; /* NULL: contacts were not looked for */
    const float *clear2;             /* m2: of where they come from, or NULL */
    float served;                    /* m: walls are known so far from where they come from */
    float dt;                        /* s */
    float response, on_the_way;      /* share of the way to the planned velocity: by the end of the
                                        step, and its mean over the step */
    float stiffness;                 /* share of an overlap removed by one sweep */
    JoxV2 *position[2];              /* m: before a sweep, and behind it */
    int from;                        /* which of them a sweep reads */
} JoxMove;

/* Returns where walls let a disc of `radius` m get on its way to a point. A way that is longer than
   `served` is cut into pieces, and each is moved to within joined edges. */
JoxV2 jox_nav_way(const JoxMove *move, JoxV2 from, JoxV2 to, float radius);

#define JOX_STILL_REACH 0.25f /* m: less than this counts as not having moved */

/* Agents [begin, end): their velocity, prev_x, prev_y, and position[0]. */
typedef void JoxMoveKernel(const JoxMove *move, uint32_t begin, uint32_t end);
/* Agents [begin, end): x, y from position[0], still, still_x, still_y. Returns how they moved.
   `begin` is a multiple of JOX_LANES for both. */
typedef JoxDrift JoxSettleKernel(const JoxMove *move, uint32_t begin, uint32_t end);
#define X(name, isa)                                                                               \
    JoxMoveKernel jox_move_integrate_##name;                                                       \
    JoxSettleKernel jox_move_settle_##name;
JOX_ISAS(X)
#undef X

/* What the walking law needs of a step (core/walking.md). */
typedef struct JoxWalk {
    JoxNav *nav;
    JoxAgents *agents;
    const JoxNeighbours *neighbours;
    const JoxWalkLaw *law;
    double interval; /* s: since people planned last */
    /* Of what time gaps wander by: the random stream, the draws of the knots before and after now,
       and of what people have of their own, and the share of the way between the knots. */
    uint64_t stream, knots[2], own;
    double between;
    float rise, fall, course; /* shares of the way gone in `interval` */
    float start, stop;        /* likewise, of a change of velocity */
} JoxWalk;

/* The directions that are judged: the way, and 15 to 75 degrees to its left and right. */
enum { JOX_WALK_DIRECTIONS = 11 };

/* The speed that walls allow in each direction, m/s, by lane; INFINITY where there are none. */
typedef struct JoxWalkTable {
    float allowed[JOX_WALK_DIRECTIONS][JOX_LANES];
} JoxWalkTable;

/* Agents [begin, end): aim_x, aim_y. Returns how far walls matter to those who walk by the law, m,
   at least 0; -1 where nobody does. */
typedef float JoxAimKernel(const JoxWalk *walk, uint32_t begin, uint32_t end);
/* Agents [begin, end) that walk by the law: walk_x, walk_y, course_x, course_y, eager. `begin` is a
   multiple of JOX_LANES. */
typedef void JoxWalkKernel(const JoxWalk *walk, uint32_t begin, uint32_t end);
#define X(name, isa)                                                                               \
    JoxAimKernel jox_walk_aim_##name;                                                              \
    JoxWalkKernel jox_walk_packets_##name;
JOX_ISAS(X)
#undef X

/* For one agent: what walls allow, in its lane of the table, but for straight on: the way itself
   leads round walls. What is more than the speed wanted is of no account. */
typedef void JoxWalkWallsKernel(const JoxWalk *walk, uint32_t agent, uint32_t lane,
                                JoxWalkTable *table);
#define X(name, isa) JoxWalkWallsKernel jox_walk_mind_walls_##name;
JOX_ISAS(X)
#undef X

#endif
