/* The parts of a running scene, the files that each is made of, and the files that have changed and
   are not live yet. Parts that share a changed file go live together or not at all. Used by
   run/reload_thread.c and run/reload_batch.c. */
#ifndef JOX_RUN_WATCH_CHANGES_H
#define JOX_RUN_WATCH_CHANGES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "machine/run.h"

/* The parts: the machines by their index, the scene's specification, the mod.yaml files of its
   mods. */
enum { JOX_PART_SCENE = JOX_MOST_MACHINES, JOX_PART_MODS, JOX_PARTS };

typedef struct JoxFiles {
    char **paths;
    uint32_t count;
    size_t capacity;
} JoxFiles;

typedef struct JoxChangedFile {
    char *path;
    double written; /* seconds since 1970 */
    bool untried;   /* loading was not tried since it changed */
} JoxChangedFile;

/* Adds a copy of a path, unless the list has it. */
void jox_files_add(JoxFiles *files, const char *path);
void jox_files_free(JoxFiles *files);

/* Zero-initialise. */
typedef struct JoxChanges {
    JoxFiles made_of[JOX_PARTS]; /* files that a part uses */
    JoxChangedFile *files;       /* changed and not live */
    uint32_t count;
    size_t capacity;
} JoxChanges;

/* Notes that a part uses a file. */
void jox_changes_add_use(JoxChanges *changes, uint32_t part, const char *path);
/* Whether any part uses a file. */
bool jox_changes_use(const JoxChanges *changes, const char *path);
/* Notes that a file has changed, and when it was written, s since 1970. */
void jox_changes_add_changed_file(JoxChanges *changes, const char *path, double written);
/* Whether a part uses a file that has changed and is not live. */
bool jox_changes_affects(const JoxChanges *changes, uint32_t part, const char *path);
/* Forgets that a file has changed: the text that is live is that of the disk. */
void jox_changes_forget_file(JoxChanges *changes, const char *path);
/* Whether loading was not tried yet for some changed file. */
bool jox_changes_has_untried(const JoxChanges *changes);
/* Finds the next parts to load together: all that are connected by changed files of which at least
   one is untried. Marks those files as tried, and returns when the last of them was written. False
   if there are none. */
bool jox_changes_take_next(JoxChanges *changes, bool parts[JOX_PARTS], double *written);
/* Forgets the changed files of parts that have gone live, and the files that those parts use; the
   caller adds the uses anew. Parts that failed to load are left as they are. */
void jox_changes_mark_live(JoxChanges *changes, const bool parts[JOX_PARTS]);
void jox_changes_free(JoxChanges *changes);

#endif
