#include "view/access.h"

#include "base/format/path.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/random.h>
#include <sys/stat.h>

bool jox_access_make_token(char token[33]) {
    unsigned char bits[16];
    if (getrandom(bits, sizeof bits, 0) != (ssize_t)sizeof bits)
        return false;
    for (size_t i = 0; i < sizeof bits; i++)
        snprintf(token + 2 * i, 3, "%02x", bits[i]);
    return true;
}

bool jox_access_is_token(const char *given, const char *token) {
    size_t n = strlen(token), length = strlen(given);
    volatile unsigned char difference = length != n;
    for (size_t i = 0; i < n; i++)
        difference |= (unsigned char)(token[i] ^ (i < length ? given[i] : 0));
    return difference == 0;
}

const char *jox_access_skip_token(const char *path, const char *token) {
    char first[33];
    const size_t n = sizeof first - 1;
    if (*path != '/' || strlen(path) < n + 2 || path[n + 1] != '/')
        return NULL;
    memcpy(first, path + 1, n);
    first[n] = 0;
    return jox_access_is_token(first, token) ? path + 1 + n : NULL;
}

bool jox_access_sources_are_clean(const char *sources, size_t capacity) {
    static const char *const QUOTED[] = {"'self'", "'none'"};
    const size_t length = strlen(sources);
    if (length == 0 || length >= capacity)
        return false;
    while (*sources) {
        sources += strspn(sources, " ");
        size_t n = strcspn(sources, " ");
        bool clean = strspn(sources, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                     "0123456789.-_:/*") >= n;
        for (int q = 0; q < 2; q++)
            clean |= strlen(QUOTED[q]) == n && strncmp(sources, QUOTED[q], n) == 0;
        if (!clean)
            return false;
        sources += n;
    }
    return true;
}

bool jox_access_find_cookie(const char *header, const char *name, char *value, size_t capacity) {
    size_t n = strlen(name);
    while (*header) {
        header += strspn(header, " ;");
        size_t length = strcspn(header, ";");
        if (length > n && header[n] == '=' && strncmp(header, name, n) == 0) {
            size_t size = length - n - 1;
            if (size >= capacity)
                return false;
            memcpy(value, header + n + 1, size);
            value[size] = 0;
            return true;
        }
        header += length;
    }
    return false;
}

bool jox_access_is_local_host(const char *host, int port) {
    static const char *const NAMES[] = {"127.0.0.1", "localhost", "[::1]"};
    char full[64];
    for (int i = 0; i < 3; i++) {
        snprintf(full, sizeof full, "%s:%d", NAMES[i], port);
        if (strcasecmp(host, full) == 0 || (port == 80 && strcasecmp(host, NAMES[i]) == 0))
            return true;
    }
    return false;
}

bool jox_access_host_is_clean(const char *host) {
    size_t n = strspn(host, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_:[]");
    return n > 0 && n < 200 && host[n] == 0;
}

bool jox_access_is_same_origin(const char *origin, const char *host) {
    static const char SCHEME[] = "http://";
    size_t n = sizeof SCHEME - 1;
    return strncasecmp(origin, SCHEME, n) == 0 && strcasecmp(origin + n, host) == 0;
}

bool jox_access_find_file(const char *folder, const char *path, char file[4096]) {
    char whole[PATH_MAX];
    struct stat info;
    if (*path != '/' || strstr(path, "/.") || strchr(path, '\\') ||
        snprintf(whole, sizeof whole, "%s%s", folder, path) >= (int)sizeof whole)
        return false;
    char *real = jox_path_real_below(whole, folder);
    bool inside = real && strlen(real) < 4096 && stat(real, &info) == 0 && S_ISREG(info.st_mode);
    if (inside)
        strcpy(file, real);
    free(real);
    return inside;
}

const char *jox_access_content_type(const char *path) {
    static const char *const TYPES[][2] = {
        {".html", "text/html; charset=utf-8"},
        {".css", "text/css; charset=utf-8"},
        {".js", "text/javascript; charset=utf-8"},
        {".mjs", "text/javascript; charset=utf-8"},
        {".json", "application/json"},
        {".svg", "image/svg+xml"},
        {".png", "image/png"},
        {".ico", "image/x-icon"},
        {".woff2", "font/woff2"},
    };
    size_t n = strlen(path);
    for (size_t i = 0; i < sizeof TYPES / sizeof *TYPES; i++) {
        size_t m = strlen(TYPES[i][0]);
        if (n > m && strcmp(path + n - m, TYPES[i][0]) == 0)
            return TYPES[i][1];
    }
    return NULL;
}
