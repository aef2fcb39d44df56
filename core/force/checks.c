/* Checks the results of the stages of force; called in builds with assertions only. */
#include <math.h>

#include "base/assert.h"
#include "force/forces.h"

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

/* Asserts that no agent occurs twice in a colour, that no contact pulls, and that the forces of
   contacts between agents cancel out. */
void jox_contacts_check(const JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    const JoxPairs *p = &f->pairs;
    double x = 0.0, y = 0.0, size = 0.0, per_second = 1.0 / f->step.dt;
    for (uint32_t k = 0; k < p->count; k++) {
        const JoxPair *pair = &p->items[k];
        JOX_ASSERT(pair->first < a->count && pair->second < a->count);
        JOX_ASSERT(!(pair->impulse < 0.0f));
        size += (double)pair->impulse * per_second;
    }
    for (uint32_t i = 0; i < a->count; i++) {
        uint64_t colours = 0;
        for (uint32_t k = f->end_starts[i]; k < f->end_starts[i + 1]; k++) {
            uint32_t c = 0;
            while (f->ends[k].pair >= p->starts[c + 1])
                c++;
            JOX_ASSERT(!(colours >> c & 1));
            colours |= (uint64_t)1 << c;
        }
    }
    for (uint32_t i = 0; i < a->count; i++) {
        x += (double)a->contact_x[i];
        y += (double)a->contact_y[i];
    }
    for (uint32_t k = 0; k < f->touch_count; k++) {
        x -= (double)(f->touch[k].normal.x * f->touch[k].impulse) * per_second;
        y -= (double)(f->touch[k].normal.y * f->touch[k].impulse) * per_second;
        size += (double)f->touch[k].impulse * per_second;
    }
    for (uint32_t k = 0; k < f->wall_count; k++) {
        x -= (double)(f->wall[k].normal.x * f->wall[k].impulse) * per_second;
        y -= (double)(f->wall[k].normal.y * f->wall[k].impulse) * per_second;
        size += (double)f->wall[k].impulse * per_second;
    }
    JOX_ASSERT(!(fabs(x) + fabs(y) > 1e-2 + 1e-4 * size));
}
