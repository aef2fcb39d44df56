/* What the files of the parser share: the place in the tokens, and the tree that is made. */
#ifndef JOX_LUA_VM_PARSE_H
#define JOX_LUA_VM_PARSE_H

#include "lua/vm/syntax.h"

enum { JOX_PARSE_LEVELS = 400 };

typedef struct JoxParser JoxParser;
struct JoxParser {
    JoxSyntax *tree;
    const JoxToken *tokens;
    size_t at, count;
    size_t returned;  /* where the last `return` that was read ends */
    int32_t *visible; /* variables, innermost last */
    size_t visible_count, visible_capacity;
    int32_t function; /* being read */
    uint32_t looks;
    int level;
    bool failed;
    void (*block)(JoxParser *p); /* reads the statements of a function */
};

/* ---- parse.c: tokens, trees and variables ---- */

bool jox_parse_is(const JoxParser *p, const char *text);
/* Passes the token where it is this one. */
bool jox_parse_accept(JoxParser *p, const char *text);
void jox_parse_expect(JoxParser *p, const char *text);
bool jox_parse_is_name(const JoxParser *p);
/* The token of a name, which is passed. */
uint32_t jox_parse_name(JoxParser *p);
int32_t jox_parse_add(JoxParser *p, JoxTreeKind kind, uint32_t at);
JoxTree *jox_parse_tree(JoxParser *p, int32_t tree);
void jox_parse_bind(JoxParser *p, JoxTreeBindKind kind, int32_t target, int32_t value,
                    bool declares);
int32_t jox_parse_declare(JoxParser *p, uint32_t at, int32_t parameter);
/* Makes a variable visible from here on to the end of the block. */
void jox_parse_show(JoxParser *p, int32_t variable);
/* A NAME of a variable that is declared here. */
int32_t jox_parse_declared(JoxParser *p, int32_t variable);
/* A NAME of whatever the token means here. */
int32_t jox_parse_used(JoxParser *p, uint32_t at);

/* ---- parse_expression.c ---- */

/* An expression whose operators bind more tightly than `limit`; 0: a whole one. */
int32_t jox_parse_expression(JoxParser *p, int limit);
/* Reads `a, b, c` into a list; *last is its last item. Returns the first. */
int32_t jox_parse_list(JoxParser *p, int32_t *last);
/* What may stand before `.`, `[`, `:` and arguments, with all of those that follow. */
int32_t jox_parse_suffixed(JoxParser *p);
/* At the token after `function NAME`: parameters and body; returns the FUNCTION. `at`: its token.
 */
int32_t jox_parse_function(JoxParser *p, uint32_t at, bool method);

#endif
