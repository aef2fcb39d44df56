/* The stage solve: makes every agent's half-planes and picks the best velocity that they allow, by
   the kernel of the run's instruction set. jox_nav_plan does the same for one agent between two
   steps. */
#define JOX_ISA_scalar
#include <assert.h>
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "nav/near/perceive.h"
#include "nav/orca/solve.h"
#include "nav/orca/wish_lanes.h"
#include "nav/step_back_lanes.h"
#include "simd/four.h"

#define X(name, isa) [isa] = jox_solve_packets_##name,
static JoxSolveKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

/* Labels half-planes, which stand in the order of JoxConstraintKind, with their kinds. Returns how
   many. */
static uint32_t label_half_planes(const JoxHalfPlane *half_planes, const JoxHalfPlaneCounts *made,
                                  JoxConstraint out[JOX_MOST_CONSTRAINTS]) {
    const uint32_t hard = made->walls + made->contacts;
    const uint32_t ends[] = {made->walls, hard, hard + made->agents,
                             hard + made->agents + made->objects, UINT32_MAX};
    uint32_t count = ends[3] + made->force, kind = 0;
    for (uint32_t p = 0; p < count; p++) {
        while (p >= ends[kind])
            kind++;
        out[p] =
            (JoxConstraint){(JoxConstraintKind)kind, half_planes[p].normal, half_planes[p].offset};
    }
    return count;
}

uint32_t jox_nav_constraints(const JoxNav *nav, const JoxStep *step, uint32_t agent,
                             JoxConstraint out[JOX_MOST_CONSTRAINTS]) {
    static_assert(JOX_MOST_WALLS + JOX_MOST_CONTACTS + JOX_MOST_NEIGHBOURS + JOX_MOST_OBJECTS + 1 ==
                      JOX_MOST_CONSTRAINTS,
                  "room for all");
    JOX_ASSERT(agent < step->agents->count);
    const JoxSolve solve = {.nav = (JoxNav *)nav, .step = jox_nav_step(step)};
    JoxHalfPlane half_planes[JOX_MOST_CONSTRAINTS];
    const JoxHalfPlaneCounts made = jox_solve_half_planes(&solve, agent, half_planes);
    return label_half_planes(half_planes, &made, out);
}

static void solve_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxSolve *s = context;
    s->nav->chunk_relaxed[begin / JOX_NAV_GRAIN] = KERNELS[s->nav->isa](s, begin, end);
}

/* Returns how far, m, any agent has to look for walls at most: as far as it plans ahead, and as far
   as it can get in a step, thrown or shifted. */
static float find_wall_reach(const JoxAgents *a, float planning_time) {
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    const JoxParameterColumn speed = a->param[JOX_PARAM_max_speed];
    const JoxParameterColumn horizon = a->param[JOX_PARAM_wall_horizon];
    const float *limit = a->speed_limit;
    JoxFour reach = {0.0f};
    uint32_t i = 0;
    for (; i + 4 <= a->count; i += 4) {
        const JoxFour planned = jox_load_four(jox_params(a, JOX_PARAM_wall_horizon, i)) *
                                jox_load_four(jox_params(a, JOX_PARAM_max_speed, i));
        const JoxFour shifted = jox_load_four(limit + i) * planning_time + 0.5f;
        const JoxFour farther = jox_greater_four(planned, shifted);
        reach =
            jox_greater_four(jox_load_four(jox_params(a, JOX_PARAM_radius, i)) + farther, reach);
    }
    float most = jox_greatest_of_four(reach, 0.0f);
    for (; i < a->count; i++)
        most = jox_maxf(most, jox_at(radius, i) + jox_maxf(jox_at(horizon, i) * jox_at(speed, i),
                                                           limit[i] * planning_time + 0.5f));
    return most;
}

uint32_t jox_nav_solve(JoxNav *nav, const JoxStep *step) {
    const JoxTiming *timing = &step->timing;
    const JoxAgents *agents = step->agents;
    JoxSolve solve = {.nav = nav,
                      .step = jox_nav_step(step),
                      .unhidden2 = nav->grid.walls ? nav->unhidden2 : NULL,
                      .aside = jox_stuck_draw_of(timing, JOX_DRAW_ASIDE)};
    if (nav->grid.walls) {
        jox_wall_grid_fit(&nav->grid, find_wall_reach(agents, (float)timing->planning_time));
        jox_nav_find_unhidden(nav, step);
    }
    JOX_CHECK(jox_motions_check(step->neighbours, agents));
    jox_parallel_for(step->pool, agents->count, JOX_NAV_GRAIN, solve_range, &solve);
    uint32_t relaxed = 0;
    for (uint32_t chunk = 0; chunk * JOX_NAV_GRAIN < agents->count; chunk++)
        relaxed += nav->chunk_relaxed[chunk];
    return relaxed;
}

/* ---- one agent, between two steps ---- */

/* The contact planes of one agent, with the indices that the touched agents have now. */
typedef struct Touched {
    JoxContactPlanes all;
    JoxContactPlane planes[JOX_MOST_CONTACTS];
} Touched;

