/* table.* of behaviours, with raw access. Frozen tables can be read but not written; all work is
   charged to the script's budget. */
#include <string.h>

#include "lua/vm/library.h"

enum { MOST_UNPACKED = 200, MOST_MOVED = 100000 };

static lua_Integer get_table_length(lua_State *L, int index) {
    jox_frozen_contents(L, index);
    lua_Integer n = (lua_Integer)lua_rawlen(L, -1);
    lua_pop(L, 1);
    return n;
}

/* insert(t, value) or insert(t, position, value) */
static int table_insert(lua_State *L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    jox_frozen_check_writable(L, 1);
    int given = lua_gettop(L);
    if (given < 2 || given > 3)
        return luaL_error(L, "table.insert takes a table, perhaps a position, and a value");
    lua_Integer n = (lua_Integer)lua_rawlen(L, 1) + 1;
    lua_Integer at = given == 2 ? n : luaL_checkinteger(L, 2);
    luaL_argcheck(L, at >= 1 && at <= n, 2, "the position is outside the list");
    jox_vm_charge(L, (uint64_t)(n - at));
    for (lua_Integer i = n; i > at; i--) {
        lua_rawgeti(L, 1, i - 1);
        lua_rawseti(L, 1, i);
    }
    lua_pushvalue(L, given);
    lua_rawseti(L, 1, at);
    return 0;
}

static int table_remove(lua_State *L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    jox_frozen_check_writable(L, 1);
    lua_Integer n = (lua_Integer)lua_rawlen(L, 1), at = luaL_optinteger(L, 2, n);
    luaL_argcheck(L, lua_isnoneornil(L, 2) || (at >= 1 && at <= n + 1) || (n == 0 && at == 0), 2,
                  "the position is outside the list");
    lua_rawgeti(L, 1, at);
    jox_vm_charge(L, n > at ? (uint64_t)(n - at) : 0);
    for (lua_Integer i = at; i < n; i++) {
        lua_rawgeti(L, 1, i + 1);
        lua_rawseti(L, 1, i);
    }
    if (at >= 1 && at <= n) {
        lua_pushnil(L);
        lua_rawseti(L, 1, n);
    }
    return 1;
}

static int table_concat(lua_State *L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    size_t gap;
    const char *separator = luaL_optlstring(L, 2, "", &gap);
    lua_Integer from = luaL_optinteger(L, 3, 1), to = luaL_optinteger(L, 4, get_table_length(L, 1));
    JoxScratch out;
    jox_frozen_contents(L, 1);
    int table = lua_gettop(L);
    jox_scratch_open(&out, L, 64);
    for (lua_Integer i = from; i <= to; i++) {
        jox_vm_charge(L, 2);
        int type = lua_rawgeti(L, table, i);
        if (type != LUA_TSTRING && type != LUA_TNUMBER)
            return luaL_error(L, "item %I is neither text nor number", i);
        size_t length;
        const char *text = lua_tolstring(L, -1, &length);
        jox_scratch_add(&out, text, length);
        lua_pop(L, 1);
        if (i == to)
            break; /* as it may be the greatest integer */
        jox_scratch_add(&out, separator, gap);
    }
    jox_scratch_push(&out);
    return 1;
}

static int table_pack(lua_State *L) {
    int n = lua_gettop(L);
    jox_vm_charge(L, (uint64_t)n / 4);
    lua_createtable(L, n, 1);
    lua_insert(L, 1);
    for (int i = n; i >= 1; i--)
        lua_rawseti(L, 1, i);
    lua_pushinteger(L, n);
    lua_setfield(L, 1, "n");
    return 1;
}

static int table_unpack(lua_State *L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_Integer from = luaL_optinteger(L, 2, 1), to = luaL_optinteger(L, 3, get_table_length(L, 1));
    if (from > to)
        return 0;
    luaL_argcheck(L, (lua_Unsigned)to - (lua_Unsigned)from < MOST_UNPACKED, 1,
                  "at most 200 values are unpacked at once");
    int count = (int)(to - from) + 1;
    luaL_checkstack(L, count + 2, "values");
    jox_vm_charge(L, (uint64_t)count / 4);
    jox_frozen_contents(L, 1);
    int table = lua_gettop(L);
    for (int i = 0; i < count; i++)
        lua_rawgeti(L, table, from + i);
    return count;
}

