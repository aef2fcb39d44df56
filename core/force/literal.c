/* What only the mode `literal` does: terms of the net force as the paper prints them. */
#include "base/assert.h"
#include "force/equations.h"
#include "force/internal.h"

/* (6) Each overlapping pair by itself, at the velocities that the step began with. */
static void pair_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const JoxAgents *a = f->step.agents;
    const float *mass = a->param[JOX_PARAM_mass], *e = a->param[JOX_PARAM_restitution];
    const float *radius = a->param[JOX_PARAM_radius];
    JoxPairs *p = &f->pairs;
    for (uint32_t k = begin; k < end; k++) {
        uint32_t i = p->first[k], j = p->second[k];
        float touch = radius[i] + radius[j];
        p->impulse[k] = 0.0f;
        if (!(jox_length2(jox_offset(a, i, j)) < touch * touch))
            continue;
        float speed = (a->vx[i] - a->vx[j]) * p->nx[k] + (a->vy[i] - a->vy[j]) * p->ny[k];
        p->impulse[k] =
            jox_contact_impulse(speed, jox_minf(e[i], e[j]), 1.0f / mass[i] + 1.0f / mass[j]);
    }
}

/* (6), (7) Each touch of a body by itself; the body opposes its mass alone, wherever it is hit. */
static void touch_bodies(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    for (uint32_t k = 0; k < f->touch_count; k++) {
        JoxTouch *t = &f->touch[k];
        const JoxObject *body = &f->step.objects->rows[t->object];
        JoxV3 turning = jox_cross3(body->spin, jox_arm_of(body, t->point));
        float speed = (a->vx[t->agent] - body->velocity.x - turning.x) * t->normal.x +
                      (a->vy[t->agent] - body->velocity.y - turning.y) * t->normal.y;
        float e = jox_minf(a->param[JOX_PARAM_restitution][t->agent], body->restitution);
        t->impulse =
            t->gap < 0.0f
                ? jox_contact_impulse(
                      speed, e, 1.0f / a->param[JOX_PARAM_mass][t->agent] + body->inverse_mass)
                : 0.0f;
    }
}

void jox_literal_contacts(JoxForces *f) {
    JOX_ASSERT(f->options.literal);
    jox_parallel_for(f->step.pool, f->pairs.count, JOX_FORCE_GRAIN, pair_chunk, f);
    touch_bodies(f);
}
