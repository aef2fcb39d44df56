/* Literal mode: contacts as the paper prints them, equations 6 and 7; in place of solve.c. */
#include "base/assert.h"
#include "force/contact/contacts.h"

/* (6) Solves each overlapping pair by itself, from the velocities before the step. */
static void solve_single_pairs(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const JoxAgents *a = f->step.agents;
    const JoxParameterColumn mass = a->param[JOX_PARAM_mass];
    const JoxParameterColumn e = a->param[JOX_PARAM_restitution];
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    for (uint32_t k = begin; k < end; k++) {
        JoxPair *p = &f->contacts->pairs.items[k];
        uint32_t i = p->first, j = p->second;
        float touch = jox_at(radius, i) + jox_at(radius, j);
        p->impulse = 0.0f;
        if (!(jox_length2(jox_offset(a, i, j)) < touch * touch))
            continue;
        float speed =
            (a->vx[i] - a->vx[j]) * p->at.normal.x + (a->vy[i] - a->vy[j]) * p->at.normal.y;
        p->impulse = jox_contact_impulse(speed, jox_minf(jox_at(e, i), jox_at(e, j)),
                                         1.0f / jox_at(mass, i) + 1.0f / jox_at(mass, j));
    }
}

/* (6), (7) Solves each contact with a body by itself; the body opposes its mass alone, wherever it
   is hit. */
static void solve_single_touches(JoxForces *f) {
    JoxTouches *touches = &f->contacts->touches;
    const JoxAgents *a = f->step.agents;
    for (uint32_t k = 0; k < touches->count; k++) {
        JoxTouch *t = &touches->items[k];
        const JoxObject *body = &f->step.objects->rows[t->object];
        JoxV3 turning = jox_cross3(body->spin, (JoxV3){t->point.x - body->position.x,
                                                       t->point.y - body->position.y,
                                                       t->point.z - body->position.z});
        float speed = (a->vx[t->agent] - body->velocity.x - turning.x) * t->normal.x +
                      (a->vy[t->agent] - body->velocity.y - turning.y) * t->normal.y;
        float e = jox_minf(jox_param(a, JOX_PARAM_restitution, t->agent), body->restitution);
        t->impulse =
            t->gap < 0.0f
                ? jox_contact_impulse(
                      speed, e, 1.0f / jox_param(a, JOX_PARAM_mass, t->agent) + body->inverse_mass)
                : 0.0f;
    }
}

void jox_literal_contacts(JoxForces *f) {
    JOX_ASSERT(f->options.literal);
    jox_parallel_for(f->step.pool, f->contacts->pairs.count, JOX_FORCE_GRAIN, solve_single_pairs,
                     f);
    solve_single_touches(f);
}
