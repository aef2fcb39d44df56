/* A Lua table as the text of a scene. */
#include <string.h>

#include "base/mem.h"
#include "luatest/internal.h"

static void write_value(lua_State *L, JoxTestRun *run, int index, const char *key, int depth,
                        JoxText *out);

static void write_string(lua_State *L, JoxTestRun *run, const char *key, const char *text,
                         size_t length, JoxText *out) {
    if (!strcmp(key, "behaviour") && (strchr(text, '\n') || strstr(text, "return machine"))) {
        text = run->driver->keep(run->driver->context, text, length);
        if (!text)
            luaL_error(L, "behaviours in a test are at most 200, of at most 256 KB each");
    }
    jox_text_json(out, text);
}

static void write_table(lua_State *L, JoxTestRun *run, int index, const char *key, int depth,
                        JoxText *out) {
    lua_Integer length = (lua_Integer)lua_rawlen(L, index);
    if (length > 0) {
        lua_pushnil(L);
        while (lua_next(L, index)) {
            lua_pop(L, 1);
            if (lua_type(L, -1) == LUA_TSTRING)
                luaL_error(L, "'%s' is a list and has a key '%s'", key, lua_tostring(L, -1));
        }
        jox_text_add(out, "[");
        for (lua_Integer i = 1; i <= length; i++) {
            jox_text_add(out, i > 1 ? ", " : "");
            lua_rawgeti(L, index, i);
            write_value(L, run, lua_gettop(L), key, depth + 1, out);
            lua_pop(L, 1);
        }
        jox_text_add(out, "]");
        return;
    }
    bool first = true;
    const char *last = NULL; /* keys in ascending order, whatever the table's own */
    jox_text_add(out, "{");
    for (;;) {
        const char *next = NULL;
        lua_pushnil(L);
        while (lua_next(L, index)) {
            lua_pop(L, 1);
            jox_vm_charge(L, 4);
            const char *name = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
            if (!name)
                luaL_error(L, "'%s' has a key that is no name", key);
            if (name && (!last || strcmp(name, last) > 0) && (!next || strcmp(name, next) < 0))
                next = name;
        }
        if (!next)
            break;
        last = next;
        jox_text_add(out, first ? "" : ", ");
        first = false;
        jox_text_json(out, next);
        jox_text_add(out, ": ");
        lua_pushstring(L, next);
        lua_rawget(L, index);
        write_value(L, run, lua_gettop(L), next, depth + 1, out);
        lua_pop(L, 1);
    }
    jox_text_add(out, "}");
}

static void write_value(lua_State *L, JoxTestRun *run, int index, const char *key, int depth,
                        JoxText *out) {
    luaL_checkstack(L, 10, NULL);
    if (depth > 16 || out->length > 4 << 20)
        luaL_error(L, "this scene is too deep or too large");
    switch (lua_type(L, index)) {
    case LUA_TTABLE:
        write_table(L, run, index, key, depth, out);
        break;
    case LUA_TSTRING: {
        size_t length;
        const char *text = lua_tolstring(L, index, &length);
        write_string(L, run, key, text, length, out);
        break;
    }
    case LUA_TBOOLEAN:
        jox_text_add(out, lua_toboolean(L, index) ? "true" : "false");
        break;
    case LUA_TNUMBER:
        jox_text_printf(out, "%.17g", lua_tonumber(L, index));
        break;
    default:
        luaL_error(L, "'%s' of a scene cannot be a %s", key, luaL_typename(L, index));
    }
}

void jox_test_scene_yaml(lua_State *L, JoxTestRun *run, int index, JoxText *out) {
    lua_pushliteral(L, "jostle");
    bool version = lua_rawget(L, index) != LUA_TNIL;
    lua_pop(L, 1);
    size_t from = out->length;
    write_table(L, run, index, "scene", 0, out);
    if (version || out->data[from] != '{')
        return;
    out->data[from] = ' '; /* the version of the format goes without saying */
    JoxText whole = {0};
    bool empty = strcmp(out->data + from, " }") == 0;
    jox_text_printf(&whole, "{\"jostle\": 1%s%s", empty ? "" : ",", out->data + from);
    out->length = from;
    jox_text_append(out, whole.data, whole.length);
    jox_text_free(&whole);
}
