/* Records the kinds of arguments and results of functions while a file loads, by Lua's debug hook.
   infer_kinds.c asks, as only the calls show whether a parameter of a library function is a
   condition. */
#include "base/assert.h"
#include "base/mem.h"
#include "lua/language/script.h"

enum { MOST_FACTS = 512 };

/* Returns the kind of the value at a stack index, JOX_KIND_... */
static uint8_t get_kind_of(lua_State *L, int index) {
    const JoxNode *node = jox_node_get(L, index);
    if (node)
        return node->kind == JOX_NODE_ERROR       ? JOX_KIND_UNKNOWN
               : node->kind == JOX_NODE_CONDITION ? JOX_KIND_CONDITION
                                                  : JOX_KIND_VALUE;
    switch (lua_type(L, index)) {
    case LUA_TNIL:
        return JOX_KIND_FALSE;
    case LUA_TBOOLEAN:
        return lua_toboolean(L, index) ? JOX_KIND_PLAIN : JOX_KIND_FALSE;
    case LUA_TTABLE:
        return JOX_KIND_TABLE;
    case LUA_TFUNCTION:
        return JOX_KIND_FUNCTION;
    case LUA_TUSERDATA:
        return JOX_KIND_UNKNOWN;
    default:
        return JOX_KIND_PLAIN;
    }
}

JoxCallFact *jox_calls_find(const JoxScript *script, uint32_t source, int first_line,
                            int last_line) {
    for (uint32_t i = 0; i < script->fact_count; i++) {
        JoxCallFact *fact = &script->facts[i];
        if (fact->source == source && fact->first_line == first_line &&
            fact->last_line == last_line)
            return fact;
    }
    return NULL;
}

/* Returns the record of the running function, made on first use; NULL for a function of C or of the
   file itself, or if there are too many. */
static JoxCallFact *find_or_add_fact(JoxScript *script, lua_State *L, lua_Debug *about) {
    lua_getinfo(L, "S", about);
    const int number = jox_vm_source(&script->vm, about->short_src);
    if (number < 0 || about->linedefined == 0)
        return NULL;
    JoxCallFact *fact =
        jox_calls_find(script, (uint32_t)number, about->linedefined, about->lastlinedefined);
    if (fact || script->fact_count == MOST_FACTS)
        return fact;
    JOX_RESERVE(script->facts, script->fact_capacity, script->fact_count + 1);
    fact = &script->facts[script->fact_count++];
    *fact = (JoxCallFact){(uint32_t)number, about->linedefined, about->lastlinedefined, {0}, 0};
    return fact;
}

/* Adds the kind of a local variable or returned value with this number. */
static void add_kind(lua_State *L, const lua_Debug *about, int number, uint8_t *kinds) {
    if (lua_getlocal(L, about, number)) {
        *kinds |= get_kind_of(L, -1);
        lua_pop(L, 1);
    }
}

void jox_calls_watch(lua_State *L, lua_Debug *about) {
    JoxScript *script = jox_script_of(L);
    JOX_ASSERT(script->vm.loading);
    JoxCallFact *fact = find_or_add_fact(script, L, about);
    if (!fact)
        return;
    if (about->event == LUA_HOOKRET) {
        lua_getinfo(L, "r", about);
        if (about->ntransfer > 0)
            add_kind(L, about, about->ftransfer, &fact->returned);
        else
            fact->returned |= JOX_KIND_FALSE;
        return;
    }
    lua_getinfo(L, "u", about);
    for (int i = 0; i < about->nparams && i < JOX_FACT_PARAMETERS; i++)
        add_kind(L, about, i + 1, &fact->given[i]);
}
