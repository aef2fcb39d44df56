#include "agents/agents.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"

/* Called for each column with the size of its entries, so that growing and sorting are one loop. */
typedef void ColumnVisitor(void *context, void **column, size_t size);
enum {
    COLUMN_STATE,
    COLUMN_RARE,
    COLUMN_INDEX,
    COLUMN_HINT,
    COLUMN_SCRATCH
}; /* the marks of columns,
      JOX_AGENT_COLUMNS */

/* Visits the columns of the list, with marks up to `last`. */
static inline void visit_common(JoxAgents *a, int last, ColumnVisitor *visit, void *context) {
#define X(keep, type, name)                                                                        \
    if (COLUMN_##keep <= last)                                                                     \
        visit(context, (void **)&a->name, sizeof(type));
    JOX_AGENT_COLUMNS(X)
#undef X
}

/* Visits parameters and own values that have a cell per agent, and memory. */
static inline void visit_special(JoxAgents *a, ColumnVisitor *visit, void *context) {
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        if (a->param[p].mask)
            visit(context, (void **)&a->param[p].cells, sizeof(float));
    for (uint32_t s = 0; s < a->own_count; s++)
        if (a->own[s].mask)
            visit(context, (void **)&a->own[s].cells, sizeof(double));
    if (a->memory_stride)
        visit(context, (void **)&a->memory, a->memory_stride * sizeof(double));
}

/* Visits all columns with marks up to `last`. */
static inline void visit_columns(JoxAgents *a, int last, ColumnVisitor *visit, void *context) {
    visit_common(a, last, visit, context);
    visit_special(a, visit, context);
}

typedef struct Growth {
    size_t old, new;
} Growth;

/* Grows a column. New memory is zero and takes no room until it is written, so zero cells are not
   copied: many columns stay zero. */
static void grow_column(void *context, void **column, size_t size) {
    const Growth *growth = context;
    void *wider = jox_alloc_aligned(growth->new + JOX_AGENTS_PADDING, size);
    if (!jox_mem_is(*column, 0, growth->old * size))
        memcpy(wider, *column, growth->old * size);
    jox_free(*column);
    *column = wider;
}

/* Grows the buffer for one row of memory, as rows are permuted in place. */
static void grow_row(JoxAgents *a) {
    jox_free(a->row);
    a->row = jox_alloc((size_t)a->memory_stride + 1, sizeof(double));
}

void jox_agents_reserve(JoxAgents *a, uint32_t capacity) {
    if (capacity <= a->capacity)
        return;
    Growth growth = {a->count, capacity};
    visit_columns(a, COLUMN_SCRATCH, grow_column, &growth);
    growth.old = 0;
    grow_column(&growth, &a->spare, sizeof(uint32_t));
    a->capacity = capacity;
    jox_shared_create(a);
    grow_row(a);
    jox_free(a->order);
    a->order = jox_alloc(capacity, sizeof *a->order);
    a->by_rank = jox_realloc(a->by_rank, capacity, sizeof *a->by_rank);
    a->rank_id = jox_realloc(a->rank_id, capacity, sizeof *a->rank_id);
}

/* Copies rows of `old` doubles into new rows of `wider` doubles; frees the old ones. */
static double *widen_rows(double *rows, const JoxAgents *a, uint32_t old, uint32_t wider) {
    double *result =
        jox_alloc_aligned(((size_t)a->capacity + JOX_AGENTS_PADDING) * wider, sizeof *result);
    for (size_t i = 0; i < a->count && old; i++)
        memcpy(result + i * wider, rows + i * old, old * sizeof *rows);
    jox_free(rows);
    return result;
}

void jox_agents_widen(JoxAgents *a, uint32_t own_count, uint32_t memory_stride) {
    if (own_count > a->own_count) {
        a->own = jox_realloc(a->own, own_count, sizeof *a->own);
        for (uint32_t s = a->own_count; s < own_count; s++)
            a->own[s] = (JoxOwnColumn){0};
        a->own_count = own_count;
        jox_shared_create(a);
    }
    if (memory_stride <= a->memory_stride)
        return;
    a->memory = widen_rows(a->memory, a, a->memory_stride, memory_stride);
    a->memory_stride = memory_stride;
    grow_row(a);
}

static void clear_row(void *context, void **column, size_t size) {
    jox_mem_fill((char *)*column + *(uint32_t *)context * size, 0, size);
}

void jox_agents_reserve_slots(JoxAgents *a, uint32_t capacity) {
    if (capacity <= a->slot_capacity)
        return;
    a->slot_index = jox_realloc(a->slot_index, capacity, sizeof *a->slot_index);
    a->slot_generation = jox_realloc(a->slot_generation, capacity, sizeof *a->slot_generation);
    a->free_slots = jox_realloc(a->free_slots, capacity, sizeof *a->free_slots);
    a->slot_capacity = capacity;
}

static uint32_t take_slot(JoxAgents *a, uint32_t index) {
    uint32_t slot;
    if (a->free_count) {
        slot = a->free_slots[--a->free_count];
    } else {
        if (a->slot_count == a->slot_capacity)
            jox_agents_reserve_slots(a, a->slot_capacity ? 2 * a->slot_capacity : 64);
        slot = a->slot_count++;
        a->slot_generation[slot] = 1;
    }
    JOX_ASSERT(slot < a->slot_count && index < a->capacity);
    a->slot_index[slot] = index;
    return slot;
}

uint32_t jox_agents_add_alike(JoxAgents *a) {
    if (a->count == a->capacity)
        jox_agents_reserve(a, a->capacity ? 2 * a->capacity : JOX_AGENTS_PADDING);
    uint32_t i = a->count++;
    visit_columns(a, COLUMN_SCRATCH, clear_row, &i);
    a->id[i] = a->rank_id[i] = a->next_id++; /* the greatest id: the last by rank */
    a->rank[i] = i;
    a->by_rank[i] = i;
    a->slot[i] = take_slot(a, i);
    for (JoxParameter p = 0; p < JOX_PARAM_COUNT; p++)
        if (a->param[p].mask)
            jox_param_set(a, p, i, jox_parameter_store(p, jox_parameters[p].value));
    a->face_x[i] = 1.0f;
    a->chest_x[i] = 1.0f;
    a->lasts[i] = INFINITY;
    a->goal[i] = -1;
    a->speed_limit[i] = jox_param(a, JOX_PARAM_max_speed, i);
    return i;
}

uint32_t jox_agents_add(JoxAgents *a) {
    const uint32_t i = jox_agents_add_alike(a);
    a->machine[i] = JOX_NO_MACHINE;
    for (JoxParameter p = 0; p < JOX_PARAM_COUNT; p++)
        jox_param_set(a, p, i, jox_parameter_store(p, jox_parameters[p].value));
    a->speed_limit[i] = jox_param(a, JOX_PARAM_max_speed, i);
    return i;
}

/* A permutation: the new agent i is the old agent order[i]. */
typedef struct Gather {
    JoxAgents *agents;
    const uint32_t *order;
    uint32_t count;
    void *room; /* 8 bytes per agent */
} Gather;

/* Permutes a column of 4 bytes per agent into the spare one, which then takes its place. */
static void gather_words(const Gather *gather, void **column) {
    uint32_t *to = gather->agents->spare;
    const uint32_t *from = *column;
    for (uint32_t i = 0; i < gather->count; i++)
        to[i] = from[gather->order[i]];
    gather->agents->spare = *column;
    *column = to;
}

/* Permutes a column of 8 bytes per agent. */
static void gather_long_words(const Gather *gather, uint64_t *column) {
    uint64_t *to = gather->room;
    for (uint32_t i = 0; i < gather->count; i++)
        to[i] = column[gather->order[i]];
    memcpy(column, to, gather->count * sizeof *column);
}

/* Permutes a narrow column. */
static void gather_bytes(const Gather *gather, char *column, size_t size) {
    char *to = gather->room;
    for (uint32_t i = 0; i < gather->count; i++)
        memcpy(to + i * size, column + gather->order[i] * size, size);
    memcpy(column, to, gather->count * size);
}

/* Permutes rows in place, cycle by cycle; `done`: one byte per agent. */
static void permute_rows(const Gather *gather, char *rows, size_t size, uint8_t *done) {
    const uint32_t *order = gather->order;
    void *first = gather->agents->row;
    memset(done, 0, gather->count);
    for (uint32_t start = 0; start < gather->count; start++) {
        if (done[start] || order[start] == start)
            continue;
        uint32_t i = start;
        memcpy(first, rows + i * size, size);
        for (; order[i] != start; i = order[i]) {
            memcpy(rows + i * size, rows + order[i] * size, size);
            done[i] = 1;
        }
        memcpy(rows + i * size, first, size);
        done[i] = 1;
    }
}

static void gather_column(void *context, void **column, size_t size) {
    const Gather *gather = context;
    char *rows = *column;
    if (jox_is_same_of_all(rows, size, gather->count))
        return;
    if (size == sizeof(uint32_t)) /* nearly all columns */
        gather_words(gather, column);
    else if (size == sizeof(uint64_t))
        gather_long_words(gather, *column);
    else if (size < sizeof(uint32_t))
        gather_bytes(gather, rows, size);
    else
        permute_rows(gather, rows, size, gather->agents->spare);
}

/* Rebuilds the tables from slots and ranks to indices. */
static void rebuild_indices(JoxAgents *a) {
    for (uint32_t i = 0; i < a->count; i++) {
        JOX_ASSERT(a->rank[i] < a->count && a->rank_id[a->rank[i]] == a->id[i]);
        a->slot_index[a->slot[i]] = i;
        a->by_rank[a->rank[i]] = i;
    }
}

/* Checks a column that may be stored once: all cells of its one packet are equal. */
static void check_shared(const void *cells, uint32_t mask, size_t size) {
    JOX_ASSERT(cells && (mask == 0 || mask == UINT32_MAX));
    JOX_ASSERT(mask || jox_is_same_of_all(cells, size, JOX_AGENTS_PADDING));
}

/* Checks, through JOX_CHECK, that indices, ids, ranks and handles agree and shared cells are
   equal. */
static void check_agents(const JoxAgents *a) {
    JOX_ASSERT(a->count <= a->capacity && a->slot_count <= a->slot_capacity);
    JOX_ASSERT(a->count + a->free_count == a->slot_count); /* every slot is in use or free */
    for (uint32_t i = 0; i < a->count; i++) {
        JOX_ASSERT(a->slot[i] < a->slot_count && a->slot_index[a->slot[i]] == i);
        JOX_ASSERT(a->by_rank[a->rank[i]] == i && a->id[i] < a->next_id);
        JOX_ASSERT(i == 0 || a->rank_id[i - 1] < a->rank_id[i]);
    }
    for (uint32_t k = 0; k < a->free_count; k++)
        JOX_ASSERT(a->slot_index[a->free_slots[k]] == JOX_NO_INDEX);
    for (int p = 0; p < JOX_PARAM_COUNT && a->capacity; p++)
        check_shared(a->param[p].cells, a->param[p].mask, sizeof(float));
    for (uint32_t s = 0; s < a->own_count; s++)
        check_shared(a->own[s].cells, a->own[s].mask, sizeof(double));
}

void jox_agents_permute(JoxAgents *a, const uint32_t *order, void *room) {
    Gather gather = {a, order, a->count, room};
    uint32_t same = 0;
    while (same < a->count && order[same] == same)
        same++;
    if (same < a->count)
        visit_columns(a, COLUMN_HINT, gather_column, &gather);
    rebuild_indices(a);
    JOX_CHECK(check_agents(a)); /* fails if the order is no permutation */
}

static void release_slot(JoxAgents *a, uint32_t slot) {
    JOX_ASSERT(a->slot_index[slot] != JOX_NO_INDEX); /* nothing is released twice */
    a->slot_index[slot] = JOX_NO_INDEX;
    a->slot_generation[slot]++;
    a->free_slots[a->free_count++] = slot;
}

/* Ranks the remaining agents after removals. Slots are released by ascending id, so that the order
   in memory does not affect which agent gets which slot later. */
static void close_ranks(JoxAgents *a) {
    uint32_t rank = 0;
    for (uint32_t r = 0; r < a->count; r++) {
        uint32_t i = a->by_rank[r];
        if (a->removed[i]) {
            release_slot(a, a->slot[i]);
            continue;
        }
        a->rank_id[rank] = a->id[i];
        a->rank[i] = rank++;
        JOX_ASSERT(rank < 2 || a->rank_id[rank - 2] < a->rank_id[rank - 1]);
    }
}

/* Indices of agents to be removed, ascending. */
typedef struct Leaving {
    const uint32_t *index;
    uint32_t count, before; /* number of them; number of all agents before */
} Leaving;

/* Closes the gaps in a column: the agents between two removed ones move up in one block. */
static void close_column(void *context, void **column, size_t size) {
    const Leaving *leaving = context;
    char *rows = *column;
    if (jox_is_same_of_all(rows, size, leaving->before))
        return;
    for (uint32_t k = 0; k < leaving->count; k++) {
        const uint32_t from = leaving->index[k] + 1;
        const uint32_t end = k + 1 < leaving->count ? leaving->index[k + 1] : leaving->before;
        JOX_ASSERT(from > k && from <= end);
        memmove(rows + (from - 1 - k) * size, rows + from * size, (end - from) * size);
    }
}

/* Adds to index_drop by how much the indices of the agents that stay drop. */
static void note_moves(JoxAgents *a, const Leaving *leaving) {
    for (uint32_t k = 0; k < leaving->count; k++) {
        const uint32_t begin = leaving->index[k] - k;
        const uint32_t end = k + 1 < leaving->count ? leaving->index[k + 1] - k - 1 : a->count;
        for (uint32_t i = begin; i < end; i++)
            a->index_drop[i] += k + 1;
    }
}

uint32_t jox_agents_compact(JoxAgents *a) {
    uint32_t gone = 0;
    if (!a->count || (!a->removed[0] && jox_is_same_of_all(a->removed, 1, a->count)))
        return 0;
    for (uint32_t i = 0; i < a->count; i++)
        if (a->removed[i])
            a->order[gone++] = i;
    close_ranks(a);
    Leaving leaving = {a->order, gone, a->count};
    visit_columns(a, COLUMN_SCRATCH, close_column, &leaving);
    a->count -= gone;
    note_moves(a, &leaving);
    rebuild_indices(a);
    JOX_CHECK(check_agents(a));
    return gone;
}

void jox_agents_by_id(const JoxAgents *a, uint32_t *out) {
    if (a->count)
        memcpy(out, a->by_rank, a->count * sizeof *out);
}

uint32_t jox_agents_find(const JoxAgents *a, uint32_t id) {
    if (id >= a->next_id || a->count == 0)
        return JOX_NO_INDEX;
    /* next_id - count ids are gone in all, so at most as many below `id` */
    uint32_t gone = a->next_id - a->count;
    uint32_t low = id > gone ? id - gone : 0, high = id < a->count ? id : a->count - 1;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (a->rank_id[middle] < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low < a->count && a->rank_id[low] == id ? a->by_rank[low] : JOX_NO_INDEX;
}

static void free_column(void *context, void **column, size_t size) {
    (void)context;
    (void)size;
    jox_free(*column);
    *column = NULL;
}

void jox_agents_free(JoxAgents *a) {
    visit_common(a, COLUMN_SCRATCH, free_column, NULL);
    jox_free(a->spare);
    jox_free(a->memory);
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        if (a->param[p].mask)
            jox_free(a->param[p].cells);
    jox_free(a->alike);
    for (uint32_t s = 0; s < a->own_count; s++)
        jox_free(a->own[s].cells);
    jox_free(a->own);
    jox_free(a->slot_index);
    jox_free(a->slot_generation);
    jox_free(a->free_slots);
    jox_free(a->by_rank);
    jox_free(a->rank_id);
    jox_free(a->row);
    jox_free(a->order);
    *a = (JoxAgents){0};
}

JoxV2 jox_agents_wrapped(const JoxAgents *a, JoxV2 at) {
    if (a->period.x > 0.0f)
        at.x -= floorf((at.x - a->origin.x) / a->period.x) * a->period.x;
    if (a->period.y > 0.0f)
        at.y -= floorf((at.y - a->origin.y) / a->period.y) * a->period.y;
    return at;
}

bool jox_agents_wrap(JoxAgents *a, uint32_t i) {
    const JoxV2 before = {a->x[i], a->y[i]}, at = jox_agents_wrapped(a, before);
    a->x[i] = at.x;
    a->y[i] = at.y;
    JOX_ASSERT(!(a->period.x > 0.0f && fabsf(a->x[i] - a->origin.x) > 1.001f * a->period.x));
    JOX_ASSERT(!(a->period.y > 0.0f && fabsf(a->y[i] - a->origin.y) > 1.001f * a->period.y));
    JoxV2 shift = jox_sub((JoxV2){a->x[i], a->y[i]}, before);
    if (!isfinite(shift.x + shift.y)) /* the guard of the world restores its last valid position */
        return true;
    a->prev_x[i] += shift.x;
    a->prev_y[i] += shift.y;
    a->still_x[i] += shift.x;
    a->still_y[i] += shift.y;
    return shift.x != 0.0f || shift.y != 0.0f;
}
