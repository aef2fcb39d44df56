/* Which parts of a running scene are made of which files, and which files have changed and are not
   live yet. Parts that share a changed file go live together or not at all. */
#ifndef JOX_RUN_WATCH_CHANGES_H
#define JOX_RUN_WATCH_CHANGES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "machine/run.h"

/* Parts are machines by their index, the scene's specification, and the mod.yaml files of its mods.
 */
enum { JOX_PART_SCENE = JOX_MOST_MACHINES, JOX_PART_MODS, JOX_PARTS };

typedef struct JoxFiles {
    char **paths;
    uint32_t count;
    size_t capacity;
} JoxFiles;

typedef struct JoxChangedFile {
    char *path;
    double written; /* seconds since 1970 */
    bool fresh;     /* not tried since it changed */
} JoxChangedFile;

/* Adds a path, copied, unless it is there. */
void jox_files_add(JoxFiles *files, const char *path);
void jox_files_free(JoxFiles *files);

/* Zero-initialise. */
typedef struct JoxChanges {
    JoxFiles made_of[JOX_PARTS];
    JoxChangedFile *files;
    uint32_t count;
    size_t capacity;
} JoxChanges;

/* A part uses a file too. */
void jox_changes_uses(JoxChanges *changes, uint32_t part, const char *path);
void jox_changes_file(JoxChanges *changes, const char *path, double written);
/* Whether a part uses a file that has changed and is not live. */
bool jox_changes_has(const JoxChanges *changes, uint32_t part, const char *path);
/* The file is live as it is: it has not changed. */
void jox_changes_drop(JoxChanges *changes, const char *path);
/* Whether a file has changed that was not tried yet. */
bool jox_changes_fresh(const JoxChanges *changes);
/* The next parts to try together: all that hang together by files that are not live, one of which
   is fresh, and when the last of those was written. False if there are none. */
bool jox_changes_next(JoxChanges *changes, bool parts[JOX_PARTS], double *written);
/* The parts that were tried are live: what they are made of is told anew by jox_changes_uses. Parts
   that could not go live are simply left as they are. */
void jox_changes_live(JoxChanges *changes, const bool parts[JOX_PARTS]);
void jox_changes_free(JoxChanges *changes);

#endif
