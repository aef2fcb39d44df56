/* Checks the results of the stage contact; called in builds with assertions only. */
#include <math.h>

#include "base/assert.h"
#include "force/contact/contacts.h"

/* Asserts that no agent occurs twice in a colour, that no contact pulls, and that the forces of
   contacts between agents cancel out. */
void jox_contacts_check(const JoxForces *f) {
    const JoxPairs *pairs = &f->contacts->pairs;
    const JoxTouches *touches = &f->contacts->touches;
    const JoxWallContacts *walls = &f->contacts->walls;
    const JoxAgents *a = f->step.agents;
    double x = 0.0, y = 0.0, size = 0.0, per_second = 1.0 / f->step.timing.dt;
    for (uint32_t k = 0; k < pairs->count; k++) {
        const JoxPair *pair = &pairs->items[k];
        JOX_ASSERT(pair->first < a->count && pair->second < a->count);
        JOX_ASSERT(!(pair->impulse < 0.0f));
        size += (double)pair->impulse * per_second;
    }
    for (uint32_t i = 0; i < a->count; i++) {
        uint64_t colours = 0;
        for (uint32_t k = pairs->end_starts[i]; k < pairs->end_starts[i + 1]; k++) {
            uint32_t c = 0;
            while (pairs->ends[k].pair >= pairs->starts[c + 1])
                c++;
            JOX_ASSERT(!(colours >> c & 1));
            colours |= (uint64_t)1 << c;
        }
    }
    for (uint32_t i = 0; i < a->count; i++) {
        x += (double)a->contact_x[i];
        y += (double)a->contact_y[i];
    }
    for (uint32_t k = 0; k < touches->count; k++) {
        x -= (double)(touches->items[k].normal.x * touches->items[k].impulse) * per_second;
        y -= (double)(touches->items[k].normal.y * touches->items[k].impulse) * per_second;
        size += (double)touches->items[k].impulse * per_second;
    }
    for (uint32_t k = 0; k < walls->count; k++) {
        const JoxV2 impulse = jox_wall_impulse(&walls->items[k]);
        x -= (double)impulse.x * per_second;
        y -= (double)impulse.y * per_second;
        size += (double)walls->items[k].impulse * per_second;
    }
    JOX_ASSERT(!(fabs(x) + fabs(y) > 1e-2 + 1e-4 * size));
}
