/* ORCA's half-planes of orca.c for all lanes of a packet, to the bit. For kernels: part of those
   that include it. */
#ifndef JOX_NAV_ORCA_LANES_H
#define JOX_NAV_ORCA_LANES_H

#include "nav/rest_lanes.h"

/* Two who may meet: where the other is from the agent, m, the agent's velocity less the other's,
   m/s, and the sum of their radii, m. */
typedef struct JoxPair {
    JoxFloats x, y, vx, vy, radii;
} JoxPair;

/* What ORCA's half-planes of one agent have in common: its velocity, m/s, the inverse of its
   horizon, 1/s, and its share of the correction. */
typedef struct JoxOrcaSelf {
    JoxVector velocity;
    JoxFloats inverse, share;
} JoxOrcaSelf;

/* The half-plane for a neighbour: see jox_orca_half_plane. Where the centres coincide and move
   alike its normal is (1, 0). The velocity obstacle is bounded by a disc and by two legs; what both
   cases need, one root and one quotient, is computed once, of what the case of the lane takes. Of
   the lanes, only those of `wanted` are of any meaning. */
static inline __attribute__((always_inline)) JoxPlaneLanes
jox_orca_lanes(const JoxPair *q, const JoxOrcaSelf *self, float dt, JoxMask wanted) {
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxFloats d2 = jf_add(jf_mul(q->x, q->x), jf_mul(q->y, q->y));
    const JoxFloats r2 = jf_mul(q->radii, q->radii);
    const JoxMask overlap = jf_le(d2, r2);
    JoxFloats inverse = self->inverse, round = jf_mul(q->radii, inverse);
    if (jm_bits(jm_and(overlap, wanted))) { /* they are to part within dt */
        inverse = jf_select(overlap, jf_set(1.0f / dt), inverse);
        round = jf_select(overlap, jf_div(q->radii, jf_set(dt)), round);
    }
    /* The relative velocity less that which makes them meet at the horizon. */
    const JoxVector w = {jf_sub(q->vx, jf_mul(q->x, inverse)),
                         jf_sub(q->vy, jf_mul(q->y, inverse))};
    const JoxFloats w2 = jv_dot(w, w), along = jf_add(jf_mul(w.x, q->x), jf_mul(w.y, q->y));
    const JoxMask before = jm_and(jf_lt(along, zero), jf_lt(jf_mul(r2, w2), jf_mul(along, along)));
    const JoxMask disc = jm_or(overlap, before);
    const JoxFloats length = jf_sqrt(jf_select(disc, w2, jf_sub(d2, r2)));
    const JoxFloats by = jf_div(one, jf_select(disc, length, d2));
    /* The disc: out along w. */
    const JoxMask moves = jf_lt(jf_set(1e-6f), length);
    const JoxFloats disc_x = jf_select(moves, jf_mul(w.x, by), one);
    const JoxFloats disc_y = jf_select(moves, jf_mul(w.y, by), zero);
    const JoxFloats depth = jf_sub(round, length);
    /* The nearer leg: its direction is (leg.y, -leg.x), its outward normal leg. */
    const JoxMask left = jf_lt(zero, jf_sub(jf_mul(q->x, w.y), jf_mul(q->y, w.x)));
    const JoxFloats side = jf_select(left, length, jf_neg(length));
    const JoxFloats leg_x = jf_sub(jf_mul(q->x, side), jf_mul(q->y, q->radii));
    const JoxFloats leg_y = jf_add(jf_mul(q->x, q->radii), jf_mul(q->y, side));
    const JoxVector leg = {jf_neg(jf_mul(leg_y, by)), jf_mul(leg_x, by)};
    const JoxFloats speed = jf_add(jf_mul(q->vx, leg.y), jf_mul(q->vy, jf_neg(leg.x)));
    const JoxFloats nx = jf_select(disc, disc_x, leg.x), ny = jf_select(disc, disc_y, leg.y);
    const JoxFloats ux =
        jf_select(disc, jf_mul(disc_x, depth), jf_sub(jf_mul(leg.y, speed), q->vx));
    const JoxFloats uy =
        jf_select(disc, jf_mul(disc_y, depth), jf_sub(jf_mul(jf_neg(leg.x), speed), q->vy));
    const JoxFloats at_x = jf_add(self->velocity.x, jf_mul(ux, self->share));
    const JoxFloats at_y = jf_add(self->velocity.y, jf_mul(uy, self->share));
    return (JoxPlaneLanes){nx, ny, jf_add(jf_mul(nx, at_x), jf_mul(ny, at_y))};
}

#endif
