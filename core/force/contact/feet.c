/* Feet of agents that stand: until they step they hold a force sideways, as friction holds a load,
   up to that at which the weight is over one foot. Solved together with the contacts (solve.c):
   what presses a row of people is far more than what would move one of them aside. */
#include "force/contact/contacts.h"

/* m/s2: gravity by the height of an agent's mass above the ground, 1 m, as in world/falls.c. */
static const float PER_STANCE = 9.81f;

static bool may_hold(const JoxForces *f, uint32_t i) {
    const JoxAgents *a = f->step.agents;
    return jox_stands(a, i) && jox_param(a, JOX_PARAM_stance, i) > 0.0f && !(a->fallen[i] > 0.0f);
}

/* Returns whether a force or a contact acts on agent i. */
static bool is_acted_on(const JoxForces *f, uint32_t i) {
    const JoxV2 force = jox_sum_terms(f->step.agents, i, JOX_FORCE_FREE | JOX_FORCE_BRACED);
    return force.x != 0.0f || force.y != 0.0f || f->contacts->found.wall_count[i] ||
           !jox_have_no_contacts(f->contacts, i, i + 1);
}

bool jox_feet_matter(const JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    return !f->options.literal && a->count && jox_param_greatest(a, JOX_PARAM_stance) > 0.0f;
}

void jox_feet_list(JoxForces *f) {
    JoxFeet *feet = &f->contacts->feet;
    const JoxAgents *a = f->step.agents;
    feet->count = 0;
    if (!jox_feet_matter(f))
        return;
    JOX_RESERVE(feet->items, feet->capacity, a->count);
    for (uint32_t i = 0; i < a->count; i++) {
        if (!may_hold(f, i) || !is_acted_on(f, i))
            continue;
        const float mass = jox_param(a, JOX_PARAM_mass, i);
        const float newtons = mass * PER_STANCE * jox_param(a, JOX_PARAM_stance, i);
        const JoxV2 side = jox_left((JoxV2){a->chest_x[i], a->chest_y[i]});
        const float speed = jox_dot((JoxV2){a->vx[i], a->vy[i]}, side);
        if (!isfinite(speed))
            continue; /* the step reports it at the end; it must not spread to others */
        feet->items[feet->count++] = (JoxFoothold){.agent = i,
                                                   .side = side,
                                                   .least_speed = jox_minf(0.0f, speed),
                                                   .most_speed = jox_maxf(0.0f, speed),
                                                   .mass = mass,
                                                   .most = newtons * (float)f->step.timing.dt};
    }
}

float jox_feet_solve_once(JoxForces *f, uint32_t begin, uint32_t end) {
    float most = 0.0f;
    for (uint32_t k = begin; k < end; k++) {
        JoxFoothold *foot = &f->contacts->feet.items[k];
        JoxContactMotion *motion = &f->contacts->solve.motions[foot->agent];
        const float last = foot->impulse;
        const float speed = jox_speed_along(motion, foot->side, 0.0f) - last / foot->mass;
        const float held = jox_clampf(speed, foot->least_speed, foot->most_speed);
        foot->impulse = jox_clampf((held - speed) * foot->mass, -foot->most, foot->most);
        jox_add_impulse(motion, foot->side, 0.0f, foot->impulse - last);
        most = jox_maxf(most, fabsf(foot->impulse - last));
    }
    return most;
}

void jox_feet_write_forces(JoxForces *f) {
    const JoxFeet *feet = &f->contacts->feet;
    JoxAgents *a = f->step.agents;
    const float per_second = 1.0f / (float)f->step.timing.dt;
    for (uint32_t k = 0; k < feet->count; k++) {
        const JoxFoothold *foot = &feet->items[k];
        a->feet_x[foot->agent] = foot->side.x * foot->impulse * per_second;
        a->feet_y[foot->agent] = foot->side.y * foot->impulse * per_second;
    }
}
