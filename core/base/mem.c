#include "base/mem.h"

#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "jostle_host.h"

enum { ALIGNMENT = 64 };

static atomic_uint_fast64_t allocations;
static atomic_bool limited;           /* for tests: `remaining` counts, */
static atomic_int_fast64_t remaining; /* allocations until memory is out */
static _Thread_local JoxHeap *in_use; /* the thread's heap */

_Static_assert(sizeof(JoxBlock) % 16 == 0, "memory behind a block is aligned as malloc aligns it");

/* Whether the next allocation may succeed; false only in tests that exhaust memory on purpose. */
static bool may_allocate(void) {
    return !atomic_load_explicit(&limited, memory_order_relaxed) ||
           atomic_fetch_sub_explicit(&remaining, 1, memory_order_relaxed) > 0;
}

/* ---- the allocator: the program's or the C library's ---- */

static JoAllocator host;  /* its functions are NULL: the C library's are used */
static atomic_bool begun; /* something was allocated: `host` cannot change any more */

bool jox_set_allocator(const JoAllocator *allocator) {
    if (atomic_load(&begun))
        return false;
    host = allocator ? *allocator : (JoAllocator){0};
    return true;
}

static void *allocate_bytes(size_t bytes) {
    if (!atomic_load_explicit(&begun, memory_order_relaxed))
        atomic_store(&begun, true);
    return host.allocate ? host.allocate(host.context, bytes) : malloc(bytes);
}

/* By calloc where possible: fresh pages of the system are zero without being written. */
static void *allocate_zeroed_bytes(size_t bytes) {
    if (!host.allocate) {
        atomic_store_explicit(&begun, true, memory_order_relaxed);
        return calloc(1, bytes);
    }
    void *memory = allocate_bytes(bytes);
    return memory ? memset(memory, 0, bytes) : NULL;
}

static void *reallocate_bytes(void *memory, size_t bytes) {
    if (!memory)
        return allocate_bytes(bytes);
    return host.allocate ? host.reallocate(host.context, memory, bytes) : realloc(memory, bytes);
}

static void release_bytes(void *memory) {
    if (!host.allocate)
        free(memory);
    else if (memory)
        host.release(host.context, memory);
}

/* ---- counting ---- */

static bool count_allocation(void) {
    atomic_fetch_add_explicit(&allocations, 1, memory_order_relaxed);
    return may_allocate();
}

uint64_t jox_alloc_count(void) {
    return atomic_load_explicit(&allocations, memory_order_relaxed);
}

void jox_alloc_fail_after(uint64_t count) {
    atomic_store(&remaining, count < INT64_MAX ? (int64_t)count : INT64_MAX);
    atomic_store(&limited, count != UINT64_MAX);
}

/* ---- recovery points ---- */

static _Thread_local JoxRecovery *innermost;

void jox_recovery_push(JoxRecovery *recovery) {
    recovery->outer = innermost;
    innermost = recovery;
}

void jox_recovery_pop(JoxRecovery *recovery) {
    if (innermost == recovery)
        innermost = recovery->outer;
}

bool jox_recovery_exists(void) {
    return innermost != NULL;
}

void jox_out_of_memory(size_t bytes) {
    JoxRecovery *recovery = innermost;
    if (!recovery) {
        fprintf(stderr, "jostle: out of memory (%zu bytes wanted)\n", bytes);
        abort();
    }
    innermost = recovery->outer;
    longjmp(recovery->jump, 1);
}

/* ---- blocks ---- */

static void link_block(JoxHeap *heap, JoxBlock *block) {
    block->heap = heap;
    if (!heap)
        return;
    pthread_mutex_lock(&heap->lock);
    block->next = heap->blocks.next;
    block->previous = &heap->blocks;
    block->next->previous = block;
    heap->blocks.next = block;
    pthread_mutex_unlock(&heap->lock);
}

static void unlink_block(JoxBlock *block) {
    JoxHeap *heap = block->heap;
    if (!heap)
        return;
    pthread_mutex_lock(&heap->lock);
    JOX_ASSERT(block->next->previous == block && block->previous->next == block);
    block->next->previous = block->previous;
    block->previous->next = block->next;
    pthread_mutex_unlock(&heap->lock);
    block->heap = NULL;
}

