/* Misuse that Lua would pass over in silence: `and`, `or`, `not`, `==`, `~=` and tests decide at
   once, by whether there is a value, and a condition always is one. Reported are places where a
   value of the language, and nothing else, gets there, in functions too; a name's kind is that of
   the variable it means. Where optional arguments of functions are told apart, as in `x = x or
   goal`, nothing is lost. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/kinds.h"
#include "lua/read.h"

typedef struct Search {
    JoxScript *script;
    const JoxSyntax *s;
    const JoxKind *kinds; /* of its trees */
    uint32_t source;
} Search;

static void add_misuse(const Search *f, uint32_t at, bool certain) {
    JoxScript *script = f->script;
    JOX_RESERVE(script->misuses, script->misuse_capacity, script->misuse_count + 1);
    script->misuses[script->misuse_count++] = (JoxMisuse){f->source, at, certain, false};
}

static const JoxTree *bare(const Search *f, int32_t tree) {
    return &f->s->trees[jox_syntax_bare(f->s, tree)];
}

/* Whether a tree is a parameter of a function by itself: others may call it with nothing. */
static bool is_parameter(const Search *f, int32_t tree) {
    const JoxTree *t = bare(f, tree);
    return t->kind == JOX_TREE_NAME && t->variable != JOX_NO_TREE &&
           f->s->variables[t->variable].parameter != JOX_NO_TREE;
}

/* The variable that a name, or a field of a field of it, begins with. */
static int32_t root_of(const Search *f, int32_t tree) {
    const JoxTree *t = bare(f, tree);
    while (t->kind == JOX_TREE_INDEX)
        t = bare(f, t->a);
    return t->kind == JOX_TREE_NAME ? t->variable : JOX_NO_TREE;
}

/* Whether the right operand uses the left one, so that it is not dropped: `x and near(x, 2)`. */
static bool uses_left(const Search *f, const JoxTree *t) {
    const int32_t root = root_of(f, t->a);
    for (int32_t part = t->a + 1; root != JOX_NO_TREE && part <= t->b; part++)
        if (f->s->trees[part].kind == JOX_TREE_NAME && f->s->trees[part].variable == root)
            return true;
    return false;
}

/* Whether a tree is the value of an assignment to a variable with the name of its left operand. */
static bool is_default(const Search *f, int32_t tree) {
    const JoxTree *left = bare(f, f->s->trees[tree].a);
    const JoxToken *name = &f->s->source->tokens[left->at];
    for (size_t b = 0; b < f->s->binding_count; b++) {
        const JoxTreeBinding *bound = &f->s->bindings[b];
        const JoxToken *to = jox_syntax_token(f->s, bound->target);
        if (bound->value == tree && left->kind == JOX_TREE_NAME && to->length == name->length &&
            memcmp(to->text, name->text, name->length) == 0)
            return true;
    }
    return false;
}

static bool is_joining(const Search *f, const JoxTree *t, const char *sign) {
    return t->kind == JOX_TREE_BINARY && jox_token_is(&f->s->source->tokens[t->at], sign);
}

/* `a and b`, `a or b` */
static void judge_joining(const Search *f, int32_t tree, bool is_or) {
    const JoxTree *t = &f->s->trees[tree], *left = bare(f, t->a);
    const JoxKind a = f->kinds[t->a], b = f->kinds[t->b];
    if (!jox_kind_is_value(a)) {
        if ((a.bits & JOX_KIND_UNKNOWN) && (jox_kind_is_value(b) || (b.bits & JOX_KIND_UNKNOWN)))
            add_misuse(f, t->at, false);
        return;
    }
    const bool parameter = is_parameter(f, t->a);
    const bool optional =
        parameter && (t->tested || (is_or && (a.bits == JOX_KIND_VALUE || is_default(f, tree))));
    /* Of `a and b or c` the first operator is told of, or is none. */
    const bool chosen = is_or && is_joining(f, left, "and") && jox_kind_is_value(f->kinds[left->a]);
    if (!optional && !chosen && (is_or || !uses_left(f, t)))
        add_misuse(f, t->at, true);
}

