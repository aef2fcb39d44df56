/* Child processes that work in parallel: each is a fork of this process, so its memory, its files
   and its crashes stay its own. Sweeps run each simulation in one; reports call the drawing program
   in one. */
#ifndef JOX_TASK_CHILDREN_H
#define JOX_TASK_CHILDREN_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"

typedef struct JoxChildren JoxChildren;

/* Creates a set of at most `most` children that run at once. The memory that this process may still
   allocate is divided among them. Children that run are killed when the heap that owns the set
   fails (base/mem.h), and when this process ends. Never NULL. */
JoxChildren *jox_children_create(uint32_t most);
/* Kills the children that run, and frees the set. NULL is fine. */
void jox_children_free(JoxChildren *children);
/* Returns whether one more child may be started, and how many run. */
bool jox_children_has_room(const JoxChildren *children);
uint32_t jox_children_count(const JoxChildren *children);

/* Runs in the child. What it appends to `result` is handed to the parent. When memory runs out, the
   child ends with status 99. It must not use the parent's open files and databases, unless they may
   be shared by processes. */
typedef void JoxChildWork(void *context, uint64_t job, JoxText *result);
/* Forks a child that runs `work` for the number `job`. Requires jox_children_has_room. Returns
   false with errno when the system starts no process. */
bool jox_children_start(JoxChildren *children, uint64_t job, JoxChildWork *work, void *context);

/* Says how a child ended. */
typedef struct JoxChildEnd {
    uint64_t job;
    bool good;      /* exited with status 0, after its whole result was written */
    bool killed;    /* ended by SIGKILL, as by a system that runs out of memory */
    JoxText result; /* owned by the caller; empty unless good */
    char why[400];  /* if not good: signal or status, and the end of its standard error */
} JoxChildEnd;
/* Waits at most 0.2 s for a child to end. Returns false if none did, or if a signal interrupted the
   wait. */
bool jox_children_wait(JoxChildren *children, JoxChildEnd *end);

/* Runs `work` in one child and waits for it, so that a crash in it, such as a system library that
   runs out of memory, ends the child alone. Returns false with `why` if the child failed. If the
   system starts no process, the work runs in this one. */
bool jox_children_do(JoxChildWork *work, void *context, JoxText *result, JoxText *why);

#endif
