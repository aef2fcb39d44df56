/* Finds where a part of a machine is written if its file does not write it out in one table: in a
   local, by an assignment, or in a function or library that builds it. Follows the machine from the
   file's `return` through the syntax trees. Called by value_sources.c and origin.c. */
#include <stdio.h>
#include <string.h>

#include "lua/infer_kinds.h"
#include "lua/language/vocabulary.h"

enum { DEEPEST_PART = 24, MOST_STEPS = 20000, MOST_STEPS_IN_ALL = 4000000 };

typedef struct PartSearch {
    const JoxKinds *kinds;
    int steps;
    JoxPartOrigin *found;
} PartSearch;

static const JoxSyntax *get_tree(const PartSearch *f, uint32_t source) {
    return jox_outline_syntax(f->kinds->script->vm.sources[source]);
}

static bool follow_value(PartSearch *f, uint32_t source, int32_t tree, const char *path, int depth);

/* Continues with the value of a key; at the end of the path that is the part. */
static bool follow_part_value(PartSearch *f, uint32_t source, uint32_t key, int32_t value,
                              const char *rest, int depth) {
    const JoxTree *t = &get_tree(f, source)->trees[value];
    if (*rest)
        return follow_value(f, source, value, rest + 1, depth);
    *f->found = (JoxPartOrigin){source, key, t->first, t->last};
    return true;
}

typedef enum { KEY_OTHER, KEY_SAME, KEY_COMPUTED } KeyMatch;

/* Compares a key, in brackets or a name, with a name of `length` bytes. */
static KeyMatch match_key(const JoxSyntax *s, const JoxTree *t, int32_t in_brackets,
                          const char *name, size_t length) {
    const JoxToken *token = &s->source->tokens[t->at];
    if (!t->named) {
        if (s->trees[in_brackets].kind != JOX_TREE_CONSTANT)
            return KEY_COMPUTED;
        token = jox_syntax_token(s, in_brackets);
    }
    return token->length == length && memcmp(token->text, name, length) == 0 ? KEY_SAME : KEY_OTHER;
}

/* Follows assignments to a table, `t.name = value` or with a computed key. */
static bool follow_assigned(PartSearch *f, JoxKind table, const char *path, KeyMatch match,
                            int depth) {
    const size_t length = strcspn(path, ".");
    for (uint32_t o = f->kinds->source_count; o-- > 0;) {
        const JoxSyntax *s = get_tree(f, o);
        for (size_t b = f->kinds->trees[o] ? s->binding_count : 0; b-- > 0;) {
            const JoxTreeBinding *bound = &s->bindings[b];
            const JoxTree *target = &s->trees[bound->target];
            f->steps++;
            if (target->kind != JOX_TREE_INDEX || bound->kind != JOX_BIND_VALUE)
                continue;
            const JoxKind to = f->kinds->trees[o][target->a];
            if (to.site == JOX_SITE_TREE && to.source == table.source && to.tree == table.tree &&
                match_key(s, target, target->b, path, length) == match &&
                follow_part_value(f, o, target->at, bound->value, path + length, depth))
                return true;
        }
    }
    return false;
}

/* Follows a field of a table constructor, by name, or by number for an item. */
static bool follow_field(PartSearch *f, JoxKind table, const char *path, int depth) {
    const JoxSyntax *s = get_tree(f, table.source);
    const size_t length = strcspn(path, ".");
    const bool number = length > 0 && strspn(path, "0123456789") == length;
    unsigned item = 0, wanted = 0;
    for (size_t c = 0; number && c < length && wanted < 10000; c++)
        wanted = wanted * 10 + (unsigned)(path[c] - '0');
    for (int32_t t = s->trees[table.tree].items; t >= 0; t = s->trees[t].next, f->steps++) {
        const JoxTree *field = &s->trees[t];
        const bool plain = !field->named && field->a == JOX_NO_TREE;
        item += plain;
        if (plain ? !number || item != wanted
                  : match_key(s, field, field->a, path, length) != KEY_SAME)
            continue;
        if (follow_part_value(f, table.source, field->at + (!plain && !field->named), field->b,
                              path + length, depth))
            return true;
    }
    return false;
}

