/* The outline of a file: the keys of the table constructor that it ends with, and where each one
   stands. Positions of errors, patches and settings are looked up here. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/language/script.h"

/* Returns by how much a token changes the depth of nesting. */
static int get_depth_change(const JoxToken *t) {
    static const char *const OPEN[] = {"{", "(", "[", "function", "if", "do", "repeat"};
    static const char *const CLOSE[] = {"}", ")", "]", "end", "until"};
    for (size_t i = 0; i < sizeof OPEN / sizeof *OPEN; i++)
        if (jox_token_is(t, OPEN[i]))
            return 1;
    for (size_t i = 0; i < sizeof CLOSE / sizeof *CLOSE; i++)
        if (jox_token_is(t, CLOSE[i]))
            return -1;
    return 0;
}

static void add_path(JoxOutline *outline, const char *path, size_t key, size_t first, size_t last) {
    JOX_ASSERT(key < last && first <= last);
    JOX_RESERVE(outline->paths, outline->path_capacity, outline->path_count + 1);
    outline->paths[outline->path_count++] =
        (JoxPath){jox_strdup(path), (uint32_t)key, (uint32_t)first, (uint32_t)last};
}

/* Returns whether machine { or sequence { begins at token `i`. */
static bool begins_machine(const JoxSource *source, size_t i) {
    return i + 2 < source->token_count &&
           (jox_token_is(&source->tokens[i], "machine") ||
            jox_token_is(&source->tokens[i], "sequence")) &&
           jox_token_is(&source->tokens[i + 1], "{");
}

enum { DEEPEST = 16 }; /* levels of tables */

/* Writes the whole name of a state in a path "states.NAME" as the path of its table. */
static void expand_state_name(char path[256]) {
    char name[256];
    snprintf(name, sizeof name, "%s", path + 7);
    size_t n = 7;
    for (const char *c = name; *c && n < 240; c++)
        n += (size_t)snprintf(path + n, 256 - n, *c == '.' ? ".runs.states." : "%c", *c);
}

/* Adds the keys of the table constructor that opens at token `at`; returns the token after it. */
static size_t outline_table(const JoxSource *source, size_t at, const char *prefix, int level) {
    JoxOutline *outline = source->outline;
    const JoxToken *t = source->tokens;
    size_t count = source->token_count;
    int item = 0;
    for (at++; at < count && !jox_token_is(&t[at], "}");) {
        char path[256];
        size_t key = at, value = at;
        if (at + 1 < count && t[at].kind == JOX_TOKEN_NAME && jox_token_is(&t[at + 1], "=")) {
            snprintf(path, sizeof path, "%s%s%.*s", prefix, *prefix ? "." : "", (int)t[at].length,
                     t[at].text);
            value = at + 2;
        } else if (at + 4 < count && jox_token_is(&t[at], "[") &&
                   t[at + 1].kind == JOX_TOKEN_STRING && jox_token_is(&t[at + 3], "=")) {
            snprintf(path, sizeof path, "%s%s%.*s", prefix, *prefix ? "." : "",
                     (int)t[at + 1].length, t[at + 1].text);
            key = at + 1;
            value = at + 4;
        } else {
            snprintf(path, sizeof path, "%s%s%d", prefix, *prefix ? "." : "", ++item);
        }
        size_t end = value;
        for (int depth = 0; end < count; end++) {
            if (depth == 0 && (jox_token_is(&t[end], ",") || jox_token_is(&t[end], ";") ||
                               jox_token_is(&t[end], "}")))
                break;
            depth += get_depth_change(&t[end]);
        }
        if (key < end) /* else nothing stands between two commas, a syntax error */
            add_path(outline, path, key, value, end);
        const bool table = value < count && jox_token_is(&t[value], "{");
        const bool outlined = level < DEEPEST && (table || begins_machine(source, value));
        if (outlined)
            outline_table(source, table ? value : value + 1, path, level + 1);
        if (outline->patches && strcmp(prefix, "states") == 0 && strchr(path + 7, '.') &&
            key < end) { /* "Guard.Walk" is the state Walk of what Guard runs */
            expand_state_name(path);
            add_path(outline, path, key, value, end);
            if (outlined)
                outline_table(source, table ? value : value + 1, path, level + 1);
        }
        at = end < count && jox_token_is(&t[end], "}") ? end : end + 1;
    }
    return at + 1;
}

