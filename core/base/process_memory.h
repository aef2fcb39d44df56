/* Memory that this process uses, as the system counts it. */
#ifndef JOX_BASE_PROCESS_MEMORY_H
#define JOX_BASE_PROCESS_MEMORY_H

#include <stdint.h>

/* Bytes; both are 0 where the system does not tell. */
typedef struct JoxProcessMemory {
    uint64_t addresses; /* address space, also where no page is in use */
    uint64_t resident;  /* pages in use */
} JoxProcessMemory;

/* Reads them from /proc, which a confined process must be allowed to read. */
JoxProcessMemory jox_read_process_memory(void);

#endif
