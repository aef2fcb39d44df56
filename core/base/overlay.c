#include "base/overlay.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "base/mem.h"
#include "base/zip.h"

static _Thread_local const JoxOverlay *used; /* the thread's overlay in use, or NULL */

const JoxOverlayFile *jox_overlay_find(const JoxOverlay *overlay, const char *path) {
    for (size_t f = 0; overlay && f < overlay->count; f++)
        if (strcmp(overlay->files[f].path, path) == 0)
            return &overlay->files[f];
    return NULL;
}

void jox_overlay_put(JoxOverlay *overlay, const char *path, const char *text, size_t length) {
    JoxOverlayFile *file = (JoxOverlayFile *)jox_overlay_find(overlay, path);
    if (!file) {
        JOX_RESERVE(overlay->files, overlay->capacity, overlay->count + 1);
        file = &overlay->files[overlay->count++];
        *file = (JoxOverlayFile){.path = jox_strdup(path)};
    }
    jox_free(file->text);
    file->text = jox_strndup(text, length);
    file->length = length;
}

void jox_overlay_remove(JoxOverlay *overlay, const char *path) {
    JoxOverlayFile *file = (JoxOverlayFile *)jox_overlay_find(overlay, path);
    if (!file)
        return;
    jox_free(file->path);
    jox_free(file->text);
    *file = overlay->files[--overlay->count];
}

void jox_overlay_free(JoxOverlay *overlay) {
    for (size_t f = 0; f < overlay->count; f++) {
        jox_free(overlay->files[f].path);
        jox_free(overlay->files[f].text);
    }
    jox_free(overlay->files);
    *overlay = (JoxOverlay){0};
}

const JoxOverlay *jox_overlay_use(const JoxOverlay *overlay) {
    const JoxOverlay *before = used;
    used = overlay;
    return before;
}

void jox_overlay_keep(const char *path, const char *text, size_t length, bool from_disk) {
    if (used && used->tape && !jox_overlay_find(used, path))
        jox_overlay_put(used->tape, path, text, length);
    for (const JoxOverlay *o = used; o && from_disk; o = o->under)
        if (o->told)
            o->told(o->context, path, text, length);
}

const JoxOverlayFile *jox_overlay_file(const char *path) {
    const JoxOverlayFile *file = NULL;
    for (const JoxOverlay *o = used; o && !file; o = o->under)
        file = jox_overlay_find(o, path);
    return file;
}

bool jox_overlay_opens(void) {
    const JoxOverlay *o = used;
    while (o && !o->sealed)
        o = o->under;
    return !o;
}

bool jox_is_file(const char *path) {
    struct stat info;
    if (jox_overlay_file(path))
        return true;
    return stat(path, &info) == 0 ? S_ISREG(info.st_mode)
                                  : errno == ENOTDIR && jox_zip_is_file(path);
}