/* move(from, first, last, at [, into]) */
static int table_move(lua_State *L) {
    lua_Integer first = luaL_checkinteger(L, 2), last = luaL_checkinteger(L, 3);
    lua_Integer at = luaL_checkinteger(L, 4);
    int into = lua_isnoneornil(L, 5) ? 1 : 5;
    luaL_checktype(L, 1, LUA_TTABLE);
    luaL_checktype(L, into, LUA_TTABLE);
    jox_frozen_check_writable(L, into);
    if (last >= first) {
        luaL_argcheck(L, (lua_Unsigned)last - (lua_Unsigned)first < MOST_MOVED, 3,
                      "at most 100,000 items are moved at once");
        lua_Integer n = last - first + 1;
        luaL_argcheck(L, at <= LUA_MAXINTEGER - n, 4, "too large");
        jox_vm_charge(L, (uint64_t)n);
        jox_frozen_contents(L, 1);
        bool up = at > first && at <= last && lua_rawequal(L, 1, into);
        for (lua_Integer k = 0; k < n; k++) {
            lua_Integer i = up ? n - 1 - k : k;
            lua_rawgeti(L, -1, first + i);
            lua_rawseti(L, into, at + i);
        }
    }
    lua_pushvalue(L, into);
    return 1;
}

/* ---- sort: stable; ends and keeps every item whatever the comparator returns ---- */

enum { TABLE = 1, LESS, ITEMS }; /* stack indices */

static bool is_item_before(lua_State *L, uint32_t a, uint32_t b) {
    jox_vm_charge(L, 2);
    if (!lua_isnil(L, LESS))
        lua_pushvalue(L, LESS);
    lua_rawgeti(L, ITEMS, a);
    lua_rawgeti(L, ITEMS, b);
    bool result;
    if (!lua_isnil(L, LESS)) {
        lua_call(L, 2, 1);
        result = lua_toboolean(L, -1);
        lua_pop(L, 1);
        return result;
    }
    int type = lua_type(L, -1);
    if (type != lua_type(L, -2) || (type != LUA_TNUMBER && type != LUA_TSTRING))
        luaL_error(L, "table.sort cannot compare a %s with a %s; give it a function",
                   luaL_typename(L, -2), luaL_typename(L, -1));
    if (type == LUA_TNUMBER) {
        result = lua_compare(L, -2, -1, LUA_OPLT);
    } else {
        size_t n, m;
        const char *s = lua_tolstring(L, -2, &n), *t = lua_tolstring(L, -1, &m);
        jox_vm_charge(L, (n < m ? n : m) / 16);
        result = jox_library_compare(s, n, t, m) < 0;
    }
    lua_pop(L, 2);
    return result;
}

/* Sorts indices by merging; `order` has room for twice the count. Returns the half that holds the
   result. */
static uint32_t *sort_indices(lua_State *L, uint32_t *order, uint32_t count) {
    uint32_t *from = order, *to = order + count;
    for (uint32_t i = 0; i < count; i++)
        from[i] = i + 1;
    for (uint32_t width = 1; width < count; width *= 2) {
        for (uint32_t low = 0; low < count; low += 2 * width) {
            uint32_t middle = low + width < count ? low + width : count;
            uint32_t high = low + 2 * width < count ? low + 2 * width : count;
            for (uint32_t k = low, a = low, b = middle; k < high; k++) {
                bool right = b < high && (a >= middle || is_item_before(L, from[b], from[a]));
                to[k] = right ? from[b++] : from[a++];
            }
        }
        uint32_t *swap = from;
        from = to;
        to = swap;
    }
    return from;
}

static int table_sort(lua_State *L) {
    luaL_checktype(L, TABLE, LUA_TTABLE);
    jox_frozen_check_writable(L, TABLE);
    if (!lua_isnoneornil(L, LESS))
        luaL_checktype(L, LESS, LUA_TFUNCTION);
    lua_settop(L, LESS);
    lua_Unsigned count = lua_rawlen(L, TABLE);
    luaL_argcheck(L, count <= MOST_MOVED, TABLE, "at most 100,000 items are sorted at once");
    jox_vm_charge(L, count);
    luaL_checkstack(L, 8, "sort");
    lua_createtable(L, (int)count, 0); /* a copy of the items, so that an error changes nothing */
    for (lua_Unsigned i = 1; i <= count; i++) {
        lua_rawgeti(L, TABLE, (lua_Integer)i);
        lua_rawseti(L, ITEMS, (lua_Integer)i);
    }
    uint32_t *order = lua_newuserdatauv(L, 2 * (count + 1) * sizeof *order, 0);
    const uint32_t *sorted = sort_indices(L, order, (uint32_t)count);
    for (lua_Unsigned i = 1; i <= count; i++) {
        lua_rawgeti(L, ITEMS, sorted[i - 1]);
        lua_rawseti(L, TABLE, (lua_Integer)i);
    }
    return 0;
}

const luaL_Reg jox_library_table[] = {{"insert", table_insert}, {"remove", table_remove},
                                      {"concat", table_concat}, {"pack", table_pack},
                                      {"unpack", table_unpack}, {"move", table_move},
                                      {"sort", table_sort},     {NULL, NULL}};