static JoxBlock *find_block_header(void *memory) {
    return (JoxBlock *)memory - 1;
}

/* Returns the size of `count` objects behind `before` bytes; an overflow counts as out of
   memory. */
static size_t compute_block_size(size_t count, size_t size, size_t before) {
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes) ||
        __builtin_add_overflow(bytes, before + 64, &bytes) || bytes > PTRDIFF_MAX)
        jox_out_of_memory(SIZE_MAX);
    return bytes - 64;
}

/* Writes the header of an allocation that begins at `start` (NULL: memory is out), so that the
   memory lies `offset` bytes behind it; returns the memory. */
static void *begin_block(char *start, size_t offset, size_t bytes) {
    if (!start)
        jox_out_of_memory(bytes);
    JoxBlock *block = find_block_header(start + offset);
    block->offset = offset;
    link_block(in_use, block);
    return block + 1;
}

void *jox_alloc(size_t count, size_t size) {
    size_t bytes = compute_block_size(count, size, sizeof(JoxBlock));
    return begin_block(count_allocation() ? allocate_zeroed_bytes(bytes) : NULL, sizeof(JoxBlock),
                       bytes);
}

void *jox_copy_array(const void *from, size_t count, size_t size) {
    void *copy = jox_alloc(count + 1, size);
    if (count)
        memcpy(copy, from, count * size);
    return copy;
}

void *jox_alloc_aligned(size_t count, size_t size) {
    const size_t bytes = compute_block_size(count, size, ALIGNMENT + sizeof(JoxBlock));
    char *start = count_allocation() ? allocate_zeroed_bytes(bytes) : NULL;
    const size_t past = ((uintptr_t)start + sizeof(JoxBlock)) % ALIGNMENT;
    return begin_block(start, sizeof(JoxBlock) + (ALIGNMENT - past) % ALIGNMENT, bytes);
}

void *jox_realloc(void *memory, size_t count, size_t size) {
    size_t bytes = compute_block_size(count, size, sizeof(JoxBlock));
    if (!memory)
        return begin_block(count_allocation() ? allocate_bytes(bytes) : NULL, sizeof(JoxBlock),
                           bytes);
    JoxBlock *block = find_block_header(memory);
    JoxHeap *heap = block->heap;
    JOX_ASSERT(block->offset == sizeof(JoxBlock));
    unlink_block(block);
    JoxBlock *moved = count_allocation() ? reallocate_bytes(block, bytes) : NULL;
    link_block(heap, moved ? moved : block); /* if memory is out, the old block stays */
    if (!moved)
        jox_out_of_memory(bytes);
    return moved + 1;
}

void jox_free(void *memory) {
    if (!memory)
        return;
    JoxBlock *block = find_block_header(memory);
    unlink_block(block);
    release_bytes((char *)memory - block->offset);
}

static inline uint64_t load_word(const uint8_t *memory) {
    uint64_t word;
    memcpy(&word, memory, sizeof word);
    return word;
}

/* jox_mem_is for short runs: compares words of 8 bytes; the last one may overlap the one before
   it. */
static inline bool is_short_run_of(const uint8_t *first, uint8_t byte, size_t bytes) {
    const uint64_t like = byte * 0x0101010101010101u;
    uint64_t other = 0;
    if (bytes >= sizeof like)
        other = load_word(first + bytes - sizeof like) ^ like;
    for (size_t k = 0; k + sizeof like < bytes; k += sizeof like)
        other |= load_word(first + k) ^ like;
    for (size_t k = 0; bytes < sizeof like && k < bytes; k++)
        other |= first[k] ^ byte;
    return other == 0;
}

enum { FEW = 64 }; /* bytes up to which the words are faster than a call of memcmp */

static bool is_long_run_of(const uint8_t *first, uint8_t byte, size_t bytes) {
    return *first == byte && memcmp(first, first + 1, bytes - 1) == 0;
}

bool jox_mem_is(const void *memory, uint8_t byte, size_t bytes) {
    return bytes <= FEW ? is_short_run_of(memory, byte, bytes)
                        : is_long_run_of(memory, byte, bytes);
}

/* Not inlined, so that calls for a few bytes need not save registers. */
static __attribute__((noinline)) void fill_long_run(void *memory, uint8_t byte, size_t bytes) {
    if (!is_long_run_of(memory, byte, bytes))
        memset(memory, byte, bytes);
}

