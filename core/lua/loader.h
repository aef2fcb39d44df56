/* Loads behaviours: a Lua file becomes a JoxMachine, and its plain functions become hooks that run
   in the Lua state kept behind the machine. In a run: jox_lua_create, jox_lua_load for each
   behaviour, jox_lua_attach, then the machines call jox_lua_call; jox_lua_free at the end. Machines
   belong to the caller, Lua states to the JoxLua. */
#ifndef JOX_LUA_LOADER_H
#define JOX_LUA_LOADER_H

#include "base/format/diag.h"
#include "base/text.h"
#include "lua/language/scope.h"
#include "lua/vm/script_limits.h"
#include "machine/run.h"

/* JOX_MOST_FAILURES: failures of a function in a second of simulated time at which it is suspended.
   JOX_FAILING_SHARE: jox_lua_is_failing holds if at least one call in so many fails. */
enum { JOX_MOST_FAILURES = 100, JOX_FAILING_SHARE = 10 };

/* Loads a behaviour with the scope's mods applied. NULL on errors, up to 20 of which are in
   `diagnostics`; then nothing has changed. The caller owns the machine; its functions can be called
   until jox_lua_release, or until `lua` is freed. */
JoxMachine *jox_lua_load(JoxLua *lua, const char *path, const JoxScope *scope,
                         JoxDiagnostics *diagnostics);
/* Visits every place that sets a value of the machine, from the earliest to the last:
   "Circle.push", "defaults.speed", "Circle.Exit.chance". False if none does. */
bool jox_lua_why(const JoxLua *lua, const JoxMachine *machine, const char *path,
                 const JoxScope *scope, JoSetVisit *visit, void *context);
/* The place that sets a value of the machine last. Paths: "defaults.speed", "states.Circle.push",
   "states.Circle.@Exit.when" (a transition by its id). */
typedef struct JoxWritten {
    JoxText text;     /* value as written, on one line; free with jox_text_free */
    const char *file; /* one of the machine's files, valid as long as the machine */
    int line, column;
    const char *mod; /* name of the mod, or NULL for the behaviour itself */
} JoxWritten;
/* Gives the place that sets a path last; false if none does. */
bool jox_lua_written(const JoxLua *lua, const JoxMachine *machine, const char *path,
                     const JoxScope *scope, JoxWritten *out);
/* As jox_lua_written, and follows functions that build a part of the machine's table. */
bool jox_lua_written_or_built(const JoxLua *lua, const JoxMachine *machine, const char *path,
                              const JoxScope *scope, JoxWritten *out);
/* Visits the local variables of the behaviour's own file with their values as written, in order of
   their declaration; not those of its functions, nor what holds a table, a function or memory. */
typedef void JoxLocalVisit(void *context, const char *name, const char *value);
void jox_lua_locals(const JoxLua *lua, const JoxMachine *machine, JoxLocalVisit *visit,
                    void *context);
/* Finds where memory is declared, as `memory { hits = 0 }`; the value as written is in out->text.
 */
bool jox_lua_memory(const JoxLua *lua, const JoxMachine *machine, const char *name,
                    JoxWritten *out);
/* An export of a library file: a field of the table that it returns. */
typedef struct JoxLuaExport {
    char *name;
    char *doc;     /* comment before it, on one line, or NULL */
    char kind[24]; /* "function", "a condition", "a steering", "number" */
    int line;      /* 0: unknown */
} JoxLuaExport;
/* Runs a file in a Lua state of its own and lists its exports by line; NULL with diagnostics. The
   comment at the head of the file, or NULL, goes to *about. Free the list with
   jox_lua_exports_free, and *about with jox_free. */
JoxLuaExport *jox_lua_exports(JoxLua *lua, const char *path, const JoxScope *scope, uint32_t *count,
                              char **about, JoxDiagnostics *diagnostics);
void jox_lua_exports_free(JoxLuaExport *exports, uint32_t count);
/* Finds, in the text of a mod's file, the name of the behaviour that it changes, and whether it
   replaces it. False if it names none. */
bool jox_lua_patch_target(const char *text, size_t length, char target[128], bool *replaces,
                          int *line, int *column);
/* Loads a behaviour as jox_lua_load does, from memory (NULL: from the disk); `path` names it, and
   `require` looks beside it. */
JoxMachine *jox_lua_load_text(JoxLua *lua, const char *path, const char *text, size_t length,
                              const JoxScope *scope, JoxDiagnostics *diagnostics);
/* Frees the Lua state behind a machine; the machine's functions must not be called any more. */
void jox_lua_release(JoxLua *lua, const JoxMachine *machine);

/* Loads in two halves, so that a reload can happen beside the run. jox_lua_prepare (text NULL: from
   the disk) may run on any thread while the scope's names stay; the machine is NULL if it failed.
   jox_lua_adopt must run on the stepping thread. Files that were looked for are listed in both
   cases. */
