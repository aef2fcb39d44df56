/* A process that gives up what it does not need, before it reads what a stranger wrote. It cannot
   take anything back, nor can what it starts. */
#ifndef JOX_BASE_CONFINE_H
#define JOX_BASE_CONFINE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct JoxConfines {
    const char *const *folders; /* with all below them, or files: may be read, if they are there */
    size_t folder_count;
    size_t memory;    /* bytes that it may take besides what it has; 0: any */
    size_t file_size; /* bytes of a file that it writes; 0: any */
    unsigned files;   /* that it has open at a time; 0: any of who works, else 64 */
    /* Of processor time; 0: any. Then it is ended; who works is told by SIGXCPU, and ended a little
       later. */
    unsigned seconds;
    /* Who works has threads, and calls that do not reach beyond itself and its files. Without, it
       reads, and writes to what is open. */
    bool works;
    bool programs;       /* who works starts programs of the system, which are confined as it is */
    const char *program; /* one more that it starts, by its path, and may end; or NULL */
    bool serves;         /* who works answers those who connect to it, and connects to nobody */
    const char *const *outputs; /* of who works: folders, with all below them, or files */
    size_t output_count;
} JoxConfines;

/* What this kernel can hold a process to. */
typedef struct JoxConfining {
    bool files; /* Landlock: only the folders are read, and only the outputs written */
    bool calls; /* seccomp: no network and no other processes but those that are granted */
} JoxConfining;
JoxConfining jox_confine_can(void);

/* From here on the calling thread, which is to be the only one of its process, can do no more than
   that. False, and some of it may hold, where the kernel refuses what it has. A forbidden call
   fails; starting a program ends the process by SIGSYS, and so does a socket of who does not work.
   What lies beneath an output may be made, changed and removed. */
bool jox_confine(const JoxConfines *confines);

/* Of these the limits alone: memory, processor time, sizes and numbers of files. */
bool jox_confine_limits(const JoxConfines *confines);

/* Bytes that this process may take yet by its limit of memory, 1 at least; 0: it has none. */
size_t jox_confine_memory_left(void);

#endif
