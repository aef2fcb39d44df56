/* Everything wrong with scenes, behaviours and folders of them. */
#ifndef JOX_VALIDATE_CHECK_H
#define JOX_VALIDATE_CHECK_H

#include <stddef.h>

#include "base/format/diag.h"

/* Codes of a file, and of a folder, that nobody could look at. */
#define JOX_CHECK_UNREADABLE "unreadable-file"
#define JOX_CHECK_UNREAD "unread-folder"

/* To be freed by jox_diag_free. */
JoxDiagnostics jox_check_paths(const char *const *paths, size_t count);

#endif