/* Copies the contact planes of agent i, which hold indices of the last step, with the present
   indices. */
static void find_touched(const JoxAgents *a, uint32_t i, const JoxNeighbours *n,
                         const JoxContactPlanes *in_step, Touched *out) {
    const uint32_t was = i + a->index_drop[i];
    *out = (Touched){.all = {.planes = out->planes, .agents = i + 1}};
    JOX_RESERVE_ZEROED(out->all.starts, out->all.starts_capacity, i + 1);
    JOX_RESERVE_ZEROED(out->all.people, out->all.people_capacity, i + 1);
    JOX_RESERVE_ZEROED(out->all.bodies, out->all.bodies_capacity, i + 1);
    if (was >= in_step->agents)
        return;
    out->all.people[i] = in_step->people[was];
    out->all.bodies[i] = in_step->bodies[was];
    for (uint32_t k = 0; k < (uint32_t)in_step->people[was] + in_step->bodies[was]; k++) {
        out->planes[k] = in_step->planes[in_step->starts[was] + k];
        const uint32_t other = out->planes[k].other;
        if (k >= in_step->people[was])
            continue;
        out->planes[k].other = UINT32_MAX; /* until the agent is found again below */
        for (uint32_t m = 0; m < n->count[i]; m++) {
            const uint32_t j = n->index[jox_neighbour_at(n, i, m)];
            if (j + a->index_drop[j] == other)
                out->planes[k].other = j;
        }
    }
}

/* Returns the velocity that one agent wants: wish_lanes.h at width 1. */
static JoxV2 find_wanted_alone(const JoxSolve *s, uint32_t i, const JoxHalfPlaneCounts *made,
                               const JoxHalfPlane *planes) {
    const JoxAgents *a = s->step.agents;
    const JoxWish wish = jox_wish_of(s, i);
    JoxVector wanted = wish.preferred;
    bool kept_off = false;
    for (uint32_t k = made->walls; k < made->walls + made->contacts + made->agents; k++) {
        const JoxVector normal = {planes[k].normal.x, planes[k].normal.y};
        kept_off |= jox_is_kept_off(&wish, normal, planes[k].offset);
    }
    if (jox_solve_walks(s, i))
        wanted = jv_load(a->walk_x, a->walk_y, i);
    else if (wish.may_turn && kept_off)
        wanted = jox_turn_wish(wanted, wish.gets_on ? 0.0f : jox_turn_aside(s, i));
    wanted = jox_add_steps_lanes(a, i, wanted);
    return jox_v2(wanted.x, wanted.y);
}

static void put_shape(JoxAgents *a, uint32_t i, JoxTorsoShape shape) {
    a->axis_x[i] = shape.axis_x;
    a->axis_y[i] = shape.axis_y;
    a->contact_radius[i] = shape.radius;
}

/* Solves for one agent, with its torso as it is now, and restores its columns. */
static void solve_alone(const JoxSolve *s, uint32_t i, JoxPlan *out) {
    JoxAgents *a = s->step.agents;
    const JoxTorsoShape last = {a->axis_x[i], a->axis_y[i], a->contact_radius[i], 0.0f};
    put_shape(a, i, s->step.neighbours->shapes[i]);
    const float x = a->next_x[i], y = a->next_y[i];
    const uint8_t failed = a->failed[i], notes = a->plan_notes[i];
    JoxHalfPlane half_planes[JOX_MOST_CONSTRAINTS];
    const JoxHalfPlaneCounts made = jox_solve_half_planes(s, i, half_planes);
    out->count = label_half_planes(half_planes, &made, out->planes);
    a->failed[i] = 0;
    jox_solve_one(s, i, &made, half_planes, find_wanted_alone(s, i, &made, half_planes));
    out->chosen = jox_v2(a->next_x[i], a->next_y[i]);
    out->failed = a->failed[i];
    a->next_x[i] = x;
    a->next_y[i] = y;
    a->failed[i] = failed;
    a->plan_notes[i] = notes;
    put_shape(a, i, last);
}

void jox_nav_plan(const JoxNav *nav, const JoxStep *step, uint32_t agent, JoxPlan *out) {
    JoxNeighbours neighbours = {0};
    JoxSolve solve = {.nav = (JoxNav *)nav,
                      .step = jox_nav_step(step),
                      .aside = jox_stuck_draw_of(&step->timing, JOX_DRAW_ASIDE)};
    Touched *own = solve.step.touched ? jox_alloc(1, sizeof *own) : NULL;
    JOX_ASSERT(agent < step->agents->count);
    jox_perceive_alone(step->agents, agent, nav->literal, &neighbours);
    solve.step.neighbours = &neighbours;
    if (own) {
        find_touched(step->agents, agent, &neighbours, step->touched, own);
        solve.step.touched = &own->all;
    }
    solve_alone(&solve, agent, out);
    jox_neighbours_free(&neighbours);
    if (own) {
        jox_free(own->all.starts);
        jox_free(own->all.people);
        jox_free(own->all.bodies);
        jox_free(own);
    }
}
