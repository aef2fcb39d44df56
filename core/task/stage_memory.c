#include "task/stage_memory.h"

#include <stdint.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"

enum { ALIGNMENT = 64 };

size_t jox_stage_memory_bytes(size_t count, size_t size) {
    JOX_ASSERT(size && count <= (SIZE_MAX - ALIGNMENT) / size);
    return (count * size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

/* Overwrites the block in checked builds, so that reading memory of an earlier stage gives
   nonsense. */
static void poison_block(JoxStageMemory *m) {
    if (m->used)
        memset(m->block, 0xa5, m->used);
}

void jox_stage_memory_begin(JoxStageMemory *m, size_t bytes) {
    JOX_CHECK(poison_block(m));
    m->used = 0;
    if (bytes <= m->capacity)
        return;
    jox_stage_memory_free(m);
    m->block = jox_alloc_aligned(bytes + bytes / 4, 1);
    m->capacity = bytes + bytes / 4;
}

void *jox_stage_memory_take(JoxStageMemory *m, size_t count, size_t size) {
    char *taken = m->block + m->used;
    m->used += jox_stage_memory_bytes(count, size);
    JOX_ASSERT(m->used <= m->capacity);
    return taken;
}

void jox_stage_memory_free(JoxStageMemory *m) {
    jox_free(m->block);
    *m = (JoxStageMemory){0};
}
