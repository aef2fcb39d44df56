/* The velocity that an agent wants by ORCA: its preferred one, or that one turned to its right. An
   agent that stands before others wants to go more to its right, by an angle of its own once it has
   stood for a second: two that meet head-on, and any number that meet in one point, would else
   stand for ever. An agent that pushes another straight ahead wants to go somewhat to its right
   too, or it would push them along for ever. solve_wide.c includes it for packets, solve.c at
   width 1. */
#ifndef JOX_NAV_WISH_LANES_H
#define JOX_NAV_WISH_LANES_H

#include "agents/param_lanes.h"
#include "nav/orca/solve.h"
#include "simd/vectors.h"

typedef struct JoxWish {
    JoxVector preferred; /* m/s */
    JoxMask gets_on;     /* moves along it at 20 % of its speed or more */
    JoxMask may_turn;    /* turns aside if a half-plane keeps it off */
} JoxWish;

/* Makes the wishes of the agents from `first` on. No equation of the paper turns a preferred
   velocity, so in literal mode no agent turns aside. */
static inline JoxWish jox_wish_of(const JoxSolve *s, uint32_t first) {
    const float slow = 0.2f;
    const JoxAgents *a = s->step.agents;
    const JoxVector w = jv_load(a->pref_x, a->pref_y, first);
    const JoxFloats along = jv_dot(jv_load(a->vx, a->vy, first), w), length2 = jv_dot(w, w);
    const JoxMask gets_on = jf_lt(slow * length2, along);
    const JoxMask pushes = jf_lt(jf_set(0.0f), jox_param_lanes(a, JOX_PARAM_push, first));
    const JoxMask stands = jf_lt(length2, jf_set(JOX_STANDS * JOX_STANDS));
    const JoxMask stays = jm_or(jm_without(gets_on, pushes), stands);
    return (JoxWish){w, gets_on,
                     jm_without(jm_of_bits(s->nav->literal ? 0 : JOX_ALL_LANES), stays)};
}

/* Returns whether a half-plane keeps an agent from its preferred velocity: any that forbids it, or,
   for an agent that gets on, only one straight against it. */
static inline JoxMask jox_is_kept_off(const JoxWish *wish, JoxVector normal, JoxFloats offset) {
    const JoxVector w = wish->preferred;
    const float tie = 0.02f; /* sideways share of the way ahead: more is no tie */
    const JoxFloats along = jv_dot(normal, w), against = -along;
    const JoxFloats aside = jf_abs(normal.x * w.y - normal.y * w.x);
    const JoxMask head_on = jm_and(jf_lt(jf_set(0.0f), against), jf_lt(aside, tie * against));
    return jm_without(jf_lt(along, offset), jm_without(wish->gets_on, head_on));
}

/* Returns a preferred velocity turned to the right, by `turn` (0 to 1, jox_turn_aside). */
static inline JoxVector jox_turn_wish(JoxVector w, JoxFloats turn) {
    const JoxFloats right = JOX_ASIDE_RIGHT_FIRST + JOX_ASIDE_RIGHT_STUCK * turn;
    const JoxFloats on = 1.0f - JOX_ASIDE_BACK_STUCK * turn;
    return (JoxVector){on * w.x + right * w.y, on * w.y - right * w.x};
}

#endif
