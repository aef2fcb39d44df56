/* Memory that a stage of a step needs only while it works. All stages take theirs from the same
   block, one after the other, so that a crowd needs what the greediest stage takes, and not what
   all take together; and what was just read and written is still in the processor's cache. */
#ifndef JOX_TASK_STAGE_MEMORY_H
#define JOX_TASK_STAGE_MEMORY_H

#include <stddef.h>

/* Zero-initialise. */
typedef struct JoxStageMemory {
    char *block; /* aligned to 64 bytes */
    size_t capacity, used;
} JoxStageMemory;

/* What taking `count` objects of `size` bytes needs, bytes. */
size_t jox_stage_memory_bytes(size_t count, size_t size);
/* A stage begins, on the stepping thread, which takes so many bytes at most: nothing that was taken
   before is there any more. */
void jox_stage_memory_begin(JoxStageMemory *memory, size_t bytes);
/* `count` objects of `size` bytes, aligned to 64 bytes, with any contents, until the next stage
   begins. On the stepping thread. */
void *jox_stage_memory_take(JoxStageMemory *memory, size_t count, size_t size);
void jox_stage_memory_free(JoxStageMemory *memory);

#endif
