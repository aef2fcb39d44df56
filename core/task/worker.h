/* A thread that runs long work while steps go on, in the order in which it was given. Routes
   compute their distance fields on it (world/routes/routes.c). */
#ifndef JOX_TASK_WORKER_H
#define JOX_TASK_WORKER_H

#include <stdbool.h>

typedef struct JoxWorker JoxWorker;

/* One piece of work. Its owner keeps it alive until jox_worker_wait has returned, or the worker is
   freed. Embed it and set `run`; the worker sets the rest. */
typedef struct JoxWorkItem {
    void (*run)(struct JoxWorkItem *item);
    struct JoxWorkItem *next;
    struct JoxHeap *heap; /* the giver's; `run` allocates from it */
    bool done, starved;   /* starved: memory ran out in `run` */
} JoxWorkItem;

/* Creates a worker; its thread starts with the first item. Never NULL. */
JoxWorker *jox_worker_create(void);
/* Waits for the item that runs, and drops items that have not begun. */
void jox_worker_free(JoxWorker *worker);
/* Appends an item to the queue. */
void jox_worker_enqueue(JoxWorker *worker, JoxWorkItem *item);
/* Waits until the item is done; the caller runs it itself if it has not begun. When memory ran out
   in it, the call fails as an allocation of the caller would (base/mem.h). */
void jox_worker_wait(JoxWorker *worker, JoxWorkItem *item);

#endif
