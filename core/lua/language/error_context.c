/* Names the part of the machine's table that an error is in: "machine tawaf > state ToStone >
   transition 2 (to Circle)". */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "lua/language/script.h"

/* Copies the string value at a path, or "?". */
static void copy_string_at(const JoxSource *source, const char *path, char out[64]) {
    const JoxPath *found = jox_outline_find(source, path);
    const JoxToken *t =
        found && found->first < source->token_count ? &source->tokens[found->first] : NULL;
    bool text = t && t->kind == JOX_TOKEN_STRING;
    snprintf(out, 64, "%.*s", text ? (int)(t->length < 60 ? t->length : 60) : 1,
             text ? t->text : "?");
}

static bool is_at_or_before(const JoxToken *t, int line, int column) {
    return t->line < line || (t->line == line && t->column <= column);
}

/* Returns the longest path whose key and value enclose a position. */
static const JoxPath *find_enclosing_path(const JoxSource *source, int line, int column) {
    const JoxPath *best = NULL;
    const JoxOutline *outline = jox_outline_of(source);
    for (size_t p = 0; p < outline->path_count; p++) {
        const JoxPath *path = &outline->paths[p];
        if (path->key >= source->token_count ||
            !is_at_or_before(&source->tokens[path->key], line, column))
            continue;
        if (path->last < source->token_count &&
            is_at_or_before(&source->tokens[path->last], line, column))
            continue;
        if (!best || strlen(path->path) > strlen(best->path))
            best = path;
    }
    return best;
}

/* Appends the states and the transition that a path below a machine's table leads through; `root`
   is the path of that table. */
static void describe_parts(const JoxSource *source, const char *root, const char *rest,
                           JoxText *out) {
    char full[256], to[64];
    unsigned number;
    if (sscanf(rest, "%u", &number) == 1) /* of a sequence */
        jox_text_printf(out, " > step %u", number);
    while (strncmp(rest, "states.", 7) == 0) {
        const size_t n = strcspn(rest + 7, ".");
        jox_text_printf(out, " > state %.*s", (int)(n < 60 ? n : 60), rest + 7);
        rest += 7 + n;
        if (strncmp(rest, ".runs.", 6) == 0) {
            rest += 6;
            if (sscanf(rest, "%u", &number) == 1)
                jox_text_printf(out, " > step %u", number);
        } else if (sscanf(rest, ".%u", &number) == 1) {
            const size_t length = (size_t)(rest - root);
            snprintf(full, sizeof full, "%.*s.%u.to", (int)(length < 200 ? length : 200), root,
                     number);
            copy_string_at(source, full, to);
            jox_text_printf(out, " > transition %u (to %s)", number, to);
        }
    }
}

static char *describe_table_path(const JoxSource *source, const JoxPath *path) {
    JOX_ASSERT(path->path && *path->path);
    char name[64], full[256];
    JoxText out = {0};
    const JoxToken *patches = jox_outline_of(source)->patches;
    const bool inner = *path->path == '#'; /* a machine besides the one that the file returns */
    const size_t root = inner ? strcspn(path->path, ".") : 0;
    snprintf(full, sizeof full, "%.*s%sname", (int)root, path->path, inner ? "." : "");
    copy_string_at(source, full, name);
    if (patches && !inner)
        jox_text_printf(&out, "patch of %.*s", (int)patches->length, patches->text);
    else
        jox_text_printf(&out, inner && strcmp(name, "?") == 0 ? "machine" : "machine %s", name);
    describe_parts(source, path->path, path->path + root + (path->path[root] == '.'), &out);
    return out.data;
}

void jox_outline_contexts(const JoxSource *source, JoxDiagnostics *diagnostics) {
    for (size_t d = 0; d < diagnostics->count; d++) {
        JoxDiagnostic *item = &diagnostics->items[d];
        if (item->context || item->line < 1 || !item->file || strcmp(item->file, source->path) != 0)
            continue;
        const JoxPath *path =
            find_enclosing_path(source, item->line, item->column > 0 ? item->column : 1);
        if (path)
            item->context = describe_table_path(source, path);
    }
}
