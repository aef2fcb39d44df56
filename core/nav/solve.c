/* The stage solve: every agent's half-planes, and the best velocity that they leave, by the kernel
   of the run's instruction set. */
#include <assert.h>
#include <math.h>

#include "base/assert.h"
#include "nav/kernels.h"

#define X(name, isa) [isa] = jox_solve_packets_##name,
static JoxSolveKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static const JoxContactPlanes *in_force(const JoxContactPlanes *touched) {
    return touched && touched->agents ? touched : NULL;
}

uint32_t jox_nav_constraints(const JoxNav *nav, const JoxAgents *agents,
                             const JoxNeighbours *neighbours, const JoxObjects *objects,
                             const JoxContactPlanes *touched, double planning_time, uint32_t agent,
                             JoxConstraint out[JOX_MOST_CONSTRAINTS]) {
    static_assert(JOX_MOST_WALLS + JOX_MOST_CONTACTS + JOX_MOST_NEIGHBOURS + JOX_MOST_OBJECTS + 1 ==
                      JOX_MOST_CONSTRAINTS,
                  "room for all");
    JOX_ASSERT(agent < agents->count);
    const JoxSolve solve = {(JoxNav *)nav,     (JoxAgents *)agents,  neighbours, objects,
                            in_force(touched), (float)planning_time, true};
    JoxHalfPlane half_planes[JOX_MOST_CONSTRAINTS];
    JoxHalfPlaneCounts made = jox_solve_half_planes(&solve, agent, half_planes);
    const uint32_t hard = made.walls + made.contacts;
    const uint32_t ends[] = {made.walls, hard, hard + made.agents,
                             hard + made.agents + made.objects, UINT32_MAX};
    uint32_t count = ends[3] + made.force, kind = 0;
    for (uint32_t p = 0; p < count; p++) {
        while (p >= ends[kind])
            kind++;
        out[p] =
            (JoxConstraint){(JoxConstraintKind)kind, half_planes[p].normal, half_planes[p].offset};
    }
    return count;
}

static void solve_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxSolve *s = context;
    s->nav->chunk_relaxed[begin / JOX_NAV_GRAIN] = KERNELS[s->nav->isa](s, begin, end);
}

/* One record an agent, for those who look at many others. */
static void record_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxSolve *s = context;
    const JoxAgents *a = s->agents;
    for (uint32_t i = begin; i < end; i++)
        s->nav->records[i] = (JoxRecord){a->x[i], a->y[i], a->vx[i], a->vy[i]};
}

/* The farthest that any agent may have to look for walls, m: as far as it plans ahead, and as far
   as it can get in a step, thrown or shifted. */
static float wall_reach(const JoxAgents *a, float planning_time) {
    float reach = 0.0f;
    for (uint32_t i = 0; i < a->count; i++) {
        float radius = a->param[JOX_PARAM_radius][i];
        float planned = a->param[JOX_PARAM_wall_horizon][i] * a->param[JOX_PARAM_max_speed][i];
        reach =
            jox_maxf(reach, radius + jox_maxf(planned, a->speed_limit[i] * planning_time + 0.5f));
    }
    return reach;
}

uint32_t jox_nav_solve(JoxNav *nav, JoxAgents *agents, const JoxNeighbours *neighbours,
                       const JoxObjects *objects, const JoxContactPlanes *touched,
                       double planning_time, bool plans, JoxPool *pool) {
    JoxSolve solve = {nav,  agents, neighbours, objects, in_force(touched), (float)planning_time,
                      plans};
    if (nav->grid.walls)
        jox_wall_grid_fit(&nav->grid, wall_reach(agents, (float)planning_time));
    jox_parallel_for(pool, agents->count, JOX_NAV_GRAIN, record_range, &solve);
    jox_parallel_for(pool, agents->count, JOX_NAV_GRAIN, solve_range, &solve);
    uint32_t relaxed = 0;
    for (uint32_t chunk = 0; chunk * JOX_NAV_GRAIN < agents->count; chunk++)
        relaxed += nav->chunk_relaxed[chunk];
    return relaxed;
}
