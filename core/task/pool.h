/* A pool of threads for loops whose iterations are independent. */
#ifndef JOX_TASK_POOL_H
#define JOX_TASK_POOL_H

#include <stdint.h>

typedef struct JoxPool JoxPool;
struct JoJobs;

/* At most `threads`, the caller included, 1..64; they are started when a loop has work for them.
   Never NULL. */
JoxPool *jox_pool_create(uint32_t threads);
void jox_pool_free(JoxPool *pool);
/* Loops run on a program's own threads from here on; before the first loop. It stays the caller's.
 */
void jox_pool_set_jobs(JoxPool *pool, const struct JoJobs *jobs);
uint32_t jox_pool_threads(const JoxPool *pool);

/* Work on [begin, end); `worker` in [0, threads) names scratch space, never influences results. */
typedef void JoxTask(void *context, uint32_t begin, uint32_t end, uint32_t worker);
/* jox_parallel_for of more than one chunk. */
void jox_parallel_for_many(JoxPool *pool, uint32_t count, uint32_t grain, JoxTask *task,
                           void *context);
/* Splits [0, count) into chunks of `grain` (the last may be shorter), the same for any number of
   threads, runs them all and returns. `pool` NULL runs here. Not reentrant. */
static inline void jox_parallel_for(JoxPool *pool, uint32_t count, uint32_t grain, JoxTask *task,
                                    void *context) {
    if (count > grain)
        jox_parallel_for_many(pool, count, grain, task, context);
    else if (count > 0)
        task(context, 0, count, 0);
}
/* Tells how long the caller's work with the pool took since the last call, s, where that is much
   the same each time, as steps are: while one thread does it sooner, loops run on one. */
void jox_pool_lap(JoxPool *pool, double seconds);

#endif
