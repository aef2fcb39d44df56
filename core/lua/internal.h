/* What the files of lua share. */
#ifndef JOX_LUA_INTERNAL_H
#define JOX_LUA_INTERNAL_H

#include <lauxlib.h>
#include <lua.h>

#include "lua/loader.h"

/* ---- tokens ---- */

typedef enum { JOX_TOKEN_NAME, JOX_TOKEN_STRING, JOX_TOKEN_NUMBER, JOX_TOKEN_SYMBOL } JoxTokenKind;
typedef struct JoxToken {
    JoxTokenKind kind;
    const char *text; /* in the source; a string's without its quotes */
    uint32_t length;
    int line, column, end_column;
    bool used; /* a word of this name was already read here */
} JoxToken;

/* A key or item of the machine's table: "states.Circle.2.when", and where it stands. */
typedef struct JoxPath {
    char *path;
    uint32_t key, first, last; /* tokens: of the key (or the value), of the value */
} JoxPath;

typedef struct JoxSource {
    const char *path; /* as the user named it */
    char *text;
    size_t length;
    JoxToken *tokens;
    size_t token_count, token_capacity;
    JoxPath *paths;
    size_t path_count, path_capacity;
    const JoxToken *patches;  /* of a mod's file: the name of what it changes */
    uint32_t looks;           /* tokens looked at for conditions; bounded */
    struct JoxScopes *scopes; /* of its variables; NULL until asked for */
} JoxSource;

/* Splits Lua source into tokens; never fails, for Lua's own parser reports what is malformed. */
void jox_source_scan(JoxSource *source);
void jox_source_free(JoxSource *source);
/* The first unused token of this name on a line, marked used; else any of them; else NULL. */
JoxToken *jox_source_find(JoxSource *source, int line, const char *name);
/* Position of a path's key, or of the nearest enclosing one that is written out. */
JoxPosition jox_source_path(const JoxSource *source, const char *path);
/* Says of each diagnostic in the source which part of the sheet it is in. */
void jox_source_contexts(const JoxSource *source, JoxDiagnostics *diagnostics);
/* The first place where a function with these lines (or one in it) assigns one of the named
   variables, which was declared outside of it; NULL where none is seen. */
const JoxToken *jox_source_assigned(JoxSource *source, int first_line, int last_line,
                                    const char *const *names, size_t name_count);
void jox_source_scopes_free(struct JoxScopes *scopes);
const JoxPath *jox_source_path_find(const JoxSource *source, const char *path);
static inline bool jox_token_is(const JoxToken *token, const char *text) {
    size_t n = token->length;
    return token->kind != JOX_TOKEN_STRING && __builtin_strlen(text) == n &&
           __builtin_memcmp(token->text, text, n) == 0;
}

/* ---- expression values ---- */

enum { JOX_UNKNOWN_TAG = 63 }; /* bit of tags of a scene that is not known */

typedef enum {
    JOX_NODE_NUMBER = 1,
    JOX_NODE_CONDITION,
    JOX_NODE_TARGET,
    JOX_NODE_OWN, /* own.NAME: a number or, where a place is wanted, a place */
    JOX_NODE_STEER,
    JOX_NODE_DIST,
    JOX_NODE_CIRCUITS,
    JOX_NODE_MACHINE,
    JOX_NODE_PATCH,   /* of a mod: a table that changes another file's machine */
    JOX_NODE_REPLACE, /* of a mod: a table that takes its place */
    JOX_NODE_NONE,    /* in a patch: takes a key away */
    JOX_NODE_POISON   /* stands for something already reported */
} JoxNodeKind;

typedef struct JoxNode JoxNode;
struct JoxNode {
    JoxNodeKind kind;
    int op;  /* JoxOp of numbers and conditions */
    int arg; /* JoxNow */
    double number;
    const char *name; /* own, memory or target name; interned with the VM */
    JoxTargetKind target_kind;
    int32_t target_arg;
    JoxNode *a, *b, *c; /* inputs */
    JoxNode *target, *place;
    JoxDist dist;
    JoxSteerTerm term; /* one term; its target and weight are nodes here */
    JoxNode *weight;
    JoxNode *next;   /* further terms of a sum */
    int32_t program; /* that it was compiled to, plus 1; 0: not yet */
    int hook;        /* registry reference of a function or table, or LUA_NOREF */
    JoxPosition position;
    uint32_t source; /* number of the source that position is in */
};

/* ---- one Lua state with its load ---- */

/* Where a part of the machine was written, in place of the behaviour's own file: everything at and
   below `path` stands at `from` in a source. In the order in which it was set. */
typedef struct JoxOrigin {
    char *path; /* "states.Circle.push"; a transition by its id: "states.Circle.@Exit.chance" */
    uint32_t source;
    char *from;
    int32_t mod; /* index, or -1: the behaviour itself */
    bool removes;
} JoxOrigin;

/* A variable that a Lua function shares with the code around it: Lua's name of the variable itself,
   and its number in the function that stands for it. */
