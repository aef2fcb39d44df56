/* States that a patch names as "Guard.Walk": within an outer state. Called by patch.c before it
   applies the patch. */
#include <stdio.h>
#include <string.h>

#include "base/sort.h"
#include "lua/patch_tree.h"
#include "lua/read_table.h"

void jox_table_push_copy(lua_State *L, int index) {
    lua_newtable(L);
    int copy = lua_gettop(L);
    lua_pushnil(L);
    while (lua_next(L, index)) {
        jox_vm_charge(L, 5);
        lua_pushvalue(L, -2);
        lua_insert(L, -2);
        lua_rawset(L, copy);
    }
}

bool jox_table_is_list(lua_State *L, int index) {
    bool list = lua_type(L, index) == LUA_TTABLE && lua_rawlen(L, index) > 0;
    if (!list)
        return false;
    for (lua_pushnil(L); list && lua_next(L, index); lua_pop(L, 1)) {
        jox_vm_charge(L, 1);
        list = lua_isinteger(L, -2) != 0;
        if (!list) {
            lua_pop(L, 2);
            break;
        }
    }
    return list;
}

/* Returns whether the machine's table has no state of this name, but the outer state that the name
   begins with. */
static bool is_whole_name(JoxLuaNodes *n, const char *name) {
    lua_State *L = n->L;
    const int top = lua_gettop(L);
    const size_t first = strcspn(name, ".");
    bool whole = false;
    if (name[first] && jox_read_field(L, n->table, "states") == LUA_TTABLE) {
        jox_read_field(L, top + 1, name);
        lua_pushlstring(L, name, first);
        lua_rawget(L, top + 1);
        whole = lua_isnil(L, top + 2) && lua_istable(L, top + 3);
        if (whole)
            whole = jox_read_field(L, top + 3, "runs") != LUA_TNIL;
    }
    lua_settop(L, top);
    return whole;
}

/* Pushes table[key] of the table at `at`, a copy of it that replaces it; a new table if there is
   none. */
static void push_inner_copy(lua_State *L, int at, const char *key) {
    if (jox_read_field(L, at, key) == LUA_TTABLE) {
        jox_table_push_copy(L, lua_gettop(L));
        lua_remove(L, -2);
    } else {
        lua_pop(L, 1);
        lua_newtable(L);
    }
    lua_pushvalue(L, -1);
    lua_setfield(L, at, key);
}

/* Moves states[name], of the copy at stack index `states`, to where it belongs. */
static void move_state(lua_State *L, int states, const char *name) {
    const int top = lua_gettop(L);
    char part[128];
    luaL_checkstack(L, 20, "states");
    jox_read_field(L, states, name); /* the state's change, moved below */
    lua_pushstring(L, name);
    lua_pushnil(L);
    lua_rawset(L, states);
    lua_pushvalue(L, states);
    for (const char *dot; (dot = strchr(name, '.')); name = dot + 1) {
        snprintf(part, sizeof part, "%.*s", (int)(dot - name), name);
        push_inner_copy(L, lua_gettop(L), part);
        push_inner_copy(L, lua_gettop(L), "runs");
        push_inner_copy(L, lua_gettop(L), "states");
    }
    lua_pushvalue(L, top + 1);
    lua_setfield(L, -2, name);
    lua_settop(L, top);
}

void jox_nodes_expand_states(JoxLuaNodes *n) {
    enum { MOST = 256 };
    lua_State *L = n->L;
    const int change = lua_gettop(L);
    const char *names[MOST];
    size_t count = 0;
    if (!lua_istable(L, change) || jox_read_field(L, change, "states") != LUA_TTABLE) {
        lua_settop(L, change);
        return;
    }
    for (lua_pushnil(L); lua_next(L, change + 1); lua_pop(L, 1))
        if (lua_type(L, -2) == LUA_TSTRING && count < MOST && strchr(lua_tostring(L, -2), '.') &&
            strlen(lua_tostring(L, -2)) < 120 && is_whole_name(n, lua_tostring(L, -2)))
            names[count++] = lua_tostring(L, -2); /* valid while the patch's own table lives */
    jox_sort_texts(names, count);
    if (count > 0) {
        jox_table_push_copy(L, change);
        push_inner_copy(L, change + 2, "states");
        for (size_t s = 0; s < count; s++)
            move_state(L, change + 3, names[s]);
        lua_settop(L, change + 2);
        lua_replace(L, change);
    }
    lua_settop(L, change);
}
