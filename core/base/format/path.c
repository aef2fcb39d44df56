#include "base/format/path.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/mem.h"
#include "base/overlay.h"
#include "base/zip.h"

size_t jox_path_folder(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

const char *jox_path_name(const char *path) {
    return path + jox_path_folder(path);
}

size_t jox_path_stem(const char *name) {
    return strcspn(name, ".");
}

/* Joins `folder`, `name` and `ending` to a path relative to the folder of `file`; false if too
   long. */
static bool join_path(const char *file, const char *folder, const char *name, const char *ending,
                      char path[JOX_LONGEST_PATH]) {
    const bool absolute = *name == '/' || *folder == '/';
    const int length =
        snprintf(path, JOX_LONGEST_PATH, "%.*s%s%s%s", absolute ? 0 : (int)jox_path_folder(file),
                 file, *name == '/' ? "" : folder, name, ending);
    return length < JOX_LONGEST_PATH;
}

bool jox_path_beside(const char *file, const char *name, char path[JOX_LONGEST_PATH]) {
    return join_path(file, "", name, "", path);
}

bool jox_path_find(const char *file, const char *name, const char *ending,
                   const char *const *folders, char path[JOX_LONGEST_PATH]) {
    const size_t n = strlen(name), m = strlen(ending);
    const bool has_ending = n > m && strcmp(name + n - m, ending) == 0;
    for (; *folders; folders++) {
        if (!join_path(file, *folders, name, has_ending ? "" : ending, path))
            continue;
        if (!jox_is_file(path)) /* an overlay has clean paths, also of files not on the disk */
            jox_path_clean(path);
        if (jox_is_file(path))
            return true;
    }
    return false;
}

char *jox_path_real(const char *path) {
    char *real = realpath(path, NULL); /* from malloc */
    const char *inside;
    const size_t length = real ? 0 : jox_zip_split(path, &inside);
    if (!length || !(jox_zip_is_file(path) || jox_zip_is_folder(path)))
        return real;
    char *archive = jox_strndup(path, length), *whole = NULL;
    char *base = realpath(archive, NULL);
    jox_free(archive);
    if (base && asprintf(&whole, "%s/%s", base, inside) < 0)
        whole = NULL;
    free(base);
    return whole;
}

char *jox_path_real_below(const char *path, const char *folder) {
    char *real = jox_path_real(path), *root = jox_path_real(folder);
    const size_t n = root ? strlen(root) : 0;
    const bool below = real && root && strncmp(real, root, n) == 0 && (real[n] == '/' || n == 1);
    free(root);
    if (!below)
        free(real);
    return below ? real : NULL;
}

bool jox_path_below(const char *path, const char *folder) {
    char *real = jox_path_real_below(path, folder);
    free(real);
    return real != NULL;
}

bool jox_path_is_foreign(const char *file, const char *path) {
    char folder[JOX_LONGEST_PATH];
    struct stat info;
    if (jox_overlay_file(path) || lstat(path, &info) != 0)
        return false;
    snprintf(folder, sizeof folder, "%.*s.", (int)jox_path_folder(file), file);
    return !jox_path_below(path, folder);
}

bool jox_path_same(const char *a, const char *b) {
    struct stat x, y;
    return strcmp(a, b) == 0 ||
           (stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino);
}

void jox_path_clean(char *path) {
    size_t length = strlen(path), used = *path == '/';
    char *clean = jox_alloc(length + 2, 1);
    size_t starts[256] = {0}, parts = 0; /* offsets of the parts of `clean`, to remove the last */
    if (used)
        clean[0] = '/';
    for (const char *at = path; *at && parts < 255;) {
        size_t n = strcspn(at, "/");
        bool up = n == 2 && at[0] == '.' && at[1] == '.';
        const char *last = parts ? clean + starts[parts - 1] : "";
        if (up && parts && strcmp(last, "..") != 0) {
            used = starts[--parts];
            clean[used] = 0;
        } else if (n > 0 && !(n == 1 && *at == '.')) {
            if (used > 0 && clean[used - 1] != '/')
                clean[used++] = '/';
            starts[parts++] = used;
            memcpy(clean + used, at, n);
            used += n;
            clean[used] = 0;
        }
        at += n + (at[n] == '/');
    }
    while (used > 1 && clean[used - 1] == '/')
        clean[--used] = 0;
    if (used > 0 && used <= length && (jox_overlay_file(clean) || jox_path_same(path, clean)))
        memcpy(path, clean, used + 1);
    jox_free(clean);
}
