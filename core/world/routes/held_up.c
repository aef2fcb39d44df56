#include "world/routes/held_up.h"

#include <string.h>

#include "base/mem.h"

/* Returns by how much an agent is held up: the lacking share of its preferred speed, in
   1 / JOX_HELD. */
static uint32_t measure_hold_up(const JoxAgents *a, uint32_t i) {
    JoxV2 preferred = {a->pref_x[i], a->pref_y[i]}, velocity = {a->vx[i], a->vy[i]};
    float speed2 = jox_length2(preferred);
    if (!(speed2 > 0.0f))
        return 0;
    float share = 1.0f - jox_dot(velocity, preferred) / speed2;
    return (uint32_t)(jox_clampf(share, 0.0f, 1.0f) * (float)JOX_HELD);
}

void jox_held_up_sum(const JoxAgents *a, uint32_t *held, uint32_t places) {
    if (places)
        memset(held, 0, places * sizeof *held);
    for (uint32_t i = 0; i < a->count; i++)
        if (a->bound[i] && a->bound[i] <= places)
            held[jox_referred(a->bound[i])] += measure_hold_up(a, i);
}

JoxFieldCrowd jox_held_up_list(const JoxAgents *a, uint32_t place, float slowing, JoIsa isa) {
    JoxFieldCrowd crowd = {.at = jox_alloc(a->count + 1, sizeof *crowd.at),
                           .held = jox_alloc(a->count + 1, sizeof *crowd.held),
                           .slowing = slowing,
                           .isa = isa};
    for (uint32_t rank = 0; rank < a->count; rank++) { /* in ascending id */
        uint32_t i = a->by_rank[rank],
                 held = jox_referred(a->bound[i]) == (int32_t)place ? measure_hold_up(a, i) : 0;
        if (held == 0)
            continue;
        crowd.at[crowd.count] = (JoxV2){a->x[i], a->y[i]};
        crowd.held[crowd.count++] = (float)held / (float)JOX_HELD;
    }
    return crowd;
}
