#include "run/watch/changes.h"

#include <string.h>

#include "base/mem.h"

static bool holds_path(const JoxFiles *files, const char *path) {
    for (uint32_t f = 0; f < files->count; f++)
        if (strcmp(files->paths[f], path) == 0)
            return true;
    return false;
}

void jox_files_add(JoxFiles *files, const char *path) {
    if (holds_path(files, path))
        return;
    JOX_RESERVE(files->paths, files->capacity, files->count + 1);
    files->paths[files->count++] = jox_strdup(path);
}

void jox_files_free(JoxFiles *files) {
    for (uint32_t f = 0; f < files->count; f++)
        jox_free(files->paths[f]);
    jox_free(files->paths);
    *files = (JoxFiles){0};
}

void jox_changes_add_use(JoxChanges *changes, uint32_t part, const char *path) {
    jox_files_add(&changes->made_of[part], path);
}

bool jox_changes_use(const JoxChanges *changes, const char *path) {
    for (uint32_t p = 0; p < JOX_PARTS; p++)
        if (holds_path(&changes->made_of[p], path))
            return true;
    return false;
}

void jox_changes_add_changed_file(JoxChanges *changes, const char *path, double written) {
    JoxChangedFile *file = NULL;
    for (uint32_t f = 0; f < changes->count; f++)
        if (strcmp(changes->files[f].path, path) == 0)
            file = &changes->files[f];
    if (!file) {
        JOX_RESERVE(changes->files, changes->capacity, changes->count + 1);
        file = &changes->files[changes->count++];
        file->path = jox_strdup(path);
    }
    file->written = written;
    file->untried = true;
}

static void forget_changed_file(JoxChanges *changes, uint32_t file) {
    jox_free(changes->files[file].path);
    changes->files[file] = changes->files[--changes->count];
}

bool jox_changes_affects(const JoxChanges *changes, uint32_t part, const char *path) {
    for (uint32_t f = 0; f < changes->count; f++)
        if (strcmp(changes->files[f].path, path) == 0)
            return holds_path(&changes->made_of[part], path);
    return false;
}

void jox_changes_forget_file(JoxChanges *changes, const char *path) {
    for (uint32_t f = changes->count; f-- > 0;)
        if (strcmp(changes->files[f].path, path) == 0)
            forget_changed_file(changes, f);
}

bool jox_changes_has_untried(const JoxChanges *changes) {
    for (uint32_t f = 0; f < changes->count; f++)
        if (changes->files[f].untried)
            return true;
    return false;
}

/* Adds to `parts` those that use the file, and those connected to them by other changed files. */
static void add_connected_parts(const JoxChanges *changes, uint32_t file, bool parts[JOX_PARTS]) {
    const char *path = changes->files[file].path;
    for (uint32_t p = 0; p < JOX_PARTS; p++) {
        if (parts[p] || !holds_path(&changes->made_of[p], path))
            continue;
        parts[p] = true;
        for (uint32_t f = 0; f < changes->count; f++)
            if (f != file && holds_path(&changes->made_of[p], changes->files[f].path))
                add_connected_parts(changes, f, parts);
    }
}

static bool is_used_by(const JoxChanges *changes, const bool parts[JOX_PARTS], const char *path) {
    for (uint32_t p = 0; p < JOX_PARTS; p++)
        if (parts[p] && holds_path(&changes->made_of[p], path))
            return true;
    return false;
}

bool jox_changes_take_next(JoxChanges *changes, bool parts[JOX_PARTS], double *written) {
    *written = 0.0;
    for (uint32_t first = 0; first < changes->count; first++) {
        if (!changes->files[first].untried)
            continue;
        memset(parts, 0, JOX_PARTS * sizeof *parts);
        add_connected_parts(changes, first, parts);
        if (!is_used_by(changes, parts, changes->files[first].path)) {
            forget_changed_file(changes, first--); /* no part uses it any more */
            continue;
        }
        for (uint32_t f = 0; f < changes->count; f++) {
            JoxChangedFile *file = &changes->files[f];
            if (!file->untried || !is_used_by(changes, parts, file->path))
                continue;
            file->untried = false;
            *written = file->written > *written ? file->written : *written;
        }
        return true;
    }
    return false;
}

void jox_changes_mark_live(JoxChanges *changes, const bool parts[JOX_PARTS]) {
    for (uint32_t f = changes->count; f-- > 0;)
        if (!changes->files[f].untried && is_used_by(changes, parts, changes->files[f].path))
            forget_changed_file(changes, f);
    for (uint32_t p = 0; p < JOX_PARTS; p++)
        if (parts[p])
            jox_files_free(&changes->made_of[p]);
}

void jox_changes_free(JoxChanges *changes) {
    while (changes->count)
        forget_changed_file(changes, 0);
    jox_free(changes->files);
    for (uint32_t p = 0; p < JOX_PARTS; p++)
        jox_files_free(&changes->made_of[p]);
    *changes = (JoxChanges){0};
}
