/* Memory of lists that chunks fill in parallel. */
#include "force/chunk_list.h"

#include "base/assert.h"
#include "base/mem.h"

void jox_chunks_reserve(JoxChunkList *list, uint32_t chunks, uint32_t room, size_t size) {
    const size_t need = (size_t)chunks * room * size;
    if (need > list->capacity) {
        /* No realloc: nothing has to be kept, and pages that are not written stay unused. */
        jox_free(list->items);
        list->capacity = need + need / 2;
        list->items = jox_alloc(list->capacity, 1);
    }
    JOX_RESERVE(list->counts, list->chunk_capacity, chunks);
    list->room = room;
    JOX_ASSERT(!need || (list->items && list->capacity >= need));
}

uint32_t jox_chunks_count(const JoxChunkList *list, uint32_t chunks) {
    uint32_t sum = 0;
    for (uint32_t c = 0; c < chunks; c++)
        sum += list->counts[c];
    return sum;
}

void jox_chunks_free(JoxChunkList *list) {
    jox_free(list->items);
    jox_free(list->counts);
}
