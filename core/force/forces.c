/* Scratch, transfers between agents, and the list of impulses on bodies. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "force/internal.h"

JoxForceOptions jox_force_default_options(void) {
    return (JoxForceOptions){.iterations = 4, .reach = 0.6f, .filter = 0.13f, .least = 0.05f};
}

void jox_forces_set_options(JoxForces *f, const JoxForceOptions *options) {
    f->options = options ? *options : jox_force_default_options();
}

JoxForces *jox_forces_create(const JoxForceOptions *options) {
    JoxForces *f = jox_alloc(1, sizeof *f);
    jox_forces_set_options(f, options);
    return f;
}

void jox_forces_free(JoxForces *f) {
    if (!f)
        return;
    void *owned[] = {
        f->transfers.items, f->transfers.counts, f->starts,         f->sorted, f->pairs.items,
        f->pairs.counts,    f->touches.items,    f->touches.counts, f->ends,   f->touch,
        f->first_touch,     f->touch_number,     f->motions,        f->work_x, f->work_y,
        f->pending,         f->impulses,         f->old_x,          f->old_y,  f->chunk};
    for (size_t i = 0; i < sizeof owned / sizeof *owned; i++)
        jox_free(owned[i]);
    jox_free(f);
}

static float widest_radius(const JoxAgents *a) {
    float widest = 0.0f;
    for (uint32_t i = 0; i < a->count; i++)
        widest = jox_maxf(widest, a->param[JOX_PARAM_radius][i]);
    return widest;
}

/* The terms that do not carry over from the last step. */
static void zero_terms(JoxAgents *a) {
#define ZERO_STATE(column)
#define ZERO_SCRATCH(column) memset(column, 0, a->count * sizeof *column);
#define ZERO(X, keep, name, label) ZERO_##keep(a->name##_x) ZERO_##keep(a->name##_y)
    JOX_FORCE_TERMS(ZERO, )
#undef ZERO
#undef ZERO_SCRATCH
#undef ZERO_STATE
}

void jox_force_begin(JoxForces *f, const JoxForceStep *step) {
    JOX_ASSERT(step && step->agents && step->neighbours && step->dt > 0.0);
    f->step = *step;
    if (!(f->step.planning_time > 0.0))
        f->step.planning_time = step->dt;
    f->totals = (JoxForceTotals){0};
    f->pending_count = f->pending_sorted = 0;
    f->touch_count = 0;
    JoxAgents *a = step->agents;
    uint32_t n = a->count;
    f->chunks = (n + JOX_FORCE_GRAIN - 1) / JOX_FORCE_GRAIN;
    JOX_RESERVE(f->chunk, f->chunk_capacity, f->chunks);
    JOX_RESERVE(f->starts, f->start_capacity, (size_t)n + 1);
    JOX_RESERVE(f->old_x, f->old_x_capacity, n);
    JOX_RESERVE(f->old_y, f->old_y_capacity, n);
    if (f->chunks)
        memset(f->chunk, 0, f->chunks * sizeof *f->chunk);
    if (n) {
        zero_terms(a);
        memset(a->compression, 0, n * sizeof *a->compression);
        memset(a->load, 0, n * sizeof *a->load);
        memset(a->contacts, 0, n);
    }
    JOX_ASSERT(step->neighbours->agents >= n || n == 0);
    f->widest = widest_radius(a);
    f->bodies = n && step->objects && step->objects->grid.columns;
}

JoxForceTotals jox_force_totals(const JoxForces *f) {
    return f->totals;
}
