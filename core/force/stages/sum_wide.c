/* The kernel of sum, equations 10 to 12: a lane is an agent. By the end of the step the velocity
   has the part along the force that (11) gives; the step goes the share `response` of the way from
   the forced velocity to the planned one. Lanes behind the last agent hold meaningless numbers.
   tests/unit/force_one.h has the same for one agent, equal to the bit. */
#include "force/stages/kernels.h"
#include "force/terms_lanes.h"

static inline JoxMask has_force(JoxVector a) {
    return jf_lt(jf_set(0.0f), jf_max(jf_abs(a.x), jf_abs(a.y)));
}

/* Returns whether all bits of all lanes are zero. */
static inline bool is_nothing(JoxVector a) {
    return jm_bits(ji_equal(ji_or(jf_bits(a.x), jf_bits(a.y)), ji_set(0))) == JOX_ALL_LANES;
}

/* Writes a packet on which no force acts. Columns that are zero already are not written; in sparse
   crowds they stay untouched. */
static void write_unforced(JoxAgents *a, uint32_t i, JoxFloats most) {
    const JoxFloats zero = jf_set(0.0f);
    const JoxVector none = {zero, zero};
    jf_store(a->speed_limit + i, most);
    if (!is_nothing(jv_load(a->force_x, a->force_y, i)))
        jv_store(a->force_x, a->force_y, i, none);
    if (is_nothing(jv_load(a->half_plane_x, a->half_plane_y, i)) &&
        is_nothing((JoxVector){jf_load(a->half_plane_offset + i), zero}))
        return;
    jv_store(a->half_plane_x, a->half_plane_y, i, none);
    jf_store(a->half_plane_offset + i, zero);
}

/* How long agents plan ahead, by lane (JoxPlanning, and the decay over the interval); agents that
   stand plan in each step. */
typedef struct Planning {
    JoxFloats interval, response, forced, decay;
} Planning;

static Planning load_planning(const JoxStep *step, uint32_t i, JoxMask stands, JoxDecay decays[2]) {
    const float *damping = jox_params(step->agents, JOX_PARAM_damping, i);
    const JoxPlanning own[2] = {jox_planning(&step->timing, false),
                                jox_planning(&step->timing, true)};
    return (Planning){
        jf_select(stands, jf_set(own[1].interval), jf_set(own[0].interval)),
        jf_select(stands, jf_set(own[1].response), jf_set(own[0].response)),
        jf_select(stands, jf_set(own[1].forced), jf_set(own[0].forced)),
        jf_select(stands, jox_decay_lanes(damping, own[1].interval, &decays[1]),
                  jox_decay_lanes(damping, own[0].interval, &decays[0])),
    };
}

/* Writes the net force, the forced velocity, the half-plane and the speed limit of the packet from
   agent i on. */
static void sum_packet(JoxForces *f, uint32_t i, JoxDecay decays[2]) {
    JoxAgents *a = f->step.agents;
    const JoxFloats zero = jf_set(0.0f), dt = jf_set((float)f->step.timing.dt);
    const JoxFloats mass = jox_param_lanes(a, JOX_PARAM_mass, i);
    const JoxFloats most = jox_param_lanes(a, JOX_PARAM_max_speed, i);
    const JoxVector velocity = jv_load(a->vx, a->vy, i),
                    contact = jox_sum_terms_lanes(a, i, JOX_FORCE_CONTACT | JOX_FORCE_GROUND);
    const JoxVector force = jox_sum_terms_lanes(a, i, JOX_FORCE_ALL); /* (10) */
    const JoxMask touched = has_force(jox_sum_terms_lanes(a, i, JOX_FORCE_CONTACT));
    const JoxMask stands = jox_stands_lanes(a, i);
    const JoxVector moving = jox_moving_lanes(a, i, stands);
    const JoxVector given = jv_add(moving, contact);
    const JoxVector forced = {velocity.x + given.x * dt / mass, velocity.y + given.y * dt / mass};
    jv_store(a->forced_x, a->forced_y, i, forced);
    if (is_nothing(force)) {
        write_unforced(a, i, most);
        return;
    }
    jv_store(a->force_x, a->force_y, i, force);
    const JoxFloats size = jf_sqrt(jv_dot(force, force));
    /* Even the faintest contact bounds a plan: otherwise what the feet took of it would be missing
       from the total momentum. Not that of an agent which steps back, by its own feet. */
    const JoxMask slightest = jm_without(touched, jox_steps_back_lanes(a, i));
    const JoxFloats least = jf_select(slightest, jf_set(1e-6f), jf_set(f->options.least));
    const JoxMask felt = jm_and(jf_le(least * mass, size), jf_lt(size, jf_set(INFINITY)));
    const Planning plan = load_planning(&f->step, i, stands, decays);
    const JoxVector normal = jv_scale(force, 1.0f / size);
    const JoxFloats along = jv_dot(velocity, normal), pressed = jv_dot(contact, normal) / mass;
    const JoxFloats driven = jv_dot(moving, normal) / mass;
    JoxFloats wanted = jf_select(jf_lt(zero, along), along * plan.decay, along);
    wanted += size * plan.interval / mass;
    /* Contacts act within this step only, however long the plan is kept. */
    wanted -= pressed * (plan.interval - dt);
    const JoxFloats moved = along + pressed * dt + driven * plan.forced;
    const JoxFloats offset = moved + (wanted - moved) / plan.response;
    jv_store(a->half_plane_x, a->half_plane_y, i,
             (JoxVector){jf_select(felt, normal.x, zero), jf_select(felt, normal.y, zero)});
    jf_store(a->half_plane_offset + i, jf_select(felt, offset, zero));
    /* Only contacts may carry an agent faster than its greatest speed. */
    jf_store(a->speed_limit + i,
             jf_select(jm_and(felt, touched), jf_max(most, jf_sqrt(jv_dot(forced, forced))), most));
}

void JOX_WIDE(jox_sum_packets)(JoxForces *f, uint32_t begin, uint32_t end) {
    JoxDecay decays[2] = {f->decay, f->decay};
    for (uint32_t i = begin; i < end; i += JOX_WIDTH)
        sum_packet(f, i, decays);
}
