/* Equations 10 to 12. */
#include <math.h>

#include "base/assert.h"
#include "force/equations.h"
#include "force/kernels.h"

#define X(name, isa) [isa] = jox_sum_packets_##name,
static JoxSumKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

/* (11), (12): the half-plane of the force, and the speed limit of this step. By the end of the step
   the velocity is to have the part along the force that (11) says; it goes the share `response` of
   the way from what the force gives to what is planned. */
static void bound_by_force(JoxAgents *a, uint32_t i, JoxV2 force, JoxV2 moving, float decay,
                           JoxPlanning plan, float step) {
    float size = jox_length(force), mass = jox_param(a, JOX_PARAM_mass, i);
    float most = jox_param(a, JOX_PARAM_max_speed, i);
    JoxV2 velocity = {a->vx[i], a->vy[i]}, contact = {a->contact_x[i], a->contact_y[i]};
    JoxV2 normal = jox_scale(force, 1.0f / size);
    JOX_ASSERT(mass > 0.0f && decay <= 1.0f);
    JOX_ASSERT(jox_is_unit(normal));
    float wanted = jox_forced_speed(velocity, normal, size, mass, decay, plan.interval);
    float pressed = jox_dot(contact, normal) / mass, driven = jox_dot(moving, normal) / mass;
    /* Contacts act within this step, however long the plan is kept. */
    wanted -= pressed * (plan.interval - step);
    float moved = jox_dot(velocity, normal) + pressed * step + driven * plan.forced;
    a->half_plane_x[i] = normal.x;
    a->half_plane_y[i] = normal.y;
    a->half_plane_offset[i] = moved + (wanted - moved) / plan.response;
    if (contact.x == 0.0f && contact.y == 0.0f)
        return;
    /* Being hit or squeezed may carry someone faster than they can go; nothing else may. */
    a->speed_limit[i] = jox_maxf(most, jox_length((JoxV2){a->forced_x[i], a->forced_y[i]}));
}

/* (10) The net force. */
static inline JoxV2 sum_of_terms(const JoxAgents *a, uint32_t i) {
#define PLUS_X(X, keep, name, label) +a->name##_x[i]
#define PLUS_Y(X, keep, name, label) +a->name##_y[i]
    return (JoxV2){JOX_FORCE_TERMS(PLUS_X, ), JOX_FORCE_TERMS(PLUS_Y, )};
#undef PLUS_X
#undef PLUS_Y
}

/* Whether a net force of `size` newtons bounds agent i's plan. The faintest contact does: what the
   feet took of it would be missing from the momentum of all. */
static bool is_felt(const JoxForces *f, uint32_t i, float size) {
    const JoxAgents *a = f->step.agents;
    bool touched = a->contact_x[i] != 0.0f || a->contact_y[i] != 0.0f;
    float least = touched ? 1e-6f : f->options.least;
    return size >= least * jox_param(a, JOX_PARAM_mass, i) && isfinite(size);
}

void jox_sum_one(JoxForces *f, uint32_t i, JoxDecay *decay) {
    JoxAgents *a = f->step.agents;
    const JoxParameterColumn mass = a->param[JOX_PARAM_mass];
    const float dt = (float)f->step.dt;
    a->speed_limit[i] = jox_param(a, JOX_PARAM_max_speed, i);
    a->half_plane_x[i] = a->half_plane_y[i] = a->half_plane_offset[i] = 0.0f;
    JoxV2 force = sum_of_terms(a, i);
    a->force_x[i] = force.x;
    a->force_y[i] = force.y;
    JoxV2 moving = jox_moving_force(a, i);
    a->forced_x[i] = a->vx[i] + (moving.x + a->contact_x[i]) * dt / jox_at(mass, i);
    a->forced_y[i] = a->vy[i] + (moving.y + a->contact_y[i]) * dt / jox_at(mass, i);
    if (force.x == 0.0f && force.y == 0.0f)
        return;
    float size = jox_length(force);
    const JoxPlanning plan = jox_planning(&f->step, jox_stands(a, i));
    if (f->options.literal)
        jox_literal_bound(f, i);
    else if (is_felt(f, i, size))
        bound_by_force(a, i, force, moving,
                       jox_decay(decay, jox_param(a, JOX_PARAM_damping, i), plan.interval), plan,
                       dt);
}

/* Whole packets by the kernel of the run's instruction set. As printed, each by itself. */
static void sum_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    JoxDecay decay = f->decay;
    const uint32_t whole = f->options.literal ? begin : end - (end - begin) % JOX_LANES;
    if (whole > begin)
        KERNELS[f->isa](f, begin, whole);
    for (uint32_t i = whole; i < end; i++)
        jox_sum_one(f, i, &decay);
}

void jox_force_sum(JoxForces *f) {
    jox_parallel_for(f->step.pool, f->step.agents->count, JOX_FORCE_GRAIN, sum_chunk, f);
    jox_contact_planes_make(f);
}
