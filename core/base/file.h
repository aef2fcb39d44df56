/* Files and folders. An open one is held by the heap in use (jox_heap_register), which closes it if
   memory runs out. */
#ifndef JOX_BASE_FILE_H
#define JOX_BASE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* As fopen with mode "r", "w" or "a" (and "b"), but never waits: a pipe without a reader is not
   opened for writing, and only regular files are opened for reading. A file has one writer at a
   time, by a lock: errno is EBUSY for a second one. NULL with errno. Close by jox_file_close. */
FILE *jox_file_open(const char *path, const char *mode);
/* Whether a file can be written at a path; false with errno. Neither changes nor leaves a file. */
bool jox_file_can_be_written(const char *path);
/* Opens a file that replaces the one at `path` when it is closed: until then it is named PATH.part,
   so that readers never see half a file. It takes over the old file's mode, as far as the process's
   mask allows and with write permission for its owner. A path that is no regular file is written in
   place. NULL with errno. */
FILE *jox_file_replace(const char *path);
/* Closes and removes a file of jox_file_replace that is not complete. Returns EOF. */
int jox_file_drop(FILE *file);
/* As fclose. A file of jox_file_replace takes its final name, or is removed if a write failed. */
int jox_file_close(FILE *file);
/* Whether `path` still names an open file: false if it was removed or replaced. */
bool jox_file_has_name(FILE *file, const char *path);
/* Locks a folder for one run until the result is closed; NULL with errno, EBUSY if another has
   it. */
FILE *jox_folder_claim(const char *path);
/* Writes all bytes to a descriptor, such as a pipe's; false with errno. */
bool jox_file_send(int descriptor, const void *bytes, size_t length);
/* Returns the meaning of the errno that the functions above set, as the end of a sentence. */
const char *jox_file_error_text(int number);
enum { JOX_UNREAD = 300 };
/* Returns why a file could not be read, by the error number of the attempt; of a file in a zip
   archive what is wrong there, in `text`. */
const char *jox_unread_text(const char *path, int number, char text[JOX_UNREAD]);

/* Whether a path is a folder, or a zip archive or a folder in one (zip.h). */
bool jox_is_folder(const char *path);
/* Lists the names in a folder, except "." and "..", sorted by bytes, up to a NULL. The caller frees
   the whole by one jox_free. `hidden`: includes names that begin with a dot. NULL with errno if the
   folder cannot be read. */
char **jox_folder_names(const char *path, bool hidden);

#endif
