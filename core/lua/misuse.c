/* Finds Lua operators and tests on values of the language: `and`, `or`, `not`, `==`, `~=`, `if` and
   `while` decide at once by whether there is a value, and a condition always is one. Reports only
   expressions that infer_kinds.c shows to be a value of the language and nothing else, in functions
   too. Nothing is reported if the code shows that the value may be absent: a parameter, a field of
   a table of options, the result of a function that may return nothing. Called by build.c. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/infer_kinds.h"
#include "lua/read_table.h"

/* A search through one source. */
typedef struct Search {
    JoxScript *script;
    const JoxKinds *all;
    const JoxSyntax *s;
    const JoxKind *kinds; /* by node of `s` */
    uint32_t source;
    int32_t *fields; /* by node: the table field whose value it is, or JOX_NO_TREE */
    bool *hooks;     /* by function: it is called while the crowd runs */
    uint32_t *looks; /* steps of may_be_nil, counted over all sources */
} Search;

static void add_misuse(const Search *f, uint32_t at, bool certain) {
    JoxScript *script = f->script;
    JOX_RESERVE(script->misuses, script->misuse_capacity, script->misuse_count + 1);
    script->misuses[script->misuse_count++] = (JoxMisuse){f->source, at, certain, false};
}

static const JoxTree *get_bare_tree(const Search *f, int32_t tree) {
    return &f->s->trees[jox_syntax_bare(f->s, tree)];
}

/* Returns whether a node is a parameter of a function by itself, which may be called without it. */
static bool is_parameter(const Search *f, int32_t tree) {
    const JoxTree *t = get_bare_tree(f, tree);
    return t->kind == JOX_TREE_NAME && t->variable != JOX_NO_TREE &&
           f->s->variables[t->variable].parameter != JOX_NO_TREE;
}

/* Returns the variable at the root of a name or of `a.b.c`; JOX_NO_TREE if there is none. */
static int32_t find_root_variable(const Search *f, int32_t tree) {
    const JoxTree *t = get_bare_tree(f, tree);
    while (t->kind == JOX_TREE_INDEX)
        t = get_bare_tree(f, t->a);
    return t->kind == JOX_TREE_NAME ? t->variable : JOX_NO_TREE;
}

/* Returns whether the right operand uses the variable of the left one, as `x and near(x, 2)` does.
 */
static bool uses_left(const Search *f, const JoxTree *t) {
    const int32_t root = find_root_variable(f, t->a);
    for (int32_t part = t->a + 1; root != JOX_NO_TREE && part <= t->b; part++)
        if (f->s->trees[part].kind == JOX_TREE_NAME && f->s->trees[part].variable == root)
            return true;
    return false;
}

/* Returns the name or field that a value is assigned to, `x = ...` or `{ x = ... }`; NULL if there
   is none. */
static const JoxToken *find_assigned_name(const Search *f, int32_t tree) {
    const int32_t field = f->fields[tree];
    if (field != JOX_NO_TREE)
        return f->s->trees[field].named ? jox_syntax_token(f->s, field) : NULL;
    for (size_t b = 0; b < f->s->binding_count; b++)
        if (f->s->bindings[b].value == tree)
            return jox_syntax_token(f->s, f->s->bindings[b].target);
    return NULL;
}

/* Returns whether `a or b` sets a default: the result is assigned to the name or field `a`. */
static bool is_default(const Search *f, int32_t tree) {
    const JoxTree *left = get_bare_tree(f, f->s->trees[tree].a);
    const JoxToken *target = find_assigned_name(f, tree);
    const bool name = left->kind == JOX_TREE_NAME || (left->kind == JOX_TREE_INDEX && left->named);
    return target && name && jox_token_equals(target, &f->s->source->tokens[left->at]);
}

/* Returns whether a node is the binary operator `sign`. */
static bool is_binary(const Search *f, const JoxTree *t, const char *sign) {
    return t->kind == JOX_TREE_BINARY && jox_token_is(&f->s->source->tokens[t->at], sign);
}

