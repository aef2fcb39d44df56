#include "luatest/history.h"

#include <string.h>

#include "base/assert.h"
#include "base/format/name.h"
#include "base/mem.h"

/* Returns the index of a state's name in `been`, or -1 if no agent has been in it. */
static int find_state_name(const JoxTestHistory *h, const char *name) {
    for (uint32_t n = 0; n < h->name_count; n++)
        if (strcmp(h->names[n], name) == 0)
            return (int)n;
    return -1;
}

/* Records that an agent has been in a state. */
static void mark_state(JoxTestHistory *h, const char *state, uint32_t id) {
    int n = find_state_name(h, state);
    if (n < 0 && h->name_count < JOX_TEST_STATES) {
        n = (int)h->name_count++;
        h->names[n] = jox_strdup(state);
        h->been[n] = jox_alloc(h->id_capacity + 1, 1);
    }
    if (n >= 0 && id < h->id_capacity)
        h->been[n][id] = 1;
}

void jox_test_history_note(JoxTestHistory *h, const JoxMachineRun *machines) {
    const JoxAgents *a = machines->agents;
    if (a->next_id > h->id_capacity) {
        uint32_t wider = a->next_id + a->next_id / 2 + 64;
        h->group = jox_realloc(h->group, wider, sizeof *h->group);
        for (uint32_t n = 0; n < h->name_count; n++) {
            h->been[n] = jox_realloc(h->been[n], wider + 1, 1);
            memset(h->been[n] + h->id_capacity, 0, wider + 1 - h->id_capacity);
        }
        h->id_capacity = wider;
    }
    JOX_ASSERT(h->known <= h->id_capacity && a->next_id <= h->id_capacity);
    for (; h->known < a->next_id; h->known++) {
        uint32_t i = jox_agents_find(a, h->known);
        h->group[h->known] = i == JOX_NO_INDEX ? -1 : a->group[i];
        if (i != JOX_NO_INDEX && a->machine[i] != JOX_NO_MACHINE)
            mark_state(h, machines->set->items[a->machine[i]]->states[a->state[i]].name, h->known);
    }
    for (uint32_t k = 0; k < machines->taken_count; k++) {
        const JoxTaken *taken = &machines->taken[k];
        mark_state(h, machines->set->items[taken->machine]->states[taken->to].name,
                   taken->agent_id);
        uint32_t i =
            jox_agents_find(a, taken->agent_id); /* `become` may have changed its machine */
        if (i != JOX_NO_INDEX)
            mark_state(h, machines->set->items[a->machine[i]]->states[a->state[i]].name,
                       taken->agent_id);
    }
}

uint32_t jox_test_history_been(const JoxTestHistory *h, const char *state, int32_t group,
                               int32_t *first) {
    uint32_t within[JOX_TEST_STATES], states = 0, count = 0;
    for (uint32_t n = 0; n < h->name_count; n++)
        if (jox_name_is_within(h->names[n], state))
            within[states++] = n;
    for (uint32_t id = 0; id < h->known && states; id++) {
        bool been = false;
        for (uint32_t k = 0; k < states; k++)
            been |= h->been[within[k]][id];
        been &= group < 0 || h->group[id] == group;
        if (been && count++ == 0 && first)
            *first = (int32_t)id;
    }
    return count;
}

void jox_test_history_free(JoxTestHistory *h) {
    for (uint32_t n = 0; n < h->name_count; n++) {
        jox_free(h->names[n]);
        jox_free(h->been[n]);
    }
    jox_free(h->group);
    *h = (JoxTestHistory){0};
}
