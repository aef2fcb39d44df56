/* Files and folders, held (mem.h) while they are open. */
#ifndef JOX_BASE_FILE_H
#define JOX_BASE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* As fopen, of modes that read, write or append; but nothing is waited for: a pipe that nobody
   reads is not opened for writing, and only regular files are opened for reading. A file has one
   writer at a time: errno is EBUSY for a second one. */
FILE *jox_file_open(const char *path, const char *mode);
/* Whether a file of that path can be written, else errno; it is left as it is, or not there. */
bool jox_file_can_be_written(const char *path);
/* Opens a file to be written whole: until it is closed it is named PATH.part, and what was at the
   path stays, and its mode with it as far as the process's mask allows; but its owner may write it.
   Written in place where that is no regular file. */
FILE *jox_file_replace(const char *path);
/* Closes a file that is not whole, and removes it. */
int jox_file_drop(FILE *file);
/* As fclose; what could not be written whole is removed, and takes no name. */
int jox_file_close(FILE *file);
/* Whether an open file still has that name: not where it was removed, or replaced by another. */
bool jox_file_has_name(FILE *file, const char *path);
/* Claims a folder for one run: NULL with errno EBUSY where another has it. Until it is closed. */
FILE *jox_folder_claim(const char *path);
/* Writes all bytes to a descriptor, of a pipe for instance; false with errno. */
bool jox_file_send(int descriptor, const void *bytes, size_t length);
/* What the errno of a file that was not opened, or not read, means. */
const char *jox_file_why(int number);

/* Names of what lies in a folder, but "." and "..", in the order of their bytes, up to NULL; the
   caller frees the whole by jox_free. `hidden`: with those that begin with a dot. NULL with errno
   where the folder cannot be read. */
char **jox_folder_names(const char *path, bool hidden);

#endif
