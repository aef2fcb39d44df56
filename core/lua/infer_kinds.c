/* Infers the kind of each expression of a script, by passes over the syntax trees of all its files
   until nothing changes. A variable holds the union of all values assigned to it, in any order; a
   parameter those it was passed while the file loaded. */
#include "lua/infer_kinds.h"

#include <string.h>

#include "base/mem.h"
#include "lua/language/vocabulary.h"

enum { MOST_PASSES = 40 };
static const uint64_t MOST_LOOKS = 20000000;

static const JoxKind NOTHING = {0}, UNKNOWN = {.bits = JOX_KIND_UNKNOWN},
                     PLAIN = {.bits = JOX_KIND_PLAIN}, FALSE = {.bits = JOX_KIND_FALSE},
                     VALUE = {.bits = JOX_KIND_VALUE}, CONDITION = {.bits = JOX_KIND_CONDITION},
                     TRUTH = {.bits = JOX_KIND_FALSE | JOX_KIND_PLAIN},
                     PLAIN_ONE = {JOX_KIND_FALSE | JOX_KIND_PLAIN, JOX_SITE_PLAIN, 0, 0};

static const JoxSyntax *get_syntax(const JoxKinds *k, uint32_t source) {
    return jox_outline_of(k->script->vm.sources[source])->syntax;
}

/* Returns the union of two kinds. */
static JoxKind join_kinds(JoxKind a, JoxKind b) {
    if (b.site == JOX_SITE_NONE || a.site == JOX_SITE_MANY) {
        a.bits |= b.bits;
        return a;
    }
    const bool same = a.site == b.site && a.source == b.source && a.tree == b.tree;
    const JoxSiteKind site = a.site == JOX_SITE_NONE || same ? b.site : JOX_SITE_MANY;
    return (JoxKind){a.bits | b.bits, site, b.source, b.tree};
}

/* Adds a kind to one found before; records whether that changed it. */
static void widen_kind(JoxKinds *k, JoxKind *kept, JoxKind more) {
    const JoxKind wide = join_kinds(*kept, more);
    k->changed |= wide.bits != kept->bits || wide.site != kept->site || wide.tree != kept->tree ||
                  wide.source != kept->source;
    *kept = wide;
}

/* ---- functions ---- */

static bool is_call(const JoxTree *t) {
    return t->kind == JOX_TREE_CALL || t->kind == JOX_TREE_METHOD;
}

/* Returns the recorded calls of a function; NULL if there are none, or another function is on the
   same lines. */
static const JoxCallFact *find_call_fact(const JoxKinds *k, uint32_t source, int32_t function) {
    const JoxSyntax *s = get_syntax(k, source);
    const JoxTreeFunction *f = &s->functions[function];
    for (size_t o = 1; o < s->function_count; o++)
        if ((int32_t)o != function && s->functions[o].first_line == f->first_line &&
            s->functions[o].last_line == f->last_line)
            return NULL;
    return jox_calls_find(k->script, source, f->first_line, f->last_line);
}

/* Returns the kind of a function's results: those recorded, and those of the calls that it returns.
 */
static JoxKind infer_result(JoxKinds *k, uint32_t source, int32_t function) {
    const JoxSyntax *s = get_syntax(k, source);
    const JoxCallFact *fact = function > 0 ? find_call_fact(k, source, function) : NULL;
    JoxKind all = {0};
    if (function > 0) /* it may end without `return` */
        all.bits = fact ? fact->returned : JOX_KIND_FALSE;
    for (size_t r = 0; r < s->return_count; r++) {
        const JoxTreeReturn *given = &s->returns[r];
        k->looks++;
        if (given->function != function)
            continue;
        const JoxKind kind = given->value < 0 ? FALSE : k->trees[source][given->value];
        if (fact && fact->returned && !(given->value >= 0 && is_call(&s->trees[given->value])))
            all = join_kinds(all, (JoxKind){0, kind.site, kind.source, kind.tree});
        else
            all = join_kinds(all, kind);
    }
    return all;
}

/* Returns the kind of what a `require` returns. */
static JoxKind infer_required(JoxKinds *k, uint32_t source, int32_t argument) {
    const JoxSyntax *s = get_syntax(k, source);
    if (argument < 0 || jox_syntax_token(s, argument)->kind != JOX_TOKEN_STRING)
        return UNKNOWN;
    for (uint32_t r = 0; r < k->script->required_count; r++) {
        const JoxRequired *file = &k->script->required[r];
        if (file->asking == source && jox_token_says(jox_syntax_token(s, argument), file->name))
            return k->trees[file->given] ? infer_result(k, file->given, 0) : UNKNOWN;
    }
    return UNKNOWN;
}

