/* What a behaviour may use: a whitelist, nothing of Lua's libraries is opened. No files, clocks,
   addresses, coroutines, metatables, code from strings, or patterns. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/elementary.h"
#include "base/hash.h"
#include "base/mem.h"
#include "lua/internal.h"

enum { LONGEST_STRING = 1 << 20, MOST_FILES = 64 };

/* ---- mathematics: the same bits everywhere ---- */

static int call_1(lua_State *L, double (*f)(double)) {
    lua_pushnumber(L, f(luaL_checknumber(L, 1)));
    return 1;
}
static int math_sin(lua_State *L) {
    return call_1(L, jox_sin);
}
static int math_cos(lua_State *L) {
    return call_1(L, jox_cos);
}
static int math_exp(lua_State *L) {
    return call_1(L, jox_exp);
}
static int math_log(lua_State *L) {
    return call_1(L, jox_log);
}
static int math_sqrt(lua_State *L) {
    return call_1(L, sqrt);
}
static int math_abs(lua_State *L) {
    return call_1(L, fabs);
}
static int math_floor(lua_State *L) {
    return call_1(L, floor);
}
static int math_ceil(lua_State *L) {
    return call_1(L, ceil);
}
static int math_atan(lua_State *L) {
    lua_pushnumber(L, jox_atan2(luaL_checknumber(L, 1), luaL_optnumber(L, 2, 1.0)));
    return 1;
}
static int math_fmod(lua_State *L) {
    lua_pushnumber(L, fmod(luaL_checknumber(L, 1), luaL_checknumber(L, 2)));
    return 1;
}
static int extreme(lua_State *L, double sign) {
    double best = luaL_checknumber(L, 1);
    for (int i = 2; i <= lua_gettop(L); i++) {
        double v = luaL_checknumber(L, i);
        best = sign * v > sign * best ? v : best;
    }
    lua_pushnumber(L, best);
    return 1;
}
static int math_max(lua_State *L) {
    return extreme(L, 1.0);
}
static int math_min(lua_State *L) {
    return extreme(L, -1.0);
}

/* From the agent's own stream: a function of seed, agent and tick. */
static int math_random(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    if (vm->loading || !vm->owner->mind)
        return luaL_error(L, "math.random works in functions of agents only; at load use normal, "
                             "uniform or choose");
    const JoxMind *mind = vm->owner->mind;
    double u = jox_random_unit(mind->seed, mind->agents->id[vm->agent], mind->tick, JOX_DRAW_LUA,
                               vm->draws++);
    if (lua_gettop(L) == 0) {
        lua_pushnumber(L, u);
        return 1;
    }
    double low = lua_gettop(L) > 1 ? luaL_checknumber(L, 1) : 1.0;
    double high = luaL_checknumber(L, lua_gettop(L) > 1 ? 2 : 1);
    luaL_argcheck(L, high >= low && high - low < 1e15, 1, "the interval is empty");
    lua_pushinteger(L, (lua_Integer)(low + floor(u * (high - low + 1.0))));
    return 1;
}

static const luaL_Reg MATH[] = {{"sin", math_sin},       {"cos", math_cos},   {"exp", math_exp},
                                {"log", math_log},       {"sqrt", math_sqrt}, {"abs", math_abs},
                                {"floor", math_floor},   {"ceil", math_ceil}, {"atan", math_atan},
                                {"fmod", math_fmod},     {"max", math_max},   {"min", math_min},
                                {"random", math_random}, {NULL, NULL}};

/* ---- strings and tables ---- */

