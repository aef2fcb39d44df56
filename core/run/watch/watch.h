/* Watches files for edits, with inotify. It watches their folders, as editors replace or truncate
   the files that they save. */
#ifndef JOX_RUN_WATCH_WATCH_H
#define JOX_RUN_WATCH_WATCH_H

#include <stdbool.h>
#include <stddef.h>

typedef struct JoxWatch JoxWatch;

/* Returns a watch without files; NULL with errno if the system refuses. */
JoxWatch *jox_watch_create(void);
/* Watches a path, whether a file is there or not; its present content counts as known. A path that
   ends with / is a folder, whose content is the names of its .lua and .yaml files. False with errno
   if the folder cannot be watched. */
bool jox_watch_add(JoxWatch *watch, const char *path);
/* Watches a file, if it is not yet watched, and takes `text` as its known content, which another
   process read. */
void jox_watch_set_known(JoxWatch *watch, const char *path, const char *text, size_t length);
/* Waits up to `seconds` for an event, or until the descriptor `other` is readable (-1: none), then
   until the folders have been quiet for 30 ms. Calls `changed` for each watched file whose content
   differs from the known one, with the time at which it was written, s since 1970. A file that is
   missing or half replaced is looked at again at the next event of its folder. */
typedef void JoxChanged(void *context, const char *path, double written);
void jox_watch_wait(JoxWatch *watch, int other, double seconds, JoxChanged *changed, void *context);
void jox_watch_free(JoxWatch *watch);

#endif
