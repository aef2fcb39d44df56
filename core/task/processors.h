/* How many processors the process may use. */
#ifndef JOX_TASK_PROCESSORS_H
#define JOX_TASK_PROCESSORS_H

#include <stdint.h>

/* Those that it may run on, but no more than the quotas of its control groups are worth; 1..64. */
uint32_t jox_processors(void);
/* What quotas allow, rounded up, by the process's list of control groups (as /proc/self/cgroup)
   and the folder where they are mounted; UINT32_MAX where none is set. */
uint32_t jox_processors_quota(const char *list, const char *root);

#endif
