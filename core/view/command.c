#include "view/command.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Reader {
    const char *at;
    char *out, *end; /* free part of the store */
} Reader;

static void skip_space(Reader *r) {
    r->at += strspn(r->at, " \t\r\n");
}

static bool take(Reader *r, char c) {
    skip_space(r);
    if (*r->at != c)
        return false;
    r->at++;
    return true;
}

/* Four hexadecimal digits, or -1. */
static int32_t read_unit(Reader *r) {
    int32_t unit = 0;
    for (int i = 0; i < 4; i++) {
        char c = *r->at;
        int digit = c >= '0' && c <= '9'   ? c - '0'
                    : c >= 'a' && c <= 'f' ? c - 'a' + 10
                    : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                           : -1;
        if (digit < 0)
            return -1;
        unit = unit * 16 + digit;
        r->at++;
    }
    return unit;
}

/* A character as UTF-8; control characters and halves of pairs are refused. */
static bool put(Reader *r, int32_t c) {
    if (c < 32 || (c >= 127 && c < 160) || (c >= 0xD800 && c < 0xE000) || r->end - r->out < 5)
        return false;
    if (c < 0x80) {
        *r->out++ = (char)c;
    } else if (c < 0x800) {
        *r->out++ = (char)(0xC0 | c >> 6);
        *r->out++ = (char)(0x80 | (c & 63));
    } else if (c < 0x10000) {
        *r->out++ = (char)(0xE0 | c >> 12);
        *r->out++ = (char)(0x80 | (c >> 6 & 63));
        *r->out++ = (char)(0x80 | (c & 63));
    } else {
        *r->out++ = (char)(0xF0 | c >> 18);
        *r->out++ = (char)(0x80 | (c >> 12 & 63));
        *r->out++ = (char)(0x80 | (c >> 6 & 63));
        *r->out++ = (char)(0x80 | (c & 63));
    }
    return true;
}

static bool read_escape(Reader *r) {
    const char c = *r->at++;
    if (c == '"' || c == '\\' || c == '/')
        return put(r, c);
    if (c != 'u') /* the others are control characters, or nothing */
        return false;
    int32_t unit = read_unit(r);
    if (unit >= 0xD800 && unit < 0xDC00) {
        if (r->at[0] != '\\' || r->at[1] != 'u')
            return false;
        r->at += 2;
        int32_t low = read_unit(r);
        if (low < 0xDC00 || low >= 0xE000)
            return false;
        unit = 0x10000 + ((unit - 0xD800) << 10) + (low - 0xDC00);
    }
    return put(r, unit);
}

/* One character of UTF-8, or -1: no overlong forms, nothing beyond U+10FFFF. */
static int32_t read_character(Reader *r) {
    const unsigned char *s = (const unsigned char *)r->at;
    int more = s[0] < 0x80 ? 0 : s[0] < 0xC2 ? -1 : s[0] < 0xE0 ? 1 : s[0] < 0xF0 ? 2 : 3;
    static const int32_t LEAST[] = {0, 0x80, 0x800, 0x10000};
    int32_t c = more == 0 ? s[0] : s[0] & (more == 1 ? 31 : more == 2 ? 15 : 7);
    for (int i = 1; i <= more; i++) {
        if ((s[i] & 0xC0) != 0x80)
            return -1;
        c = c << 6 | (s[i] & 63);
    }
    if (more < 0 || s[0] > 0xF4 || c < LEAST[more] || c > 0x10FFFF)
        return -1;
    r->at += more + 1;
    return c;
}

static char *read_text(Reader *r) {
    char *begin = r->out;
    if (!take(r, '"'))
        return NULL;
    while (*r->at && *r->at != '"') {
        if (*r->at == '\\') {
            r->at++;
            if (!read_escape(r))
                return NULL;
        } else if (!put(r, read_character(r))) {
            return NULL;
        }
    }
    if (*r->at != '"' || r->out >= r->end)
        return NULL;
    r->at++;
    *r->out++ = 0;
    return begin;
}

/* A number as JSON has it, finite. */
static bool read_number(Reader *r, double *number) {
    size_t n = strspn(r->at, "+-.0123456789eE");
    const char *digits = r->at + (*r->at == '-');
    char *end;
    *number = strtod(r->at, &end);
    bool good = n > 0 && n < 64 && end == r->at + n && *digits >= '0' && *digits <= '9' &&
                isfinite(*number);
    r->at += n;
    return good;
}

static bool take_word(Reader *r, const char *word) {
    size_t n = strlen(word);
    if (strncmp(r->at, word, n) != 0)
        return false;
    r->at += n;
    return true;
}

static bool read_value(Reader *r, JoxCommand *command) {
    int i = command->count;
    command->values[i].text = NULL;
    skip_space(r);
    if (*r->at == '"') {
        command->values[i].kind = JOX_SAID_TEXT;
        command->values[i].text = read_text(r);
        return command->values[i].text != NULL;
    }
    bool yes = take_word(r, "true");
    if (yes || take_word(r, "false")) {
        command->values[i].kind = JOX_SAID_BOOL;
        command->values[i].number = yes;
        return true;
    }
    if (take_word(r, "null")) {
        command->values[i].kind = JOX_SAID_NULL;
        return true;
    }
    command->values[i].kind = JOX_SAID_NUMBER;
    return read_number(r, &command->values[i].number);
}

/* Index of a key, or -1. */
static int find(const JoxCommand *command, const char *key, JoxSaidKind kind) {
    for (int i = 0; i < command->count; i++)
        if (!strcmp(command->values[i].key, key))
            return command->values[i].kind == kind ? i : -1;
    return -1;
}

bool jox_command_read(const char *json, JoxCommand *command) {
    Reader r = {.at = json, .out = command->store, .end = command->store + sizeof command->store};
    command->count = 0;
    command->verb = NULL;
    if (!take(&r, '{'))
        return false;
    do {
        if (command->count == JOX_COMMAND_KEYS)
            return false;
        skip_space(&r);
        char *key = read_text(&r);
        command->values[command->count].key = key;
        if (!key || !take(&r, ':') || !read_value(&r, command))
            return false;
        command->count++;
    } while (take(&r, ','));
    bool closed = take(&r, '}');
    skip_space(&r);
    int verb = find(command, "do", JOX_SAID_TEXT);
    if (!closed || *r.at || verb < 0)
        return false;
    command->verb = command->values[verb].text;
    return true;
}

const char *jox_command_text(const JoxCommand *command, const char *key, const char *otherwise) {
    int i = find(command, key, JOX_SAID_TEXT);
    return i < 0 ? otherwise : command->values[i].text;
}

double jox_command_number(const JoxCommand *command, const char *key, double otherwise) {
    int i = find(command, key, JOX_SAID_NUMBER);
    return i < 0 ? otherwise : command->values[i].number;
}

bool jox_command_bool(const JoxCommand *command, const char *key, bool otherwise) {
    int i = find(command, key, JOX_SAID_BOOL);
    return i < 0 ? otherwise : command->values[i].number > 0.0;
}
