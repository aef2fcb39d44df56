/* A script: a Lua state with the language of behaviours in it, and what was read of its files. */
#ifndef JOX_LUA_LANGUAGE_SCRIPT_H
#define JOX_LUA_LANGUAGE_SCRIPT_H

#include <assert.h>
#include <stddef.h>

#include "base/assert.h"
#include "base/format/patch.h"
#include "lua/language/scope.h"
#include "lua/vm/syntax.h"
#include "lua/vm/vm.h"
#include "machine/run.h"

/* ---- what a file writes out: the keys of its table ---- */

/* A key or item of the machine's table: "states.Circle.2.when", and where it stands. */
typedef struct JoxPath {
    char *path;
    uint32_t key, first, last; /* tokens: of the key (or the value), of the value */
} JoxPath;

typedef struct JoxOutline {
    JoxPath *paths;
    size_t path_count, path_capacity;
    const JoxToken *patches; /* of a mod's file: the name of what it changes */
    JoxSyntax *syntax;       /* NULL until asked for */
} JoxOutline;

/* Of a source that jox_script_read has read. */
static inline JoxOutline *jox_outline_of(const JoxSource *source) {
    JOX_ASSERT(source->outline);
    return source->outline;
}
/* Makes the outline of a source from its tokens, and frees it. */
void jox_outline_read(JoxSource *source);
void jox_outline_free(JoxSource *source);
/* Position of a path's key, or of the nearest enclosing one that is written out. */
JoxPosition jox_outline_at(const JoxSource *source, const char *path);
const JoxPath *jox_outline_find(const JoxSource *source, const char *path);
/* Says of each diagnostic in the source which part of the machine's table it is in. */
void jox_outline_contexts(const JoxSource *source, JoxDiagnostics *diagnostics);
/* The first place where a function with these lines (or one in it) assigns one of the named
   variables, which was declared outside of it; NULL where none is seen. */
const JoxToken *jox_outline_assigned(const JoxSource *source, int first_line, int last_line,
                                     const char *const *names, size_t name_count);
/* The syntax tree of a source that Lua has compiled. */
const JoxSyntax *jox_outline_syntax(const JoxSource *source);

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
    JOX_NODE_ERROR    /* stands for something already reported */
} JoxNodeKind;

/* Where a name was written, and the number of that source. */
typedef struct JoxNamePlace {
    JoxPosition at;
    uint32_t source;
} JoxNamePlace;

/* As JoxWhose, by names; NULL: any. */
typedef struct JoxNodeWhose {
    const char *state, *machine, *memory;
    JoxNamePlace state_at, memory_at;
    bool grouped;
    int32_t group;
    double least, greatest;
} JoxNodeWhose;

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
    union {
        JoxDist dist;       /* of a distribution */
        JoxSteerTerm term;  /* of a steering: one term; its target and weight are nodes here */
        JoxNodeWhose whose; /* of a target: whom of those it means */
    };
    JoxNode *weight;
    JoxNode *next;    /* further terms of a sum */
    int32_t compiled; /* expression of the machine that it was compiled to, plus 1; 0: not yet */
    int hook;         /* registry reference of a function or table, or LUA_NOREF */
    JoxPosition position;
    JoxNamePlace written; /* of own values, and of names of what others have */
};

/* ---- what functions are given while a file loads ---- */

/* What a value is, for the search of misuse; bits, as a variable may hold several. */
enum {
    JOX_KIND_FALSE = 1, /* nil or false */
    JOX_KIND_PLAIN = 2, /* any other value of Lua's own that is no table and no function */
    JOX_KIND_CONDITION = 4,
    JOX_KIND_VALUE = 8, /* any other value of the language: a number, a target, ... */
    JOX_KIND_TABLE = 16,
    JOX_KIND_FUNCTION = 32,
    JOX_KIND_UNKNOWN = 64
};

enum { JOX_FACT_PARAMETERS = 8 };

