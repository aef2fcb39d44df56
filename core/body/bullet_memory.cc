/* Bullet's allocations: where memory is out, Bullet would go on with a null pointer. So its
   functions for memory, which are the process's, are replaced by ones that give what malloc gives
   and, within a call of ours, do not return without it. What a world allocated before belongs to a
   heap that has failed: it is freed without Bullet, whose destructors expect whole objects. */
#include <pthread.h>
#include <stdlib.h>

#include "body/bullet.h"

/* What Bullet allocated while a heap was in use; open addressing, a power of two. */
struct Allocation {
    void *memory; /* NULL: free; GONE: was freed */
    JoxHeap *heap;
};
static Allocation *table;
static size_t capacity, used; /* used: with those that are gone */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static char gone;

static size_t place_of(const void *memory) {
    return (reinterpret_cast<uintptr_t>(memory) >> 4) * 0x9e3779b97f4a7c15u >> 20;
}

/* Takes the first place that is free or whose memory is gone: the same addresses come back again
   and again. Returns whether it was free. */
static bool put(Allocation *to, size_t size, Allocation allocation) {
    size_t at = place_of(allocation.memory) & (size - 1);
    while (to[at].memory && to[at].memory != &gone)
        at = (at + 1) & (size - 1);
    const bool was_free = !to[at].memory;
    to[at] = allocation;
    return was_free;
}

/* Room for one more, without those that are gone. */
static bool grow() {
    if (2 * (used + 1) <= capacity)
        return true;
    size_t live = 0;
    for (size_t i = 0; i < capacity; i++)
        live += table[i].memory && table[i].memory != &gone;
    size_t size = 1024;
    while (size < 4 * (live + 1))
        size *= 2;
    Allocation *wider = static_cast<Allocation *>(jox_try_malloc(size * sizeof *wider));
    if (!wider)
        return false;
    memset(wider, 0, size * sizeof *wider);
    for (size_t i = 0; i < capacity; i++)
        if (table[i].memory && table[i].memory != &gone)
            put(wider, size, table[i]);
    free(table);
    table = wider;
    capacity = size;
    used = live;
    JOX_ASSERT((capacity & (capacity - 1)) == 0 && 2 * (used + 1) <= capacity);
    return true;
}

static void *allocate(size_t bytes) {
    JoxHeap *heap = jox_heap_used();
    void *memory = jox_try_malloc(bytes);
    if (memory && heap) {
        pthread_mutex_lock(&lock);
        bool room = grow();
        if (room)
            used += put(table, capacity, {memory, heap});
        pthread_mutex_unlock(&lock);
        if (!room) {
            free(memory);
            memory = nullptr;
        }
    }
    if (!memory && jox_recovery_exists())
        jox_out_of_memory(bytes);
    return memory;
}

/* Memory of which nothing is known is another program's part, or was allocated without a heap. */
static void release(void *memory) {
    pthread_mutex_lock(&lock);
    size_t at = capacity ? place_of(memory) & (capacity - 1) : 0;
    while (memory && capacity && table[at].memory && table[at].memory != memory)
        at = (at + 1) & (capacity - 1);
    if (memory && capacity && table[at].memory == memory)
        table[at] = {&gone, nullptr};
    pthread_mutex_unlock(&lock);
    free(memory);
}

static void install() {
    btAlignedAllocSetCustom(allocate, release);
}

/* A library that is unloaded leaves Bullet as it was. */
__attribute__((destructor)) static void restore() {
    btAlignedAllocSetCustom(nullptr, nullptr);
}

void jox_bullet_use_memory() {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, install);
}

void jox_bullet_free_heap(const JoxHeap *heap) {
    pthread_mutex_lock(&lock);
    for (size_t i = 0; i < capacity; i++)
        if (table[i].memory && table[i].memory != &gone && table[i].heap == heap) {
            free(table[i].memory);
            table[i] = {&gone, nullptr};
        }
    pthread_mutex_unlock(&lock);
}

bool jox_bodies_are_heaped(const JoxBodies *b, JoxText *error) {
    const int pairs = b->broadphase->getOverlappingPairCache()->getNumOverlappingPairs();
    if (pairs <= 50000 + 32 * int(b->live))
        return false;
    if (error)
        jox_text_printf(
            error,
            "with this body, %d pairs of bodies lie in each other, which would take too "
            "much memory: move them apart",
            pairs);
    return true;
}

/* In one pass; as each object is removed Bullet would search all pairs for its own. */
void jox_bodies_remove_pairs(JoxBodies *b) {
    btOverlappingPairCache *pairs = b->broadphase->getOverlappingPairCache();
    for (int n = pairs->getNumOverlappingPairs(); n > 0; n = pairs->getNumOverlappingPairs()) {
        const btBroadphasePair &last = pairs->getOverlappingPairArray()[n - 1];
        pairs->removeOverlappingPair(last.m_pProxy0, last.m_pProxy1, b->dispatcher);
    }
}

void JoxBulletWorld::release_predictions() {
    for (int m = 0; m < m_predictiveManifolds.size(); m++)
        getDispatcher()->releaseManifold(m_predictiveManifolds[m]);
    m_predictiveManifolds.clear();
}

void JoxBulletWorld::remove(btRigidBody *body) {
    for (int m = m_predictiveManifolds.size() - 1; m >= 0; m--) {
        btPersistentManifold *manifold = m_predictiveManifolds[m];
        if (manifold->getBody0() != body && manifold->getBody1() != body)
            continue;
        m_predictiveManifolds.removeAtIndex(m);
        getDispatcher()->releaseManifold(manifold);
    }
    removeRigidBody(body);
}
