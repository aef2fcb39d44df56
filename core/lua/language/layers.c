/* Words by which mods extend a function that stands in a behaviour: before, afterwards, around. A
   patch's tree puts the function that stood there behind the new one (patch_tree.c). */
#include "base/assert.h"
#include "lua/language/vocabulary.h"

const char *jox_layer_word(JoxLayer layer) {
    static const char *const WORDS[] = {"", "before", "afterwards", "around"};
    JOX_ASSERT(layer >= JOX_LAYER_ALONE && layer <= JOX_LAYER_AROUND);
    return WORDS[layer];
}

/* before(f), afterwards(f), around(f) */
static int make_layer(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    const JoxLayer layer = (JoxLayer)lua_tointeger(L, lua_upvalueindex(1));
    const char *word = jox_layer_word(layer);
    if (!script->vm.loading)
        return luaL_error(L, "'%s' belongs into the patch of a mod, not into a function", word);
    if (!script->mod)
        return jox_word_error(L, word, "not-a-mod",
                              "Put it into the patches/ of a mod; here write the function itself",
                              "'%s' works in mods only", word);
    if (lua_gettop(L) != 1 || lua_type(L, 1) != LUA_TFUNCTION || lua_iscfunction(L, 1))
        return jox_word_error(L, word, "bad-argument",
                              layer == JOX_LAYER_AROUND
                                  ? "Example: on_enter = around(function(me, previous) "
                                    "previous(me) end)"
                                  : "Example: on_enter = before(function(me) me.laps = 0 end)",
                              "%s takes one function", word);
    JoxNode *node = jox_node_push(L, JOX_NODE_LAYER);
    node->op = (int)layer;
    node->name = jox_vm_intern(&script->vm, script->mod->name);
    node->arg = LUA_NOREF;
    lua_pushvalue(L, 1);
    node->hook = luaL_ref(L, LUA_REGISTRYINDEX);
    return 1;
}

void jox_layers_add(lua_State *L) {
    JOX_ASSERT(lua_istable(L, -1));
    for (int layer = JOX_LAYER_BEFORE; layer <= JOX_LAYER_AROUND; layer++) {
        lua_pushinteger(L, layer);
        lua_pushcclosure(L, make_layer, 1);
        lua_setfield(L, -2, jox_layer_word((JoxLayer)layer));
    }
}
