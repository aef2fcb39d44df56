/* What a file that others require gives them: its names, what each is, and the comment before it.
 */
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

/* The text of a line, from 1, without its blanks in front; its length in *length. NULL: there is no
   such line. */
static const char *line_of(const JoxSource *source, int line, size_t *length) {
    const char *at = source->text;
    for (int n = 1; n < line && at; n++)
        at = (at = strchr(at, '\n')) ? at + 1 : NULL;
    if (!at || line < 1)
        return NULL;
    at += strspn(at, " \t");
    *length = strcspn(at, "\r\n");
    return at;
}

static bool is_comment(const JoxSource *source, int line) {
    size_t length;
    const char *text = line_of(source, line, &length);
    return text && length > 1 && text[0] == '-' && text[1] == '-';
}

/* The comment of the lines from `first` to `last`, joined; NULL where they are none. */
static char *comment(const JoxSource *source, int first, int last) {
    JoxText doc = {0};
    for (int line = first; line <= last && doc.length < LONGEST_DOC; line++) {
        size_t length, skip;
        const char *text = line_of(source, line, &length);
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

static char *comment_before(const JoxSource *source, int line) {
    int first = line;
    while (is_comment(source, first - 1))
        first--;
    return first < line ? comment(source, first, line - 1) : NULL;
}

static char *comment_of_file(const JoxSource *source) {
    int last = 0;
    while (is_comment(source, last + 1))
        last++;
    return last ? comment(source, 1, last) : NULL;
}

/* ---- names ---- */

/* The line where a field is given: `x.NAME =`, `NAME =` in a table, or `function x.NAME(`; 0. */
static int line_where(const JoxSource *source, const char *name) {
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

/* "name(a, b)" of the function on top of the stack. */
static void add_signature(lua_State *L, const char *name, JoxText *out) {
    jox_text_printf(out, "%s(", name);
    const char *parameter;
    for (int n = 1; (lua_pushvalue(L, -1), parameter = lua_getlocal(L, NULL, n)); n++)
        jox_text_printf(out, "%s%s", n > 1 ? ", " : "", parameter);
    jox_text_add(out, ")");
}

/* Adds the value on top of the stack under a name. */
static void add(Exports *all, const char *name) {
    lua_State *L = all->script->vm.L;
    const JoxSource *source = all->script->vm.sources[0];
    JoxText text = {0};
    if (all->count == MOST_EXPORTS)
        return;
    JoxLuaExport *item = &all->items[all->count++];
    item->line = line_where(source, name);
    if (lua_isfunction(L, -1)) {
        lua_Debug debug;
        const int top = lua_gettop(L);
        add_signature(L, name, &text);
        lua_settop(L, top);
        lua_pushvalue(L, -1);
        lua_getinfo(L, ">S", &debug);
        item->line = debug.linedefined > 0 ? debug.linedefined : item->line;
    } else {
        jox_text_add(&text, name);
    }
    item->name = text.data;
    snprintf(item->kind, sizeof item->kind, "%s", jox_node_kind(L, -1));
    item->doc = comment_before(source, item->line);
}

/* The value that the file returned is the argument; reading it may fail for want of memory. */
static int list_protected(lua_State *L) {
    Exports *all = lua_touserdata(L, 2);
    lua_settop(L, 1);
    if (!lua_istable(L, 1)) {
        add(all, "");
        jox_free(all->items[all->count - 1].doc); /* the file's own comment says it */
        all->items[all->count - 1].doc = NULL;
        return 0;
    }
    lua_pushnil(L);
    while (lua_next(L, 1)) {
        if (lua_type(L, -2) == LUA_TSTRING)
            add(all, lua_tostring(L, -2));
        lua_pop(L, 1);
    }
    return 0;
}

static int by_line(const void *left, const void *right) {
    const JoxLuaExport *a = left, *b = right;
    return a->line != b->line ? (a->line < b->line ? -1 : 1) : strcmp(a->name, b->name);
}

/* Runs the file; false with a diagnostic. */
static bool list(JoxScript *script, const char *path, Exports *all) {
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
    if (list(script, path, &all))
        *about = comment_of_file(script->vm.sources[0]);
    qsort(all.items, all.count, sizeof *all.items, by_line);
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
