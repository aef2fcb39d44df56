/* The half-plane of one pair of agents: by ORCA, or by the walking law. A lane is an agent with one
   other. solve_wide.c makes those of packets with it; orca.c and half_planes.c include it at width
   1, for bodies and for one agent. */
#ifndef JOX_NAV_PAIR_LANES_H
#define JOX_NAV_PAIR_LANES_H

#include "agents/param_lanes.h"
#include "nav/orca/program_lanes.h"
#include "nav/walk/walk_lanes.h"

/* Position of the other relative to the agent, m; velocity of the agent relative to the other, m/s;
   and the sum of their radii, m. */
typedef struct JoxPair {
    JoxFloats x, y, vx, vy, radii;
} JoxPair;

/* ---- ORCA (van den Berg et al. 2011) ---- */

/* Data of one agent for all of its half-planes: velocity, m/s, inverse of the horizon, 1/s, and
   share of the correction that it takes. */
typedef struct JoxOrcaSelf {
    JoxVector velocity;
    JoxFloats inverse, share;
} JoxOrcaSelf;

/* First half of the work for a pair. The velocity obstacle is bounded by a disc and two legs; the
   one root and the one quotient that either case needs are computed here, of the case that the lane
   is in. They take long, so the kernel starts those of all neighbours before it uses one. */
typedef struct JoxOrcaHalf {
    JoxVector w;      /* relative velocity less the one that leads to contact at the horizon, m/s */
    JoxMask disc;     /* the disc bounds; else a leg does */
    JoxFloats length; /* length of w where the disc bounds, m/s; else of the leg, m */
    JoxFloats inverse; /* 1 / length where the disc bounds; else 1 / distance^2 */
    JoxFloats round;   /* radius of the disc, m/s */
} JoxOrcaHalf;

/* Discs that overlap are to part within dt (s). Only the lanes of `wanted` (bits) count; those of
   them whose centres coincide are added to *coincide. */
static inline __attribute__((always_inline)) JoxOrcaHalf jox_orca_begin(const JoxPair *q,
                                                                        const JoxOrcaSelf *self,
                                                                        float dt, uint32_t wanted,
                                                                        uint32_t *coincide) {
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxFloats d2 = q->x * q->x + q->y * q->y;
    const JoxFloats r2 = q->radii * q->radii;
    const JoxMask overlap = jf_le(d2, r2);
    JoxFloats inverse = self->inverse, round = q->radii * inverse;
    if (jm_bits(overlap) & wanted) { /* they are to part within dt */
        inverse = jf_select(overlap, jf_set(1.0f / dt), inverse);
        round = jf_select(overlap, q->radii / dt, round);
        *coincide |= jm_bits(jf_le(d2, zero)) & wanted;
    }
    const JoxVector w = {q->vx - q->x * inverse, q->vy - q->y * inverse};
    const JoxFloats w2 = jv_dot(w, w), along = w.x * q->x + w.y * q->y;
    const JoxMask before = jm_and(jf_lt(along, zero), jf_lt(r2 * w2, along * along));
    const JoxMask disc = jm_or(overlap, before);
    const JoxFloats length = jf_sqrt(jf_select(disc, w2, d2 - r2));
    const JoxFloats inverse_length = one / jf_select(disc, length, d2);
    return (JoxOrcaHalf){w, disc, length, inverse_length, round};
}

/* Length below which w has no direction, m/s. */
#define JOX_ORCA_LEAST_W 1e-6f

/* Second half. The normal points out of the velocity obstacle, along w or across the leg on the
   side of w, and the border passes through own velocity + share * u, where u is the least change of
   the relative velocity. Where w has no direction the normal is (1, 0). */
static inline __attribute__((always_inline)) JoxPlaneLanes
jox_orca_end(const JoxPair *q, const JoxOrcaSelf *self, const JoxOrcaHalf *h) {
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxMask left = jf_lt(zero, q->x * h->w.y - q->y * h->w.x);
    const JoxFloats side = jf_select(left, h->length, -h->length);
    const JoxFloats leg_x = q->x * side - q->y * q->radii;
    const JoxFloats leg_y = q->x * q->radii + q->y * side;
    const JoxMask rests = jm_without(h->disc, jf_lt(jf_set(JOX_ORCA_LEAST_W), h->length));
    const JoxFloats x = jf_select(h->disc, h->w.x, -leg_y);
    const JoxFloats y = jf_select(h->disc, h->w.y, leg_x);
    const JoxFloats nx = jf_select(rests, one, x * h->inverse);
    const JoxFloats ny = jf_select(rests, zero, y * h->inverse);
    const JoxFloats into = nx * q->vx + ny * q->vy;
    const JoxFloats change = jf_select(h->disc, h->round - h->length, -into);
    const JoxFloats own = nx * self->velocity.x + ny * self->velocity.y;
    return (JoxPlaneLanes){nx, ny, own + change * self->share};
}

/* Data of an agent that is the same for all of its neighbours. */
typedef struct JoxSelf {
    JoxFloats x, y, radius; /* m */
    JoxFloats room;  /* gap that a walker keeps to the agent it follows, as a share of the law's */
    JoxFloats cross; /* gap that it keeps to one that crosses, as a share of the sum of radii */
    JoxOrcaSelf orca;
} JoxSelf;

/* Returns by ORCA's parameters how agents avoid others. Equation 3 prints u/2. Agents that step
   back to where they stood look twice as far ahead and take all of u, so that nobody has to give
   way. */
