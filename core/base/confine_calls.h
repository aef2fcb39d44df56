/* The filter of system calls (seccomp) of a confined process; called by confine.c. */
#ifndef JOX_BASE_CONFINE_CALLS_H
#define JOX_BASE_CONFINE_CALLS_H

#include "base/confine.h"

/* Installs the filter for a reader or a worker; false if the kernel refuses it. */
bool jox_confine_calls(const JoxConfines *confines);
/* Whether the kernel has filters of system calls. */
bool jox_confine_has_calls(void);

#endif
