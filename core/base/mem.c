#include "base/mem.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static atomic_uint_fast64_t allocations;

static void *checked(void *memory, size_t bytes) {
    if (!memory) {
        fprintf(stderr, "jostle: out of memory (%zu bytes wanted)\n", bytes);
        abort();
    }
    atomic_fetch_add_explicit(&allocations, 1, memory_order_relaxed);
    return memory;
}

static size_t total(size_t count, size_t size) {
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes))
        bytes = SIZE_MAX / 2; /* malloc refuses this, and `checked` reports it */
    return bytes ? bytes : 1;
}

void *jox_alloc(size_t count, size_t size) {
    size_t bytes = total(count, size);
    return checked(calloc(1, bytes), bytes);
}

void *jox_realloc(void *memory, size_t count, size_t size) {
    size_t bytes = total(count, size);
    return checked(realloc(memory, bytes), bytes);
}

void *jox_alloc_aligned(size_t count, size_t size) {
    size_t bytes = (total(count, size) + 63) & ~(size_t)63;
    return memset(checked(aligned_alloc(64, bytes), bytes), 0, bytes);
}

void jox_free(void *memory) {
    free(memory);
}

char *jox_strndup(const char *text, size_t length) {
    char *copy = jox_alloc(length + 1, 1);
    memcpy(copy, text, length);
    return copy;
}

char *jox_strdup(const char *text) {
    return text ? jox_strndup(text, strlen(text)) : NULL;
}

uint64_t jox_alloc_count(void) {
    return atomic_load_explicit(&allocations, memory_order_relaxed);
}
