/* Which variables the functions of a source assign though they were declared outside of them. A
   small resolver of scopes over the tokens: it needs no knowledge of Lua's compiled form, and it
   knows the column. Where it cannot tell, it says nothing: upvalues.c catches what is left when the
   function runs. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/language/script.h"

enum { MOST_LOOKS = 20000000, NOWHERE = -1 };

/* What a token opened: brackets, in which `=` belongs to a field; a block; the head of a loop,
   whose block begins at `do`; a function. */
typedef enum { OPEN_BRACKET, OPEN_BLOCK, OPEN_LOOP, OPEN_REPEAT, OPEN_FUNCTION } OpenKind;
typedef struct Open {
    OpenKind kind;
    size_t locals;    /* declared outside of it */
    int32_t function; /* that it is in; of OPEN_FUNCTION: itself */
} Open;

typedef struct Local {
    const JoxToken *name;
    int32_t function; /* that declared it */
} Local;

typedef struct Function {
    int first_line, last_line;
    int32_t parent; /* NOWHERE for the file itself */
} Function;

/* A use of a declared variable: the function it stands in and the one that declared the variable.
 */
typedef struct Use {
    const JoxToken *name;
    int32_t function, home;
    bool assigns;
} Use;

struct JoxScopes {
    const JoxSource *source;
    Open *open;
    size_t open_count, open_capacity;
    Local *locals;
    size_t local_count, local_capacity;
    Function *functions;
    size_t function_count, function_capacity;
    Use *uses;
    size_t use_count, use_capacity;
    uint32_t looks;
};
typedef struct JoxScopes Scopes;

static bool same_name(const JoxToken *a, const JoxToken *b) {
    return a->length == b->length && memcmp(a->text, b->text, a->length) == 0;
}

static int32_t function_now(const Scopes *s) {
    JOX_ASSERT(s->open_count > 0);
    return s->open[s->open_count - 1].function;
}

static void push_open(Scopes *s, OpenKind kind, int32_t function) {
    JOX_RESERVE(s->open, s->open_capacity, s->open_count + 1);
    s->open[s->open_count++] = (Open){kind, s->local_count, function};
}

/* Ends the innermost scope of these two kinds; the outermost, that of the file, stays. */
static void pop_open(Scopes *s, OpenKind kind, OpenKind other) {
    const Open *top = &s->open[s->open_count - 1];
    if (s->open_count > 1 && (top->kind == kind || top->kind == other)) {
        JOX_ASSERT(top->locals <= s->local_count);
        s->local_count = top->locals;
        s->open_count--;
    }
}

static void declare(Scopes *s, const JoxToken *name) {
    JOX_RESERVE(s->locals, s->local_capacity, s->local_count + 1);
    s->locals[s->local_count++] = (Local){name, function_now(s)};
}

static void use(Scopes *s, const JoxToken *name, bool assigns) {
    for (size_t i = s->local_count; i-- > 0 && s->looks < MOST_LOOKS; s->looks++)
        if (same_name(s->locals[i].name, name)) {
            JOX_RESERVE(s->uses, s->use_capacity, s->use_count + 1);
            s->uses[s->use_count++] = (Use){name, function_now(s), s->locals[i].function, assigns};
            return;
        }
}

static bool is(const Scopes *s, size_t at, const char *text) {
    return at < s->source->token_count && jox_token_is(&s->source->tokens[at], text);
}

static bool is_name(const Scopes *s, size_t at) {
    return at < s->source->token_count && s->source->tokens[at].kind == JOX_TOKEN_NAME;
}

/* Declares a list of names, `a <const>, b`, from token `at` on; returns the token after it. */
static size_t declare_names(Scopes *s, size_t at) {
    while (is_name(s, at)) {
        declare(s, &s->source->tokens[at++]);
        if (is(s, at, "<"))
            at += 3;
        if (!is(s, at, ","))
            break;
        at++;
    }
    return at;
}

