#include "task/worker.h"

#include <pthread.h>

#include "base/mem.h"

struct JoxWorker {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t given, done;
    JoxErrand *first; /* that has not begun */
    bool begun, quit;
};

/* Takes an errand off the list; false where it has begun already. Under the lock. */
static bool take(JoxWorker *worker, JoxErrand *errand) {
    JoxErrand **at = &worker->first;
    while (*at && *at != errand)
        at = &(*at)->next;
    if (!*at)
        return false;
    *at = errand->next;
    errand->next = NULL;
    return true;
}

static void *work(void *argument) {
    JoxWorker *worker = argument;
    pthread_mutex_lock(&worker->lock);
    for (;;) {
        while (!worker->first && !worker->quit)
            pthread_cond_wait(&worker->given, &worker->lock);
        if (worker->quit)
            break;
        JoxErrand *errand = worker->first;
        take(worker, errand);
        pthread_mutex_unlock(&worker->lock);
        errand->run(errand);
        pthread_mutex_lock(&worker->lock);
        errand->done = true;
        pthread_cond_broadcast(&worker->done);
    }
    pthread_mutex_unlock(&worker->lock);
    return NULL;
}

JoxWorker *jox_worker_create(void) {
    JoxWorker *worker = jox_alloc(1, sizeof *worker);
    pthread_mutex_init(&worker->lock, NULL);
    pthread_cond_init(&worker->given, NULL);
    pthread_cond_init(&worker->done, NULL);
    return worker;
}

void jox_worker_give(JoxWorker *worker, JoxErrand *errand) {
    if (!worker->begun) /* without a thread, who waits does the work */
        worker->begun = pthread_create(&worker->thread, NULL, work, worker) == 0;
    pthread_mutex_lock(&worker->lock);
    JoxErrand **end = &worker->first;
    while (*end)
        end = &(*end)->next;
    *end = errand;
    errand->next = NULL;
    errand->done = false;
    pthread_cond_signal(&worker->given);
    pthread_mutex_unlock(&worker->lock);
}

void jox_worker_wait(JoxWorker *worker, JoxErrand *errand) {
    pthread_mutex_lock(&worker->lock);
    bool mine = take(worker, errand);
    while (!mine && !errand->done)
        pthread_cond_wait(&worker->done, &worker->lock);
    pthread_mutex_unlock(&worker->lock);
    if (mine) {
        errand->run(errand);
        errand->done = true;
    }
}

void jox_worker_free(JoxWorker *worker) {
    if (!worker)
        return;
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
