/* Loads behaviours: a Lua file becomes a JoxMachine, and its plain functions become hooks. */
#ifndef JOX_LUA_LOADER_H
#define JOX_LUA_LOADER_H

#include "base/diag.h"
#include "geom/place.h"
#include "machine/mind.h"

typedef struct JoxLua JoxLua;

/* Every script works within these; over them it is stopped and named. */
typedef struct JoxLuaLimits {
    uint64_t load_instructions; /* of one load; default 20 million */
    uint64_t hook_instructions; /* of one call of a hook; default 100,000 */
    size_t memory;              /* bytes of one Lua state; default 32 MB */
    size_t block;               /* bytes of one allocation; default 2 MB */
    size_t source;              /* bytes of one file; default 256 KB */
} JoxLuaLimits;
JoxLuaLimits jox_lua_default_limits(void);

/* Names that a behaviour may use. Not complete: any name is accepted (checking a behaviour without
   a scene); places then stay unresolved, with index -1. */
typedef struct JoxScope {
    const JoxPlace *places;
    uint32_t place_count;
    const char *const *tags; /* the index is the bit */
    uint32_t tag_count;
    bool complete;
} JoxScope;

JoxLua *jox_lua_create(const JoxLuaLimits *limits);
void jox_lua_free(JoxLua *lua);

/* NULL if anything is wrong; every error (up to 20) is then in `diagnostics`, and nothing changed.
   The machine is the caller's; its hooks live until jox_lua_release or the end of `lua`. */
JoxMachine *jox_lua_load(JoxLua *lua, const char *path, const JoxScope *scope,
                         JoxDiagnostics *diagnostics);
/* The same from memory; `path` names it and is where `require` starts. */
JoxMachine *jox_lua_load_text(JoxLua *lua, const char *path, const char *text, size_t length,
                              const JoxScope *scope, JoxDiagnostics *diagnostics);
/* Closes the Lua state behind a machine that is no longer used. */
void jox_lua_release(JoxLua *lua, const JoxMachine *machine);

/* Files that a machine was made of, its own first. */
typedef struct JoxLuaFile {
    char *path;
    char sha256[65];
} JoxLuaFile;
const JoxLuaFile *jox_lua_files(const JoxLua *lua, const JoxMachine *machine, uint32_t *count);

/* Ready for JoxMind.call, with the JoxLua as context. `jox_lua_attach` says whose columns hooks
   read and write, and where their errors go: each place and message in full once, then counted. */
typedef void JoxLuaComplain(void *context, const char *text);
void jox_lua_attach(JoxLua *lua, JoxMind *mind, JoxLuaComplain *complain, void *context);
bool jox_lua_call(void *lua, const JoxMachine *machine, int32_t hook, JoxHookKind kind,
                  uint32_t agent, double result[2]);
/* Calls of hooks that failed so far. */
uint64_t jox_lua_failures(const JoxLua *lua);

#endif
