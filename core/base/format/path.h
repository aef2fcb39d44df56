/* Paths: their parts, and the search for a file that another file names. */
#ifndef JOX_BASE_FORMAT_PATH_H
#define JOX_BASE_FORMAT_PATH_H

#include <stdbool.h>
#include <stddef.h>

enum { JOX_LONGEST_PATH = 1024 }; /* bytes, with the end */

/* Returns the length of a path's folder with its last '/', bytes; 0 if it has none. */
size_t jox_path_folder(const char *path);
/* Returns the part of a path behind its folder. */
const char *jox_path_name(const char *path);
/* Returns the length of a file's name up to its first '.', bytes. */
size_t jox_path_stem(const char *name);

/* Writes the path of the file that `file` names as `name`: relative to the folder of `file`, unless
   `name` begins with '/'. False, with a cut path, if it is too long. */
bool jox_path_beside(const char *file, const char *name, char path[JOX_LONGEST_PATH]);

/* Searches the file that `file` names as `name`, with or without `ending` (as ".lua"), in a list of
   folders up to a NULL. Each ends with '/' or is "", and is relative to the folder of `file` unless
   it begins with '/'. False if there is no such file. */
bool jox_path_find(const char *file, const char *name, const char *ending,
                   const char *const *folders, char path[JOX_LONGEST_PATH]);

/* Whether two paths are equal, or lead to the same existing file or folder. */
bool jox_path_same(const char *a, const char *b);
/* Removes "." and "folder/.." from a path, in place, if the result leads to the same file, so that
   a file has one path. */
void jox_path_clean(char *path);
/* As realpath; also of a path in a zip archive. For free(). */
char *jox_path_real(const char *path);
/* Whether a file, with all links followed, lies below a folder; both must exist. */
bool jox_path_below(const char *path, const char *folder);
/* As jox_path_below; returns the path without links and "..", for free(). NULL if the file lies
   elsewhere. */
char *jox_path_real_below(const char *path, const char *folder);

/* Whether a file that `file` names exists outside the folder of `file`, with links followed. The
   content of such a file must not appear in messages about a stranger's scene. */
bool jox_path_is_foreign(const char *file, const char *path);

#endif
