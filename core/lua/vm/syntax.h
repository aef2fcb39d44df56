/* The syntax tree of a Lua file, with every name resolved to the variable that it means. Made of
   the tokens of a file that Lua has compiled; misuse.c and assigned.c ask it. */
#ifndef JOX_LUA_VM_SYNTAX_H
#define JOX_LUA_VM_SYNTAX_H

#include "lua/vm/source.h"

enum { JOX_NO_TREE = -1 };

typedef enum {
    JOX_TREE_CONSTANT, /* number, text, true */
    JOX_TREE_FALSE,    /* nil, false */
    JOX_TREE_REST,     /* ... */
    JOX_TREE_NAME,     /* `at`: the name; `variable`: what it means, JOX_NO_TREE for a global */
    JOX_TREE_INDEX,    /* a.name with `at` at the name, or a[b] */
    JOX_TREE_CALL,     /* a(items) */
    JOX_TREE_METHOD,   /* a:name(items), `at` at the name */
    JOX_TREE_FUNCTION, /* `variable`: its number among the functions */
    JOX_TREE_TABLE,    /* items: FIELDs */
    JOX_TREE_FIELD,    /* of a table: `at` at the name and a = none, or [a] = b, or b alone */
    JOX_TREE_BINARY,   /* `at`: the operator */
    JOX_TREE_UNARY,    /* `at`: the operator, a */
    JOX_TREE_PAREN     /* (a) */
} JoxTreeKind;

/* An expression. Its parts have lower numbers than itself, except for the body of a function. */
typedef struct JoxTree {
    JoxTreeKind kind;
    uint32_t at;          /* token */
    uint32_t first, last; /* tokens of the whole of it, last exclusive; of values in lists, tables,
                             assignments and returns */
    int32_t a, b;         /* parts; JOX_NO_TREE: none */
    int32_t items;        /* first argument or field */
    int32_t next;         /* in the list of the same parent */
    int32_t variable;
    int32_t function; /* in which it stands */
    bool named;       /* INDEX, FIELD: the key is the name at `at` */
    bool tested;      /* decides a test (`if`, `while`, `until`), alone or by and, or, not */
} JoxTree;

typedef struct JoxTreeVariable {
    uint32_t at;       /* token of its declaration */
    int32_t function;  /* that declared it */
    int32_t parameter; /* number among the function's parameters, or JOX_NO_TREE */
} JoxTreeVariable;

typedef struct JoxTreeFunction {
    int first_line, last_line; /* as Lua tells them; 0 of the file itself */
    int32_t parent;            /* JOX_NO_TREE of the file itself, which is function 0 */
    bool returns;              /* its last statement is a `return` */
} JoxTreeFunction;

typedef enum {
    JOX_BIND_VALUE,  /* to the value of an expression */
    JOX_BIND_NIL,    /* declared without one */
    JOX_BIND_REST,   /* to a further result of a call, which is not followed */
    JOX_BIND_NUMBER, /* of a numeric loop */
    JOX_BIND_KEY,    /* of a loop over `value` */
    JOX_BIND_ITEM
} JoxTreeBindKind;

/* An assignment or declaration: target is a NAME or an INDEX. */
typedef struct JoxTreeBinding {
    JoxTreeBindKind kind;
    int32_t target, value;
    bool declares;
} JoxTreeBinding;

typedef struct JoxTreeReturn {
    int32_t function, value; /* the first value; JOX_NO_TREE: none */
} JoxTreeReturn;

typedef struct JoxTreeTest {
    uint32_t at; /* token of if, elseif, while or until */
    int32_t value;
} JoxTreeTest;

typedef struct JoxSyntax {
    const JoxSource *source;
    bool whole; /* false: the parser stopped, and what is here is of no use */
    JoxTree *trees;
    size_t tree_count, tree_capacity;
    JoxTreeVariable *variables;
    size_t variable_count, variable_capacity;
    JoxTreeFunction *functions;
    size_t function_count, function_capacity;
    JoxTreeBinding *bindings;
    size_t binding_count, binding_capacity;
    JoxTreeReturn *returns;
    size_t return_count, return_capacity;
    JoxTreeTest *tests;
    size_t test_count, test_capacity;
} JoxSyntax;

/* Parses a source that Lua accepts. Never fails; see `whole`. */
JoxSyntax *jox_syntax_read(const JoxSource *source);
void jox_syntax_free(JoxSyntax *syntax);
static inline const JoxToken *jox_syntax_token(const JoxSyntax *syntax, int32_t tree) {
    return &syntax->source->tokens[syntax->trees[tree].at];
}
/* Whether function `inner` is `outer` or stands in it. */
bool jox_syntax_within(const JoxSyntax *syntax, int32_t inner, int32_t outer);
/* The expression within parentheses; itself where there are none. */
int32_t jox_syntax_bare(const JoxSyntax *syntax, int32_t tree);

#endif
