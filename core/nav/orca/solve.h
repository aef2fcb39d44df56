/* The stage solve: its kernel for each instruction set, which solve.c calls for chunks of agents on
   several threads; the half-planes and the linear program of one agent. */
#ifndef JOX_NAV_ORCA_SOLVE_H
#define JOX_NAV_ORCA_SOLVE_H

#include "base/number/random.h"
#include "nav/nav_state.h"
#include "simd/isa.h"

/* How far an agent that stands before others turns its preferred velocity aside, as shares of its
   length: JOX_ASIDE_RIGHT_FIRST to the right at first; when it has not moved for some seconds, up
   to JOX_ASIDE_RIGHT_STUCK more to the right and JOX_ASIDE_BACK_STUCK less ahead. Symmetric crowds
   lock in an arch that all agents have to leave at different angles. */
#define JOX_ASIDE_RIGHT_FIRST 0.25f
#define JOX_ASIDE_RIGHT_STUCK 1.0f
#define JOX_ASIDE_BACK_STUCK 1.2f

enum {
    JOX_MOST_WALLS = 16,
    JOX_MOST_OBJECTS = 24,
    JOX_MOST_CONTACTS = JOX_MOST_TOUCHED + JOX_MOST_BODIES_TOUCHED
};

typedef struct JoxSolve {
    JoxNav *nav;
    JoxStep step; /* with contact planes of this step or NULL */
    const float
        *unhidden2;     /* m2, nav's: no wall hides neighbours nearer than this; NULL: unknown */
    JoxStuckDraw aside; /* of turning aside */
} JoxSolve;

/* Returns how far an agent that stands before others turns aside, 0 to 1. */
static inline float jox_turn_aside(const JoxSolve *s, uint32_t i) {
    const JoxAgents *a = s->step.agents;
    return jox_draw_of_stuck(&s->aside, a->id[i], a->still[i], 0.0f);
}
/* Numbers of an agent's half-planes by kind, in the order of JoxConstraintKind and of the list. */
typedef struct JoxHalfPlaneCounts {
    uint32_t walls, contacts, agents, objects, force;
} JoxHalfPlaneCounts;

/* Plans agents [begin, end): next_x, next_y, failed, plan_notes. Returns how many had a hard
   half-plane relaxed. `begin` is a multiple of JOX_LANES. */
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
    return !solve->nav->literal && jox_walks(solve->step.agents, agent);
}
/* Plans one agent with the half-planes given, which it may lower. Returns whether a hard one was
   relaxed. */
bool jox_solve_one(const JoxSolve *solve, uint32_t agent, const JoxHalfPlaneCounts *made,
                   JoxHalfPlane *half_planes, JoxV2 wanted);

/* Makes the half-plane of ORCA (van den Berg et al. 2011) for another agent at relative position p
   (m), with relative velocity v = own - other (m/s), sum of radii R (m), horizon tau (s), own
   velocity and the share of the correction that the agent takes. Overlapping discs part within dt
   (s), along `away` where the centres coincide. */
JoxHalfPlane jox_orca_half_plane(JoxV2 p, JoxV2 v, float radius, float tau, float dt, JoxV2 own,
                                 float share, JoxV2 away);
/* The shape of an agent towards walls: torso, and the distance that it keeps by its own will, m. */
typedef struct JoxWallShape {
    JoxV2 axis;
    float radius, keeps;
} JoxWallShape;

/* Makes the half-planes of the wall edges near an agent; returns how many, at most `most`. tau:
   horizon, s; range: m. */
uint32_t jox_orca_walls(const JoxWallGrid *grid, JoxV2 position, JoxV2 velocity,
                        const JoxWallShape *shape, float tau, float range, JoxHalfPlane *out,
                        uint32_t most);
/* Makes the half-planes of the bodies that an agent avoids, except those that it touches; returns
   how many, at most `most`. */
uint32_t jox_orca_objects(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out, uint32_t most);

/* Finds the velocity of at most `speed_limit` that is nearest to `wanted` and meets all
   half-planes, of which the first `hard` are hard. Returns true if there is one. Otherwise
   *velocity minimises the greatest violation of the soft half-planes while the hard ones hold, and
   *relaxed tells whether even hard ones had to be violated. `stands`: of an agent that wants to
   stand. */
bool jox_linear_program_solve(const JoxHalfPlane *half_planes, uint32_t count, uint32_t hard,
                              float speed_limit, JoxV2 wanted, bool stands, JoxV2 *velocity,
                              bool *relaxed);

#endif
