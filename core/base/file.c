#include "base/file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/sort.h"
#include "base/zip.h"
#include "jostle_tools.h"

/* ---- files that are written under a temporary name ---- */

typedef struct Part {
    struct Part *next;
    FILE *file;
    char *name;  /* the final path; points into `text` */
    char text[]; /* the temporary path, a zero, the final path, a zero */
} Part;

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static Part *parts;

/* Takes the entry of a file off the list; NULL if it has none. */
static Part *unlist_part(const FILE *file) {
    pthread_mutex_lock(&lock);
    Part **at = &parts;
    while (*at && (*at)->file != file)
        at = &(*at)->next;
    Part *part = *at;
    if (part)
        *at = part->next;
    pthread_mutex_unlock(&lock);
    return part;
}

/* Closes a file. One with a temporary name is renamed if all was written (`good`), else removed. */
static int end_file(FILE *file, bool good) {
    Part *part = unlist_part(file);
    good = good && fflush(file) == 0 && !ferror(file);
    if (part && good)
        good = rename(part->text, part->name) == 0;
    const int number = errno;
    if (part && !good)
        unlink(part->text);
    free(part);
    const bool closed = fclose(file) == 0;
    if (!good)
        errno = number;
    return good && closed ? 0 : EOF;
}

static void release_file(void *file) {
    end_file(file, false);
}

/* ---- opening ---- */

/* Opens a file without waiting for the other end of a pipe. For reading, opens regular files alone:
   reads from a pipe or a terminal might wait for ever. Returns a descriptor, or -1 with errno. */
static int open_now(const char *path, int flags, mode_t mode, struct stat *info) {
    const int file = open(path, flags | O_NONBLOCK | O_CLOEXEC, mode);
    if (file < 0)
        return -1;
    const bool good = fstat(file, info) == 0;
    if (!good || (flags == O_RDONLY && !S_ISREG(info->st_mode))) {
        close(file);
        errno = !good ? EIO : S_ISDIR(info->st_mode) ? EISDIR : EINVAL;
        return -1;
    }
    fcntl(file, F_SETFL, fcntl(file, F_GETFL) & ~O_NONBLOCK);
    return file;
}

/* Opens a file for one writer, by a lock that ends with the descriptor. Returns -1 with errno,
   EBUSY if another writer has the file or replaced it meanwhile. `mode`: permissions of a new file,
   as far as the process's mask allows. */
static int open_to_write(const char *path, int flags, mode_t mode) {
    struct stat info, named;
    const int file = open_now(path, O_WRONLY | O_CREAT | flags, mode, &info);
    if (file < 0 || !S_ISREG(info.st_mode))
        return file;
    const bool own = flock(file, LOCK_EX | LOCK_NB) == 0 && stat(path, &named) == 0 &&
                     named.st_ino == info.st_ino;
    if (own && (flags == O_APPEND || ftruncate(file, 0) == 0))
        return file;
    const int number = own ? errno : EBUSY;
    if (own && info.st_size == 0) /* it was made by this call */
        unlink(path);
    close(file);
    errno = number;
    return -1;
}

bool jox_file_has_name(FILE *file, const char *path) {
    struct stat info, named;
    return fstat(fileno(file), &info) == 0 && stat(path, &named) == 0 &&
           info.st_dev == named.st_dev && info.st_ino == named.st_ino;
}

static FILE *hold_stream(int number, const char *mode) {
    FILE *file = number >= 0 ? fdopen(number, mode) : NULL;
    if (number >= 0 && !file)
        close(number);
    return file ? jox_heap_register(file, release_file) : NULL;
}

FILE *jox_file_open(const char *path, const char *mode) {
    struct stat info;
    return hold_stream(*mode == 'r' ? open_now(path, O_RDONLY, 0, &info)
                                    : open_to_write(path, *mode == 'a' ? O_APPEND : 0, 0666),
                       mode);
}

bool jox_file_can_be_written(const char *path) {
    const bool was = access(path, F_OK) == 0;
    const int number = open_to_write(path, O_APPEND, 0666);
    if (number < 0)
        return false;
    close(number);
    if (!was)
        unlink(path);
    return true;
}

