/* A process that gives up what it does not need, before it reads what a stranger wrote. It cannot
   take anything back, nor can what it starts. */
#ifndef JOX_BASE_CONFINE_H
#define JOX_BASE_CONFINE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct JoxConfines {
    const char *const *folders; /* with all below them, or files: may be read, if they are there */
    size_t folder_count;
    size_t memory;    /* bytes that it may take besides what it has */
    unsigned seconds; /* of processor time */
} JoxConfines;

/* What this kernel can hold a process to. */
typedef struct JoxConfining {
    bool files; /* Landlock: only the folders are read */
    bool calls; /* seccomp: no network, no other processes, nothing is written but open files */
} JoxConfining;
JoxConfining jox_confine_can(void);

/* From here on the calling thread, which is to be the only one of its process, can do no more than
   that. False, and some of it may hold, where the kernel refuses what it has. A forbidden call
   fails; starting a program or opening a socket ends the process by SIGSYS. */
bool jox_confine(const JoxConfines *confines);

#endif
