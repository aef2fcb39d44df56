/* Equations 10 to 12, and what braced and slowing people pass on: equations 8 and 9. */
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
    float size = jox_length(force), mass = a->param[JOX_PARAM_mass][i];
    float most = a->param[JOX_PARAM_max_speed][i];
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
    return size >= least * a->param[JOX_PARAM_mass][i] && isfinite(size);
}

void jox_sum_one(JoxForces *f, uint32_t i, JoxDecay *decay) {
    JoxAgents *a = f->step.agents;
    const float *mass = a->param[JOX_PARAM_mass], dt = (float)f->step.dt;
    f->old_x[i] = a->vx[i];
    f->old_y[i] = a->vy[i];
    a->speed_limit[i] = a->param[JOX_PARAM_max_speed][i];
    a->half_plane_x[i] = a->half_plane_y[i] = a->half_plane_offset[i] = 0.0f;
    JoxV2 force = sum_of_terms(a, i);
    a->force_x[i] = force.x;
    a->force_y[i] = force.y;
    JoxV2 moving = jox_moving_force(a, i);
    a->forced_x[i] = a->vx[i] + (moving.x + a->contact_x[i]) * dt / mass[i];
    a->forced_y[i] = a->vy[i] + (moving.y + a->contact_y[i]) * dt / mass[i];
    if (force.x == 0.0f && force.y == 0.0f)
        return;
    float size = jox_length(force);
    const JoxPlanning plan = jox_planning(&f->step, jox_stands(a, i));
    if (f->options.literal)
        jox_literal_bound(f, i);
    else if (is_felt(f, i, size))
        bound_by_force(a, i, force, moving,
                       jox_decay(decay, a->param[JOX_PARAM_damping][i], plan.interval), plan, dt);
}

/* Whole packets by the kernel of the run's instruction set. As printed, each by itself. */
static void sum_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    JoxDecay decay = {-1.0f, 0.0f, 0.0f};
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

/* (9) By how much the feet keep agent i, in this step, below where the force along a unit vector
   would take them, m/s: what they hold of others' pushes, and what they take of the velocity that
   forces give, less what they wear down in any case. Counted step by step, it is the same at any
   step and however long a plan is kept. */
static float shortfall_of(const JoxForces *f, uint32_t i, JoxV2 unit, JoxDecay *decay) {
    const JoxAgents *a = f->step.agents;
    const float dt = (float)f->step.dt, response = (float)f->step.response;
    float lightness = 1.0f / a->param[JOX_PARAM_mass][i];
    float damping = a->param[JOX_PARAM_damping][i];
    JoxV2 others = {a->push_x[i] + a->inferred_x[i], a->push_y[i] + a->inferred_y[i]};
    JoxV2 held = jox_sub(others, jox_unheld_pushes(a, i));
    JoxV2 taken = {a->forced_x[i] - a->next_x[i], a->forced_y[i] - a->next_y[i]};
    float along = jox_maxf(0.0f, f->old_x[i] * unit.x + f->old_y[i] * unit.y);
    float worn = along * (1.0f - jox_decay(decay, damping, dt));
    return jox_dot(held, unit) * dt * lightness + jox_dot(taken, unit) * response - worn;
}

/* (9) Someone under force who falls short of where it would take them. */
static void pass_resistance(JoxForces *f, uint32_t chunk, uint32_t i, JoxDecay *decay) {
    const JoxAgents *a = f->step.agents;
    JoxV2 unit = {a->half_plane_x[i], a->half_plane_y[i]};
    float shortfall = shortfall_of(f, i, unit, decay), absorb = a->param[JOX_PARAM_absorb][i];
    if (!(shortfall > 1e-6f) || !(absorb > 0.0f))
        return;
    uint32_t found[JOX_MOST_NEIGHBOURS], n = jox_people_in_cone(f, i, unit, found);
    for (uint32_t k = 0; k < n; k++)
        jox_transfer_give(f, chunk, i, found[k],
                          jox_resistance(unit, shortfall, absorb, a->param[JOX_PARAM_mass][i], n,
                                         (float)f->step.dt));
}

/* Share of a force that agent `to` takes of someone who slowed down and lost `energy` (J) by that:
   who is faster already, or soon will be, is not driven by more than was lost. */
