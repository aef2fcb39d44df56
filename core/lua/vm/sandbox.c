/* What a behaviour can reach: its environment, a whitelist, and `require`. Nothing of Lua's own
   libraries is opened: no files, clocks, addresses, coroutines, metatables, code from strings. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/hash.h"
#include "base/mem.h"
#include "base/overlay.h"
#include "lua/internal.h"

enum { MOST_FILES = 64 };

/* ---- require ---- */

/* What names mean in a file is not to be changed, neither for the reader nor for the checks. */
static bool refuse_env(JoxVm *vm, const JoxSource *source) {
    for (size_t i = 0; i < source->token_count; i++) {
        const JoxToken *t = &source->tokens[i];
        if (t->kind != JOX_TOKEN_NAME || !jox_token_is(t, "_ENV"))
            continue;
        jox_diag_error(vm->diagnostics,
                       ((JoxPosition){source->path, t->line, t->column, t->end_column}),
                       "unknown-word", "Words and locals are all that a behaviour can use",
                       "'_ENV' cannot be used");
        return true;
    }
    return false;
}

JoxSource *jox_vm_read(JoxVm *vm, const char *path, const char *given, size_t length,
                       JoxPosition from) {
    const size_t limit = vm->owner->limits.source;
    char large[64];
    const char *wrong = NULL;
    snprintf(large, sizeof large, "the file is over %zu KB", limit >> 10);
    struct stat info;
    char *text = NULL;
    bool disk = !given && !jox_overlay_file(path);
    if (given) {
        text = jox_strndup(given, length);
    } else if (disk && lstat(path, &info) == 0 && S_ISLNK(info.st_mode)) {
        wrong = "symbolic links are not followed";
    } else if (disk && stat(path, &info) == 0 && !S_ISREG(info.st_mode)) {
        wrong = "it is no regular file"; /* opening a pipe would wait */
    } else if (!(text = jox_read_file(path, limit, &length))) {
        wrong = errno == EFBIG ? large : strerror(errno);
    }
    if (text && length > limit)
        wrong = large;
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
    return refuse_env(vm, source) ? NULL : source;
}

/* Only plain names below the behaviour's folder or the library's: no "..", no absolute paths. */
static bool plain_name(const char *name) {
    if (!*name || *name == '/' || *name == '.' || strlen(name) > 100 || strstr(name, ".."))
        return false;
    for (const char *c = name; *c; c++)
        if (!((*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9') ||
              *c == '_' || *c == '-' || *c == '/' || *c == '.' || *c == ':'))
            return false;
    return true;
}

void jox_vm_tried(JoxVm *vm, const char *path) {
    for (uint32_t i = 0; i < vm->tried_count; i++)
        if (strcmp(vm->tried[i], path) == 0)
            return;
    JOX_RESERVE(vm->tried, vm->tried_capacity, vm->tried_count + 1);
    vm->tried[vm->tried_count++] = jox_strdup(path);
}

/* Whether a module's file is there, in a folder that it may be in. Links are refused later. */
static bool is_module(JoxVm *vm, const char *folder, const char *name, char path[1024]) {
    struct stat info;
    snprintf(path, 1024, "%.511s/%.400s.lua", folder, name);
    jox_vm_tried(vm, path);
    return jox_overlay_file(path) ||
           (lstat(path, &info) == 0 && (S_ISLNK(info.st_mode) || jox_path_below(path, folder)));
}

/* The file of a module: "mod:name" of a mod; else beside the file that requires it, beside the
   behaviour, or of the library. */
static bool find_module(lua_State *L, const char *name, char path[1024]) {
    JoxVm *vm = jox_vm_of(L);
    JoxPosition from = jox_vm_place(L);
    const char *colon = strchr(name, ':');
    const char *asking = from.file ? from.file : vm->sources[0].path, *own = vm->sources[0].path;
    char folder[512];
    for (uint32_t m = 0; colon && m < vm->scope->mod_count; m++) {
        const JoxMod *mod = &vm->scope->mods[m];
        snprintf(folder, sizeof folder, "%.480s/behaviours", mod->folder);
        if (!strncmp(mod->name, name, (size_t)(colon - name)) && !mod->name[colon - name])
            return is_module(vm, folder, colon + 1, path);
    }
    if (colon)
        return false;
    const char *const files[] = {asking, own};
    for (int i = 0; i < 2; i++) {
        const char *slash = strrchr(files[i], '/');
        snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - files[i]) : 1,
                 slash ? files[i] : ".");
        if (is_module(vm, folder, name, path))
            return true;
    }
    const char *slash = strrchr(own, '/');
    snprintf(folder, sizeof folder, "%.*s/../scripts", slash ? (int)(slash - own) : 1,
             slash ? own : ".");
    if (is_module(vm, folder, name, path))
        return true;
    snprintf(folder, sizeof folder, "%s/scripts", JOX_DATADIR);
    return is_module(vm, folder, name, path);
}