/* ---- values that may be absent ---- */

enum { DEEPEST = 8, MOST_LOOKS = 5000000 };

static bool may_be_nil(const Search *f, int32_t tree, bool tested, int depth);

/* Returns whether a function may return nothing: it ends without a `return`, or returns a value
   that may be absent. */
static bool may_return_nothing(const Search *f, JoxKind callee, int depth) {
    const Search other = {.script = f->script,
                          .all = f->all,
                          .s = jox_outline_syntax(f->script->vm.sources[callee.source]),
                          .kinds = f->all->trees[callee.source],
                          .source = callee.source,
                          .looks = f->looks};
    const int32_t function = other.s->trees[callee.tree].variable;
    bool lacks = !other.s->functions[function].returns;
    *f->looks += (uint32_t)other.s->return_count;
    for (size_t r = 0; r < other.s->return_count && !lacks; r++) {
        const JoxTreeReturn *given = &other.s->returns[r];
        lacks = given->function == function &&
                (given->value == JOX_NO_TREE || (other.kinds[given->value].bits & JOX_KIND_FALSE) ||
                 may_be_nil(&other, given->value, false, depth));
    }
    return lacks;
}

/* Returns whether a variable may be nil by its assignments. In a test also if it is assigned more
   than once. */
static bool may_hold_nothing(const Search *f, int32_t variable, bool tested, int depth) {
    int count = 0;
    bool lacks = f->s->variables[variable].parameter != JOX_NO_TREE;
    *f->looks += (uint32_t)f->s->binding_count;
    for (size_t b = 0; b < f->s->binding_count && !lacks; b++) {
        const JoxTreeBinding *bound = &f->s->bindings[b];
        const JoxTree *target = &f->s->trees[bound->target];
        if (target->kind != JOX_TREE_NAME || target->variable != variable)
            continue;
        count++;
        lacks = bound->kind != JOX_BIND_VALUE || (tested && count > 1) ||
                may_be_nil(f, bound->value, tested, depth);
    }
    return lacks;
}

/* Returns whether the form of an expression shows that its value may be absent, so that testing it
   makes sense: a field of a table constructor, a parameter, a call, `a or b`. Values of `own`,
   `now` and memory are never absent. True if the search is too deep. */
static bool may_be_nil(const Search *f, int32_t tree, bool tested, int depth) {
    const JoxTree *t = get_bare_tree(f, tree);
    if (depth <= 0 || *f->looks > MOST_LOOKS)
        return true;
    switch (t->kind) {
    case JOX_TREE_NAME:
        return t->variable != JOX_NO_TREE && may_hold_nothing(f, t->variable, tested, depth - 1);
    case JOX_TREE_INDEX: {
        const JoxKind table = f->kinds[t->a];
        return table.site == JOX_SITE_TREE && (tested || table.source == f->source);
    }
    case JOX_TREE_CALL: {
        const JoxKind callee = f->kinds[t->a];
        return callee.site == JOX_SITE_TREE && may_return_nothing(f, callee, depth - 1);
    }
    case JOX_TREE_BINARY:
        return is_binary(f, t, "and") ||
               (is_binary(f, t, "or") && (tested || may_be_nil(f, t->b, tested, depth - 1)));
    default:
        return false;
    }
}

/* Returns whether a node is in a function that is called while the crowd runs, where no values of
   the language are made. */
static bool is_in_hook(const Search *f, const JoxTree *t) {
    int32_t function = t->function;
    while (function != JOX_NO_TREE && !f->hooks[function])
        function = f->s->functions[function].parent;
    return function != JOX_NO_TREE;
}

/* Returns whether a value may be absent where it is used. */
static bool may_be_absent(const Search *f, int32_t tree, bool tested) {
    return !is_in_hook(f, &f->s->trees[tree]) && may_be_nil(f, tree, tested, DEEPEST);
}

/* ---- operators and tests ---- */

/* Returns whether `a or b` gives a value that may be absent a default. In a table the field must
   have the same name: `{ when = opts.when or after(3) }`; in `{ when = opts.busy or after(3) }` `|`
   is meant. */