static float share_taken(const JoxForces *f, uint32_t to, JoxV2 force, float energy) {
    const JoxAgents *a = f->step.agents;
    float size = jox_length(force), mass = a->param[JOX_PARAM_mass][to];
    if (!(size > 0.0f))
        return 0.0f;
    JoxV2 direction = jox_scale(force, 1.0f / size);
    JoxV2 coming =
        jox_scale((JoxV2){a->inferred_x[to], a->inferred_y[to]}, f->options.filter / mass);
    float speed = jox_dot((JoxV2){a->vx[to], a->vy[to]}, direction) +
                  jox_maxf(0.0f, jox_dot(coming, direction));
    return jox_share_within_energy(size * (float)f->step.dt, mass, speed, energy);
}

/* (8) Someone under no force who slowed down. */
static void pass_deceleration(JoxForces *f, uint32_t chunk, uint32_t i) {
    const JoxAgents *a = f->step.agents;
    float dt = (float)f->step.dt, mass = a->param[JOX_PARAM_mass][i];
    float absorb = a->param[JOX_PARAM_absorb][i];
    /* What the feet took: contacts and other forces have their share already. */
    JoxV2 before = {a->forced_x[i], a->forced_y[i]}, after = {a->vx[i], a->vy[i]};
    if (!(absorb > 0.0f) || !jox_slows(before, after, a->param[JOX_PARAM_brace_angle][i]))
        return;
    JoxV2 change = jox_slowing(before, after);
    if (!(jox_length(change) * absorb >= f->options.least * dt))
        return; /* no one would feel it */
    uint32_t found[JOX_MOST_NEIGHBOURS], n = jox_people_in_cone(f, i, jox_unit(before), found);
    JoxV2 given = jox_deceleration(change, absorb, mass, n > 0 ? n : 1, dt);
    float lost = 0.5f * mass * (jox_length2(before) - jox_length2(after));
    for (uint32_t k = 0; k < n; k++) {
        float share = share_taken(f, found[k], given, absorb * lost / (float)n);
        jox_transfer_give(f, chunk, i, found[k], jox_scale(given, share));
    }
    if (n || jox_stands(a, i))
        return; /* who wants to stand brakes as they plan: nothing carries them on */
    jox_transfer_give(f, chunk, i, i,
                      jox_keep_from_reversing(given, after, mass, (float)f->step.planning_time));
}

static void infer_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const JoxAgents *a = f->step.agents;
    uint32_t chunk = begin / JOX_FORCE_GRAIN;
    JoxDecay decay = {-1.0f, 0.0f, 0.0f};
    for (uint32_t i = begin; i < end; i++) {
        if (f->options.literal)
            jox_literal_pass_on(f, chunk, i);
        else if (a->half_plane_x[i] != 0.0f || a->half_plane_y[i] != 0.0f)
            pass_resistance(f, chunk, i, &decay);
        else if (f->old_x[i] != 0.0f || f->old_y[i] != 0.0f)
            pass_deceleration(f, chunk, i);
    }
}

static void fade_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    JoxAgents *a = f->step.agents;
    float kept =
        1.0f - (f->options.literal ? 1.0f : jox_filter_share(f->step.dt, f->options.filter));
    for (uint32_t i = begin; i < end; i++) {
        if (a->inferred_x[i] == 0.0f && a->inferred_y[i] == 0.0f)
            continue;
        a->inferred_x[i] *= kept;
        a->inferred_y[i] *= kept;
        /* What is left of a force after seconds is nothing, and slow to compute with. */
        if (fabsf(a->inferred_x[i]) + fabsf(a->inferred_y[i]) < 1e-6f)
            a->inferred_x[i] = a->inferred_y[i] = 0.0f;
    }
}

static void scale_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    float share = f->options.literal ? 1.0f : jox_filter_share(f->step.dt, f->options.filter);
    JOX_ASSERT(share > 0.0f && share <= 1.0f);
    JoxTransfer *sorted = f->sorted;
    for (uint32_t i = f->starts[begin]; i < f->starts[end]; i++) {
        sorted[i].x *= share;
        sorted[i].y *= share;
    }
}

void jox_force_infer(JoxForces *f) {
    JoxAgents *a = f->step.agents;
    uint32_t room = JOX_FORCE_GRAIN * (f->step.neighbours->stride + 1);
    jox_chunks_begin(&f->transfers, f->chunks, room, sizeof(JoxTransfer));
    jox_parallel_for(f->step.pool, a->count, JOX_FORCE_GRAIN, infer_chunk, f);
    jox_parallel_for(f->step.pool, a->count, JOX_FORCE_GRAIN, fade_chunk, f);
    f->totals.passed = jox_transfers_sort(f);
    if (!f->totals.passed)
        return;
    jox_parallel_for(f->step.pool, a->count, JOX_FORCE_GRAIN, scale_chunk, f);
    jox_transfers_sum(f, a->inferred_x, a->inferred_y);
}
