/* Finds the running test file from a Lua state. Apart from test_file.c, so that the functions of
   tests need not call the file that calls them. */
#include "luatest/luatest_parts.h"

JoxTestRun *jox_test_run_of(lua_State *L) {
    lua_getfield(L, LUA_REGISTRYINDEX, "jostle test run");
    JoxTestRun *run = lua_touserdata(L, -1);
    lua_pop(L, 1);
    return run;
}
