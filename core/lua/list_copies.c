/* Finds functions that write into the copy of a list in memory: `me.ids[1] = 3` and
   `table.insert(me.ids, 3)` change nothing that the agent remembers. Called by build.c. */
#include <string.h>

#include "lua/read_table.h"

/* Returns whether a node is a list in memory, of `me` or of a view in a function. */
static bool is_list(const JoxScript *script, const JoxSyntax *s, int32_t tree) {
    const JoxTree *t = tree < 0 ? NULL : &s->trees[jox_syntax_bare(s, tree)];
    if (!t || t->kind != JOX_TREE_INDEX || !t->named)
        return false;
    const JoxTree *of = &s->trees[jox_syntax_bare(s, t->a)];
    if (of->kind != JOX_TREE_NAME || of->variable == JOX_NO_TREE ||
        s->variables[of->variable].function == 0)
        return false;
    for (uint32_t m = 0; m < script->memory_count; m++)
        if (jox_memory_is_list(&script->memory[m]) &&
            jox_token_says(&s->source->tokens[t->at], script->memory[m].name))
            return true;
    return false;
}

/* Returns whether a node is a function of `table` that changes its first argument. */
static bool changes_table(const JoxSyntax *s, int32_t tree) {
    static const char *const CHANGING[] = {"insert", "remove", "sort"};
    const JoxTree *t = &s->trees[jox_syntax_bare(s, tree)];
    if (t->kind != JOX_TREE_INDEX || !t->named)
        return false;
    const JoxTree *of = &s->trees[jox_syntax_bare(s, t->a)];
    if (of->kind != JOX_TREE_NAME || !jox_token_is(&s->source->tokens[of->at], "table"))
        return false;
    for (size_t k = 0; k < sizeof CHANGING / sizeof *CHANGING; k++)
        if (jox_token_is(&s->source->tokens[t->at], CHANGING[k]))
            return true;
    return false;
}

static void report_copy(JoxBuild *b, const JoxSyntax *s, int32_t list) {
    const JoxToken *t = jox_syntax_token(s, jox_syntax_bare(s, list));
    jox_build_error(
        b, (JoxPosition){s->source->path, t->line, t->column, t->end_column}, "copied-list",
        "Change a copy and set it: local list = me.NAME, list[#list + 1] = 3, me.NAME = "
        "list",
        "reading the list '%.*s' makes a copy, and this changes the copy alone",
        t->length < 60 ? (int)t->length : 60, t->text);
}

void jox_list_copies_find(JoxBuild *b) {
    const JoxScript *script = b->script;
    for (uint32_t n = 0; n < script->vm.source_count; n++) {
        const JoxSyntax *s = jox_outline_syntax(script->vm.sources[n]);
        for (size_t k = 0; s->whole && k < s->binding_count; k++) {
            const JoxTree *target = &s->trees[s->bindings[k].target];
            if (!s->bindings[k].declares && target->kind == JOX_TREE_INDEX &&
                is_list(script, s, target->a))
                report_copy(b, s, target->a);
        }
        for (size_t t = 0; s->whole && t < s->tree_count; t++)
            if (s->trees[t].kind == JOX_TREE_CALL && changes_table(s, s->trees[t].a) &&
                is_list(script, s, s->trees[t].items))
                report_copy(b, s, s->trees[t].items);
    }
}
