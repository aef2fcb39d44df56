/* A Lua state within limits: its memory, its budgets, its files, and the one protected call through
   which everything enters it. Knows Lua, and nothing of what scripts are about. */
#ifndef JOX_LUA_VM_VM_H
#define JOX_LUA_VM_VM_H

#include <lauxlib.h>
#include <lua.h>

#include "base/text.h"
#include "lua/vm/limits.h"
#include "lua/vm/source.h"

/* What the states of one run share. */
typedef struct JoxVmGroup {
    JoxLuaLimits limits;
    char stalled[256];   /* the script for which the run must end, or nothing */
    JoxLuaComplain *say; /* NULL: nobody listens */
    void *say_context;
} JoxVmGroup;

typedef struct JoxVm {
    JoxVmGroup *group;
    lua_State *L;
    size_t used;        /* bytes */
    uint64_t left;      /* instructions until it is stopped */
    bool over;          /* sticky: every further instruction fails */
    bool starved;       /* it is over for want of memory; sticky too */
    bool no_memory;     /* the machine had none when it last asked for more */
    bool running;       /* within jox_vm_call */
    bool loading;       /* a file is loaded: a clock counts besides the instructions */
    lua_Hook watch;     /* told of calls and returns while loading; NULL: nobody */
    bool untimed;       /* no budget is shared by the calls of a step, and no clock looks on */
    double deadline;    /* of a load, seconds of this thread's processor time; 0 is unset */
    uint32_t interval;  /* instructions from one check to the next */
    uint32_t charges;   /* of C code while loading */
    uint64_t calls;     /* while not loading */
    uint32_t run;       /* numbers the calls, so that nothing of a call can be kept: the caller's */
    uint32_t step;      /* of the simulation, in which the next call is: the caller's */
    uint32_t second;    /* the same in simulated seconds, plus 1; 0 outside of a simulation */
    uint64_t step_left; /* instructions that calls may still use in step `budget_step` */
    uint32_t budget_step;
    double watch_from; /* seconds of this thread's processor time, when `left` was this: */
    uint64_t watch_left;
    double beyond; /* seconds that calls took beyond what their instructions explain */
    char **names;  /* interned */
    size_t name_count, name_capacity;
    JoxSource **sources; /* the script, then what it required; chunk "=b3" is number 3 */
    size_t source_count, source_capacity;
    JoxLuaFile *files; /* one for each source */
    uint32_t file_count;
    size_t file_capacity;
    char **tried; /* files that were looked for, found or not */
    uint32_t tried_count;
    size_t tried_capacity;
    JoxText printed_text;                  /* what was printed while loading */
    size_t failed_source;                  /* in which file the last failure was */
    char traceback[1024];                  /* of the last failure: frames of the script alone */
    uint32_t printed, print_second;        /* lines of `print` in that second */
    uint32_t complaints, complaint_second; /* said in full in that second */
} JoxVm;

/* Makes the state of `vm`, which is all zero but for `watch`, and calls `open` in it. False where
   memory lacks; close it then too. */
bool jox_vm_open(JoxVm *vm, JoxVmGroup *group, lua_CFunction open);
void jox_vm_close(JoxVm *vm);
JoxVm *jox_vm_of(lua_State *L);
/* The only way in: runs what is on the stack within `instructions`. False on any failure; *why is
   then a sentence that holds until the next call, with the line in *line (0 unknown), and the stack
   is empty. */
bool jox_vm_call(JoxVm *vm, int arguments, int results, uint64_t instructions, const char **why,
                 int *line);
/* Keeps a copy of a name as long as the VM. Within a call only: too many raise an error. */
const char *jox_vm_intern(JoxVm *vm, const char *name);
/* What C code does for a script counts too: takes steps, of about 10 ns, from the budget. Raises
   an error when it is spent. */
void jox_vm_charge(lua_State *L, uint64_t steps);
/* Ends the script for good: every further instruction fails. Pops and raises the message. */
int jox_vm_stop(lua_State *L);
/* Whether one more failure may be said in full in a simulated second. */
bool jox_vm_may_say(JoxVm *vm, uint32_t second);
/* The number of the source that a chunk name is of ("b3": 3), or -1. */
int jox_vm_source(const JoxVm *vm, const char *chunk);
/* The innermost place in a script that is running; its path is NULL where there is none. */
JoxPosition jox_vm_place(lua_State *L);
/* Splits "b12:34: message" into line, source and message; line 0 where it says none. */
const char *jox_vm_split(const JoxVm *vm, const char *message, int *line, size_t *source);

/* ---- files ---- */

/* Reads, checks and scans a file (`text` NULL: from the disk); it becomes the last of the sources.
   NULL with a diagnostic, at `from` where that has a file. */
JoxSource *jox_vm_read(JoxVm *vm, const char *path, const char *text, size_t length,
                       JoxPosition from, JoxDiagnostics *diagnostics);
/* Keeps that a file was looked for. */
void jox_vm_tried(JoxVm *vm, const char *path);
/* Compiles source `number` as a chunk, and pushes it; false with an error message pushed. Within
   the time of a load. */
bool jox_vm_compile(JoxVm *vm, size_t number);
/* Whether the parser stops within the first `length` bytes of source `number`: what follows cannot
   mend them. */
bool jox_vm_stops_within(JoxVm *vm, size_t number, size_t length);

/* ---- the sandbox ---- */

/* What the language above adds to the environment of scripts. Lists end with a NULL name. */
typedef struct JoxSandbox {
    const luaL_Reg *base, *math;   /* further functions; NULL: none */
    lua_CFunction missing, assign; /* __index of what is not there; __newindex */
} JoxSandbox;
/* Makes the environment: a whitelist of functions of our own, then what is added. */
void jox_sandbox_open(lua_State *L, const JoxSandbox *extra);

/* ---- frozen tables and what functions share ---- */

typedef void JoxFreezeFunction(lua_State *L, int index, void *context);
/* Freezes the table at `index`, or what the function there reaches, and everything reachable from
   it through tables and upvalues: reading goes on as before, writing raises an error that names
   memory. Tables with metatables are the engine's and left alone. `function`, which may be NULL, is
   called for each Lua function met for the first time. Raises errors: call it protected. */
void jox_freeze(lua_State *L, int index, JoxFreezeFunction *function, void *context);
/* Pushes the table that holds the contents of the table at `index`: itself, or what was frozen. */
void jox_frozen_contents(lua_State *L, int index);
/* Raises an error where the table at `index` is frozen or belongs to the library. */
void jox_frozen_check_writable(lua_State *L, int index);

/* A variable that a Lua function shares with the code around it: Lua's name of the variable itself,
   its number in the function that stands for it, and the value that it had. */
typedef struct JoxUpvalue {
    const void *id;
    int number;
    bool next; /* of the same function as the one before it */
    int type;  /* of Lua */
    union {
        const void *pointer; /* of tables, functions, userdata and texts, which are kept alive */
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
/* Adds the variables of the Lua function at `index` that are not among those from `first` on, with
   their present values. Raises errors: call it protected. */
void jox_upvalues_add(lua_State *L, int index, JoxUpvalues *all, uint32_t first);
/* Gives `count` variables from `first` on the values they had when they were added. Whether one had
   changed; then the name of the first and the function that was added with it. Raises no errors. */
bool jox_upvalues_restore(lua_State *L, const JoxUpvalues *all, uint32_t first, uint32_t count,
                          char name[64], lua_Debug *where);

#endif
