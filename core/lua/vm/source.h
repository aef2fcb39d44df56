/* The text of a Lua file and its tokens. Lua reports lines only; the tokens give the columns of
   messages. */
#ifndef JOX_LUA_VM_SOURCE_H
#define JOX_LUA_VM_SOURCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/format/diag.h"

typedef enum { JOX_TOKEN_NAME, JOX_TOKEN_STRING, JOX_TOKEN_NUMBER, JOX_TOKEN_SYMBOL } JoxTokenKind;
typedef struct JoxToken {
    JoxTokenKind kind;
    const char *text; /* points into the source; of a string, without its quotes */
    uint32_t length;
    int line, column, end_column; /* from 1; end_column is after the last character */
    bool used; /* jox_source_find has returned it: the next search on its line takes the next one */
    bool called; /* jox_source_find_called has returned it */
} JoxToken;

typedef struct JoxSource {
    char *path; /* as the user named it */
    char *text;
    size_t length;
    JoxToken *tokens;
    size_t token_count, token_capacity;
    void *outline; /* JoxOutline of lua/language, which frees it; NULL: none */
} JoxSource;

/* Splits the source's text into tokens. Never fails, as Lua's own parser reports syntax errors. */
void jox_source_scan(JoxSource *source);
/* Frees the text and tokens, but not the outline. */
void jox_source_free(JoxSource *source);
/* Returns the first token of this name on a line that is not used, and marks it used; if all are
   used, one of them; NULL if there is none. */
JoxToken *jox_source_find(JoxSource *source, int line, const char *name);
/* Returns the token of a function of this name on a line that is being called: of those that were
   looked up (jox_source_find) and not called yet the last, as calls are nested. NULL if there is
   none. Marks it as called. */
JoxToken *jox_source_find_called(JoxSource *source, int line, const char *name);

/* Returns whether a name or a string has this text. */
static inline bool jox_token_says(const JoxToken *token, const char *text) {
    size_t n = token->length;
    return __builtin_strlen(text) == n && __builtin_memcmp(token->text, text, n) == 0;
}

/* Returns whether two tokens have the same text. */
static inline bool jox_token_equals(const JoxToken *a, const JoxToken *b) {
    return a->length == b->length && __builtin_memcmp(a->text, b->text, a->length) == 0;
}

/* Returns whether a token other than a string has this text. */
static inline bool jox_token_is(const JoxToken *token, const char *text) {
    return token->kind != JOX_TOKEN_STRING && jox_token_says(token, text);
}

#endif
