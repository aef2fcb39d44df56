/* Which variables the functions of a source assign though they were declared outside of them. The
   syntax tree tells, with the column. What it does not see, upvalues.c catches when the function
   runs. */
#include "lua/language/script.h"

/* Whether the name at a tree is a variable from outside of function `f`, used within it. */
static bool is_shared(const JoxSyntax *s, int32_t tree, int32_t f, const char *name) {
    const JoxTree *t = &s->trees[tree];
    return t->kind == JOX_TREE_NAME && t->variable != JOX_NO_TREE &&
           jox_token_is(jox_syntax_token(s, tree), name) && jox_syntax_within(s, t->function, f) &&
           !jox_syntax_within(s, s->variables[t->variable].function, f);
}

/* The first assignment in function `f` of a variable of that name from outside of it. */
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

static bool uses_shared(const JoxSyntax *s, int32_t f, const char *name) {
    for (size_t t = 0; t < s->tree_count; t++)
        if (is_shared(s, (int32_t)t, f, name))
            return true;
    return false;
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
            /* else it may be this one, which only reads */
            sure = sure && (here || !uses_shared(s, (int32_t)f, names[n]));
            found = found ? found : here;
        }
        if (found && sure && (!first || found < first))
            first = found;
    }
    return first;
}
