#include "task/worker.h"

#include <pthread.h>

#include "base/assert.h"
#include "base/mem.h"
#include "task/thread.h"

struct JoxWorker {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t given, done;
    JoxWorkItem *first; /* the oldest item that has not begun */
    bool begun, quit;
};

/* Takes an item off the queue; false if it has begun already. The caller holds the lock. */
static bool unlink_item(JoxWorker *worker, JoxWorkItem *item) {
    JoxWorkItem **at = &worker->first;
    while (*at && *at != item)
        at = &(*at)->next;
    if (!*at)
        return false;
    JOX_ASSERT(!item->done);
    *at = item->next;
    item->next = NULL;
    return true;
}

static void run_item(JoxWorkItem *item) {
    JoxRecovery recovery;
    JoxHeap *before = jox_heap_use(item->heap);
    jox_recovery_push(&recovery);
    if (setjmp(recovery.jump) != 0)
        item->starved = true;
    else
        item->run(item);
    jox_recovery_pop(&recovery);
    jox_heap_use(before);
}

static void *run_worker(void *argument) {
    JoxWorker *worker = argument;
    pthread_mutex_lock(&worker->lock);
    for (;;) {
        while (!worker->first && !worker->quit)
            pthread_cond_wait(&worker->given, &worker->lock);
        if (worker->quit)
            break;
        JoxWorkItem *item = worker->first;
        unlink_item(worker, item);
        pthread_mutex_unlock(&worker->lock);
        run_item(item);
        pthread_mutex_lock(&worker->lock);
        item->done = true;
        pthread_cond_broadcast(&worker->done);
    }
    pthread_mutex_unlock(&worker->lock);
    return NULL;
}

static void release_worker(void *worker) {
    jox_worker_free(worker);
}

JoxWorker *jox_worker_create(void) {
    JoxWorker *worker = jox_alloc(1, sizeof *worker);
    pthread_mutex_init(&worker->lock, NULL);
    pthread_cond_init(&worker->given, NULL);
    pthread_cond_init(&worker->done, NULL);
    return jox_heap_register(worker, release_worker);
}

void jox_worker_enqueue(JoxWorker *worker, JoxWorkItem *item) {
    if (!worker->begun) /* if no thread starts, jox_worker_wait runs the items */
        worker->begun = jox_thread_start(&worker->thread, run_worker, worker);
    pthread_mutex_lock(&worker->lock);
    JoxWorkItem **end = &worker->first;
    while (*end) {
        JOX_ASSERT(*end != item);
        end = &(*end)->next;
    }
    *end = item;
    item->next = NULL;
    item->done = item->starved = false;
    item->heap = jox_heap_used();
    pthread_cond_signal(&worker->given);
    pthread_mutex_unlock(&worker->lock);
}

void jox_worker_wait(JoxWorker *worker, JoxWorkItem *item) {
    pthread_mutex_lock(&worker->lock);
    bool mine = unlink_item(worker, item);
    while (!mine && !item->done)
        pthread_cond_wait(&worker->done, &worker->lock);
    pthread_mutex_unlock(&worker->lock);
    if (mine) {
        run_item(item);
        item->done = true;
    }
    JOX_ASSERT(item->done && !item->next);
    if (item->starved)
        jox_out_of_memory(0);
}

void jox_worker_free(JoxWorker *worker) {
    if (!worker)
        return;
    jox_heap_unregister(worker);
    pthread_mutex_lock(&worker->lock);
    worker->quit = true;
    pthread_cond_signal(&worker->given);
    pthread_mutex_unlock(&worker->lock);
    if (worker->begun)
        pthread_join(worker->thread, NULL);
    pthread_cond_destroy(&worker->done);
    pthread_cond_destroy(&worker->given);
    pthread_mutex_destroy(&worker->lock);
    jox_free(worker);
}
