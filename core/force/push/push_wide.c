/* The kernel of push: who pushes whom, equation 5; a lane is an agent. */
#include "force/cone_lanes.h"
#include "force/push/pushes.h"

/* Returns the directions of pushes, unit vectors: `push_toward`, else that of the preferred
   velocity; (0, 0) without either. */
static JoxVector find_aims(const JoxForces *f, uint32_t i) {
    const JoxAgents *a = f->step.agents;
    const JoxVector preferred = jv_unit(jv_load(a->pref_x, a->pref_y, i));
    if (!f->in.push_toward_x || !f->in.push_toward_y)
        return preferred;
    const JoxVector toward = jv_unit(jv_load(f->in.push_toward_x, f->in.push_toward_y, i));
    return jv_select(jv_is_nonzero(toward), toward, preferred);
}

/* Returns which agents from i on, before `end`, push if somebody is there. */
static JoxMask find_pushing(const JoxForces *f, uint32_t i, uint32_t end) {
    const JoxMask push = jf_lt(jf_set(0.0f), jox_param_lanes(f->step.agents, JOX_PARAM_push, i));
    const JoxMask there = jm_and(push, jm_of_bits(jox_first_lanes(end - i)));
    if (!f->in.push_on)
        return there;
    return jm_and(there, ji_less(ji_set(0), ji_load_bytes(f->in.push_on + i)));
}

bool JOX_WIDE(jox_push_packets)(const JoxForces *f, uint32_t begin, uint32_t end,
                                JoxPushing *pushing) {
    const JoxAgents *a = f->step.agents;
    const JoxConeReach reach = {.angle = JOX_PARAM_push_angle};
    const JoxVector none = {jf_set(0.0f), jf_set(0.0f)};
    bool any = false;
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        const uint32_t at = i - begin;
        const JoxMask on = find_pushing(f, i, end);
        any |= jm_bits(on) != 0;
        if (!jm_bits(on)) {
            jv_store(pushing->aim_x, pushing->aim_y, at, none);
            continue;
        }
        const JoxVector aim = jv_select(on, find_aims(f, i), none);
        const JoxFloats own =
            jox_param_lanes(a, JOX_PARAM_push_reach, i) + jox_param_lanes(a, JOX_PARAM_radius, i);
        const JoxFoundLanes people =
            jox_find_people_in_cone(f, i, jm_bits(jv_is_nonzero(aim)), &reach, aim, own);
        jv_store(pushing->aim_x, pushing->aim_y, at, aim);
        ji_store(pushing->people.found + at, people.found);
        ji_store(pushing->people.doubtful + at, people.doubtful);
    }
    return any;
}
