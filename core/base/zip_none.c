/* Stands for zip_libzip.c in builds without libzip: no archive is read. */
#include <errno.h>

#include "base/mem.h"
#include "base/zip.h"

char *jox_zip_read(const char *path, size_t limit, size_t *length) {
    (void)path, (void)limit, (void)length;
    errno = ENOENT;
    return NULL;
}

bool jox_zip_is_file(const char *path) {
    (void)path;
    return false;
}

bool jox_zip_is_folder(const char *path) { /* so that it is looked at and refused */
    const char *inside;
    return jox_zip_split(path, &inside) > 0 && !*inside;
}

char **jox_zip_names(const char *path, bool hidden) {
    (void)path, (void)hidden;
    errno = ENOENT;
    return NULL;
}

char *jox_zip_fault(const char *path) {
    const char *inside;
    return jox_zip_split(path, &inside) ? jox_strdup("this Jostle was built without libzip") : NULL;
}
