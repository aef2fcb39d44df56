/* Impulses of a step on bodies, sorted by their keys. */
#include "force/impulses.h"

#include "base/mem.h"
#include "base/sort.h"

void jox_impulses_add(JoxImpulses *i, uint32_t agent_id, uint32_t row, JoxV3 impulse, JoxV3 point,
                      float lasting) {
    const uint64_t key = (uint64_t)agent_id << 32 | row;
    JOX_RESERVE(i->pending, i->capacity, (size_t)i->count + 1);
    i->pending[i->count++] = (JoxPendingImpulse){key, {row, impulse, point, lasting}};
}

static int compare_impulse_keys(const void *a, const void *b, const void *context) {
    const JoxPendingImpulse *x = a, *y = b;
    (void)context;
    return (x->key > y->key) - (x->key < y->key);
}

const JoxImpulse *jox_impulses_sort(JoxImpulses *i, uint32_t *count) {
    if (i->sorted_count != i->count) {
        JOX_RESERVE(i->pending, i->capacity, i->count + JOX_SORT_SPARE(i->count));
        jox_sort(i->pending, i->count, sizeof *i->pending, compare_impulse_keys, NULL,
                 i->pending + i->count);
        JOX_RESERVE(i->sorted, i->sorted_capacity, i->count);
        for (uint32_t k = 0; k < i->count; k++)
            i->sorted[k] = i->pending[k].impulse;
        i->sorted_count = i->count;
    }
    *count = i->count;
    return i->sorted;
}

void jox_impulses_free(JoxImpulses *impulses) {
    jox_free(impulses->pending);
    jox_free(impulses->sorted);
}
