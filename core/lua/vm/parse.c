/* Helpers of the parser: passing tokens, adding tree nodes, resolving names to variables. Called by
   syntax.c and parse_expression.c. */
#include "lua/vm/parse.h"

#include <string.h>

#include "base/assert.h"
#include "base/mem.h"

enum { MOST_LOOKS = 20000000 };

bool jox_parse_is(const JoxParser *p, const char *text) {
    return !p->failed && p->at < p->count && jox_token_is(&p->tokens[p->at], text);
}

bool jox_parse_accept(JoxParser *p, const char *text) {
    const bool found = jox_parse_is(p, text);
    p->at += found;
    return found;
}

void jox_parse_expect(JoxParser *p, const char *text) {
    if (!jox_parse_accept(p, text))
        p->failed = true;
}

static bool is_keyword(const JoxToken *t) {
    static const char *const WORDS[] = {"and",   "break", "do",       "else", "elseif", "end",
                                        "false", "for",   "function", "goto", "if",     "in",
                                        "local", "nil",   "not",      "or",   "repeat", "return",
                                        "then",  "true",  "until",    "while"};
    for (size_t i = 0; i < sizeof WORDS / sizeof *WORDS; i++)
        if (jox_token_is(t, WORDS[i]))
            return true;
    return false;
}

bool jox_parse_is_name(const JoxParser *p) {
    return !p->failed && p->at < p->count && p->tokens[p->at].kind == JOX_TOKEN_NAME &&
           !is_keyword(&p->tokens[p->at]);
}

uint32_t jox_parse_name(JoxParser *p) {
    if (!jox_parse_is_name(p))
        p->failed = true;
    else
        p->at++;
    return (uint32_t)(p->at > 0 ? p->at - 1 : 0);
}

int32_t jox_parse_add(JoxParser *p, JoxTreeKind kind, uint32_t at) {
    JoxSyntax *s = p->tree;
    JOX_RESERVE(s->trees, s->tree_capacity, s->tree_count + 1);
    s->trees[s->tree_count] = (JoxTree){.kind = kind,
                                        .at = at,
                                        .a = JOX_NO_TREE,
                                        .b = JOX_NO_TREE,
                                        .items = JOX_NO_TREE,
                                        .next = JOX_NO_TREE,
                                        .variable = JOX_NO_TREE,
                                        .function = p->function};
    return (int32_t)s->tree_count++;
}

JoxTree *jox_parse_tree(JoxParser *p, int32_t tree) {
    JOX_ASSERT(tree >= 0 && (size_t)tree < p->tree->tree_count);
    return &p->tree->trees[tree];
}

void jox_parse_bind(JoxParser *p, JoxTreeBindKind kind, int32_t target, int32_t value,
                    bool declares) {
    JoxSyntax *s = p->tree;
    JOX_RESERVE(s->bindings, s->binding_capacity, s->binding_count + 1);
    s->bindings[s->binding_count++] = (JoxTreeBinding){kind, target, value, declares};
}

int32_t jox_parse_declare(JoxParser *p, uint32_t at, int32_t parameter) {
    JoxSyntax *s = p->tree;
    JOX_RESERVE(s->variables, s->variable_capacity, s->variable_count + 1);
    s->variables[s->variable_count] = (JoxTreeVariable){at, p->function, parameter};
    return (int32_t)s->variable_count++;
}

void jox_parse_show(JoxParser *p, int32_t variable) {
    JOX_RESERVE(p->visible, p->visible_capacity, p->visible_count + 1);
    p->visible[p->visible_count++] = variable;
}

int32_t jox_parse_declared(JoxParser *p, int32_t variable) {
    int32_t name = jox_parse_add(p, JOX_TREE_NAME, p->tree->variables[variable].at);
    jox_parse_tree(p, name)->variable = variable;
    return name;
}

int32_t jox_parse_used(JoxParser *p, uint32_t at) {
    const JoxToken *t = &p->tokens[at];
    int32_t name = jox_parse_add(p, JOX_TREE_NAME, at);
    for (size_t v = p->visible_count; v-- > 0; p->looks++) {
        const JoxToken *declared = &p->tokens[p->tree->variables[p->visible[v]].at];
        if (!jox_token_equals(declared, t))
            continue;
        jox_parse_tree(p, name)->variable = p->visible[v];
        break;
    }
    p->failed |= p->looks > MOST_LOOKS;
    return name;
}