/* Returns the kind of what a word of the vocabulary returns. */
static JoxKind infer_word_result(JoxKinds *k, uint32_t source, const JoxTree *call, int32_t word) {
    const JoxWord *w = &jox_words[word];
    if (w->makes != 0)
        return w->makes == JOX_NODE_CONDITION ? CONDITION : VALUE;
    if (strcmp(w->name, "require") == 0)
        return infer_required(k, source, call->items);
    if (strcmp(w->name, "memory") == 0)
        return (JoxKind){JOX_KIND_TABLE, JOX_SITE_MEMORY, source, call->items};
    return UNKNOWN;
}

static JoxKind infer_call(JoxKinds *k, uint32_t source, const JoxTree *call) {
    const JoxKind callee = k->trees[source][call->a];
    if (callee.bits == JOX_KIND_FUNCTION && callee.site == JOX_SITE_WORD)
        return infer_word_result(k, source, call, callee.tree);
    if (callee.bits == JOX_KIND_FUNCTION && callee.site == JOX_SITE_TREE)
        return infer_result(k, callee.source,
                            get_syntax(k, callee.source)->trees[callee.tree].variable);
    if (callee.site == JOX_SITE_PLAIN)
        return TRUTH;
    return callee.bits == 0 ? NOTHING : UNKNOWN;
}

static JoxKind infer_method(const JoxSyntax *s, int32_t tree) {
    static const char *const COMPARES[] = {"above", "below", "at_least", "at_most", "is"},
                             *const NARROWS[] = {"in_state", "of_machine", "of_group", "where"};
    const JoxToken *name = jox_syntax_token(s, tree);
    for (size_t i = 0; i < sizeof COMPARES / sizeof *COMPARES; i++)
        if (jox_token_is(name, COMPARES[i]))
            return CONDITION;
    for (size_t i = 0; i < sizeof NARROWS / sizeof *NARROWS; i++)
        if (jox_token_is(name, NARROWS[i]))
            return VALUE;
    return UNKNOWN;
}

/* ---- names and fields ---- */

/* Returns whether a table key may equal `name`: written as a name, as a string in brackets, or
   computed in brackets. Keys of list items never do. */
static bool may_equal_key(const JoxSyntax *s, const JoxTree *t, int32_t in_brackets,
                          const JoxToken *name) {
    if (t->named)
        return jox_token_equals(&s->source->tokens[t->at], name);
    return in_brackets != JOX_NO_TREE && (s->trees[in_brackets].kind != JOX_TREE_CONSTANT ||
                                          jox_token_equals(jox_syntax_token(s, in_brackets), name));
}

/* Returns the kind of a field of a table constructor, with all assignments to it; `name` NULL: of
   all fields. */
static JoxKind infer_field(JoxKinds *k, JoxKind table, const JoxToken *name) {
    const JoxSyntax *s = get_syntax(k, table.source);
    JoxKind all = {0};
    for (int32_t f = s->trees[table.tree].items; f >= 0; f = s->trees[f].next) {
        const JoxTree *field = &s->trees[f];
        k->looks++;
        if (!name || may_equal_key(s, field, field->a, name))
            all = join_kinds(all, k->trees[table.source][field->b]);
    }
    for (uint32_t o = 0; o < k->source_count; o++) {
        const JoxSyntax *other = k->trees[o] ? get_syntax(k, o) : NULL;
        for (size_t b = 0; other && b < other->binding_count; b++) {
            const JoxTreeBinding *bound = &other->bindings[b];
            const JoxTree *target = &other->trees[bound->target];
            k->looks++;
            if (target->kind != JOX_TREE_INDEX || bound->kind != JOX_BIND_VALUE)
                continue;
            const JoxKind to = k->trees[o][target->a];
            if (to.site == JOX_SITE_TREE && to.source == table.source && to.tree == table.tree &&
                (!name || may_equal_key(other, target, target->b, name)))
                all = join_kinds(all, k->trees[o][bound->value]);
        }
    }
    return all.bits ? all : UNKNOWN;
}

/* Returns the kind of memory: a boolean is a condition, a number a value. */
static JoxKind infer_memory(const JoxKinds *k, const JoxToken *name) {
    for (uint32_t m = 0; m < k->script->memory_count; m++)
        if (jox_token_is(name, k->script->memory[m].name))
            return k->script->memory[m].kind == JOX_MEMORY_BOOLEAN ? CONDITION : VALUE;
    return UNKNOWN;
}

static JoxKind infer_index(JoxKinds *k, uint32_t source, const JoxTree *t) {
    const JoxKind base = k->trees[source][t->a];
    const JoxToken *name = t->named ? &k->script->vm.sources[source]->tokens[t->at] : NULL;
    if (base.bits == 0)
        return base;
    if (base.site == JOX_SITE_VALUES)
        return VALUE;
    if (base.site == JOX_SITE_PLAIN)
        return base;
    if (base.site == JOX_SITE_MEMORY)
        return name ? infer_memory(k, name) : UNKNOWN;
    if (base.site != JOX_SITE_TREE || !(base.bits & JOX_KIND_TABLE))
        return UNKNOWN;
    JoxKind found = infer_field(k, base, name);
    if (!name)
        found.bits |= JOX_KIND_FALSE; /* past the last item */
    return found;
}

