#include "run/watch/watch.h"

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/mem.h"
#include "base/text.h"
#include "base/zip.h"

enum { LARGEST_FILE = 16 << 20 };
static const double QUIET = 0.030; /* s without events before files are read */

typedef struct WatchedFile {
    char *path;
    char *watched, *name; /* the path, or that of the archive in which the file lies; its last part,
                             empty if the path is a folder, with / */
    bool lists;           /* the path is a folder, of which the names are watched */
    int folder;      /* inotify's number of its folder, or of the nearest one above that exists */
    bool away;       /* its folder does not exist */
    char digest[65]; /* SHA-256 of the known content; "" if the file could not be read */
    bool moved;      /* it had an event since its content was read */
} WatchedFile;

struct JoxWatch {
    int inotify;
    double last_event; /* s */
    WatchedFile *files;
    size_t count, capacity;
};

/* Returns whether a name is that of a file that Jostle reads, and not of an editor's backup. */
static bool is_source(const char *name) {
    const char *ending = strrchr(name, '.');
    return *name != '.' && ending && (!strcmp(ending, ".lua") || !strcmp(ending, ".yaml"));
}

/* Digests the names of the .lua and .yaml files in a folder; none if the folder does not exist. */
static void digest_names(const char *folder, char digest[65]) {
    JoxText all = {0};
    char **names = jox_folder_names(folder, false);
    for (size_t n = 0; names && names[n]; n++)
        if (is_source(names[n]))
            jox_text_printf(&all, "%s/", names[n]);
    jox_sha256_hex(all.data ? all.data : "", all.length, digest);
    jox_text_free(&all);
    jox_free(names);
}

static void digest_watched(const WatchedFile *file, char digest[65]) {
    size_t length;
    if (file->lists) {
        digest_names(file->path, digest);
        return;
    }
    char *text = jox_read_file(file->path, LARGEST_FILE, &length);
    digest[0] = 0;
    if (text)
        jox_sha256_hex(text, length, digest);
    jox_free(text);
}

static void close_watch(void *watch) {
    close(((JoxWatch *)watch)->inotify);
}

JoxWatch *jox_watch_create(void) {
    JoxWatch *watch = jox_alloc(1, sizeof *watch);
    int inotify = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    if (inotify < 0) {
        jox_free(watch);
        return NULL;
    }
    watch->inotify = inotify;
    return jox_heap_register(watch, close_watch);
}