static inline JoxOrcaSelf jox_orca_self_of(const JoxSolve *s, uint32_t first) {
    const JoxAgents *a = s->step.agents;
    const JoxVector velocity = jv_load(a->vx, a->vy, first);
    const JoxFloats inverse = 1.0f / jox_param_lanes(a, JOX_PARAM_horizon, first);
    if (s->nav->literal)
        return (JoxOrcaSelf){velocity, inverse, jf_set(0.5f)};
    const JoxMask steps = jox_steps_back_lanes(a, first);
    const JoxFloats yield = jox_param_lanes(a, JOX_PARAM_yield, first);
    return (JoxOrcaSelf){velocity, jf_select(steps, 0.5f * inverse, inverse),
                         jf_select(steps, jf_set(1.0f), yield)};
}

/* Loads it for the agents from `first` on. `walkers`: lanes (bits) that walk by the law. */
static inline JoxSelf jox_self_of(const JoxSolve *s, uint32_t first, uint32_t walkers) {
    const JoxAgents *a = s->step.agents;
    const JoxFloats radius = jox_param_lanes(a, JOX_PARAM_radius, first);
    JoxFloats room = jf_set(1.0f), cross = room;
    if (walkers) {
        room -= (float)s->nav->walk->room_eager * jf_load(a->eager + first);
        cross = (float)s->nav->walk->width_cross * jf_load(a->contact_radius + first) / radius;
    }
    return (JoxSelf){
        .x = jf_load(a->x + first),
        .y = jf_load(a->y + first),
        .radius = radius,
        .room = room,
        .cross = cross,
        .orca = jox_orca_self_of(s, first),
    };
}

/* Returns whether contacts may press agents nearer to each other than they keep by their own will.
   Without forces none does, and torsos are never nearer than discs. */
static inline bool jox_may_be_pressed(const JoxStep *step) {
    return step->neighbours->has_torsos && step->touched;
}

/* Returns how near two agents come by their own will, m: those under way keep a disc and their
   shoulders free; those who stand stay as near as they are, but their torsos part. */
static inline JoxFloats jox_radii_of_torsos(const JoxStep *step, uint32_t first,
                                            const uint32_t *others, const JoxPair *q) {
    const JoxNeighbours *near = step->neighbours;
    const JoxVector own = jv_load(step->agents->axis_x, step->agents->axis_y, first);
    JoxFloats shape[4];
    jf_records_at(&near->shapes[0].axis_x, others, shape);
    const JoxVector offset = {q->x, q->y};
    const JoxFloats distance = jf_sqrt(jv_dot(offset, offset));
    const JoxFloats axes =
        jf_abs(jv_dot(own, offset)) + jf_abs(jv_dot((JoxVector){shape[0], shape[1]}, offset));
    const JoxFloats radii = jf_load(step->agents->contact_radius + first) + shape[2];
    const JoxFloats torsos = radii + axes / jf_max(distance, jf_set(1e-6f));
    const JoxFloats pressed = jf_min(q->radii, jf_max(torsos, distance));
    return jf_select(jox_stands_lanes(step->agents, first), pressed, jf_max(q->radii, torsos));
}

/* ---- the walking law (core/walking.md) ---- */

/* Distance of a walker and its neighbour, m, and the distances within which their ways are one, m:
   for a neighbour that it follows, and for one that crosses. */
typedef struct JoxWalkerGap {
    JoxFloats distance, follows, crosses;
} JoxWalkerGap;

/* Computes the gaps of walkers to one neighbour each. */
static inline JoxWalkerGap jox_walker_gap(const JoxWalkLaw *law, const JoxSelf *self,
                                          const JoxPair *q) {
    const JoxVector offset = {q->x, q->y};
    return (JoxWalkerGap){
        jf_sqrt(jv_dot(offset, offset)),
        q->radii * (float)law->width * self->room,
        q->radii * self->cross,
    };
}

/* Returns the lanes whose neighbour is too far away for a half-plane, whether it is followed or
   crosses. */
static inline JoxMask jox_walker_is_far(const JoxWalkLaw *law, const JoxWalkerGap *g) {
    return jf_le(jf_set((float)law->close), g->distance - jf_max(g->crosses, g->follows));
}

/* Makes the half-plane of a walker for a neighbour that it minds: the walker approaches it no
   faster than uses up the gap within `close_time`, or half of the gap where their ways cross.
   `towards`: unit vector to the neighbour, which moves at `velocity` (m/s). *there: lanes that have
   one. */
static inline JoxPlaneLanes jox_walker_plane(const JoxWalkLaw *law, const JoxWalkerGap *g,
                                             const JoxMindsLanes *minds, JoxVector towards,
                                             JoxVector velocity, JoxMask *there) {
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxFloats gap = g->distance - jf_select(minds->crossing, g->crosses, g->follows);
    const JoxFloats leaves = jv_dot(towards, velocity);
    const JoxFloats share = jf_select(minds->crossing, jf_set(0.5f), one);
    const JoxFloats closes = share * jf_max(gap, zero) / (float)law->close_time;
    *there =
        jm_without(jm_or(minds->ahead, minds->crossing), jf_le(jf_set((float)law->close), gap));
    return (JoxPlaneLanes){-towards.x, -towards.y, -(jf_max(zero, leaves) + closes)};
}

#endif
