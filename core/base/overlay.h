/* Files that are read from memory: while a thread uses an overlay, whatever it reads or looks for
   at one of its paths is what the overlay holds, and not what lies on the disk. */
#ifndef JOX_BASE_OVERLAY_H
#define JOX_BASE_OVERLAY_H

#include <stdbool.h>
#include <stddef.h>

typedef struct JoxOverlayFile {
    char *path, *text;
    size_t length;
} JoxOverlayFile;

/* Zero-initialise. */
typedef struct JoxOverlay {
    JoxOverlayFile *files;
    size_t count, capacity;
    struct JoxOverlay *tape; /* where what is read from the disk through it is kept, or NULL */
} JoxOverlay;

/* Holds a copy of the text at a path, in place of what was there. */
void jox_overlay_put(JoxOverlay *overlay, const char *path, const char *text, size_t length);
const JoxOverlayFile *jox_overlay_find(const JoxOverlay *overlay, const char *path);
void jox_overlay_free(JoxOverlay *overlay);

/* The calling thread reads through it from here on (NULL: from the disk); returns the one before,
   which is to be put back. */
const JoxOverlay *jox_overlay_use(const JoxOverlay *overlay);
/* What was read from the disk: kept by the tape of the overlay in use, if it has one. */
void jox_overlay_keep(const char *path, const char *text, size_t length);
/* The file of the overlay in use at a path, or NULL. */
const JoxOverlayFile *jox_overlay_file(const char *path);
/* Whether there is a regular file: in the overlay in use, or on the disk. */
bool jox_is_file(const char *path);

#endif
