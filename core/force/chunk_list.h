/* Lists that chunks of agents fill in parallel. Either chunk c owns the items from c * room on; or
   each chunk's list is split into runs, and the first runs of all chunks are stored together, then
   the second ones, and so on, so that few pages are written where chunks have few items. Only the
   memory in use is touched. */
#ifndef JOX_FORCE_CHUNK_LIST_H
#define JOX_FORCE_CHUNK_LIST_H

#include <stddef.h>
#include <stdint.h>

enum {
    JOX_FORCE_GRAIN = 256 /* agents of a chunk */
};

/* Memory of the items of one list, or of several that are in use one after the other.
   Zero-initialise. */
typedef struct JoxChunkMemory {
    void *bytes;
    size_t capacity;
} JoxChunkMemory;

/* Zero-initialise; it owns its arrays, except items in shared memory. */
typedef struct JoxChunkList {
    void *items;
    uint32_t *counts; /* per chunk */
    uint32_t room;    /* items per chunk */
    size_t chunk_capacity;
    JoxChunkMemory own;
} JoxChunkList;

/* Makes room for so many bytes; keeps none. */
void jox_chunk_memory_reserve(JoxChunkMemory *memory, size_t bytes);
/* Makes room for `room` items of `size` bytes in every chunk, on the stepping thread; keeps none,
   nor those of other lists in `shared` memory (NULL: the list's own). The caller then empties each
   chunk's list before adding to it. */
void jox_chunks_reserve(JoxChunkList *list, JoxChunkMemory *shared, uint32_t chunks, uint32_t room,
                        size_t size);
/* Returns the place in `items` of item n of a chunk, in runs of `length` items. */
static inline size_t jox_chunk_run_place(uint32_t chunks, uint32_t chunk, uint32_t n,
                                         uint32_t length) {
    return ((size_t)(n / length) * chunks + chunk) * length + n % length;
}
static inline void jox_chunk_clear(JoxChunkList *list, uint32_t chunk) {
    list->counts[chunk] = 0;
}
/* Returns the number of items in all chunks. */
uint32_t jox_chunks_count(const JoxChunkList *list, uint32_t chunks);
void jox_chunks_free(JoxChunkList *list);
void jox_chunk_memory_free(JoxChunkMemory *memory);

#endif