static bool is_alternative(const Search *f, int32_t tree) {
    const JoxTree *t = &f->s->trees[tree];
    return is_default(f, tree) || get_bare_tree(f, t->a)->kind == JOX_TREE_CALL ||
           f->fields[tree] == JOX_NO_TREE || f->kinds[t->a].bits == JOX_KIND_VALUE;
}

/* Checks `a and b`, `a or b`. */
static void check_joining(const Search *f, int32_t tree, bool is_or) {
    const JoxTree *t = &f->s->trees[tree], *left = get_bare_tree(f, t->a);
    const JoxKind a = f->kinds[t->a], b = f->kinds[t->b];
    if (!jox_kind_is_value(a)) {
        if ((a.bits & JOX_KIND_UNKNOWN) && (jox_kind_is_value(b) || (b.bits & JOX_KIND_UNKNOWN)))
            add_misuse(f, t->at, false);
        return;
    }
    const bool parameter = is_parameter(f, t->a);
    bool optional =
        parameter && (t->tested || (is_or && (a.bits == JOX_KIND_VALUE || is_default(f, tree))));
    if (!parameter && may_be_absent(f, t->a, t->tested))
        optional = t->tested || left->kind == JOX_TREE_CALL || (is_or && is_alternative(f, tree));
    else if (!parameter && is_or && left->kind == JOX_TREE_NAME)
        optional = is_default(f, tree);
    /* In `a and b or c` only the first operator is reported, if any. */
    const bool chosen = is_or && is_binary(f, left, "and") && jox_kind_is_value(f->kinds[left->a]);
    if (!optional && !chosen && (is_or || !uses_left(f, t)))
        add_misuse(f, t->at, true);
}

/* Checks `a == b`, `a ~= b`. Comparing with nil is fine, and a parameter with a string, which tells
   names from values. */
static void check_comparison(const Search *f, const JoxTree *t) {
    const int32_t sides[] = {t->a, t->b};
    for (int i = 0; i < 2; i++) {
        const JoxTree *other = get_bare_tree(f, sides[1 - i]);
        const bool text = other->kind == JOX_TREE_CONSTANT &&
                          f->s->source->tokens[other->at].kind == JOX_TOKEN_STRING;
        if (!jox_kind_is_value(f->kinds[sides[i]]) || other->kind == JOX_TREE_FALSE ||
            (text && is_parameter(f, sides[i])))
            continue;
        add_misuse(f, t->at, true);
        return;
    }
}

/* Checks an operator. */
static void check_operator(const Search *f, int32_t tree) {
    const JoxTree *t = &f->s->trees[tree];
    if (t->kind == JOX_TREE_UNARY && jox_token_is(&f->s->source->tokens[t->at], "not")) {
        const JoxKind kind = f->kinds[t->a];
        const bool absent = is_parameter(f, t->a) ? t->tested : may_be_absent(f, t->a, true);
        if (jox_kind_is_value(kind) && !absent)
            add_misuse(f, t->at, true);
        else if ((kind.bits & JOX_KIND_UNKNOWN) || (jox_kind_is_value(kind) && !t->tested))
            add_misuse(f, t->at, false);
    } else if (is_binary(f, t, "and") || is_binary(f, t, "or")) {
        check_joining(f, tree, is_binary(f, t, "or"));
    } else if (is_binary(f, t, "==") || is_binary(f, t, "~=")) {
        check_comparison(f, t);
    }
}

/* Checks a test of a value that is always there. In a function that is called while the crowd runs
   it is an error: a condition was meant. While a file loads it may be a constant switch, so it is
   noted only. */
