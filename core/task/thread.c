#include "task/thread.h"

#include <signal.h>

bool jox_thread_start(pthread_t *thread, void *(*run)(void *), void *argument) {
    /* A fault is delivered to the thread that caused it, and must reach its handler. */
    static const int FAULTS[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGABRT};
    sigset_t blocked, before;
    sigfillset(&blocked);
    for (size_t f = 0; f < sizeof FAULTS / sizeof *FAULTS; f++)
        sigdelset(&blocked, FAULTS[f]);
    pthread_sigmask(SIG_SETMASK, &blocked, &before); /* the new thread has the same mask */
    const bool started = pthread_create(thread, NULL, run, argument) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}
