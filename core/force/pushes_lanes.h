/* Others' pushes, and who holds against them, for all lanes of a packet of agents from `i` on. For
   kernels: part of those that include it. */
#ifndef JOX_FORCE_PUSHES_LANES_H
#define JOX_FORCE_PUSHES_LANES_H

#include "agents/param_lanes.h"
#include "force/equations.h"
#include "simd/vectors.h"

/* jox_stands */
static inline JoxMask jox_stands_lanes(const JoxAgents *a, uint32_t i) {
    const JoxVector preferred = jv_load(a->pref_x, a->pref_y, i);
    return jf_lt(jv_dot(preferred, preferred), jf_set((float)(JOX_STANDS * JOX_STANDS)));
}

/* Pushes of others, N: deliberate ones, and those that were passed on. */
static inline JoxVector jox_others_lanes(const JoxAgents *a, uint32_t i) {
    return jv_add(jv_load(a->push_x, a->push_y, i), jv_load(a->inferred_x, a->inferred_y, i));
}

/* What is left of them against who braces: jox_unheld_pushes. */
static inline JoxVector jox_unheld_lanes(const JoxAgents *a, uint32_t i, JoxVector others,
                                         JoxMask stands) {
    const JoxFloats zero = jf_set(0.0f), size = jf_sqrt(jv_dot(others, others));
    const JoxFloats held = jf_select(stands, zero, jox_param_lanes(a, JOX_PARAM_brace, i));
    const JoxFloats share = (size - held) / size;
    return jv_scale(others, jf_select(jf_lt(held, size), share, zero));
}

/* exp(-damping time) of each: jox_decay. Most have the damping of those before. */
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
