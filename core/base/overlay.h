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
    struct JoxOverlay
        *tape; /* where what is read through it, but is not its own, is kept, or NULL */
    const struct JoxOverlay
        *under;  /* where what it has not is looked for before the disk, or NULL */
    bool sealed; /* what neither has is not read from the disk */
    void (*told)(void *context, const char *path, const char *text, size_t length);
    void *context; /* of `told`, which is told of each file that was read from the disk, or NULL */
} JoxOverlay;

/* Holds a copy of the text at a path, in place of what was there. */
void jox_overlay_put(JoxOverlay *overlay, const char *path, const char *text, size_t length);
const JoxOverlayFile *jox_overlay_find(const JoxOverlay *overlay, const char *path);
void jox_overlay_free(JoxOverlay *overlay);

/* The calling thread reads through it from here on (NULL: from the disk); returns the one before,
   which is to be put back. */
const JoxOverlay *jox_overlay_use(const JoxOverlay *overlay);
/* What was read: kept by the tape of the overlay in use, if it has one and has not the file itself.
 */
void jox_overlay_keep(const char *path, const char *text, size_t length, bool from_disk);
/* The file of the overlay in use, or of those under it, at a path, or NULL. */
const JoxOverlayFile *jox_overlay_file(const char *path);
/* Whether what is not in the overlay in use may be read from the disk. */
bool jox_overlay_opens(void);
/* Whether there is a regular file: in the overlay in use, or on the disk. */
bool jox_is_file(const char *path);

#endif
