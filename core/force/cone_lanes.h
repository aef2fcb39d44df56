/* Which of their neighbours a force of agents can reach: those in a cone; a lane is an agent. The
   kernels of push/ include it; people_in_cone.c does at width 1. */
#ifndef JOX_FORCE_CONE_LANES_H
#define JOX_FORCE_CONE_LANES_H

#include <math.h>

#include "agents/param_lanes.h"
#include "force/cones.h"
#include "simd/vectors.h"

/* jox_cone_holds, by lane. */
static inline JoxMask jox_cone_holds_lanes(JoxVector offset, JoxVector axis, JoxFloats cosine) {
    const JoxFloats along = jv_dot(offset, axis);
    const JoxFloats least = cosine * jf_abs(cosine) * jv_dot(offset, offset);
    return jm_or(jf_le(least, along * jf_abs(along)), jf_le(cosine, jf_set(-1.0f)));
}

/* Returns the square of a distance, m2, within which no wall is; below 0: unknown. Edges that the
   grid does not list there are beyond its reach; the margin exceeds the rounding of positions.
   Agents that have moved lose their way, which is long over a periodic edge. */
static inline JoxFloats jox_unhidden2_lanes(const JoxForces *f, uint32_t first, bool moved) {
    const JoxAgents *a = f->step.agents;
    if (!f->in.walls)
        return jf_set(INFINITY);
    if (!f->in.unhidden2)
        return jf_set(-1.0f);
    const float served = 0.999f * f->in.walls->reach;
    const JoxFloats before2 = jf_min(jf_load(f->in.unhidden2 + first), jf_set(served * served));
    if (!moved)
        return before2;
    const JoxVector way = jv_sub(jv_load(a->x, a->y, first), jv_load(a->prev_x, a->prev_y, first));
    const JoxFloats distance = jf_sqrt(before2) - jf_sqrt(jv_dot(way, way));
    return distance * jf_abs(distance);
}

/* JoxFound, by lane. */
typedef struct JoxFoundLanes {
    JoxInts found, doubtful;
} JoxFoundLanes;

/* Finds which neighbours of `lanes` (bits), agents from `first` on, are in the cone about the unit
   vector `axis`. It reaches centres within `own` + their radius + the gap, m. */
static inline JoxFoundLanes jox_find_people_in_cone(const JoxForces *f, uint32_t first,
                                                    uint32_t lanes, const JoxConeReach *reach,
                                                    JoxVector axis, JoxFloats own) {
    const JoxAgents *a = f->step.agents;
    const JoxNeighbours *near = f->step.neighbours;
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    const JoxFloats cosine = jox_param_lanes(a, reach->angle, first);
    const JoxFloats farthest = own + f->widest;
    const JoxFloats unhidden2 = jox_unhidden2_lanes(f, first, reach->moved);
    const JoxVector at = jv_load(a->x, a->y, first);
    const JoxInts none = ji_set(0);
    const JoxInts count = ji_select(jm_of_bits(lanes), ji_load_bytes(near->count + first), none);
    const uint32_t *others = near->index + jox_neighbour_at(near, first, 0);
    JoxFoundLanes out = {none, none};
    for (uint32_t k = 0; k < near->stride; k++, others += JOX_LANES) {
        JoxMask there = ji_less(ji_set((int32_t)k), count);
        JoxVector offset = {jf_pick_at(a->x, others) - at.x, jf_pick_at(a->y, others) - at.y};
        offset.x = jf_wrap(offset.x, a->period.x);
        offset.y = jf_wrap(offset.y, a->period.y);
        const JoxFloats most = own + jox_param_of(radius, others) + reach->gap;
        const JoxFloats d2 = jv_dot(offset, offset);
        const JoxMask within = jm_and(there, jf_le(d2, farthest * farthest));
        if (!jm_bits(reach->moved ? there : within))
            break; /* the rest, which are in order unless they have moved, are farther away */
        there = jm_and(there, jf_le(d2, most * most));
        there = jm_and(there, jox_cone_holds_lanes(offset, axis, cosine));
        const JoxInts bit = ji_select(there, ji_set(1 << k), none);
        out.found = ji_or(out.found, bit);
        out.doubtful = ji_or(out.doubtful, ji_select(jf_lt(d2, unhidden2), none, bit));
    }
    return out;
}

#endif
