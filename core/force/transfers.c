/* Lists that the stages of force fill in parallel and sort afterwards: forces between agents, and
   impulses on bodies. */
#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "force/equations.h"
#include "force/forces.h"

void jox_chunks_grow(JoxChunkList *list, uint32_t chunks, size_t need) {
    if (need > list->capacity) {
        /* No realloc: nothing has to be kept, and pages that are not written stay unused. */
        jox_free(list->items);
        list->capacity = need + need / 2;
        list->items = jox_alloc(list->capacity, 1);
    }
    JOX_RESERVE(list->counts, list->chunk_capacity, chunks);
    JOX_ASSERT(!need || (list->items && list->capacity >= need));
}

bool jox_force_is_walled_off(const JoxForces *f, JoxV2 from, JoxV2 to) {
    /* Tests from either end, as the grid lists edges up to half of the distance only. */
    const JoxWallGrid *walls = f->step.walls;
    return walls && (jox_wall_grid_has_wall_between(walls, from, to) ||
                     jox_wall_grid_has_wall_between(walls, to, from));
}

/* Removes the agents from `found` that a wall separates from agent i. Returns how many are left. */
static uint32_t drop_walled_off(const JoxForces *f, uint32_t i, uint32_t *found, uint32_t count) {
    const JoxAgents *a = f->step.agents;
    JoxV2 at = {a->x[i], a->y[i]};
    uint32_t n = 0;
    for (uint32_t k = 0; k < count; k++) {
        found[n] = found[k];
        n += !jox_force_is_walled_off(f, at, jox_add(at, jox_offset(a, i, found[k])));
    }
    return n;
}

uint32_t jox_people_in_cone(const JoxForces *f, uint32_t i, JoxV2 axis, uint32_t *found) {
    const JoxAgents *a = f->step.agents;
    const JoxNeighbours *near = f->step.neighbours;
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    float cosine = jox_param(a, JOX_PARAM_brace_angle, i);
    uint32_t n = 0;
    for (uint32_t k = 0; k < near->count[i]; k++) {
        uint32_t other = near->index[jox_neighbour_at(near, i, k)];
        JoxV2 offset = jox_offset(a, i, other);
        float most = jox_at(radius, i) + jox_at(radius, other) + f->options.reach;
        bool near_enough = f->options.literal | (jox_length2(offset) <= most * most);
        found[n] = other; /* kept only if it counts; no branch to mispredict */
        n += near_enough & jox_cone_holds(offset, axis, cosine);
    }
    n = f->options.literal ? n : drop_walled_off(f, i, found, n);
    JOX_ASSERT(n <= near->count[i]);
    return n;
}

/* Length of a run, in which the list of a chunk is split. The first runs of all chunks are stored
   together, then the second ones, and so on: with few transfers per chunk, few pages are
   written. */
enum { RUN = 16 };

void jox_transfers_begin(JoxForces *f) {
    const uint32_t most = jox_chunk_agents(f) * (f->step.neighbours->stride + 1);
    jox_chunks_begin(&f->transfers, f->chunks, (most + RUN - 1) / RUN * RUN, sizeof(JoxTransfer));
}

/* Returns the first entry of a run of a chunk. */
static JoxTransfer *get_run(const JoxForces *f, uint32_t chunk, uint32_t run) {
    return (JoxTransfer *)f->transfers.items + ((size_t)run * f->chunks + chunk) * RUN;
}

void jox_transfers_add(JoxForces *f, uint32_t chunk, uint32_t i, uint32_t to, JoxV2 force) {
    const uint32_t at = f->transfers.counts[chunk]++;
    JOX_ASSERT(to < f->step.agents->count);
    JOX_ASSERT(chunk < f->chunks && at < f->transfers.room);
    get_run(f, chunk, at / RUN)[at % RUN] =
        (JoxTransfer){to, f->step.agents->id[i], force.x, force.y};
}

