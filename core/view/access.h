/* Checks of requests, without any network: tokens, names of hosts, and which files may be served.
   lws_http.c calls them for every request. */
#ifndef JOX_VIEW_ACCESS_H
#define JOX_VIEW_ACCESS_H

#include <stdbool.h>
#include <stddef.h>

/* Makes a token: 128 random bits as 32 hexadecimal digits. Returns false if the system has none. */
bool jox_access_make_token(char token[33]);
/* Compares a text with a token, in constant time, so that timing does not reveal the token. */
bool jox_access_is_token(const char *given, const char *token);
/* Returns the rest of a path behind "/TOKEN", which begins with '/'; NULL if the path has another
   first part. */
const char *jox_access_skip_token(const char *path, const char *token);
/* Returns whether a text names sources of Content-Security-Policy alone, separated by spaces, and
   fits `capacity` bytes; it becomes part of a header. */
bool jox_access_sources_are_clean(const char *sources, size_t capacity);
/* Finds the value of a cookie in the text of a Cookie header; false if it is missing or does not
   fit. */
bool jox_access_find_cookie(const char *header, const char *name, char *value, size_t capacity);
/* Returns whether a Host header is a loopback name of this machine with our port. */
bool jox_access_is_local_host(const char *host, int port);
/* Returns whether a Host header has only allowed characters; it is repeated in a header of the
   answer. */
bool jox_access_host_is_clean(const char *host);
/* Returns whether an Origin header names the same server as the Host header: the page that opens a
   socket must come from here. */
bool jox_access_is_same_origin(const char *origin, const char *host);
/* Finds the file for the path of a request. All links are followed; the file must be an ordinary
   one inside the folder, and no part of the path may be hidden. */
bool jox_access_find_file(const char *folder, const char *path, char file[4096]);
/* Returns the content type for the ending of a name; NULL if files with this ending are not
   served. */
const char *jox_access_content_type(const char *path);

#endif
