/* Loads behaviours: a Lua file becomes a JoxMachine, and its plain functions become hooks. */
#ifndef JOX_LUA_LOADER_H
#define JOX_LUA_LOADER_H

#include "base/format/diag.h"
#include "base/text.h"
#include "lua/language/scope.h"
#include "lua/vm/limits.h"
#include "machine/run.h"

/* Failures of a function in a simulated second, with which it is suspended; and the share of its
   calls, one in so many, from which on failures are a trouble of the run (jox_lua_is_failing). */
enum { JOX_MOST_FAILURES = 100, JOX_FAILING_SHARE = 10 };

/* NULL if anything is wrong; every error (up to 20) is then in `diagnostics`, and nothing changed.
   The machine is the caller's; its hooks live until jox_lua_release or the end of `lua`. */
JoxMachine *jox_lua_load(JoxLua *lua, const char *path, const JoxScope *scope,
                         JoxDiagnostics *diagnostics);
/* Who set a path of the machine ("Circle.push", "defaults.speed", "Circle.Exit.chance"), the first
   first; false if nobody did. */
bool jox_lua_why(const JoxLua *lua, const JoxMachine *machine, const char *path,
                 const JoxScope *scope, JoSetVisit *visit, void *context);
/* What set a canonical path of the machine last: "defaults.speed", "states.Circle.push",
   "states.Circle.@Exit.when" (a transition by its id). */
typedef struct JoxWritten {
    JoxText text;     /* the value as written, on one line; the caller frees */
    const char *file; /* of the machine's files, valid as long as it */
    int line, column;
    const char *mod; /* name, or NULL: the behaviour itself */
} JoxWritten;
bool jox_lua_written(const JoxLua *lua, const JoxMachine *machine, const char *path,
                     const JoxScope *scope, JoxWritten *out);
/* Where the machine's memory of a name is declared: `memory { hits = 0 }`; its text, too. */
bool jox_lua_memory(const JoxLua *lua, const JoxMachine *machine, const char *name,
                    JoxWritten *out);
/* What a file returns to who requires it: a name of its table (of a function with its parameters),
   or
   "" for a value that is no table. */
typedef struct JoxLuaExport {
    char *name;
    char *doc;     /* the comment before it, on one line, or NULL */
    char kind[24]; /* "function", "a condition", "a steering", "number" */
    int line;      /* 0 unknown */
} JoxLuaExport;
/* In the order of their lines; *about: the comment that the file begins with, or NULL. The file
   runs in a state of its own; what is wrong with it goes to `diagnostics`. Free the list, and
   *about. */
JoxLuaExport *jox_lua_exports(JoxLua *lua, const char *path, const JoxScope *scope, uint32_t *count,
                              char **about, JoxDiagnostics *diagnostics);
void jox_lua_exports_free(JoxLuaExport *exports, uint32_t count);
/* Name of the behaviour that a mod's Lua file changes, and whether it replaces it: copied into
   target; false where it names none. */
bool jox_lua_patch_target(const char *text, size_t length, char target[128], bool *replaces,
                          int *line, int *column);
/* The same from memory; `path` names it and is where `require` starts. */
JoxMachine *jox_lua_load_text(JoxLua *lua, const char *path, const char *text, size_t length,
                              const JoxScope *scope, JoxDiagnostics *diagnostics);
/* Closes the Lua state behind a machine that is no longer used. */
void jox_lua_release(JoxLua *lua, const JoxMachine *machine);

/* Loading in two halves, for a thread that reloads: jox_lua_prepare (text NULL: read the file) may
   run beside the stepping thread, as long as the scope's names stay; jox_lua_adopt belongs to the
   stepping thread. The machine is NULL where it failed; files that were looked for are known in any
   case. */
typedef struct JoxLoaded JoxLoaded;
JoxLoaded *jox_lua_prepare(JoxLua *lua, const char *path, const char *text, size_t length,
                           const JoxScope *scope, JoxDiagnostics *diagnostics);
