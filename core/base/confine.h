/* Sandboxing of the calling process by Landlock, seccomp and resource limits, before it reads files
   of strangers. It cannot be undone, and programs that the process starts inherit it.

   There are two kinds of process. A reader (`works` false) parses files: it has no threads and no
   network, and writes only to descriptors that are open. A worker (`works` true) runs simulations:
   it may have threads and write its outputs. */
#ifndef JOX_BASE_CONFINE_H
#define JOX_BASE_CONFINE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct JoxConfines {
    const char *const *folders; /* files, or folders with all below them, that may be read */
    size_t folder_count;
    size_t memory;    /* bytes that it may allocate in addition to those in use; 0: no limit */
    size_t file_size; /* greatest size of a file that it writes, bytes; 0: no limit */
    unsigned files;   /* files open at a time; 0: no limit for a worker, 64 for a reader */
    /* Processor time, s; 0: no limit. Then the process is killed. A worker gets SIGXCPU, and is
       killed a few seconds later, so that it can say why it ends. */
    unsigned seconds;
    bool works;                 /* a worker; false: a reader. The members below are for workers */
    bool programs;              /* may start programs of the system, which inherit the sandbox */
    const char *program;        /* path of one more program that it may start and end; or NULL */
    bool serves;                /* may accept connections, but never connect */
    const char *const *outputs; /* files, or folders with all below them, that may be written */
    size_t output_count;
} JoxConfines;

/* The mechanisms that this kernel has. */
typedef struct JoxConfining {
    bool files; /* Landlock: only `folders` can be read, and only `outputs` written */
    bool calls; /* seccomp: no network and no other processes except those that are granted */
} JoxConfining;
JoxConfining jox_confine_can(void);

/* Confines the calling thread, which must be the only one of its process. Afterwards a forbidden
   call fails, but starting a program kills the process by SIGSYS, and so does a reader's call of
   socket. Files beneath an output may be made, changed and removed. Mechanisms that the kernel
   lacks are left out (jox_confine_can). False if one that it has was refused; the others may hold
   then. */
bool jox_confine(const JoxConfines *confines);

/* Sets the limits alone: memory, processor time, size and number of files. */
bool jox_confine_limits(const JoxConfines *confines);

/* Bytes that this process can still allocate below its memory limit, at least 1; 0: no limit. */
size_t jox_confine_memory_left(void);

#endif
