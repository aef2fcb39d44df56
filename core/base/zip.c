/* Finds the zip archive in a path. zip_libzip.c reads it, or zip_none.c does not. */
#include "base/zip.h"

#include <string.h>
#include <sys/stat.h>

#include "base/mem.h"

size_t jox_zip_split(const char *path, const char **inside) {
    for (const char *at = strstr(path, ".zip"); at; at = strstr(at + 1, ".zip")) {
        const size_t length = (size_t)(at - path) + strlen(".zip");
        if (path[length] && path[length] != '/')
            continue;
        struct stat info;
        char *archive = jox_strndup(path, length);
        const bool there = stat(archive, &info) == 0 && S_ISREG(info.st_mode);
        jox_free(archive);
        if (!there)
            continue;
        *inside = path + length + strspn(path + length, "/");
        return length;
    }
    return 0;
}
