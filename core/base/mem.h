/* Memory. Exhaustion of the machine's memory is fatal and reported; size overflow is checked. */
#ifndef JOX_BASE_MEM_H
#define JOX_BASE_MEM_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* `count` objects of `size` bytes, zeroed. Never NULL. */
void *jox_alloc(size_t count, size_t size);
/* Grows or shrinks; new bytes are not zeroed. Never NULL. */
void *jox_realloc(void *memory, size_t count, size_t size);
/* As jox_alloc, aligned to 64 bytes; freed by jox_free like the rest. */
void *jox_alloc_aligned(size_t count, size_t size);
void jox_free(void *memory);
char *jox_strdup(const char *text);
char *jox_strndup(const char *text, size_t length);

/* Number of allocations since the process began: a steady step must not move it. */
uint64_t jox_alloc_count(void);

/* Ensures room for `need` items in a heap array; doubles. */
#define JOX_RESERVE(array, capacity, need)                                                         \
    do {                                                                                           \
        if ((size_t)(need) > (size_t)(capacity)) {                                                 \
            size_t jox_c = (capacity) ? 2 * (size_t)(capacity) : 8;                                \
            if (jox_c < (size_t)(need))                                                            \
                jox_c = (size_t)(need);                                                            \
            (array) = jox_realloc((array), jox_c, sizeof *(array));                                \
            (capacity) = jox_c;                                                                    \
        }                                                                                          \
    } while (0)

/* The same, with zeros in what is new. */
#define JOX_RESERVE_ZEROED(array, capacity, need)                                                  \
    do {                                                                                           \
        size_t jox_had = (capacity);                                                               \
        JOX_RESERVE(array, capacity, need);                                                        \
        if ((size_t)(capacity) > jox_had)                                                          \
            memset((array) + jox_had, 0, ((size_t)(capacity)-jox_had) * sizeof *(array));          \
    } while (0)

#endif
