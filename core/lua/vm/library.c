/* Base functions of behaviours, such as pairs, print and pcall. Every loop in C is charged to the
   script's budget. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "lua/vm/library.h"

enum { MOST_KEYS = 65536, LONGEST_LINE = 400, LOAD_LINES = 5 /* times the limit of a second */ };

/* ---- pairs in a fixed order: numbers, then strings ---- */

/* A key of a table that is sorted. Its text stays alive as the table of keys holds it. */
typedef struct Key {
    union {
        lua_Integer integer;
        double number;
        const char *text;
    } as;
    uint32_t length;
    enum { KEY_INTEGER, KEY_FLOAT, KEY_TEXT } kind;
} Key;

/* Returns whether an integer is below a non-integral number; exact, while a cast of the integer
   would round. */
static bool integer_before(lua_Integer i, double f) {
    if (f >= 9223372036854775808.0)
        return true;
    return f > -9223372036854775808.0 && i <= (lua_Integer)floor(f);
}

static bool key_before(const Key *a, const Key *b) {
    if ((a->kind == KEY_TEXT) != (b->kind == KEY_TEXT))
        return b->kind == KEY_TEXT;
    if (a->kind == KEY_TEXT)
        return jox_library_compare(a->as.text, a->length, b->as.text, b->length) < 0;
    if (a->kind == KEY_INTEGER && b->kind == KEY_INTEGER)
        return a->as.integer < b->as.integer;
    if (a->kind == KEY_FLOAT && b->kind == KEY_FLOAT)
        return a->as.number < b->as.number;
    return a->kind == KEY_INTEGER ? integer_before(a->as.integer, b->as.number)
                                  : !integer_before(b->as.integer, a->as.number);
}

static Key read_key(lua_State *L, int index) {
    Key key = {0};
    if (lua_isinteger(L, index)) {
        key.as.integer = lua_tointeger(L, index);
        key.kind = KEY_INTEGER;
    } else if (lua_type(L, index) == LUA_TNUMBER) {
        key.as.number = lua_tonumber(L, index);
        key.kind = KEY_FLOAT;
    } else if (lua_type(L, index) == LUA_TSTRING) {
        size_t length;
        key.as.text = lua_tolstring(L, index, &length);
        key.length = (uint32_t)length; /* fits, as an allocation is limited */
        key.kind = KEY_TEXT;
    } else {
        luaL_error(L, "pairs and next visit tables whose keys are numbers and texts");
    }
    return key;
}

static void push_key(lua_State *L, const Key *key) {
    if (key->kind == KEY_INTEGER)
        lua_pushinteger(L, key->as.integer);
    else if (key->kind == KEY_FLOAT)
        lua_pushnumber(L, key->as.number);
    else
        lua_pushlstring(L, key->as.text, key->length);
}

/* Sorts keys by merging, which is as fast for any order of the input. `spare` has room for `count`
   keys. */
static void sort_keys(Key *keys, Key *spare, size_t count) {
    Key *from = keys, *to = spare;
    for (size_t width = 1; width < count; width *= 2) {
        for (size_t low = 0; low < count; low += 2 * width) {
            size_t middle = low + width < count ? low + width : count;
            size_t high = low + 2 * width < count ? low + 2 * width : count;
            size_t a = low, b = middle;
            for (size_t k = low; k < high; k++)
                to[k] = b >= high || (a < middle && !key_before(&from[b], &from[a])) ? from[a++]
                                                                                     : from[b++];
        }
        Key *swap = from;
        from = to;
        to = swap;
    }
    if (from != keys)
        memcpy(keys, from, count * sizeof *keys);
}

/* Pushes a table with the sorted keys of the table on top of the stack. */
static void push_sorted(lua_State *L) {
    JOX_ASSERT(lua_istable(L, -1));
    size_t count = 0, bytes = 0, at = 0;
    const int table = lua_gettop(L);
    for (lua_pushnil(L); lua_next(L, table); lua_pop(L, 1))
        if (++count > MOST_KEYS)
            luaL_error(L, "pairs visits tables of at most %d keys", MOST_KEYS);
    jox_vm_charge(L, count / 2 + 4);
    Key *keys = lua_newuserdatauv(L, (count + 1) * sizeof *keys, 0);
    Key *spare = lua_newuserdatauv(L, (count + 1) * sizeof *spare, 0);
    lua_createtable(L, (int)count,
                    0); /* no script code runs below, so that no key can be removed meanwhile */
    for (lua_pushnil(L); at < count && lua_next(L, table); lua_pop(L, 1)) {
        keys[at] = read_key(L, lua_gettop(L) - 1);
        bytes += keys[at].kind == KEY_TEXT ? keys[at].length : 0;
        at++;
    }
    unsigned rounds = 1;
    while ((1ull << rounds) < count)
        rounds++;
    jox_vm_charge(L, (count + bytes / 16) * rounds / 4);
    sort_keys(keys, spare, count);
    for (size_t i = 0; i < count; i++) {
        push_key(L, &keys[i]);
        lua_rawseti(L, table + 3, (lua_Integer)i + 1);
    }
    lua_settop(L, table + 3);
    lua_replace(L, table + 1);
    lua_settop(L, table + 1);
}

