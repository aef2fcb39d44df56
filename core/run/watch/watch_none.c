/* Replaces watch_inotify.c in builds without inotify (WATCH=0): no watch can be created, so that
   jo_scene_watch fails and says so. */
#include <errno.h>

#include "run/watch/watch.h"

JoxWatch *jox_watch_create(void) {
    errno = ENOSYS;
    return NULL;
}

bool jox_watch_add(JoxWatch *watch, const char *path) {
    (void)watch, (void)path;
    return true;
}

void jox_watch_set_known(JoxWatch *watch, const char *path, const char *text, size_t length) {
    (void)watch, (void)path, (void)text, (void)length;
}

void jox_watch_wait(JoxWatch *watch, int other, double seconds, JoxChanged *changed,
                    void *context) {
    (void)watch, (void)other, (void)seconds, (void)changed, (void)context;
}

void jox_watch_free(JoxWatch *watch) {
    (void)watch;
}
