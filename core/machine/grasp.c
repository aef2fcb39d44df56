/* Holding on to people. The holder pulls the held agent, and is pulled, like an arm that is
   critically damped and whose force is limited to the grip: stronger agents break free. Both get
   the force for one step, as an external force. */
#include <math.h>

#include "base/assert.h"
#include "machine/obstacles.h"
#include "machine/way_between.h"

static const float SLIPS = 1.0f;     /* m: gap at which the hold is lost */
static const float STIFFNESS = 2e3f; /* N/m: stiffness of an arm */
/* Bounds on stiffness and damping, as shares of m / dt2 and m / dt, beyond which an explicit step
   would oscillate. */
static const float STIFF_MOST = 0.12f, DAMPED_MOST = 0.7f;

static float measure_arm_gap(const JoxAgents *a, uint32_t i, uint32_t j) {
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    return jox_length(jox_way_between(a, i, j)) - jox_at(radius, i) - jox_at(radius, j);
}

JoxObstacle jox_find_grasp_obstacle(const JoxMachineRun *run, const JoxState *state, uint32_t i,
                                    JoxSpot *spot) {
    *spot = jox_target_find(run, i, state->grasp);
    if (spot->agent == JOX_NO_INDEX || spot->agent == i)
        return spot->found ? JOX_OBSTACLE_KIND : JOX_OBSTACLE_ABSENT;
    return measure_arm_gap(run->agents, i, spot->agent) <= JOX_GRASP_REACH ? JOX_OBSTACLE_NONE
                                                                           : JOX_OBSTACLE_FAR;
}

/* Returns the agent that i holds: the one it held, else its target if within reach. */
static uint32_t find_held(const JoxMachineRun *run, uint32_t i, const JoxState *state) {
    const JoxAgents *a = run->agents;
    JoxSpot spot;
    if (a->grasped[i]) {
        const uint32_t j = jox_agents_find(a, a->grasped[i] - 1);
        if (j != JOX_NO_INDEX && !a->removed[j] && measure_arm_gap(a, i, j) <= SLIPS)
            return j;
    }
    return jox_find_grasp_obstacle(run, state, i, &spot) == JOX_OBSTACLE_NONE ? spot.agent
                                                                              : JOX_NO_INDEX;
}

static void pull_together(const JoxMachineRun *run, uint32_t i, uint32_t j, float grip) {
    JoxAgents *a = run->agents;
    const JoxParameterColumn mass = a->param[JOX_PARAM_mass];
    const float dt = (float)run->dt;
    const float both = jox_at(mass, i) * jox_at(mass, j) / (jox_at(mass, i) + jox_at(mass, j));
    const JoxV2 way = jox_unit(jox_way_between(a, i, j));
    const float apart = jox_maxf(measure_arm_gap(a, i, j), 0.0f);
    const float parting = way.x * (a->vx[j] - a->vx[i]) + way.y * (a->vy[j] - a->vy[i]);
    const float stiffness = jox_minf(STIFFNESS, STIFF_MOST * both / (dt * dt));
    const float damping = jox_minf(2.0f * sqrtf(stiffness * both), DAMPED_MOST * both / dt);
    const float force = jox_clampf(stiffness * apart + damping * parting, 0.0f, grip);
    JOX_ASSERT(both > 0.0f && force >= 0.0f);
    a->ext_x[i] += force * way.x;
    a->ext_y[i] += force * way.y;
    a->ext_x[j] -= force * way.x;
    a->ext_y[j] -= force * way.y;
}

/* Returns the greatest force of a hold, N. */
static float find_grip(JoxMachineRun *run, uint32_t i, const JoxState *state) {
    if (state->grip.kind == JOX_VALUE_UNSET)
        return JOX_GRIP;
    return (float)jox_action_number(run, jox_machine_of(run, i), JOX_ACTION_GRIP, &state->grip, i);
}

void jox_machines_grasp(JoxMachineRun *run, const uint32_t *agents, uint32_t count) {
    JoxAgents *a = run->agents;
    for (uint32_t n = 0; n < count; n++) {
        const uint32_t i = agents[n];
        const JoxState *state = &jox_machine_of(run, i)->states[a->state[i]];
        const uint32_t j = find_held(run, i, state);
        a->grasped[i] = j == JOX_NO_INDEX ? 0 : a->id[j] + 1;
        if (j == JOX_NO_INDEX)
            continue;
        a->held[j] = (uint8_t)(a->held[j] + (a->held[j] < UINT8_MAX));
        pull_together(run, i, j, find_grip(run, i, state));
    }
}
