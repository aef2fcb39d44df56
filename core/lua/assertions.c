/* What a test asserts of plain values. */
#include <math.h>
#include <string.h>

#include "lua/trial.h"

static int word_equal(lua_State *L) {
    luaL_checkany(L, 2);
    jox_trial_of(L)->assertions++;
    if (lua_rawequal(L, 1, 2))
        return 0;
    return luaL_error(L, "%s is not %s", luaL_tolstring(L, 1, NULL), luaL_tolstring(L, 2, NULL));
}

static int word_near(lua_State *L) {
    double a = luaL_checknumber(L, 1), b = luaL_checknumber(L, 2), by = luaL_checknumber(L, 3);
    jox_trial_of(L)->assertions++;
    if (fabs(a - b) <= by)
        return 0;
    return luaL_error(L, "%f is not within %f of %f", a, by, b);
}

static int word_truthy(lua_State *L) {
    luaL_checkany(L, 1);
    jox_trial_of(L)->assertions++;
    if (lua_toboolean(L, 1))
        return 0;
    return luaL_error(L, "%s", luaL_optstring(L, 2, "this is not true"));
}

/* fails(function, "text"): the function must raise an error with that text. */
static int word_fails(lua_State *L) {
    luaL_checktype(L, 1, LUA_TFUNCTION);
    const char *text = luaL_optstring(L, 2, "");
    jox_trial_of(L)->assertions++;
    lua_pushvalue(L, 1);
    if (lua_pcall(L, 0, 0, 0) == LUA_OK)
        return luaL_error(L, "this does not fail");
    if (lua_type(L, -1) == LUA_TSTRING && strstr(lua_tostring(L, -1), text))
        return 0;
    return luaL_error(L, "this fails, but not with '%s': %s", text,
                      lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "no text");
}

const luaL_Reg jox_trial_assertions[] = {{"equal", word_equal},
                                         {"near", word_near},
                                         {"truthy", word_truthy},
                                         {"fails", word_fails},
                                         {NULL, NULL}};