JoxMachine *jox_loaded_machine(const JoxLoaded *loaded);
char *const *jox_loaded_tried(const JoxLoaded *loaded, uint32_t *count);
/* What was printed while loading; "" for nothing. */
const char *jox_loaded_said(const JoxLoaded *loaded);
/* As jox_lua_files, before it is adopted. */
const JoxLuaFile *jox_loaded_files(const JoxLoaded *loaded, uint32_t *count);
/* The machine's functions can be called from here on; the machine is the caller's. */
void jox_lua_adopt(JoxLua *lua, JoxLoaded *loaded);
/* The reverse: machine and Lua state, in one piece, to be freed on any thread. */
JoxLoaded *jox_lua_retire(JoxLua *lua, JoxMachine *machine);
void jox_loaded_free(JoxLoaded *loaded);

/* Files that a machine was made of, its own first. */
const JoxLuaFile *jox_lua_files(const JoxLua *lua, const JoxMachine *machine, uint32_t *count);

/* The text of one of them as it was read (a byte order mark made blank). */
const char *jox_lua_text(const JoxLua *lua, const JoxMachine *machine, uint32_t file,
                         size_t *length);
const char *jox_loaded_text(const JoxLoaded *loaded, uint32_t file, size_t *length);

/* Whether a function of the machine may give the signal, as far as its files tell. */
bool jox_lua_may_signal(const JoxLua *lua, const JoxMachine *machine, const char *name);

/* All files that were looked for when a machine was loaded. */
char *const *jox_lua_tried(const JoxLua *lua, const JoxMachine *machine, uint32_t *count);

/* Ready for JoxMachineRun.call, with the JoxLua as context. `jox_lua_attach` says whose columns
   hooks read and write, and where their errors go: each place and message in full once, then
   counted. */
void jox_lua_attach(JoxLua *lua, JoxMachineRun *machines, JoxLuaComplain *complain, void *context);
bool jox_lua_call(void *lua, const JoxMachine *machine, int32_t hook, JoxHookKind kind,
                  uint32_t agent, double result[2]);
/* Ready for JoxMachineRun.bracket. */
void jox_lua_bracket(void *lua, bool begins);
/* Ready for JoxMachineRun.hook_sections: which functions of a machine are suspended, how often they
   have failed in the present second and, outside of the hash, were called and failed in all. */
void jox_lua_sections(void *lua, const JoxMachine *machine, JoxSections *sections);
/* Whether a function's call of that number, from 0, is timed. */
bool jox_lua_is_timed(uint64_t call);
/* Processor time that a machine's functions took, s, estimated from the first 16 calls of each and
   one in 16 of the others, and how many there were. */
double jox_lua_seconds(const JoxLua *lua, const JoxMachine *machine, uint64_t *calls);
/* Cost of all plain functions. Their time is estimated; where it would pass that of the steps, that
   of each is multiplied by `cut`, which is 1 else. */
typedef struct JoxLuaTotal {
    uint64_t calls;
    double seconds, stepping, cut; /* s; s, of the steps with the calls as people come in; share */
} JoxLuaTotal;
/* stepped: s, that the steps took. */
JoxLuaTotal jox_lua_total(const JoxLua *lua, double stepped);
/* What its n-th function cost, with texts of the machine; false behind the last. */
bool jox_lua_cost(const JoxLua *lua, const JoxMachine *machine, uint32_t n, JoLuaCost *cost);
/* Whether so many of its calls failed that the run did not go as its behaviour says. */
static inline bool jox_lua_is_failing(const JoLuaCost *cost) {
    return cost->failures > 0 && cost->failures * JOX_FAILING_SHARE >= cost->calls;
}
/* Path of the behaviour whose functions take so much longer than their instructions explain that
   the run should end, or NULL. No count finds them, and a clock must not decide within a run. */
const char *jox_lua_stalled(const JoxLua *lua);

#endif
