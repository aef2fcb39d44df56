/* Memory of lists that chunks fill in parallel. */
#include "force/chunk_list.h"

#include "base/assert.h"
#include "base/mem.h"

void jox_chunk_memory_reserve(JoxChunkMemory *memory, size_t bytes) {
    if (bytes <= memory->capacity)
        return;
    /* No realloc: nothing has to be kept, and pages that are not written stay unused. */
    jox_free(memory->bytes);
    memory->bytes = jox_alloc(memory->capacity = bytes + bytes / 2, 1);
}

void jox_chunks_reserve(JoxChunkList *list, JoxChunkMemory *shared, uint32_t chunks, uint32_t room,
                        size_t size) {
    JoxChunkMemory *memory = shared ? shared : &list->own;
    const size_t need = (size_t)chunks * room * size;
    jox_chunk_memory_reserve(memory, need);
    list->items = memory->bytes;
    JOX_RESERVE(list->counts, list->chunk_capacity, chunks);
    list->room = room;
    JOX_ASSERT(!need || (list->items && memory->capacity >= need));
}

uint32_t jox_chunks_count(const JoxChunkList *list, uint32_t chunks) {
    uint32_t sum = 0;
    for (uint32_t c = 0; c < chunks; c++)
        sum += list->counts[c];
    return sum;
}

void jox_chunk_memory_free(JoxChunkMemory *memory) {
    jox_free(memory->bytes);
}

void jox_chunks_free(JoxChunkList *list) {
    jox_chunk_memory_free(&list->own);
    jox_free(list->counts);
}
