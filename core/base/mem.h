/* Memory: the engine's one allocator, and heaps, which own allocations.
 *
 * An allocation never returns NULL: if memory is out, the thread jumps (longjmp) to its innermost
 * recovery point, which a public call sets at its beginning (guard.h). All memory that a call
 * allocates belongs to the heap that its thread uses: that of the world or the scene, or one of the
 * call alone. When memory runs out, the heap in use is marked as failed: its objects may be half
 * made, so that no destructors are run, but the heap releases all its memory at once.
 */
#ifndef JOX_BASE_MEM_H
#define JOX_BASE_MEM_H

#include <pthread.h>
#include <setjmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Allocates `count` objects of `size` bytes, zeroed. */
void *jox_alloc(size_t count, size_t size);
/* Grows or shrinks memory; new bytes are not zeroed. It stays in its heap. NULL allocates. */
void *jox_realloc(void *memory, size_t count, size_t size);
/* As jox_alloc, aligned to 64 bytes. Freed by jox_free; cannot be reallocated. */
void *jox_alloc_aligned(size_t count, size_t size);
/* Copies an array into memory of its own, which holds one more item, zeroed. `from`: may be NULL if
   `count` is 0. */
void *jox_copy_array(const void *from, size_t count, size_t size);
/* Frees memory of any heap, from any thread; NULL is fine. */
void jox_free(void *memory);
/* Copy a text. jox_strdup of NULL is NULL. */
char *jox_strdup(const char *text);
char *jox_strndup(const char *text, size_t length);

/* For Lua: as realloc, NULL if memory is out. Such memory belongs to no heap and is freed by
   jox_give_back. */
void *jox_try_realloc(void *memory, size_t bytes);
void jox_give_back(void *memory);
/* As malloc, counted for jox_alloc_fail_after; for libraries that free their memory by free(). */
void *jox_try_malloc(size_t bytes);

/* Sets the program's allocator, which the functions above use except for jox_try_malloc; NULL: the
   C library's. False, and nothing changes, once anything was allocated. */
struct JoAllocator;
bool jox_set_allocator(const struct JoAllocator *allocator);

/* Number of allocations since the process began. Tests check that steps do not change it. */
uint64_t jox_alloc_count(void);
/* For tests: memory is out after `count` more allocations, until the next call; UINT64_MAX:
   never. */
void jox_alloc_fail_after(uint64_t count);

/* ---- recovery points ----
 *
 *     JoxRecovery recovery;
 *     jox_recovery_push(&recovery);
 *     if (setjmp(recovery.jump) != 0) {
 *         ... memory is out: the point has been popped ...
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

/* Makes `recovery` the innermost point of the calling thread. It must stay in the caller's frame
   until it is popped or jumped to. */
void jox_recovery_push(JoxRecovery *recovery);
/* Removes `recovery` if it is the innermost point; does nothing if it was jumped to. */
void jox_recovery_pop(JoxRecovery *recovery);
/* Whether the calling thread has a recovery point. */
bool jox_recovery_exists(void);

/* Jumps to the innermost recovery point of the thread. Without one the program ends with a message:
   only Jostle's own programs and tests call the engine so. `bytes`: size that was wanted; 0:

   unknown. */
__attribute__((noreturn)) void jox_out_of_memory(size_t bytes);

/* ---- heaps ---- */

/* Header before each allocation: links the allocations of a heap into a ring. */
typedef struct JoxBlock {
    struct JoxBlock *next, *previous;
    struct JoxHeap *heap; /* NULL: no heap owns it, and the links are unused */
    size_t offset;        /* bytes from the address that malloc returned to the memory */
} JoxBlock;

typedef struct JoxHeap {
    JoxBlock blocks; /* head of the ring */
    pthread_mutex_t lock;
    bool failed; /* read and written atomically */
} JoxHeap;

/* Makes a heap; NULL if memory is out. */
JoxHeap *jox_heap_create(void);
/* Frees a heap. A failed one releases the resources that it holds, newest first, and all its
   memory. Any other should be empty; what is left in it stays allocated, without a heap. */
void jox_heap_free(JoxHeap *heap);
/* The same for a heap that is a member of another struct. */
void jox_heap_begin(JoxHeap *heap);
void jox_heap_end(JoxHeap *heap);

/* Sets the heap that the calling thread allocates from (NULL: none owns the memory); returns the
   one before. */
JoxHeap *jox_heap_use(JoxHeap *heap);
JoxHeap *jox_heap_used(void);
/* Mark a heap as failed; ask whether it is. NULL never fails. */
void jox_heap_fail(JoxHeap *heap);
bool jox_heap_has_failed(const JoxHeap *heap);

/* Whether all bytes have the value `byte`. */
bool jox_mem_is(const void *memory, uint8_t byte, size_t bytes);
/* As memset, but writes only if a byte differs: pages of zeros that were never written take no
   memory, and reading keeps it so. */
void jox_mem_fill(void *memory, uint8_t byte, size_t bytes);

/* Takes memory out of its heap and returns it; the caller frees it. NULL is fine. */
void *jox_disown(void *memory);

/* Registers a resource other than memory (an open file, a connection, a thread) with the heap in
   use, which calls `release` if it fails before jox_heap_unregister. If the registration itself is
   out of memory, `release` is called at once. Returns `thing`, which must not be NULL. */
typedef void JoxRelease(void *thing);
void *jox_heap_register(void *thing, JoxRelease *release);
/* Unregisters a resource, which the caller then releases. From any thread; one that is not
   registered is fine. */
void jox_heap_unregister(void *thing);

/* Ensures that an array has room for `need` items; doubles its capacity. */
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

/* The same; new items are zero. */
#define JOX_RESERVE_ZEROED(array, capacity, need)                                                  \
    do {                                                                                           \
        size_t jox_had = (capacity);                                                               \
        JOX_RESERVE(array, capacity, need);                                                        \
        if ((size_t)(capacity) > jox_had)                                                          \
            memset((array) + jox_had, 0, ((size_t)(capacity)-jox_had) * sizeof *(array));          \
    } while (0)

#endif