static int sandbox_require(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    const char *name = luaL_checkstring(L, 1);
    char path[1024];
    jox_vm_charge(L, 500); /* the system is asked for files */
    if (!vm->loading)
        return luaL_error(L, "require works at the top of a file, not in functions");
    if (!plain_name(name))
        return jox_word_error(L, name, "bad-require", "Names are relative to this file's folder",
                              "cannot require '%s': not a plain name", name);
    if (!find_module(L, name, path) || vm->source_count >= MOST_FILES)
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
    jox_vm_charge(L, source->length / 4);
    lua_pushboolean(L, 1); /* a circle of requires sees this */
    lua_setfield(L, 2, path);
    if (!jox_source_compile(vm, number))
        return lua_error(L);
    lua_call(L, 0, 1);
    lua_pushvalue(L, -1);
    lua_setfield(L, 2, path);
    return 1;
}

/* ---- the environment ---- */

/* Why a name of Lua's own libraries is missing; NULL for any other. */
static const char *absent(const char *name) {
    static const struct {
        const char *name, *why;
    } ABSENT[] = {
        {"io", "Behaviours have no files"},
        {"os", "Behaviours have no clock and no files; me.time is the simulated time"},
        {"debug", "Behaviours cannot look into the engine"},
        {"package", "require \"name\" loads a file beside this one"},
        {"coroutine", "A state of the machine is what a coroutine would remember"},
        {"load", "Code is not made from texts; require \"name\" loads a file beside this one"},
        {"loadstring", "Code is not made from texts"},
        {"loadfile", "require \"name\" loads a file beside this one"},
        {"dofile", "require \"name\" loads a file beside this one"},
        {"setmetatable", "Tables have no metatables here"},
        {"getmetatable", "Tables have no metatables here"},
        {"rawget", "Tables have no metatables here: t[key] is raw"},
        {"rawset", "Tables have no metatables here: t[key] = value is raw"},
        {"rawequal", "Tables have no metatables here: == is raw"},
        {"rawlen", "Tables have no metatables here: # is raw"},
        {"collectgarbage", "Memory is looked after by the engine"},
        {"xpcall", "pcall catches errors"},
        {"_G", "There are no globals; what an agent remembers belongs in memory"},
        {"utf8", "string.byte and string.char work on bytes"},
    };
    for (size_t i = 0; i < sizeof ABSENT / sizeof *ABSENT; i++)
        if (strcmp(ABSENT[i].name, name) == 0)
            return ABSENT[i].why;
    return NULL;
}

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
    else if (absent(name))
        snprintf(hint, sizeof hint, "%s", absent(name));
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
    if (functions == jox_library_math) {
        lua_pushnumber(L, 3.14159265358979323846);
        lua_setfield(L, -2, "pi");
        lua_pushnumber(L, (lua_Number)HUGE_VAL);
        lua_setfield(L, -2, "huge");
        lua_pushinteger(L, LUA_MAXINTEGER);
        lua_setfield(L, -2, "maxinteger");
        lua_pushinteger(L, LUA_MININTEGER);
        lua_setfield(L, -2, "mininteger");
    }
    if (functions == jox_library_string) { /* ("x"):upper() */
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
    lua_State *L = vm->L;
    lua_newtable(L);
    lua_setfield(L, LUA_REGISTRYINDEX, "jostle loaded");
    lua_newtable(L); /* the environment, empty: every access goes through env_index */
    lua_newtable(L);
    lua_newtable(L); /* what is known besides the words */
    luaL_setfuncs(L, jox_library_base, 0);
    lua_pushcfunction(L, sandbox_require);
    lua_setfield(L, -2, "require");
    set_library(L, "math", jox_library_math);
    set_library(L, "string", jox_library_string);
    set_library(L, "table", jox_library_table);
    lua_pushcclosure(L, env_index, 1);
    lua_setfield(L, -2, "__index");
    lua_pushcfunction(L, env_newindex);
    lua_setfield(L, -2, "__newindex");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
    lua_rawseti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
}
