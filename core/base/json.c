#include "base/json.h"

#include <ctype.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEEPEST = 16, LONGEST_PATH = 256 };

typedef struct Reader {
    const char *at;
    JoxJsonNumber *number;
    void *context;
    char path[LONGEST_PATH];
    bool bad;
} Reader;

static void skip_space(Reader *r) {
    while (isspace((unsigned char)*r->at))
        r->at++;
}

static bool take(Reader *r, char c) {
    skip_space(r);
    if (*r->at != c)
        return false;
    r->at++;
    return true;
}

/* Reads a string into `out` (escapes are kept as they are; paths need no more). */
static void read_string(Reader *r, char *out, size_t size) {
    size_t n = 0;
    if (!take(r, '"'))
        r->bad = true;
    while (!r->bad && *r->at && *r->at != '"') {
        if (*r->at == '\\' && r->at[1])
            r->at++;
        if (out && n + 1 < size)
            out[n++] = *r->at;
        r->at++;
    }
    if (out)
        out[n] = 0;
    r->bad |= *r->at != '"';
    r->at += *r->at == '"';
}

static void read_value(Reader *r, int depth) {
    size_t length = strlen(r->path);
    skip_space(r);
    if (depth > DEEPEST) {
        r->bad = true;
    } else if (*r->at == '{' || *r->at == '[') {
        bool map = *r->at++ == '{';
        char close = map ? '}' : ']', key[64];
        for (int item = 0; !r->bad && !take(r, close); item++) {
            if (item && !take(r, ','))
                r->bad = true;
            if (map)
                read_string(r, key, sizeof key);
            else
                snprintf(key, sizeof key, "%d", item);
            if (map && !take(r, ':'))
                r->bad = true;
            snprintf(r->path + length, sizeof r->path - length, "%s%s", length ? "." : "", key);
            if (!r->bad)
                read_value(r, depth + 1);
            r->path[length] = 0;
        }
    } else if (*r->at == '"') {
        read_string(r, NULL, 0);
    } else if (isalpha((unsigned char)*r->at)) { /* true, false, null */
        static const char *const WORDS[] = {"true", "false", "null"};
        size_t length_of = 0;
        while (isalpha((unsigned char)r->at[length_of]))
            length_of++;
        bool known = false;
        for (int w = 0; w < 3; w++)
            known |= strlen(WORDS[w]) == length_of && !strncmp(r->at, WORDS[w], length_of);
        r->bad |= !known;
        r->at += length_of;
    } else {
        char *end;
        double value = strtod(r->at, &end);
        r->bad |=
            end == r->at || end > r->at + strspn(r->at, "+-.0123456789eE") || !isfinite(value);
        r->at = end;
        if (!r->bad)
            r->number(r->context, r->path, value);
    }
}

bool jox_json_numbers(const char *text, JoxJsonNumber *number, void *context) {
    Reader r = {.at = text, .number = number, .context = context};
    skip_space(&r);
    r.bad |= *r.at != '{';
    if (!r.bad)
        read_value(&r, 0);
    skip_space(&r);
    return !r.bad && *r.at == 0;
}
