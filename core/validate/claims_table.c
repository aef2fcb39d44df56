/* Reads fields of a table in a claim file and checks their types. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "validate/claims_parts.h"

void jox_claim_check_keys(lua_State *L, const char *what, const char *const *known, size_t count) {
    lua_pushnil(L);
    while (lua_next(L, -2)) {
        const char *key = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : NULL;
        bool fine = key == NULL;
        for (size_t k = 0; key && k < count; k++)
            fine |= strcmp(key, known[k]) == 0;
        if (!fine) {
            const char *near = jox_suggest(key, known, count);
            luaL_error(L, "%s has no '%s'%s%s%s", what, key, near ? "; did you mean '" : "",
                       near ? near : "", near ? "'?" : "");
        }
        lua_pop(L, 1);
    }
}

char *jox_claim_read_text(lua_State *L, const char *what, const char *key, bool needed) {
    int type = lua_getfield(L, -1, key);
    if (type != LUA_TSTRING && (needed || type != LUA_TNIL))
        luaL_error(L, "%s needs %s = \"...\"", what, key);
    const char *given = type == LUA_TNIL ? "" : lua_tostring(L, -1);
    if (type != LUA_TNIL && given[strspn(given, " \t\r\n")] == '\0')
        luaL_error(L, "%s: %s is empty: write a text", what, key);
    char *text = jox_strdup(given);
    lua_pop(L, 1);
    return text;
}

double jox_claim_read_number(lua_State *L, const char *what, const char *key, double otherwise) {
    int type = lua_getfield(L, -1, key);
    double value = type == LUA_TNIL ? otherwise : lua_tonumber(L, -1);
    if (type != LUA_TNIL && (type != LUA_TNUMBER || !isfinite(value)))
        luaL_error(L, "%s: %s is a number", what, key);
    lua_pop(L, 1);
    return value;
}
