#include "task/pool.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>

#include "base/assert.h"
#include "base/mem.h"
#include "simd/pause.h"
#include "task/thread.h"

enum { MOST_THREADS = 64, SPINS = 2000 };

/* One loop at a time. A worker sleeps on `wake` until `round` moves, then takes chunks until none
   is left; the caller takes part and waits on `done`. Waits spin a bounded while, then sleep. */
struct JoxPool {
    uint32_t threads;
    pthread_t thread[MOST_THREADS];
    struct Worker {
        JoxPool *pool;
        uint32_t number;
    } worker[MOST_THREADS];
    pthread_mutex_t lock;
    pthread_cond_t wake, done;
    atomic_uint round;
    atomic_uint busy;    /* workers that have not finished this round */
    atomic_uint next;    /* first chunk not taken */
    atomic_bool starved; /* memory ran out in a chunk of this round */
    bool quit;
    JoxHeap *heap; /* of the caller */
    uint32_t count, grain, chunks;
    JoxTask *task;
    void *context;
};

static void take_chunks(JoxPool *pool, uint32_t worker) {
    for (;;) {
        uint32_t chunk = atomic_fetch_add_explicit(&pool->next, 1, memory_order_relaxed);
        if (chunk >= pool->chunks)
            return;
        uint32_t begin = chunk * pool->grain;
        JOX_ASSERT(begin < pool->count && worker < pool->threads);
        uint32_t left = pool->count - begin;
        pool->task(pool->context, begin, begin + (left < pool->grain ? left : pool->grain), worker);
    }
}

/* Where memory is out, the round ends early: its caller learns it when no thread is in it. */
static void run_chunks(JoxPool *pool, uint32_t worker) {
    JoxRecovery recovery;
    JoxHeap *before = jox_heap_use(pool->heap);
    jox_recovery_push(&recovery);
    if (setjmp(recovery.jump) != 0) {
        atomic_store(&pool->starved, true);
        atomic_store(&pool->next, pool->chunks);
    } else {
        take_chunks(pool, worker);
    }
    jox_recovery_pop(&recovery);
    jox_heap_use(before);
}

static void *worker_main(void *argument) {
    struct Worker *self = argument;
    JoxPool *pool = self->pool;
    unsigned seen = 0;
    for (;;) {
        for (int i = 0; i < SPINS && atomic_load(&pool->round) == seen; i++)
            jox_pause();
        pthread_mutex_lock(&pool->lock);
        while (atomic_load(&pool->round) == seen)
            pthread_cond_wait(&pool->wake, &pool->lock);
        seen = atomic_load(&pool->round);
        bool quit = pool->quit;
        pthread_mutex_unlock(&pool->lock);
        if (quit)
            return NULL;
        run_chunks(pool, self->number);
        if (atomic_fetch_sub(&pool->busy, 1) == 1) {
            pthread_mutex_lock(&pool->lock);
            pthread_cond_signal(&pool->done);
            pthread_mutex_unlock(&pool->lock);
        }
    }
}

static void release_pool(void *pool) {
    jox_pool_free(pool);
}

JoxPool *jox_pool_create(uint32_t threads) {
    JoxPool *pool = jox_alloc(1, sizeof *pool);
    pthread_mutex_init(&pool->lock, NULL);
    pthread_cond_init(&pool->wake, NULL);
    pthread_cond_init(&pool->done, NULL);
    pool->threads = 1;
    threads = threads < 1 ? 1 : threads > MOST_THREADS ? MOST_THREADS : threads;
    for (uint32_t i = 1; i < threads; i++) {
        pool->worker[i] = (struct Worker){pool, i};
        if (!jox_thread_start(&pool->thread[i], worker_main, &pool->worker[i]))
            break; /* fewer threads give the same results */
        pool->threads++;
    }
    return jox_hold(pool, release_pool);
}

static void start_round(JoxPool *pool) {
    pthread_mutex_lock(&pool->lock);
    atomic_store(&pool->busy, pool->threads - 1);
    atomic_fetch_add(&pool->round, 1);
    pthread_cond_broadcast(&pool->wake);
    pthread_mutex_unlock(&pool->lock);
}

void jox_pool_free(JoxPool *pool) {
    if (!pool)
        return;
    jox_let_go(pool);
    pool->quit = true;
    start_round(pool);
    for (uint32_t i = 1; i < pool->threads; i++)
        pthread_join(pool->thread[i], NULL);
    pthread_cond_destroy(&pool->done);
    pthread_cond_destroy(&pool->wake);
    pthread_mutex_destroy(&pool->lock);
    jox_free(pool);
}

uint32_t jox_pool_threads(const JoxPool *pool) {
    return pool ? pool->threads : 1;
}

void jox_parallel_for(JoxPool *pool, uint32_t count, uint32_t grain, JoxTask *task, void *context) {
    JOX_ASSERT(grain > 0);
    if (!pool || pool->threads == 1 || count <= grain) {
        for (uint32_t begin = 0; begin < count; begin += grain)
            task(context, begin, count - begin < grain ? count : begin + grain, 0);
        return;
    }
    JOX_ASSERT(atomic_load(&pool->busy) == 0); /* one loop at a time */
    pool->count = count;
    pool->grain = grain;
    pool->chunks = (count + grain - 1) / grain;
    pool->task = task;
    pool->context = context;
    pool->heap = jox_heap_used();
    atomic_store(&pool->next, 0);
    start_round(pool);
    run_chunks(pool, 0);
    for (int i = 0; i < SPINS && atomic_load(&pool->busy) > 0; i++)
        jox_pause();
    pthread_mutex_lock(&pool->lock);
    while (atomic_load(&pool->busy) > 0)
        pthread_cond_wait(&pool->done, &pool->lock);
    pthread_mutex_unlock(&pool->lock);
    JOX_ASSERT(atomic_load(&pool->next) >= pool->chunks);
    if (atomic_exchange(&pool->starved, false))
        jox_out_of_memory(0);
}
