/* Lists that chunks of agents fill in parallel: chunk c owns the items from c * room on. Only the
   memory in use is touched. */
#ifndef JOX_FORCE_CHUNK_LIST_H
#define JOX_FORCE_CHUNK_LIST_H

#include <stddef.h>
#include <stdint.h>

enum {
    JOX_FORCE_GRAIN = 256 /* agents of a chunk */
};

/* Zero-initialise; it owns its arrays. */
typedef struct JoxChunkList {
    void *items;
    uint32_t *counts; /* per chunk */
    uint32_t room;    /* items per chunk */
    size_t capacity, chunk_capacity;
} JoxChunkList;

/* Makes room for `room` items of `size` bytes in every chunk, on the stepping thread; keeps none.
   The caller then empties each chunk's list before adding to it. */
void jox_chunks_reserve(JoxChunkList *list, uint32_t chunks, uint32_t room, size_t size);
static inline void jox_chunk_clear(JoxChunkList *list, uint32_t chunk) {
    list->counts[chunk] = 0;
}
/* Returns the number of items in all chunks. */
uint32_t jox_chunks_count(const JoxChunkList *list, uint32_t chunks);
void jox_chunks_free(JoxChunkList *list);

#endif
