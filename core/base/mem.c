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
static atomic_bool limited;           /* for tests: memory is out, */
static atomic_int_fast64_t remaining; /* after so many more allocations */
static _Thread_local JoxHeap *in_use;

_Static_assert(sizeof(JoxBlock) % 16 == 0, "memory behind a block is aligned as malloc aligns it");

static bool may_allocate(void) {
    return !atomic_load_explicit(&limited, memory_order_relaxed) ||
           atomic_fetch_sub_explicit(&remaining, 1, memory_order_relaxed) > 0;
}

/* ---- where memory comes from ---- */

static JoAllocator host; /* its functions are NULL: the C library's */
static atomic_bool begun;

bool jox_set_allocator(const JoAllocator *allocator) {
    if (atomic_load(&begun))
        return false;
    host = allocator ? *allocator : (JoAllocator){0};
    return true;
}

static void *get(size_t bytes) {
    if (!atomic_load_explicit(&begun, memory_order_relaxed))
        atomic_store(&begun, true);
    return host.allocate ? host.allocate(host.context, bytes) : malloc(bytes);
}

/* Pages that calloc has from the system are zero without being touched. */
static void *get_zeroed(size_t bytes) {
    if (!host.allocate) {
        atomic_store_explicit(&begun, true, memory_order_relaxed);
        return calloc(1, bytes);
    }
    void *memory = get(bytes);
    return memory ? memset(memory, 0, bytes) : NULL;
}

static void *resize(void *memory, size_t bytes) {
    if (!memory)
        return get(bytes);
    return host.allocate ? host.reallocate(host.context, memory, bytes) : realloc(memory, bytes);
}

static void give_back(void *memory) {
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

static JoxBlock *block_of(void *memory) {
    return (JoxBlock *)memory - 1;
}

/* Bytes of `count` objects and of what stands before them; does not return where that overflows. */
static size_t total(size_t count, size_t size, size_t before) {
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes) ||
        __builtin_add_overflow(bytes, before + 64, &bytes) || bytes > PTRDIFF_MAX)
        jox_out_of_memory(SIZE_MAX);
    return bytes - 64;
}

/* Puts the block behind `start`, which malloc gave, and returns the memory behind the block. */
static void *begin_block(char *start, size_t offset, size_t bytes) {
    if (!start)
        jox_out_of_memory(bytes);
    JoxBlock *block = block_of(start + offset);
    block->offset = offset;
    link_block(in_use, block);
    return block + 1;
}

void *jox_alloc(size_t count, size_t size) {
    size_t bytes = total(count, size, sizeof(JoxBlock));
    return begin_block(count_allocation() ? get_zeroed(bytes) : NULL, sizeof(JoxBlock), bytes);
}

void *jox_alloc_aligned(size_t count, size_t size) {
    const size_t bytes = total(count, size, ALIGNMENT + sizeof(JoxBlock));
    char *start = count_allocation() ? get_zeroed(bytes) : NULL;
    const size_t past = ((uintptr_t)start + sizeof(JoxBlock)) % ALIGNMENT;
    return begin_block(start, sizeof(JoxBlock) + (ALIGNMENT - past) % ALIGNMENT, bytes);
}

void *jox_realloc(void *memory, size_t count, size_t size) {
    size_t bytes = total(count, size, sizeof(JoxBlock));
    if (!memory)
        return begin_block(count_allocation() ? get(bytes) : NULL, sizeof(JoxBlock), bytes);
    JoxBlock *block = block_of(memory);
    JoxHeap *heap = block->heap;
    JOX_ASSERT(block->offset == sizeof(JoxBlock));
    unlink_block(block);
    JoxBlock *moved = count_allocation() ? resize(block, bytes) : NULL;
    link_block(heap, moved ? moved : block); /* where memory is out, the old one stays */
    if (!moved)
        jox_out_of_memory(bytes);
    return moved + 1;
}

void jox_free(void *memory) {
    if (!memory)
        return;
    JoxBlock *block = block_of(memory);
    unlink_block(block);
    give_back((char *)memory - block->offset);
}

static inline uint64_t word_at(const uint8_t *memory) {
    uint64_t word;
    memcpy(&word, memory, sizeof word);
    return word;
}

/* Whether a few bytes are all the same as one: by words, of which the last may reach into the one
   before it. */
static inline bool are_few(const uint8_t *first, uint8_t byte, size_t bytes) {
    const uint64_t like = byte * 0x0101010101010101u;
    uint64_t other = 0;
    if (bytes >= sizeof like)
        other = word_at(first + bytes - sizeof like) ^ like;
    for (size_t k = 0; k + sizeof like < bytes; k += sizeof like)
        other |= word_at(first + k) ^ like;
    for (size_t k = 0; bytes < sizeof like && k < bytes; k++)
        other |= first[k] ^ byte;
    return other == 0;
}

enum { FEW = 64 }; /* bytes, for which a call of memcmp takes longer */

static bool are_many(const uint8_t *first, uint8_t byte, size_t bytes) {
    return *first == byte && memcmp(first, first + 1, bytes - 1) == 0;
}

bool jox_mem_is(const void *memory, uint8_t byte, size_t bytes) {
    return bytes <= FEW ? are_few(memory, byte, bytes) : are_many(memory, byte, bytes);
}

/* Apart, so that a call for a few bytes keeps no registers for this one. */
static __attribute__((noinline)) void fill_many(void *memory, uint8_t byte, size_t bytes) {
    if (!are_many(memory, byte, bytes))
        memset(memory, byte, bytes);
}

void jox_mem_fill(void *memory, uint8_t byte, size_t bytes) {
    if (bytes > FEW)
        fill_many(memory, byte, bytes);
    else if (!are_few(memory, byte, bytes))
        memset(memory, byte, bytes);
}

void *jox_disown(void *memory) {
    if (memory)
        unlink_block(block_of(memory));
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
    return may_allocate() ? resize(memory, bytes) : NULL;
}

void jox_give_back(void *memory) {
    give_back(memory);
}

void *jox_try_malloc(size_t bytes) {
    return may_allocate() ? malloc(bytes) : NULL;
}

/* ---- what heaps hold ---- */

typedef struct Held {
    struct Held *older;
    JoxHeap *heap;
    void *thing;
    JoxRelease *release;
} Held;

/* Of all heaps: few things are held at once. */
static Held *newest;
static pthread_mutex_t held_lock = PTHREAD_MUTEX_INITIALIZER;

void *jox_hold(void *thing, JoxRelease *release) {
    JOX_ASSERT(thing && release);
    if (!in_use)
        return thing;
    Held *held = may_allocate() ? get(sizeof *held) : NULL;
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

/* Takes the newest off the list that is this thing (NULL: any) and, unless NULL, of this heap. */
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

void jox_let_go(void *thing) {
    if (thing)
        give_back(take_held(thing, NULL));
}

/* ---- heaps ---- */

void jox_heap_begin(JoxHeap *heap) {
    *heap = (JoxHeap){0};
    pthread_mutex_init(&heap->lock, NULL);
    heap->blocks.next = heap->blocks.previous = &heap->blocks;
}

JoxHeap *jox_heap_create(void) {
    JoxHeap *heap = may_allocate() ? get(sizeof *heap) : NULL;
    if (heap)
        jox_heap_begin(heap);
    return heap;
}

void jox_heap_end(JoxHeap *heap) {
    JOX_ASSERT(jox_heap_has_failed(heap) || heap->blocks.next == &heap->blocks);
    for (Held *held; (held = take_held(NULL, heap));) {
        if (jox_heap_has_failed(heap))
            held->release(held->thing);
        give_back(held);
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
    give_back(heap);
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
