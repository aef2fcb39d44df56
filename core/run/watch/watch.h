/* Notices edited files. Folders are watched, not files: editors replace or truncate what they
   save. */
#ifndef JOX_RUN_WATCH_WATCH_H
#define JOX_RUN_WATCH_WATCH_H

#include <stdbool.h>
#include <stddef.h>

typedef struct JoxWatch JoxWatch;

/* NULL with errno set if the system refuses. */
JoxWatch *jox_watch_create(void);
/* Watches a file by its path, there or not; its present content is the one already known. The
   content of a folder, whose path ends with a /, is the names of its .lua and .yaml files. False
   with errno if the folder cannot be watched. */
bool jox_watch_add(JoxWatch *watch, const char *path);
/* What was read of a file, by whomever: it is watched, and the content already known is that. */
void jox_watch_read(JoxWatch *watch, const char *path, const char *text, size_t length);
/* Waits up to `seconds` for something to happen (or for the other file descriptor to be readable),
   then until the folders have been quiet for 30 ms. Calls `changed` for each watched file whose
   content differs from the one last known, with the time at which it was written (seconds since
   1970). A file that is missing or half-way replaced is looked at again when its folder moves next.
 */
typedef void JoxChanged(void *context, const char *path, double written);
void jox_watch_wait(JoxWatch *watch, int other, double seconds, JoxChanged *changed, void *context);
void jox_watch_free(JoxWatch *watch);

#endif