static int string_len(lua_State *L) {
    size_t n;
    luaL_checklstring(L, 1, &n);
    lua_pushinteger(L, (lua_Integer)n);
    return 1;
}
static int string_sub(lua_State *L) {
    size_t n;
    const char *s = luaL_checklstring(L, 1, &n);
    lua_Integer length = (lua_Integer)n, i = luaL_checkinteger(L, 2), j = luaL_optinteger(L, 3, -1);
    i = i < 0 ? (length + i + 1 < 1 ? 1 : length + i + 1) : i == 0 ? 1 : i;
    j = j < 0 ? length + j + 1 : j > length ? length : j;
    lua_pushlstring(L, i <= j ? s + i - 1 : "", i <= j ? (size_t)(j - i + 1) : 0);
    return 1;
}
static int string_rep(lua_State *L) {
    size_t n;
    const char *s = luaL_checklstring(L, 1, &n);
    lua_Integer times = luaL_checkinteger(L, 2);
    luaL_argcheck(L, times <= 0 || n == 0 || times <= LONGEST_STRING / (lua_Integer)n, 2,
                  "the result would be over 1 MB");
    luaL_Buffer buffer;
    luaL_buffinit(L, &buffer);
    for (lua_Integer i = 0; i < times && n > 0; i++)
        luaL_addlstring(&buffer, s, n);
    luaL_pushresult(&buffer);
    return 1;
}
static int fold(lua_State *L, char low, char high, int by) {
    size_t n;
    const char *s = luaL_checklstring(L, 1, &n);
    luaL_Buffer buffer;
    char *p = luaL_buffinitsize(L, &buffer, n);
    for (size_t i = 0; i < n; i++)
        p[i] = s[i] >= low && s[i] <= high ? (char)(s[i] + by) : s[i];
    luaL_pushresultsize(&buffer, n);
    return 1;
}
static int string_upper(lua_State *L) {
    return fold(L, 'a', 'z', 'A' - 'a');
}
static int string_lower(lua_State *L) {
    return fold(L, 'A', 'Z', 'a' - 'A');
}
static const luaL_Reg STRING[] = {{"len", string_len},     {"sub", string_sub},
                                  {"rep", string_rep},     {"upper", string_upper},
                                  {"lower", string_lower}, {NULL, NULL}};

static int table_insert(lua_State *L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    luaL_checkany(L, 2);
    lua_settop(L, 2);
    lua_rawseti(L, 1, (lua_Integer)lua_rawlen(L, 1) + 1);
    return 0;
}
static int table_remove(lua_State *L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_Integer n = (lua_Integer)lua_rawlen(L, 1);
    lua_rawgeti(L, 1, n);
    if (n > 0) {
        lua_pushnil(L);
        lua_rawseti(L, 1, n);
    }
    return 1;
}
static int table_concat(lua_State *L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    const char *separator = luaL_optstring(L, 2, "");
    luaL_Buffer buffer;
    luaL_buffinit(L, &buffer);
    lua_Integer n = (lua_Integer)lua_rawlen(L, 1);
    for (lua_Integer i = 1; i <= n; i++) {
        lua_rawgeti(L, 1, i);
        if (lua_type(L, -1) != LUA_TSTRING && lua_type(L, -1) != LUA_TNUMBER)
            return luaL_error(L, "item %I is neither text nor number", i);
        luaL_addvalue(&buffer);
        if (i < n)
            luaL_addstring(&buffer, separator);
    }
    luaL_pushresult(&buffer);
    return 1;
}
static const luaL_Reg TABLE[] = {
    {"insert", table_insert}, {"remove", table_remove}, {"concat", table_concat}, {NULL, NULL}};

/* ---- pairs in a fixed order: numbers, then strings ---- */

/* Whether the key at `a` comes before the key at `b`. */
static bool key_before(lua_State *L, int a, int b) {
    int type_a = lua_type(L, a), type_b = lua_type(L, b);
    if (type_a != type_b)
        return type_a == LUA_TNUMBER || (type_a == LUA_TSTRING && type_b != LUA_TNUMBER);
    if (type_a == LUA_TNUMBER || type_a == LUA_TSTRING)
        return lua_compare(L, a, b, LUA_OPLT);
    return false;
}

/* The key that follows `key` (index 2) in the order; nil at the end. Quadratic, for small tables.
 */
