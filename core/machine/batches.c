/* Scratch of a step: agents grouped by state into batches, people counted in places. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "machine/formation.h"

JoxMachineScratch *jox_machines_scratch(JoxMachineRun *run) {
    if (!run->scratch)
        run->scratch = jox_alloc(1, sizeof *run->scratch);
    return run->scratch;
}

/* Grows the scratch to the number of agents and workers. */
static void reserve_scratch(JoxMachineRun *run, JoxPool *pool) {
    JoxMachineScratch *s = jox_machines_scratch(run);
    uint32_t workers = jox_pool_threads(pool);
    if (workers > s->workers) {
        jox_free(s->registers);
        s->registers = jox_alloc(workers, sizeof *s->registers);
        s->odd = jox_realloc(s->odd, workers, sizeof *s->odd);
        s->workers = workers;
    }
    if (run->agents->count <= s->capacity)
        return;
    uint32_t n = s->capacity = run->agents->count + run->agents->count / 4 + 64;
    s->grouped = jox_realloc(s->grouped, n, sizeof *s->grouped);
    s->in_state = jox_realloc(s->in_state, n, sizeof *s->in_state);
    s->fired = jox_realloc(s->fired, n, sizeof *s->fired);
    s->reacts = jox_realloc(s->reacts, n, sizeof *s->reacts);
    s->rank = jox_realloc(s->rank, n, sizeof *s->rank);
    s->list = jox_realloc(s->list, n, sizeof *s->list);
    s->spare = jox_realloc(s->spare, JOX_SORT_SPARE(n), sizeof *s->spare);
    s->queue = jox_realloc(s->queue, n, sizeof *s->queue);
    s->row = jox_realloc(s->row, n, sizeof *s->row);
    s->entries = jox_realloc(s->entries, n + JOX_SORT_SPARE(n), sizeof *s->entries);
    JOX_RESERVE(run->taken, run->taken_capacity, n);
    /* Kernels of forces read whole packets past the last agent. */
    const uint32_t padded = n + JOX_AGENTS_PADDING;
    run->push_on = jox_realloc(run->push_on, padded, 1);
    run->push_nearest = jox_realloc(run->push_nearest, n, 1);
    jox_free(run->push_toward_x); /* filled anew in each step; columns that stay zero take no
                                     memory */
    jox_free(run->push_toward_y);
    run->push_toward_x = jox_alloc(padded, sizeof(float));
    run->push_toward_y = jox_alloc(padded, sizeof(float));
}

void jox_machines_scratch_free(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    if (!s)
        return;
    jox_free(s->grouped);
    jox_free(s->batches);
    jox_free(s->state_first);
    jox_free(s->part_first);
    jox_free(s->in_state);
    jox_free(s->fired);
    jox_free(s->reacts);
    jox_free(s->rank);
    jox_free(s->heading);
    jox_free(s->queue);
    jox_free(s->arrivals);
    jox_free(s->row);
    jox_free(s->entries);
    jox_gatherings_free(s);
    jox_free(s->leads);
    jox_free(s->list);
    jox_free(s->spare);
    jox_free(s->heard);
    jox_free(s->everywhere);
    jox_hands_free(&s->hands);
    jox_free(s->place_people);
    jox_free(s->place_queue);
    jox_free(s->marks);
    jox_free(s->registers);
    jox_free(s->odd);
    jox_free(s);
    run->scratch = NULL;
}

/* Returns the number of a machine's first state in the list of all states. */
static uint32_t find_first_state(const JoxMachineRun *run, uint32_t machine) {
    uint32_t first = 0;
    for (uint32_t m = 0; m < machine; m++)
        first += run->set->items[m]->state_count;
    return first;
}

/* Appends the batches of one state, whose agents are grouped[begin .. end - 1]. */
static void add_batches(JoxMachineScratch *s, uint16_t machine, uint16_t state, uint32_t begin,
                        uint32_t end) {
    for (; begin < end; begin += JOX_BATCH) {
        JOX_RESERVE(s->batches, s->batch_capacity, s->batch_count + 1);
        uint32_t left = end - begin;
        s->batches[s->batch_count++] =
            (JoxBatchRange){machine, state, begin, left < JOX_BATCH ? left : JOX_BATCH};
    }
}

/* Sorts a long list by id: marks the ranks in a bitmap, then reads it in order. */
static void sort_by_marks(JoxMachineRun *run, uint32_t *list, uint32_t count) {
    JoxMachineScratch *s = run->scratch;
    const JoxAgents *a = run->agents;
    uint32_t words = a->count / 64 + 1, n = 0;
    if (words > s->mark_capacity) {
        s->mark_capacity = words + words / 4;
        s->marks = jox_realloc(s->marks, s->mark_capacity, sizeof *s->marks);
    }
    memset(s->marks, 0, words * sizeof *s->marks);
    for (uint32_t k = 0; k < count; k++)
        s->marks[a->rank[list[k]] / 64] |= (uint64_t)1 << a->rank[list[k]] % 64;
    for (uint32_t w = 0; w < words; w++)
        for (uint64_t bits = s->marks[w]; bits; bits &= bits - 1)
            list[n++] = a->by_rank[w * 64 + (uint32_t)__builtin_ctzll(bits)];
    JOX_ASSERT(n == count); /* no agent was listed twice */
}

