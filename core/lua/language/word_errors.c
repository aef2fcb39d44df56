/* Reports errors at the position of a word in its file. */
#include <stdarg.h>
#include <stdio.h>

#include "base/assert.h"
#include "lua/language/script.h"

JoxPosition jox_word_position(lua_State *L, const char *word) {
    JoxScript *script = jox_script_of(L);
    lua_Debug debug;
    for (int level = 1; lua_getstack(L, level, &debug); level++) {
        lua_getinfo(L, "Sl", &debug);
        int number = debug.currentline < 1 ? -1 : jox_vm_source(&script->vm, debug.short_src);
        if (number < 0)
            continue;
        JoxSource *source = script->vm.sources[number];
        const JoxToken *t = jox_source_find(source, debug.currentline, word);
        if (!t && word[0] == '<') /* as Lua turns a > b into b < a */
            t = jox_source_find(source, debug.currentline, word[1] ? ">=" : ">");
        return t ? (JoxPosition){source->path, t->line, t->column, t->end_column}
                 : (JoxPosition){source->path, debug.currentline, 0, 0};
    }
    return (JoxPosition){script->vm.source_count ? script->vm.sources[0]->path : NULL, 0, 0, 0};
}

JoxNamePlace jox_word_place(lua_State *L, const char *word) {
    const JoxVm *vm = jox_vm_of(L);
    JoxNamePlace written = {.at = jox_word_position(L, word)};
    for (uint32_t s = 0; s < vm->source_count; s++)
        if (vm->sources[s]->path == written.at.file)
            written.source = s;
    return written;
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
    JoxPosition position = jox_word_position(L, word);
    jox_diag_error(script->diagnostics, position, code, hint, "%s", text);
    jox_node_push(L, JOX_NODE_ERROR);
    return 1;
}