/* `function` at token `at`; returns the token after its parameters. */
static size_t begin_function(Scopes *s, size_t at) {
    const JoxToken *t = s->source->tokens;
    const int line = t[at].line;
    const bool local = at > 0 && jox_token_is(&t[at - 1], "local");
    size_t next = at + 1;
    if (is_name(s, next)) {
        bool plain = !is(s, next + 1, ".") && !is(s, next + 1, ":");
        if (local)
            declare(s, &t[next]);
        else if (plain)
            use(s, &t[next], true);
        while (next < s->source->token_count && !is(s, next, "("))
            next++;
    }
    JOX_RESERVE(s->functions, s->function_capacity, s->function_count + 1);
    int32_t number = (int32_t)s->function_count++;
    s->functions[number] = (Function){line, line, function_now(s)};
    push_open(s, OPEN_FUNCTION, number);
    return declare_names(s, next + 1);
}

/* The bracket that opens what closes at token `at`; `at` itself where nothing closes. */
static size_t opening_bracket(Scopes *s, size_t at) {
    int depth = 0;
    do {
        bool closes = is(s, at, ")") || is(s, at, "]") || is(s, at, "}");
        depth += closes - (is(s, at, "(") || is(s, at, "[") || is(s, at, "{"));
        s->looks++;
    } while (depth > 0 && at-- > 0);
    return at;
}

/* `=` of a statement at token `at`: every target that is a plain name is assigned. */
static void assign_targets(Scopes *s, size_t at) {
    const JoxToken *t = s->source->tokens;
    while (at-- > 0 && s->looks < MOST_LOOKS) {
        bool plain = t[at].kind == JOX_TOKEN_NAME;
        size_t first = at; /* of this target */
        for (;; first--) {
            if (first >= s->source->token_count)
                return;
            if (t[first].kind == JOX_TOKEN_SYMBOL)
                first = opening_bracket(s, first);
            bool suffix = first > 0 && (t[first].kind != JOX_TOKEN_NAME || is(s, first - 1, ".") ||
                                        is(s, first - 1, ":"));
            if (!suffix || first < 2)
                break;
            plain = false;
            if (t[first].kind == JOX_TOKEN_NAME)
                first--; /* then the '.' goes with the step of the loop */
        }
        if (plain)
            use(s, &t[at], true);
        if (first == 0 || !is(s, first - 1, ","))
            return;
        at = first - 1;
    }
}

/* Words that open and close blocks; the token after what was read. */
static size_t read_word(Scopes *s, size_t at) {
    const JoxToken *t = &s->source->tokens[at];
    Open *top = &s->open[s->open_count - 1];
    if (jox_token_is(t, "function"))
        return begin_function(s, at);
    if (jox_token_is(t, "local") && !is(s, at + 1, "function")) {
        at = declare_names(s, at + 1);
        return at + is(s, at, "=");
    }
    if (jox_token_is(t, "for")) {
        push_open(s, OPEN_LOOP, function_now(s));
        at = declare_names(s, at + 1);
        return at + is(s, at, "=");
    }
    if (jox_token_is(t, "while"))
        push_open(s, OPEN_LOOP, function_now(s));
    else if (jox_token_is(t, "do") && top->kind == OPEN_LOOP)
        top->kind = OPEN_BLOCK;
    else if (jox_token_is(t, "do") || jox_token_is(t, "then"))
        push_open(s, OPEN_BLOCK, function_now(s));
    else if (jox_token_is(t, "elseif"))
        pop_open(s, OPEN_BLOCK, OPEN_BLOCK);
    else if (jox_token_is(t, "else")) {
        pop_open(s, OPEN_BLOCK, OPEN_BLOCK);
        push_open(s, OPEN_BLOCK, function_now(s));
    } else if (jox_token_is(t, "repeat"))
        push_open(s, OPEN_REPEAT, function_now(s));
    else if (jox_token_is(t, "until") && top->kind == OPEN_REPEAT)
        s->open_count--; /* its condition still sees its variables: they stay a little longer */
    else if (jox_token_is(t, "end")) {
        if (top->kind == OPEN_FUNCTION)
            s->functions[top->function].last_line = t->line;
        pop_open(s, OPEN_BLOCK, OPEN_FUNCTION);
    } else
        use(s, t, false); /* or a field of that name: taken for a use, to be careful */
    return at + 1;
}

