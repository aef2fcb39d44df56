/* Everything wrong with scenes, behaviours and folders of them. */
#ifndef JOX_VALIDATE_CHECK_H
#define JOX_VALIDATE_CHECK_H

#include <stddef.h>

#include "base/format/diag.h"

/* To be freed by jox_diag_free. */
JoxDiagnostics jox_check_paths(const char *const *paths, size_t count);

#endif