/* Kinds that a function was called with while the file loaded, and returned first. */
typedef struct JoxCallFact {
    uint32_t source;
    int first_line, last_line;
    uint8_t given[JOX_FACT_PARAMETERS], returned;
} JoxCallFact;

/* A place where Lua decides by a value of the language, which it always takes for true. */
typedef struct JoxMisuse {
    uint32_t source, at; /* token */
    bool certain;        /* false: it may be one, and is where a condition was meant */
    bool reported;
} JoxMisuse;

/* Which file a `require` gave. */
typedef struct JoxRequired {
    uint32_t asking, given; /* sources */
    const char *name;       /* interned */
} JoxRequired;

/* ---- one Lua state with its load ---- */

/* A plain function of the behaviour. */
typedef struct JoxHook {
    int ref;                               /* in the registry */
    char *where;                           /* "state Circle > transition 2 (to Exit) > on_take" */
    uint32_t first_upvalue, upvalue_count; /* that it could change */
    uint64_t calls, failures, timed;
    double first;             /* s, of the first calls, all of which are timed */
    double seconds;           /* of later ones that were timed */
    uint32_t second;          /* simulated, of the failures that follow */
    uint32_t second_failures; /* in that second */
    uint64_t repeated;        /* failures like the last that were not said */
    char *complaint;          /* the last one that was said in full */
    bool suspended;
} JoxHook;

/* One Lua state and what was read of its script: a behaviour with the files that it requires. */
typedef struct JoxScript {
    JoxVm vm; /* first: jox_script_of relies on it */
    JoxLua *owner;
    JoxNode **nodes;
    size_t node_count, node_capacity, node_bytes;
    const JoxScope *scope;       /* while loading */
    JoxDiagnostics *diagnostics; /* while loading */
    const JoxMod *mod;           /* whose file is running; NULL: the script's own */
    JoxPatchChanges changes;     /* that mods made */
    JoxBelonging *belongings;    /* tags and teams that were named; go to the machine */
    uint32_t belonging_count;
    size_t belonging_capacity;
    JoxCallFact *facts;
    uint32_t fact_count;
    size_t fact_capacity;
    JoxMisuse *misuses;
    uint32_t misuse_count;
    size_t misuse_capacity;
    JoxRequired *required;
    uint32_t required_count;
    size_t required_capacity;
    JoxUpvalues upvalues; /* those of each hook in one piece */
    JoxHook *hooks;
    uint32_t hook_count;
    uint32_t hook_walked; /* while loading: whose upvalues are looked at */
    size_t hook_capacity;
    JoxMemorySlot *memory; /* declared by memory{} */
    uint32_t memory_count;
    size_t memory_capacity;
    JoxMachine *built;         /* under construction, so that a failure can free it */
    const JoxMachine *machine; /* whose hook runs */
    int me;                    /* registry reference of the object that hooks are given */
    struct {
        uint32_t agent, slot;
    } read[16];          /* memory of others that the present hook has read: the last ones */
    uint32_t read_count; /* all of them */
    uint32_t draws;      /* math.random calls of the present hook */
    uint32_t agent;      /* whose hook runs */
} JoxScript;
static_assert(offsetof(JoxScript, vm) == 0, "jox_script_of casts");

/* What a hook wrote into another agent's memory. */
typedef struct JoxWrite {
    uint32_t agent_id, slot;
    uint16_t machine; /* whose slot it is: the agent may become another in the same step */
    bool depends;     /* on what the hook had read there */
    const char *file; /* where it is written */
    int line;
    double value;
} JoxWrite;

struct JoxLua {
    JoxVmGroup group;
    JoxScript **scripts;
    uint32_t script_count;
    size_t script_capacity;
    JoxMachineRun *machines;
    double arriving; /* s of calls as people come in, outside of steps; estimated */
    /* Agents as they were before the step, for hooks that look at others. */
    uint16_t *before_state, *before_machine;
    double *before_memory;
    size_t before_capacity, before_machine_capacity, before_memory_capacity;
    JoxWrite *writes;
    uint32_t write_count;
    size_t write_capacity;
    uint64_t lost_writes; /* that were not said; `lost_second`: of the last that was, plus 1 */
    uint32_t lost_second;
};

