/* Memory functions for Bullet. When memory is out, Bullet would go on with a null pointer. So
   its functions, which are global to the process, are replaced by ones that use malloc and,
   within a call of the engine, leave that call (base/mem.h) in place of returning NULL. The
   memory of a world whose heap has failed is freed here without Bullet, whose destructors expect
   complete objects. */
#include <pthread.h>
#include <stdlib.h>

#include "body/bullet.h"

/* Hash table of the blocks that Bullet allocated while a heap was in use; open addressing, its
   size is a power of two. */
struct Allocation {
    void *memory; /* NULL: free entry; &gone: its block was freed */
    JoxHeap *heap;
};
static Allocation *table;
static size_t capacity, used; /* used: entries that are not free, including those of freed blocks */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static char gone;

static size_t hash_address(const void *memory) {
    return (reinterpret_cast<uintptr_t>(memory) >> 4) * 0x9e3779b97f4a7c15u >> 20;
}

/* Stores an allocation in the first entry that is free or whose block was freed, as the same
   addresses come back again and again. Returns whether the entry was free. */
static bool insert_allocation(Allocation *to, size_t size, Allocation allocation) {
    size_t at = hash_address(allocation.memory) & (size - 1);
    while (to[at].memory && to[at].memory != &gone)
        at = (at + 1) & (size - 1);
    const bool was_free = !to[at].memory;
    to[at] = allocation;
    return was_free;
}

/* Makes room for one more entry, dropping those of freed blocks. False if memory is out. */
static bool grow_allocation_table() {
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
            insert_allocation(wider, size, table[i]);
    free(table);
    table = wider;
    capacity = size;
    used = live;
    JOX_ASSERT((capacity & (capacity - 1)) == 0 && 2 * (used + 1) <= capacity);
    return true;
}

static void *allocate_for_bullet(size_t bytes) {
    JoxHeap *heap = jox_heap_used();
    void *memory = jox_try_malloc(bytes);
    if (memory && heap) {
        pthread_mutex_lock(&lock);
        bool room = grow_allocation_table();
        if (room)
            used += insert_allocation(table, capacity, {memory, heap});
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

/* Frees a block. A block that is not in the table belongs to another part of the program, or was
   allocated without a heap. */
static void free_for_bullet(void *memory) {
    pthread_mutex_lock(&lock);
    size_t at = capacity ? hash_address(memory) & (capacity - 1) : 0;
    while (memory && capacity && table[at].memory && table[at].memory != memory)
        at = (at + 1) & (capacity - 1);
    if (memory && capacity && table[at].memory == memory)
        table[at] = {&gone, nullptr};
    pthread_mutex_unlock(&lock);
    free(memory);
}

static void install_bullet_allocator() {
    btAlignedAllocSetCustom(allocate_for_bullet, free_for_bullet);
}

/* Restores Bullet's own functions when the library is unloaded. */
__attribute__((destructor)) static void uninstall_bullet_allocator() {
    btAlignedAllocSetCustom(nullptr, nullptr);
}

void jox_bullet_use_memory() {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, install_bullet_allocator);
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

/* Removes the pairs in one pass; otherwise Bullet would search all pairs for each removed
   object. */
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
