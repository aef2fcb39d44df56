/* Plane vectors of lanes; base/vec.h has those of plain numbers. Included by kernels only. */
#ifndef JOX_SIMD_VECTORS_H
#define JOX_SIMD_VECTORS_H

#include "simd/lanes.h"

typedef struct JoxVector {
    JoxFloats x, y;
} JoxVector;

/* Load and store JOX_WIDTH vectors from index `i` of two columns. */
static inline JoxVector jv_load(const float *x, const float *y, size_t i) {
    return (JoxVector){jf_load(x + i), jf_load(y + i)};
}
static inline void jv_store(float *x, float *y, size_t i, JoxVector v) {
    jf_store(x + i, v.x);
    jf_store(y + i, v.y);
}
static inline JoxVector jv_add(JoxVector a, JoxVector b) {
    return (JoxVector){a.x + b.x, a.y + b.y};
}
static inline JoxVector jv_sub(JoxVector a, JoxVector b) {
    return (JoxVector){a.x - b.x, a.y - b.y};
}
static inline JoxVector jv_scale(JoxVector a, JoxFloats by) {
    return (JoxVector){a.x * by, a.y * by};
}
static inline JoxFloats jv_dot(JoxVector a, JoxVector b) {
    return a.x * b.x + a.y * b.y;
}
static inline JoxFloats jv_det(JoxVector a, JoxVector b) {
    return a.x * b.y - a.y * b.x;
}
static inline JoxVector jv_select(JoxMask m, JoxVector a, JoxVector b) {
    return (JoxVector){jf_select(m, a.x, b.x), jf_select(m, a.y, b.y)};
}
static inline JoxFloats jv_length(JoxVector a) {
    return jf_sqrt(jv_dot(a, a));
}
/* jox_unit of base/vec.h, by lane. */
static inline JoxVector jv_unit(JoxVector a) {
    const JoxFloats length = jv_length(a), zero = jf_set(0.0f);
    return jv_select(jf_lt(zero, length), jv_scale(a, 1.0f / length), (JoxVector){zero, zero});
}
/* Returns which lanes are not (0, 0). */
static inline JoxMask jv_is_nonzero(JoxVector a) {
    const JoxFloats zero = jf_set(0.0f);
    const JoxMask none = jm_and(jf_le(jf_abs(a.x), zero), jf_le(jf_abs(a.y), zero));
    return jm_without(jm_of_bits(JOX_ALL_LANES), none);
}
/* Returns 0 for what has decayed to less than 1e-12. What loses a share in each step would end as
   subnormal numbers, on which processors take a hundred cycles and more. */
static inline JoxFloats jf_end_decay(JoxFloats a) {
    return jf_select(jf_lt(jf_abs(a), jf_set(1e-12f)), jf_set(0.0f), a);
}
static inline JoxVector jv_end_decay(JoxVector a) {
    return (JoxVector){jf_end_decay(a.x), jf_end_decay(a.y)};
}
/* Returns the shortest difference along one axis with periodic edges; as jox_wrap of
   agents/agents.h. */
static inline JoxFloats jf_wrap(JoxFloats d, float period) {
    JoxFloats shift = jf_select(jf_lt(jf_set(0.0f), d), jf_set(period), jf_set(-period));
    return jf_select(jf_lt(jf_set(0.5f * period), jf_abs(d)), d - shift, d);
}
/* Returns d less the nearest whole multiple of the pitch, as rintf finds it: adding and subtracting
   this number rounds to a whole one. */
static inline JoxFloats jf_fold(JoxFloats d, float pitch) {
    const JoxFloats rounds = jf_set(0x1.8p23f);
    return d - pitch * ((d / pitch + rounds) - rounds);
}

#endif
