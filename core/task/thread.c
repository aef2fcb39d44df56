#include "task/thread.h"

#include <signal.h>
#include <stdlib.h>

#include "base/guard.h"

typedef struct Start {
    void *(*run)(void *);
    void *argument;
} Start;

static void *run_thread(void *data) {
    const Start start = *(Start *)data;
    free(data);
    jox_numeric_use(jox_numeric_plain());
    return start.run(start.argument);
}

bool jox_thread_start(pthread_t *thread, void *(*run)(void *), void *argument) {
    /* Faults stay unblocked: the system delivers one to the thread that caused it, where its
       handler must run. */
    static const int FAULTS[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGABRT};
    sigset_t blocked, before;
    Start *start = malloc(sizeof *start); /* not from a JoxHeap: the new thread frees it */
    if (!start)
        return false;
    *start = (Start){run, argument};
    sigfillset(&blocked);
    for (size_t f = 0; f < sizeof FAULTS / sizeof *FAULTS; f++)
        sigdelset(&blocked, FAULTS[f]);
    pthread_sigmask(SIG_SETMASK, &blocked, &before); /* inherited by the new thread */
    const bool started = pthread_create(thread, NULL, run_thread, start) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (!started)
        free(start);
    return started;
}
