/* Reports errors at the position of a word in its file. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "lua/language/script.h"

/* Returns the token of a word on a line of a source: of its call if it is `called`, or else its
   next use. */
static const JoxToken *find_token(JoxSource *source, int line, const char *word, bool called) {
    const JoxToken *t = called ? jox_source_find_called(source, line, word) : NULL;
    if (!t)
        t = jox_source_find(source, line, word);
    if (!t && word[0] == '<') /* as Lua turns a > b into b < a */
        t = jox_source_find(source, line, word[1] ? ">=" : ">");
    return t;
}

/* Returns the position of a word in the innermost running line of a script. */
static JoxPosition find_position(lua_State *L, const char *word, bool called) {
    JoxScript *script = jox_script_of(L);
    lua_Debug debug;
    for (int level = 1; lua_getstack(L, level, &debug); level++) {
        lua_getinfo(L, "Sl", &debug);
        int number = debug.currentline < 1 ? -1 : jox_vm_source(&script->vm, debug.short_src);
        if (number < 0)
            continue;
        JoxSource *source = script->vm.sources[number];
        const JoxToken *t = find_token(source, debug.currentline, word, called);
        return t ? (JoxPosition){source->path, t->line, t->column, t->end_column}
                 : (JoxPosition){source->path, debug.currentline, 0, 0};
    }
    return (JoxPosition){script->vm.source_count ? script->vm.sources[0]->path : NULL, 0, 0, 0};
}

JoxPosition jox_word_position(lua_State *L, const char *word) {
    return find_position(L, word, false);
}

/* Returns a position with the number of its source. */
static JoxNamePlace make_place(lua_State *L, JoxPosition at) {
    const JoxVm *vm = jox_vm_of(L);
    JoxNamePlace written = {.at = at};
    for (uint32_t s = 0; s < vm->source_count; s++)
        if (vm->sources[s]->path == at.file)
            written.source = s;
    return written;
}

JoxNamePlace jox_word_place(lua_State *L, const char *word) {
    return make_place(L, jox_word_position(L, word));
}

JoxNamePlace jox_word_call_place(lua_State *L, const char *word) {
    JoxScript *script = jox_script_of(L);
    script->called = word;
    script->called_at = find_position(L, word, true);
    return make_place(L, script->called_at);
}

int jox_word_error(lua_State *L, const char *word, const char *code, const char *hint,
                   const char *format, ...) {
    JOX_ASSERT(*code);
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    JoxScript *script = jox_script_of(L);
    jox_vm_charge(L, 2000); /* a suggestion compares with every word */
    if (!script->vm.loading)
        return luaL_error(L, "%s", text); /* there are diagnostics only while loading */
    const bool called = script->called && strcmp(script->called, word) == 0;
    JoxPosition position = called ? script->called_at : jox_word_position(L, word);
    jox_diag_error(script->diagnostics, position, code, hint, "%s", text);
    jox_node_push(L, JOX_NODE_ERROR);
    return 1;
}
