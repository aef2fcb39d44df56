/* Parts of one agent's forces, for inspection. */
#include "base/assert.h"
#include "force/contact/contacts.h"

JoxV2 jox_force_of_bodies(const JoxForces *f, uint32_t agent) {
    const JoxTouches *touches = &f->contacts->touches;
    JOX_ASSERT(agent < f->step.agents->capacity); /* agents may have left since */
    JoxV2 sum = {0.0f, 0.0f};
    for (uint32_t k = 0; k < touches->count; k++)
        if (touches->items[k].agent == agent)
            sum = jox_add(sum, jox_scale(touches->items[k].normal, touches->items[k].impulse));
    return jox_scale(sum, 1.0f / (float)f->step.timing.dt);
}

JoxV2 jox_force_from_slowing(const JoxForces *f, uint32_t agent, float *remaining) {
    const JoxAgents *a = f->step.agents;
    JoxV2 sum = {0.0f, 0.0f};
    *remaining =
        1.0f - (f->options.literal ? 1.0f : jox_filter_share(f->step.timing.dt, f->options.filter));
    if (!f->totals.passed)
        return sum;
    for (uint32_t k = f->transfers.starts[agent]; k < f->transfers.starts[agent + 1]; k++) {
        const JoxReceivedForce *t = &f->transfers.sorted[k];
        uint32_t giver = jox_agents_find(a, t->from_id);
        JOX_ASSERT(giver < a->count);
        if (!jox_under_force(f, giver))
            sum = jox_add(sum, (JoxV2){t->x, t->y});
    }
    return sum;
}