typedef struct JoxUpvalue {
    const void *id;
    int number;
} JoxUpvalue;
typedef struct JoxUpvalues {
    JoxUpvalue *items;
    uint32_t count;
    size_t capacity;
} JoxUpvalues;

/* A plain function of the behaviour. */
typedef struct JoxHook {
    int ref;                               /* in the registry */
    char *where;                           /* "state Circle > transition 2 (to Exit) > on_take" */
    uint32_t first_upvalue, upvalue_count; /* that it could change */
    uint64_t calls, failures, timed;
    double seconds;           /* of the calls that were timed */
    uint32_t second;          /* simulated, of the failures that follow */
    uint32_t second_failures; /* in that second */
    uint64_t repeated;        /* failures like the last that were not said */
    char *complaint;          /* the last one that was said in full */
    bool suspended;
} JoxHook;

typedef struct JoxVm {
    JoxLua *owner;
    lua_State *L;
    size_t used, node_bytes; /* bytes */
    uint64_t left;           /* instructions until it is stopped */
    bool over;               /* sticky: every further instruction fails */
    bool running;            /* within jox_vm_call */
    bool loading;
    bool starved;       /* it is over for want of memory; sticky too */
    double deadline;    /* of a load, seconds of this thread's processor time; 0 is unset */
    uint32_t interval;  /* instructions from one check to the next */
    uint64_t calls;     /* of hooks */
    uint32_t charges;   /* of C code while loading */
    bool untimed;       /* it runs tests, whose scenes take their time */
    uint64_t step_left; /* instructions that hooks may still use in this step */
    uint32_t step;
    double watch_from; /* seconds of this thread's processor time, when `left` was this: */
    uint64_t watch_left;
    double beyond; /* seconds that hooks took beyond what their instructions explain */
    JoxNode **nodes;
    size_t node_count, node_capacity;
    char **names; /* interned */
    size_t name_count, name_capacity;
    JoxSource *sources; /* the behaviour, then what it required */
    size_t source_count, source_capacity;
    JoxLuaFile *files;
    uint32_t file_count;
    size_t file_capacity;
    char **tried; /* files that were looked for, found or not */
    uint32_t tried_count;
    size_t tried_capacity;
    JoxText printed_text; /* what was printed while loading */
    const JoxScope *scope;
    JoxDiagnostics *diagnostics;
    const JoxMod *mod; /* whose file is running; NULL: the behaviour's own */
    JoxOrigin *origins;
    size_t origin_count, origin_capacity;
    JoxUpvalues upvalues;
    JoxHook *hooks;
    uint32_t hook_count;
    uint32_t hook_walked; /* while loading: whose upvalues are looked at */
    size_t hook_capacity;
    JoxMemorySlot *memory; /* declared by memory{} */
    uint32_t memory_count;
    size_t memory_capacity;
    JoxMachine *built;    /* under construction, so that a failure can free it */
    size_t failed_source; /* in which file the last failure was */
    const JoxMachine *machine;
    int me;                         /* registry reference of the object that hooks are given */
    char traceback[1024];           /* of the last failure: frames of the behaviour alone */
    uint32_t draws;                 /* math.random calls of the present hook */
    uint32_t agent;                 /* whose hook runs */
    uint32_t run;                   /* numbers the calls, so that `me` cannot be kept */
    uint32_t printed, print_second; /* lines of `print` in that second */
    uint32_t complaints, complaint_second; /* said in full in that second */
} JoxVm;

/* What a hook wrote into another agent's memory. */
typedef struct JoxWrite {
    uint32_t agent_id, slot;
    double value;
} JoxWrite;

struct JoxLua {
    JoxLuaLimits limits;
    char stalled[256]; /* the behaviour for which the run must end, or nothing */
    JoxVm **vms;
    uint32_t vm_count;
    size_t vm_capacity;
    JoxMachineRun *machines;
    JoxLuaComplain *complain;
    void *complain_context;
    uint64_t failures;
    /* Agents as they were before the step, for hooks that look at others. */
    uint16_t *before_state;
    double *before_memory;
    size_t before_capacity, before_memory_capacity;
    JoxWrite *writes;
    uint32_t write_count;
    size_t write_capacity;
};

JoxVm *jox_vm_create(JoxLua *lua);
void jox_vm_free(JoxVm *vm);
/* Takes the VM of a machine out of its owner. */
JoxVm *jox_vm_detach(JoxLua *lua, const JoxMachine *machine);
JoxVm *jox_vm_of(lua_State *L);
/* The only way in: runs what is on the stack within `instructions`. False on any failure; *why is
   then a sentence that holds until the next call, with the line in *line (0 unknown). */
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
/* The innermost place in a script that is running; its path is NULL where there is none. */
JoxPosition jox_vm_place(lua_State *L);