static void check_test(const Search *f, const JoxTreeTest *test) {
    const JoxTree *t = get_bare_tree(f, test->value);
    if (!jox_kind_is_value(f->kinds[test->value]) || is_parameter(f, test->value) ||
        is_binary(f, t, "and") || is_binary(f, t, "or") || may_be_absent(f, test->value, true))
        return;
    if (is_in_hook(f, t)) {
        add_misuse(f, test->at, true);
        return;
    }
    const JoxToken *at = &f->s->source->tokens[test->at];
    jox_diag_note(f->script->diagnostics,
                  ((JoxPosition){f->s->source->path, at->line, at->column, at->end_column}),
                  "lua-operator",
                  "this test always holds, as its value is always there; what the crowd does is "
                  "asked in a `when`");
}

/* Returns the token of a field's key, a name or a string in brackets; NULL for any other. */
static const JoxToken *find_key_token(const JoxSyntax *s, const JoxTree *field) {
    if (field->named)
        return &s->source->tokens[field->at];
    if (field->a == JOX_NO_TREE || s->trees[field->a].kind != JOX_TREE_CONSTANT)
        return NULL;
    const JoxToken *t = jox_syntax_token(s, field->a);
    return t->kind == JOX_TOKEN_STRING ? t : NULL;
}

/* Reports keys that a table constructor has twice: Lua takes the last, and the first value is lost.
 */
static void report_doubled_keys(JoxBuild *b, const JoxSyntax *s, const JoxTree *table) {
    enum { MOST_KEYS = 2000 };
    int looked = 0;
    for (int32_t f = table->items; f >= 0; f = s->trees[f].next) {
        const JoxToken *key = find_key_token(s, &s->trees[f]);
        for (int32_t o = table->items; key && o != f && looked++ < MOST_KEYS;
             o = s->trees[o].next) {
            const JoxToken *other = find_key_token(s, &s->trees[o]);
            if (!other || !jox_token_equals(other, key))
                continue;
            jox_build_error(b,
                            (JoxPosition){s->source->path, key->line, key->column, key->end_column},
                            "doubled-key", "Take one of them out, or give it another name",
                            "'%.*s' is in this table twice: what line %d says of it is lost",
                            key->length < 60 ? (int)key->length : 60, key->text, other->line);
            break;
        }
    }
}

/* Reports a misuse with the operator that was meant. */
static void report_misuse(JoxBuild *b, JoxMisuse *misuse) {
    static const struct {
        const char *sign, *instead;
    } MISUSED[] = {{"and", "Use & between conditions"},
                   {"or", "Use | between conditions"},
                   {"not", "Use ~ before a condition"},
                   {"==", "Write :is(n)"},
                   {"~=", "Write ~x:is(n)"}};
    const JoxSource *source = b->script->vm.sources[misuse->source];
    const JoxToken *t = &source->tokens[misuse->at];
    const char *instead =
        "What depends on a condition belongs in a `when`, or in memory that `set` "
        "makes true";
    char sign[16];
    for (size_t k = 0; k < sizeof MISUSED / sizeof *MISUSED; k++)
        if (jox_token_is(t, MISUSED[k].sign))
            instead = MISUSED[k].instead;
    snprintf(sign, sizeof sign, "%.*s", (int)t->length, t->text);
    misuse->reported = true;
    jox_build_error(b, (JoxPosition){source->path, t->line, t->column, t->end_column},
                    "lua-operator", instead,
                    "'%s' decides by whether there is a value, not by what the crowd does", sign);
}

/* Marks the functions that are called while the crowd runs: values of keys that take a function. */
static void mark_hooks(const JoxKinds *kinds, Search *searches) {
    static const char *const KEYS[] = {"when", "steer", "on_enter", "on_exit", "on_take"};
    for (uint32_t n = 0; n < kinds->source_count; n++) {
        const Search *f = &searches[n];
        for (size_t t = 0; f->kinds && t < f->s->tree_count; t++) {
            const JoxTree *field = &f->s->trees[t];
            if (field->kind != JOX_TREE_FIELD || !field->named)
                continue;
            const JoxKind kind = f->kinds[field->b];
            bool hook = false;
            for (size_t k = 0; k < sizeof KEYS / sizeof *KEYS; k++)
                hook |= jox_token_is(jox_syntax_token(f->s, (int32_t)t), KEYS[k]);
            if (hook && kind.bits == JOX_KIND_FUNCTION && kind.site == JOX_SITE_TREE) {
                const Search *of = &searches[kind.source];
                of->hooks[of->s->trees[kind.tree].variable] = true;
            }
        }
    }
}

