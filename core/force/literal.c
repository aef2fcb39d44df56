/* Literal mode: the terms of the net force as the paper prints them, for the stages push, sum and
   infer; contact/literal_contacts.c has contacts. */
#include "base/assert.h"
#include "force/cones.h"
#include "force/equations.h"

/* m/s: a force that changes a velocity by less in a step counts as rounding */
static const float ROUNDING = 1e-5f;

JoxV2 jox_literal_push_offset(const JoxForces *f, uint32_t pusher, JoxV2 to_centre) {
    const JoxAgents *a = f->step.agents;
    JoxV2 way = {a->vx[pusher], a->vy[pusher]};
    return jox_sub(to_centre, jox_scale(way, (float)f->step.timing.dt));
}

bool jox_literal_under_force(const JoxForces *f, uint32_t i) {
    const JoxAgents *a = f->step.agents;
    float impulse = jox_length(jox_v2(a->force_x[i], a->force_y[i])) * (float)f->step.timing.dt;
    return impulse >= ROUNDING * jox_param(a, JOX_PARAM_mass, i) && isfinite(impulse);
}

/* (11) Returns the velocity before the step plus what the force gives. */
static JoxV2 find_forced_velocity(const JoxForces *f, uint32_t i) {
    const JoxAgents *a = f->step.agents;
    return jox_forced_velocity(jox_velocity_before(f, i), jox_v2(a->force_x[i], a->force_y[i]),
                               jox_param(a, JOX_PARAM_mass, i), 1.0f, (float)f->step.timing.dt);
}

/* (11), (12) Makes the half-plane of the force; the speed limit is raised so that it allows the
   forced velocity. */
static void make_force_plane(JoxForces *f, uint32_t i) {
    JoxAgents *a = f->step.agents;
    if (!jox_literal_under_force(f, i))
        return;
    JoxV2 normal = jox_unit(jox_v2(a->force_x[i], a->force_y[i])),
          forced = find_forced_velocity(f, i);
    JOX_ASSERT(jox_is_unit(normal));
    a->half_plane_x[i] = normal.x;
    a->half_plane_y[i] = normal.y;
    a->half_plane_offset[i] = jox_dot(forced, normal);
    a->speed_limit[i] = jox_maxf(a->speed_limit[i], jox_length(forced));
}

void jox_literal_sum(JoxForces *f, uint32_t i) {
    JoxAgents *a = f->step.agents;
    const JoxV2 force = jox_sum_terms(a, i, JOX_FORCE_ALL); /* (10) */
    a->speed_limit[i] = jox_param(a, JOX_PARAM_max_speed, i);
    a->half_plane_x[i] = a->half_plane_y[i] = a->half_plane_offset[i] = 0.0f;
    a->force_x[i] = force.x;
    a->force_y[i] = force.y;
    const JoxV2 forced = find_forced_velocity(f, i);
    a->forced_x[i] = forced.x;
    a->forced_y[i] = forced.y;
    if (force.x != 0.0f || force.y != 0.0f)
        make_force_plane(f, i);
}

/* (8) Returns whether the change of a velocity points against the new velocity, within the
   angle. */
static bool decelerates(JoxV2 change, JoxV2 velocity, float cosine) {
    return jox_dot(jox_unit(change), jox_unit(velocity)) < -cosine;
}

/* Shares a force among the agents in the cone; without any its giver gets all of it. */
static void share_in_cone(JoxForces *f, uint32_t chunk, uint32_t i, JoxV2 axis, JoxV2 force) {
    uint32_t found = 0;
    if (axis.x != 0.0f || axis.y != 0.0f)
        found = jox_literal_people_in_cone(f, i, jox_unit(axis));
    const uint32_t n = jox_count_found(found);
    while (found)
        jox_transfers_add(f, chunk, i, jox_take_found(f, i, &found),
                          jox_scale(force, 1.0f / (float)n));
    if (!n)
        jox_transfers_add(f, chunk, i, i, force);
}

/* (8), (9) k m dv/dt in the cone about the old velocity, k m (v - v_f)/dt in that about the forced
   one. */
void jox_literal_pass_on(JoxForces *f, uint32_t chunk, uint32_t i) {
    const JoxAgents *a = f->step.agents;
    float size = jox_param(a, JOX_PARAM_absorb, i) * jox_param(a, JOX_PARAM_mass, i) /
                 (float)f->step.timing.dt;
    JoxV2 before = jox_velocity_before(f, i), after = {a->vx[i], a->vy[i]};
    if (!(size > 0.0f))
        return;
    if (jox_literal_under_force(f, i)) {
        JoxV2 forced = find_forced_velocity(f, i), change = jox_sub(after, forced);
        if ((forced.x != 0.0f || forced.y != 0.0f) && jox_length(change) > ROUNDING)
            share_in_cone(f, chunk, i, forced, jox_scale(change, size));
        return;
    }
    JoxV2 change = jox_sub(after, before);
    if (jox_length(change) > ROUNDING &&
        decelerates(change, after, jox_param(a, JOX_PARAM_brace_angle, i)))
        share_in_cone(f, chunk, i, before, jox_scale(change, size));
}
