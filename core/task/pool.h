/* A pool of threads that runs loops whose iterations are independent. A world owns one; each stage
   of its step calls jox_parallel_for on it. */
#ifndef JOX_TASK_POOL_H
#define JOX_TASK_POOL_H

#include <stdint.h>

typedef struct JoxPool JoxPool;
struct JoJobs;

/* Creates a pool of at most `threads` threads (1..64), the caller included. They are started by the
   first loop that is long enough. Never NULL. */
JoxPool *jox_pool_create(uint32_t threads);
void jox_pool_free(JoxPool *pool);
/* Runs all loops on the host program's threads instead of own ones. Call it before the first loop.
   The caller keeps `jobs` alive as long as the pool. */
void jox_pool_set_jobs(JoxPool *pool, const struct JoJobs *jobs);
uint32_t jox_pool_threads(const JoxPool *pool);

/* Does the iterations [begin, end). `worker` in [0, threads) selects scratch memory; it must not
   influence results. */
typedef void JoxTask(void *context, uint32_t begin, uint32_t end, uint32_t worker);
/* The part of jox_parallel_for that is not inlined: loops of more than one chunk. */
void jox_parallel_for_many(JoxPool *pool, uint32_t count, uint32_t grain, JoxTask *task,
                           void *context);
/* Splits [0, count) into chunks of `grain` iterations (the last may be shorter), the same for any
   number of threads, runs all of them and returns. A NULL pool runs them on the caller. Not
   reentrant. When memory runs out in a chunk, the call fails as an allocation of the caller would
   (base/mem.h). */
static inline void jox_parallel_for(JoxPool *pool, uint32_t count, uint32_t grain, JoxTask *task,
                                    void *context) {
    if (count > grain)
        jox_parallel_for_many(pool, count, grain, task, context);
    else if (count > 0)
        task(context, 0, count, 0);
}
/* Reports the seconds of wall time that the caller's last repeated unit of work took, such as a
   step. Now and then the pool runs a few laps on one thread, and stays there while that is
   faster. */
void jox_pool_note_duration(JoxPool *pool, double seconds);

#endif