static int next_key(lua_State *L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_settop(L, 2);
    lua_pushnil(L); /* 3: best so far */
    lua_pushnil(L);
    while (lua_next(L, 1)) {
        lua_pop(L, 1);
        int type = lua_type(L, -1);
        if (type != LUA_TNUMBER && type != LUA_TSTRING)
            return luaL_error(L, "pairs visits tables with number and string keys only");
        bool later = lua_isnil(L, 2) || key_before(L, 2, 4);
        if (later && (lua_isnil(L, 3) || key_before(L, 4, 3))) {
            lua_pushvalue(L, 4);
            lua_replace(L, 3);
        }
        JoxVm *vm = jox_vm_of(L); /* C code counts too */
        if (vm->left < 8)
            return luaL_error(L, "it ran for too long (over its budget of instructions)");
        vm->left -= 4;
    }
    if (lua_isnil(L, 3))
        return 1;
    lua_settop(L, 3);
    lua_pushvalue(L, 3);
    lua_rawget(L, 1);
    return 2;
}

static int sandbox_pairs(lua_State *L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_pushcfunction(L, next_key);
    lua_pushvalue(L, 1);
    lua_pushnil(L);
    return 3;
}
static int next_item(lua_State *L) {
    lua_Integer i = luaL_checkinteger(L, 2) + 1;
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_pushinteger(L, i);
    return lua_rawgeti(L, 1, i) == LUA_TNIL ? 1 : 2;
}
static int sandbox_ipairs(lua_State *L) {
    luaL_checktype(L, 1, LUA_TTABLE);
    lua_pushcfunction(L, next_item);
    lua_pushvalue(L, 1);
    lua_pushinteger(L, 0);
    return 3;
}
static int sandbox_type(lua_State *L) {
    luaL_checkany(L, 1);
    lua_pushstring(L, jox_node_get(L, 1) ? "value" : luaL_typename(L, 1));
    return 1;
}
static int sandbox_tostring(lua_State *L) {
    luaL_checkany(L, 1);
    if (lua_type(L, 1) == LUA_TNUMBER || lua_type(L, 1) == LUA_TSTRING)
        lua_tostring(L, 1);
    else if (lua_type(L, 1) == LUA_TBOOLEAN)
        lua_pushstring(L, lua_toboolean(L, 1) ? "true" : "false");
    else
        lua_pushstring(L, luaL_typename(L, 1)); /* no addresses */
    return 1;
}
static int sandbox_tonumber(lua_State *L) {
    int good;
    lua_Number n = lua_tonumberx(L, 1, &good);
    if (good)
        lua_pushnumber(L, n);
    else
        lua_pushnil(L);
    return 1;
}
static int sandbox_error(lua_State *L) {
    luaL_where(L, 1);
    if (lua_type(L, 1) != LUA_TSTRING)
        return luaL_error(L, "error needs a text");
    lua_pushvalue(L, 1);
    lua_concat(L, 2);
    return lua_error(L);
}
static int sandbox_assert(lua_State *L) {
    if (lua_toboolean(L, 1))
        return lua_gettop(L);
    return luaL_error(L, "%s",
                      lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "assertion failed");
}

/* ---- require ---- */

