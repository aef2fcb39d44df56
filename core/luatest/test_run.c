/* The test file that runs, as its words find it. */
#include <time.h>

#include "luatest/internal.h"

JoxTestRun *jox_test_run_of(lua_State *L) {
    lua_getfield(L, LUA_REGISTRYINDEX, "jostle test run");
    JoxTestRun *run = lua_touserdata(L, -1);
    lua_pop(L, 1);
    return run;
}

double jox_test_clock(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}
