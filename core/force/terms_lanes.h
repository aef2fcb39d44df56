/* Forces on the agents of a packet, from agent `i` on: sums of force terms, and the part of pushes
   that feet hold. forces.h has the same for one agent. Included by the kernels of sum, infer and
   the start of contacts. */
#ifndef JOX_FORCE_TERMS_LANES_H
#define JOX_FORCE_TERMS_LANES_H

#include "agents/param_lanes.h"
#include "force/equations.h"
#include "simd/vectors.h"

/* jox_sum_terms, by lane; `roles` is a compile-time constant. */
static inline JoxVector jox_sum_terms_lanes(const JoxAgents *a, uint32_t i, uint32_t roles) {
    JoxVector sum = {jf_set(-0.0f), jf_set(-0.0f)};
#define ADD_TERM(X, keep, role, name, label)                                                       \
    if (JOX_FORCE_##role & roles)                                                                  \
        sum = jv_add(sum, jv_load(a->name##_x, a->name##_y, i));
    JOX_FORCE_TERMS(ADD_TERM, )
#undef ADD_TERM
    return sum;
}

/* Returns the part of others' pushes that the feet do not hold, N; `others`: sum of the braced
   terms, N. */
static inline JoxVector jox_unheld_lanes(const JoxAgents *a, uint32_t i, JoxVector others,
                                         JoxMask stands) {
    const JoxFloats zero = jf_set(0.0f), size = jf_sqrt(jv_dot(others, others));
    const JoxFloats held = jf_select(stands, zero, jox_param_lanes(a, JOX_PARAM_brace, i));
    const JoxFloats share = (size - held) / size;
    return jv_scale(others, jf_select(jf_lt(held, size), share, zero));
}

/* Returns the forces that move agents before contacts are solved, N: the free terms, plus the
   pushes of others that the feet do not hold. */
static inline JoxVector jox_moving_lanes(const JoxAgents *a, uint32_t i, JoxMask stands) {
    const JoxVector others = jox_sum_terms_lanes(a, i, JOX_FORCE_BRACED);
    return jv_add(jox_sum_terms_lanes(a, i, JOX_FORCE_FREE),
                  jox_unheld_lanes(a, i, others, stands));
}

/* exp(-damping time) by lane, as jox_decay. Mostly all lanes have the damping that is cached. */
static inline JoxFloats jox_decay_lanes(const float *damping, float time, JoxDecay *decay) {
    const JoxMask other = jf_lt(jf_set(0.0f), jf_abs(jf_load(damping) - damping[0]));
    if (!jm_bits(other))
        return jf_set(jox_decay(decay, damping[0], time));
    float each[JOX_WIDTH];
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        each[lane] = jox_decay(decay, damping[lane], time);
    return jf_load(each);
}

#endif
