/* Reads zip archives by libzip, from memory. */
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <zip.h>

#include "base/mem.h"
#include "base/sort.h"
#include "base/zip.h"

enum {
    WHY = 200, /* bytes of a sentence */
    MOST_ENTRIES = 1000,
    LONGEST_NAME = 200,
    MOST_RATIO = 200, /* deflate reaches 1,030 */
    RATIO_FROM = 4096 /* bytes: what is smaller may have any ratio */
};
static const size_t LARGEST_ARCHIVE = (size_t)8 << 20, LARGEST_CONTENT = (size_t)16 << 20;

/* An archive in memory. */
typedef struct Archive {
    zip_t *zip;
    char *data;
    uint64_t count;
} Archive;

static void release_archive(void *archive) {
    zip_discard(((Archive *)archive)->zip);
}

static void close_archive(Archive *archive) {
    jox_heap_unregister(archive);
    release_archive(archive);
    jox_free(archive->data);
    jox_free(archive);
}

/* Reads a file of the disk whole; NULL with errno. Nothing is allocated while it is open. */
static char *read_archive_bytes(const char *path, size_t *length) {
    struct stat info;
    if (stat(path, &info) != 0)
        return NULL;
    if ((uint64_t)info.st_size > LARGEST_ARCHIVE) {
        errno = EFBIG;
        return NULL;
    }
    char *data = jox_alloc((size_t)info.st_size + 1, 1);
    FILE *file = fopen(path, "rbe");
    *length = file ? fread(data, 1, (size_t)info.st_size, file) : 0;
    const int why = errno;
    if (file) {
        fclose(file);
        return data;
    }
    jox_free(data);
    errno = why;
    return NULL;
}

/* Whether the path of an entry stays within the archive, and is one that every system reads alike.
 */
static bool is_good_name(const char *name) {
    if (!*name || *name == '/' || strlen(name) > LONGEST_NAME)
        return false;
    for (const char *at = name; *at;) {
        const size_t n = strcspn(at, "/");
        if (n == 0 || (n == 1 && *at == '.') || (n == 2 && at[0] == '.' && at[1] == '.'))
            return false;
        at += n + (at[n] == '/');
    }
    for (const char *c = name; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == '\\' || *c == ':' || *c == 0x7f)
            return false;
    return true;
}

/* Whether an entry is a link, or anything else than a file or folder, by its Unix mode. */
static bool is_special(zip_t *zip, uint64_t index) {
    zip_uint8_t system = 0;
    zip_uint32_t attributes = 0;
    if (zip_file_get_external_attributes(zip, index, 0, &system, &attributes) != 0 ||
        system != ZIP_OPSYS_UNIX)
        return false;
    const uint32_t type = attributes >> 16 & S_IFMT;
    return type && type != S_IFREG && type != S_IFDIR;
}

/* Returns what is wrong with an entry, or NULL; adds its size to *content. */
static const char *find_entry_fault(zip_t *zip, uint64_t index, const zip_stat_t *entry,
                                    size_t *content) {
    const zip_uint64_t needed = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE;
    if ((entry->valid & needed) != needed || entry->size > LARGEST_CONTENT)
        return "it is too large";
    *content += (size_t)entry->size;
    if (!is_good_name(entry->name))
        return "its path leads out of the archive, or is not portable";
    if (is_special(zip, index))
        return "symbolic links are not followed";
    if ((entry->valid & ZIP_STAT_ENCRYPTION_METHOD) && entry->encryption_method != ZIP_EM_NONE)
        return "it is encrypted";
    if (entry->size > RATIO_FROM && entry->size / MOST_RATIO > entry->comp_size)
        return "it unpacks to over 200 times its size";
    return *content > LARGEST_CONTENT ? "the files before and with it are over 16 MB" : NULL;
}

/* Checks all entries; false with a sentence in `why`. */
static bool check_entries(const Archive *archive, char why[WHY]) {
    size_t content = 0;
    if (archive->count > MOST_ENTRIES) {
        snprintf(why, WHY, "it has over %d files", MOST_ENTRIES);
        return false;
    }
    for (uint64_t e = 0; e < archive->count; e++) {
        zip_stat_t entry;
        zip_stat_init(&entry);
        const char *fault = zip_stat_index(archive->zip, e, 0, &entry) == 0
                                ? find_entry_fault(archive->zip, e, &entry, &content)
                                : "it is damaged";
        if (fault) {
            const char *name = entry.valid & ZIP_STAT_NAME ? entry.name : "?";
            snprintf(why, WHY, "'%.80s': %s", name, fault);
            for (char *c = why; *c; c++)
                *c = (unsigned char)*c < 0x20 || *c == 0x7f ? '?' : *c;
            return false;
        }
    }
    return true;
}

/* Opens the archive of a path and checks it; NULL with errno, and a sentence in `why` if it is
   refused. */
