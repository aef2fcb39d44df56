/* Scripts: Lua states with the language of behaviours, and JoxLua, which owns those of a run. */
#include "lua/language/script.h"
#include "base/assert.h"
#include "base/mem.h"

/* Opens the language in a new state; called by jox_vm_open. */
static int open_language(lua_State *L) {
    jox_nodes_open(L, jox_operators);
    lua_newtable(L);
    jox_words_add(L);
    jox_values_add(L);
    jox_layers_add(L);
    jox_script_set_words(L);
    jox_me_open(jox_script_of(L));
    jox_environment_open(L);
    return 0;
}

JoxScript *jox_script_create(JoxLua *lua) {
    JoxScript *script = jox_alloc(1, sizeof *script);
    script->owner = lua;
    script->vm.watch = jox_calls_watch;
    if (jox_vm_open(&script->vm, &lua->group, open_language))
        return script;
    jox_script_free(script);
    return NULL;
}

void jox_script_free(JoxScript *script) {
    if (!script)
        return;
    for (size_t s = 0; s < script->vm.source_count; s++)
        jox_outline_free(script->vm.sources[s]);
    jox_vm_close(&script->vm);
    for (size_t i = 0; i < script->node_count; i++)
        jox_free(script->nodes[i]);
    for (uint32_t i = 0; i < script->memory_count; i++)
        jox_free(script->memory[i].name);
    jox_patch_changes_free(&script->changes);
    for (uint32_t h = 0; h < script->hook_count; h++) {
        jox_free(script->hooks[h].where);
        jox_free(script->hooks[h].complaint);
    }
    jox_free(script->facts);
    for (uint32_t n = 0; n < script->belonging_count; n++)
        jox_free(script->belongings[n].name);
    jox_free(script->belongings);
    jox_free(script->misuses);
    jox_free(script->required);
    jox_free(script->nodes);
    jox_free(script->memory);
    jox_free(script->hooks);
    jox_free(script->upvalues.items);
    jox_free(script);
}

JoxLua *jox_lua_create(const JoxLuaLimits *limits) {
    JoxLua *lua = jox_alloc(1, sizeof *lua);
    lua->group.limits = limits ? *limits : jox_lua_default_limits();
    return lua;
}

void jox_lua_free(JoxLua *lua) {
    if (!lua)
        return;
    for (uint32_t i = 0; i < lua->script_count; i++)
        jox_script_free(lua->scripts[i]);
    jox_free(lua->scripts);
    jox_free(lua->before_state);
    jox_free(lua->before_machine);
    jox_free(lua->before_memory);
    jox_free(lua->writes);
    jox_free(lua->acts);
    jox_free(lua);
}

JoxScript *jox_script_detach(JoxLua *lua, const JoxMachine *machine) {
    JOX_ASSERT(machine == NULL || machine->vm < (int32_t)lua->script_count);
    if (!machine || machine->vm < 0 || (uint32_t)machine->vm >= lua->script_count)
        return NULL;
    JoxScript *script = lua->scripts[machine->vm];
    lua->scripts[machine->vm] = NULL;
    return script;
}

const JoxScript *jox_lua_script(const JoxLua *lua, const JoxMachine *machine) {
    JOX_ASSERT(machine->vm < (int32_t)lua->script_count);
    return machine->vm >= 0 ? lua->scripts[machine->vm] : NULL;
}
