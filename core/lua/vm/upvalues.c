/* Records the upvalues of functions when a file is loaded and sets them back after each call,
   through Lua's debug interface. They are constants once a file is loaded, as state belongs in
   memory. */
#include "lua/vm/vm.h"

#include <string.h>

#include "base/assert.h"
#include "base/mem.h"

/* Key, by its address, of the registry's list that keeps all recorded values alive: function,
   value, function, value. */
static const char LIST;

/* Pushes the list of recorded values, made on first use. */
static void push_value_list(lua_State *L) {
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, &LIST) == LUA_TTABLE)
        return;
    lua_pop(L, 1);
    lua_newtable(L);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &LIST);
}

/* Records type and value at a stack index. */
static void record_value(lua_State *L, int index, JoxUpvalue *u) {
    u->type = lua_type(L, index);
    u->is_integer = lua_isinteger(L, index);
    if (u->type == LUA_TBOOLEAN)
        u->value.boolean = lua_toboolean(L, index);
    else if (u->is_integer)
        u->value.integer = lua_tointeger(L, index);
    else if (u->type == LUA_TNUMBER)
        u->value.number = lua_tonumber(L, index);
    else
        u->value.pointer = lua_topointer(L, index);
}

void jox_upvalues_add(lua_State *L, int index, JoxUpvalues *all, uint32_t first) {
    JOX_ASSERT(lua_type(L, index) == LUA_TFUNCTION && !lua_iscfunction(L, index));
    JOX_ASSERT(first <= all->count);
    const char *name;
    bool added = false;
    luaL_checkstack(L, 4, NULL);
    for (int u = 1; (name = lua_getupvalue(L, index, u)) != NULL; u++) {
        const void *id = lua_upvalueid(L, index, u);
        bool known = strcmp(name, "_ENV") == 0; /* no source may name it */
        jox_vm_charge(L, all->count - first);
        for (uint32_t k = first; k < all->count && !known; k++)
            known = all->items[k].id == id;
        if (!known) {
            JOX_RESERVE(all->items, all->capacity, all->count + 1);
            all->items[all->count++] = (JoxUpvalue){.id = id, .number = u, .next = added};
            record_value(L, lua_gettop(L), &all->items[all->count - 1]);
            added = true;
            push_value_list(L);
            lua_pushvalue(L, index);
            lua_rawseti(L, -2, 2 * (lua_Integer)all->count - 1);
            lua_pushvalue(L, -2);
            lua_rawseti(L, -2, 2 * (lua_Integer)all->count);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
    }
}

/* Returns whether the value at `index` is the recorded one, which is item `k` of the list. 1
   and 1.0 differ; nan equals itself. */
static bool is_same_value(lua_State *L, int index, const JoxUpvalue *u, int list, lua_Integer k) {
    if (lua_type(L, index) != u->type)
        return false;
    if (u->type == LUA_TNIL)
        return true;
    if (u->type == LUA_TBOOLEAN)
        return lua_toboolean(L, index) == u->value.boolean;
    if (u->type == LUA_TNUMBER) {
        const lua_Number number = lua_tonumber(L, index);
        return lua_isinteger(L, index) != u->is_integer ? false
               : u->is_integer ? lua_tointeger(L, index) == u->value.integer
                               : memcmp(&number, &u->value.number, sizeof number) == 0;
    }
    if (lua_topointer(L, index) == u->value.pointer)
        return true;
    if (u->type != LUA_TSTRING)
        return false;
    lua_rawgeti(L, list, k); /* equal strings may differ in address */
    const bool equal = lua_rawequal(L, index, -1);
    lua_pop(L, 1);
    return equal;
}

bool jox_upvalues_restore(lua_State *L, const JoxUpvalues *all, uint32_t first, uint32_t count,
                          char name[64], lua_Debug *where) {
    JOX_ASSERT(first + count <= all->count);
    bool changed = false;
    if (count == 0)
        return false;
    enum { LEFT = 12 }; /* values that stay on the stack until it is cleared */
    const int list = lua_gettop(L) + 1, function = list + 1;
    int now = function;
    push_value_list(L);
    for (uint32_t k = first; k < first + count; k++) {
        const JoxUpvalue *u = &all->items[k];
        if (k == first || !u->next || now == function + LEFT) {
            lua_settop(L, list);
            lua_rawgeti(L, list, 2 * (lua_Integer)k + 1);
            now = function;
        }
        const char *called = lua_getupvalue(L, function, u->number);
        now++;
        JOX_ASSERT(called && lua_gettop(L) == now);
        if (is_same_value(L, now, u, list, 2 * (lua_Integer)k + 2))
            continue;
        lua_rawgeti(L, list, 2 * (lua_Integer)k + 2);
        lua_setupvalue(L, function, u->number); /* pops the value */
        if (!changed) {
            changed = true;
            strncpy(name, called, 63);
            name[63] = 0;
            lua_pushvalue(L, function);
            lua_getinfo(L, ">S", where);
        }
    }
    lua_settop(L, list - 1);
    return changed;
}
