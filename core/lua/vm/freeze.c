/* Tables that nothing can change once a file is loaded. The contents move to a table of their own,
   behind a metatable that reads there and refuses to write. */
#include "base/assert.h"
#include "lua/vm/vm.h"

/* The metatable of a frozen table holds its contents under this key's address. */
static const char CONTENTS;

static int refuse_write(lua_State *L) {
    return luaL_error(L, "tables are frozen once the file is loaded; what an agent remembers "
                         "belongs in memory");
}

static int frozen_length(lua_State *L) {
    lua_pushinteger(L, (lua_Integer)lua_rawlen(L, lua_upvalueindex(1)));
    return 1;
}

void jox_frozen_contents(lua_State *L, int index) {
    if (lua_getmetatable(L, index)) {
        if (lua_rawgetp(L, -1, &CONTENTS) == LUA_TTABLE) {
            lua_remove(L, -2);
            return;
        }
        lua_pop(L, 2);
    }
    lua_pushvalue(L, index);
}

void jox_frozen_check_writable(lua_State *L, int index) {
    if (!lua_getmetatable(L, index))
        return;
    if (lua_rawgetp(L, -1, &CONTENTS) == LUA_TTABLE)
        refuse_write(L);
    luaL_error(L, "this table belongs to the library and cannot be changed");
}

/* Where the walk stands: two tables on the stack, and how many are still to be looked at. */
typedef struct Walk {
    lua_State *L;
    int seen, work; /* stack indices: the set of values met, and the list of those still to visit */
    lua_Integer count;
} Walk;

/* Adds the value on top of the stack, which stays, to the values to visit, unless it was met
 * before. */
static void reach(Walk *w) {
    JOX_ASSERT(lua_gettop(w->L) >= w->work);
    int type = lua_type(w->L, -1);
    if (type != LUA_TTABLE && type != LUA_TFUNCTION)
        return;
    lua_pushvalue(w->L, -1);
    if (lua_rawget(w->L, w->seen) == LUA_TNIL) {
        lua_pushvalue(w->L, -2);
        lua_pushboolean(w->L, 1);
        lua_rawset(w->L, w->seen);
        lua_pushvalue(w->L, -2);
        lua_rawseti(w->L, w->work, ++w->count);
    }
    lua_pop(w->L, 1);
}

/* Visits the contents of a table that is frozen already; tables of the engine are left alone. */
static void walk_frozen(Walk *w) {
    lua_State *L = w->L;
    const int table = lua_gettop(L);
    jox_frozen_contents(L, table);
    if (lua_rawequal(L, table, table + 1))
        return;
    for (lua_pushnil(L); lua_next(L, table + 1);) {
        jox_vm_charge(L, 4);
        reach(w);
        lua_pop(L, 1);
        reach(w); /* the key, which stays */
    }
}

/* Freezes the table on top of the stack, which stays. */
static void freeze_table(Walk *w) {
    JOX_ASSERT(lua_istable(w->L, -1));
    lua_State *L = w->L;
    const int table = lua_gettop(L), shadow = table + 1;
    if (lua_getmetatable(L, table)) { /* frozen already, or the engine's */
        lua_pop(L, 1);
        walk_frozen(w);
        lua_settop(L, table);
        return;
    }
    lua_createtable(L, (int)lua_rawlen(L, table), 0);
    for (lua_pushnil(L); lua_next(L, table);) { /* key, value */
        jox_vm_charge(L, 4);
        reach(w);
        lua_pushvalue(L, -2);
        reach(w);
        lua_insert(L, -2); /* key, key, value */
        lua_rawset(L, shadow);
        lua_pushvalue(L, -1);
        lua_pushnil(L);
        lua_rawset(L, table);
    }
    lua_createtable(L, 0, 5);
    lua_pushvalue(L, shadow);
    lua_setfield(L, -2, "__index");
    lua_pushcfunction(L, refuse_write);
    lua_setfield(L, -2, "__newindex");
    lua_pushvalue(L, shadow);
    lua_pushcclosure(L, frozen_length, 1);
    lua_setfield(L, -2, "__len");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_pushvalue(L, shadow);
    lua_rawsetp(L, -2, &CONTENTS);
    lua_setmetatable(L, table);
    lua_settop(L, table);
}

/* Visits the upvalues of the function on top of the stack, which stays. */
static void walk_function(Walk *w, JoxFreezeFunction *function, void *context) {
    JOX_ASSERT(lua_isfunction(w->L, -1));
    lua_State *L = w->L;
    const int at = lua_gettop(L);
    for (int i = 1; lua_getupvalue(L, at, i); i++) {
        reach(w);
        lua_pop(L, 1);
    }
    if (function && !lua_iscfunction(L, at))
        function(L, at, context);
    lua_settop(L, at);
}

void jox_freeze(lua_State *L, int index, JoxFreezeFunction *function, void *context) {
    luaL_checkstack(L, 20, "freeze");
    lua_pushvalue(L, index);
    const int top = lua_gettop(L);
    lua_newtable(L);
    lua_newtable(L);
    Walk walk = {L, top + 1, top + 2, 0};
    lua_pushvalue(L, top);
    reach(&walk);
    lua_settop(L, walk.work);
    while (walk.count > 0) {
        jox_vm_charge(L, 10);
        lua_rawgeti(L, walk.work, walk.count);
        lua_pushnil(L);
        lua_rawseti(L, walk.work, walk.count--);
        if (lua_type(L, -1) == LUA_TTABLE)
            freeze_table(&walk);
        else
            walk_function(&walk, function, context);
        lua_settop(L, walk.work);
    }
    lua_settop(L, top - 1);
}
