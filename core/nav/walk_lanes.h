/* The precedence of the walking law (walk.h) for all lanes of a packet, to the bit. For kernels:
   part of those that include it. */
#ifndef JOX_NAV_WALK_LANES_H
#define JOX_NAV_WALK_LANES_H

#include "nav/program_lanes.h"
#include "nav/walk.h"

/* Whom lanes mind, and how: those who go first, and those who cross. */
typedef struct JoxMindsLanes {
    JoxMask ahead, crossing;
} JoxMindsLanes;

/* How agents from `first` on mind one other each, at an offset (m) from them: jox_minds. */
static inline JoxMindsLanes jox_minds_lanes(const JoxAgents *a, uint32_t first, JoxInts others,
                                            JoxVector offset) {
    const JoxFloats zero = jf_set(0.0f), way = jf_load(a->way + first);
    const JoxVector own = {jf_load(a->aim_x + first), jf_load(a->aim_y + first)};
    const JoxVector aim = {jf_pick(a->aim_x, others), jf_pick(a->aim_y, others)};
    const JoxMask stands = jf_le(jf_add(jf_abs(aim.x), jf_abs(aim.y)), zero);
    const JoxInts sign = ji_set(INT32_MIN), bound = ji_load((const uint32_t *)a->bound + first);
    JoxMask alike = ji_equal(bound, ji_pick((const uint32_t *)a->bound, others));
    alike = jm_and(alike, ji_less(ji_set(-1), bound));
    const JoxFloats other_way = jf_pick(a->way, others);
    const JoxMask older =
        ji_less(ji_add(ji_pick(a->id, others), sign), ji_add(ji_load(a->id + first), sign));
    const JoxMask goes_first =
        jm_or(jf_lt(other_way, way), jm_without(older, jf_lt(way, other_way)));
    const JoxMask along = jf_lt(jf_set(JOX_SAME_WAY), jv_dot(own, aim));
    const JoxMask before = jm_and(along, jf_lt(zero, jv_dot(offset, own)));
    const JoxMask ahead = jm_or(jm_and(alike, goes_first), jm_without(before, alike));
    const JoxMask other_bound = jm_without(jm_of_bits(~0u), alike);
    return (JoxMindsLanes){jm_without(ahead, stands),
                           jm_or(stands, jm_without(other_bound, along))};
}

#endif
