/* What only the mode `literal` does: terms of the net force as the paper prints them. */
#include "base/assert.h"
#include "force/equations.h"
#include "force/internal.h"

/* (6) Each pair by itself, at the velocities that the step began with. */
static void pairs_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    (void)end;
    JoxForces *f = context;
    const JoxAgents *a = f->step.agents;
    const float *mass = a->param[JOX_PARAM_mass], *e = a->param[JOX_PARAM_restitution];
    uint32_t chunk = begin / JOX_FORCE_GRAIN;
    JoxPair *list = (JoxPair *)f->pairs.items + (size_t)chunk * f->pairs.room;
    for (uint32_t k = 0; k < f->pairs.counts[chunk]; k++) {
        JoxPair *p = &list[k];
        float speed = (a->vx[p->first] - a->vx[p->second]) * p->nx +
                      (a->vy[p->first] - a->vy[p->second]) * p->ny;
        p->impulse = jox_contact_impulse(speed, jox_minf(e[p->first], e[p->second]),
                                         1.0f / mass[p->first] + 1.0f / mass[p->second]);
    }
}

/* (6), (7) Each touch of a body by itself; the body opposes its mass alone, wherever it is hit. */
static void touch_bodies(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    for (uint32_t k = 0; k < f->touch_count; k++) {
        JoxTouch *t = &f->touch[k];
        const JoxObject *body = &f->step.objects->rows[t->object];
        JoxV3 arm = {t->point.x - body->position.x, t->point.y - body->position.y,
                     t->point.z - body->position.z};
        JoxV3 turning = jox_cross3(body->spin, arm);
        float speed = (a->vx[t->agent] - body->velocity.x - turning.x) * t->normal.x +
                      (a->vy[t->agent] - body->velocity.y - turning.y) * t->normal.y;
        float e = jox_minf(a->param[JOX_PARAM_restitution][t->agent], body->restitution);
        t->impulse = jox_contact_impulse(
            speed, e, 1.0f / a->param[JOX_PARAM_mass][t->agent] + body->inverse_mass);
    }
}

void jox_literal_contacts(JoxForces *f) {
    JOX_ASSERT(f->options.literal);
    jox_parallel_for(f->step.pool, f->step.agents->count, JOX_FORCE_GRAIN, pairs_chunk, f);
    touch_bodies(f);
}
