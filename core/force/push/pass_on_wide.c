/* The kernel of infer: which agents pass forces on to whom, equations 8 and 9; a lane is an agent.
   Lanes behind the last agent hold meaningless numbers. tests/unit/force_one.h has the same for one
   agent, equal to the bit. */
#include <string.h>

#include "force/cone_lanes.h"
#include "force/push/pass_on.h"
#include "force/terms_lanes.h"

/* (9) Returns by how much the feet keep agents, in this step, below the velocity along a unit
   vector that the force would give, m/s: the part of others' pushes that they hold, and what they
   take from the forced velocity, minus what they wear down anyway. It adds up step by step, so that
   neither the step nor the length of a plan changes it. `old`: velocities before the step. */
static JoxFloats find_shortfall(const JoxForces *f, uint32_t i, JoxVector old, JoxVector unit,
                                JoxDecay *decay) {
    const JoxAgents *a = f->step.agents;
    const float dt = (float)f->step.timing.dt, *damping = jox_params(a, JOX_PARAM_damping, i);
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxFloats inverse_mass = one / jox_param_lanes(a, JOX_PARAM_mass, i);
    const JoxVector others = jox_sum_terms_lanes(a, i, JOX_FORCE_BRACED);
    const JoxVector held = jv_sub(others, jox_unheld_lanes(a, i, others, jox_stands_lanes(a, i)));
    const JoxVector taken =
        jv_sub(jv_load(a->forced_x, a->forced_y, i), jv_load(a->next_x, a->next_y, i));
    const JoxFloats along = jf_max(zero, jv_dot(old, unit));
    const JoxFloats worn = along * (one - jox_decay_lanes(damping, dt, decay));
    const JoxFloats holds = jv_dot(held, unit) * dt * inverse_mass;
    const JoxFloats takes = jv_dot(taken, unit) * (float)f->step.timing.response;
    return holds + takes - worn;
}

/* (8) Returns the lanes that, under no force, slowed down enough for others to feel. Only what the
   feet took counts, as contacts and other forces have acted on others already. */
static JoxMask find_slowing(const JoxForces *f, uint32_t i, JoxVector old) {
    const JoxAgents *a = f->step.agents;
    const JoxFloats zero = jf_set(0.0f), one = jf_set(1.0f);
    const JoxFloats least = jf_set(f->options.least * (float)f->step.timing.dt);
    const JoxFloats cosine = jox_param_lanes(a, JOX_PARAM_brace_angle, i);
    const JoxVector before = jv_load(a->forced_x, a->forced_y, i);
    JoxVector after = jv_load(a->vx, a->vy, i);
    if (f->step.neighbours->has_torsos)
        after = jv_sub(after, jv_load(a->borne_x, a->borne_y, i));
    const JoxVector change = jv_sub(after, before), way = jv_add(after, before);
    const JoxFloats against = -jv_dot(change, way), change2 = jv_dot(change, change);
    const JoxFloats bound = cosine * cosine * change2 * jv_dot(way, way);
    const JoxMask aligned = jm_or(jf_le(cosine, zero), jf_lt(bound, against * against));
    const JoxFloats size = jf_sqrt(change2), most = jf_sqrt(jv_dot(before, before));
    const JoxMask cut = jf_lt(most, size);
    const JoxVector slowing = jv_scale(change, jf_select(cut, most / size, one)); /* jox_slowing */
    const JoxFloats absorb = jox_param_lanes(a, JOX_PARAM_absorb, i);
    const JoxFloats felt = jf_sqrt(jv_dot(slowing, slowing)) * absorb;
    return jm_and(jm_and(jf_lt(zero, against), aligned),
                  jm_and(jm_and(jv_is_nonzero(old), jf_lt(zero, absorb)), jf_le(least, felt)));
}

void JOX_WIDE(jox_infer_packets)(const JoxForces *f, uint32_t begin, uint32_t end,
                                 JoxPassing *passing) {
    const JoxAgents *a = f->step.agents;
    const JoxFloats least = jf_set(JOX_SHORTFALL_LEAST), zero = jf_set(0.0f);
    const JoxConeReach reach = {JOX_PARAM_brace_angle, f->options.reach, true};
    JoxDecay decay = f->decay;
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        const JoxVector unit = jv_load(a->half_plane_x, a->half_plane_y, i);
        const uint32_t forced = jm_bits(jv_is_nonzero(unit));
        JoxFloats motion[4];
        jf_fours((const float *)&f->step.neighbours->motions[i], 4, motion);
        const JoxVector old = {motion[2], motion[3]};
        JoxFloats lacks = zero;
        uint32_t resists = 0;
        if (forced) {
            lacks = find_shortfall(f, i, old, unit, &decay);
            resists = jm_bits(
                jm_and(jf_lt(least, lacks), jf_lt(zero, jox_param_lanes(a, JOX_PARAM_absorb, i))));
        }
        const uint32_t slows = jm_bits(find_slowing(f, i, old)) & ~forced;
        if (!(resists | slows)) {
            memset(passing->kind + (i - begin), JOX_PASSES_NOTHING, JOX_WIDTH);
            continue;
        }
        const uint32_t at = i - begin, passes = slows | (resists & forced),
                       there = jox_first_lanes(end - i);
        const JoxVector axis =
            jv_select(jm_of_bits(slows), jv_unit(jv_load(a->forced_x, a->forced_y, i)), unit);
        const JoxFoundLanes people = jox_find_people_in_cone(
            f, i, passes & there, &reach, axis, jox_param_lanes(a, JOX_PARAM_radius, i));
        jf_store(passing->shortfall + at, lacks);
        ji_store(passing->people.found + at, people.found);
        ji_store(passing->people.doubtful + at, people.doubtful);
        for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
            passing->kind[at + lane] =
                (uint8_t)((resists & forced) >> lane & 1 ? JOX_PASSES_RESISTANCE
                          : slows >> lane & 1            ? JOX_PASSES_DECELERATION
                                                         : JOX_PASSES_NOTHING);
    }
}