JoxSource *jox_vm_read(JoxVm *vm, const char *path, const char *given, size_t length,
                       JoxPosition from) {
    const size_t limit = vm->owner->limits.source;
    const char *wrong = NULL;
    struct stat info;
    char *text = NULL;
    if (given) {
        text = jox_strndup(given, length);
    } else if (lstat(path, &info) == 0 && S_ISLNK(info.st_mode)) {
        wrong = "symbolic links are not followed";
    } else if (!(text = jox_read_file(path, limit, &length))) {
        wrong = errno == EFBIG ? "the file is over 256 KB" : strerror(errno);
    }
    if (text && length > limit)
        wrong = "the file is over 256 KB";
    else if (text && length > 0 && text[0] == '\x1b')
        wrong = "this is compiled Lua; only source is loaded";
    else if (text && memchr(text, 0, length))
        wrong = "the file contains a zero byte";
    if (wrong) {
        jox_free(text);
        jox_diag_error(vm->diagnostics, from.file ? from : ((JoxPosition){path, 0, 0, 0}),
                       "unreadable-file", NULL, "cannot load '%s': %s", path, wrong);
        return NULL;
    }
    if (length >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        memcpy(text, "   ", 3); /* a byte order mark */
    JOX_RESERVE(vm->files, vm->file_capacity, vm->file_count + 1);
    JoxLuaFile *file = &vm->files[vm->file_count++];
    file->path = jox_strdup(path);
    jox_sha256_hex(given ? given : text, length, file->sha256);
    JOX_RESERVE(vm->sources, vm->source_capacity, vm->source_count + 1);
    JoxSource *source = &vm->sources[vm->source_count++];
    *source = (JoxSource){.path = jox_strdup(path), .text = text, .length = length};
    jox_source_scan(source);
    return source;
}

/* Only plain names below the behaviour's folder or the library's: no "..", no absolute paths. */
static bool plain_name(const char *name) {
    if (!*name || *name == '/' || *name == '.' || strlen(name) > 100 || strstr(name, ".."))
        return false;
    for (const char *c = name; *c; c++)
        if (!((*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9') ||
              *c == '_' || *c == '-' || *c == '/' || *c == '.'))
            return false;
    return true;
}

/* Whether a file, with every link on its way followed, still lies below the folder. */
static bool lies_below(const char *path, const char *folder) {
    char *real = realpath(path, NULL), *root = realpath(folder, NULL);
    size_t n = root ? strlen(root) : 0;
    bool below = real && root && strncmp(real, root, n) == 0 && real[n] == '/';
    free(real); /* made by the C library */
    free(root);
    return below;
}

static bool find_module(const JoxVm *vm, const char *name, char path[1024]) {
    const char *own = vm->sources[0].path, *slash = strrchr(own, '/');
    char folders[3][512];
    struct stat info;
    snprintf(folders[0], sizeof folders[0], "%.*s", slash ? (int)(slash - own) : 1,
             slash ? own : ".");
    snprintf(folders[1], sizeof folders[1], "%.490s/../scripts", folders[0]);
    snprintf(folders[2], sizeof folders[2], "%s/scripts", JOX_DATADIR);
    for (int i = 0; i < 3; i++) {
        snprintf(path, 1024, "%.511s/%.400s.lua", folders[i], name);
        if (lstat(path, &info) == 0)
            return S_ISLNK(info.st_mode) ||
                   lies_below(path, folders[i]); /* links are refused later */
    }
    return false;
}

static int sandbox_require(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    const char *name = luaL_checkstring(L, 1);
    char path[1024], chunk[16];
    if (!vm->loading)
        return luaL_error(L, "require works at the top of a file, not in functions");
    if (!plain_name(name))
        return jox_word_error(L, name, "bad-require", "Names are relative to this file's folder",
                              "cannot require '%s': not a plain name", name);
    if (!find_module(vm, name, path) || vm->source_count >= MOST_FILES)
        return jox_word_error(
            L, name, "missing-file", NULL,
            "cannot require '%s': there is no such file beside this one or in the "
            "library",
            name);
    lua_getfield(L, LUA_REGISTRYINDEX, "jostle loaded");
    if (lua_getfield(L, -1, path) != LUA_TNIL)
        return 1;
    JoxPosition from = jox_word_position(L, name);
    size_t number = vm->source_count;
    JoxSource *source = jox_vm_read(vm, path, NULL, 0, from);
    if (!source)
        return jox_node_push(L, JOX_NODE_POISON), 1;
    lua_pushboolean(L, 1); /* a circle of requires sees this */
    lua_setfield(L, 2, path);
    snprintf(chunk, sizeof chunk, "=b%zu", number);
    if (luaL_loadbufferx(L, source->text, source->length, chunk, "t") != LUA_OK)
        return lua_error(L);
    lua_call(L, 0, 1);
    lua_pushvalue(L, -1);
    lua_setfield(L, 2, path);
    return 1;
}

/* ---- the environment ---- */

static int env_index(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(1)) != LUA_TNIL)
        return 1;
    if (jox_word_lookup(L, name)) {
        if (vm->loading)
            jox_word_position(L, name); /* marks this occurrence as read */
        return 1;
    }
    if (!vm->loading)
        return luaL_error(L, "unknown name '%s'", name);
    const char *names[128];
    size_t count = jox_word_names(names, 128);
    char hint[128];
    const char *near = jox_suggest(name, names, count);
    if (jox_parameter_find(name) >= 0)
        snprintf(hint, sizeof hint,
                 "As a value write own.%s (what was drawn) or now.NAME (what is "
                 "measured)",
                 name);
    else if (near)
        snprintf(hint, sizeof hint, "Did you mean '%s'?", near);
    else
        snprintf(hint, sizeof hint, "Words and locals are all that a behaviour can use");
    return jox_word_error(L, name, "unknown-word", hint, "unknown word '%s'", name);
}

