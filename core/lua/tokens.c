/* Places in the source: Lua tells lines only, so that columns come from a scan of our own. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "lua/internal.h"

typedef struct Scan {
    JoxSource *source;
    const char *at, *end, *line_start;
    int line;
} Scan;

static void add_token(Scan *s, JoxTokenKind kind, const char *text, size_t length, const char *from,
                      int line, const char *line_start) {
    JoxSource *source = s->source;
    JOX_RESERVE(source->tokens, source->token_capacity, source->token_count + 1);
    int column = (int)(from - line_start) + 1;
    source->tokens[source->token_count++] =
        (JoxToken){kind, text, (uint32_t)length, line, column, column + (int)(s->at - from), false};
}

static void newline(Scan *s) {
    s->line++;
    s->line_start = s->at;
}

/* At "[": the number of "=" of a long bracket, or -1. */
static int long_bracket(const Scan *s) {
    const char *p = s->at + 1;
    while (p < s->end && *p == '=')
        p++;
    return p < s->end && *p == '[' ? (int)(p - s->at) - 1 : -1;
}

/* Skips a long bracket with `level` signs; returns the length of what is inside. */
static size_t skip_long(Scan *s, int level, const char **inside) {
    s->at += level + 2;
    *inside = s->at;
    while (s->at < s->end) {
        if (*s->at == ']' && s->at + level + 1 < s->end && s->at[level + 1] == ']') {
            int n = 0;
            while (n < level && s->at[1 + n] == '=')
                n++;
            if (n == level) {
                size_t length = (size_t)(s->at - *inside);
                s->at += level + 2;
                return length;
            }
        }
        if (*s->at++ == '\n')
            newline(s);
    }
    return (size_t)(s->at - *inside);
}

static void skip_comment(Scan *s) {
    s->at += 2;
    int level = s->at < s->end && *s->at == '[' ? long_bracket(s) : -1;
    const char *inside;
    if (level >= 0)
        skip_long(s, level, &inside);
    else
        while (s->at < s->end && *s->at != '\n')
            s->at++;
}

static void scan_string(Scan *s) {
    const char *from = s->at, *line_start = s->line_start;
    int line = s->line;
    char quote = *s->at++;
    while (s->at < s->end && *s->at != quote && *s->at != '\n')
        s->at += *s->at == '\\' && s->at + 1 < s->end && s->at[1] != '\n' ? 2 : 1;
    size_t length = (size_t)(s->at - from) - 1;
    if (s->at < s->end && *s->at == quote)
        s->at++;
    add_token(s, JOX_TOKEN_STRING, from + 1, length, from, line, line_start);
}

static void scan_one(Scan *s) {
    const char *from = s->at, *line_start = s->line_start, *inside;
    int line = s->line, level;
    unsigned char c = (unsigned char)*s->at;
    if (isalpha(c) || c == '_') {
        while (s->at < s->end && (isalnum((unsigned char)*s->at) || *s->at == '_'))
            s->at++;
        add_token(s, JOX_TOKEN_NAME, from, (size_t)(s->at - from), from, line, line_start);
    } else if (isdigit(c)) {
        while (s->at < s->end && (isalnum((unsigned char)*s->at) || *s->at == '.'))
            s->at++;
        add_token(s, JOX_TOKEN_NUMBER, from, (size_t)(s->at - from), from, line, line_start);
    } else if (c == '"' || c == '\'') {
        scan_string(s);
    } else if (c == '[' && (level = long_bracket(s)) >= 0) {
        size_t length = skip_long(s, level, &inside);
        add_token(s, JOX_TOKEN_STRING, inside, length, from, line, line_start);
    } else {
        static const char *const PAIRS[] = {"==", "~=", "<=", ">=", "..", "//", "::", "<<", ">>"};
        s->at++;
        for (size_t i = 0; s->at < s->end && i < sizeof PAIRS / sizeof *PAIRS; i++)
            if (c == PAIRS[i][0] && *s->at == PAIRS[i][1]) {
                s->at++;
                break;
            }
        add_token(s, JOX_TOKEN_SYMBOL, from, (size_t)(s->at - from), from, line, line_start);
    }
}

/* Deeper or shallower by what a token opens or closes. */
static int depth_change(const JoxToken *t) {
    static const char *const OPEN[] = {"{", "(", "[", "function", "if", "do", "repeat"};
    static const char *const CLOSE[] = {"}", ")", "]", "end", "until"};
    for (size_t i = 0; i < sizeof OPEN / sizeof *OPEN; i++)
        if (jox_token_is(t, OPEN[i]))
            return 1;
    for (size_t i = 0; i < sizeof CLOSE / sizeof *CLOSE; i++)
        if (jox_token_is(t, CLOSE[i]))
            return -1;
    return 0;
}

static void add_path(JoxSource *source, const char *path, size_t key, size_t first, size_t last) {
    JOX_RESERVE(source->paths, source->path_capacity, source->path_count + 1);
    source->paths[source->path_count++] =
        (JoxPath){jox_strdup(path), (uint32_t)key, (uint32_t)first, (uint32_t)last};
}

