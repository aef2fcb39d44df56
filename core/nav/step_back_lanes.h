/* Balance recovery: agents that stand step back to where they stood after others moved them (column
   `displaced`, parameter `step_back`). Each step's move adds to the displacement (move_wide.c); the
   wanted velocity of an agent that stands is one that takes it off again (solve_wide.c, and solve.c
   at width 1). Half-planes of forces, contacts and neighbours bound it like any wanted velocity: so
   nobody steps against a force that it feels, nor where there is no room. */
#ifndef JOX_NAV_STEP_BACK_LANES_H
#define JOX_NAV_STEP_BACK_LANES_H

#include "agents/param_lanes.h"
#include "simd/vectors.h"

/* Five people whom a push had moved by 0.11 to 0.40 m towards a wall ended 0.02 to 0.13 m behind
   where they had stood (Feldmann and Adrian 2023): a share of what a force moves them. */
#define JOX_STEP_BEYOND 0.3f
#define JOX_STEP_REST 0.1f   /* m/s: slower motion away counts as none */
#define JOX_STEP_REACH 1.0f  /* m: farther from where they stood, agents move that place along */
#define JOX_STEP_LEAST 1e-3f /* m: lesser displacements are forgotten */
/* s: those who rest and get back by less than `nearer`, m/s, forget 63 % of a displacement in it:
   there is no room, or they are pressed where they are. */
#define JOX_STEP_FORGOTTEN 2.0f
#define JOX_STEP_NEARER 0.02f
/* m/s2: how steps slow down at the end, so gently that nobody near feels a force of (8), from 0.05
   m/s2 on. */
#define JOX_STEP_SLOWING 0.06f

/* Adds the velocity of steps back to what the agents from `first` on want, m/s. */
static inline JoxVector jox_add_steps_lanes(const JoxAgents *a, uint32_t first, JoxVector wanted) {
    const JoxMask steps = jox_steps_back_lanes(a, first);
    if (!jm_bits(steps))
        return wanted;
    const JoxVector displaced = jv_load(a->displaced_x, a->displaced_y, first);
    const JoxFloats size = jf_max(jf_set(JOX_STEP_LEAST), jf_sqrt(jv_dot(displaced, displaced)));
    const JoxFloats speed = jf_min(jox_param_lanes(a, JOX_PARAM_step_back, first),
                                   jf_sqrt(2.0f * JOX_STEP_SLOWING * size));
    const JoxVector step = jv_scale(displaced, speed / size);
    return jv_select(steps, jv_sub(wanted, step), wanted);
}

/* Returns by what a displacement of `size` m is multiplied: cut to what is left to go back, and
   forgotten by those who rest and get no nearer. `away`: speed away from where they stood, m/s. */
static inline JoxFloats jox_share_kept_lanes(JoxFloats size, JoxFloats settled, JoxFloats away,
                                             float dt) {
    const JoxFloats one = jf_set(1.0f), within = jf_min(one, JOX_STEP_REACH / size);
    const JoxMask rests = jf_lt(jf_set(JOX_STEP_REACTION), settled);
    const JoxMask stays = jm_without(rests, jf_lt(away, jf_set(-JOX_STEP_NEARER)));
    return jf_select(stays, within * (1.0f - dt / JOX_STEP_FORGOTTEN), within);
}

/* Returns which of the agents from `first` on a force of others moves: by contact or push, or one
   that others pass on and that makes them faster. Who comes to rest feels its own deceleration (8)
   as a force, too, and has not been moved by anybody. */
static inline JoxMask jox_moved_by_others_lanes(const JoxAgents *a, uint32_t first, JoxVector old,
                                                JoxVector force) {
    const JoxVector contact = jv_load(a->contact_x, a->contact_y, first),
                    push = jv_load(a->push_x, a->push_y, first),
                    external = jv_load(a->last_ext_x, a->last_ext_y, first);
    const JoxFloats direct =
        jv_dot(contact, contact) + jv_dot(push, push) + jv_dot(external, external);
    const JoxFloats speed = jv_dot(jv_load(a->vx, a->vy, first), force);
    return jm_or(jf_lt(jf_set(0.0f), direct), jf_lt(jv_dot(old, force), speed));
}

/* Adds a move of `dt` seconds to how far the agents from `first` on are displaced from where they
   stood, m: begins with a move under a force of others. `old`: velocity before the step, m/s.
   Agents that want to walk, and those that do not step back, have no such place. */
static inline void jox_note_displacement_lanes(JoxAgents *a, uint32_t first, JoxVector move,
                                               JoxVector old, float dt) {
    const JoxFloats zero = jf_set(0.0f);
    const JoxVector before = jv_load(a->displaced_x, a->displaced_y, first);
    const JoxVector force = jv_load(a->half_plane_x, a->half_plane_y, first);
    const JoxMask known = jf_lt(zero, jv_dot(before, before) + jv_dot(force, force));
    if (!jm_bits(known))
        return;
    const JoxMask begun = jm_and(known, jm_or(jf_lt(zero, jv_dot(before, before)),
                                              jox_moved_by_others_lanes(a, first, old, force)));
    const JoxFloats pushed = jf_max(zero, jv_dot(move, force));
    const JoxVector now = jv_add(before, jv_add(move, jv_scale(force, JOX_STEP_BEYOND * pushed)));
    const JoxFloats size = jf_sqrt(jv_dot(now, now)), settled = jf_load(a->settled + first);
    const JoxFloats away = jv_dot(move, now) / (size * dt);
    const JoxMask holds = jm_and(jm_and(begun, jox_stands_lanes(a, first)),
                                 jf_lt(zero, jox_param_lanes(a, JOX_PARAM_step_back, first)));
    const JoxMask far = jm_and(jf_lt(jf_set(JOX_STEP_LEAST), size), jf_lt(size, jf_set(INFINITY)));
    const JoxMask kept = jm_and(holds, far);
    const JoxVector after = jv_scale(now, jox_share_kept_lanes(size, settled, away, dt));
    jv_store(a->displaced_x, a->displaced_y, first,
             jv_select(kept, after, (JoxVector){zero, zero}));
    const JoxMask rests = jm_without(kept, jf_lt(jf_set(JOX_STEP_REST), away));
    jf_store(a->settled + first, jf_select(rests, settled + dt, zero));
}

#endif
