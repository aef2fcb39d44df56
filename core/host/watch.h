/* Notices edited files. Folders are watched, not files: editors replace or truncate what they
   save. */
#ifndef JOX_HOST_WATCH_H
#define JOX_HOST_WATCH_H

#include <stdbool.h>
#include <stddef.h>

typedef struct JoxWatch JoxWatch;

/* NULL with errno set if the system refuses. */
JoxWatch *jox_watch_create(void);
/* Watches a file by its path; its present content is the one already known. False with errno. */
bool jox_watch_add(JoxWatch *watch, const char *path);
/* Does not block. Calls `changed` for each watched file whose content differs from the one last
   known, once its folder has been quiet for 30 ms. A file that is missing or half-way replaced is
   looked at again when its folder moves next. */
typedef void JoxChanged(void *context, const char *path);
void jox_watch_poll(JoxWatch *watch, JoxChanged *changed, void *context);
void jox_watch_free(JoxWatch *watch);

#endif
