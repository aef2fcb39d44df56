/* Who may have what: tokens, names of hosts, files below a folder. No network here. */
#ifndef JOX_VIEW_ACCESS_H
#define JOX_VIEW_ACCESS_H

#include <stdbool.h>
#include <stddef.h>

/* 128 random bits as 32 hexadecimal digits; false if the system has none. */
bool jox_access_token(char token[33]);
/* In the same time wherever they differ. */
bool jox_access_same(const char *given, const char *token);
/* The value of a cookie within the header's text; false if it is not there or does not fit. */
bool jox_access_cookie(const char *header, const char *name, char *value, size_t capacity);
/* Whether a Host header names this machine by a loopback name, with our port. */
bool jox_access_host(const char *host, int port);
/* Whether a Host header has only what such a header may have: it is repeated in an answer. */
bool jox_access_host_is_clean(const char *host);
/* Whether the page that opens a socket was served under the same name as the socket's. */
bool jox_access_origin(const char *origin, const char *host);
/* The file for a path within a folder: every link followed, inside the folder, an ordinary file,
   no part of its name hidden. */
bool jox_access_file(const char *folder, const char *path, char file[4096]);
/* The content type by the end of the name, or NULL: such files are not served. */
const char *jox_access_type(const char *path);

#endif
