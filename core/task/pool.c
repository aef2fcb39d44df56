#include "task/pool.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>

#include "base/assert.h"
#include "base/clock.h"
#include "base/guard.h"
#include "base/mem.h"
#include "jostle_host.h"
#include "simd/pause.h"
#include "task/processors.h"
#include "task/thread.h"

enum { MOST_THREADS = 64 };
static const unsigned OPEN = 1u << 31; /* bit of `gate` */

/* Chooses between one thread and all. When other processes keep the processors busy, several
   threads may take longer than one, because a loop waits for a thread that the system has
   suspended. So the other choice is probed for PROBE laps: SOON laps after a change, then at
   growing intervals, at most SELDOM laps apart. */
enum { PROBE = 2, SOON = 8, SELDOM = 512 };
/* A probe wins if its laps take less than this share of the usual time */
static const double BETTER = 0.95;
typedef struct Pace {
    bool alone, probing;
    uint32_t left, interval; /* laps until the next probe begins or the present one ends; laps
                                between probes */
    double usual, probed;    /* s per lap: smoothed; mean of the probe */
} Pace;

/* The range of chunks of one worker that are not taken yet: the first chunk in the low 32 bits, the
   end in the high ones. Each has its own cache line. */
typedef struct Share {
    _Alignas(64) atomic_uint_least64_t left;
} Share;

/* One loop runs at a time. A worker that arrives while the gate is open takes chunks until none is
   left. The caller does the same, then closes the gate and waits for the workers inside; it never
   waits for a thread that the system has not scheduled. Waiting threads spin for a bounded time,
   then sleep. */
struct JoxPool {
    uint32_t threads; /* upper limit, the caller included */
    uint32_t running; /* 1 + threads that were started; the first long loop starts them */
    pthread_t thread[MOST_THREADS];
    struct Worker {
        JoxPool *pool;
        uint32_t number;
    } worker[MOST_THREADS];
    pthread_mutex_t lock;
    pthread_cond_t wake, done;
    atomic_uint round;   /* number of the loop: incremented when the gate opens */
    atomic_uint asleep;  /* workers that sleep on `wake` */
    atomic_uint gate;    /* OPEN bit, plus the number of workers inside */
    atomic_bool starved; /* memory ran out in a chunk of this loop */
    atomic_bool quit;
    bool begun;         /* the first long loop has started the threads */
    const JoJobs *jobs; /* the host's threads, used instead of own ones; NULL: none */
    double spin;        /* s: longest wait without sleep */
    Pace pace;
    JoxHeap *heap; /* the caller's; chunks allocate from it */
    uint32_t count, grain, chunks;
    JoxTask *task;
    void *context;
    Share share[MOST_THREADS];
};

static uint64_t pack_range(uint32_t begin, uint32_t end) {
    return (uint64_t)end << 32 | begin;
}

/* Gives each worker the same share of the chunks in every loop: what it reads was mostly written by
   itself in the loop before, and is in its processor's cache. */
static void share_chunks(JoxPool *pool) {
    for (uint32_t w = 0; w < pool->threads; w++) {
        const uint64_t begin = (uint64_t)pool->chunks * w / pool->threads;
        const uint64_t end = (uint64_t)pool->chunks * (w + 1) / pool->threads;
        atomic_store(&pool->share[w].left, pack_range((uint32_t)begin, (uint32_t)end));
    }
}

/* Takes a chunk of a share: its owner takes the first one, other workers the last. Returns false if
   none is left. */
static bool take_chunk(Share *share, bool own, uint32_t *chunk) {
    uint64_t left = atomic_load_explicit(&share->left, memory_order_relaxed), rest;
    do {
        const uint32_t begin = (uint32_t)left, end = (uint32_t)(left >> 32);
        if (begin >= end)
            return false;
        *chunk = own ? begin : end - 1;
        rest = own ? pack_range(begin + 1, end) : pack_range(begin, end - 1);
    } while (!atomic_compare_exchange_weak_explicit(&share->left, &left, rest, memory_order_relaxed,
                                                    memory_order_relaxed));
    return true;
}

static bool are_chunks_taken(JoxPool *pool) {
    for (uint32_t w = 0; w < pool->threads; w++) {
        const uint64_t left = atomic_load(&pool->share[w].left);
        if ((uint32_t)left < (uint32_t)(left >> 32))
            return false;
    }
    return true;
}

static void run_chunk(JoxPool *pool, uint32_t chunk, uint32_t worker) {
    const uint32_t begin = chunk * pool->grain, left = pool->count - begin;
    JOX_ASSERT(begin < pool->count && worker < pool->threads);
    pool->task(pool->context, begin, begin + (left < pool->grain ? left : pool->grain), worker);
}

