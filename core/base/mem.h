/* Memory: the one allocator of the engine, and heaps, which own what is allocated.
 *
 * Where memory is out, an allocation does not return: the thread goes back to its innermost
 * recovery point, which is where a public call began (guard.h). Whatever was allocated
 * in a call belongs to the heap that the thread uses: that of the world or of the scene that was
 * called, or one of the call alone. A heap in which memory ran out is failed: what it owns may be
 * half done, so that its destructors are not run, but the heap releases it as a whole.
 */
#ifndef JOX_BASE_MEM_H
#define JOX_BASE_MEM_H

#include <pthread.h>
#include <setjmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* `count` objects of `size` bytes, zeroed. Never NULL. */
void *jox_alloc(size_t count, size_t size);
/* Grows or shrinks; new bytes are not zeroed. Never NULL. Memory keeps its heap. */
void *jox_realloc(void *memory, size_t count, size_t size);
/* As jox_alloc, aligned to 64 bytes; freed by jox_free like the rest, but never reallocated. */
void *jox_alloc_aligned(size_t count, size_t size);
/* From any thread. */
void jox_free(void *memory);
char *jox_strdup(const char *text);
char *jox_strndup(const char *text, size_t length);

/* For Lua: as realloc, NULL where memory is out. Such memory belongs to no heap, and goes back by
   jox_give_back. */
void *jox_try_realloc(void *memory, size_t bytes);
void jox_give_back(void *memory);
/* For allocators of other libraries, which have the C library's memory: as malloc. */
void *jox_try_malloc(size_t bytes);

/* Where all of this comes from; NULL: the C library. False once anything was allocated. */
struct JoAllocator;
bool jox_set_allocator(const struct JoAllocator *allocator);

/* Number of allocations since the process began: a steady step must not move it. */
uint64_t jox_alloc_count(void);
/* For tests: after `count` more allocations memory is out, until this is called with UINT64_MAX. */
void jox_alloc_fail_after(uint64_t count);

/* ---- recovery points ----
 *
 *     JoxRecovery recovery;
 *     jox_recovery_push(&recovery);
 *     if (setjmp(recovery.jump) != 0) {
 *         ... memory is out: the point is gone already ...
 *     } else {
 *         ... work ...
 *         jox_recovery_pop(&recovery);
 *     }
 *
 * Code between a recovery point and an allocation must hold no lock. Public calls use guard.h. */

typedef struct JoxRecovery {
    jmp_buf jump;
    struct JoxRecovery *outer;
} JoxRecovery;

/* Of the calling thread. `recovery` stays in the caller's frame until it is popped or reached. */
void jox_recovery_push(JoxRecovery *recovery);
/* Takes the innermost point away; does nothing where it was reached and is gone. */
void jox_recovery_pop(JoxRecovery *recovery);
/* Whether the calling thread has a recovery point. */
bool jox_recovery_exists(void);

/* Goes to the innermost recovery point of the thread. Without one the program ends with a message:
   only our own programs and tests call the engine that way. `bytes` were wanted; 0 is unknown. */
__attribute__((noreturn)) void jox_out_of_memory(size_t bytes);

/* ---- heaps ---- */

/* Links of what a heap owns; stands before each allocation. */
typedef struct JoxBlock {
    struct JoxBlock *next, *previous;
    struct JoxHeap *heap; /* NULL: of no heap, and without links */
    size_t offset;        /* from what malloc gave to the memory, bytes */
} JoxBlock;

typedef struct JoxHeap {
    JoxBlock blocks; /* of a ring */
    pthread_mutex_t lock;
    bool failed; /* read and written atomically */
} JoxHeap;

/* NULL where memory is out. */
JoxHeap *jox_heap_create(void);
/* A failed heap releases what it holds, the newest first, and all of its memory. Of any other
   everything should be gone; what is left remains, without a heap. */
void jox_heap_free(JoxHeap *heap);
/* The same for a heap that is part of something else, as jox_heap_begin made it. */
void jox_heap_begin(JoxHeap *heap);
void jox_heap_end(JoxHeap *heap);

/* The calling thread allocates from it from here on (NULL: from none); returns the one before. */
JoxHeap *jox_heap_use(JoxHeap *heap);
JoxHeap *jox_heap_used(void);
/* NULL is a heap that never fails. */
void jox_heap_fail(JoxHeap *heap);
bool jox_heap_has_failed(const JoxHeap *heap);

/* Whether all bytes are this one. */
bool jox_mem_is(const void *memory, uint8_t byte, size_t bytes);
/* Sets all bytes to this one, and writes nothing where they are: zeros that were never written are
   then read alone, and take no page of their own. */
void jox_mem_fill(void *memory, uint8_t byte, size_t bytes);

/* Takes memory out of its heap, for a caller who frees it; NULL is fine. Returns it. */
void *jox_disown(void *memory);

/* What is not memory: an open file, a connection, a thread. The heap in use calls `release` if it
   fails before jox_let_go. Where memory is out, `release` is called at once. Returns `thing`, which
   must not be NULL. */
typedef void JoxRelease(void *thing);
void *jox_hold(void *thing, JoxRelease *release);
/* The caller releases it now. From any thread; what nobody holds is fine. */
void jox_let_go(void *thing);

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
