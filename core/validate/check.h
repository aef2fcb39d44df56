/* Static checks of scenes, behaviours, claims and mods (check.c). */
#ifndef JOX_VALIDATE_CHECK_H
#define JOX_VALIDATE_CHECK_H

#include <stddef.h>

#include "base/format/diag.h"

/* Diagnostic codes of files and folders that could not be read. */
#define JOX_CHECK_UNREADABLE "unreadable-file"
#define JOX_CHECK_UNREAD "unread-folder"

/* Checks files, and folders with all that is in them, and returns the diagnostics, which the
   caller frees with jox_diag_free. */
JoxDiagnostics jox_check_paths(const char *const *paths, size_t count);

#endif
