/* Escalators in the stage move: a running belt carries agents along. That is no motion of their own
   nor one by others: velocities, contacts and displacements leave it out. */
#include "geom/storeys.h"
#include "nav/move/move.h"

static const uint32_t GRAIN = 256;

/* Returns how far a belt carries who is at a position within dt seconds, m in plan. */
static JoxV2 find_carry(const JoxStoreys *flights, JoxV2 at, float dt) {
    const JoxFlight *flight = jox_flight_at(flights, at);
    const float belt = flight ? flights->stairs[flight->stair].belt : 0.0f;
    if (belt == 0.0f)
        return (JoxV2){0.0f, 0.0f};
    const float in_plan = belt / sqrtf(1.0f + flight->slope * flight->slope);
    return jox_scale(flight->along, in_plan * dt);
}

static void carry_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxMove *m = context;
    const JoxAgents *a = m->step.agents;
    for (uint32_t i = begin; i < end; i++) {
        m->carried[i] =
            find_carry(a->flights, (JoxV2){a->prev_x[i], a->prev_y[i]}, (float)m->step.timing.dt);
        m->position[0][i] = jox_add(m->position[0][i], m->carried[i]);
    }
}

bool jox_nav_has_belts(const JoxAgents *agents) {
    const JoxStoreys *s = agents->flights;
    for (uint32_t k = 0; s && k < s->stair_count; k++)
        if (s->stairs[k].belt != 0.0f)
            return true;
    return false;
}

void jox_nav_carry(JoxMove *move) {
    jox_parallel_for(move->step.pool, move->step.agents->count, GRAIN, carry_range, move);
}
