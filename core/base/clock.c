#include "base/clock.h"

#include <time.h>

/* Reads the first of two clocks that can be read, s; if neither can, returns whole seconds of the
   date, which cannot fail. A clock cannot be read if the system lacks it or a filter of system
   calls forbids it. */
static double read_clock(clockid_t clock, clockid_t other) {
    struct timespec t;
    if (clock_gettime(clock, &t) != 0 && clock_gettime(other, &t) != 0)
        return (double)time(NULL);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

double jox_clock_wall(void) {
    return read_clock(CLOCK_MONOTONIC, CLOCK_REALTIME);
}

double jox_clock_date(void) {
    return read_clock(CLOCK_REALTIME, CLOCK_REALTIME);
}

double jox_clock_cpu(void) {
    return read_clock(CLOCK_PROCESS_CPUTIME_ID, CLOCK_MONOTONIC);
}

double jox_clock_thread(void) {
    return read_clock(CLOCK_THREAD_CPUTIME_ID, CLOCK_MONOTONIC);
}

double jox_clock_thread_cost(void) {
    double least = 1e-3;
    for (int n = 0; n < 20; n++) {
        const double before = jox_clock_thread(), took = jox_clock_thread() - before;
        least = took < least ? took : least;
    }
    return least > 0.0 ? least : 0.0;
}
