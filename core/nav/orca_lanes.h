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

/* Outward normal of the velocity obstacle at the leg that is nearer, of discs that are apart; w is
   the relative velocity less that which makes them meet at the horizon, m/s. */
static inline __attribute__((always_inline)) JoxVector
jox_leg_normal_lanes(const JoxPair *q, JoxFloats d2, JoxFloats r2, JoxVector w) {
    JoxFloats leg = jf_sqrt(jf_sub(d2, r2)), by = jf_div(jf_set(1.0f), d2);
    JoxMask left = jf_lt(jf_set(0.0f), jf_sub(jf_mul(q->x, w.y), jf_mul(q->y, w.x)));
    JoxFloats along_x = jf_mul(q->x, leg), along_y = jf_mul(q->y, leg);
    JoxFloats x = jf_sub(jf_select(left, along_x, jf_neg(along_x)), jf_mul(q->y, q->radii));
    JoxFloats y = jf_add(jf_mul(q->x, q->radii), jf_select(left, along_y, jf_neg(along_y)));
    return (JoxVector){jf_neg(jf_mul(y, by)), jf_mul(x, by)};
}

/* The half-plane for a neighbour: see jox_orca_half_plane. Where the centres coincide and move
   alike its normal is (1, 0). */
static inline __attribute__((always_inline)) JoxPlaneLanes
jox_orca_lanes(const JoxPair *q, JoxVector own, JoxFloats tau, JoxFloats share, float dt) {
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    JoxFloats d2 = jf_add(jf_mul(q->x, q->x), jf_mul(q->y, q->y));
    JoxFloats r2 = jf_mul(q->radii, q->radii);
    JoxMask overlap = jf_le(d2, r2);
    JoxFloats inverse = jf_select(overlap, jf_set(1.0f / dt), jf_div(one, tau));
    JoxFloats round = jf_select(overlap, jf_div(q->radii, jf_set(dt)), jf_mul(q->radii, inverse));
    JoxVector w = {jf_sub(q->vx, jf_mul(q->x, inverse)), jf_sub(q->vy, jf_mul(q->y, inverse))};
    JoxFloats w2 = jf_add(jf_mul(w.x, w.x), jf_mul(w.y, w.y));
    JoxFloats along = jf_add(jf_mul(w.x, q->x), jf_mul(w.y, q->y));
    JoxMask before = jm_and(jf_lt(along, zero), jf_lt(jf_mul(r2, w2), jf_mul(along, along)));
    JoxMask disc = jm_or(overlap, before);
    JoxFloats length = jf_sqrt(w2), by = jf_div(one, length);
    JoxMask moves = jf_lt(jf_set(1e-6f), length);
    JoxVector leg = jox_leg_normal_lanes(q, d2, r2, w); /* its direction is (leg.y, -leg.x) */
    JoxFloats speed = jf_add(jf_mul(q->vx, leg.y), jf_mul(q->vy, jf_neg(leg.x)));
    JoxFloats nx = jf_select(moves, jf_mul(w.x, by), one);
    JoxFloats ny = jf_select(moves, jf_mul(w.y, by), zero), depth = jf_sub(round, length);
    JoxFloats ux = jf_sub(jf_mul(leg.y, speed), q->vx);
    JoxFloats uy = jf_sub(jf_mul(jf_neg(leg.x), speed), q->vy);
    ux = jf_select(disc, jf_mul(nx, depth), ux);
    uy = jf_select(disc, jf_mul(ny, depth), uy);
    nx = jf_select(disc, nx, leg.x);
    ny = jf_select(disc, ny, leg.y);
    JoxFloats at_x = jf_add(own.x, jf_mul(ux, share));
    JoxFloats at_y = jf_add(own.y, jf_mul(uy, share));
    return (JoxPlaneLanes){nx, ny, jf_add(jf_mul(nx, at_x), jf_mul(ny, at_y))};
}

#endif