/* Returns whether patch "NAME" { or replace "NAME" { begins at token `i`. */
static bool begins_patch(const JoxSource *source, size_t i) {
    const JoxToken *t = &source->tokens[i];
    return i + 3 < source->token_count &&
           (jox_token_is(t, "patch") || jox_token_is(t, "replace")) &&
           t[1].kind == JOX_TOKEN_STRING && jox_token_is(&t[2], "{");
}

/* Adds the tables of machines that states run, under the numbers of their tokens. */
static void outline_machines(JoxSource *source, size_t main) {
    enum { MOST = 64 };
    size_t count = 0;
    for (size_t i = 0; i < source->token_count && count < MOST; i++) {
        char root[24];
        if (i == main || !begins_machine(source, i))
            continue;
        snprintf(root, sizeof root, "#%zu", i);
        add_path(source->outline, root, i, i + 1, i + 2);
        outline_table(source, i + 1, root, 0);
        count++;
    }
}

/* Returns the token of the table that the file returns: the last machine, patch or replacement that
   is not within another; the number of tokens if there is none. */
static size_t find_main_table(const JoxSource *source) {
    size_t found = source->token_count;
    int depth = 0, least = 0;
    for (size_t i = 0; i < source->token_count; i++) {
        if ((begins_machine(source, i) || begins_patch(source, i)) &&
            (found == source->token_count || depth <= least)) {
            found = i;
            least = depth;
        }
        depth += get_depth_change(&source->tokens[i]);
    }
    return found;
}

/* Makes the outline of a source from its tokens. */
static void read_outline(JoxSource *source) {
    JOX_ASSERT(!source->outline);
    JoxOutline *outline = source->outline = jox_alloc(1, sizeof *outline);
    size_t main = find_main_table(source);
    if (main == source->token_count)
        return;
    outline->main = main;
    outline->patches = begins_patch(source, main) ? &source->tokens[main + 1] : NULL;
    outline_table(source, main + (outline->patches ? 2 : 1), "", 0);
    outline_machines(source, main);
}

bool jox_outline_root(const JoxSource *source, int line, int column, char root[24]) {
    const JoxOutline *outline = jox_outline_of(source);
    for (size_t i = 0; i < source->token_count; i++) {
        const JoxToken *t = &source->tokens[i];
        if (t->line != line || t->column != column)
            continue;
        snprintf(root, 24, "#%zu", i);
        if (i == outline->main)
            *root = 0;
        return i == outline->main || jox_outline_find(source, root);
    }
    return false;
}

void jox_outline_free(JoxSource *source) {
    JoxOutline *outline = source->outline;
    if (!outline)
        return;
    for (size_t i = 0; i < outline->path_count; i++)
        jox_free(outline->paths[i].path);
    jox_syntax_free(outline->syntax);
    jox_free(outline->paths);
    jox_free(outline);
    source->outline = NULL;
}

const JoxSyntax *jox_outline_syntax(const JoxSource *source) {
    JoxOutline *outline = jox_outline_of(source);
    if (!outline->syntax)
        outline->syntax = jox_syntax_read(source);
    return outline->syntax;
}

const JoxPath *jox_outline_find(const JoxSource *source, const char *path) {
    const JoxOutline *outline = jox_outline_of(source);
    for (size_t i = 0; i < outline->path_count; i++)
        if (strcmp(outline->paths[i].path, path) == 0)
            return &outline->paths[i];
    return NULL;
}

JoxPosition jox_outline_at(const JoxSource *source, const char *path) {
    char shorter[256];
    snprintf(shorter, sizeof shorter, "%s", path);
    for (;;) {
        const JoxPath *found = jox_outline_find(source, shorter);
        if (found && found->key < source->token_count) {
            const JoxToken *t = &source->tokens[found->key];
            return (JoxPosition){source->path, t->line, t->column, t->end_column};
        }
        char *dot = strrchr(shorter, '.');
        if (!dot)
            return (JoxPosition){source->path, 0, 0, 0};
        *dot = 0;
    }
}

JoxSource *jox_script_read(JoxScript *script, const char *path, const char *text, size_t length,
                           JoxPosition from) {
    const size_t before = script->vm.source_count;
    JoxSource *source = jox_vm_read(&script->vm, path, text, length, from, script->diagnostics);
    for (size_t s = before; s < script->vm.source_count; s++) /* also of a file that was refused */
        read_outline(script->vm.sources[s]);
    return source;
}
