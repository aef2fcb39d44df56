/* Which of their neighbours a force of agents can reach: those in a cone; a lane is an agent. The
   kernels of push/ include it; people_in_cone.c does at width 1. */
#ifndef JOX_FORCE_CONE_LANES_H
#define JOX_FORCE_CONE_LANES_H

#include <math.h>

#include "agents/fold_lanes.h"
#include "agents/param_lanes.h"
#include "force/cones.h"
#include "geom/wall_grid_lanes.h"
#include "simd/vectors.h"

/* jox_cone_holds, by lane. */
static inline JoxMask jox_cone_holds_lanes(JoxVector offset, JoxVector axis, JoxFloats cosine) {
    const JoxFloats along = jv_dot(offset, axis);
    const JoxFloats least = cosine * jf_abs(cosine) * jv_dot(offset, offset);
    return jm_or(jf_le(least, along * jf_abs(along)), jf_le(cosine, jf_set(-1.0f)));
}

/* Returns a distance from agents within which no wall is, m; `first`: of a packet. `moved`: they
   have moved since walls were measured. */
static inline JoxFloats jox_unhidden_lanes(const JoxForces *f, uint32_t first, bool moved) {
    const JoxAgents *a = f->step.agents;
    const JoxVector at = jv_load(a->x, a->y, first);
    if (!f->in.walls || !f->in.unhidden2)
        return jf_set(f->in.walls ? 0.0f : INFINITY);
    const JoxVector way = jv_sub(at, jv_load(a->prev_x, a->prev_y, first));
    return jox_wall_grid_unhidden_lanes(f->in.walls, jf_load(f->in.unhidden2 + first),
                                        moved ? jv_length(way) : jf_set(0.0f));
}

/* Does the same for neighbours at `offset` from agents, m. Beyond a periodic edge there is only an
   image, whose walls are not measured. */
static inline JoxFloats jox_unhidden_of(const JoxForces *f, uint32_t first, const uint32_t *others,
                                        JoxVector offset, bool moved) {
    const JoxAgents *a = f->step.agents;
    const JoxVector to = {jf_pick_at(a->x, others), jf_pick_at(a->y, others)};
    const JoxVector before = {jf_pick_at(a->prev_x, others), jf_pick_at(a->prev_y, others)};
    const JoxFloats zero = jf_set(0.0f), way = moved ? jv_length(jv_sub(to, before)) : zero;
    if (!f->in.unhidden2)
        return zero;
    const JoxVector direct = jv_sub(to, jv_load(a->x, a->y, first));
    const JoxFloats unhidden =
        jox_wall_grid_unhidden_lanes(f->in.walls, jf_pick_at(f->in.unhidden2, others), way);
    return jf_select(jv_is_nonzero(jv_sub(offset, direct)), zero, unhidden);
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
    const JoxFloats unhidden = jox_unhidden_lanes(f, first, reach->moved);
    const JoxVector at = jv_load(a->x, a->y, first);
    const JoxInts none = ji_set(0);
    const JoxInts count = ji_select(jm_of_bits(lanes), ji_load_bytes(near->count + first), none);
    const uint32_t *others = near->index + jox_neighbour_at(near, first, 0);
    JoxFoundLanes out = {none, none};
    for (uint32_t k = 0; k < near->stride; k++, others += JOX_LANES) {
        JoxMask there = ji_less(ji_set((int32_t)k), count);
        JoxVector offset = {jf_pick_at(a->x, others) - at.x, jf_pick_at(a->y, others) - at.y};
        offset = jox_fold_lanes(a, offset);
        const JoxFloats most = own + jox_param_of(radius, others) + reach->gap;
        const JoxFloats d2 = jv_dot(offset, offset);
        const JoxMask within = jm_and(there, jf_le(d2, farthest * farthest));
        if (!jm_bits(reach->moved ? there : within))
            break; /* the rest, which are in order unless they have moved, are farther away */
        there = jm_and(there, jf_le(d2, most * most));
        there = jm_and(there, jox_cone_holds_lanes(offset, axis, cosine));
        const JoxInts bit = ji_set(1 << k);
        out.found = ji_or(out.found, ji_select(there, bit, none));
        there = jm_and(there, jox_wall_grid_may_cross_lanes(d2, unhidden, jf_set(0.0f)));
        if (!jm_bits(there))
            continue;
        const JoxFloats its = jox_unhidden_of(f, first, others, offset, reach->moved);
        there = jm_and(there, jox_wall_grid_may_cross_lanes(d2, unhidden, its));
        out.doubtful = ji_or(out.doubtful, ji_select(there, bit, none));
    }
    return out;
}

#endif
