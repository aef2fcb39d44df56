/* The test file that runs, as its words find it. */
#include "luatest/internal.h"

JoxTestRun *jox_test_run_of(lua_State *L) {
    lua_getfield(L, LUA_REGISTRYINDEX, "jostle test run");
    JoxTestRun *run = lua_touserdata(L, -1);
    lua_pop(L, 1);
    return run;
}