/* A state with the language in it; NULL where memory lacks. */
JoxScript *jox_script_create(JoxLua *lua);
void jox_script_free(JoxScript *script);
static inline JoxScript *jox_script_of(lua_State *L) {
    return (JoxScript *)jox_vm_of(L);
}
/* Takes the script of a machine out of its owner. */
JoxScript *jox_script_detach(JoxLua *lua, const JoxMachine *machine);
/* The script behind a machine, or NULL. */
const JoxScript *jox_lua_script(const JoxLua *lua, const JoxMachine *machine);
/* As jox_vm_read, with the script's diagnostics, and makes the outline. */
JoxSource *jox_script_read(JoxScript *script, const char *path, const char *text, size_t length,
                           JoxPosition from);
/* Puts the table on top of the stack, popped, in the place of the words that a file can use. */
void jox_script_set_words(lua_State *L);

/* Number of a tag (its bit) or team that is set or asked for, written at a place: the scene's, or
   where it has none of the name a new one. -1 where there are too many, or the scene is not known.
 */
int32_t jox_script_belonging(JoxScript *script, const char *name, bool is_team, bool is_set,
                             JoxPosition at);

uint8_t jox_kind_of(lua_State *L, int index);
/* Keeps what a call that is told of, or its return, says of its function. */
void jox_calls_watch(lua_State *L, lua_Debug *about);
/* What is known of the function with these lines; NULL where it was not called. */
JoxCallFact *jox_calls_find(const JoxScript *script, uint32_t source, int first_line,
                            int last_line);

/* Reports an error at a word's place in the running chunk and pushes an error value; returns 1. */
int jox_word_error(lua_State *L, const char *word, const char *code, const char *hint,
                   const char *format, ...) __attribute__((format(printf, 5, 6)));
JoxPosition jox_word_position(lua_State *L, const char *word);
JoxNamePlace jox_word_written(lua_State *L, const char *word);

JoxNode *jox_node_push(lua_State *L, JoxNodeKind kind); /* new, also on the stack */
JoxNode *jox_node_get(lua_State *L, int index);         /* NULL if it is no node */
/* A number, a number node or own value as a node of numbers; NULL if it is something else. */
JoxNode *jox_node_number(lua_State *L, int index);
/* Pushes the value of a node once more. */
void jox_node_repush(lua_State *L, JoxNode *node);
JoxNode *jox_node_constant(lua_State *L, double value);
/* What a value is, in words: "a condition". */
const char *jox_node_kind(lua_State *L, int index);
bool jox_node_is_error(lua_State *L, int index);
int jox_node_push_error(lua_State *L); /* returns 1 */
/* Makes the type of nodes known, with the operators as its metamethods. */
void jox_nodes_open(lua_State *L, const luaL_Reg *operators);
extern const luaL_Reg jox_operators[];
/* Adds the words of words.c, and of values.c, to the table on top of the stack. */
void jox_words_add(lua_State *L);
void jox_values_add(lua_State *L);
/* Makes the environment of scripts. */
void jox_environment_open(lua_State *L);
/* require "name" */
int jox_require(lua_State *L);
/* Names of the vocabulary, up to `capacity`; returns how many. */
size_t jox_word_names(const char **names, size_t capacity);
/* Reads argument `index` of a word as its letter of the vocabulary asks; NULL with an error, or a
   error value, pushed. */
JoxNode *jox_word_argument(lua_State *L, const char *word, int index, char letter);
bool jox_word_lookup(lua_State *L, const char *name); /* pushes it */

void jox_me_open(JoxScript *script);

#endif
