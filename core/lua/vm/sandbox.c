/* Makes the environment of scripts, a whitelist of functions. Lua's own libraries are never opened:
   scripts have no files, clocks, addresses, coroutines, metatables or code from strings. */
#include <math.h>

#include "base/assert.h"
#include "base/number/pi.h"
#include "lua/vm/library.h"

static void set_library(lua_State *L, const char *name, const luaL_Reg *functions,
                        const luaL_Reg *more, lua_CFunction assign) {
    lua_newtable(L); /* a proxy, so that scripts cannot change the library */
    lua_newtable(L);
    lua_newtable(L);
    luaL_setfuncs(L, functions, 0);
    if (more)
        luaL_setfuncs(L, more, 0);
    if (functions == jox_library_math) {
        lua_pushnumber(L, JOX_PI);
        lua_setfield(L, -2, "pi");
        lua_pushnumber(L, (lua_Number)HUGE_VAL);
        lua_setfield(L, -2, "huge");
        lua_pushinteger(L, LUA_MAXINTEGER);
        lua_setfield(L, -2, "maxinteger");
        lua_pushinteger(L, LUA_MININTEGER);
        lua_setfield(L, -2, "mininteger");
    }
    if (functions == jox_library_string) { /* allows ("x"):upper() */
        lua_pushliteral(L, "");
        lua_newtable(L);
        lua_pushvalue(L, -3);
        lua_setfield(L, -2, "__index");
        lua_pushboolean(L, 0);
        lua_setfield(L, -2, "__metatable");
        lua_setmetatable(L, -2);
        lua_pop(L, 1);
    }
    lua_setfield(L, -2, "__index");
    lua_pushcfunction(L, assign);
    lua_setfield(L, -2, "__newindex");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
    lua_setfield(L, -2, name);
}

void jox_sandbox_open(lua_State *L, const JoxSandbox *extra) {
    JOX_ASSERT(extra->missing && extra->assign);
    const int top = lua_gettop(L);
    lua_newtable(L); /* the environment, always empty, so that every access calls `missing` */
    lua_newtable(L);
    lua_newtable(L); /* the table of known names, an upvalue of `missing` */
    luaL_setfuncs(L, jox_library_base, 0);
    if (extra->base)
        luaL_setfuncs(L, extra->base, 0);
    set_library(L, "math", jox_library_math, extra->math, extra->assign);
    set_library(L, "string", jox_library_string, NULL, extra->assign);
    set_library(L, "table", jox_library_table, NULL, extra->assign);
    lua_pushcclosure(L, extra->missing, 1);
    lua_setfield(L, -2, "__index");
    lua_pushcfunction(L, extra->assign);
    lua_setfield(L, -2, "__newindex");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
    lua_rawseti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
    JOX_ASSERT(lua_gettop(L) == top);
}
