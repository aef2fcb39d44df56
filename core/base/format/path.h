/* Paths of files, and where a file is that another one names. */
#ifndef JOX_BASE_FORMAT_PATH_H
#define JOX_BASE_FORMAT_PATH_H

#include <stdbool.h>
#include <stddef.h>

enum { JOX_LONGEST_PATH = 1024 }; /* bytes, with the end */

/* Bytes of a path's folder, with its last '/'; 0 where it has none. */
size_t jox_path_folder(const char *path);
/* What follows the folder, and how much of that is before the first '.'. */
const char *jox_path_name(const char *path);
size_t jox_path_stem(const char *name);

/* The file that `file` names as `name`: in its folder, unless `name` begins with '/'. False, and a
   path cut short, where it is too long. */
bool jox_path_beside(const char *file, const char *name, char path[JOX_LONGEST_PATH]);

/* Looks for the file that `file` names as `name`, whose ending (as ".lua") may be left out, in the
   folders listed, up to NULL: each ends with '/', or is "" (that of `file`), and is relative to the
   folder of `file` unless it begins with '/'. False if there is no such file. */
bool jox_path_find(const char *file, const char *name, const char *ending,
                   const char *const *folders, char path[JOX_LONGEST_PATH]);

/* Whether two paths are equal, or lead to one file or folder that is there. */
bool jox_path_same(const char *a, const char *b);
/* Takes "folder/.." and "." out of a path, in place, where that is the same file: two ways to write
   a file's path become one. */
void jox_path_clean(char *path);
/* Whether a file, with every link on its way followed, lies below a folder; both must be there. */
bool jox_path_below(const char *path, const char *folder);
/* As jox_path_below; the path without links and "..", freed by free(). NULL if it lies elsewhere.
 */
char *jox_path_real_below(const char *path, const char *folder);

/* Whether a file that `file` names is there and yet lies neither beside `file` nor below its
   folder, links followed: what a stranger's scene may not have shown. */
bool jox_path_is_foreign(const char *file, const char *path);

#endif