/* Orders agents by id; `context`: the agents' ids. */
static int compare_ids(const void *a, const void *b, const void *context) {
    const uint32_t *id = context;
    const uint32_t x = id[*(const uint32_t *)a], y = id[*(const uint32_t *)b];
    return (x > y) - (x < y);
}

void jox_sort_by_id(JoxMachineRun *run, uint32_t *list, uint32_t count) {
    const JoxAgents *a = run->agents;
    if (count > 256 && count > a->count / 256)
        sort_by_marks(run, list, count);
    else
        jox_sort(list, count, sizeof *list, compare_ids, a->id, run->scratch->spare);
    JOX_CHECK(jox_by_id_check(a, list, count));
}

/* Returns whether all agents are in one state of one machine, as in many crowds. */
static bool is_uniform_crowd(const JoxAgents *a) {
    return a->count && a->machine[0] != JOX_NO_MACHINE &&
           jox_is_same_of_all(a->machine, sizeof *a->machine, a->count) &&
           jox_is_same_of_all(a->state, sizeof *a->state, a->count);
}

/* A stable sort of agents by state, in parallel: counts the states in each part of the agents, then
   lists each part behind the parts before it. */
typedef struct StateSort {
    JoxMachineScratch *scratch;
    const JoxAgents *agents;
    uint32_t bases[JOX_MOST_MACHINES]; /* number of each machine's first state among all */
    uint32_t states;                   /* number of states of all machines; agents without a machine
                                          form one more */
    uint32_t grain;                    /* agents per part */
} StateSort;

/* Parts that one task visits in alternation, one agent of each at a time: neighbouring agents are
   often in one state, and incrementing a counter that was just written stalls. */
enum { AT_ONCE = 4 };

/* A part of the agents, from `next` on. */
typedef struct Part {
    uint32_t next, end;
    uint32_t *numbers; /* per state: number of agents, or index in `grouped` of the next one */
} Part;

typedef void PartVisit(const StateSort *sort, Part *part);

/* Visits each agent from `begin` to `end`, in AT_ONCE parts; `clear`: zeroes the numbers first. */
static inline __attribute__((always_inline)) void
visit_parts(const StateSort *sort, uint32_t begin, uint32_t end, bool clear, PartVisit *visit) {
    const size_t width = (size_t)sort->states + 1;
    Part parts[AT_ONCE];
    uint32_t together = UINT32_MAX;
    for (uint32_t p = 0; p < AT_ONCE; p++) {
        const uint32_t first = begin + p * sort->grain, next = first < end ? first : end;
        const uint32_t last = end - next < sort->grain ? end : next + sort->grain;
        parts[p] = (Part){next, last, sort->scratch->part_first + next / sort->grain * width};
        together = last - next < together ? last - next : together;
        if (clear && next < last)
            memset(parts[p].numbers, 0, width * sizeof *parts[p].numbers);
    }
    for (uint32_t k = 0; k < together; k++)
        for (uint32_t p = 0; p < AT_ONCE; p++)
            visit(sort, &parts[p]);
    for (uint32_t p = 0; p < AT_ONCE; p++)
        while (parts[p].next < parts[p].end)
            visit(sort, &parts[p]);
}

/* Counts the next agent of a part by its state. */
static inline __attribute__((always_inline)) void count_agent(const StateSort *sort, Part *part) {
    const JoxAgents *a = sort->agents;
    const uint32_t i = part->next++;
    const bool none = a->machine[i] == JOX_NO_MACHINE;
    const uint32_t state = none ? sort->states : sort->bases[a->machine[i]] + a->state[i];
    sort->scratch->in_state[i] = state;
    part->numbers[state]++;
}

/* Lists the next agent of a part in its state's range. */
static inline __attribute__((always_inline)) void list_agent(const StateSort *sort, Part *part) {
    const uint32_t i = part->next++;
    sort->scratch->grouped[part->numbers[sort->scratch->in_state[i]]++] = i;
}

static void count_parts(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    visit_parts(context, begin, end, true, count_agent);
}

static void list_parts(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    visit_parts(context, begin, end, false, list_agent);
}

