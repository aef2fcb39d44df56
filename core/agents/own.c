/* Own values, a column each: what is the same of all agents is held once. */
#include "agents/agents.h"

#include "base/assert.h"
#include "base/mem.h"

void jox_own_differ(JoxAgents *a, uint32_t slot, bool each) {
    JoxOwnColumn *column = &a->own[slot];
    JOX_ASSERT(slot < a->own_count);
    if (each == (column->each != NULL))
        return;
    if (!each) {
        column->all = a->count ? column->each[0] : 0.0;
        jox_free(column->each);
        column->each = NULL;
        return;
    }
    column->each = jox_alloc_aligned((size_t)a->capacity + JOX_AGENTS_PADDING, sizeof(double));
    for (uint32_t i = 0; i < a->count; i++)
        column->each[i] = column->all;
}

void jox_own_set(JoxAgents *a, uint32_t i, uint32_t slot, double value) {
    JoxOwnColumn *column = &a->own[slot];
    JOX_ASSERT(i < a->count && slot < a->own_count);
    if (!column->each && memcmp(&column->all, &value, sizeof value) == 0)
        return;
    if (!column->each && a->count == 1) {
        column->all = value;
        return;
    }
    jox_own_differ(a, slot, true);
    column->each[i] = value;
}

void jox_own_settle(JoxAgents *a) {
    for (uint32_t s = 0; s < a->own_count && a->count; s++)
        if (a->own[s].each && jox_is_same_of_all(a->own[s].each, sizeof(double), a->count))
            jox_own_differ(a, s, false);
}
