/* The kernel that computes where the torsos of agents are; a lane is an agent. */
#include "agents/torso_lanes.h"
#include "nav/near/perceive.h"
#include "simd/vectors.h"

/* Writes the torsos of a packet. */
static void shape_torsos(const JoxPerceive *p, uint32_t i, const JoxTorsoLanes *torso) {
    JoxAgents *a = p->agents;
    const JoxFloats zero = jf_set(0.0f), one = jf_set(1.0f);
    const JoxVector chest = jv_load(a->chest_x, a->chest_y, i);
    /* A chest that is not finite, which the world reports, must not spoil those beside it. */
    const JoxMask sound = jf_lt(jv_dot(chest, chest), jf_set(2.0f));
    const JoxVector axis = jv_select(
        sound, (JoxVector){-chest.y * torso->half, chest.x * torso->half}, (JoxVector){zero, zero});
    const JoxMask is_long = jf_lt(zero, torso->half);
    const JoxFloats half2 = jf_select(is_long, torso->half * torso->half, one);
    const JoxFloats inverse = jf_select(is_long, one / half2, zero);
    float of[4][JOX_WIDTH];
    jv_store(of[0], of[1], 0, axis);
    jf_store(of[2], torso->radius);
    jf_store(of[3], inverse);
    jv_store(a->axis_x, a->axis_y, i, axis);
    jf_store(a->spin + i, jf_select(is_long, jf_load(a->spin + i), zero));
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        p->out->shapes[i + lane] =
            (JoxTorsoShape){of[0][lane], of[1][lane], of[2][lane], of[3][lane]};
}

void JOX_WIDE(jox_shape_packets)(const JoxPerceive *p, uint32_t begin, uint32_t end) {
    JoxAgents *a = p->agents;
    const JoxFloats zero = jf_set(0.0f);
    const JoxVector none = {zero, zero};
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        JoxTorsoLanes torso = {jox_param_lanes(a, JOX_PARAM_radius, i), zero};
        if (!p->nav->literal)
            torso = jox_torso_lanes(a, i);
        jf_store(a->contact_radius + i, torso.radius);
        if (p->out->has_torsos) {
            shape_torsos(p, i, &torso);
            continue;
        }
        jv_store(a->axis_x, a->axis_y, i, none); /* discs do not turn */
        jf_store(a->spin + i, zero);
    }
}