typedef struct JoxLoaded JoxLoaded;
JoxLoaded *jox_lua_prepare(JoxLua *lua, const char *path, const char *text, size_t length,
                           const JoxScope *scope, JoxDiagnostics *diagnostics);
/* Returns the machine, or NULL if it failed. */
JoxMachine *jox_loaded_machine(const JoxLoaded *loaded);
/* Returns the paths that were looked for. */
char *const *jox_loaded_paths_tried(const JoxLoaded *loaded, uint32_t *count);
/* Returns what was printed while loading, or "". */
const char *jox_loaded_output(const JoxLoaded *loaded);
/* Returns the files as jox_lua_files does, before the machine is adopted. */
const JoxLuaFile *jox_loaded_files(const JoxLoaded *loaded, uint32_t *count);
/* Moves the Lua state into `lua`, so that the machine's functions can be called. The caller owns
   the machine from then on, and frees `loaded`. */
void jox_lua_adopt(JoxLua *lua, JoxLoaded *loaded);
/* Moves machine and Lua state out of `lua`, to be freed on any thread by jox_loaded_free. */
JoxLoaded *jox_lua_retire(JoxLua *lua, JoxMachine *machine);
/* Frees the machine and Lua state, if they are still there, and `loaded`. */
void jox_loaded_free(JoxLoaded *loaded);

/* Returns the files that a machine was made of, its own first. */
const JoxLuaFile *jox_lua_files(const JoxLua *lua, const JoxMachine *machine, uint32_t *count);

/* Returns the text of a file as it was read; a byte order mark is replaced by blanks. */
const char *jox_lua_text(const JoxLua *lua, const JoxMachine *machine, uint32_t file,
                         size_t *length);
const char *jox_loaded_text(const JoxLoaded *loaded, uint32_t file, size_t *length);

/* Returns whether a function of the machine may give the signal, as far as the text of its files
   tells. */
bool jox_lua_may_signal(const JoxLua *lua, const JoxMachine *machine, const char *name);

/* Returns the paths that were looked for when a machine was loaded, found or not. */
char *const *jox_lua_paths_tried(const JoxLua *lua, const JoxMachine *machine, uint32_t *count);

/* Sets whose columns functions read and write, and where their failures are reported: each place
   and message in full once, then counted. */
void jox_lua_attach(JoxLua *lua, JoxMachineRun *machines, JoxLuaComplain *complain, void *context);
/* Calls function `hook` of a machine for an agent, as JoxMachineRun.call with the JoxLua as
   context; writes what `when` or `steer` returned to `result`. False if it failed. */
bool jox_lua_call(void *lua, const JoxMachine *machine, int32_t hook, JoxHookKind kind,
                  uint32_t agent, double result[2]);
/* Called before and after the functions of a step, as JoxMachineRun.bracket: keeps the columns
   before the step, and applies writes into neighbours' memory after it. */
void jox_lua_bracket_hooks(void *lua, bool begins);
/* Lists the state of a machine's functions, as JoxMachineRun.hook_sections: suspended or not,
   failures in the present second; and, not hashed, all calls and failures. */
void jox_lua_sections(void *lua, const JoxMachine *machine, JoxSections *sections);
/* Returns whether the time of a function's call number `call`, from 0, is measured. */
bool jox_lua_is_timed(uint64_t call);
/* Cost of all functions of a run. The time is estimated; if it exceeds that of the steps it is cut
   to that, and `cut` is the factor by which each function's time must be multiplied, else 1. */
typedef struct JoxLuaTotal {
    uint64_t calls;
    double seconds, stepping, cut; /* s; s, of the steps and of calls as agents arrive; factor */
} JoxLuaTotal;
/* Returns the cost of all functions; `stepped` is the time of all steps, s. */
JoxLuaTotal jox_lua_total(const JoxLua *lua, double stepped);
/* Gives the cost of the machine's n-th function; the strings belong to the machine. False past the
   last function. */
bool jox_lua_cost(const JoxLua *lua, const JoxMachine *machine, uint32_t n, JoLuaCost *cost);
/* Returns the message of the last failure of the machine's n-th function that was reported in full;
   NULL: it has not failed. */
const char *jox_lua_last_failure(const JoxLua *lua, const JoxMachine *machine, uint32_t n);
/* Returns whether so large a share of its calls failed that the run did not go as the behaviour
   says. */
static inline bool jox_lua_is_failing(const JoLuaCost *cost) {
    return cost->failures > 0 && cost->failures * JOX_FAILING_SHARE >= cost->calls;
}
/* Returns the path of a behaviour whose functions take so much longer than their instructions
   explain that the run should end, or NULL. Counting instructions does not find it, and a clock
   must not decide anything within a run. */
const char *jox_lua_stalled(const JoxLua *lua);

#endif