/* Sorts agents by state: counts per part, then prefix sums, then lists. */
static void sort_by_state(StateSort *sort, JoxPool *pool) {
    enum { PARTS = 64, LEAST = 256 };
    JoxMachineScratch *s = sort->scratch;
    const uint32_t count = sort->agents->count, width = sort->states + 1;
    sort->grain = (count + PARTS - 1) / PARTS > LEAST ? (count + PARTS - 1) / PARTS : LEAST;
    const uint32_t parts = (count + sort->grain - 1) / sort->grain;
    JOX_RESERVE(s->part_first, s->part_capacity, (size_t)parts * width);
    jox_parallel_for(pool, count, AT_ONCE * sort->grain, count_parts, sort);
    uint32_t sum = 0;
    for (uint32_t k = 0; k < width; k++) {
        s->state_first[k] = sum;
        for (uint32_t p = 0; p < parts; p++) {
            uint32_t *size = &s->part_first[(size_t)p * width + k], first = sum;
            sum += *size;
            *size = first;
        }
    }
    JOX_ASSERT(sum == count);
    jox_parallel_for(pool, count, AT_ONCE * sort->grain, list_parts, sort);
}

/* Lists all agents as one group, as they are all in the same state. */
static void list_uniform_crowd(StateSort *sort) {
    const JoxAgents *a = sort->agents;
    const uint32_t in = sort->bases[a->machine[0]] + a->state[0];
    for (uint32_t k = 0; k <= sort->states; k++)
        sort->scratch->state_first[k] = k <= in ? 0 : a->count;
    for (uint32_t i = 0; i < a->count; i++)
        sort->scratch->grouped[i] = i;
}

void jox_machines_group_again(JoxMachineRun *run, JoxPool *pool) {
    reserve_scratch(run, pool);
    JoxMachineScratch *s = run->scratch;
    const JoxAgents *a = run->agents;
    s->batch_count = 0;
    if (run->set->count == 0)
        return;
    StateSort sort = {.scratch = s, .agents = a, .states = find_first_state(run, run->set->count)};
    for (uint32_t m = 0; m < run->set->count; m++)
        sort.bases[m] = find_first_state(run, m);
    JOX_RESERVE(s->state_first, s->state_capacity, (size_t)sort.states + 1);
    if (a->count)
        memset(s->rank, 0xff, a->count * sizeof *s->rank);
    if (is_uniform_crowd(a))
        list_uniform_crowd(&sort);
    else
        sort_by_state(&sort, pool);
    const uint32_t *first = s->state_first;
    for (uint32_t m = 0; m < run->set->count; m++)
        for (uint32_t k = 0; k < run->set->items[m]->state_count; k++)
            add_batches(s, (uint16_t)m, (uint16_t)k, first[sort.bases[m] + k],
                        first[sort.bases[m] + k + 1]);
}

void jox_machines_group(JoxMachineRun *run, JoxPool *pool) {
    jox_machines_group_again(run, pool);
    if (run->set->count > 0)
        jox_queues_rank(run);
}

/* Marks the places whose number of people an expression reads. */
static void mark_counted_places(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    for (uint32_t p = 0; p < run->place_count; p++)
        s->place_people[p] = UINT32_MAX;
    for (uint32_t m = 0; m < run->set->count; m++) {
        const JoxMachine *machine = run->set->items[m];
        for (uint32_t p = 0; p < machine->expression_count; p++)
            for (uint32_t i = 0; i < machine->expressions[p].count; i++) {
                const JoxInstruction *in = &machine->expressions[p].code[i];
                if (in->op != JOX_OP_PLACE_DENSITY && in->op != JOX_OP_PLACE_COUNT)
                    continue;
                const JoxTarget *target = &machine->targets[in->place];
                for (uint32_t q = 0; q < run->place_count;
                     q++) /* an agent's own place may be any */
                    if (target->kind != JOX_TARGET_PLACE || target->arg == (int32_t)q)
                        s->place_people[q] = 0;
            }
    }
}

/* Returns the number of agents in a polygon, or within 2 m of a place without area. */
static uint32_t count_people_about(const JoxMachineRun *run, uint32_t p) {
    const float REACH = 2.0f, HAIR = 0.01f; /* m; HAIR exceeds the rounding of distances */
    const JoxAgents *a = run->agents;
    const JoxPlace *place = &run->places[p];
    const bool area = jox_place_is_area(place), boxed = !jox_place_is_set(place);
    const float wide = boxed ? REACH + HAIR : INFINITY;
    const JoxV2 low = {place->low.x - wide, place->low.y - wide};
    const JoxV2 high = {place->high.x + wide, place->high.y + wide};
    uint32_t people = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        const JoxV2 at = {a->x[i], a->y[i]};
        if (jox_is_within(at, low, high))
            people += area ? jox_place_contains(run->places, p, at)
                           : jox_place_distance(run->places, p, at) <= REACH;
    }
    return people;
}

void jox_machines_count_places(JoxMachineRun *run) {
    mark_counted_places(run);
    for (uint32_t p = 0; p < run->place_count; p++)
        if (run->scratch->place_people[p] != UINT32_MAX)
            run->scratch->place_people[p] = count_people_about(run, p);
}