static size_t read_token(Scopes *s, size_t at) {
    const JoxToken *t = &s->source->tokens[at];
    if (t->kind == JOX_TOKEN_NAME)
        return read_word(s, at);
    if (t->kind != JOX_TOKEN_SYMBOL)
        return at + 1;
    if (jox_token_is(t, "(") || jox_token_is(t, "[") || jox_token_is(t, "{"))
        push_open(s, OPEN_BRACKET, function_now(s));
    else if (jox_token_is(t, ")") || jox_token_is(t, "]") || jox_token_is(t, "}"))
        pop_open(s, OPEN_BRACKET, OPEN_BRACKET);
    else if (jox_token_is(t, "=") && s->open[s->open_count - 1].kind != OPEN_BRACKET)
        assign_targets(s, at);
    return at + 1;
}

/* Whether `function` is `outer` or stands in it. */
static bool is_within(const Scopes *s, int32_t function, int32_t outer) {
    while (function != NOWHERE && function != outer)
        function = s->functions[function].parent;
    return function == outer;
}

static Scopes *resolve(const JoxSource *source) {
    Scopes *s = jox_alloc(1, sizeof *s);
    s->source = source;
    JOX_RESERVE(s->functions, s->function_capacity, 1);
    s->functions[s->function_count++] = (Function){0, 0, NOWHERE};
    push_open(s, OPEN_FUNCTION, 0);
    for (size_t at = 0; at < source->token_count && s->looks < MOST_LOOKS;) {
        size_t next = read_token(s, at);
        JOX_ASSERT(next > at);
        at = next;
    }
    return s;
}

void jox_scopes_free(struct JoxScopes *s) {
    if (!s)
        return;
    jox_free(s->open);
    jox_free(s->locals);
    jox_free(s->functions);
    jox_free(s->uses);
    jox_free(s);
}

/* The first assignment in function `f` of a variable of that name from outside of it; *uses:
   whether it uses such a variable at all. */
static const JoxToken *assigned_in(const Scopes *s, int32_t f, const char *name, bool *uses) {
    const JoxToken *found = NULL;
    *uses = false;
    for (size_t k = 0; k < s->use_count; k++) {
        const Use *u = &s->uses[k];
        if (!jox_token_is(u->name, name) || !is_within(s, u->function, f) ||
            is_within(s, u->home, f))
            continue;
        *uses = true;
        if (u->assigns && !found)
            found = u->name;
    }
    return found;
}

const JoxToken *jox_outline_assigned(const JoxSource *source, int first_line, int last_line,
                                     const char *const *names, size_t name_count) {
    JoxOutline *outline = jox_outline_of(source);
    if (!outline->scopes)
        outline->scopes = resolve(source);
    const Scopes *s = outline->scopes;
    const JoxToken *first = NULL;
    for (size_t n = 0; n < name_count; n++) {
        const JoxToken *found = NULL;
        bool sure = true;
        for (size_t f = 1; f < s->function_count; f++) {
            if (s->functions[f].first_line != first_line || s->functions[f].last_line != last_line)
                continue;
            bool uses;
            const JoxToken *here = assigned_in(s, (int32_t)f, names[n], &uses);
            sure = sure && (here || !uses); /* else it may be this one, which only reads */
            found = found ? found : here;
        }
        if (found && sure && (!first || found < first))
            first = found;
    }
    return first;
}
