/* The text of a Lua file and its tokens: Lua tells lines only, columns come from a scan of our own.
 */
#ifndef JOX_LUA_VM_SOURCE_H
#define JOX_LUA_VM_SOURCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/format/diag.h"

typedef enum { JOX_TOKEN_NAME, JOX_TOKEN_STRING, JOX_TOKEN_NUMBER, JOX_TOKEN_SYMBOL } JoxTokenKind;
typedef struct JoxToken {
    JoxTokenKind kind;
    const char *text; /* in the source; a string's without its quotes */
    uint32_t length;
    int line, column, end_column; /* from 1; end_column: after the last character */
    bool used;                    /* a word of this name was already read here */
} JoxToken;

typedef struct JoxSource {
    char *path; /* as the user named it */
    char *text;
    size_t length;
    JoxToken *tokens;
    size_t token_count, token_capacity;
    void *outline; /* of the language above, which frees it; NULL: none */
} JoxSource;

/* Splits the source's text into tokens; never fails, for Lua's own parser reports what is
 * malformed.
 */
void jox_source_scan(JoxSource *source);
/* Frees what the source holds, but for the outline. */
void jox_source_free(JoxSource *source);
/* The first unused token of this name on a line, marked used; else any of them; else NULL. */
JoxToken *jox_source_find(JoxSource *source, int line, const char *name);

/* Whether a name or a string has this text. */
static inline bool jox_token_says(const JoxToken *token, const char *text) {
    size_t n = token->length;
    return __builtin_strlen(text) == n && __builtin_memcmp(token->text, text, n) == 0;
}

static inline bool jox_token_is(const JoxToken *token, const char *text) {
    return token->kind != JOX_TOKEN_STRING && jox_token_says(token, text);
}

#endif
