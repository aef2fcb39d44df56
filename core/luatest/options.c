/* Options of the functions of tests: tables with known keys. */
#include <string.h>

#include "luatest/luatest_parts.h"

double jox_test_number_option(lua_State *L, int index, const char *name, double standard) {
    if (lua_type(L, index) != LUA_TTABLE)
        return standard;
    lua_pushstring(L, name);
    lua_rawget(L, index);
    double value = lua_type(L, -1) == LUA_TNUMBER ? lua_tonumber(L, -1) : standard;
    if (!lua_isnil(L, -1) && (lua_type(L, -1) != LUA_TNUMBER || !(value >= -1.0 && value <= 4e9)))
        luaL_error(L, "option '%s' must be a number from 0 to 4e9", name);
    lua_pop(L, 1);
    return value;
}

void jox_test_check_options(lua_State *L, int index, const char *const *known, size_t count) {
    if (lua_isnoneornil(L, index))
        return;
    luaL_checktype(L, index, LUA_TTABLE);
    lua_pushnil(L);
    while (lua_next(L, index)) {
        lua_pop(L, 1);
        const char *key = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "?";
        bool found = false;
        for (size_t k = 0; k < count; k++)
            found |= strcmp(known[k], key) == 0;
        const char *near = found ? NULL : jox_suggest(key, known, count);
        if (!found)
            luaL_error(L, "there is no option '%s'%s%s", key, near ? "; did you mean " : "",
                       near ? near : "");
    }
}

const char *jox_test_text_option(lua_State *L, int index, const char *name) {
    lua_pushstring(L, name);
    lua_rawget(L, index);
    const char *text = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
    if (!text && !lua_isnil(L, -1))
        luaL_error(L, "option '%s' must be a text", name);
    lua_pop(L, 1); /* the table keeps it */
    return text;
}
