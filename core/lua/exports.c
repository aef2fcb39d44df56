/* Lists what a file returns to files that require it: each name with its kind and the comment
   before it. For `jostle` commands that document libraries. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "lua/language/script.h"
#include "lua/loader.h"

enum { MOST_EXPORTS = 256, LONGEST_DOC = 600 };

typedef struct Exports {
    JoxScript *script;
    JoxLuaExport *items;
    uint32_t count;
} Exports;

/* ---- comments ---- */

/* Returns a line, from 1, without its leading blanks, with its length; NULL if there is no such
   line. */
static const char *get_source_line(const JoxSource *source, int line, size_t *length) {
    const char *at = source->text;
    for (int n = 1; n < line && at; n++)
        at = (at = strchr(at, '\n')) ? at + 1 : NULL;
    if (!at || line < 1)
        return NULL;
    at += strspn(at, " \t");
    *length = strcspn(at, "\r\n");
    return at;
}

/* Returns whether a line, from 1, is a comment. */
static bool is_comment_line(const JoxSource *source, int line) {
    size_t length;
    const char *text = get_source_line(source, line, &length);
    return text && length > 1 && text[0] == '-' && text[1] == '-';
}

/* Returns the comment on lines `first` to `last`, joined; NULL if they are blank. */
static char *join_comment_lines(const JoxSource *source, int first, int last) {
    JoxText doc = {0};
    for (int line = first; line <= last && doc.length < LONGEST_DOC; line++) {
        size_t length, skip;
        const char *text = get_source_line(source, line, &length);
        skip = strspn(text, "- ");
        if (skip < length) {
            jox_text_add(&doc, doc.length ? " " : "");
            jox_text_append(&doc, text + skip, length - skip);
        }
    }
    if (doc.data)
        jox_text_clean(doc.data);
    return doc.data;
}

static char *read_comment_before(const JoxSource *source, int line) {
    int first = line;
    while (is_comment_line(source, first - 1))
        first--;
    return first < line ? join_comment_lines(source, first, line - 1) : NULL;
}

static char *read_leading_comment(const JoxSource *source) {
    int last = 0;
    while (is_comment_line(source, last + 1))
        last++;
    return last ? join_comment_lines(source, 1, last) : NULL;
}

/* ---- names ---- */

/* Returns the line where a field is set, as `x.NAME =`, `NAME =` in a table or `function x.NAME(`;
   0 if none. */
static int find_field_line(const JoxSource *source, const char *name) {
    for (size_t t = 1; t + 1 < source->token_count; t++) {
        const JoxToken *tokens = source->tokens;
        const bool given = jox_token_is(&tokens[t + 1], "=") || jox_token_is(&tokens[t + 1], "(");
        const bool field = jox_token_is(&tokens[t - 1], ".") || jox_token_is(&tokens[t - 1], "{") ||
                           jox_token_is(&tokens[t - 1], ",");
        if (tokens[t].kind == JOX_TOKEN_NAME && jox_token_is(&tokens[t], name) && given && field)
            return tokens[t].line;
    }
    return 0;
}

/* Prints "name(a, b)" for the function on top of the stack. */
static void print_signature(lua_State *L, const char *name, JoxText *out) {
    jox_text_printf(out, "%s(", name);
    const char *parameter;
    for (int n = 1; (lua_pushvalue(L, -1), parameter = lua_getlocal(L, NULL, n)); n++)
        jox_text_printf(out, "%s%s", n > 1 ? ", " : "", parameter);
    jox_text_add(out, ")");
}

/* Adds an export for the value on top of the stack. */
static void add_export(Exports *all, const char *name) {
    lua_State *L = all->script->vm.L;
    const JoxSource *source = all->script->vm.sources[0];
    JoxText text = {0};
    if (all->count == MOST_EXPORTS)
        return;
    JoxLuaExport *item = &all->items[all->count++];
    item->line = find_field_line(source, name);
    if (lua_isfunction(L, -1)) {
        lua_Debug debug;
        const int top = lua_gettop(L);
        print_signature(L, name, &text);
        lua_settop(L, top);
        lua_pushvalue(L, -1);
        lua_getinfo(L, ">S", &debug);
        item->line = debug.linedefined > 0 ? debug.linedefined : item->line;
    } else {
        jox_text_add(&text, name);
    }
    item->name = text.data;
    snprintf(item->kind, sizeof item->kind, "%s", jox_node_kind(L, -1));
    item->doc = read_comment_before(source, item->line);
}

/* Lists the exports of the value that the file returned, as a protected call, as reading it may run
   out of memory. */
static int list_protected(lua_State *L) {
    Exports *all = lua_touserdata(L, 2);
    lua_settop(L, 1);
    if (!lua_istable(L, 1)) {
        add_export(all, "");
        jox_free(all->items[all->count - 1].doc); /* it is the file's own comment, in *about */
        all->items[all->count - 1].doc = NULL;
        return 0;
    }
    lua_pushnil(L);
    while (lua_next(L, 1)) {
        if (lua_type(L, -2) == LUA_TSTRING)
            add_export(all, lua_tostring(L, -2));
        lua_pop(L, 1);
    }
    return 0;
}

static int compare_export_lines(const void *left, const void *right) {
    const JoxLuaExport *a = left, *b = right;
    return a->line != b->line ? (a->line < b->line ? -1 : 1) : strcmp(a->name, b->name);
}

/* Runs the file and lists its exports; false with a diagnostic. */
static bool list_exports(JoxScript *script, const char *path, Exports *all) {
    const char *why = NULL;
    int line = 0;
    lua_State *L = script->vm.L;
    const uint64_t most = script->owner->group.limits.load_instructions;
    if (!jox_script_read(script, path, NULL, 0, (JoxPosition){0}))
        return false;
    bool good = jox_vm_compile(&script->vm, 0);
    if (!good)
        why = jox_vm_split(&script->vm, lua_tostring(L, -1), &line, &script->vm.failed_source);
    good = good && jox_vm_call(&script->vm, 0, 1, most, &why, &line);
    if (good) {
        lua_pushcfunction(L, list_protected);
        lua_insert(L, 1);
        lua_pushlightuserdata(L, all);
        good = jox_vm_call(&script->vm, 2, 0, most, &why, &line);
    }
    if (!good && script->diagnostics->errors == 0)
        jox_diag_error(script->diagnostics, ((JoxPosition){path, line, 0, 0}), "lua-error", NULL,
                       "%s", why ? why : "it does not load");
    return good;
}

JoxLuaExport *jox_lua_exports(JoxLua *lua, const char *path, const JoxScope *scope, uint32_t *count,
                              char **about, JoxDiagnostics *diagnostics) {
    JoxScript *script = jox_script_create(lua);
    *count = 0;
    *about = NULL;
    if (!script)
        return NULL;
    script->scope = scope;
    script->diagnostics = diagnostics;
    script->vm.loading = true;
    Exports all = {script, jox_alloc(MOST_EXPORTS, sizeof *all.items), 0};
    if (list_exports(script, path, &all))
        *about = read_leading_comment(script->vm.sources[0]);
    qsort(all.items, all.count, sizeof *all.items, compare_export_lines);
    jox_script_free(script);
    *count = all.count;
    return all.items;
}

void jox_lua_exports_free(JoxLuaExport *exports, uint32_t count) {
    for (uint32_t e = 0; e < count; e++) {
        jox_free(exports[e].name);
        jox_free(exports[e].doc);
    }
    jox_free(exports);
}
