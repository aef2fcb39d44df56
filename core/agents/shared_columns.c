/* Columns that are stored once while all agents have the same value: parameters and own values. */
#include "agents/agents.h"

#include "base/assert.h"
#include "base/mem.h"
#include "simd/four.h"

/* Such a column of any type: pointers to its fields, the size of its cells, and the place of the
   single value; NULL: a block of its own. */
typedef struct Shared {
    void **cells;
    uint32_t *mask;
    size_t size;
    void *home;
} Shared;

static Shared refer_to_parameter(JoxAgents *a, JoxParameter p) {
    JOX_ASSERT(p < JOX_PARAM_COUNT);
    return (Shared){(void **)&a->param[p].cells, &a->param[p].mask, sizeof(float),
                    a->alike + (size_t)p * JOX_AGENTS_PADDING};
}

static Shared refer_to_own(JoxAgents *a, uint32_t slot) {
    JOX_ASSERT(slot < a->own_count);
    return (Shared){(void **)&a->own[slot].cells, &a->own[slot].mask, sizeof(double), NULL};
}

static void repeat_cell(char *cells, const void *value, size_t size, size_t count) {
    for (size_t i = 0; i < count; i++)
        memcpy(cells + i * size, value, size);
}

static void replace_cells(Shared s, void *cells, uint32_t mask) {
    if (*s.cells != s.home)
        jox_free(*s.cells);
    *s.cells = cells;
    *s.mask = mask;
}

/* Stores one value for all agents, in as many cells as a packet reads. */
static void hold_once(Shared s, const void *value) {
    char *cells = s.home ? s.home : jox_alloc_aligned(JOX_AGENTS_PADDING, s.size);
    repeat_cell(cells, value, s.size, JOX_AGENTS_PADDING);
    replace_cells(s, cells, 0);
}

static void give_each_a_cell(const JoxAgents *a, Shared s) {
    if (*s.mask)
        return;
    char *cells = jox_alloc_aligned((size_t)a->capacity + JOX_AGENTS_PADDING, s.size);
    repeat_cell(cells, *s.cells, s.size, (size_t)a->count + JOX_AGENTS_PADDING);
    replace_cells(s, cells, UINT32_MAX);
}

static void set_cell(const JoxAgents *a, Shared s, uint32_t i, const void *value) {
    JOX_ASSERT(i < a->count);
    if (*s.mask == 0 && memcmp(*s.cells, value, s.size) == 0)
        return;
    if (*s.mask == 0 && a->count == 1) {
        repeat_cell(*s.cells, value, s.size, JOX_AGENTS_PADDING);
        return;
    }
    give_each_a_cell(a, s);
    memcpy((char *)*s.cells + i * s.size, value, s.size);
}

void jox_shared_create(JoxAgents *a) {
    const double zero = 0.0;
    if (!a->alike)
        a->alike = jox_alloc_aligned((size_t)JOX_PARAM_COUNT * JOX_AGENTS_PADDING, sizeof(float));
    for (JoxParameter p = 0; p < JOX_PARAM_COUNT; p++) {
        const float value = jox_parameter_store(p, jox_parameters[p].value);
        if (!a->param[p].cells)
            hold_once(refer_to_parameter(a, p), &value);
    }
    for (uint32_t slot = 0; slot < a->own_count; slot++)
        if (!a->own[slot].cells)
            hold_once(refer_to_own(a, slot), &zero);
}

float jox_param_greatest(const JoxAgents *a, JoxParameter p) {
    const JoxParameterColumn column = a->param[p];
    return a->count ? jox_greatest(column.cells, column.mask ? a->count : 1) : 0.0f;
}

void jox_param_differ(JoxAgents *a, JoxParameter p) {
    give_each_a_cell(a, refer_to_parameter(a, p));
}

void jox_param_set(JoxAgents *a, JoxParameter p, uint32_t i, float value) {
    set_cell(a, refer_to_parameter(a, p), i, &value);
}

void jox_own_differ(JoxAgents *a, uint32_t slot) {
    give_each_a_cell(a, refer_to_own(a, slot));
}

void jox_own_share(JoxAgents *a, uint32_t slot, double value) {
    hold_once(refer_to_own(a, slot), &value);
}

void jox_own_set(JoxAgents *a, uint32_t i, uint32_t slot, double value) {
    set_cell(a, refer_to_own(a, slot), i, &value);
}

static void store_once_if_equal(const JoxAgents *a, Shared s) {
    if (*s.mask && jox_is_same_of_all(*s.cells, s.size, a->count))
        hold_once(s, *s.cells);
}

void jox_shared_settle(JoxAgents *a) {
    for (JoxParameter p = 0; p < JOX_PARAM_COUNT && a->count; p++)
        store_once_if_equal(a, refer_to_parameter(a, p));
    for (uint32_t slot = 0; slot < a->own_count && a->count; slot++)
        store_once_if_equal(a, refer_to_own(a, slot));
}
