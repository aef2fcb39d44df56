/* The syntax tree of a Lua file, with every name resolved to its variable. Built from the tokens of
   a file that Lua has compiled; misuse.c, infer_kinds.c, part_origin.c and
   language/outer_assignments.c search it.
 */
#ifndef JOX_LUA_VM_SYNTAX_H
#define JOX_LUA_VM_SYNTAX_H

#include "lua/vm/source.h"

enum { JOX_NO_TREE = -1 };

typedef enum {
    JOX_TREE_CONSTANT, /* number, text, true */
    JOX_TREE_FALSE,    /* nil, false */
    JOX_TREE_REST,     /* ... */
    JOX_TREE_NAME,     /* `at`: its token; `variable`: what it means, JOX_NO_TREE: a global */
    JOX_TREE_INDEX,    /* a.name with `at` at the name, or a[b] */
    JOX_TREE_CALL,     /* a(items) */
    JOX_TREE_METHOD,   /* a:name(items), `at` at the name */
    JOX_TREE_FUNCTION, /* `variable`: number of the function in JoxSyntax.functions */
    JOX_TREE_TABLE,    /* items: FIELDs */
    JOX_TREE_FIELD,    /* entry of a table: `at` at the name and no a, or [a] = b, or b alone */
    JOX_TREE_BINARY,   /* a, b; `at`: the operator */
    JOX_TREE_UNARY,    /* a; `at`: the operator */
    JOX_TREE_PAREN     /* (a) */
} JoxTreeKind;

/* An expression. Its parts have lower numbers than itself, except for the body of a function. */
typedef struct JoxTree {
    JoxTreeKind kind;
    uint32_t at;          /* its token */
    uint32_t first, last; /* tokens of the whole expression, last exclusive; set for values in
                             lists, tables, assignments and returns */
    int32_t a, b;         /* operands; JOX_NO_TREE: none */
    int32_t items;        /* first argument or field */
    int32_t next;         /* next item in the list of the parent */
    int32_t variable;
    int32_t function; /* number of the function that contains it */
    bool named;       /* INDEX, FIELD: the key is the name at `at` */
    bool tested; /* its truth decides an `if`, `while` or `until`, alone or through and, or, not */
} JoxTree;

/* A local variable or parameter. */
typedef struct JoxTreeVariable {
    uint32_t at;       /* token of its declaration */
    int32_t function;  /* function that declares it */
    int32_t parameter; /* number among the function's parameters, or JOX_NO_TREE */
} JoxTreeVariable;

/* A function of the file; number 0 is the file itself. */
typedef struct JoxTreeFunction {
    int first_line, last_line; /* as Lua numbers them; 0 for the file itself */
    int32_t parent;            /* function around it; JOX_NO_TREE for the file itself */
    bool returns;              /* its last statement is a `return` */
} JoxTreeFunction;

typedef enum {
    JOX_BIND_VALUE,  /* value of an expression */
    JOX_BIND_NIL,    /* declaration without a value */
    JOX_BIND_REST,   /* a further result of a call, which is not traced */
    JOX_BIND_NUMBER, /* variable of a numeric loop */
    JOX_BIND_KEY,    /* first variable of a generic loop over `value` */
    JOX_BIND_ITEM    /* further variable of that loop */
} JoxTreeBindKind;

/* An assignment or declaration: `target` is a NAME or an INDEX node. */
typedef struct JoxTreeBinding {
    JoxTreeBindKind kind;
    int32_t target, value;
    bool declares;
} JoxTreeBinding;

/* A `return` statement. */
typedef struct JoxTreeReturn {
    int32_t function, value; /* the first value; JOX_NO_TREE: none */
} JoxTreeReturn;

/* The condition of an if, elseif, while or repeat. */
typedef struct JoxTreeTest {
    uint32_t at; /* token of if, elseif, while or until */
    int32_t value;
} JoxTreeTest;

typedef struct JoxSyntax {
    const JoxSource *source;
    bool whole; /* the file was parsed to its end; if false, the rest is incomplete and must not be
                   used */
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

/* Parses a source that Lua accepts. Never fails; see `whole`. Free with jox_syntax_free. */
JoxSyntax *jox_syntax_read(const JoxSource *source);
void jox_syntax_free(JoxSyntax *syntax);
/* Returns the token of a node. */
static inline const JoxToken *jox_syntax_token(const JoxSyntax *syntax, int32_t tree) {
    return &syntax->source->tokens[syntax->trees[tree].at];
}
/* Returns whether function `inner` is `outer` or nested in it. */
bool jox_syntax_within(const JoxSyntax *syntax, int32_t inner, int32_t outer);
/* Returns the expression inside any parentheses. */
int32_t jox_syntax_bare(const JoxSyntax *syntax, int32_t tree);

#endif
