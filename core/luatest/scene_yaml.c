/* Converts a Lua table to the text of a scene: JSON, which is valid YAML. In these functions `key`
   is the member's name, NULL within a list, and `name` the value's name in errors: its key, or that
   of the list that contains it. */
#include <math.h>
#include <string.h>

#include "base/format/json_writer.h"
#include "luatest/luatest_parts.h"

enum { DEEPEST = 16, LONGEST = 4 << 20 };

static void write_yaml_value(lua_State *L, JoxTestRun *run, int index, const char *key,
                             const char *name, JoxJson *json);

static void write_yaml_string(lua_State *L, JoxTestRun *run, int index, const char *key,
                              const char *name, JoxJson *json) {
    size_t length;
    const char *text = lua_tolstring(L, index, &length);
    if (!strcmp(name, "behaviour") &&
        (strchr(text, '\n') || strstr(text, "return machine") || strstr(text, "return sequence"))) {
        text = run->driver->keep(run->driver->context, text, length);
        if (!text)
            luaL_error(L,
                       "the behaviours in a file of tests are at most 200, of at most 256 KB each");
    }
    jox_json_string(json, key, text);
}

static void write_yaml_list(lua_State *L, JoxTestRun *run, int index, lua_Integer length,
                            const char *key, const char *name, JoxJson *json) {
    lua_pushnil(L);
    while (lua_next(L, index)) {
        lua_pop(L, 1);
        if (lua_type(L, -1) == LUA_TSTRING)
            luaL_error(L, "'%s' is a list and has a key '%s'", name, lua_tostring(L, -1));
    }
    jox_json_array(json, key);
    for (lua_Integer i = 1; i <= length; i++) {
        lua_rawgeti(L, index, i);
        write_yaml_value(L, run, lua_gettop(L), NULL, name, json);
        lua_pop(L, 1);
    }
    jox_json_end(json);
}

/* Returns the key that follows `last` in ascending order (NULL: the first), or NULL after the last
   one. Lua's own order of keys is not deterministic. */
static const char *next_key(lua_State *L, int index, const char *last, const char *name) {
    const char *next = NULL;
    lua_pushnil(L);
    while (lua_next(L, index)) {
        lua_pop(L, 1);
        jox_vm_charge(L, 4);
        const char *key = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
        if (!key)
            luaL_error(L, "'%s' has a key that is no name", name);
        if (key && (!last || strcmp(key, last) > 0) && (!next || strcmp(key, next) < 0))
            next = key;
    }
    return next;
}

static void write_yaml_members(lua_State *L, JoxTestRun *run, int index, const char *name,
                               JoxJson *json) {
    const char *key = NULL;
    while ((key = next_key(L, index, key, name))) {
        lua_pushstring(L, key);
        lua_rawget(L, index);
        write_yaml_value(L, run, lua_gettop(L), key, key, json);
        lua_pop(L, 1);
    }
}

static void write_yaml_value(lua_State *L, JoxTestRun *run, int index, const char *key,
                             const char *name, JoxJson *json) {
    luaL_checkstack(L, 10, NULL);
    if (json->depth > DEEPEST || json->out->length > LONGEST)
        luaL_error(L, "this scene is too deep or too large");
    switch (lua_type(L, index)) {
    case LUA_TTABLE: {
        lua_Integer length = (lua_Integer)lua_rawlen(L, index);
        if (length > 0) {
            write_yaml_list(L, run, index, length, key, name, json);
            break;
        }
        jox_json_object(json, key);
        write_yaml_members(L, run, index, name, json);
        jox_json_end(json);
        break;
    }
    case LUA_TSTRING:
        write_yaml_string(L, run, index, key, name, json);
        break;
    case LUA_TBOOLEAN:
        jox_json_bool(json, key, lua_toboolean(L, index));
        break;
    case LUA_TNUMBER:
        if (!isfinite(lua_tonumber(L, index)))
            luaL_error(L, "'%s' of a scene is not finite", name);
        jox_json_digits(json, key, lua_tonumber(L, index), 17);
        break;
    default:
        luaL_error(L, "'%s' of a scene cannot be a %s", name, luaL_typename(L, index));
    }
}

void jox_test_scene_yaml(lua_State *L, JoxTestRun *run, int index, JoxText *out) {
    JoxJson json = jox_json_begin(out, 0);
    if (lua_rawlen(L, index) > 0) { /* a list is not a scene, which loading reports */
        write_yaml_value(L, run, index, NULL, "scene", &json);
        return;
    }
    lua_pushliteral(L, "jostle");
    bool version = lua_rawget(L, index) != LUA_TNIL;
    lua_pop(L, 1);
    jox_json_object(&json, NULL);
    if (!version) /* a test may leave out the version of the format */
        jox_json_whole(&json, "jostle", 1);
    write_yaml_members(L, run, index, "scene", &json);
    jox_json_end(&json);
}

size_t jox_test_read_texts(lua_State *L, int index, const char *name, bool pairs,
                           const char *out[64]) {
    size_t count = 0;
    if (lua_type(L, index) != LUA_TTABLE)
        return 0;
    lua_pushstring(L, name);
    int type = lua_rawget(L, index);
    if (type == LUA_TNIL)
        return 0;
    if (type != LUA_TTABLE)
        luaL_error(L, "option '%s' must be a table", name);
    int from = lua_gettop(L);
    lua_newtable(L);
    lua_pushnil(L);
    while (lua_next(L, from)) {
        int key = lua_type(L, -2);
        if (count == 64 || (pairs ? key != LUA_TSTRING : key != LUA_TNUMBER) ||
            (lua_type(L, -1) != LUA_TSTRING && lua_type(L, -1) != LUA_TNUMBER &&
             lua_type(L, -1) != LUA_TBOOLEAN))
            luaL_error(L,
                       pairs ? "'%s' maps at most 64 paths to values"
                             : "'%s' is a list of at most 64 names",
                       name);
        luaL_tolstring(L, -1, NULL);
        if (pairs)
            lua_pushfstring(L, "%s=%s", lua_tostring(L, -3), lua_tostring(L, -1));
        const char *text = lua_tostring(L, -1);
        size_t at = count++; /* sorted by insertion: Lua's order of keys is not deterministic */
        for (; pairs && at > 0 && strcmp(out[at - 1], text) > 0; at--)
            out[at] = out[at - 1];
        out[at] = text;
        lua_rawseti(L, from + 1, (lua_Integer)count);
        lua_settop(L, from + 2);
    }
    return count;
}