/* `a == b`, `a ~= b`: fine with nil, and where a function tells names from values. */
static void judge_comparison(const Search *f, const JoxTree *t) {
    const int32_t sides[] = {t->a, t->b};
    for (int i = 0; i < 2; i++) {
        const JoxTree *other = bare(f, sides[1 - i]);
        const bool text = other->kind == JOX_TREE_CONSTANT &&
                          f->s->source->tokens[other->at].kind == JOX_TOKEN_STRING;
        if (!jox_kind_is_value(f->kinds[sides[i]]) || other->kind == JOX_TREE_FALSE ||
            (text && is_parameter(f, sides[i])))
            continue;
        add_misuse(f, t->at, true);
        return;
    }
}

static void judge_tree(const Search *f, int32_t tree) {
    const JoxTree *t = &f->s->trees[tree];
    if (t->kind == JOX_TREE_UNARY && jox_token_is(&f->s->source->tokens[t->at], "not")) {
        const JoxKind kind = f->kinds[t->a];
        if (jox_kind_is_value(kind) && !(t->tested && is_parameter(f, t->a)))
            add_misuse(f, t->at, true);
        else if (kind.bits & JOX_KIND_UNKNOWN)
            add_misuse(f, t->at, false);
    } else if (is_joining(f, t, "and") || is_joining(f, t, "or")) {
        judge_joining(f, tree, is_joining(f, t, "or"));
    } else if (is_joining(f, t, "==") || is_joining(f, t, "~=")) {
        judge_comparison(f, t);
    }
}

static void judge_test(const Search *f, const JoxTreeTest *test) {
    const JoxTree *t = bare(f, test->value);
    if (jox_kind_is_value(f->kinds[test->value]) && !is_parameter(f, test->value) &&
        !is_joining(f, t, "and") && !is_joining(f, t, "or"))
        add_misuse(f, test->at, true);
}

/* The token that writes out the key of a field, a name or a text in brackets; NULL of any other. */
static const JoxToken *key_of(const JoxSyntax *s, const JoxTree *field) {
    if (field->named)
        return &s->source->tokens[field->at];
    if (field->a == JOX_NO_TREE || s->trees[field->a].kind != JOX_TREE_CONSTANT)
        return NULL;
    const JoxToken *t = jox_syntax_token(s, field->a);
    return t->kind == JOX_TOKEN_STRING ? t : NULL;
}

/* Reports keys that a table writes out twice: Lua takes the last, and what the first had is lost.
 */
static void report_doubled(JoxBuild *b, const JoxSyntax *s, const JoxTree *table) {
    enum { MOST_KEYS = 2000 };
    int looked = 0;
    for (int32_t f = table->items; f >= 0; f = s->trees[f].next) {
        const JoxToken *key = key_of(s, &s->trees[f]);
        for (int32_t o = table->items; key && o != f && looked++ < MOST_KEYS;
             o = s->trees[o].next) {
            const JoxToken *other = key_of(s, &s->trees[o]);
            if (!other || other->length != key->length ||
                memcmp(other->text, key->text, key->length) != 0)
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

static void report(JoxBuild *b, JoxMisuse *misuse) {
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

void jox_misuse_find(JoxBuild *b) {
    JoxScript *script = b->script;
    JOX_ASSERT(script->misuse_count == 0);
    JoxKinds *kinds = jox_kinds_read(script);
    for (uint32_t n = 0; kinds->settled && n < kinds->source_count; n++) {
        if (!kinds->trees[n])
            continue;
        const Search f = {script, jox_outline_syntax(script->vm.sources[n]), kinds->trees[n], n};
        for (size_t t = 0; t < f.s->tree_count; t++)
            judge_tree(&f, (int32_t)t);
        for (size_t t = 0; t < f.s->test_count; t++)
            judge_test(&f, &f.s->tests[t]);
    }
    if (!kinds->settled)
        jox_diag_warn(
            script->diagnostics, ((JoxPosition){b->source->path, 0, 0, 0}), "too-large",
            "Write less in one file, or fewer calls from one file to another",
            "it is too large to be searched for `and`, `or`, `not`, `==` and `~=` between "
            "conditions");
    jox_kinds_free(kinds);
    for (size_t n = 0; n < script->vm.source_count; n++) {
        const JoxSyntax *s = jox_outline_syntax(script->vm.sources[n]);
        for (size_t t = 0; s->whole && t < s->tree_count; t++)
            if (s->trees[t].kind == JOX_TREE_TABLE)
                report_doubled(b, s, &s->trees[t]);
    }
    for (uint32_t i = 0; i < script->misuse_count; i++)
        if (script->misuses[i].certain)
            report(b, &script->misuses[i]);
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
            report(b, misuse);
        found |= misuse->reported;
    }
    return found;
}
