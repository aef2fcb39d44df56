/* System calls that the libraries of WebAssembly lack. */
#include <errno.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <sys/file.h>
#include <sys/random.h>
#include <unistd.h>

#include "wasm/module_threads.h"

int eventfd(unsigned value, int flags) {
    (void)value, (void)flags;
    errno = ENOSYS;
    return -1;
}

int jox_module_processors = 1;

/* The set is not filled: only its count is asked for (task/processors.c). */
int sched_getaffinity(pid_t process, size_t size, cpu_set_t *set) {
    (void)process, (void)size, (void)set;
    return 0;
}

int __sched_cpucount(size_t size, const cpu_set_t *set) {
    (void)size, (void)set;
    return jox_module_processors;
}

/* No other process has the files of the module's file system. */
int flock(int descriptor, int operation) {
    (void)descriptor, (void)operation;
    return 0;
}

ssize_t getrandom(void *bytes, size_t length, unsigned flags) {
    (void)flags;
    return getentropy(bytes, length) == 0 ? (ssize_t)length : -1;
}
