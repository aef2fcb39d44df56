/* A thread for long work beside the steps, done in the order in which it was given. */
#ifndef JOX_TASK_WORKER_H
#define JOX_TASK_WORKER_H

#include <stdbool.h>

typedef struct JoxWorker JoxWorker;

/* One piece of work; its owner keeps it until it was waited for, or the worker is gone. Embed it
   and fill `run`; the rest is the worker's own. */
typedef struct JoxWorkItem {
    void (*run)(struct JoxWorkItem *item);
    struct JoxWorkItem *next;
    struct JoxHeap *heap; /* of who gave it */
    bool done, starved;
} JoxWorkItem;

/* The thread begins with the first item. Never NULL. */
JoxWorker *jox_worker_create(void);
/* Ends what is under way; what has not begun is not run. */
void jox_worker_free(JoxWorker *worker);
void jox_worker_give(JoxWorker *worker, JoxWorkItem *item);
/* Returns when the item is done; one that has not begun is run by the caller. Where memory ran out
   in it, that shows here, as in an allocation of the caller's (base/mem.h). */
void jox_worker_wait(JoxWorker *worker, JoxWorkItem *item);

#endif