static Archive *open_archive(const char *path, size_t name_length, char why[WHY]) {
    char *name = jox_strndup(path, name_length);
    size_t length = 0;
    Archive *archive = jox_alloc(1, sizeof *archive);
    archive->data = read_archive_bytes(name, &length);
    const int reason = errno;
    jox_free(name);
    if (!archive->data) {
        snprintf(why, WHY, "%s", reason == EFBIG ? "it is over 8 MB" : strerror(reason));
        jox_free(archive);
        errno = reason == EFBIG ? EBADMSG : reason;
        return NULL;
    }
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t *source = zip_source_buffer_create(archive->data, length, 0, &error);
    archive->zip = source ? zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error) : NULL;
    if (!archive->zip) {
        if (zip_error_code_zip(&error) == ZIP_ER_EXISTS)
            snprintf(why, WHY, "it has two files of one name");
        else
            snprintf(why, WHY, "it is no zip archive: %.120s", zip_error_strerror(&error));
        zip_source_free(source);
        zip_error_fini(&error);
        jox_free(archive->data);
        jox_free(archive);
        errno = EBADMSG;
        return NULL;
    }
    zip_error_fini(&error);
    jox_heap_register(archive, release_archive);
    archive->count = (uint64_t)zip_get_num_entries(archive->zip, 0);
    if (check_entries(archive, why))
        return archive;
    close_archive(archive);
    errno = EBADMSG;
    return NULL;
}

/* Opens the archive that a path leads into; *inside is the rest of the path. NULL with errno. */
static Archive *open_for(const char *path, const char **inside) {
    const size_t length = jox_zip_split(path, inside);
    char why[WHY];
    if (length)
        return open_archive(path, length, why);
    errno = ENOENT;
    return NULL;
}

/* Reads an entry to its end, where its checksum is compared. */
static char *read_entry(const Archive *archive, const char *name, size_t limit, size_t *length) {
    zip_stat_t entry;
    zip_stat_init(&entry);
    if (!*name || zip_stat(archive->zip, name, 0, &entry) != 0 || name[strlen(name) - 1] == '/') {
        errno = ENOENT;
        return NULL;
    }
    if (entry.size > limit) {
        errno = EFBIG;
        return NULL;
    }
    char *text = jox_alloc((size_t)entry.size + 2, 1);
    zip_file_t *file = zip_fopen_index(archive->zip, entry.index, 0);
    zip_int64_t got = file ? 0 : -1, more = 1;
    while (got >= 0 && more > 0 && (zip_uint64_t)got <= entry.size) {
        more = zip_fread(file, text + got, entry.size + 1 - (zip_uint64_t)got);
        got = more < 0 ? -1 : got + more; /* the read at the end compares the checksum */
    }
    if (file)
        zip_fclose(file);
    if (got != (zip_int64_t)entry.size) {
        jox_free(text);
        errno = EBADMSG;
        return NULL;
    }
    text[entry.size] = 0;
    if (length)
        *length = (size_t)entry.size;
    return text;
}

char *jox_zip_read(const char *path, size_t limit, size_t *length) {
    const char *inside;
    Archive *archive = open_for(path, &inside);
    if (!archive)
        return NULL;
    char *text = read_entry(archive, inside, limit, length);
    const int reason = errno;
    close_archive(archive);
    errno = reason;
    return text;
}

bool jox_zip_is_file(const char *path) {
    const char *inside;
    Archive *archive = open_for(path, &inside);
    const bool is = archive && *inside && inside[strlen(inside) - 1] != '/' &&
                    zip_name_locate(archive->zip, inside, 0) >= 0;
    if (archive)
        close_archive(archive);
    return is;
}

/* Returns the part of an entry's path behind a folder of the archive; NULL if it is not below. */
static const char *get_part_below(const Archive *archive, uint64_t entry, const char *folder) {
    const char *name = zip_get_name(archive->zip, entry, 0);
    size_t n = strlen(folder);
    while (n > 0 && folder[n - 1] == '/')
        n--;
    if (!name || strncmp(name, folder, n) != 0 || (n && name[n] != '/'))
        return NULL;
    name += n + (n > 0);
    return *name ? name : NULL;
}

bool jox_zip_is_folder(const char *path) {
    const char *inside;
    Archive *archive = open_for(path, &inside);
    bool is = archive && !*inside;
    for (uint64_t e = 0; archive && e < archive->count && !is; e++)
        is = get_part_below(archive, e, inside) != NULL;
    if (archive)
        close_archive(archive);
    return is;
}

char **jox_zip_names(const char *path, bool hidden) {
    const char *inside;
    Archive *archive = open_for(path, &inside);
    if (!archive)
        return NULL;
    const char **found = jox_alloc(archive->count + 1, sizeof *found);
    char *text = jox_alloc(archive->count + 1, LONGEST_NAME + 1), *at = text;
    size_t count = 0;
    for (uint64_t e = 0; e < archive->count; e++) {
        const char *part = get_part_below(archive, e, inside);
        bool known = !part || (!hidden && *part == '.');
        if (!known)
            snprintf(at, LONGEST_NAME + 1, "%.*s", (int)strcspn(part, "/"), part);
        for (size_t k = 0; k < count && !known; k++)
            known = strcmp(found[k], at) == 0;
        if (known)
            continue;
        found[count++] = at;
        at += strlen(at) + 1;
    }
    jox_sort_texts(found, count);
    /* One block: the pointers, then the names. */
    const size_t table = (count + 1) * sizeof(char *);
    char **names = jox_alloc(table + (size_t)(at - text), 1), *to = (char *)names + table;
    for (size_t k = 0; k < count; k++) {
        names[k] = strcpy(to, found[k]);
        to += strlen(to) + 1;
    }
    jox_free(found);
    jox_free(text);
    close_archive(archive);
    return names;
}

char *jox_zip_fault(const char *path) {
    const char *inside;
    const size_t length = jox_zip_split(path, &inside);
    char why[WHY] = "";
    Archive *archive = length ? open_archive(path, length, why) : NULL;
    if (archive)
        close_archive(archive);
    return *why ? jox_strdup(why) : NULL;
}
