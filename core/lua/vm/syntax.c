/* Parses Lua's statements by recursive descent over the tokens of a file. Lua has compiled the file
   before, so syntax errors need no report; at anything unexpected the parser stops. */
#include "lua/vm/syntax.h"
#include "base/mem.h"
#include "lua/vm/parse.h"

static void parse_block(JoxParser *p);

/* Binds a list of targets to a list of values as Lua's multiple assignment does. */
static void bind_targets(JoxParser *p, const int32_t *targets, size_t count, int32_t first,
                         bool declares) {
    int32_t value = first;
    bool many = false; /* the last value is a call or `...`, which may give several */
    for (size_t i = 0; i < count; i++) {
        if (value >= 0) {
            JoxTreeKind kind = jox_parse_tree(p, value)->kind;
            jox_parse_bind(p, JOX_BIND_VALUE, targets[i], value, declares);
            many = kind == JOX_TREE_CALL || kind == JOX_TREE_METHOD || kind == JOX_TREE_REST;
            value = jox_parse_tree(p, value)->next;
        } else {
            jox_parse_bind(p, many ? JOX_BIND_REST : JOX_BIND_NIL, targets[i], JOX_NO_TREE,
                           declares);
        }
    }
}

enum { MOST_TARGETS = 256 };

static void parse_local(JoxParser *p) {
    int32_t names[MOST_TARGETS], last, values = JOX_NO_TREE;
    size_t count = 0;
    if (jox_parse_accept(p, "function")) {
        const uint32_t function = (uint32_t)p->at - 1;
        const int32_t variable = jox_parse_declare(p, jox_parse_name(p), JOX_NO_TREE);
        if (p->failed)
            return;
        jox_parse_show(p, variable);
        const int32_t name = jox_parse_declared(p, variable);
        jox_parse_bind(p, JOX_BIND_VALUE, name, jox_parse_function(p, function, false), true);
        return;
    }
    do {
        names[count++] = jox_parse_declare(p, jox_parse_name(p), JOX_NO_TREE);
        if (jox_parse_accept(p, "<")) {
            jox_parse_name(p);
            jox_parse_expect(p, ">");
        }
    } while (jox_parse_accept(p, ",") && count < MOST_TARGETS);
    if (jox_parse_accept(p, "="))
        values = jox_parse_list(p, &last);
    if (p->failed)
        return;
    for (size_t i = 0; i < count; i++) {
        jox_parse_show(p, names[i]);
        names[i] = jox_parse_declared(p, names[i]);
    }
    bind_targets(p, names, count, values, true);
}

static void parse_for(JoxParser *p) {
    const size_t visible = p->visible_count;
    int32_t names[MOST_TARGETS], last, values;
    size_t count = 0;
    do
        names[count++] = jox_parse_declare(p, jox_parse_name(p), JOX_NO_TREE);
    while (jox_parse_accept(p, ",") && count < MOST_TARGETS);
    const bool numeric = jox_parse_accept(p, "=");
    if (!numeric)
        jox_parse_expect(p, "in");
    values = jox_parse_list(p, &last);
    jox_parse_expect(p, "do");
    if (p->failed)
        return;
    for (size_t i = 0; i < count; i++) {
        jox_parse_show(p, names[i]);
        jox_parse_bind(p,
                       numeric  ? JOX_BIND_NUMBER
                       : i == 0 ? JOX_BIND_KEY
                       : i == 1 ? JOX_BIND_ITEM
                                : JOX_BIND_REST,
                       jox_parse_declared(p, names[i]), values, true);
    }
    parse_block(p);
    jox_parse_expect(p, "end");
    p->visible_count = visible;
}

/* Marks the nodes that a condition's truth depends on: through parentheses, and, or, not. */
static void mark_tested(JoxParser *p, int32_t tree) {
    while (tree >= 0) {
        JoxTree *t = jox_parse_tree(p, tree);
        const JoxToken *sign = &p->tokens[t->at];
        t->tested = true;
        if (t->kind == JOX_TREE_BINARY && (jox_token_is(sign, "and") || jox_token_is(sign, "or")))
            mark_tested(p, t->b);
        else if (t->kind != JOX_TREE_PAREN &&
                 !(t->kind == JOX_TREE_UNARY && jox_token_is(sign, "not")))
            return;
        tree = t->a;
    }
}

static void parse_test(JoxParser *p, uint32_t at) {
    JoxSyntax *s = p->tree;
    const int32_t value = jox_parse_expression(p, 0);
    if (p->failed)
        return;
    mark_tested(p, value);
    JOX_RESERVE(s->tests, s->test_capacity, s->test_count + 1);
    s->tests[s->test_count++] = (JoxTreeTest){at, value};
}

static void parse_if(JoxParser *p, uint32_t at) {
    do {
        parse_test(p, at);
        jox_parse_expect(p, "then");
        parse_block(p);
        at = (uint32_t)p->at;
    } while (jox_parse_accept(p, "elseif"));
    if (jox_parse_accept(p, "else"))
        parse_block(p);
    jox_parse_expect(p, "end");
}

static void parse_repeat(JoxParser *p) {
    const size_t visible = p->visible_count;
    /* The condition of `until` sees the block's variables, which parse_block leaves in scope. */
    parse_block(p);
    const uint32_t at = (uint32_t)p->at;
    jox_parse_expect(p, "until");
    parse_test(p, at);
    p->visible_count = visible;
}

