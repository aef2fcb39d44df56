/* Splits Lua source into tokens, to know columns, as Lua reports lines only. */
#include <ctype.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/vm/source.h"

typedef struct Scan {
    JoxSource *source;
    const char *at, *end, *line_start;
    int line;
    /* The last place whose column was counted, on the line that begins at `counted_line`. */
    const char *counted_line, *counted;
    int column;
} Scan;

/* Returns the column of a place on a line. Places come in order: only what lies between two of a
   line is counted. */
static int find_column(Scan *s, const char *place, const char *line_start) {
    if (s->counted_line != line_start) {
        s->counted_line = s->counted = line_start;
        s->column = 1;
    }
    JOX_ASSERT(place >= s->counted);
    s->column += (int)jox_count_characters(s->counted, (size_t)(place - s->counted));
    s->counted = place;
    return s->column;
}

static void add_token(Scan *s, JoxTokenKind kind, const char *text, size_t length, const char *from,
                      int line, const char *line_start) {
    JOX_ASSERT(from >= line_start && s->at <= s->end && line >= 1);
    JoxSource *source = s->source;
    JOX_RESERVE(source->tokens, source->token_capacity, source->token_count + 1);
    const int column = find_column(s, from, line_start);
    const int width = (int)jox_count_characters(from, (size_t)(s->at - from));
    source->tokens[source->token_count++] = (JoxToken){.kind = kind,
                                                       .text = text,
                                                       .length = (uint32_t)length,
                                                       .line = line,
                                                       .column = column,
                                                       .end_column = column + width};
}

static void count_newline(Scan *s) {
    s->line++;
    s->line_start = s->at;
}

/* At "[": returns the number of "=" of a long bracket, or -1 if it is none. */
static int get_bracket_level(const Scan *s) {
    const char *p = s->at + 1;
    while (p < s->end && *p == '=')
        p++;
    return p < s->end && *p == '[' ? (int)(p - s->at) - 1 : -1;
}

/* Skips a long bracket with `level` equal signs; returns the length of its contents and their
   start. */
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
            count_newline(s);
    }
    return (size_t)(s->at - *inside);
}

static void skip_comment(Scan *s) {
    s->at += 2;
    int level = s->at < s->end && *s->at == '[' ? get_bracket_level(s) : -1;
    const char *inside;
    if (level >= 0)
        skip_long(s, level, &inside);
    else
        while (s->at < s->end && *s->at != '\n')
            s->at++;
}

/* Skips a backslash and what it escapes: a character, the end of a line, or with `\z` all white
   space. */
static void skip_escape(Scan *s) {
    s->at++;
    if (s->at < s->end && *s->at == 'z') {
        for (s->at++; s->at < s->end && isspace((unsigned char)*s->at);)
            if (*s->at++ == '\n')
                count_newline(s);
        return;
    }
    if (s->at + 1 < s->end && s->at[0] == '\r' && s->at[1] == '\n')
        s->at++;
    if (s->at < s->end && *s->at++ == '\n')
        count_newline(s);
}

static void scan_string(Scan *s) {
    const char *from = s->at, *line_start = s->line_start;
    int line = s->line;
    char quote = *s->at++;
    while (s->at < s->end && *s->at != quote && *s->at != '\n') {
        if (*s->at == '\\')
            skip_escape(s);
        else
            s->at++;
    }
    size_t length = (size_t)(s->at - from) - 1;
    if (s->at < s->end && *s->at == quote)
        s->at++;
    add_token(s, JOX_TOKEN_STRING, from + 1, length, from, line, line_start);
}

static void skip_number(Scan *s) {
    const bool hex = *s->at == '0' && s->at + 1 < s->end && (s->at[1] | 32) == 'x';
    for (s->at++; s->at < s->end; s->at++) {
        const char before = (char)(s->at[-1] | 32);
        const bool exponent = before == (hex ? 'p' : 'e') && (*s->at == '+' || *s->at == '-');
        if (!isalnum((unsigned char)*s->at) && *s->at != '.' && !exponent)
            return;
    }
}

static void scan_one(Scan *s) {
    const char *from = s->at, *line_start = s->line_start, *inside;
    int line = s->line, level;
    unsigned char c = (unsigned char)*s->at;
    if (isalpha(c) || c == '_') {
        while (s->at < s->end && (isalnum((unsigned char)*s->at) || *s->at == '_'))
            s->at++;
        add_token(s, JOX_TOKEN_NAME, from, (size_t)(s->at - from), from, line, line_start);
    } else if (isdigit(c) || (c == '.' && s->at + 1 < s->end && isdigit((unsigned char)s->at[1]))) {
        skip_number(s);
        add_token(s, JOX_TOKEN_NUMBER, from, (size_t)(s->at - from), from, line, line_start);
    } else if (c == '"' || c == '\'') {
        scan_string(s);
    } else if (c == '[' && (level = get_bracket_level(s)) >= 0) {
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
        if (c == '.' && s->at - from == 2 && s->at < s->end && *s->at == '.')
            s->at++; /* ... */
        add_token(s, JOX_TOKEN_SYMBOL, from, (size_t)(s->at - from), from, line, line_start);
    }
}

void jox_source_scan(JoxSource *source) {
    Scan s = {.source = source,
              .at = source->text,
              .end = source->text + source->length,
              .line_start = source->text,
              .line = 1};
    while (s.at < s.end) {
        if (*s.at == '\n') {
            s.at++;
            count_newline(&s);
        } else if (isspace((unsigned char)*s.at)) {
            s.at++;
        } else if (*s.at == '-' && s.at + 1 < s.end && s.at[1] == '-') {
            skip_comment(&s);
        } else {
            scan_one(&s);
        }
    }
}

void jox_source_free(JoxSource *source) {
    JOX_ASSERT(!source->outline);
    jox_free(source->tokens);
    jox_free(source->text);
    jox_free(source->path);
}

/* Returns the number of the first token on a line, or on the first line after it that has any. */
static size_t find_line(const JoxSource *source, int line) {
    size_t low = 0, high = source->token_count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (source->tokens[middle].line < line)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

JoxToken *jox_source_find_called(JoxSource *source, int line, const char *name) {
    JoxToken *last = NULL;
    for (size_t n = find_line(source, line);
         n < source->token_count && source->tokens[n].line == line; n++) {
        JoxToken *t = &source->tokens[n];
        if (t->used && !t->called && jox_token_is(t, name))
            last = t;
    }
    if (last)
        last->called = true;
    return last;
}

JoxToken *jox_source_find(JoxSource *source, int line, const char *name) {
    JoxToken *any = NULL;
    for (size_t n = find_line(source, line);
         n < source->token_count && source->tokens[n].line == line; n++) {
        JoxToken *t = &source->tokens[n];
        if (!jox_token_says(t, name))
            continue;
        bool key = n + 1 < source->token_count &&
                   jox_token_is(t + 1, "="); /* a key of a table, not a use of the word */
        if (!t->used && !key) {
            t->used = true;
            return t;
        }
        any = t;
    }
    return any;
}
