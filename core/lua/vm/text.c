/* Text of Lua values, and the growing text that library functions build. */
#include <string.h>

#include "base/assert.h"
#include "lua/vm/library.h"

enum { LONGEST = 1 << 20 };

const char *jox_library_kind(lua_State *L, int index) {
    const int top = lua_gettop(L);
    if (lua_type(L, index) == LUA_TUSERDATA &&
        luaL_getmetafield(L, index, "__kind") == LUA_TSTRING) {
        const char *kind = lua_tostring(L, -1); /* valid while the metatable lives */
        lua_settop(L, top);
        return kind;
    }
    lua_settop(L, top);
    return luaL_typename(L, index);
}

const char *jox_library_text(lua_State *L, int index, size_t *length) {
    int type = lua_type(L, index);
    if (type == LUA_TNUMBER && lua_tonumber(L, index) != lua_tonumber(L, index))
        lua_pushliteral(L, "nan"); /* without the sign, which means nothing */
    else if (type == LUA_TNUMBER || type == LUA_TSTRING)
        lua_pushvalue(L, index);
    else if (type == LUA_TBOOLEAN)
        lua_pushstring(L, lua_toboolean(L, index) ? "true" : "false");
    else
        lua_pushstring(L, jox_library_kind(L, index)); /* instead of its address */
    return lua_tolstring(L, -1, length);
}

void jox_scratch_open(JoxScratch *s, lua_State *L, size_t capacity) {
    capacity = capacity < 64 ? 64 : capacity;
    luaL_checkstack(L, 4, "text");
    *s = (JoxScratch){L, lua_newuserdatauv(L, capacity, 0), 0, capacity, lua_gettop(L)};
}

void jox_scratch_add(JoxScratch *s, const char *text, size_t length) {
    JOX_ASSERT(s->length <= s->capacity && lua_gettop(s->L) >= s->slot);
    if (s->length + length > LONGEST)
        luaL_error(s->L, "the result would be over 1 MB");
    if (s->length + length > s->capacity) {
        size_t capacity =
            2 * s->capacity > s->length + length ? 2 * s->capacity : s->length + length;
        char *data = lua_newuserdatauv(s->L, capacity, 0);
        memcpy(data, s->data, s->length);
        lua_replace(s->L, s->slot);
        s->data = data;
        s->capacity = capacity;
    }
    if (length > 0)
        memcpy(s->data + s->length, text, length);
    s->length += length;
}

void jox_scratch_push(JoxScratch *s) {
    JOX_ASSERT(s->length <= s->capacity);
    lua_pushlstring(s->L, s->data, s->length);
}

int jox_library_compare(const char *a, size_t a_length, const char *b, size_t b_length) {
    int order = memcmp(a, b, a_length < b_length ? a_length : b_length);
    return order ? order : (a_length > b_length) - (a_length < b_length);
}