static void parse_return(JoxParser *p) {
    JoxSyntax *s = p->tree;
    int32_t value = JOX_NO_TREE, last;
    if (!jox_parse_is(p, "end") && !jox_parse_is(p, "else") && !jox_parse_is(p, "elseif") &&
        !jox_parse_is(p, "until") && !jox_parse_is(p, ";") && p->at < p->count)
        value = jox_parse_list(p, &last);
    jox_parse_accept(p, ";");
    p->returned = p->at;
    JOX_RESERVE(s->returns, s->return_capacity, s->return_count + 1);
    s->returns[s->return_count++] = (JoxTreeReturn){p->function, value};
}

/* Parses function a.b:c(...) ... end. */
static void parse_named_function(JoxParser *p, uint32_t at) {
    bool method = false;
    int32_t target = jox_parse_used(p, jox_parse_name(p));
    while (!p->failed && !method && (jox_parse_is(p, ".") || jox_parse_is(p, ":"))) {
        method = jox_parse_is(p, ":");
        p->at++;
        const uint32_t name = jox_parse_name(p);
        const int32_t whole = jox_parse_add(p, JOX_TREE_INDEX, name);
        jox_parse_tree(p, whole)->a = target;
        jox_parse_tree(p, whole)->named = true;
        target = whole;
    }
    if (!p->failed)
        jox_parse_bind(p, JOX_BIND_VALUE, target, jox_parse_function(p, at, method), false);
}

/* Parses an assignment or a call. */
static void parse_assignment(JoxParser *p) {
    int32_t targets[MOST_TARGETS], last;
    size_t count = 0;
    do
        targets[count++] = jox_parse_suffixed(p);
    while (jox_parse_accept(p, ",") && count < MOST_TARGETS);
    if (jox_parse_accept(p, "=")) {
        int32_t values = jox_parse_list(p, &last);
        if (!p->failed)
            bind_targets(p, targets, count, values, false);
    }
}

static void parse_statement(JoxParser *p) {
    const uint32_t at = (uint32_t)p->at;
    if (jox_parse_accept(p, ";") || jox_parse_accept(p, "break"))
        return;
    if (jox_parse_accept(p, "::")) {
        jox_parse_name(p);
        jox_parse_expect(p, "::");
    } else if (jox_parse_is(p, "goto") && at + 1 < p->count &&
               p->tokens[at + 1].kind == JOX_TOKEN_NAME) {
        p->at += 2;
    } else if (jox_parse_accept(p, "if")) {
        parse_if(p, at);
    } else if (jox_parse_accept(p, "while")) {
        parse_test(p, at);
        jox_parse_expect(p, "do");
        parse_block(p);
        jox_parse_expect(p, "end");
    } else if (jox_parse_accept(p, "do")) {
        parse_block(p);
        jox_parse_expect(p, "end");
    } else if (jox_parse_accept(p, "for")) {
        parse_for(p);
    } else if (jox_parse_accept(p, "repeat")) {
        parse_repeat(p);
    } else if (jox_parse_accept(p, "function")) {
        parse_named_function(p, at);
    } else if (jox_parse_accept(p, "local")) {
        parse_local(p);
    } else if (jox_parse_accept(p, "return")) {
        parse_return(p);
    } else {
        parse_assignment(p);
    }
}

static void parse_block(JoxParser *p) {
    const size_t visible = p->visible_count;
    if (++p->level > JOX_PARSE_LEVELS)
        p->failed = true;
    while (!p->failed && p->at < p->count && !jox_parse_is(p, "end") && !jox_parse_is(p, "else") &&
           !jox_parse_is(p, "elseif") && !jox_parse_is(p, "until"))
        parse_statement(p);
    p->level--;
    if (!jox_parse_is(
            p, "until")) /* the condition sees the block's variables; parse_repeat removes them */
        p->visible_count = visible;
}

JoxSyntax *jox_syntax_read(const JoxSource *source) {
    JoxSyntax *s = jox_alloc(1, sizeof *s);
    JoxParser p = {
        .tree = s, .tokens = source->tokens, .count = source->token_count, .block = parse_block};
    s->source = source;
    JOX_RESERVE(s->functions, s->function_capacity, 1);
    s->functions[s->function_count++] = (JoxTreeFunction){.parent = JOX_NO_TREE};
    parse_block(&p);
    s->whole = !p.failed && p.at == p.count;
    jox_free(p.visible);
    return s;
}

void jox_syntax_free(JoxSyntax *s) {
    if (!s)
        return;
    jox_free(s->trees);
    jox_free(s->variables);
    jox_free(s->functions);
    jox_free(s->bindings);
    jox_free(s->returns);
    jox_free(s->tests);
    jox_free(s);
}

bool jox_syntax_within(const JoxSyntax *syntax, int32_t inner, int32_t outer) {
    while (inner != JOX_NO_TREE && inner != outer)
        inner = syntax->functions[inner].parent;
    return inner == outer;
}

int32_t jox_syntax_bare(const JoxSyntax *syntax, int32_t tree) {
    while (tree >= 0 && syntax->trees[tree].kind == JOX_TREE_PAREN)
        tree = syntax->trees[tree].a;
    return tree;
}
