/* The assertions of tests on plain values: equal, near, truthy, fails. Each counts itself and
   raises an error in Lua if it fails. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lua/vm/library.h"
#include "luatest/luatest_parts.h"

static int word_equal(lua_State *L) {
    luaL_checkany(L, 2);
    jox_test_run_of(L)->assertions++;
    if (lua_rawequal(L, 1, 2))
        return 0;
    jox_test_run_of(L)->failures++;
    size_t length;
    const char *a = jox_library_text(L, 1, &length), *b = jox_library_text(L, 2, &length);
    return luaL_error(L, "%s is not %s", a, b);
}

static int word_near(lua_State *L) {
    double a = luaL_checknumber(L, 1), b = luaL_checknumber(L, 2), by = luaL_checknumber(L, 3);
    jox_test_run_of(L)->assertions++;
    if (fabs(a - b) <= by)
        return 0;
    jox_test_run_of(L)->failures++;
    return luaL_error(L, "%f is not within %f of %f", a, by, b);
}

static int word_truthy(lua_State *L) {
    luaL_checkany(L, 1);
    jox_test_run_of(L)->assertions++;
    if (lua_toboolean(L, 1))
        return 0;
    jox_test_run_of(L)->failures++;
    return luaL_error(L, "%s", luaL_optstring(L, 2, "this is not true"));
}

/* fails(function, "text"): the function must raise an error with that text. */
static int word_fails(lua_State *L) {
    luaL_checktype(L, 1, LUA_TFUNCTION);
    const char *text = luaL_optstring(L, 2, "");
    JoxTestRun *run = jox_test_run_of(L);
    uint64_t failures = run->failures;
    run->assertions++;
    lua_pushvalue(L, 1);
    bool fine = lua_pcall(L, 0, 0, 0) == LUA_OK;
    run->failures = failures; /* failures within the function were expected */
    if (fine) {
        run->failures++;
        return luaL_error(L, "this does not fail");
    }
    const char *why = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "no text";
    if (strstr(why, text))
        return 0;
    run->failures++;
    int number, line, used = 0; /* cuts the position, which names an internal chunk */
    if (sscanf(why, "b%d:%d: %n", &number, &line, &used) == 2)
        why += used;
    return luaL_error(L, "this fails, but not with '%s': %s", text, why);
}

const luaL_Reg jox_test_assertions[] = {{"equal", word_equal},
                                        {"near", word_near},
                                        {"truthy", word_truthy},
                                        {"fails", word_fails},
                                        {NULL, NULL}};