/* Runs all chunks of the worker's own share, then those left in other shares. */
static void run_shares(JoxPool *pool, uint32_t worker) {
    uint32_t chunk;
    for (uint32_t k = 0; k < pool->threads; k++)
        while (take_chunk(&pool->share[(worker + k) % pool->threads], k == 0, &chunk))
            run_chunk(pool, chunk, worker);
}

/* Runs chunks with the caller's heap. When memory runs out, empties all shares so that the loop
   ends early; the caller sees `starved` once no thread is inside. */
static void run_chunks(JoxPool *pool, uint32_t worker) {
    JoxRecovery recovery;
    JoxHeap *before = jox_heap_use(pool->heap);
    jox_recovery_push(&recovery);
    if (setjmp(recovery.jump) != 0) {
        atomic_store(&pool->starved, true);
        for (uint32_t w = 0; w < pool->threads; w++)
            atomic_store(&pool->share[w].left, pack_range(0, 0));
    } else {
        run_shares(pool, worker);
    }
    jox_recovery_pop(&recovery);
    jox_heap_use(before);
}

/* A job for the host's threads. The host may run more jobs than were asked for: extra ones do
   nothing. */
static void run_job(void *data, uint32_t worker) {
    JoxPool *pool = data;
    const JoxNumeric before = jox_numeric_use(jox_numeric_plain());
    if (worker < pool->threads)
        run_chunks(pool, worker);
    jox_numeric_use(before);
}

/* A bounded wait without sleep. It is longer than a step's serial work between two loops, because
   waking a thread takes 50 us and more on virtual processors. It is bounded by time and not by
   turns, as one pause takes 10 to 150 cycles. */
static const double SPIN = 300e-6;       /* s */
static const double SPIN_CROWDED = 3e-6; /* s, if there are more threads than processors */
typedef struct Spin {
    double most, until; /* s */
    unsigned turns;
} Spin;

/* Pauses for one turn; returns false when the time is up. */
static bool spin_turn(Spin *wait) {
    jox_pause();
    if (++wait->turns % 64 != 0)
        return true;
    const double now = jox_clock_wall();
    if (wait->until <= 0.0)
        wait->until = now + wait->most;
    return now < wait->until;
}

/* Waits until the number of the loop differs from `seen`; returns it. */
static unsigned await_round(JoxPool *pool, unsigned seen) {
    Spin wait = {.most = pool->spin};
    do {
        const unsigned round = atomic_load(&pool->round);
        if (round != seen)
            return round;
    } while (spin_turn(&wait));
    pthread_mutex_lock(&pool->lock);
    /* Counted before `round` is read: start_round changes `round` before it reads `asleep`. */
    atomic_fetch_add(&pool->asleep, 1);
    while (atomic_load(&pool->round) == seen)
        pthread_cond_wait(&pool->wake, &pool->lock);
    atomic_fetch_sub(&pool->asleep, 1);
    pthread_mutex_unlock(&pool->lock);
    return atomic_load(&pool->round);
}

static bool enter_gate(JoxPool *pool) {
    unsigned gate = atomic_load(&pool->gate);
    while (gate & OPEN)
        if (atomic_compare_exchange_weak(&pool->gate, &gate, gate + 1))
            return true;
    return false;
}

