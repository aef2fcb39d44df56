/* Plain C for one agent of what the kernels sum_wide.c and pass_on_wide.c do for a packet. */
#ifndef TESTS_FORCE_ONE_H
#define TESTS_FORCE_ONE_H

#include <math.h>

#include "base/assert.h"
#include "force/push/pass_on.h"
#include "force/stages/kernels.h"

/* (11) Returns the speed along the unit vector of a force of `size` newtons that the force alone
   would give. The feet wear down motion along the force, but do not slow motion against it: else
   the faintest force from ahead would brake a walker as hard as the feet can. */
static inline float find_forced_speed(JoxV2 velocity, JoxV2 force_unit, float size, float mass,
                                      float decay, float dt) {
    float along = jox_dot(velocity, force_unit);
    return (along > 0.0f ? along * decay : along) + size * dt / mass;
}

/* (8) Returns whether an agent slows down rather than turns: the change of velocity points against
   the mean of both velocities, within an angle with this cosine. The paper prints the new velocity
   instead, which has no direction after a full stop. */
static inline bool does_slow_down(JoxV2 before, JoxV2 after, float cosine) {
    JoxV2 change = jox_sub(after, before), way = jox_add(after, before);
    float against = -jox_dot(change, way); /* |before|^2 - |after|^2 */
    if (!(against > 0.0f))
        return false;
    return cosine <= 0.0f ||
           against * against > cosine * cosine * jox_length2(change) * jox_length2(way);
}

/* (10) Returns the net force, N. */
static JoxV2 plain_sum_terms(const JoxAgents *a, uint32_t i) {
#define PLUS_X(X, keep, role, name, label) +a->name##_x[i]
#define PLUS_Y(X, keep, role, name, label) +a->name##_y[i]
    return (JoxV2){JOX_FORCE_TERMS(PLUS_X, ), JOX_FORCE_TERMS(PLUS_Y, )};
#undef PLUS_X
#undef PLUS_Y
}

/* Returns whether a net force of `size` newtons bounds agent i's plan. Even the faintest contact
   does: otherwise what the feet took of it would be missing from the total momentum; not that of an
   agent which steps back. */
static bool plain_is_felt(const JoxForces *f, uint32_t i, float size) {
    const JoxAgents *a = f->step.agents;
    bool touched = a->contact_x[i] != 0.0f || a->contact_y[i] != 0.0f;
    float least = touched && !jox_steps_back(a, i) ? 1e-6f : f->options.least;
    return size >= least * jox_param(a, JOX_PARAM_mass, i) && isfinite(size);
}

/* (11), (12): writes the half-plane of the force, and the speed limit of this step. By the end of
   the step the velocity has the part along the force that (11) gives; the step goes the share
   `response` of the way from the forced velocity to the planned one. */
static void plain_bound_by_force(JoxAgents *a, uint32_t i, JoxV2 force, JoxV2 moving, float decay,
                                 JoxPlanning plan, float step) {
    float size = jox_length(force), mass = jox_param(a, JOX_PARAM_mass, i);
    float most = jox_param(a, JOX_PARAM_max_speed, i);
    JoxV2 velocity = {a->vx[i], a->vy[i]}, contact = {a->contact_x[i], a->contact_y[i]};
    JoxV2 solved = jox_sum_terms(a, i, JOX_FORCE_CONTACT | JOX_FORCE_GROUND);
    JoxV2 normal = jox_scale(force, 1.0f / size);
    JOX_ASSERT(mass > 0.0f && decay <= 1.0f);
    JOX_ASSERT(jox_is_unit(normal));
    float wanted = find_forced_speed(velocity, normal, size, mass, decay, plan.interval);
    float pressed = jox_dot(solved, normal) / mass, driven = jox_dot(moving, normal) / mass;
    /* Contacts act within this step only, however long the plan is kept. */
    wanted -= pressed * (plan.interval - step);
    float moved = jox_dot(velocity, normal) + pressed * step + driven * plan.forced;
    a->half_plane_x[i] = normal.x;
    a->half_plane_y[i] = normal.y;
    a->half_plane_offset[i] = moved + (wanted - moved) / plan.response;
    if (contact.x == 0.0f && contact.y == 0.0f)
        return;
    /* Only contacts may carry an agent faster than its greatest speed. */
    a->speed_limit[i] = jox_maxf(most, jox_length((JoxV2){a->forced_x[i], a->forced_y[i]}));
}

/* Returns the part of others' pushes that an agent's feet do not hold, N. */
static inline JoxV2 find_unheld_pushes(const JoxAgents *a, uint32_t i) {
    JoxV2 others = jox_sum_terms(a, i, JOX_FORCE_BRACED);
    float size = jox_length(others),
          held = jox_stands(a, i) ? 0.0f : jox_param(a, JOX_PARAM_brace, i);
    return jox_scale(others, size > held ? (size - held) / size : 0.0f);
}

