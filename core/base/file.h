/* Files and folders, held (mem.h) while they are open. */
#ifndef JOX_BASE_FILE_H
#define JOX_BASE_FILE_H

#include <stdbool.h>
#include <stdio.h>

/* As fopen and fclose. */
FILE *jox_file_open(const char *path, const char *mode);
int jox_file_close(FILE *file);

/* Names of what lies in a folder, but "." and "..", in the order of their bytes, up to NULL; the
   caller frees the whole by jox_free. `hidden`: with those that begin with a dot. NULL with errno
   where the folder cannot be read. */
char **jox_folder_names(const char *path, bool hidden);

#endif