/* Iterator of pairs. Upvalues: the table, its sorted keys, the number visited, the number of the
   call that made it. */
static int next_pair(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    if (lua_tointeger(L, lua_upvalueindex(4)) != (lua_Integer)vm->run)
        return luaL_error(L, "what pairs returned was kept from an earlier call");
    lua_Integer at = lua_tointeger(L, lua_upvalueindex(3));
    lua_settop(L, 0);
    jox_frozen_contents(L, lua_upvalueindex(1));
    for (;;) {
        jox_vm_charge(L, 1);
        if (lua_rawgeti(L, lua_upvalueindex(2), ++at) == LUA_TNIL)
            return 1;
        lua_pushvalue(L, -1);
        if (lua_rawget(L, 1) != LUA_TNIL) /* skips a key that was removed since */
            break;
        lua_settop(L, 1);
    }
    lua_pushinteger(L, at);
    lua_replace(L, lua_upvalueindex(3));
    return 2;
}

static int base_pairs(lua_State *L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_settop(L, 1);
    jox_frozen_contents(L, 1);
    push_sorted(L);
    lua_pushvalue(L, 1);
    lua_insert(L, -2);
    lua_pushinteger(L, 0);
    lua_pushinteger(L, (lua_Integer)jox_vm_of(L)->run);
    lua_pushcclosure(L, next_pair, 4);
    lua_pushvalue(L, 1);
    lua_pushnil(L);
    return 3;
}

/* Returns the key after another in the fixed order; each call looks at all keys. */
static int base_next(lua_State *L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_settop(L, 2);
    bool first = lua_isnil(L, 2), found = false;
    Key after = {0}, best = {0};
    if (!first)
        after = read_key(L, 2);
    jox_frozen_contents(L, 1);
    uint64_t seen = 0;
    for (lua_pushnil(L); lua_next(L, 3); lua_pop(L, 1)) {
        Key key = read_key(L, lua_gettop(L) - 1);
        bool later = first || key_before(&after, &key);
        if (later && (!found || key_before(&key, &best))) {
            best = key;
            found = true;
        }
        if ((++seen & 63) == 0)
            jox_vm_charge(L, 64);
    }
    if (!found)
        return lua_pushnil(L), 1;
    push_key(L, &best);
    lua_pushvalue(L, -1);
    lua_rawget(L, 3);
    return 2;
}

static int next_item(lua_State *L) {
    lua_Integer i = luaL_checkinteger(L, 2);
    luaL_checktype(L, 1, LUA_TTABLE);
    luaL_argcheck(L, i < LUA_MAXINTEGER, 2, "too large");
    jox_frozen_contents(L, 1);
    lua_pushinteger(L, i + 1);
    return lua_rawgeti(L, -2, i + 1) == LUA_TNIL ? 1 : 2;
}
static int base_ipairs(lua_State *L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_pushcfunction(L, next_item);
    lua_pushvalue(L, 1);
    lua_pushinteger(L, 0);
    return 3;
}

/* ---- types and text of values ---- */

static int base_type(lua_State *L) {
    luaL_checkany(L, 1);
    lua_pushstring(L, jox_library_kind(L, 1));
    return 1;
}
static int base_tostring(lua_State *L) {
    luaL_checkany(L, 1);
    jox_library_text(L, 1, NULL);
    return 1;
}

static int digit_of(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'z' ? c - 'a' + 10
           : c >= 'A' && c <= 'Z' ? c - 'A' + 10
                                  : 99;
}
static int base_tonumber(lua_State *L) {
    size_t length;
    if (lua_isnoneornil(L, 2)) {
        luaL_checkany(L, 1);
        const char *text = lua_type(L, 1) == LUA_TSTRING ? lua_tolstring(L, 1, &length) : NULL;
        if (text && (length > 200 || lua_stringtonumber(L, text) != length + 1))
            lua_pushnil(L);
        else if (!text && lua_type(L, 1) == LUA_TNUMBER)
            lua_pushvalue(L, 1);
        else if (!text)
            lua_pushnil(L);
        return 1;
    }
    lua_Integer base = luaL_checkinteger(L, 2);
    luaL_argcheck(L, base >= 2 && base <= 36, 2, "a base is from 2 to 36");
    luaL_checktype(L, 1, LUA_TSTRING);
    const char *c = lua_tolstring(L, 1, &length), *end = c + length;
    jox_vm_charge(L, length / 8);
    while (c < end && (*c == ' ' || *c == '\t'))
        c++;
    while (end > c && (end[-1] == ' ' || end[-1] == '\t'))
        end--;
    bool minus = c < end && *c == '-', good;
    c += minus;
    good = c < end;
    lua_Unsigned n = 0;
    for (; c < end && good; c++) {
        good = digit_of(*c) < base;
        n = n * (lua_Unsigned)base + (lua_Unsigned)digit_of(*c);
    }
    if (good)
        lua_pushinteger(L, (lua_Integer)(minus ? 0u - n : n));
    else
        lua_pushnil(L);
    return 1;
}

