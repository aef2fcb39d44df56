/* Solves contacts of agents with bodies, equation 7, together with the supports of the bodies
   (support/) and the limits of driven ones (bodies_driven.c). */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "force/contact/contacts.h"
#include "force/support/supports.h"

void jox_touches_start_solve(JoxForces *f) {
    const JoxKeptImpulses *kept = &f->contacts->kept[JOX_KEPT_TOUCHES];
    JoxTouches *touches = &f->contacts->touches;
    const JoxAgents *a = f->step.agents;
    size_t at = 0;
    if (!touches->count)
        return;
    jox_supports_start_solve(f, touches->items, touches->count);
    for (uint32_t k = 0; k < touches->count; k++) {
        JoxTouch *t = &touches->items[k];
        const JoxObject *body = &f->step.objects->rows[t->object];
        float give = jox_body_inverse_mass(body, t->point, t->normal);
        float restitution =
            jox_minf(jox_param(a, JOX_PARAM_restitution, t->agent), body->restitution);
        float speed = jox_dot(jox_v2(a->vx[t->agent], a->vy[t->agent]), t->normal) -
                      jox_touch_speed_before(f, t);
        t->mass =
            1.0f / ((1.0f + t->lever * t->lever) / jox_param(a, JOX_PARAM_mass, t->agent) + give);
        t->target = jox_contact_target(t->gap - JOX_BODY_SLACK, speed, restitution,
                                       (float)f->step.timing.dt);
        t->impulse = jox_find_kept(kept, &at, a->id[t->agent], t->object)->impulse;
        JOX_ASSERT(t->mass > 0.0f);
    }
    jox_drives_find(f);
    for (uint32_t k = 0; k < touches->count; k++)
        jox_touch_apply_impulse(f, &touches->items[k], touches->items[k].impulse);
}

/* Runs in ascending agent id, on one thread: touches are few. */
float jox_touches_solve_once(JoxForces *f) {
    const JoxContactMotion *motions = f->contacts->solve.motions;
    JoxTouches *touches = &f->contacts->touches;
    if (!touches->count)
        return 0.0f;
    float most = jox_supports_solve_once(f);
    for (uint32_t k = 0; k < touches->count; k++) {
        JoxTouch *t = &touches->items[k];
        float speed =
            jox_speed_along(&motions[t->agent], t->normal, t->lever) - jox_touch_speed_after(f, t);
        t->before = t->impulse;
        t->impulse = jox_maxf(0.0f, t->before + (t->target - speed) * t->mass);
        jox_touch_apply_impulse(f, t, t->impulse - t->before);
    }
    jox_drives_limit_impulses(f);
    for (uint32_t k = 0; k < touches->count; k++)
        most = jox_maxf(most, fabsf(touches->items[k].impulse - touches->items[k].before));
    return most;
}

/* Targets ask for no more than the solve of forces reached: its rounding is no matter of plans. */
void jox_touches_start_bearing(JoxForces *f) {
    const JoxContactMotion *motions = f->contacts->solve.motions; /* as that solve left them */
    JoxTouches *touches = &f->contacts->touches;
    for (uint32_t k = 0; k < touches->count; k++) {
        JoxTouch *t = &touches->items[k];
        t->before = 0.0f;
        t->target =
            jox_contact_target(t->gap - JOX_BODY_SLACK, 0.0f, 0.0f, (float)f->step.timing.dt) +
            jox_touch_speed_after(f, t);
        t->target = jox_minf(t->target, jox_speed_along(&motions[t->agent], t->normal, t->lever));
    }
}

bool jox_touches_start_parting(JoxForces *f) {
    JoxTouches *touches = &f->contacts->touches;
    bool parts = false;
    for (uint32_t k = 0; k < touches->count; k++) {
        JoxTouch *t = &touches->items[k];
        const float speed = jox_parting_speed(f, t->gap);
        if (!(speed > 0.0f))
            continue;
        t->target = speed + jox_touch_speed_after(f, t);
        parts = true;
    }
    return parts;
}

void jox_touches_give_impulses(JoxForces *f) {
    JoxKeptImpulses *kept = &f->contacts->kept[JOX_KEPT_TOUCHES];
    JoxTouches *touches = &f->contacts->touches;
    const JoxAgents *a = f->step.agents;
    JoxForceTotals *totals = &f->totals;
    uint32_t inside = JOX_NO_INDEX; /* agent counted last: touches are sorted by agent */
    JOX_RESERVE(kept->items, kept->capacity, touches->count);
    kept->count = touches->count;
    if (touches->count && !f->options.literal) {
        jox_supports_find_held_shares(f, touches->items, touches->count);
        jox_drives_slow_bodies(f);
    }
    for (uint32_t k = 0; k < touches->count; k++) {
        const JoxTouch *t = &touches->items[k];
        kept->items[k] = (JoxKeptImpulse){a->id[t->agent], t->object, t->impulse, 0.0f, 0.0f};
        const JoxObject *body = &f->step.objects->rows[t->object];
        const bool moves = body->inverse_mass > 0.0f;
        if (body->kinematic && t->gap + a->contact_radius[t->agent] < 0.0f && t->agent != inside) {
            inside = t->agent;
            totals->inside++;
        }
        if (!(t->impulse > 0.0f) || !(moves || body->kinematic)) /* other bodies feel nothing */
            continue;
        JOX_ASSERT(jox_is_unit(t->normal) && t->agent < a->count);
        JoxV2 impulse = jox_scale(t->normal, t->impulse);
        totals->touched_x += moves ? (double)impulse.x : 0.0;
        totals->touched_y += moves ? (double)impulse.y : 0.0;
        totals->touched += moves ? (double)t->impulse : 0.0;
        jox_impulses_add(&f->impulses, a->id[t->agent], t->object,
                         (JoxV3){-impulse.x, -impulse.y, 0.0f}, t->point,
                         f->options.literal ? 0.0f : f->supports->motions[t->object].held);
    }
}
