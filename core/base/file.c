#include "base/file.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/sort.h"

static void release_file(void *file) {
    fclose(file);
}

FILE *jox_file_open(const char *path, const char *mode) {
    FILE *file = fopen(path, mode);
    return file ? jox_hold(file, release_file) : NULL;
}

int jox_file_close(FILE *file) {
    jox_let_go(file);
    return fclose(file);
}

static void release_folder(void *folder) {
    closedir(folder);
}

static bool is_listed(const char *name, bool hidden) {
    return *name != '.' || (hidden && strcmp(name, ".") != 0 && strcmp(name, "..") != 0);
}

char **jox_folder_names(const char *path, bool hidden) {
    DIR *folder = opendir(path);
    if (!folder)
        return NULL;
    jox_hold(folder, release_folder);
    char *text = NULL;
    size_t length = 0, capacity = 0, count = 0;
    const struct dirent *entry;
    while ((entry = readdir(folder))) {
        const size_t size = strlen(entry->d_name) + 1;
        if (!is_listed(entry->d_name, hidden))
            continue;
        JOX_RESERVE(text, capacity, length + size);
        memcpy(text + length, entry->d_name, size);
        length += size;
        count++;
    }
    jox_let_go(folder);
    closedir(folder);
    /* The pointers, then what they point to. */
    const size_t table = (count + 1) * sizeof(char *);
    char **names = jox_alloc(table + length, 1), *at = (char *)names + table;
    if (length)
        memcpy(at, text, length);
    jox_free(text);
    for (size_t n = 0; n < count; n++, at += strlen(at) + 1)
        names[n] = at;
    jox_sort_texts((const char **)names, count);
    return names;
}
