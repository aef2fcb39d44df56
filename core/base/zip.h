/* Zip archives as folders: behind a file X.zip a path goes on to a file in it,
   "mods/X.zip/mod.yaml". An archive is read into memory as a whole, within limits, and refused as a
   whole if any entry has a path that leads out of it, is a link or encrypted, or unpacks to far
   more than it takes. The readers of files and folders (text.h, file.h, overlay.h, format/path.h)
   come here for paths that the disk does not have. Built without libzip, there are no archives. */
#ifndef JOX_BASE_ZIP_H
#define JOX_BASE_ZIP_H

#include <stdbool.h>
#include <stddef.h>

/* Returns the length of the part of a path that names an archive on the disk, 0 if there is none;
 *inside is the rest, without '/' at either end: "" for the archive itself. */
size_t jox_zip_split(const char *path, const char **inside);
/* Reads the file at a path in an archive. To be freed with jox_free; NULL with errno: ENOENT,
   EFBIG, EBADMSG for an archive that is refused. */
char *jox_zip_read(const char *path, size_t limit, size_t *length);
/* Returns whether a path is a file in an archive, or an archive or a folder in one. */
bool jox_zip_is_file(const char *path);
bool jox_zip_is_folder(const char *path);
/* Lists the names in an archive or in a folder of it, as jox_folder_names; NULL with errno. */
char **jox_zip_names(const char *path, bool hidden);
/* Returns why the archive that a path leads into is refused, to be freed with jox_free; NULL if it
   is not, or if there is none. */
char *jox_zip_fault(const char *path);

#endif