static void *worker_main(void *argument) {
    struct Worker *self = argument;
    JoxPool *pool = self->pool;
    unsigned seen = 0;
    for (;;) {
        seen = await_round(pool, seen);
        if (atomic_load(&pool->quit))
            return NULL;
        if (!enter_gate(pool))
            continue;
        run_chunks(pool, self->number);
        /* closed, and this was the last worker inside */
        if (atomic_fetch_sub(&pool->gate, 1) == 1) {
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
    JoxPool *pool = jox_alloc_aligned(1, sizeof *pool);
    pthread_mutex_init(&pool->lock, NULL);
    pthread_cond_init(&pool->wake, NULL);
    pthread_cond_init(&pool->done, NULL);
    pool->threads = threads < 1 ? 1 : threads > MOST_THREADS ? MOST_THREADS : threads;
    pool->running = 1;
    pool->pace = (Pace){.left = SOON, .interval = SOON};
    return jox_heap_register(pool, release_pool);
}

/* Starts the threads. If the system starts fewer, results are the same. */
static void start_threads(JoxPool *pool) {
    pool->begun = true;
    pool->spin = pool->threads > jox_count_processors() ? SPIN_CROWDED : SPIN;
    for (uint32_t i = 1; i < pool->threads && !pool->jobs; i++) {
        pool->worker[i] = (struct Worker){pool, i};
        if (!jox_thread_start(&pool->thread[i], worker_main, &pool->worker[i]))
            return;
        pool->running++;
    }
}

/* Announces a loop and wakes up to `wanted` sleeping workers; those that spin notice by
   themselves. */
static void start_round(JoxPool *pool, uint32_t wanted) {
    atomic_fetch_add(&pool->round, 1);
    if (atomic_load(&pool->asleep) == 0)
        return;
    pthread_mutex_lock(&pool->lock);
    if (wanted >= pool->running - 1)
        pthread_cond_broadcast(&pool->wake);
    for (uint32_t n = 0; n < wanted && wanted < pool->running - 1; n++)
        pthread_cond_signal(&pool->wake);
    pthread_mutex_unlock(&pool->lock);
}

/* Closes the gate to further workers and returns when none is inside. */
static void close_gate(JoxPool *pool) {
    atomic_fetch_and(&pool->gate, ~OPEN);
    for (Spin wait = {.most = pool->spin}; atomic_load(&pool->gate) > 0 && spin_turn(&wait);)
        continue;
    if (atomic_load(&pool->gate) == 0)
        return;
    pthread_mutex_lock(&pool->lock);
    while (atomic_load(&pool->gate) > 0)
        pthread_cond_wait(&pool->done, &pool->lock);
    pthread_mutex_unlock(&pool->lock);
}

void jox_pool_free(JoxPool *pool) {
    if (!pool)
        return;
    jox_heap_unregister(pool);
    atomic_store(&pool->quit, true);
    start_round(pool, UINT32_MAX);
    for (uint32_t i = 1; i < pool->running; i++)
        pthread_join(pool->thread[i], NULL);
    pthread_cond_destroy(&pool->done);
    pthread_cond_destroy(&pool->wake);
    pthread_mutex_destroy(&pool->lock);
    jox_free(pool);
}

void jox_pool_set_jobs(JoxPool *pool, const JoJobs *jobs) {
    JOX_ASSERT(!pool->begun);
    pool->jobs = jobs;
}

uint32_t jox_pool_threads(const JoxPool *pool) {
    return pool ? pool->threads : 1;
}

void jox_pool_note_duration(JoxPool *pool, double seconds) {
    Pace *p = &pool->pace;
    if (!pool->begun)
        return;
    if (p->probing)
        p->probed += seconds / PROBE;
    else
        p->usual = p->usual > 0.0 ? 0.8 * p->usual + 0.2 * seconds : seconds;
    if (--p->left > 0)
        return;
    if (p->probing && p->probed < BETTER * p->usual) {
        p->usual = p->probed;
        p->interval = SOON;
    } else if (p->probing) {
        p->alone = !p->alone;
        p->interval = 4 * p->interval < SELDOM ? 4 * p->interval : SELDOM;
    } else {
        p->alone = !p->alone;
        p->probed = 0.0;
    }
    p->probing = !p->probing;
    p->left = p->probing ? PROBE : p->interval;
}

void jox_parallel_for_many(JoxPool *pool, uint32_t count, uint32_t grain, JoxTask *task,
                           void *context) {
    JOX_ASSERT(grain > 0);
    if (!pool || pool->threads == 1 || count <= grain || pool->pace.alone) {
        for (uint32_t begin = 0; begin < count; begin += grain)
            task(context, begin, count - begin < grain ? count : begin + grain, 0);
        return;
    }
    if (!pool->begun)
        start_threads(pool);
    JOX_ASSERT(atomic_load(&pool->gate) == 0); /* one loop at a time */
    pool->count = count;
    pool->grain = grain;
    pool->chunks = (count + grain - 1) / grain;
    pool->task = task;
    pool->context = context;
    pool->heap = jox_heap_used();
    share_chunks(pool);
    if (pool->jobs) {
        const uint32_t most = pool->chunks < pool->threads ? pool->chunks : pool->threads;
        pool->jobs->run(pool->jobs->context, most, run_job, pool);
        if (!are_chunks_taken(pool)) {
            jox_assert_failed("JoJobs.run calls each job", __FILE__, __LINE__);
            run_chunks(pool, 0);
        }
    } else {
        atomic_store(&pool->gate, OPEN);
        start_round(pool, pool->chunks - 1);
        run_chunks(pool, 0);
        close_gate(pool);
    }
    JOX_ASSERT(are_chunks_taken(pool));
    if (atomic_exchange(&pool->starved, false))
        jox_out_of_memory(0);
}