static int base_select(lua_State *L) {
    int count = lua_gettop(L);
    if (lua_type(L, 1) == LUA_TSTRING && strcmp(lua_tostring(L, 1), "#") == 0) {
        lua_pushinteger(L, count - 1);
        return 1;
    }
    lua_Integer n = luaL_checkinteger(L, 1);
    n = n < 0 ? count + n : n > count ? count : n;
    luaL_argcheck(L, n >= 1, 1, "there are not so many");
    jox_vm_charge(L, (uint64_t)count / 8);
    return count - (int)n;
}

/* ---- errors ---- */

static int base_error(lua_State *L) {
    lua_Integer level = luaL_optinteger(L, 2, 1);
    if (lua_type(L, 1) != LUA_TSTRING)
        return luaL_error(L, "error needs a text");
    lua_settop(L, 1);
    luaL_where(L, level == 0   ? 0
                  : level == 2 ? 2
                               : 1); /* level 0 is a C function and has no place */
    lua_insert(L, 1);
    lua_concat(L, 2);
    return lua_error(L);
}
static int base_assert(lua_State *L) {
    if (lua_toboolean(L, 1))
        return lua_gettop(L);
    luaL_checkany(L, 1);
    if (lua_type(L, 2) != LUA_TSTRING)
        return luaL_error(L, "assertion failed");
    luaL_where(L, 1);
    lua_pushvalue(L, 2);
    lua_concat(L, 2);
    return lua_error(L);
}

/* pcall does not catch a spent budget or a lack of memory: those end the script. */
static int base_pcall(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    luaL_checkany(L, 1);
    jox_vm_charge(L, 10);
    lua_pushboolean(L, 1);
    lua_insert(L, 1);
    int status = lua_pcall(L, lua_gettop(L) - 2, LUA_MULTRET, 0);
    vm->starved |= status == LUA_ERRMEM;
    if (status != LUA_OK && (vm->over || vm->starved))
        return jox_vm_stop(L);
    if (status == LUA_OK)
        return lua_gettop(L);
    lua_pushboolean(L, 0);
    lua_insert(L, -2);
    return 2;
}

/* ---- print ---- */

/* Counts a printed line; returns whether it may be printed in this second of simulated time. *last:
   print instead that no more lines follow. */
static bool may_print(JoxVm *vm, bool *last) {
    uint32_t most = vm->group->limits.print_lines;
    const uint32_t second = vm->loading ? 0 : vm->second;
    if (second != vm->print_second) {
        vm->print_second = second;
        vm->printed = 0;
    }
    if (second == 0)
        most *= LOAD_LINES;
    *last = vm->printed == most;
    if (vm->printed <= most)
        vm->printed++;
    return vm->printed <= most || *last;
}

static int base_print(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    int count = lua_gettop(L);
    bool last;
    jox_vm_charge(L, 50);
    if (!may_print(vm, &last) || (!vm->loading && !vm->group->say))
        return 0;
    JoxPosition place = jox_vm_place(L);
    char line[LONGEST_LINE + 600];
    int used = snprintf(line, 512, "%s:%d: ", place.file ? place.file : "?", place.line);
    size_t at = used < 511 ? (size_t)used : 511;
    const size_t end = at + LONGEST_LINE;
    if (last)
        at += (size_t)sprintf(line + at, "... print is limited");
    for (int i = 1; i <= count && !last && at < end; i++) {
        size_t length;
        const char *text = jox_library_text(L, i, &length);
        if (i > 1)
            line[at++] = ' ';
        bool fits = length <= end - at;
        length = fits ? length : end - at;
        memcpy(line + at, text, length);
        at += length;
        if (!fits)
            at += (size_t)sprintf(line + at, " ...");
        lua_pop(L, 1);
    }
    line[at] = 0;
    jox_text_clean(line);
    memcpy(line + at, "\n", 2);
    if (vm->loading) /* may be on another thread: the text is printed when the file is adopted */
        jox_text_add(&vm->printed_text, line);
    else
        vm->group->say(vm->group->say_context, line);
    return 0;
}

const luaL_Reg jox_library_base[] = {
    {"pairs", base_pairs},   {"ipairs", base_ipairs},     {"next", base_next},
    {"type", base_type},     {"tostring", base_tostring}, {"tonumber", base_tonumber},
    {"select", base_select}, {"error", base_error},       {"assert", base_assert},
    {"pcall", base_pcall},   {"print", base_print},       {NULL, NULL}};
