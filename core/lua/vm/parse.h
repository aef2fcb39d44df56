/* State and helpers of the parser, shared by syntax.c (statements), parse_expression.c
   (expressions) and parse.c (tokens, tree nodes, variables). jox_syntax_read is the way in. */
#ifndef JOX_LUA_VM_PARSE_H
#define JOX_LUA_VM_PARSE_H

#include "lua/vm/syntax.h"

enum { JOX_PARSE_LEVELS = 400 };

typedef struct JoxParser JoxParser;
struct JoxParser {
    JoxSyntax *tree;
    const JoxToken *tokens;
    size_t at, count; /* number of the next token; number of tokens */
    size_t returned;  /* token after the last `return` statement */
    int32_t *visible; /* variables in scope, innermost last */
    size_t visible_count, visible_capacity;
    int32_t function; /* number of the function that is parsed */
    uint32_t looks;   /* comparisons of names so far, which bound the work */
    int level;        /* depth of nesting */
    bool failed;
    void (*block)(JoxParser *p); /* parses the statements of a function's body; set by syntax.c,
                                    which parse_expression.c cannot call */
};

/* ---- parse.c: tokens, trees and variables ---- */

/* Returns whether the next token is `text`. */
bool jox_parse_is(const JoxParser *p, const char *text);
/* Passes the next token if it is `text`; returns whether it was. */
bool jox_parse_accept(JoxParser *p, const char *text);
/* Passes the next token, which must be `text`; else the parser fails. */
void jox_parse_expect(JoxParser *p, const char *text);
/* Returns whether the next token is a name and no keyword. */
bool jox_parse_is_name(const JoxParser *p);
/* Passes the next token, which must be a name; returns its number. */
uint32_t jox_parse_name(JoxParser *p);
/* Adds a tree node at token `at`; returns its number. */
int32_t jox_parse_add(JoxParser *p, JoxTreeKind kind, uint32_t at);
/* Returns a node; valid until the next one is added. */
JoxTree *jox_parse_tree(JoxParser *p, int32_t tree);
/* Records that a target is assigned or declared with a value. */
void jox_parse_bind(JoxParser *p, JoxTreeBindKind kind, int32_t target, int32_t value,
                    bool declares);
/* Adds a variable of the present function, not yet in scope; returns its number. */
int32_t jox_parse_declare(JoxParser *p, uint32_t at, int32_t parameter);
/* Brings a variable into scope until the end of the block. */
void jox_parse_show(JoxParser *p, int32_t variable);
/* Adds a NAME node for a variable where it is declared. */
int32_t jox_parse_declared(JoxParser *p, int32_t variable);
/* Adds a NAME node for the name at token `at`, resolved to the innermost variable in scope or a
   global. */
int32_t jox_parse_used(JoxParser *p, uint32_t at);

/* ---- parse_expression.c ---- */

/* Parses an expression whose operators bind more tightly than `limit`; 0: a whole expression.
   Returns its node. */
int32_t jox_parse_expression(JoxParser *p, int limit);
/* Parses `a, b, c` as a linked list; returns the first item, and the last in *last. */
int32_t jox_parse_list(JoxParser *p, int32_t *last);
/* Parses a name or parenthesis with all the fields, indices, methods and calls that follow it. */
int32_t jox_parse_suffixed(JoxParser *p);
/* Parses parameters and body of a function, from the token after `function NAME`; returns the
   FUNCTION node. `at` is the token of `function`; a `method` has a parameter `self`. */
int32_t jox_parse_function(JoxParser *p, uint32_t at, bool method);

#endif