FILE *jox_file_replace(const char *path) {
    static const char ENDING[] = ".part";
    const size_t length = strlen(path);
    struct stat info;
    if (lstat(path, &info) == 0 && S_ISDIR(info.st_mode)) {
        errno = EISDIR;
        return NULL;
    }
    const bool there = lstat(path, &info) == 0;
    if (there && !S_ISREG(info.st_mode)) /* a device, a pipe, a link */
        return jox_file_open(path, "w");
    Part *part =
        malloc(sizeof *part + 2 * length + sizeof ENDING + 1); /* no heap owns it: end_file frees */
    if (!part)
        jox_out_of_memory(sizeof *part);
    memcpy(part->text, path, length);
    memcpy(part->text + length, ENDING, sizeof ENDING);
    part->name = memcpy(part->text + length + sizeof ENDING, path, length + 1);
    const int number =
        open_to_write(part->text, O_NOFOLLOW, there ? (info.st_mode & 0777) | S_IWUSR : 0666);
    part->file = number >= 0 ? fdopen(number, "w") : NULL;
    if (!part->file) {
        const int why = errno;
        if (number >= 0) {
            unlink(part->text);
            close(number);
        }
        free(part);
        errno = why;
        return NULL;
    }
    FILE *file = part->file;
    pthread_mutex_lock(&lock);
    part->next = parts;
    parts = part;
    pthread_mutex_unlock(&lock);
    return jox_heap_register(file, release_file);
}

FILE *jox_folder_claim(const char *path) {
    const int number = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (number >= 0 && flock(number, LOCK_EX | LOCK_NB) != 0) {
        close(number);
        errno = EBUSY;
        return NULL;
    }
    return hold_stream(number, "r");
}

int jox_file_close(FILE *file) {
    jox_heap_unregister(file);
    return end_file(file, true);
}

int jox_file_drop(FILE *file) {
    jox_heap_unregister(file);
    end_file(file, false);
    return EOF;
}

const char *jox_file_error_text(int number) {
    return number == EINVAL || number == EISDIR ? "it is no regular file"
           : number == ENXIO                    ? "it is a pipe that nobody reads"
           : number == EBADMSG ? "the zip archive is damaged, or has what archives must not have"
           : number == EBUSY   ? "another run writes it"
                               : strerror(number);
}

const char *jox_unread_text(const char *path, int number, char text[JOX_UNREAD]) {
    const char *inside;
    if (number == EFBIG || jox_zip_split(path, &inside) == 0 || !*inside)
        return jox_file_error_text(number);
    char *fault = jox_zip_fault(path);
    if (fault)
        snprintf(text, JOX_UNREAD, "the archive cannot be used: %s", fault);
    else if (jox_zip_is_file(path))
        snprintf(text, JOX_UNREAD, "it is damaged in the archive: its checksum is wrong");
    else
        snprintf(text, JOX_UNREAD, "the archive has no such file");
    jox_free(fault);
    return text;
}

bool jo_write(const char *path, const char *text, JoError *error) {
    JOX_REQUIRE(path && text, false);
    JOX_GUARD (NULL, error)
        return false;
    FILE *file = jox_file_replace(path);
    bool good = file && fputs(text, file) >= 0;
    if (file)
        good = jox_file_close(file) == 0 && good;
    if (!good)
        jox_error(error, JO_FAILED, "%s", jox_file_error_text(errno));
    return good;
}

/* ---- folders ---- */

static void release_folder(void *folder) {
    closedir(folder);
}

static bool is_listed(const char *name, bool hidden) {
    return *name != '.' || (hidden && strcmp(name, ".") != 0 && strcmp(name, "..") != 0);
}

bool jox_is_folder(const char *path) {
    struct stat info;
    if (stat(path, &info) == 0 && S_ISDIR(info.st_mode))
        return true;
    return jox_zip_is_folder(path);
}

char **jox_folder_names(const char *path, bool hidden) {
    DIR *folder = opendir(path);
    if (!folder)
        return errno == ENOTDIR ? jox_zip_names(path, hidden) : NULL;
    jox_heap_register(folder, release_folder);
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
    jox_heap_unregister(folder);
    closedir(folder);
    /* One block: the pointers, then the names. */
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

bool jox_file_send(int descriptor, const void *bytes, size_t length) {
    for (const char *at = bytes; length > 0;) {
        const ssize_t done = write(descriptor, at, length);
        if (done < 0 && errno != EINTR)
            return false;
        at += done > 0 ? done : 0;
        length -= done > 0 ? (size_t)done : 0;
    }
    return true;
}