static int env_newindex(lua_State *L) {
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
    if (!jox_vm_of(L)->loading)
        return luaL_error(L,
                          "globals cannot be set; what an agent remembers belongs in memory: "
                          "'%s'",
                          name);
    jox_word_error(L, name, "global-assignment", "Write: local NAME = ...",
                   "'%s' would be a global", name);
    return 0;
}

static void set_library(lua_State *L, const char *name, const luaL_Reg *functions) {
    lua_newtable(L); /* a proxy, so that scripts cannot change the library */
    lua_newtable(L);
    lua_newtable(L);
    luaL_setfuncs(L, functions, 0);
    if (functions == MATH) {
        lua_pushnumber(L, 3.14159265358979323846);
        lua_setfield(L, -2, "pi");
        lua_pushnumber(L, INFINITY);
        lua_setfield(L, -2, "huge");
    }
    if (functions == STRING) { /* ("x"):upper() */
        lua_pushliteral(L, "");
        lua_newtable(L);
        lua_pushvalue(L, -3);
        lua_setfield(L, -2, "__index");
        lua_pushboolean(L, 0);
        lua_setfield(L, -2, "__metatable");
        lua_setmetatable(L, -2);
        lua_pop(L, 1);
    }
    lua_setfield(L, -2, "__index");
    lua_pushcfunction(L, env_newindex);
    lua_setfield(L, -2, "__newindex");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
    lua_setfield(L, -2, name);
}

void jox_sandbox_open(JoxVm *vm) {
    static const luaL_Reg BASE[] = {{"pairs", sandbox_pairs},
                                    {"ipairs", sandbox_ipairs},
                                    {"next", next_key},
                                    {"type", sandbox_type},
                                    {"tostring", sandbox_tostring},
                                    {"error", sandbox_error},
                                    {"tonumber", sandbox_tonumber},
                                    {"assert", sandbox_assert},
                                    {"require", sandbox_require},
                                    {NULL, NULL}};
    lua_State *L = vm->L;
    lua_newtable(L);
    lua_setfield(L, LUA_REGISTRYINDEX, "jostle loaded");
    lua_newtable(L); /* the environment, empty: every access goes through env_index */
    lua_newtable(L);
    lua_newtable(L); /* what is known besides the words */
    luaL_setfuncs(L, BASE, 0);
    set_library(L, "math", MATH);
    set_library(L, "string", STRING);
    set_library(L, "table", TABLE);
    lua_pushcclosure(L, env_index, 1);
    lua_setfield(L, -2, "__index");
    lua_pushcfunction(L, env_newindex);
    lua_setfield(L, -2, "__newindex");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
    lua_rawseti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
}
