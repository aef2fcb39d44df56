/* Preferred velocities on stairs, ramps and escalators: slower by the slope in the direction of
   walking, or as fast as an agent's own speed on stairs; on a running escalator most stand. The end
   of the stage prefer, after which all velocities are in plan. Worlds without flights skip it. */
#include "agents/stair_law.h"
#include "base/number/random.h"
#include "geom/storeys.h"
#include "machine/kernels.h"

static const uint32_t GRAIN = 256;
/* Share of the wanted speed of those who stand on an escalator: they still head onwards, so that
   others keep a time gap to them. */
static const float STANDING = 0.01f;

/* Returns whether an agent stands on an escalator: drawn once for each agent and escalator. */
static bool stands_on(const JoxMachineRun *run, const JoxFlight *flight, uint32_t i) {
    const JoxAgents *a = run->agents;
    if (run->agents->flights->stairs[flight->stair].belt == 0.0f)
        return false;
    const double drawn = jox_random_unit(run->seed, a->id[i], flight->stair, JOX_DRAW_ESCALATOR, 0);
    return drawn >= (double)jox_param(a, JOX_PARAM_escalator_walk, i);
}

/* Returns the share of the level speed at which an agent walks in plan on a flight, in a direction
   whose cosine with the way up is `up`. An own speed on stairs does not hold for ramps, and only as
   far as the way leads along the stair. */
static float find_speed_share(const JoxMachineRun *run, const JoxFlight *flight, uint32_t i,
                              float up) {
    const JoxAgents *a = run->agents;
    const float own = jox_param(a, up > 0.0f ? JOX_PARAM_stair_up : JOX_PARAM_stair_down, i);
    const float level =
        jox_minf(jox_param(a, JOX_PARAM_speed, i), jox_param(a, JOX_PARAM_max_speed, i));
    if (!(own > 0.0f && level > 0.0f) ||
        run->agents->flights->stairs[flight->stair].kind == JOX_STAIR_RAMP)
        return jox_slope_speed(flight->slope * up);
    const float in_plan = own / sqrtf(1.0f + flight->slope * flight->slope);
    return 1.0f + up * up * (in_plan / level - 1.0f);
}

static void slow_on_flight(const JoxMachineRun *run, uint32_t i) {
    JoxAgents *a = run->agents;
    const JoxV2 wanted = {a->pref_x[i], a->pref_y[i]};
    if (a->machine[i] == JOX_NO_MACHINE || !(jox_length2(wanted) > 0.0f))
        return;
    const JoxFlight *flight = jox_flight_at(run->agents->flights, (JoxV2){a->x[i], a->y[i]});
    if (!flight)
        return;
    const float up = jox_dot(jox_unit(wanted), flight->along);
    const float share = stands_on(run, flight, i) ? STANDING : find_speed_share(run, flight, i, up);
    a->pref_x[i] = wanted.x * share;
    a->pref_y[i] = wanted.y * share;
}

static void slow_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxMachineRun *run = context;
    for (uint32_t i = begin; i < end; i++)
        slow_on_flight(run, i);
}

void jox_machines_mind_stairs(JoxMachineRun *run, JoxPool *pool) {
    if (run->agents->flights)
        jox_parallel_for(pool, run->agents->count, GRAIN, slow_range, run);
}
