/* The kernel that computes the start of the contact solve; a lane is an agent. */
#include <float.h>

#include "agents/torso_lanes.h"
#include "force/contact/contacts.h"
#include "force/terms_lanes.h"

static inline JoxMask are_finite(JoxFloats x) {
    return jf_le(jf_abs(x), jf_set(FLT_MAX));
}

/* Computes the velocities that all forces except contacts give by the end of the step, and 1 /
   mass. A velocity that is not finite starts as 0, so that it does not spread to other agents; the
   step reports its agent at the end. */
void JOX_WIDE(jox_start_packets)(JoxForces *f, uint32_t begin, uint32_t end) {
    JoxContactSolve *solve = &f->contacts->solve;
    const JoxAgents *a = f->step.agents;
    const JoxFloats zero = jf_set(0.0f), dt = jf_set((float)f->step.timing.dt);
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        const JoxFloats inverse_mass = 1.0f / jox_param_lanes(a, JOX_PARAM_mass, i);
        const JoxVector force = jox_moving_lanes(a, i, jox_stands_lanes(a, i));
        const JoxVector change = jv_scale(jv_scale(force, inverse_mass), dt);
        const JoxVector begins = jv_add(jv_load(a->vx, a->vy, i), change);
        const JoxMask finite = jm_and(are_finite(begins.x), are_finite(begins.y));
        float x[JOX_WIDTH], y[JOX_WIDTH], spin[JOX_WIDTH], inverse[JOX_WIDTH];
        jf_store(inverse, inverse_mass);
        jv_store(x, y, 0, jv_select(finite, begins, (JoxVector){zero, zero}));
        const JoxFloats turns = jf_load(a->spin + i) * jox_gyration_lanes(a, i);
        jf_store(spin, jf_select(are_finite(turns), turns, zero));
        for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
            solve->motions[i + lane] =
                (JoxContactMotion){x[lane], y[lane], spin[lane], inverse[lane]};
    }
}