/* Reads the table constructor that opens at token `at`; returns the token after it. */
static size_t read_table(JoxSource *source, size_t at, const char *prefix, int level) {
    const JoxToken *t = source->tokens;
    size_t count = source->token_count;
    int item = 0;
    for (at++; at < count && !jox_token_is(&t[at], "}");) {
        char path[256];
        size_t key = at, value = at;
        if (at + 1 < count && t[at].kind == JOX_TOKEN_NAME && jox_token_is(&t[at + 1], "=")) {
            snprintf(path, sizeof path, "%s%s%.*s", prefix, *prefix ? "." : "", (int)t[at].length,
                     t[at].text);
            value = at + 2;
        } else if (at + 4 < count && jox_token_is(&t[at], "[") &&
                   t[at + 1].kind == JOX_TOKEN_STRING && jox_token_is(&t[at + 3], "=")) {
            snprintf(path, sizeof path, "%s%s%.*s", prefix, *prefix ? "." : "",
                     (int)t[at + 1].length, t[at + 1].text);
            key = at + 1;
            value = at + 4;
        } else {
            snprintf(path, sizeof path, "%s%s%d", prefix, *prefix ? "." : "", ++item);
        }
        size_t end = value;
        for (int depth = 0; end < count; end++) {
            if (depth == 0 && (jox_token_is(&t[end], ",") || jox_token_is(&t[end], ";") ||
                               jox_token_is(&t[end], "}")))
                break;
            depth += depth_change(&t[end]);
        }
        add_path(source, path, key, value, end);
        if (value < count && jox_token_is(&t[value], "{") && level < 6)
            read_table(source, value, path, level + 1);
        at = end < count && jox_token_is(&t[end], "}") ? end : end + 1;
    }
    return at + 1;
}

/* patch "NAME" { or replace "NAME" { */
static bool begins_patch(const JoxSource *source, size_t i) {
    const JoxToken *t = &source->tokens[i];
    return i + 3 < source->token_count &&
           (jox_token_is(t, "patch") || jox_token_is(t, "replace")) &&
           t[1].kind == JOX_TOKEN_STRING && jox_token_is(&t[2], "{");
}

void jox_source_scan(JoxSource *source) {
    Scan s = {source, source->text, source->text + source->length, source->text, 1};
    while (s.at < s.end) {
        if (*s.at == '\n') {
            s.at++;
            newline(&s);
        } else if (isspace((unsigned char)*s.at)) {
            s.at++;
        } else if (*s.at == '-' && s.at + 1 < s.end && s.at[1] == '-') {
            skip_comment(&s);
        } else {
            scan_one(&s);
        }
    }
    for (size_t i = source->token_count; i-- > 0;) /* the one that the file ends with */
        if (i + 2 < source->token_count && ((jox_token_is(&source->tokens[i], "machine") &&
                                             jox_token_is(&source->tokens[i + 1], "{")) ||
                                            begins_patch(source, i))) {
            source->patches = begins_patch(source, i) ? &source->tokens[i + 1] : NULL;
            read_table(source, i + (source->patches ? 2 : 1), "", 0);
            break;
        }
}

void jox_source_free(JoxSource *source) {
    for (size_t i = 0; i < source->path_count; i++)
        jox_free(source->paths[i].path);
    jox_source_scopes_free(source->scopes);
    jox_free(source->paths);
    jox_free(source->tokens);
    jox_free(source->text);
    jox_free((char *)source->path);
}

JoxToken *jox_source_find(JoxSource *source, int line, const char *name) {
    JoxToken *any = NULL;
    size_t low = 0, high = source->token_count, length = strlen(name);
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (source->tokens[middle].line < line)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < source->token_count && source->tokens[low].line == line; low++) {
        JoxToken *t = &source->tokens[low];
        if (t->length != length || memcmp(t->text, name, length) != 0)
            continue;
        bool key = low + 1 < source->token_count && jox_token_is(t + 1, "="); /* not a use */
        if (!t->used && !key) {
            t->used = true;
            return t;
        }
        any = t;
    }
    return any;
}

const JoxPath *jox_source_path_find(const JoxSource *source, const char *path) {
    for (size_t i = 0; i < source->path_count; i++)
        if (strcmp(source->paths[i].path, path) == 0)
            return &source->paths[i];
    return NULL;
}

JoxPosition jox_source_path(const JoxSource *source, const char *path) {
    char shorter[256];
    snprintf(shorter, sizeof shorter, "%s", path);
    for (;;) {
        const JoxPath *found = jox_source_path_find(source, shorter);
        if (found && found->key < source->token_count) {
            const JoxToken *t = &source->tokens[found->key];
            return (JoxPosition){source->path, t->line, t->column, t->end_column};
        }
        char *dot = strrchr(shorter, '.');
        if (!dot)
            return (JoxPosition){source->path, 0, 0, 0};
        *dot = 0;
    }
}
