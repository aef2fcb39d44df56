/* A Lua state within limits: its memory, its budgets of instructions, its files, and jox_vm_call,
   the one protected call through which all Lua code runs. Knows nothing of behaviours; lua/language
   builds on it. The usual order: jox_vm_open, jox_vm_read, jox_vm_compile and jox_vm_call with
   `loading` set, then jox_vm_call for each function, at last jox_vm_close. A JoxVm is used by one
   thread at a time. */
#ifndef JOX_LUA_VM_VM_H
#define JOX_LUA_VM_VM_H

#include <lauxlib.h>
#include <lua.h>

#include "base/text.h"
#include "lua/vm/script_limits.h"
#include "lua/vm/source.h"

/* Shared by all Lua states of a run; outlives them. */
typedef struct JoxVmGroup {
    JoxLuaLimits limits;
    char stalled[256];   /* path of the script that takes so long that the run must end; "": none */
    JoxLuaComplain *say; /* prints a line of a script or on its failure; NULL: drops it */
    void *say_context;
} JoxVmGroup;

typedef struct JoxVm {
    JoxVmGroup *group;
    lua_State *L;
    size_t used;    /* bytes that the state has allocated */
    uint64_t left;  /* instructions left in the budget of the present call */
    bool over;      /* the budget is spent: every further instruction of the call fails */
    bool starved;   /* over the limit of memory: every further instruction of the call fails */
    bool no_memory; /* the system had no memory at the last request */
    bool running;   /* within jox_vm_call */
    bool loading; /* while a file is loaded: processor time is limited too, not only instructions */
    lua_Hook watch;    /* called at each call and return while loading; NULL: not called */
    bool untimed;      /* calls neither share the budget of a step nor are timed */
    double deadline;   /* end of a load, s of processor time of this thread; 0: not set */
    uint32_t interval; /* instructions between two runs of the debug hook */
    uint32_t charges;  /* calls of jox_vm_charge while loading */
    uint64_t calls;    /* calls of jox_vm_call while not loading */
    uint32_t run;    /* number of the present call, to refuse objects kept from earlier; set by the
                        caller */
    uint32_t step;   /* step of the simulation in which the next call is. Set by the caller */
    uint32_t second; /* simulated second of the next call, plus 1; 0: outside a simulation */
    uint64_t step_left; /* instructions that calls may still use in step `budget_step` */
    uint32_t budget_step;
    double watch_from; /* time, s, at which `watch_left` was read */
    uint64_t watch_left;
    uint32_t suspected; /* number of calls yet to be watched by processor time, not by the wall's */
    double beyond;      /* time, s, that calls took beyond what their instructions explain */
    char **names;       /* interned, kept until the VM is closed */
    size_t name_count, name_capacity;
    JoxSource **sources; /* the script, then files it required; number 3 is chunk "=b3" */
    size_t source_count, source_capacity;
    JoxLuaFile *files; /* path and checksum of each source, in the same order */
    uint32_t file_count;
    size_t file_capacity;
    char **tried; /* paths of files that were looked for, found or not */
    uint32_t tried_count;
    size_t tried_capacity;
    JoxText printed_text;           /* lines printed while loading */
    size_t failed_source;           /* number of the source in which the last failure was */
    char traceback[1024];           /* stack of the last failure, frames in script files only */
    uint32_t printed, print_second; /* lines printed in that second of simulated time */
    uint32_t complaints, complaint_second; /* failures reported in full in that second */
} JoxVm;

/* Opens the Lua state of `vm`, which must be zero but for `watch`, and calls `open` in it. False if
   memory runs out in `open`; jox_vm_close is due then too. */
bool jox_vm_open(JoxVm *vm, JoxVmGroup *group, lua_CFunction open);
/* Closes the Lua state and frees everything that `vm` owns. */
void jox_vm_close(JoxVm *vm);
/* Returns the VM of a Lua state. */
JoxVm *jox_vm_of(lua_State *L);
/* Calls the function on the stack below its `arguments`, with a budget of `instructions`, and
   leaves `results` values. False on any failure: *why is a sentence, valid until the next call on
   this thread, *line its line or 0, and the stack is empty. */
bool jox_vm_call(JoxVm *vm, int arguments, int results, uint64_t instructions, const char **why,
                 int *line);
/* As jox_vm_call, for a function that was pushed right after jox_vm_push_handler, which stays below
   the results: saves moving them. */
void jox_vm_push_handler(JoxVm *vm);
bool jox_vm_call_handled(JoxVm *vm, int arguments, int results, uint64_t instructions,
                         const char **why, int *line);
/* Returns a copy of a name that lives as long as the VM, the same for equal names. Raises an error
   at too many names, so call it within jox_vm_call. */
