/* The kernels between the motions of the contact solve and the agents' columns; a lane is an
   agent. */
#include <float.h>

#include "agents/torso_lanes.h"
#include "force/contact/contacts.h"
#include "force/terms_lanes.h"

/* Numbers of a motion, as rows (JoxContactMotion). */
enum { X, Y, SPIN, INVERSE_MASS };

static inline void load_motions(const JoxForces *f, uint32_t i, JoxFloats out[4]) {
    jf_fours((const float *)&f->contacts->solve.motions[i], 4, out);
}

static inline void put_motions(const JoxForces *f, uint32_t i, const JoxFloats motions[4]) {
    float *rows[JOX_WIDTH];
    JOX_UNROLL
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        rows[lane] = (float *)&f->contacts->solve.motions[i + lane];
    jf_put_rows(rows, motions);
}

static inline JoxMask are_finite(JoxFloats x) {
    return jf_le(jf_abs(x), jf_set(FLT_MAX));
}

/* Computes the velocities that all forces except contacts give by the end of the step, and 1 /
   mass. A velocity that is not finite starts as 0, so that it does not spread to other agents; the
   step reports its agent at the end. */
void JOX_WIDE(jox_start_motions)(JoxForces *f, uint32_t begin, uint32_t end) {
    const JoxAgents *a = f->step.agents;
    const JoxFloats zero = jf_set(0.0f), dt = jf_set((float)f->step.timing.dt);
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        const JoxFloats inverse_mass = 1.0f / jox_param_lanes(a, JOX_PARAM_mass, i);
        const JoxVector force = jox_moving_lanes(a, i, jox_stands_lanes(a, i));
        const JoxVector change = jv_scale(jv_scale(force, inverse_mass), dt);
        const JoxVector begins = jv_add(jv_load(a->vx, a->vy, i), change);
        const JoxMask finite = jm_and(are_finite(begins.x), are_finite(begins.y));
        const JoxVector starts = jv_select(finite, begins, (JoxVector){zero, zero});
        const JoxFloats turns = jf_load(a->spin + i) * jox_gyration_lanes(a, i);
        const JoxFloats spin = jf_select(are_finite(turns), turns, zero);
        const JoxFloats motions[4] = {starts.x, starts.y, spin, inverse_mass};
        put_motions(f, i, motions);
    }
}

/* Writes the agents' spins, rad/s, by those of their motions, and returns them. One that is not
   finite stays, for the step to report. */
static inline JoxFloats write_spins(const JoxForces *f, uint32_t i, JoxFloats of_motions) {
    JoxAgents *a = f->step.agents;
    const JoxFloats before = jf_load(a->spin + i);
    const JoxFloats spin = of_motions / jox_gyration_lanes(a, i);
    jf_store(a->spin + i, jf_select(are_finite(before), spin, before));
    return spin;
}

void JOX_WIDE(jox_end_motions)(JoxForces *f, uint32_t begin, uint32_t end) {
    JoxFloats motions[4];
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        load_motions(f, i, motions);
        write_spins(f, i, motions[SPIN]);
    }
}

/* Computes the mean velocities within the step, as they are planned. */
void JOX_WIDE(jox_start_bearing)(JoxForces *f, uint32_t begin, uint32_t end) {
    const JoxAgents *a = f->step.agents;
    const JoxFloats on_the_way = jf_set((float)f->step.timing.on_the_way);
    JoxFloats motions[4];
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        load_motions(f, i, motions);
        const JoxVector forced = jv_load(a->forced_x, a->forced_y, i);
        const JoxVector rest = jv_sub(jv_load(a->next_x, a->next_y, i), forced);
        const JoxVector mean = jv_add(forced, jv_scale(rest, on_the_way));
        motions[X] = mean.x;
        motions[Y] = mean.y;
        put_motions(f, i, motions);
        jv_store(a->borne_x, a->borne_y, i, (JoxVector){-mean.x, -mean.y});
    }
}

/* Writes what contacts have changed of the velocities and spins so far. */
void JOX_WIDE(jox_end_bearing)(JoxForces *f, uint32_t begin, uint32_t end) {
    JoxAgents *a = f->step.agents;
    JoxFloats motions[4];
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        load_motions(f, i, motions);
        const JoxVector velocity = {motions[X], motions[Y]};
        jv_store(a->borne_x, a->borne_y, i, jv_add(jv_load(a->borne_x, a->borne_y, i), velocity));
        jv_store(a->parted_x, a->parted_y, i, (JoxVector){-velocity.x, -velocity.y});
        jf_store(a->parted_spin + i, -write_spins(f, i, motions[SPIN]));
    }
}

/* Writes what contacts have changed since. */
void JOX_WIDE(jox_end_parting)(JoxForces *f, uint32_t begin, uint32_t end) {
    JoxAgents *a = f->step.agents;
    JoxFloats motions[4];
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        load_motions(f, i, motions);
        const JoxVector velocity = {motions[X], motions[Y]};
        jv_store(a->parted_x, a->parted_y, i,
                 jv_add(jv_load(a->parted_x, a->parted_y, i), velocity));
        const JoxFloats spin = motions[SPIN] / jox_gyration_lanes(a, i);
        jf_store(a->parted_spin + i, jf_load(a->parted_spin + i) + spin);
    }
}
