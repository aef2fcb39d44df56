/* Starts the engine's threads, for the pool, the worker and the page's server. Signals sent to the
   process are blocked in them, so that the program's own threads receive them. */
#ifndef JOX_TASK_THREAD_H
#define JOX_TASK_THREAD_H

#include <pthread.h>
#include <stdbool.h>

/* As pthread_create with default attributes; false if the system starts no thread. */
bool jox_thread_start(pthread_t *thread, void *(*run)(void *), void *argument);

#endif
