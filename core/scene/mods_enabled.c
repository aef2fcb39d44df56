/* Reads and writes the list of enabled mods. */
#include "scene/mods_enabled.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/file.h"
#include "base/format/path.h"
#include "base/hash.h"
#include "base/mem.h"

enum {
    HASH = 64 /* hexadecimal digits */,
    MOST_FILES = 1024,
    LARGEST_FILE = 16 << 20,
    DEEPEST = 8,
    LARGEST_LIST = 1 << 20
};

/* ---- the hash ---- */

typedef struct ModFiles {
    JoxText list; /* a line for each file: its hash, and its path within the mod */
    JoxText *error;
    uint32_t files;
} ModFiles;

static bool hash_mod_file(ModFiles *c, const char *path, size_t root) {
    char hash[HASH + 1];
    size_t length;
    char *data = ++c->files <= MOST_FILES ? jox_read_file(path, LARGEST_FILE, &length) : NULL;
    if (!data) {
        jox_text_printf(c->error, "'%s' cannot be read, or there is too much", path);
        return false;
    }
    jox_sha256_hex(data, length, hash);
    jox_text_printf(&c->list, "%s %zu %s\n", hash, strlen(path + root), path + root);
    jox_free(data);
    return true;
}

/* Adds the files below a folder to the list. `root`: length of the path of the mod's folder. */
static bool hash_files_below(ModFiles *c, const char *folder, size_t root, int depth) {
    char **names = depth <= DEEPEST ? jox_folder_names(folder, true) : NULL;
    bool good = names;
    if (!good)
        jox_text_printf(c->error, "'%s' cannot be read, or lies too deep", folder);
    for (char **name = names; good && *name; name++) {
        JoxText path = {0};
        struct stat info;
        jox_text_printf(&path, "%s/%s", folder, *name);
        const bool in_archive = lstat(path.data, &info) != 0 && errno == ENOTDIR;
        if (in_archive ? jox_is_folder(path.data)
                       : lstat(path.data, &info) == 0 && S_ISDIR(info.st_mode)) {
            /* Hidden folders, as of version control, are no part of the mod. */
            good = **name == '.' || hash_files_below(c, path.data, root, depth + 1);
        } else if (in_archive || (lstat(path.data, &info) == 0 && S_ISREG(info.st_mode))) {
            good = hash_mod_file(c, path.data, root);
        } else {
            jox_text_printf(c->error, "'%s' is no plain file", path.data);
            good = false;
        }
        jox_text_free(&path);
    }
    jox_free(names);
    return good;
}

/* Computes SHA-256 over paths and contents of all files of a mod, as 64 hexadecimal digits. False
   with a sentence in `error` if a file is not a plain one or cannot be read, or if there are too
   many. */
static bool hash_mod_folder(const char *folder, char out[65], JoxText *error) {
    ModFiles content = {.error = error};
    bool good = hash_files_below(&content, folder, strlen(folder), 0);
    if (good)
        jox_sha256_hex(content.list.data ? content.list.data : "", content.list.length, out);
    jox_text_free(&content.list);
    return good;
}

/* ---- the list ---- */

/* Prints the path of jostle/mods-on, or of its folder; "" if the user has no home. */
static void find_list_path(bool file, char *out, size_t size) {
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    const char *end = file ? "/mods-on" : "";
    *out = 0;
    if (config && *config == '/') /* the XDG specification says to ignore relative paths */
        snprintf(out, size, "%.900s/jostle%s", config, end);
    else if (home && *home)
        snprintf(out, size, "%.900s/.config/jostle%s", home, end);
}

char *jox_mods_read_enabled(void) {
    char path[1024];
    size_t length;
    find_list_path(true, path, sizeof path);
    return *path ? jox_read_file(path, LARGEST_LIST, &length) : NULL;
}

/* A line of the list: HASH NAME FOLDER. */
typedef struct EnabledLine {
    const char *hash, *name, *folder;
    size_t name_length, folder_length;
} EnabledLine;