void jox_sandbox_open(JoxVm *vm);
/* Keeps that a file was looked for. */
void jox_vm_tried(JoxVm *vm, const char *path);
/* Reads, checks and scans a file; NULL with a diagnostic at `from`. */
JoxSource *jox_vm_read(JoxVm *vm, const char *path, const char *text, size_t length,
                       JoxPosition from);

/* ---- the library: each list ends with a NULL name ---- */

extern const luaL_Reg jox_library_base[], jox_library_math[], jox_library_string[],
    jox_library_table[];
/* Text that grows in Lua's memory, so that an error leaks nothing. Keeps one stack slot. */
typedef struct JoxScratch {
    lua_State *L;
    char *data;
    size_t length, capacity;
    int slot;
} JoxScratch;
void jox_scratch_open(JoxScratch *scratch, lua_State *L, size_t capacity);
void jox_scratch_add(JoxScratch *scratch, const char *text, size_t length);
void jox_scratch_push(JoxScratch *scratch); /* the text as a Lua string */
/* Pushes the text of any value; never an address. */
const char *jox_library_text(lua_State *L, int index, size_t *length);
/* Order of strings byte by byte, whatever the locale. */
int jox_library_compare(const char *a, size_t a_length, const char *b, size_t b_length);

/* ---- frozen tables and what functions remember ---- */

/* The metatable of a frozen table holds its contents under this key's address. */
extern const char jox_frozen_key;
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

/* Adds the variables of the Lua function at `index` that are not among those from `first` on, with
   their present values. Raises errors: call it protected. */
void jox_upvalues_add(lua_State *L, int index, JoxUpvalues *all, uint32_t first);
/* Gives `count` variables from `first` on the values they had when they were added. Whether one had
   changed; then the name of the first and the function that was added with it. Raises no errors. */
bool jox_upvalues_restore(lua_State *L, const JoxUpvalues *all, uint32_t first, uint32_t count,
                          char name[64], lua_Debug *where);

/* Reports an error at a word's place in the running chunk and pushes a poison value; returns 1. */
int jox_word_error(lua_State *L, const char *word, const char *code, const char *hint,
                   const char *format, ...) __attribute__((format(printf, 5, 6)));
JoxPosition jox_word_position(lua_State *L, const char *word);

JoxNode *jox_node_push(lua_State *L, JoxNodeKind kind); /* new, also on the stack */
JoxNode *jox_node_get(lua_State *L, int index);         /* NULL if it is no node */
/* A number, a number node or own value as a node of numbers; NULL if it is something else. */
JoxNode *jox_node_number(lua_State *L, int index);
/* Pushes the value of a node once more. */
void jox_node_repush(lua_State *L, JoxNode *node);
JoxNode *jox_node_constant(lua_State *L, double value);
void jox_nodes_open(JoxVm *vm);
void jox_words_open(JoxVm *vm);
/* Adds the words of values.c to the table on top of the stack. */
void jox_values_open(lua_State *L);
/* Names of the vocabulary, up to `capacity`; returns how many. */
size_t jox_word_names(const char **names, size_t capacity);
/* Reads argument `index` of a word as its letter of the vocabulary asks; NULL with an error, or a
   poison value, pushed. */
JoxNode *jox_word_argument(lua_State *L, const char *word, int index, char letter);
/* "Did you mean 'x'?" or NULL. */
const char *jox_did_you_mean(const char *word, const char *const *names, size_t count,
                             char hint[96]);
bool jox_word_lookup(lua_State *L, const char *name); /* pushes it */

/* Runs the patches that the scope's mods have for the machine on top of the stack, and puts the
   changed one in its place. False with diagnostics. */
bool jox_patch_apply(JoxVm *vm);
/* Compiles source `number` as a chunk, and pushes it; false with an error message pushed. Within
   the time of a load. */
bool jox_source_compile(JoxVm *vm, size_t number);

/* Makes vm->built of the machine on top of the stack; what is wrong goes to the diagnostics. */
void jox_build(JoxVm *vm, JoxSource *source);
void jox_me_open(JoxVm *vm);

/* The machine under construction. */
typedef struct JoxBuild {
    JoxVm *vm;
    JoxSource *source;
    JoxMachine *machine;
    size_t program_capacity, target_capacity, own_capacity, memory_capacity, counter_capacity,
        state_capacity, name_capacity;
} JoxBuild;
int16_t jox_build_target(JoxBuild *build, const JoxNode *node);
/* Index of a name that machines share. */
int16_t jox_build_name(JoxBuild *build, const char *name, JoxNameUse use);
int32_t jox_build_own(JoxBuild *build, const char *name);
/* The same for an own value that was written out: keeps where. */
int32_t jox_build_own_at(JoxBuild *build, const JoxNode *node);
int32_t jox_build_memory(JoxBuild *build, const char *name);
int32_t jox_build_program(JoxBuild *build, const JoxNode *node, JoxPosition position);
void jox_build_error(JoxBuild *build, JoxPosition position, const char *code, const char *hint,
                     const char *format, ...) __attribute__((format(printf, 5, 6)));

#endif
