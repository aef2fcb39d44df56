/* Solves the supports of bodies (supports.c) in sweeps. In a pile, most contacts settle after a few
   sweeps, while the chain of agents that push on it needs dozens. So after some passes a contact is
   tested again only once its bodies may have changed enough, and solved only where its impulses
   would change enough.

   1 N s along one axis of a contact changes the speed along another axis of the same body by at
   most the product of the sways of both (inequality of Cauchy and Schwarz, in the inner product of
   the inverse masses). So the unrest of a body, the sum of each impulse on it times its sway,
   bounds the change of any contact's impulse in any direction; and clamping makes no change
   greater. */
#include <math.h>

#include "force/support/supports.h"

enum {
    SWEEPS = 2,     /* over the supports, per pass over all contacts */
    FULL_PASSES = 6 /* passes in which all are solved: few bodies need no more, and settle as
                 without skipping */
};

/* Share of the tolerance: the error that a contact may have when it is tested, and as much again
   until it is tested anew. */
static const float SETTLED_SHARE = 0.125f;

/* Returns the velocity of the first body relative to the second along an axis, m/s. */
static inline float measure_speed(const JoxBodyMotion *first, const JoxBodyMotion *second,
                                  const JoxSupportAxis *axis) {
    const JoxFour p = axis->along * (first->velocity - second->velocity) +
                      (axis->lever[0] * first->spin - axis->lever[1] * second->spin);
    return p[0] + p[1] + p[2];
}

/* Applies an impulse, N s, along an axis to both bodies, and adds to their unrest. */
static inline void apply_impulse(JoxBodyMotion *first, JoxBodyMotion *second,
                                 const JoxSupportAxis *axis, float impulse) {
    const float size = fabsf(impulse);
    first->velocity += axis->along * (axis->inverse_mass[0] * impulse);
    first->spin += axis->turning[0] * impulse;
    first->unrest += axis->sway[0] * size;
    second->velocity -= axis->along * (axis->inverse_mass[1] * impulse);
    second->spin -= axis->turning[1] * impulse;
    second->unrest += axis->sway[1] * size;
}

void jox_supports_apply_first_impulses(JoxSupports *supports) {
    for (uint32_t k = 0; k < supports->count; k++) {
        const JoxSupport *s = &supports->items[k];
        apply_impulse(&supports->motions[s->rows[0]], &supports->motions[s->rows[1]], &s->normal,
                      s->normal.impulse);
    }
}

/* Returns the normal impulse that the present motions ask for, N s. */
static inline float find_normal_impulse(const JoxBodyMotion *first, const JoxBodyMotion *second,
                                        const JoxSupport *s) {
    float speed = measure_speed(first, second, &s->normal);
    return jox_maxf(0.0f, s->normal.impulse + (s->target - speed) * s->normal.mass);
}

/* Returns the friction impulses that they ask for, N s, at most `friction` times the normal
   impulse. */
static inline JoxV2 find_friction(const JoxBodyMotion *first, const JoxBodyMotion *second,
                                  const JoxSupport *s) {
    const JoxSupportAxis *x = &s->across[0], *y = &s->across[1];
    JoxV2 wanted = {x->impulse - measure_speed(first, second, x) * x->mass,
                    y->impulse - measure_speed(first, second, y) * y->mass};
    float size = jox_length(wanted), most = s->friction * s->normal.impulse;
    return size > most ? jox_scale(wanted, most / size) : wanted;
}

static inline void set_impulse(JoxBodyMotion *first, JoxBodyMotion *second, JoxSupportAxis *axis,
                               float impulse) {
    apply_impulse(first, second, axis, impulse - axis->impulse);
    axis->impulse = impulse;
}

/* Solves one contact; returns the change of its normal impulse, N s. The effect of its own friction
   counts as unrest that is not answered yet. */
static float solve_support(JoxBodyMotion *first, JoxBodyMotion *second, JoxSupport *s,
                           JoxSupportWatch *watch) {
    const float before = s->normal.impulse;
    set_impulse(first, second, &s->normal, find_normal_impulse(first, second, s));
    watch->tested_unrest[0] = first->unrest;
    watch->tested_unrest[1] = second->unrest;
    watch->remaining = 0.0f;
    const JoxV2 rub = find_friction(first, second, s);
    set_impulse(first, second, &s->across[0], rub.x);
    set_impulse(first, second, &s->across[1], rub.y);
    return fabsf(s->normal.impulse - before);
}

/* Returns by how much the impulses of a contact would change at most, N s. */
static inline float find_change(const JoxBodyMotion *first, const JoxBodyMotion *second,
                                const JoxSupport *s) {
    const JoxV2 rub = find_friction(first, second, s);
    return jox_maxf(
        fabsf(find_normal_impulse(first, second, s) - s->normal.impulse),
        jox_maxf(fabsf(rub.x - s->across[0].impulse), fabsf(rub.y - s->across[1].impulse)));
}

/* Returns whether the impulses of a contact would change by little (N s) only; *most is then the
   bound of the change. */
static inline bool is_settled(const JoxBodyMotion *first, const JoxBodyMotion *second,
                              const JoxSupport *s, JoxSupportWatch *w, float little, float *most) {
    const float since = w->most_per_unrest[0] * (first->unrest - w->tested_unrest[0]) +
                        w->most_per_unrest[1] * (second->unrest - w->tested_unrest[1]);
    if (since > little) {
        const float due = find_change(first, second, s);
        if (!(due <= little))
            return false;
        w->tested_unrest[0] = first->unrest;
        w->tested_unrest[1] = second->unrest;
        *most = w->remaining = due;
        return true;
    }
    *most = w->remaining + since;
    return true;
}

/* Runs one sweep over all contacts in their order; returns the greatest change of a normal impulse,
   N s. `whole`: solves all of them. */
static float sweep_supports(JoxForces *f, bool whole) {
    JoxSupports *supports = f->supports;
    const float little = SETTLED_SHARE * f->options.tolerance * (float)f->step.timing.dt;
    float most = 0.0f;
    for (uint32_t k = 0; k < supports->count; k++) {
        JoxSupportWatch *w = &supports->watches[k];
        JoxBodyMotion *first = &supports->motions[w->rows[0]],
                      *second = &supports->motions[w->rows[1]];
        JoxSupport *s = &supports->items[k];
        float change;
        if (whole || !is_settled(first, second, s, w, little, &change))
            change = solve_support(first, second, s, w);
        most = jox_maxf(most, change);
    }
    return most;
}

float jox_supports_solve_once(JoxForces *f) {
    const bool whole = f->totals.passes < FULL_PASSES;
    float most = 0.0f;
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        most = sweep_supports(f, whole);
    return most;
}
