/* The number of processors that this process may use, for the default number of threads and
   children. */
#ifndef JOX_TASK_PROCESSORS_H
#define JOX_TASK_PROCESSORS_H

#include <stdint.h>

/* Returns how many processors the process is allowed on, limited by the CPU quotas of its control
   groups; 1..64. */
uint32_t jox_count_processors(void);
/* Returns how many processors the CPU quotas of control groups allow, rounded up; UINT32_MAX if
   none is set. `list` is the path of the process's list of groups (as /proc/self/cgroup), `root`
   the folder where they are mounted. */
uint32_t jox_processors_quota(const char *list, const char *root);

#endif
