/* Parses expressions by precedence climbing. Called by the statements in syntax.c. */
#include "base/mem.h"
#include "lua/vm/parse.h"

enum { UNARY_LIMIT = 12 };

int32_t jox_parse_list(JoxParser *p, int32_t *last) {
    int32_t first = JOX_NO_TREE;
    *last = JOX_NO_TREE;
    do {
        int32_t item = jox_parse_expression(p, 0);
        if (p->failed)
            return JOX_NO_TREE;
        if (first < 0)
            first = item;
        else
            jox_parse_tree(p, *last)->next = item;
        *last = item;
    } while (jox_parse_accept(p, ","));
    return first;
}

int32_t jox_parse_function(JoxParser *p, uint32_t at, bool method) {
    const int line = p->tokens[at].line;
    JoxSyntax *s = p->tree;
    const int32_t outer = p->function;
    const size_t visible = p->visible_count;
    int32_t tree = jox_parse_add(p, JOX_TREE_FUNCTION, at), count = 0;
    JOX_RESERVE(s->functions, s->function_capacity, s->function_count + 1);
    const int32_t number = (int32_t)s->function_count++;
    s->functions[number] = (JoxTreeFunction){line, line, outer, false};
    jox_parse_tree(p, tree)->variable = p->function = number;
    count += method; /* `self` has no token: uses of it resolve to a global */
    jox_parse_expect(p, "(");
    while (jox_parse_is_name(p)) {
        jox_parse_show(p, jox_parse_declare(p, jox_parse_name(p), count++));
        if (!jox_parse_accept(p, ","))
            break;
    }
    jox_parse_accept(p, "...");
    jox_parse_expect(p, ")");
    p->block(p);
    s->functions[number].returns = p->returned == p->at;
    if (p->at < p->count)
        s->functions[number].last_line = p->tokens[p->at].line;
    jox_parse_expect(p, "end");
    p->function = outer;
    p->visible_count = visible;
    return tree;
}

static int32_t parse_table_field(JoxParser *p) {
    int32_t key = JOX_NO_TREE;
    uint32_t at = (uint32_t)p->at;
    bool named = false;
    if (jox_parse_accept(p, "[")) {
        key = jox_parse_expression(p, 0);
        jox_parse_expect(p, "]");
        jox_parse_expect(p, "=");
    } else if (jox_parse_is_name(p) && p->at + 1 < p->count &&
               jox_token_is(&p->tokens[p->at + 1], "=")) {
        named = true;
        p->at += 2;
    }
    int32_t value = jox_parse_expression(p, 0);
    int32_t field = jox_parse_add(p, JOX_TREE_FIELD, at);
    JoxTree *t = jox_parse_tree(p, field);
    t->a = key;
    t->b = value;
    t->named = named;
    return field;
}

/* Parses a table constructor; its fields come before it in the list of nodes. */
static int32_t parse_table(JoxParser *p) {
    const uint32_t at = (uint32_t)p->at;
    int32_t first = JOX_NO_TREE, last = JOX_NO_TREE;
    jox_parse_expect(p, "{");
    while (!p->failed && !jox_parse_is(p, "}")) {
        int32_t field = parse_table_field(p);
        if (first < 0)
            first = field;
        else
            jox_parse_tree(p, last)->next = field;
        last = field;
        if (!jox_parse_accept(p, ",") && !jox_parse_accept(p, ";"))
            break;
    }
    jox_parse_expect(p, "}");
    int32_t table = jox_parse_add(p, JOX_TREE_TABLE, at);
    jox_parse_tree(p, table)->items = first;
    return table;
}

/* Parses the arguments of a call into a list; *call tells whether there is a parenthesis, string or
   table at all. */
static int32_t parse_arguments(JoxParser *p, bool *call) {
    int32_t last;
    *call = true;
    if (jox_parse_accept(p, "(")) {
        int32_t first = jox_parse_is(p, ")") ? JOX_NO_TREE : jox_parse_list(p, &last);
        jox_parse_expect(p, ")");
        return first;
    }
    if (jox_parse_is(p, "{"))
        return parse_table(p);
    if (p->at < p->count && p->tokens[p->at].kind == JOX_TOKEN_STRING)
        return jox_parse_add(p, JOX_TREE_CONSTANT, (uint32_t)p->at++);
    *call = false;
    return JOX_NO_TREE;
}

