/* Threads of the engine: signals that the program is sent are never delivered to them. */
#ifndef JOX_TASK_THREAD_H
#define JOX_TASK_THREAD_H

#include <pthread.h>
#include <stdbool.h>

/* As pthread_create; false where the system starts no thread. */
bool jox_thread_start(pthread_t *thread, void *(*run)(void *), void *argument);

#endif
