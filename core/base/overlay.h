/* Files that are read from memory: while a thread uses an overlay, reads of a path that it holds
   get the overlay's text in place of the file on the disk. Scenes are loaded through overlays from
   checkpoints and from texts that a confined process has read. */
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
    struct JoxOverlay *tape;        /* keeps copies of files read elsewhere; or NULL */
    const struct JoxOverlay *under; /* searched next, before the disk; or NULL */
    bool sealed;                    /* the disk is not read at all */
    /* Called with each file that was read from the disk; or NULL. */
    void (*told)(void *context, const char *path, const char *text, size_t length);
    void *context; /* passed to `told` */
} JoxOverlay;

/* Stores a copy of a text at a path, in place of the one before. */
void jox_overlay_put(JoxOverlay *overlay, const char *path, const char *text, size_t length);
/* Forgets the text of a path, so that the file is read from elsewhere again. */
void jox_overlay_remove(JoxOverlay *overlay, const char *path);
/* Returns the file that this overlay itself holds at a path, or NULL. */
const JoxOverlayFile *jox_overlay_find(const JoxOverlay *overlay, const char *path);
void jox_overlay_free(JoxOverlay *overlay);

/* Sets the overlay that the calling thread reads through (NULL: the disk alone); returns the one
   before, for the caller to restore. */
const JoxOverlay *jox_overlay_use(const JoxOverlay *overlay);
/* Called by readers after each file: copies it to the tape of the overlay in use, unless the
   overlay holds it itself, and calls `told` if it was read from the disk. */
void jox_overlay_keep(const char *path, const char *text, size_t length, bool from_disk);
/* Returns the file at a path in the overlay in use or in those under it, or NULL. */
const JoxOverlayFile *jox_overlay_file(const char *path);
/* Whether files that the overlay in use lacks may be read from the disk. */
bool jox_overlay_opens(void);
/* Whether a path is a regular file, in the overlay in use or on the disk. */
bool jox_is_file(const char *path);

#endif
