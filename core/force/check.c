/* Checks of what the stages of force hand on; builds with assertions call them. */
#include <math.h>

#include "base/assert.h"
#include "force/internal.h"

void jox_transfers_check(const JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    for (uint32_t i = 0; i < a->count; i++) {
        JOX_ASSERT(f->starts[i] <= f->starts[i + 1]);
        for (uint32_t k = f->starts[i]; k < f->starts[i + 1]; k++) {
            JOX_ASSERT(f->sorted[k].to == i);
            JOX_ASSERT(jox_agents_find(a, f->sorted[k].from_id) != JOX_NO_INDEX);
        }
    }
}

void jox_contacts_check(const JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    double x = 0.0, y = 0.0, size = 0.0;
    for (uint32_t c = 0; c < f->chunks; c++) {
        const JoxPair *p = (const JoxPair *)f->pairs.items + (size_t)c * f->pairs.room;
        for (uint32_t k = 0; k < f->pairs.counts[c]; k++) {
            JOX_ASSERT(p[k].first < a->count && p[k].second < a->count);
            JOX_ASSERT(!(p[k].impulse < 0.0f));
            size += (double)p[k].impulse / f->step.dt;
        }
    }
    for (uint32_t i = 0; i < a->count; i++) {
        JOX_ASSERT(a->contacts[i] || (a->contact_x[i] == 0.0f && a->contact_y[i] == 0.0f));
        x += (double)a->contact_x[i];
        y += (double)a->contact_y[i];
    }
    JOX_ASSERT(!(fabs(x) + fabs(y) > 1e-3 + 1e-4 * size)); /* what one gets another gives */
}