static bool has_folder(const char *path) {
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

/* Watches the folder of a file, or the nearest one above it that exists. False with errno. */
static bool watch_folder(JoxWatch *watch, WatchedFile *file) {
    char folder[4096], missing[4096];
    snprintf(folder, sizeof folder, "%.*s", (int)(file->name - file->watched), file->watched);
    file->away = false;
    for (;;) {
        size_t n = strlen(folder);
        while (n > 1 && folder[n - 1] == '/')
            folder[--n] = 0;
        file->folder =
            inotify_add_watch(watch->inotify, n ? folder : ".",
                              IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_CREATE | IN_DELETE |
                                  IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR);
        if (file->folder >= 0 && file->away && has_folder(missing)) {
            file->away = false; /* it was made in the meantime */
            strcpy(folder, missing);
            continue;
        }
        if (file->folder >= 0)
            return true;
        if ((errno != ENOENT && errno != ENOTDIR) || !n || !strcmp(folder, "/"))
            return false;
        file->away = true;
        strcpy(missing, folder);
        char *slash = strrchr(folder, '/');
        folder[slash ? slash - folder + (slash == folder) : 0] = 0;
    }
}

bool jox_watch_add(JoxWatch *watch, const char *path) {
    for (size_t i = 0; i < watch->count; i++)
        if (strcmp(watch->files[i].path, path) == 0)
            return true;
    JOX_RESERVE(watch->files, watch->capacity, watch->count + 1);
    WatchedFile *file = &watch->files[watch->count];
    const char *inside;
    const size_t archive = jox_zip_split(path, &inside), length = strlen(path);
    *file = (WatchedFile){.path = jox_strdup(path),
                          .watched = jox_strndup(path, archive ? archive : length),
                          .lists = length && path[length - 1] == '/'};
    char *slash = strrchr(file->watched, '/');
    file->name = slash ? slash + 1 : file->watched;
    if (!watch_folder(watch, file)) {
        int why = errno;
        jox_free(file->path);
        jox_free(file->watched);
        errno = why;
        return false;
    }
    watch->count++;
    digest_watched(file, file->digest);
    return true;
}

void jox_watch_set_known(JoxWatch *watch, const char *path, const char *text, size_t length) {
    const size_t before = watch->count;
    if (!jox_watch_add(watch, path))
        return;
    for (size_t i = 0; i < watch->count; i++)
        if (strcmp(watch->files[i].path, path) == 0) {
            jox_sha256_hex(text, length, watch->files[i].digest);
            watch->files[i].moved |= i >= before; /* it may have changed since it was read */
        }
}

/* Watches the folder of a file anew if the event says that it appeared, or was moved or removed.
   Returns whether the file is to be read again. */
static bool follow_folder(JoxWatch *watch, WatchedFile *file, const struct inotify_event *event) {
    bool appears = file->away && (event->mask & IN_ISDIR);
    bool goes = event->mask & (IN_DELETE_SELF | IN_MOVE_SELF);
    if (!appears && !goes)
        return false;
    watch_folder(watch, file);
    return file->moved = !file->away || file->lists; /* a removed folder has lost its names */
}

/* Stops watching a folder that was moved, unless a file is still watched in it. */
static void leave_folder(JoxWatch *watch, int folder) {
    for (size_t i = 0; i < watch->count; i++)
        if (watch->files[i].folder == folder)
            return;
    inotify_rm_watch(watch->inotify, folder);
}

/* Reads all events and marks the files that they concern; if events were lost, all files. Events of
   other files in the folders do not prolong the wait for quiet. */
static void read_events(JoxWatch *watch) {
    _Alignas(struct inotify_event) char block[4096];
    ssize_t got;
    while ((got = read(watch->inotify, block, sizeof block)) > 0) {
        bool any = false;
        for (char *at = block; at < block + got;) {
            const struct inotify_event *event = (const void *)at;
            for (size_t i = 0; i < watch->count; i++) {
                WatchedFile *file = &watch->files[i];
                if (!(event->mask & IN_Q_OVERFLOW) && event->wd != file->folder)
                    continue;
                if (follow_folder(watch, file, event) || (event->mask & IN_Q_OVERFLOW) ||
                    (!file->away && event->len &&
                     (*file->name ? !strcmp(event->name, file->name) : is_source(event->name))))
                    file->moved = any = true;
            }
            if (event->mask & IN_MOVE_SELF)
                leave_folder(watch, event->wd);
            at += sizeof *event + event->len;
        }
        if (any)
            watch->last_event = jox_clock_wall();
    }
}

static bool has_moved_files(const JoxWatch *watch) {
    for (size_t i = 0; i < watch->count; i++)
        if (watch->files[i].moved)
            return true;
    return false;
}

/* Returns when a file was written, or moved to its path, whichever is later; s since 1970. */
static double read_write_time(const char *path) {
    struct stat info;
    if (stat(path, &info) != 0)
        return 0.0;
    double modified = (double)info.st_mtim.tv_sec + (double)info.st_mtim.tv_nsec * 1e-9;
    double placed = (double)info.st_ctim.tv_sec + (double)info.st_ctim.tv_nsec * 1e-9;
    return placed > modified ? placed : modified;
}

void jox_watch_wait(JoxWatch *watch, int other, double seconds, JoxChanged *changed,
                    void *context) {
    struct pollfd fds[2] = {{.fd = watch->inotify, .events = POLLIN},
                            {.fd = other, .events = POLLIN}};
    poll(fds, other >= 0 ? 2 : 1, (int)(seconds * 1e3));
    read_events(watch);
    while (has_moved_files(watch) && jox_clock_wall() - watch->last_event < QUIET) {
        double left = QUIET - (jox_clock_wall() - watch->last_event);
        poll(fds, 1, (int)(left * 1e3) + 1);
        read_events(watch);
    }
    for (size_t i = 0; i < watch->count; i++) {
        WatchedFile *file = &watch->files[i];
        if (!file->moved)
            continue;
        file->moved = false;
        char digest[65];
        digest_watched(file, digest);
        /* An archive is replaced as a whole: if nothing is read from it, it is wrong. */
        const bool broken = !digest[0] && strcmp(file->path, file->watched) != 0;
        if ((digest[0] || broken) && strcmp(digest, file->digest) != 0) {
            strcpy(file->digest, digest);
            changed(context, file->path, read_write_time(file->watched));
        }
    }
}

void jox_watch_free(JoxWatch *watch) {
    if (!watch)
        return;
    jox_heap_unregister(watch);
    close_watch(watch);
    for (size_t i = 0; i < watch->count; i++) {
        jox_free(watch->files[i].path);
        jox_free(watch->files[i].watched);
    }
    jox_free(watch->files);
    jox_free(watch);
}
