#include "task/thread.h"

#include <signal.h>
#include <stdlib.h>

#include "base/guard.h"

typedef struct Start {
    void *(*run)(void *);
    void *argument;
} Start;

static void *begin(void *data) {
    const Start start = *(Start *)data;
    free(data);
    jox_numeric_use(jox_numeric_plain());
    return start.run(start.argument);
}

bool jox_thread_start(pthread_t *thread, void *(*run)(void *), void *argument) {
    /* A fault is delivered to the thread that caused it, and must reach its handler. */
    static const int FAULTS[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGABRT};
    sigset_t blocked, before;
    Start *start = malloc(sizeof *start); /* no heap's: the thread frees it */
    if (!start)
        return false;
    *start = (Start){run, argument};
    sigfillset(&blocked);
    for (size_t f = 0; f < sizeof FAULTS / sizeof *FAULTS; f++)
        sigdelset(&blocked, FAULTS[f]);
    pthread_sigmask(SIG_SETMASK, &blocked, &before); /* the new thread has the same mask */
    const bool started = pthread_create(thread, NULL, begin, start) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (!started)
        free(start);
    return started;
}