void jox_mem_fill(void *memory, uint8_t byte, size_t bytes) {
    if (bytes > FEW)
        fill_long_run(memory, byte, bytes);
    else if (!is_short_run_of(memory, byte, bytes))
        memset(memory, byte, bytes);
}

void *jox_disown(void *memory) {
    if (memory)
        unlink_block(find_block_header(memory));
    return memory;
}

char *jox_strndup(const char *text, size_t length) {
    char *copy = jox_alloc(length + 1, 1);
    memcpy(copy, text, length);
    return copy;
}

char *jox_strdup(const char *text) {
    return text ? jox_strndup(text, strlen(text)) : NULL;
}

void *jox_try_realloc(void *memory, size_t bytes) {
    return may_allocate() ? reallocate_bytes(memory, bytes) : NULL;
}

void jox_give_back(void *memory) {
    release_bytes(memory);
}

void *jox_try_malloc(size_t bytes) {
    return may_allocate() ? malloc(bytes) : NULL;
}

/* ---- resources that heaps hold ---- */

typedef struct Held {
    struct Held *older;
    JoxHeap *heap;
    void *thing;
    JoxRelease *release;
} Held;

/* One list for all heaps: few resources are held at a time. */
static Held *newest;
static pthread_mutex_t held_lock = PTHREAD_MUTEX_INITIALIZER;

void *jox_heap_register(void *thing, JoxRelease *release) {
    JOX_ASSERT(thing && release);
    if (!in_use)
        return thing;
    Held *held = may_allocate() ? allocate_bytes(sizeof *held) : NULL;
    if (!held) {
        release(thing);
        jox_out_of_memory(sizeof *held);
    }
    pthread_mutex_lock(&held_lock);
    *held = (Held){newest, in_use, thing, release};
    newest = held;
    pthread_mutex_unlock(&held_lock);
    return thing;
}

/* Removes and returns the newest entry with this resource (NULL: any) and this heap (NULL: any). */
static Held *take_held(const void *thing, const JoxHeap *heap) {
    pthread_mutex_lock(&held_lock);
    Held **at = &newest;
    while (*at && ((thing && (*at)->thing != thing) || (heap && (*at)->heap != heap)))
        at = &(*at)->older;
    Held *held = *at;
    if (held)
        *at = held->older;
    pthread_mutex_unlock(&held_lock);
    return held;
}

void jox_heap_unregister(void *thing) {
    if (thing)
        release_bytes(take_held(thing, NULL));
}

/* ---- heaps ---- */

void jox_heap_begin(JoxHeap *heap) {
    *heap = (JoxHeap){0};
    pthread_mutex_init(&heap->lock, NULL);
    heap->blocks.next = heap->blocks.previous = &heap->blocks;
}

JoxHeap *jox_heap_create(void) {
    JoxHeap *heap = may_allocate() ? allocate_bytes(sizeof *heap) : NULL;
    if (heap)
        jox_heap_begin(heap);
    return heap;
}

void jox_heap_end(JoxHeap *heap) {
    JOX_ASSERT(jox_heap_has_failed(heap) || heap->blocks.next == &heap->blocks);
    for (Held *held; (held = take_held(NULL, heap));) {
        if (jox_heap_has_failed(heap))
            held->release(held->thing);
        release_bytes(held);
    }
    while (heap->blocks.next != &heap->blocks) {
        void *memory = heap->blocks.next + 1;
        if (jox_heap_has_failed(heap))
            jox_free(memory);
        else
            jox_disown(memory);
    }
    pthread_mutex_destroy(&heap->lock);
}

void jox_heap_free(JoxHeap *heap) {
    if (!heap)
        return;
    jox_heap_end(heap);
    release_bytes(heap);
}

JoxHeap *jox_heap_use(JoxHeap *heap) {
    JoxHeap *before = in_use;
    in_use = heap;
    return before;
}

JoxHeap *jox_heap_used(void) {
    return in_use;
}

void jox_heap_fail(JoxHeap *heap) {
    if (heap)
        __atomic_store_n(&heap->failed, true, __ATOMIC_RELEASE);
}

bool jox_heap_has_failed(const JoxHeap *heap) {
    return heap && __atomic_load_n(&heap->failed, __ATOMIC_ACQUIRE);
}
