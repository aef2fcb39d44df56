/* Freezes tables once a file is loaded. The contents of a frozen table move to a second table
   behind a metatable, which reads there and refuses writes. */
#include "base/assert.h"
#include "lua/vm/vm.h"

/* Key, by its address, under which the metatable of a frozen table holds the contents. */
static const char CONTENTS;

/* __newindex of a frozen table. */
static int refuse_write(lua_State *L) {
    return luaL_error(L, "tables are frozen once the file is loaded; what an agent remembers "
                         "belongs in memory");
}

/* __len of a frozen table. */
static int get_frozen_length(lua_State *L) {
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

/* State of the traversal from one value to all that it reaches. */
typedef struct Walk {
    lua_State *L;
    int seen, work; /* stack indices: the set of values met, and the list of values to visit */
    lua_Integer count;
} Walk;

/* Adds the value on top of the stack to the values to visit, unless it was met before. Leaves the
   stack as it was. */
static void enqueue_value(Walk *w) {
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

/* Adds the contents of a table that is already frozen; skips tables of the engine. */
static void enqueue_frozen_contents(Walk *w) {
    lua_State *L = w->L;
    const int table = lua_gettop(L);
    jox_frozen_contents(L, table);
    if (lua_rawequal(L, table, table + 1))
        return;
    for (lua_pushnil(L); lua_next(L, table + 1);) {
        jox_vm_charge(L, 4);
        enqueue_value(w);
        lua_pop(L, 1);
        enqueue_value(w); /* the key, which stays on the stack for lua_next */
    }
}

/* Freezes the table on top of the stack. Leaves the stack as it was. */
static void freeze_table(Walk *w) {
    JOX_ASSERT(lua_istable(w->L, -1));
    lua_State *L = w->L;
    const int table = lua_gettop(L), shadow = table + 1;
    if (lua_getmetatable(L, table)) { /* already frozen, or the engine's */
        lua_pop(L, 1);
        enqueue_frozen_contents(w);
        lua_settop(L, table);
        return;
    }
    lua_createtable(L, (int)lua_rawlen(L, table), 0);
    for (lua_pushnil(L); lua_next(L, table);) { /* key, value */
        jox_vm_charge(L, 4);
        enqueue_value(w);
        lua_pushvalue(L, -2);
        enqueue_value(w);
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
    lua_pushcclosure(L, get_frozen_length, 1);
    lua_setfield(L, -2, "__len");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_pushvalue(L, shadow);
    lua_rawsetp(L, -2, &CONTENTS);
    lua_setmetatable(L, table);
    lua_settop(L, table);
}

/* Adds the upvalues of the function on top of the stack. Leaves the stack as it was. */
static void visit_function(Walk *w, JoxFreezeFunction *function, void *context) {
    JOX_ASSERT(lua_isfunction(w->L, -1));
    lua_State *L = w->L;
    const int at = lua_gettop(L);
    for (int i = 1; lua_getupvalue(L, at, i); i++) {
        enqueue_value(w);
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
    enqueue_value(&walk);
    lua_settop(L, walk.work);
    while (walk.count > 0) {
        jox_vm_charge(L, 10);
        lua_rawgeti(L, walk.work, walk.count);
        lua_pushnil(L);
        lua_rawseti(L, walk.work, walk.count--);
        if (lua_type(L, -1) == LUA_TTABLE)
            freeze_table(&walk);
        else
            visit_function(&walk, function, context);
        lua_settop(L, walk.work);
    }
    lua_settop(L, top - 1);
}
