/* Scratch memory that a stage of a step needs only while it works. All stages use the same block in
   turn, so that a crowd needs the largest stage's memory and not the sum of all, and the block
   stays in the processor's cache. Each stage calls begin, then takes its arrays. */
#ifndef JOX_TASK_STAGE_MEMORY_H
#define JOX_TASK_STAGE_MEMORY_H

#include <stddef.h>

/* Zero-initialise. */
typedef struct JoxStageMemory {
    char *block;           /* aligned to 64 bytes */
    size_t capacity, used; /* bytes */
} JoxStageMemory;

/* Returns how many bytes of the block `count` objects of `size` bytes take. */
size_t jox_stage_memory_bytes(size_t count, size_t size);
/* Begins a stage that takes at most `bytes` bytes. Pointers that earlier stages took become
   invalid. Call it on the stepping thread only. */
void jox_stage_memory_begin(JoxStageMemory *memory, size_t bytes);
/* Returns uninitialised memory for `count` objects of `size` bytes, aligned to 64 bytes, valid
   until the next stage begins. Call it on the stepping thread only. */
void *jox_stage_memory_take(JoxStageMemory *memory, size_t count, size_t size);
void jox_stage_memory_free(JoxStageMemory *memory);

#endif
