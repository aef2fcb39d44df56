/* Sections of the agents' state, for hashing, saving and restoring; and overwriting their
   scratch. */
#include <string.h>

#include "agents/agents.h"
#include "base/mem.h"

/* Treatment of a column by its mark: only state is listed. */
#define KEEP_STATE(s, a, name)                                                                     \
    jox_section_ordered(s, #name, (a)->name, sizeof *(a)->name, (a)->count, order);
#define KEEP_RARE(s, a, name)                                                                      \
    if ((s)->mode != JOX_SECTIONS_HASH ||                                                          \
        !jox_mem_is((a)->name, 0, (a)->count * sizeof *(a)->name))                                 \
    KEEP_STATE(s, a, name)
#define KEEP_SCRATCH(s, a, name)
#define KEEP_HINT(s, a, name)
#define KEEP_INDEX(s, a, name)

/* Hashes own values agent by agent, so that the hash does not depend on whether a column is stored
   once. */
static void hash_own(JoxAgents *a, JoxSections *s, const uint32_t *order) {
    double *row = jox_alloc((size_t)a->own_count + 1, sizeof *row);
    for (uint32_t k = 0; k < a->count; k++) {
        const uint32_t i = order ? order[k] : k;
        const uint32_t count = a->machine[i] == JOX_NO_MACHINE ? 0 : a->own_count;
        for (uint32_t slot = 0; slot < count; slot++)
            row[slot] = jox_own(a, i, slot);
        jox_section_rows(s, "own", row, count, 1, NULL);
    }
    jox_free(row);
}

/* Lists own values for saving: one section per slot, of one cell or of a cell per agent. */
static void list_own(JoxAgents *a, JoxSections *s, const uint32_t *order) {
    if (s->mode == JOX_SECTIONS_HASH) {
        hash_own(a, s, order);
        return;
    }
    if (s->mode != JOX_SECTIONS_RESTORE)
        jox_shared_settle(a); /* columns with equal cells are saved alike, whatever their history */
    for (uint32_t slot = 0; slot < a->own_count; slot++) {
        JoxOwnColumn *column = &a->own[slot];
        uint8_t each = column->mask != 0;
        jox_sections_unhashed(s, true);
        JOX_SECTION(s, "own_differ", each);
        jox_sections_unhashed(s, false);
        if (s->mode == JOX_SECTIONS_RESTORE && each && !s->failed)
            jox_own_differ(a, slot);
        if (column->mask)
            jox_section_ordered(s, "own", column->cells, sizeof(double), a->count, order);
        else
            jox_section(s, "own", column->cells, sizeof(double), a->count ? 1 : 0);
        if (s->mode == JOX_SECTIONS_RESTORE && !column->mask)
            jox_own_share(a, slot, column->cells[0]);
    }
}

/* Returns whether a rare parameter is at its default in all agents, and left out of hashes. */
static bool is_unused(const JoxAgents *a, JoxParameter p) {
    if (p < (JoxParameter)JOX_FIRST_RARE_PARAM)
        return false;
    const float usual = jox_parameter_store(p, jox_parameters[p].value);
    for (uint32_t i = 0; i < a->count; i++)
        if (jox_param(a, p, i) != usual)
            return false;
    return true;
}

/* Lists a parameter with a cell per agent, even if it is stored once. */
static void list_parameter(JoxAgents *a, JoxSections *s, JoxParameter p, const uint32_t *order) {
    float *cells = a->spare;
    if (s->mode == JOX_SECTIONS_HASH && is_unused(a, p))
        return;
    if (s->mode == JOX_SECTIONS_RESTORE || s->mode == JOX_SECTIONS_VISIT)
        jox_param_differ(a, p); /* restoring and visiting write to the cells */
    if (a->param[p].mask)
        cells = a->param[p].cells;
    else
        for (uint32_t i = 0; i < a->count; i++)
            cells[i] = jox_param(a, p, i);
    jox_section_ordered(s, jox_parameters[p].name, cells, sizeof *cells, a->count, order);
}

static void list_agent_columns(JoxAgents *a, JoxSections *s, const uint32_t *order) {
#define X(keep, type, name) KEEP_##keep(s, a, name)
    JOX_AGENT_COLUMNS(X)
#undef X
    for (JoxParameter p = 0; p < JOX_PARAM_COUNT; p++)
        list_parameter(a, s, p, order);
    list_own(a, s, order);
    jox_section_rows(s, "memory", a->memory, a->memory_stride, a->count, order);
}

/* Lists handles. Free slots keep their generation, so that old handles stay invalid. */
static void list_slots(JoxAgents *a, JoxSections *s) {
    jox_section(s, "slot_generation", a->slot_generation, sizeof *a->slot_generation,
                a->slot_count);
    jox_section(s, "free_slots", a->free_slots, sizeof *a->free_slots, a->free_count);
}

/* Restores the sizes, and makes room. Returns false, and changes nothing, if they are
   inconsistent. */
static bool restore_sizes(JoxAgents *a, JoxSections *s) {
    size_t id_size = sizeof *a->id, row = sizeof *a->memory;
    size_t count = jox_section_count(s, "count", 0, id_size);
    size_t own = jox_section_count(s, "own_count", 0, sizeof(uint8_t));
    size_t memory = jox_section_count(s, "memory_stride", 0, row);
    size_t slots = jox_section_count(s, "slot_count", 0, sizeof *a->slot_generation);
    size_t spare = jox_section_count(s, "free_count", 0, sizeof *a->free_slots);
    uint32_t next_id = 0;
    JOX_SECTION(s, "next_id", next_id);
    if (count + spare != slots || count > next_id)
        jox_sections_fail(s, "count", "agents and free slots do not add up");
    if (s->failed)
        return false;
    a->count = 0; /* no rows need to be moved, as all are about to be read */
    jox_agents_reserve(a, (uint32_t)count);
    for (uint32_t slot = 0; slot < a->own_count; slot++)
        jox_free(a->own[slot].cells);
    jox_free(a->own);
    jox_free(a->memory);
    a->own = NULL;
    a->memory = NULL;
    a->own_count = a->memory_stride = 0;
    jox_agents_widen(a, (uint32_t)own, (uint32_t)memory);
    jox_agents_reserve_slots(a, (uint32_t)slots);
    a->count = (uint32_t)count;
    a->slot_count = (uint32_t)slots;
    a->free_count = (uint32_t)spare;
    a->next_id = next_id;
    return true;
}

/* Rebuilds ranks and the tables of ranks and slots from restored ids and slots. */
static void restore_indices(JoxAgents *a, JoxSections *s) {
    for (uint32_t k = 0; k < a->slot_count; k++)
        a->slot_index[k] = JOX_NO_INDEX;
    for (uint32_t i = 0; i < a->count && !s->failed; i++) {
        if (a->id[i] >= a->next_id || (i && a->id[i] <= a->id[i - 1]))
            jox_sections_fail(s, "id", "ids do not ascend");
        else if (a->slot[i] >= a->slot_count || a->slot_index[a->slot[i]] != JOX_NO_INDEX)
            jox_sections_fail(s, "slot", "two agents have one slot");
        else
            a->slot_index[a->slot[i]] = a->rank[i] = a->by_rank[i] = i;
        a->rank_id[i] = a->id[i];
    }
    for (uint32_t k = 0; k < a->free_count; k++)
        if (a->free_slots[k] >= a->slot_count || a->slot_index[a->free_slots[k]] != JOX_NO_INDEX)
            jox_sections_fail(s, "free_slots", "a free slot is taken");
    if (s->failed)
        a->count = a->slot_count = a->free_count = 0;
}

void jox_agents_sections(JoxAgents *a, JoxSections *s) {
    jox_sections_module(s, "agents");
    jox_shared_create(a); /* there may never have been an agent */
    if (s->mode == JOX_SECTIONS_RESTORE) {
        uint32_t own = a->own_count, memory = a->memory_stride;
        if (!restore_sizes(a, s))
            return;
        list_agent_columns(a, s, NULL);
        list_slots(a, s);
        restore_indices(a, s);
        jox_shared_settle(a);
        jox_agents_widen(a, own, memory); /* machines added since may need wider rows */
        return;
    }
    jox_section_count(s, "count", a->count, sizeof *a->id);
    jox_sections_unhashed(s, true); /* an older machine may have left wider rows */
    jox_section_count(s, "own_count", a->own_count, sizeof(uint8_t));
    jox_section_count(s, "memory_stride", a->memory_stride, sizeof *a->memory);
    jox_sections_unhashed(s, false);
    jox_section_count(s, "slot_count", a->slot_count, sizeof *a->slot_generation);
    jox_section_count(s, "free_count", a->free_count, sizeof *a->free_slots);
    JOX_SECTION(s, "next_id", a->next_id);
    list_agent_columns(a, s, a->by_rank);
    list_slots(a, s);
}

#define FORGET_STATE(a, name)
#define FORGET_RARE(a, name)
#define FORGET_INDEX(a, name)
#define FORGET_SCRATCH(a, name) memset((a)->name, 0xff, (a)->count * sizeof *(a)->name);
#define FORGET_HINT(a, name) FORGET_SCRATCH(a, name)

void jox_agents_forget(JoxAgents *a) {
    if (a->count == 0)
        return;
        /* All bits set: NaN as a float, and the greatest integer. */
#define X(keep, type, name) FORGET_##keep(a, name)
    JOX_AGENT_COLUMNS(X)
#undef X
}