const char *jox_vm_intern(JoxVm *vm, const char *name);
/* Takes `steps`, about 10 ns each, from the budget for work that C does for a script. Raises an
   error when the budget is spent. */
void jox_vm_charge(lua_State *L, uint64_t steps);
/* Ends the present call for good: pops the message, raises it, and makes every further instruction
   fail, so that pcall cannot go on. */
int jox_vm_stop(lua_State *L);
/* Counts a failure in a second of simulated time; returns whether it may still be reported in full.
 */
bool jox_vm_may_say(JoxVm *vm, uint32_t second);
/* Returns the source number that a chunk name stands for ("b3": 3), or -1. */
int jox_vm_source(const JoxVm *vm, const char *chunk);
/* Returns the innermost running line that is in a script's file; its file is NULL if there is none.
 */
JoxPosition jox_vm_place(lua_State *L);
/* Splits "b12:34: message" into source and line; returns the message. Line 0: the message names
   none. */
const char *jox_vm_split(const JoxVm *vm, const char *message, int *line, size_t *source);

/* ---- files ---- */

/* Reads a file (`text` NULL: from the disk), checks that it is valid source and splits it into
   tokens; adds it to the sources. NULL with a diagnostic, placed at `from` if that names a file. */
JoxSource *jox_vm_read(JoxVm *vm, const char *path, const char *text, size_t length,
                       JoxPosition from, JoxDiagnostics *diagnostics);
/* Remembers that a file was looked for, so that a reload can watch it. */
void jox_vm_note_path(JoxVm *vm, const char *path);
/* Compiles source `number` and pushes the chunk; on failure false, with the message pushed. Stops
   at the deadline of the load. */
bool jox_vm_compile(JoxVm *vm, size_t number);
/* Returns whether Lua's parser finds an error in the first `length` bytes of source `number` other
   than their end. */
bool jox_vm_stops_within(JoxVm *vm, size_t number, size_t length);

/* ---- the sandbox ---- */

/* Additions of lua/language to the environment of scripts. Lists end with a NULL name. */
typedef struct JoxSandbox {
    const luaL_Reg *base, *math;   /* further functions; NULL: none */
    lua_CFunction missing, assign; /* __index for names that are not found; __newindex */
} JoxSandbox;
/* Makes the environment of scripts: our versions of Lua's functions, then the additions. Nothing
   else of Lua can be reached. */
void jox_sandbox_open(lua_State *L, const JoxSandbox *extra);

/* ---- frozen tables and upvalues ---- */

/* Called by jox_freeze with the stack index of a Lua function. */
typedef void JoxFreezeFunction(lua_State *L, int index, void *context);
/* Freezes the table or function at `index` and every table that can be reached from it through
   tables and upvalues: a frozen table is read as before, a write raises an error that names memory.
   Skips tables with metatables, which are the engine's. Calls `function` (NULL: none) once for each
   Lua function it meets. Raises errors, so call it within jox_vm_call. */
void jox_freeze(lua_State *L, int index, JoxFreezeFunction *function, void *context);
/* Pushes the contents of the table at `index`: for a frozen table those behind it, else the table
   itself. */
void jox_frozen_contents(lua_State *L, int index);
/* Raises an error if the table at `index` is frozen or belongs to the library. */
void jox_frozen_check_writable(lua_State *L, int index);

/* An upvalue: a variable that a Lua function shares with the code around it, with the value it had
   when the file was loaded. */
typedef struct JoxUpvalue {
    const void
        *id; /* address of the variable (lua_upvalueid), the same in all functions that share it */
    int number; /* number of the upvalue in its function, from 1 */
    bool next;  /* belongs to the same function as the item before */
    int type;   /* LUA_T... */
    union {
        const void *pointer; /* table, function, userdata or string, kept alive by the registry */
        lua_Number number;
        lua_Integer integer;
        bool boolean;
    } value;
    bool is_integer;
} JoxUpvalue;
typedef struct JoxUpvalues {
    JoxUpvalue *items;
    uint32_t count;
    size_t capacity;
} JoxUpvalues;
/* Adds the upvalues of the Lua function at `index` with their present values, except those already
   among the items from `first` on. Raises errors, so call it within jox_vm_call. */
void jox_upvalues_add(lua_State *L, int index, JoxUpvalues *all, uint32_t first);
/* Sets `count` upvalues from `first` on back to the values they had when they were added. Returns
   whether one had changed, with the name of the first such upvalue and its function in *where.
   Raises no errors. */
bool jox_upvalues_restore(lua_State *L, const JoxUpvalues *all, uint32_t first, uint32_t count,
                          char name[64], lua_Debug *where);

#endif