/* Returns the force that moves an agent before contacts are solved, N: the free terms, plus the
   pushes of others that its feet do not hold. */
static inline JoxV2 find_moving_force(const JoxAgents *a, uint32_t i) {
    return jox_add(jox_sum_terms(a, i, JOX_FORCE_FREE), find_unheld_pushes(a, i));
}

/* (10) to (12) for agent i. `decay`: cached from the agent before. */
static void plain_sum_one(JoxForces *f, uint32_t i, JoxDecay *decay) {
    JoxAgents *a = f->step.agents;
    const float dt = (float)f->step.timing.dt, mass = jox_param(a, JOX_PARAM_mass, i);
    a->speed_limit[i] = jox_param(a, JOX_PARAM_max_speed, i);
    a->half_plane_x[i] = a->half_plane_y[i] = a->half_plane_offset[i] = 0.0f;
    JoxV2 force = plain_sum_terms(a, i);
    a->force_x[i] = force.x;
    a->force_y[i] = force.y;
    JoxV2 moving = find_moving_force(a, i);
    const JoxV2 given = jox_add(moving, jox_sum_terms(a, i, JOX_FORCE_CONTACT | JOX_FORCE_GROUND));
    a->forced_x[i] = a->vx[i] + given.x * dt / mass;
    a->forced_y[i] = a->vy[i] + given.y * dt / mass;
    if ((force.x == 0.0f && force.y == 0.0f) || !plain_is_felt(f, i, jox_length(force)))
        return;
    const JoxPlanning plan = jox_planning(&f->step.timing, jox_stands(a, i));
    const float worn = jox_decay(decay, jox_param(a, JOX_PARAM_damping, i), plan.interval);
    plain_bound_by_force(a, i, force, moving, worn, plan, dt);
}

/* (9) Returns by how much the feet keep agent i, in this step, below the velocity along a unit
   vector that the force would give, m/s: the part of others' pushes that they hold, and what they
   take from the forced velocity, minus what they wear down anyway. It adds up step by step, so that
   neither the step nor the length of a plan changes it. */
static float plain_shortfall(const JoxForces *f, uint32_t i, JoxV2 unit, JoxDecay *decay) {
    const JoxAgents *a = f->step.agents;
    const float dt = (float)f->step.timing.dt, response = (float)f->step.timing.response;
    float inverse_mass = 1.0f / jox_param(a, JOX_PARAM_mass, i);
    float damping = jox_param(a, JOX_PARAM_damping, i);
    JoxV2 others = jox_sum_terms(a, i, JOX_FORCE_BRACED);
    JoxV2 held = jox_sub(others, find_unheld_pushes(a, i));
    JoxV2 taken = {a->forced_x[i] - a->next_x[i], a->forced_y[i] - a->next_y[i]};
    float along = jox_maxf(0.0f, jox_dot(jox_velocity_before(f, i), unit));
    float worn = along * (1.0f - jox_decay(decay, damping, dt));
    return jox_dot(held, unit) * dt * inverse_mass + jox_dot(taken, unit) * response - worn;
}

static bool plain_is_under_force(const JoxAgents *a, uint32_t i) {
    return a->half_plane_x[i] != 0.0f || a->half_plane_y[i] != 0.0f;
}

/* (8) Returns whether an agent under no force slowed down enough for others to feel. */
static bool plain_slows_down(const JoxForces *f, uint32_t i) {
    const JoxAgents *a = f->step.agents;
    const float absorb = jox_param(a, JOX_PARAM_absorb, i), dt = (float)f->step.timing.dt;
    /* Only what the feet took counts: contacts and other forces have acted on others already. */
    JoxV2 before = {a->forced_x[i], a->forced_y[i]}, after = {a->vx[i], a->vy[i]};
    const JoxV2 old = jox_velocity_before(f, i);
    return (old.x != 0.0f || old.y != 0.0f) && absorb > 0.0f &&
           does_slow_down(before, after, jox_param(a, JOX_PARAM_brace_angle, i)) &&
           jox_length(jox_slowing(before, after)) * absorb >= f->options.least * dt;
}

static JoxPassKind plain_pass_kind(const JoxForces *f, uint32_t i, JoxDecay *decay,
                                   float *shortfall) {
    const JoxAgents *a = f->step.agents;
    *shortfall = 0.0f;
    if (!plain_is_under_force(a, i))
        return plain_slows_down(f, i) ? JOX_PASSES_DECELERATION : JOX_PASSES_NOTHING;
    *shortfall = plain_shortfall(f, i, (JoxV2){a->half_plane_x[i], a->half_plane_y[i]}, decay);
    return *shortfall > JOX_SHORTFALL_LEAST && jox_param(a, JOX_PARAM_absorb, i) > 0.0f
               ? JOX_PASSES_RESISTANCE
               : JOX_PASSES_NOTHING;
}

#endif