int32_t jox_parse_suffixed(JoxParser *p) {
    int32_t left;
    if (jox_parse_is(p, "(")) {
        uint32_t at = (uint32_t)p->at++;
        int32_t inside = jox_parse_expression(p, 0);
        jox_parse_expect(p, ")");
        left = jox_parse_add(p, JOX_TREE_PAREN, at);
        jox_parse_tree(p, left)->a = inside;
    } else {
        left = jox_parse_used(p, jox_parse_name(p));
    }
    while (!p->failed && p->at < p->count) {
        const uint32_t at = (uint32_t)p->at;
        int32_t whole, key = JOX_NO_TREE, items = JOX_NO_TREE;
        bool call = false, named = false;
        JoxTreeKind kind = JOX_TREE_INDEX;
        uint32_t where = at;
        if (jox_parse_accept(p, ".")) {
            where = jox_parse_name(p);
            named = true;
        } else if (jox_parse_accept(p, "[")) {
            key = jox_parse_expression(p, 0);
            jox_parse_expect(p, "]");
        } else if (jox_parse_accept(p, ":")) {
            kind = JOX_TREE_METHOD;
            where = jox_parse_name(p);
            items = parse_arguments(p, &call);
            p->failed |= !call;
        } else {
            kind = JOX_TREE_CALL;
            items = parse_arguments(p, &call);
            if (!call)
                break;
        }
        if (p->failed)
            break;
        whole = jox_parse_add(p, kind, where);
        JoxTree *t = jox_parse_tree(p, whole);
        t->a = left;
        t->b = key;
        t->items = items;
        t->named = named;
        left = whole;
    }
    return left;
}

static int32_t parse_simple(JoxParser *p) {
    if (p->at >= p->count) {
        p->failed = true;
        return JOX_NO_TREE;
    }
    const JoxToken *t = &p->tokens[p->at];
    const uint32_t at = (uint32_t)p->at;
    if (jox_parse_is(p, "{"))
        return parse_table(p);
    if (jox_parse_accept(p, "function"))
        return jox_parse_function(p, at, false);
    if (jox_parse_accept(p, "nil") || jox_parse_accept(p, "false"))
        return jox_parse_add(p, JOX_TREE_FALSE, at);
    if (jox_parse_accept(p, "..."))
        return jox_parse_add(p, JOX_TREE_REST, at);
    if (t->kind == JOX_TOKEN_STRING || t->kind == JOX_TOKEN_NUMBER || jox_parse_is(p, "true")) {
        p->at++;
        return jox_parse_add(p, JOX_TREE_CONSTANT, at);
    }
    return jox_parse_suffixed(p);
}

/* Returns how tightly a binary operator binds on its left side, and in *right on its right; 0 for
   any other token. */
static int get_binding_power(const JoxToken *t, int *right) {
    static const struct {
        const char *sign;
        int left, right;
    } POWERS[] = {{"or", 1, 1},  {"and", 2, 2}, {"<", 3, 3},   {">", 3, 3},    {"<=", 3, 3},
                  {">=", 3, 3},  {"~=", 3, 3},  {"==", 3, 3},  {"|", 4, 4},    {"~", 5, 5},
                  {"&", 6, 6},   {"<<", 7, 7},  {">>", 7, 7},  {"..", 9, 8},   {"+", 10, 10},
                  {"-", 10, 10}, {"*", 11, 11}, {"/", 11, 11}, {"//", 11, 11}, {"%", 11, 11},
                  {"^", 14, 13}};
    for (size_t i = 0; i < sizeof POWERS / sizeof *POWERS; i++)
        if (jox_token_is(t, POWERS[i].sign)) {
            *right = POWERS[i].right;
            return POWERS[i].left;
        }
    return 0;
}

int32_t jox_parse_expression(JoxParser *p, int limit) {
    const uint32_t first = (uint32_t)p->at;
    int32_t left;
    int right = 0, power;
    if (++p->level > JOX_PARSE_LEVELS)
        p->failed = true;
    if (jox_parse_is(p, "not") || jox_parse_is(p, "-") || jox_parse_is(p, "#") ||
        jox_parse_is(p, "~")) {
        const uint32_t at = (uint32_t)p->at++;
        const int32_t operand = jox_parse_expression(p, UNARY_LIMIT);
        left = jox_parse_add(p, JOX_TREE_UNARY, at);
        jox_parse_tree(p, left)->a = operand;
    } else {
        left = p->failed ? JOX_NO_TREE : parse_simple(p);
    }
    while (!p->failed && p->at < p->count &&
           (power = get_binding_power(&p->tokens[p->at], &right)) > limit) {
        const uint32_t at = (uint32_t)p->at++;
        const int32_t other = jox_parse_expression(p, right);
        const int32_t whole = jox_parse_add(p, JOX_TREE_BINARY, at);
        JoxTree *t = jox_parse_tree(p, whole);
        t->a = left;
        t->b = other;
        left = whole;
    }
    p->level--;
    if (!p->failed) {
        jox_parse_tree(p, left)->first = first;
        jox_parse_tree(p, left)->last = (uint32_t)p->at;
    }
    return left;
}
