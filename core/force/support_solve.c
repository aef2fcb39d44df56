/* Sweeps over what holds bodies (support.c). Of a pile, most contacts have found their forces after
   a few sweeps, while the chain of those who push on it goes on for dozens. So after some passes a
   contact is looked at again only once its bodies may have changed by enough, and solved only where
   its impulses would change by enough.

   By how much 1 N s along one axis of a contact changes the speed along another of the same body is
   at most the product of the sways of both (the inequality of Cauchy and Schwarz, in the product of
   vectors that the inverse masses make). So what a body got, each impulse times its sway, all added
   up (its unrest), bounds what a contact would change by, whatever directions these had; and
   clamping makes no change greater. */
#include <math.h>

#include "force/internal.h"

enum {
    SWEEPS = 2, /* over these contacts in a pass over all */
    WHOLE = 6 /* passes in which all are solved: few bodies need no more, and stand as they would */
};

/* Of the tolerance: what a contact may be off by when it is looked at, and as much again before it
   is looked at anew. */
static const float LITTLE = 0.125f;

/* Velocity of the first against the second, along an axis. */
static inline float speed_along(const JoxBodyMotion *first, const JoxBodyMotion *second,
                                const JoxSupportAxis *axis) {
    const JoxFour p = axis->along * (first->velocity - second->velocity) +
                      (axis->lever[0] * first->spin - axis->lever[1] * second->spin);
    return p[0] + p[1] + p[2];
}

static inline void give(JoxBodyMotion *first, JoxBodyMotion *second, const JoxSupportAxis *axis,
                        float impulse) {
    const float size = fabsf(impulse);
    first->velocity += axis->along * (axis->lightness[0] * impulse);
    first->spin += axis->turning[0] * impulse;
    first->unrest += axis->sway[0] * size;
    second->velocity -= axis->along * (axis->lightness[1] * impulse);
    second->spin -= axis->turning[1] * impulse;
    second->unrest += axis->sway[1] * size;
}

void jox_supports_warm(JoxForces *f) {
    for (uint32_t k = 0; k < f->support_count; k++) {
        const JoxSupport *s = &f->support[k];
        give(&f->motions[s->rows[0]], &f->motions[s->rows[1]], &s->normal, s->normal.impulse);
    }
}

/* What presses, as the bodies move now. */
static inline float pressing(const JoxBodyMotion *first, const JoxBodyMotion *second,
                             const JoxSupport *s) {
    float speed = speed_along(first, second, &s->normal);
    return jox_maxf(0.0f, s->normal.impulse + (s->target - speed) * s->normal.mass);
}

/* Friction likewise, at most `friction` times what presses there. */
static inline JoxV2 rubbing(const JoxBodyMotion *first, const JoxBodyMotion *second,
                            const JoxSupport *s) {
    const JoxSupportAxis *x = &s->across[0], *y = &s->across[1];
    JoxV2 wanted = {x->impulse - speed_along(first, second, x) * x->mass,
                    y->impulse - speed_along(first, second, y) * y->mass};
    float size = jox_length(wanted), most = s->friction * s->normal.impulse;
    return size > most ? jox_scale(wanted, most / size) : wanted;
}

static inline void set_impulse(JoxBodyMotion *first, JoxBodyMotion *second, JoxSupportAxis *axis,
                               float impulse) {
    give(first, second, axis, impulse - axis->impulse);
    axis->impulse = impulse;
}

/* By how much what presses changes. What the contact's own friction does then counts as unrest that
   it has not answered yet. */
static float solve_one(JoxBodyMotion *first, JoxBodyMotion *second, JoxSupport *s,
                       JoxSupportWatch *watch) {
    const float before = s->normal.impulse;
    set_impulse(first, second, &s->normal, pressing(first, second, s));
    watch->answered[0] = first->unrest;
    watch->answered[1] = second->unrest;
    watch->left = 0.0f;
    const JoxV2 rub = rubbing(first, second, s);
    set_impulse(first, second, &s->across[0], rub.x);
    set_impulse(first, second, &s->across[1], rub.y);
    return fabsf(s->normal.impulse - before);
}

/* By how much an impulse of a contact would change. */
static inline float change_due(const JoxBodyMotion *first, const JoxBodyMotion *second,
                               const JoxSupport *s) {
    const JoxV2 rub = rubbing(first, second, s);
    return jox_maxf(
        fabsf(pressing(first, second, s) - s->normal.impulse),
        jox_maxf(fabsf(rub.x - s->across[0].impulse), fabsf(rub.y - s->across[1].impulse)));
}

/* Whether what is left to change of a contact's impulses is little, N s; then `most` is told by how
   much what presses there would change at most. */
static inline bool is_done(const JoxBodyMotion *first, const JoxBodyMotion *second,
                           const JoxSupport *s, JoxSupportWatch *w, float little, float *most) {
    const float since = w->answer[0] * (first->unrest - w->answered[0]) +
                        w->answer[1] * (second->unrest - w->answered[1]);
    if (since > little) {
        const float due = change_due(first, second, s);
        if (!(due <= little))
            return false;
        w->answered[0] = first->unrest;
        w->answered[1] = second->unrest;
        *most = w->left = due;
        return true;
    }
    *most = w->left + since;
    return true;
}

/* Over all contacts, in their order; returns the greatest change of what presses, N s. */
static float sweep_over(JoxForces *f, bool whole) {
    const float little = LITTLE * f->options.tolerance * (float)f->step.dt;
    float most = 0.0f;
    for (uint32_t k = 0; k < f->support_count; k++) {
        JoxSupportWatch *w = &f->watch[k];
        JoxBodyMotion *first = &f->motions[w->rows[0]], *second = &f->motions[w->rows[1]];
        JoxSupport *s = &f->support[k];
        float change;
        if (whole || !is_done(first, second, s, w, little, &change))
            change = solve_one(first, second, s, w);
        most = jox_maxf(most, change);
    }
    return most;
}

float jox_supports_pass(JoxForces *f) {
    const bool whole = f->totals.passes < WHOLE;
    float most = 0.0f;
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        most = sweep_over(f, whole);
    return most;
}
