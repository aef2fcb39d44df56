/* Preloaded into a program: of its allocations, whoever makes them, that of number FAULT_AT (from
   1) fails. At the end the number of all is written to the file descriptor FAULT_COUNT, where that
   is given. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static atomic_ulong made;
static unsigned long fails = (unsigned long)-1; /* none */

__attribute__((constructor)) static void begin(void) {
    const char *at = getenv("FAULT_AT");
    unsetenv("LD_PRELOAD"); /* programs that this one starts, as gnuplot, have their memory */
    atomic_store(&made, 0);
    if (at)
        fails = strtoul(at, NULL, 10);
}

__attribute__((destructor)) static void end(void) {
    const char *to = getenv("FAULT_COUNT");
    if (to)
        dprintf(atoi(to), "%lu\n", atomic_load(&made));
}

static int is_failed(void) {
    if (atomic_fetch_add(&made, 1) + 1 != fails)
        return 0;
    errno = ENOMEM;
    return 1;
}

void *malloc(size_t size) {
    return is_failed() ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size) {
    return is_failed() ? NULL : __libc_calloc(count, size);
}

void *realloc(void *memory, size_t size) {
    return is_failed() ? NULL : __libc_realloc(memory, size);
}

void *aligned_alloc(size_t alignment, size_t size) {
    return is_failed() ? NULL : __libc_memalign(alignment, size);
}

int posix_memalign(void **memory, size_t alignment, size_t size) {
    void *made_now = is_failed() ? NULL : __libc_memalign(alignment, size);
    if (made_now)
        *memory = made_now;
    return made_now ? 0 : ENOMEM;
}
