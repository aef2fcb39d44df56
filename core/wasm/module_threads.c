/* The threads of the module: one pool, whose threads the loops of all scenes share, as scenes take
   turns. In the module without threads it has one, the caller's. */
#include "wasm/module_threads.h"

#include "base/guard.h"
#include "base/mem.h"
#include "task/pool.h"

static JoxPool *pool; /* NULL: no threads */

typedef struct JobCall {
    void (*job)(void *data, uint32_t number);
    void *data;
} JobCall;

static void run_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    const JobCall *call = context;
    (void)worker; /* numbers of jobs differ, as those of workers do */
    for (uint32_t n = begin; n < end; n++)
        call->job(call->data, n);
}

static void run_jobs(void *context, uint32_t count, void (*job)(void *data, uint32_t number),
                     void *data) {
    JobCall call = {job, data};
    (void)context;
    jox_parallel_for(pool, count, 1, run_range, &call);
}

uint32_t jox_module_threads(void) {
    return jox_pool_threads(pool);
}

JOX_MODULE_CALL uint32_t jostle_threads(void) {
    return jox_module_threads();
}

const JoJobs *jox_module_jobs(void) {
    static const JoJobs jobs = {run_jobs, NULL};
    return pool ? &jobs : NULL;
}

/* Uses `count` threads, the caller's included, for scenes that are opened from now on. Called once,
   before the first scene, with the number of processors of the machine. False if memory is out. */
JOX_MODULE_CALL bool jostle_use_threads(uint32_t count, uint32_t processors) {
    JoxHeap *heap = jox_heap_create();
    if (!heap)
        return false;
    JOX_GUARD (heap, NULL)
        return false;
    jox_module_processors = (int)processors;
    pool = jox_pool_create(count);
    return true;
}