/* Follows what a file returns that `require` with this argument found. */
static bool follow_required(PartSearch *f, uint32_t source, int32_t argument, const char *path,
                            int depth) {
    const JoxScript *script = f->kinds->script;
    if (argument == JOX_NO_TREE)
        return false;
    const JoxToken *name = jox_syntax_token(get_tree(f, source), argument);
    for (uint32_t r = 0; r < script->required_count; r++) {
        const JoxRequired *file = &script->required[r];
        if (file->asking != source || name->kind != JOX_TOKEN_STRING ||
            !jox_token_says(name, file->name) || !f->kinds->trees[file->given])
            continue;
        const JoxSyntax *s = get_tree(f, file->given);
        for (size_t t = s->return_count; t-- > 0;)
            if (s->returns[t].function == 0 && s->returns[t].value != JOX_NO_TREE &&
                follow_value(f, file->given, s->returns[t].value, path, depth))
                return true;
    }
    return false;
}

/* Follows a call: the argument of a word, or what a function returns. */
static bool follow_call(PartSearch *f, uint32_t source, const JoxTree *call, const char *path,
                        int depth) {
    const JoxKind callee = f->kinds->trees[source][call->a];
    if (callee.bits != JOX_KIND_FUNCTION)
        return false;
    if (callee.site == JOX_SITE_WORD && strcmp(jox_words[callee.tree].name, "require") == 0)
        return follow_required(f, source, call->items, path, depth);
    if (callee.site == JOX_SITE_WORD)
        return call->items != JOX_NO_TREE && follow_value(f, source, call->items, path, depth);
    if (callee.site != JOX_SITE_TREE)
        return false;
    const JoxSyntax *s = get_tree(f, callee.source);
    const int32_t function = s->trees[callee.tree].variable;
    for (size_t r = s->return_count; r-- > 0;)
        if (s->returns[r].function == function && s->returns[r].value != JOX_NO_TREE &&
            follow_value(f, callee.source, s->returns[r].value, path, depth))
            return true;
    return false;
}

/* Follows a name: the values assigned to its variable, the last first. */
static bool follow_variable(PartSearch *f, uint32_t source, int32_t variable, const char *path,
                            int depth) {
    const JoxSyntax *s = get_tree(f, source);
    for (size_t b = variable == JOX_NO_TREE ? 0 : s->binding_count; b-- > 0; f->steps++) {
        const JoxTreeBinding *bound = &s->bindings[b];
        const JoxTree *target = &s->trees[bound->target];
        if (bound->kind == JOX_BIND_VALUE && target->kind == JOX_TREE_NAME &&
            target->variable == variable && follow_value(f, source, bound->value, path, depth))
            return true;
    }
    return false;
}

/* Finds a part, by its path, in the value of an expression. */
static bool follow_value(PartSearch *f, uint32_t source, int32_t tree, const char *path,
                         int depth) {
    const JoxSyntax *s = get_tree(f, source);
    tree = jox_syntax_bare(s, tree);
    const JoxTree *t = &s->trees[tree];
    char longer[256];
    if (++f->steps >= MOST_STEPS || --depth < 0)
        return false;
    switch (t->kind) {
    case JOX_TREE_TABLE: {
        const JoxKind table = {JOX_KIND_TABLE, JOX_SITE_TREE, source, tree};
        return follow_assigned(f, table, path, KEY_SAME, depth) ||
               follow_field(f, table, path, depth) ||
               follow_assigned(f, table, path, KEY_COMPUTED, depth);
    }
    case JOX_TREE_NAME:
        return follow_variable(f, source, t->variable, path, depth);
    case JOX_TREE_CALL:
        return follow_call(f, source, t, path, depth);
    case JOX_TREE_INDEX: /* a part of a part of what `a` holds */
        if (!t->named)
            return false;
        const JoxToken *name = jox_syntax_token(s, tree);
        snprintf(longer, sizeof longer, "%.*s.%s", name->length < 60 ? (int)name->length : 60,
                 name->text, path);
        return follow_value(f, source, t->a, longer, depth);
    case JOX_TREE_BINARY: /* `a or b` may be either */
        return follow_value(f, source, t->b, path, depth) ||
               follow_value(f, source, t->a, path, depth);
    default:
        return false;
    }
}

bool jox_part_find(JoxKinds *kinds, const char *path, JoxPartOrigin *found) {
    PartSearch f = {.kinds = kinds, .found = found};
    if (!kinds->settled || kinds->source_count == 0 || !kinds->trees[0] ||
        kinds->followed > MOST_STEPS_IN_ALL)
        return false;
    const JoxSyntax *s = get_tree(&f, 0);
    bool good = false;
    for (size_t r = s->return_count; r-- > 0 && !good;)
        good = s->returns[r].function == 0 && s->returns[r].value != JOX_NO_TREE &&
               follow_value(&f, 0, s->returns[r].value, path, DEEPEST_PART);
    kinds->followed += (uint32_t)f.steps;
    return good;
}