static JoxKind infer_global(const JoxKinds *k, const JoxToken *t) {
    static const char *const PLAIN_ONES[] = {"type", "tostring", "tonumber", "math", "string"};
    for (size_t w = 0; w < jox_word_count; w++) {
        const JoxWord *word = &jox_words[w];
        if (!jox_token_is(t, word->name))
            continue;
        if (word->takes)
            return (JoxKind){JOX_KIND_FUNCTION, JOX_SITE_WORD, 0, (int32_t)w};
        if (word->makes != 0)
            return word->makes == JOX_NODE_CONDITION ? CONDITION : VALUE;
        return strcmp(word->name, "settings") == 0
                   ? PLAIN_ONE
                   : (JoxKind){JOX_KIND_TABLE, JOX_SITE_VALUES, 0, 0};
    }
    for (size_t i = 0; i < sizeof PLAIN_ONES / sizeof *PLAIN_ONES; i++)
        if (jox_token_is(t, PLAIN_ONES[i]))
            return PLAIN_ONE;
    const JoWord *word = jox_program_word_find(k->script->owner, t);
    if (word)
        return word->kind == JO_WORD_NUMBER      ? VALUE
               : word->kind == JO_WORD_CONDITION ? CONDITION
                                                 : (JoxKind){.bits = JOX_KIND_FUNCTION};
    return UNKNOWN;
}

/* ---- operators ---- */

static JoxKind infer_binary(const JoxToken *sign, JoxKind a, JoxKind b) {
    static const char *const COMPARES[] = {"==", "~=", "<", ">", "<=", ">="},
                             *const PLAIN_ONES[] = {"..", "^", "%", "//", "<<", ">>"};
    if (jox_token_is(sign, "and")) /* the first operand if false, else the second */
        return jox_kind_is_value(a)
                   ? b
                   : join_kinds(b, (JoxKind){.bits = a.bits & (JOX_KIND_FALSE | JOX_KIND_UNKNOWN)});
    if (jox_token_is(sign, "or")) {
        JoxKind left = a;
        left.bits &= (uint8_t)~JOX_KIND_FALSE;
        return jox_kind_is_value(a) ? a : join_kinds(left, b);
    }
    for (size_t i = 0; i < sizeof COMPARES / sizeof *COMPARES; i++)
        if (jox_token_is(sign, COMPARES[i]))
            return TRUTH;
    for (size_t i = 0; i < sizeof PLAIN_ONES / sizeof *PLAIN_ONES; i++)
        if (jox_token_is(sign, PLAIN_ONES[i]))
            return PLAIN;
    const uint8_t bits = a.bits | b.bits;
    if (bits & JOX_KIND_CONDITION)
        return CONDITION;
    if (bits & JOX_KIND_VALUE)
        return VALUE;
    return bits & JOX_KIND_UNKNOWN ? UNKNOWN : (JoxKind){.bits = bits};
}

static JoxKind infer_unary(const JoxToken *sign, JoxKind a) {
    if (jox_token_is(sign, "not"))
        return TRUTH;
    return jox_token_is(sign, "#") ? PLAIN : a;
}

static JoxKind infer_tree(JoxKinds *k, uint32_t source, int32_t tree) {
    const JoxSyntax *s = get_syntax(k, source);
    const JoxTree *t = &s->trees[tree];
    const JoxKind *known = k->trees[source];
    k->looks++;
    switch (t->kind) {
    case JOX_TREE_CONSTANT:
        return PLAIN;
    case JOX_TREE_FALSE:
        return FALSE;
    case JOX_TREE_REST:
        return UNKNOWN;
    case JOX_TREE_NAME:
        return t->variable == JOX_NO_TREE ? infer_global(k, jox_syntax_token(s, tree))
                                          : k->variables[source][t->variable];
    case JOX_TREE_INDEX:
        return infer_index(k, source, t);
    case JOX_TREE_CALL:
        return infer_call(k, source, t);
    case JOX_TREE_METHOD:
        return infer_method(s, tree);
    case JOX_TREE_FUNCTION:
        return (JoxKind){JOX_KIND_FUNCTION, JOX_SITE_TREE, source, tree};
    case JOX_TREE_TABLE:
        return (JoxKind){JOX_KIND_TABLE, JOX_SITE_TREE, source, tree};
    case JOX_TREE_FIELD:
        return known[t->b];
    case JOX_TREE_BINARY:
        return infer_binary(jox_syntax_token(s, tree), known[t->a], known[t->b]);
    case JOX_TREE_UNARY:
        return infer_unary(jox_syntax_token(s, tree), known[t->a]);
    case JOX_TREE_PAREN:
        return known[t->a];
    }
    return UNKNOWN;
}

