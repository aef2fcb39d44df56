/* Variables that functions share with the code around them (Lua's upvalues). They are constants
   once a file is loaded: what a function changed there is found after its call, through Lua's debug
   interface, and taken back. */
#include "lua/vm/vm.h"

#include <string.h>

#include "base/assert.h"
#include "base/mem.h"

/* The variables of a state stand in one list in its registry, under this address: function, value,
 * function, value. */
static const char LIST;

static void push_list(lua_State *L) {
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, &LIST) == LUA_TTABLE)
        return;
    lua_pop(L, 1);
    lua_newtable(L);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &LIST);
}

void jox_upvalues_add(lua_State *L, int index, JoxUpvalues *all, uint32_t first) {
    JOX_ASSERT(lua_type(L, index) == LUA_TFUNCTION && !lua_iscfunction(L, index));
    JOX_ASSERT(first <= all->count);
    const char *name;
    luaL_checkstack(L, 4, NULL);
    for (int u = 1; (name = lua_getupvalue(L, index, u)) != NULL; u++) {
        const void *id = lua_upvalueid(L, index, u);
        bool known = strcmp(name, "_ENV") == 0; /* no source may name it */
        jox_vm_charge(L, all->count - first);
        for (uint32_t k = first; k < all->count && !known; k++)
            known = all->items[k].id == id;
        if (!known) {
            JOX_RESERVE(all->items, all->capacity, all->count + 1);
            all->items[all->count++] = (JoxUpvalue){id, u};
            push_list(L);
            lua_pushvalue(L, index);
            lua_rawseti(L, -2, 2 * (lua_Integer)all->count - 1);
            lua_pushvalue(L, -2);
            lua_rawseti(L, -2, 2 * (lua_Integer)all->count);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
    }
}

/* Whether two values are one and the same: also 1 and 1.0 differ, and nan is nan. */
static bool same(lua_State *L, int a, int b) {
    if (lua_type(L, a) != LUA_TNUMBER || lua_type(L, b) != LUA_TNUMBER)
        return lua_rawequal(L, a, b);
    if (lua_isinteger(L, a) || lua_isinteger(L, b))
        return lua_isinteger(L, a) && lua_isinteger(L, b) && lua_rawequal(L, a, b);
    const lua_Number x = lua_tonumber(L, a), y = lua_tonumber(L, b);
    return memcmp(&x, &y, sizeof x) == 0;
}

bool jox_upvalues_restore(lua_State *L, const JoxUpvalues *all, uint32_t first, uint32_t count,
                          char name[64], lua_Debug *where) {
    JOX_ASSERT(first + count <= all->count);
    bool changed = false;
    if (count == 0)
        return false;
    const int list = lua_gettop(L) + 1, function = list + 1, now = list + 2, before = list + 3;
    push_list(L);
    for (uint32_t k = first; k < first + count; k++) {
        lua_rawgeti(L, list, 2 * (lua_Integer)k + 1);
        const char *called = lua_getupvalue(L, function, all->items[k].number);
        lua_rawgeti(L, list, 2 * (lua_Integer)k + 2);
        JOX_ASSERT(called && lua_gettop(L) == before);
        if (!same(L, now, before)) {
            lua_setupvalue(L, function, all->items[k].number); /* pops it */
            if (!changed) {
                changed = true;
                strncpy(name, called, 63);
                name[63] = 0;
                lua_pushvalue(L, function);
                lua_getinfo(L, ">S", where);
            }
        }
        lua_settop(L, list);
    }
    lua_settop(L, list - 1);
    return changed;
}
