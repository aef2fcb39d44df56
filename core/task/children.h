/* Work done by child processes, several at once: a copy of this process each, whose memory, files
   and failures are its own. */
#ifndef JOX_TASK_CHILDREN_H
#define JOX_TASK_CHILDREN_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"

typedef struct JoxChildren JoxChildren;

/* At most so many at once, among which the memory is shared that this process may take yet. Those
   that run are ended with the heap that fails (mem.h), or with this process. Never NULL. */
JoxChildren *jox_children_create(uint32_t most);
/* Ends those that run. */
void jox_children_free(JoxChildren *children);
/* Whether one more may be started; how many run. */
bool jox_children_has_room(const JoxChildren *children);
uint32_t jox_children_count(const JoxChildren *children);

/* In the child: what it is to hand over goes to `result`. Memory that runs out ends it with status
   1. It calls nothing of what the parent has open but what it may share. */
typedef void JoxChildWork(void *context, uint64_t job, JoxText *result);
/* False with errno where the system starts no process. */
bool jox_children_start(JoxChildren *children, uint64_t job, JoxChildWork *work, void *context);

/* How a child ended. */
typedef struct JoxChildEnd {
    uint64_t job;
    bool good;      /* by itself, with its whole result */
    JoxText result; /* to be freed */
    char why[400];  /* of one that is not good: the signal or status, and the last that it wrote to
                       its standard error */
} JoxChildEnd;
/* Waits for a child to end, some tenths of a second at most; false if none did. */
bool jox_children_wait(JoxChildren *children, JoxChildEnd *end);

/* Does a work in one child and waits for it: what fails in it, as a library of the system that runs
   out of memory, ends the child alone. False with `why` where it did. Where the system starts no
   process, it is done here. */
bool jox_children_do(JoxChildWork *work, void *context, JoxText *result, JoxText *why);

#endif