/* ---- variables ---- */

/* Returns the kind of the items in a loop by pairs or ipairs over a table constructor. */
static JoxKind infer_loop_item(JoxKinds *k, uint32_t source, int32_t over) {
    const JoxSyntax *s = get_syntax(k, source);
    const JoxTree *call = &s->trees[over];
    if (call->kind != JOX_TREE_CALL || call->items < 0)
        return UNKNOWN;
    const JoxKind table = k->trees[source][call->items];
    const JoxToken *name = jox_syntax_token(s, call->a);
    const bool pairs = s->trees[call->a].kind == JOX_TREE_NAME &&
                       (jox_token_is(name, "pairs") || jox_token_is(name, "ipairs"));
    if (pairs && table.bits == JOX_KIND_TABLE && table.site == JOX_SITE_TREE)
        return infer_field(k, table, NULL);
    return table.bits == 0 ? NOTHING : UNKNOWN;
}

/* Sets the kinds of parameters from the recorded calls. */
static void set_parameter_kinds(JoxKinds *k, uint32_t source) {
    const JoxSyntax *s = get_syntax(k, source);
    for (size_t v = 0; v < s->variable_count; v++) {
        const JoxTreeVariable *variable = &s->variables[v];
        if (variable->parameter == JOX_NO_TREE)
            continue;
        const JoxCallFact *fact = variable->parameter < JOX_FACT_PARAMETERS
                                      ? find_call_fact(k, source, variable->function)
                                      : NULL;
        const uint8_t given = fact ? fact->given[variable->parameter] : 0;
        k->looks += s->function_count + k->script->fact_count;
        k->variables[source][v] = UNKNOWN;
        if (given)
            k->variables[source][v].bits = given;
    }
}

/* Adds the kinds of assigned values to those of variables. */
static void widen_variables(JoxKinds *k, uint32_t source) {
    const JoxSyntax *s = get_syntax(k, source);
    for (size_t b = 0; b < s->binding_count; b++) {
        const JoxTreeBinding *bound = &s->bindings[b];
        const JoxTree *target = &s->trees[bound->target];
        if (target->kind != JOX_TREE_NAME || target->variable == JOX_NO_TREE)
            continue;
        JoxKind kind = UNKNOWN;
        if (bound->kind == JOX_BIND_VALUE)
            kind = k->trees[source][bound->value];
        else if (bound->kind == JOX_BIND_NIL)
            kind = FALSE;
        else if (bound->kind == JOX_BIND_NUMBER)
            kind = PLAIN;
        else if (bound->kind == JOX_BIND_ITEM)
            kind = infer_loop_item(k, source, bound->value);
        widen_kind(k, &k->variables[source][target->variable], kind);
    }
}

JoxKinds *jox_kinds_read(const JoxScript *script) {
    JoxKinds *k = jox_alloc(1, sizeof *k);
    k->script = script;
    k->source_count = (uint32_t)script->vm.source_count;
    k->trees = jox_alloc(k->source_count + 1, sizeof *k->trees);
    k->variables = jox_alloc(k->source_count + 1, sizeof *k->variables);
    for (uint32_t n = 0; n < k->source_count; n++) {
        const JoxSyntax *s = jox_outline_syntax(script->vm.sources[n]);
        if (!s->whole)
            continue;
        k->trees[n] = jox_alloc(s->tree_count + 1, sizeof **k->trees);
        k->variables[n] = jox_alloc(s->variable_count + 1, sizeof **k->variables);
        set_parameter_kinds(k, n);
    }
    for (int pass = 0; pass < MOST_PASSES && k->looks < MOST_LOOKS && !k->settled; pass++) {
        k->changed = false;
        for (uint32_t n = 0; n < k->source_count; n++) {
            if (!k->trees[n])
                continue;
            const size_t count = get_syntax(k, n)->tree_count;
            for (size_t t = 0; t < count && k->looks < MOST_LOOKS; t++)
                widen_kind(k, &k->trees[n][t], infer_tree(k, n, (int32_t)t));
            widen_variables(k, n);
        }
        k->settled = !k->changed && k->looks < MOST_LOOKS;
    }
    return k;
}

void jox_kinds_free(JoxKinds *k) {
    if (!k)
        return;
    for (uint32_t n = 0; n < k->source_count; n++) {
        jox_free(k->trees[n]);
        jox_free(k->variables[n]);
    }
    jox_free(k->trees);
    jox_free(k->variables);
    jox_free(k);
}
