#ifndef JOX_BASE_CONFINE_CALLS_H
#define JOX_BASE_CONFINE_CALLS_H

#include "base/confine.h"

/* From here on only the calls that these confines have. */
bool jox_confine_calls(const JoxConfines *confines);
/* Whether the kernel can hold a process to them. */
bool jox_confine_has_calls(void);

#endif
