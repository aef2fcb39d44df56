/* Finds assignments, in the functions of a file, of variables declared outside of the function,
   with their column. The loader refuses them; what the syntax tree does not show, vm/upvalues.c
   finds after a call. */
#include "lua/language/script.h"

/* Returns whether a node in function `f` is a variable of this name that is declared outside of
   `f`. */
static bool is_shared(const JoxSyntax *s, int32_t tree, int32_t f, const char *name) {
    const JoxTree *t = &s->trees[tree];
    return t->kind == JOX_TREE_NAME && t->variable != JOX_NO_TREE &&
           jox_token_is(jox_syntax_token(s, tree), name) && jox_syntax_within(s, t->function, f) &&
           !jox_syntax_within(s, s->variables[t->variable].function, f);
}

/* Returns the first token in function `f` that assigns a variable of this name from outside of it;
   NULL if there is none. */
static const JoxToken *find_assignment(const JoxSyntax *s, int32_t f, const char *name) {
    const JoxToken *first = NULL;
    for (size_t b = 0; b < s->binding_count; b++) {
        const JoxTreeBinding *bound = &s->bindings[b];
        if (bound->declares || !is_shared(s, bound->target, f, name))
            continue;
        const JoxToken *t = jox_syntax_token(s, bound->target);
        if (!first || t < first)
            first = t;
    }
    return first;
}

/* Returns whether function `f` uses a variable of this name that is declared outside of it. */
static bool uses_shared(const JoxSyntax *s, int32_t f, const char *name) {
    for (size_t t = 0; t < s->tree_count; t++)
        if (is_shared(s, (int32_t)t, f, name))
            return true;
    return false;
}

bool jox_outline_assigns_shared(const JoxSource *source) {
    const JoxSyntax *s = jox_outline_syntax(source);
    for (size_t b = 0; s->whole && b < s->binding_count; b++) {
        const JoxTree *t = &s->trees[s->bindings[b].target];
        if (!s->bindings[b].declares && t->kind == JOX_TREE_NAME && t->variable != JOX_NO_TREE &&
            t->function != s->variables[t->variable].function)
            return true;
    }
    return !s->whole;
}

const JoxToken *jox_outline_assigned(const JoxSource *source, int first_line, int last_line,
                                     const char *const *names, size_t name_count) {
    const JoxSyntax *s = jox_outline_syntax(source);
    const JoxToken *first = NULL;
    for (size_t n = 0; s->whole && n < name_count; n++) {
        const JoxToken *found = NULL;
        bool sure = true;
        for (size_t f = 1; f < s->function_count; f++) {
            if (s->functions[f].first_line != first_line || s->functions[f].last_line != last_line)
                continue;
            const JoxToken *here = find_assignment(s, (int32_t)f, names[n]);
            /* a function on the same lines that only reads it may be the one that is meant */
            sure = sure && (here || !uses_shared(s, (int32_t)f, names[n]));
            found = found ? found : here;
        }
        if (found && sure && (!first || found < first))
            first = found;
    }
    return first;
}