uint32_t jox_transfers_sort(JoxForces *f) {
    uint32_t n = f->step.agents->count, total = 0;
    for (uint32_t c = 0; c < f->chunks; c++)
        total += f->transfers.counts[c];
    if (!total)
        return 0;
    /* Room for a dense crowd from the start, so that a steady step never grows it. */
    uint32_t room = 6 * f->step.agents->count;
    JOX_RESERVE(f->sorted, f->sorted_capacity, total > room ? total : room);
    memset(f->starts, 0, ((size_t)n + 1) * sizeof *f->starts);
    for (uint32_t c = 0; c < f->chunks; c++)
        for (uint32_t k = 0; k < f->transfers.counts[c]; k++)
            f->starts[get_run(f, c, k / RUN)[k % RUN].to]++;
    uint32_t sum = 0;
    for (uint32_t i = 0; i <= n; i++) {
        sum += f->starts[i];
        f->starts[i] = sum; /* its end; filling backwards turns it into the start */
    }
    for (uint32_t c = 0; c < f->chunks; c++)
        for (uint32_t k = 0; k < f->transfers.counts[c]; k++) {
            const JoxTransfer *t = &get_run(f, c, k / RUN)[k % RUN];
            f->sorted[--f->starts[t->to]] = *t;
        }
    JOX_ASSERT(f->starts[0] == 0 && f->starts[n] == total);
    JOX_CHECK(jox_transfers_check(f));
    return total;
}

static void sort_by_giver(JoxTransfer *t, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        JoxTransfer moved = t[i];
        uint32_t j = i;
        for (; j > 0 && t[j - 1].from_id > moved.from_id; j--)
            t[j] = t[j - 1];
        t[j] = moved;
    }
}

typedef struct SumTask {
    JoxForces *forces;
    float *x, *y;
} SumTask;

static void sum_received_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const SumTask *task = context;
    JoxForces *f = task->forces;
    for (uint32_t i = begin; i < end; i++) {
        uint32_t first = f->starts[i], count = f->starts[i + 1] - first;
        if (!count)
            continue;
        JoxTransfer *t = f->sorted + first;
        sort_by_giver(t, count);
        JOX_ASSERT(t[0].to == i && t[count - 1].to == i);
        float x = 0.0f, y = 0.0f;
        for (uint32_t k = 0; k < count; k++) {
            JOX_ASSERT(k == 0 || t[k - 1].from_id <= t[k].from_id);
            x += t[k].x;
            y += t[k].y;
        }
        task->x[i] += x;
        task->y[i] += y;
    }
}

void jox_transfers_sum(JoxForces *f, float *x, float *y) {
    SumTask task = {f, x, y};
    jox_parallel_for(f->step.pool, f->step.agents->count, JOX_FORCE_GRAIN, sum_received_chunk,
                     &task);
}

void jox_force_add_impulse(JoxForces *f, uint32_t agent_id, uint32_t object, JoxV3 impulse,
                           JoxV3 point, float lasting) {
    JOX_RESERVE(f->pending, f->pending_capacity, (size_t)f->pending_count + 1);
    JOX_ASSERT(object < f->step.objects->count && agent_id < f->step.agents->next_id);
    uint64_t key = (uint64_t)agent_id << 32 | object;
    f->pending[f->pending_count] = (JoxPendingImpulse){key, {object, impulse, point, lasting}};
    f->pending_count++;
}

static int compare_impulse_keys(const void *a, const void *b, const void *context) {
    const JoxPendingImpulse *x = a, *y = b;
    (void)context;
    return (x->key > y->key) - (x->key < y->key);
}

const JoxImpulse *jox_force_impulses(JoxForces *f, uint32_t *count) {
    if (f->pending_sorted != f->pending_count) {
        JOX_RESERVE(f->pending, f->pending_capacity,
                    f->pending_count + JOX_SORT_SPARE(f->pending_count));
        jox_sort(f->pending, f->pending_count, sizeof *f->pending, compare_impulse_keys, NULL,
                 f->pending + f->pending_count);
        JOX_RESERVE(f->impulses, f->impulse_capacity, f->pending_count);
        for (uint32_t i = 0; i < f->pending_count; i++)
            f->impulses[i] = f->pending[i].impulse;
        f->pending_sorted = f->pending_count;
    }
    *count = f->pending_count;
    return f->impulses;
}