/* Parses the next valid line from *at on, and advances *at; false at the end. */
static bool parse_list_line(const char **at, EnabledLine *line) {
    while (*at && **at) {
        const char *begin = *at, *end = begin + strcspn(begin, "\n");
        *at = *end ? end + 1 : end;
        if (end - begin < HASH + 4 || begin[HASH] != ' ')
            continue;
        const char *name = begin + HASH + 1, *space = memchr(name, ' ', (size_t)(end - name));
        if (!space)
            continue;
        *line = (EnabledLine){begin, name, space + 1, (size_t)(space - name),
                              (size_t)(end - space - 1)};
        return true;
    }
    return false;
}

static bool equals_text(const char *text, size_t length, const char *wanted) {
    return length == strlen(wanted) && memcmp(text, wanted, length) == 0;
}

JoxModSwitch jox_mods_look_up_enabled(const char *list, const char *name, const char *folder) {
    char hash[HASH + 1] = "", *real = jox_path_real(folder);
    JoxModSwitch found = JOX_MOD_OFF;
    JoxText ignored = {0};
    EnabledLine line;
    for (const char *at = list; found != JOX_MOD_ON && parse_list_line(&at, &line);) {
        if (!equals_text(line.name, line.name_length, name))
            continue;
        if (!*hash && !hash_mod_folder(folder, hash, &ignored))
            hash[0] = '-'; /* equal to no hash */
        if (equals_text(line.hash, HASH, hash))
            found = JOX_MOD_ON;
        else if (real && equals_text(line.folder, line.folder_length, real))
            found = JOX_MOD_CHANGED;
    }
    jox_text_free(&ignored);
    free(real);
    return found;
}

/* Replaces the list, by renaming a new file, so that it is never half written. */
static bool write_enabled_list(const JoxText *list, JoxText *error) {
    char path[1024], beside[1040], folder[1024];
    find_list_path(true, path, sizeof path);
    find_list_path(false, folder, sizeof folder);
    if (!*path) {
        jox_text_add(error, "there is no configuration of the user: HOME is not set");
        return false;
    }
    char *slash = strrchr(folder, '/');
    *slash = 0;
    mkdir(folder, 0700); /* if this fails, fopen reports it */
    *slash = '/';
    mkdir(folder, 0700);
    snprintf(beside, sizeof beside, "%s.new", path);
    FILE *file = fopen(beside, "w");
    bool good = file && fwrite(list->data ? list->data : "", 1, list->length, file) == list->length;
    good = file && fclose(file) == 0 && good && rename(beside, path) == 0;
    if (!good)
        jox_text_printf(error, "cannot write '%s': %s", path, strerror(errno));
    return good;
}

bool jox_mods_set_enabled(const char *name, const char *folder, bool on, JoxText *error) {
    char hash[HASH + 1] = "", *list = jox_mods_read_enabled(), *real = jox_path_real(folder);
    JoxText out = {0};
    EnabledLine line;
    bool good = real && !strchr(real, '\n') && hash_mod_folder(folder, hash, error);
    if (!real || strchr(real, '\n'))
        jox_text_printf(error, "'%s' is no folder", folder);
    good |= !on && real; /* a mod that cannot be read can be disabled */
    for (const char *at = list; good && parse_list_line(&at, &line);) {
        bool same = equals_text(line.name, line.name_length, name) &&
                    (equals_text(line.hash, HASH, hash) ||
                     equals_text(line.folder, line.folder_length, real));
        if (!same) /* keep other mods */
            jox_text_printf(&out, "%.*s\n", (int)(line.folder + line.folder_length - line.hash),
                            line.hash);
    }
    if (good && on)
        jox_text_printf(&out, "%s %s %s\n", hash, name, real);
    good = good && write_enabled_list(&out, error);
    jox_text_free(&out);
    jox_free(list);
    free(real);
    return good;
}
