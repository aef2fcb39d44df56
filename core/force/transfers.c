/* Collects forces between agents by chunk, sorts them by receiver, and sums them. */
#include "base/assert.h"
#include "base/mem.h"
#include "force/forces.h"

enum { RUN_LENGTH = 16 }; /* of the runs that the list of a chunk is split into */

void jox_transfers_reserve(JoxForces *f, JoxChunkMemory *memory) {
    const uint32_t most = jox_most_chunk_agents(f) * (f->step.neighbours->stride + 1);
    jox_chunks_reserve(&f->transfers.list, memory, f->chunks,
                       (most + RUN_LENGTH - 1) / RUN_LENGTH * RUN_LENGTH, sizeof(JoxTransfer));
}

/* Returns the first entry of a run of a chunk. */
static JoxTransfer *get_run(const JoxForces *f, uint32_t chunk, uint32_t run) {
    return (JoxTransfer *)f->transfers.list.items +
           jox_chunk_run_place(f->chunks, chunk, run * RUN_LENGTH, RUN_LENGTH);
}

/* Returns how many entries are in a run of a chunk; 0 behind its last run. */
static uint32_t count_run(const JoxForces *f, uint32_t chunk, uint32_t run) {
    const uint32_t count = f->transfers.list.counts[chunk], first = run * RUN_LENGTH;
    return count <= first ? 0 : count - first < RUN_LENGTH ? count - first : RUN_LENGTH;
}

void jox_transfers_add(JoxForces *f, uint32_t chunk, uint32_t i, uint32_t to, JoxV2 force) {
    const uint32_t at = f->transfers.list.counts[chunk]++;
    JOX_ASSERT(to < f->step.agents->count);
    JOX_ASSERT(chunk < f->chunks && at < f->transfers.list.room);
    get_run(f, chunk, at / RUN_LENGTH)[at % RUN_LENGTH] =
        (JoxTransfer){to, f->step.agents->id[i], force.x, force.y};
}

/* Asserts that the starts of receivers ascend and transfers come from agents that exist. Only
   builds with assertions call it. */
static inline void check_transfers(const JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    for (uint32_t i = 0; i < a->count; i++) {
        JOX_ASSERT(f->transfers.starts[i] <= f->transfers.starts[i + 1]);
        for (uint32_t k = f->transfers.starts[i]; k < f->transfers.starts[i + 1]; k++) {
            JOX_ASSERT(jox_agents_find(a, f->transfers.sorted[k].from_id) != JOX_NO_INDEX);
        }
    }
}

uint32_t jox_transfers_sort(JoxForces *f) {
    uint32_t n = f->step.agents->count, total = 0;
    for (uint32_t c = 0; c < f->chunks; c++)
        total += f->transfers.list.counts[c];
    if (!total)
        return 0;
    /* Room for a dense crowd from the start, so that a steady step never grows it. */
    uint32_t room = 6 * f->step.agents->count;
    JOX_RESERVE(f->transfers.sorted, f->transfers.sorted_capacity, total > room ? total : room);
    memset(f->transfers.starts, 0, ((size_t)n + 1) * sizeof *f->transfers.starts);
    for (uint32_t c = 0; c < f->chunks; c++)
        for (uint32_t run = 0, count; (count = count_run(f, c, run)) > 0; run++) {
            const JoxTransfer *t = get_run(f, c, run);
            for (uint32_t k = 0; k < count; k++)
                f->transfers.starts[t[k].to]++;
        }
    uint32_t sum = 0;
    for (uint32_t i = 0; i <= n; i++) {
        sum += f->transfers.starts[i];
        f->transfers.starts[i] = sum; /* its end; filling backwards turns it into the start */
    }
    for (uint32_t c = 0; c < f->chunks; c++)
        for (uint32_t run = 0, count; (count = count_run(f, c, run)) > 0; run++) {
            const JoxTransfer *t = get_run(f, c, run);
            for (uint32_t k = 0; k < count; k++)
                f->transfers.sorted[--f->transfers.starts[t[k].to]] =
                    (JoxReceivedForce){t[k].from_id, t[k].x, t[k].y};
        }
    JOX_ASSERT(f->transfers.starts[0] == 0 && f->transfers.starts[n] == total);
    JOX_CHECK(check_transfers(f));
    return total;
}

static void sort_by_giver(JoxReceivedForce *t, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        JoxReceivedForce moved = t[i];
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

static void add_received(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const SumTask *task = context;
    JoxForces *f = task->forces;
    for (uint32_t i = begin; i < end; i++) {
        uint32_t first = f->transfers.starts[i], count = f->transfers.starts[i + 1] - first;
        if (!count)
            continue;
        JoxReceivedForce *t = f->transfers.sorted + first;
        sort_by_giver(t, count);
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
    jox_parallel_for(f->step.pool, f->step.agents->count, JOX_FORCE_GRAIN, add_received, &task);
}

void jox_transfers_free(JoxTransfers *transfers) {
    jox_chunks_free(&transfers->list);
    jox_free(transfers->starts);
    jox_free(transfers->sorted);
}