/* Prepares the search through source number `n`. */
static Search start_search(JoxScript *script, const JoxKinds *kinds, uint32_t source) {
    Search f = {.script = script,
                .all = kinds,
                .s = jox_outline_syntax(script->vm.sources[source]),
                .kinds = kinds->trees[source],
                .source = source};
    f.hooks = jox_alloc(f.s->function_count + 1, sizeof *f.hooks);
    f.fields = jox_alloc(f.s->tree_count + 1, sizeof *f.fields);
    for (size_t t = 0; t < f.s->tree_count; t++)
        f.fields[t] = JOX_NO_TREE;
    for (size_t t = 0; f.kinds && t < f.s->tree_count; t++)
        if (f.s->trees[t].kind == JOX_TREE_FIELD)
            f.fields[jox_syntax_bare(f.s, f.s->trees[t].b)] = (int32_t)t;
    return f;
}

/* Warns that a file was not searched, as the search would take too long. */
static void warn_too_large(JoxScript *script, const JoxSource *source) {
    jox_diag_warn(script->diagnostics, ((JoxPosition){source->path, 0, 0, 0}), "too-large",
                  "Write less in one file, or fewer calls from one file to another",
                  "it is too large to be searched for `and`, `or`, `not`, `==` and `~=` between "
                  "conditions");
}

void jox_misuse_find(JoxBuild *b) {
    JoxScript *script = b->script;
    JOX_ASSERT(script->misuse_count == 0);
    JoxKinds *kinds = b->kinds = jox_kinds_read(script);
    Search *searches = jox_alloc(kinds->source_count + 1, sizeof *searches);
    uint32_t looks = 0;
    for (uint32_t n = 0; n < kinds->source_count; n++) {
        searches[n] = start_search(script, kinds, n);
        searches[n].looks = &looks;
    }
    mark_hooks(kinds, searches);
    for (uint32_t n = 0; n < kinds->source_count; n++) {
        const Search *f = &searches[n];
        for (size_t t = 0; kinds->settled && f->kinds && t < f->s->tree_count; t++)
            check_operator(f, (int32_t)t);
        for (size_t t = 0; kinds->settled && f->kinds && t < f->s->test_count; t++)
            check_test(f, &f->s->tests[t]);
    }
    for (uint32_t n = 0; n < kinds->source_count; n++) {
        jox_free(searches[n].hooks);
        jox_free(searches[n].fields);
    }
    jox_free(searches);
    if (!kinds->settled && jox_outline_syntax(b->source)->whole)
        warn_too_large(script, b->source);
    for (size_t n = 0; n < script->vm.source_count; n++) {
        const JoxSyntax *s = jox_outline_syntax(script->vm.sources[n]);
        if (!s->whole)
            warn_too_large(script, script->vm.sources[n]);
        for (size_t t = 0; s->whole && t < s->tree_count; t++)
            if (s->trees[t].kind == JOX_TREE_TABLE)
                report_doubled_keys(b, s, &s->trees[t]);
    }
    for (uint32_t i = 0; i < script->misuse_count; i++)
        if (script->misuses[i].certain)
            report_misuse(b, &script->misuses[i]);
}

bool jox_misuse_explains(JoxBuild *b, const char *path) {
    const JoxSource *source;
    const JoxPath *span = jox_read_span(b, path, &source);
    bool found = false;
    for (uint32_t i = 0; i < b->script->misuse_count; i++) {
        JoxMisuse *misuse = &b->script->misuses[i];
        const bool here = span && b->script->vm.sources[misuse->source] == source &&
                          misuse->at >= span->first && misuse->at < span->last;
        if (here && !misuse->reported)
            report_misuse(b, misuse);
        found |= misuse->reported;
    }
    return found;
}
