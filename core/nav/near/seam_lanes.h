/* Seams between sheets near the agents of a packet (geom/storeys.h). perceive_wide.c and
   move_wide.c include it. */
#ifndef JOX_NAV_NEAR_SEAM_LANES_H
#define JOX_NAV_NEAR_SEAM_LANES_H

#include "agents/agents.h"
#include "geom/storeys.h"
#include "simd/vectors.h"

/* Positions relative to a seam, m: along it from its end a, and beyond it, by lane. */
typedef struct JoxSeamLanes {
    JoxFloats along, beyond;
} JoxSeamLanes;

/* Returns the seams of the sheets of `lanes` (bits, at least one) as a range, first to last - 1;
   agents of a packet are mostly on one sheet. `y`: m, JOX_WIDTH cells. */
static inline void jox_find_seams(const JoxStoreys *s, const float *y, uint32_t lanes,
                                  uint32_t *first, uint32_t *last) {
    float low = INFINITY, high = -INFINITY;
    for (; lanes; lanes &= lanes - 1) {
        const float at = y[__builtin_ctz(lanes)];
        low = at < low ? at : low;
        high = at > high ? at : high;
    }
    const JoxSheet *from = &s->sheets[jox_sheet_of(s, low)],
                   *to = &s->sheets[jox_sheet_of(s, high)];
    *first = from->first_seam;
    *last = to->first_seam + to->seam_count;
}

static inline JoxSeamLanes jox_place_at_seam(const JoxStoreys *s, const JoxSeam *seam,
                                             JoxVector at) {
    const JoxV2 a = jox_on_sheet(s, seam->here, seam->a);
    const JoxVector from = {at.x - a.x, at.y - a.y};
    return (JoxSeamLanes){seam->along.x * from.x + seam->along.y * from.y,
                          seam->along.x * from.y - seam->along.y * from.x};
}

/* Returns the lanes that are within `wide` m of a seam. Lanes on other sheets are too far away. */
static inline uint32_t jox_find_near_seam(const JoxStoreys *s, const JoxSeam *seam, JoxVector at,
                                          JoxFloats wide) {
    const JoxSeamLanes on = jox_place_at_seam(s, seam, at);
    const JoxFloats zero = jf_set(0.0f);
    const JoxFloats outside = on.along - jf_min(jf_max(on.along, zero), jf_set(seam->length));
    return jm_bits(jf_le(outside * outside + on.beyond * on.beyond, wide * wide));
}

/* Returns the lanes that stand beyond a seam, as jox_find_crossed_seam finds them. */
static inline uint32_t jox_find_beyond_seam(const JoxStoreys *s, const JoxSeam *seam,
                                            JoxVector at) {
    const JoxSeamLanes on = jox_place_at_seam(s, seam, at);
    const JoxFloats zero = jf_set(0.0f);
    const JoxMask beyond = jm_and(jf_lt(zero, on.beyond), jf_le(on.beyond, jf_set(JOX_SEAM_DEPTH)));
    return jm_bits(
        jm_and(beyond, jm_and(jf_le(zero, on.along), jf_le(on.along, jf_set(seam->length)))));
}

#endif
