/* The stage infer, equations 8 and 9: forces that bracing and slowing agents pass on to those
   ahead. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "force/push/pass_on.h"

#define X(name, isa) [isa] = jox_infer_packets_##name,
static JoxInferKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

/* (9) Passes the resistance of agent i, under force, on to those found ahead: it falls short of the
   velocity that the force would give, by `shortfall`, m/s. */
static void pass_resistance(JoxForces *f, uint32_t chunk, uint32_t i, uint32_t found,
                            float shortfall) {
    const JoxAgents *a = f->step.agents;
    JoxV2 unit = {a->half_plane_x[i], a->half_plane_y[i]};
    const uint32_t n = jox_count_found(found);
    if (n == 0 || a->fallen[i] > 0.0f)
        return;
    const JoxV2 each = jox_resistance(unit, shortfall, jox_param(a, JOX_PARAM_absorb, i),
                                      jox_param(a, JOX_PARAM_mass, i), n, (float)f->step.timing.dt);
    while (found)
        jox_transfers_add(f, chunk, i, jox_take_found(f, i, &found), each);
}

/* Returns the share of a force that agent `to` takes from an agent that slowed down and lost
   `energy` (J). An agent that is faster already, or soon will be, gains no more energy than was
   lost. */
static float find_taken_share(const JoxForces *f, uint32_t to, JoxV2 force, float energy) {
    const JoxAgents *a = f->step.agents;
    float size = jox_length(force), mass = jox_param(a, JOX_PARAM_mass, to);
    if (!(size > 0.0f))
        return 0.0f;
    JoxV2 direction = jox_scale(force, 1.0f / size);
    JoxV2 coming =
        jox_scale((JoxV2){a->inferred_x[to], a->inferred_y[to]}, f->options.filter / mass);
    float speed = jox_dot((JoxV2){a->vx[to], a->vy[to]}, direction) +
                  jox_maxf(0.0f, jox_dot(coming, direction));
    return jox_share_within_energy(size * (float)f->step.timing.dt, mass, speed, energy);
}

/* (8) Passes the momentum of agent i, which slowed down under no force, on to those found ahead. */
static void pass_deceleration(JoxForces *f, uint32_t chunk, uint32_t i, uint32_t found) {
    const JoxAgents *a = f->step.agents;
    float dt = (float)f->step.timing.dt, mass = jox_param(a, JOX_PARAM_mass, i);
    if (a->fallen[i] > 0.0f)
        return;
    float absorb = jox_param(a, JOX_PARAM_absorb, i);
    JoxV2 before = {a->forced_x[i], a->forced_y[i]}, after = {a->vx[i], a->vy[i]};
    JoxV2 change = jox_slowing(before, after);
    const uint32_t n = jox_count_found(found);
    JoxV2 given = jox_deceleration(change, absorb, mass, n > 0 ? n : 1, dt);
    float lost = 0.5f * mass * (jox_length2(before) - jox_length2(after));
    while (found) {
        const uint32_t to = jox_take_found(f, i, &found);
        float share = find_taken_share(f, to, given, absorb * lost / (float)n);
        jox_transfers_add(f, chunk, i, to, jox_scale(given, share));
    }
    if (n || jox_stands(a, i))
        return; /* an agent that wants to stand brakes as planned: nothing carries it on */
    jox_transfers_add(
        f, chunk, i, i,
        jox_keep_from_reversing(given, after, mass, (float)f->step.timing.planning_time));
}

static inline bool all_pass_nothing(const uint8_t kinds[8]) {
    uint64_t bytes;
    memcpy(&bytes, kinds, sizeof bytes);
    return bytes == JOX_PASSES_NOTHING;
}

/* Whole packets are tested by the kernel of the run's instruction set. */
static void pass_on_from_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const uint32_t chunk = begin / JOX_FORCE_GRAIN;
    JoxPassing passing;
    jox_chunk_clear(&f->transfers.list, chunk);
    for (uint32_t i = begin; f->options.literal && i < end; i++)
        jox_literal_pass_on(f, chunk, i);
    if (f->options.literal)
        return;
    KERNELS[f->isa](f, begin, end, &passing);
    for (uint32_t i = begin; i < end; i++) {
        const uint32_t at = i - begin;
        if (i + 8 <= end && all_pass_nothing(&passing.kind[at]))
            i += 7;
        else if (passing.kind[at] == JOX_PASSES_RESISTANCE)
            pass_resistance(f, chunk, i, jox_find_reached(f, i, &passing.people, at),
                            passing.shortfall[at]);
        else if (passing.kind[at] == JOX_PASSES_DECELERATION)
            pass_deceleration(f, chunk, i, jox_find_reached(f, i, &passing.people, at));
    }
}

/* Fades the inferred forces of the last step: exponential filter. */
static void fade_inferred(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    JoxAgents *a = f->step.agents;
    float kept =
        1.0f - (f->options.literal ? 1.0f : jox_filter_share(f->step.timing.dt, f->options.filter));
    const size_t size = (end - begin) * sizeof(float);
    if (jox_mem_is(a->inferred_x + begin, 0, size) && jox_mem_is(a->inferred_y + begin, 0, size))
        return;
    for (uint32_t i = begin; i < end; i++) {
        const float x = a->inferred_x[i], y = a->inferred_y[i];
        /* A force fades to zero after some seconds; denormal numbers would be slow. */
        const bool fades = fabsf(x * kept) + fabsf(y * kept) < 1e-6f && fabsf(x) + fabsf(y) > 0.0f;
        a->inferred_x[i] = fades ? 0.0f : x * kept;
        a->inferred_y[i] = fades ? 0.0f : y * kept;
    }
}

/* Scales the new transfers to the share of the filter that arrives in this step. */
static void scale_transfers(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    float share =
        f->options.literal ? 1.0f : jox_filter_share(f->step.timing.dt, f->options.filter);
    JOX_ASSERT(share > 0.0f && share <= 1.0f);
    JoxReceivedForce *sorted = f->transfers.sorted;
    for (uint32_t i = f->transfers.starts[begin]; i < f->transfers.starts[end]; i++) {
        sorted[i].x *= share;
        sorted[i].y *= share;
    }
}

void jox_force_infer(JoxForces *f) {
    JoxAgents *a = f->step.agents;
    jox_transfers_reserve(f, &f->pair_memory);
    jox_parallel_for(f->step.pool, a->count, JOX_FORCE_GRAIN, pass_on_from_chunk, f);
    jox_parallel_for(f->step.pool, a->count, JOX_FORCE_GRAIN, fade_inferred, f);
    f->totals.passed = jox_transfers_sort(f);
    if (!f->totals.passed)
        return;
    jox_parallel_for(f->step.pool, a->count, JOX_FORCE_GRAIN, scale_transfers, f);
    jox_transfers_sum(f, a->inferred_x, a->inferred_y);
}
