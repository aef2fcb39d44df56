/* A script: one Lua state with the language of behaviours, and all that was read of its files.
   Shared by the files of lua/ and lua/language/; others include lua/loader.h. A script is created
   when a file loads, and lives until its machine is released, as the machine's functions run in it.
 */
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

/* ---- the outline of a file: the keys of its table ---- */

/* A key or item of the machine's table, as "states.Circle.2.when", and where it stands. */
typedef struct JoxPath {
    char *path;
    uint32_t key, first, last; /* tokens: key (of an item, its value); value, last exclusive */
} JoxPath;

typedef struct JoxOutline {
    JoxPath *paths;
    size_t path_count, path_capacity;
    size_t main;             /* token of the table that the file returns */
    const JoxToken *patches; /* in a mod's file: the name of the behaviour it changes */
    JoxSyntax *syntax;       /* NULL until jox_outline_syntax makes it */
} JoxOutline;

/* Returns the outline of a source that jox_script_read has read. */
static inline JoxOutline *jox_outline_of(const JoxSource *source) {
    JOX_ASSERT(source->outline);
    return source->outline;
}
/* Frees the outline of a source. */
void jox_outline_free(JoxSource *source);
/* Returns the position of a path's key, or of the nearest enclosing key that the file writes out.
 */
JoxPosition jox_outline_at(const JoxSource *source, const char *path);
/* Returns the entry of a path, or NULL. */
const JoxPath *jox_outline_find(const JoxSource *source, const char *path);
/* Writes the path under which the outline has the table of the machine that is written at a
   position: "" for the one that the file ends with; false if it is not found. */
bool jox_outline_root(const JoxSource *source, int line, int column, char root[24]);
/* Names, in each diagnostic of the source, the part of the machine's table that it is in. */
void jox_outline_contexts(const JoxSource *source, JoxDiagnostics *diagnostics);
/* Returns the first token where a function on these lines, or one nested in it, assigns one of the
   named variables of the code around it; NULL if none is found. */
const JoxToken *jox_outline_assigned(const JoxSource *source, int first_line, int last_line,
                                     const char *const *names, size_t name_count);
/* Returns whether any function of the source may assign a variable from outside of it. */
bool jox_outline_assigns_shared(const JoxSource *source);
/* Returns the syntax tree of a source that Lua has compiled; made on first use. */
const JoxSyntax *jox_outline_syntax(const JoxSource *source);

/* ---- expression values ---- */

enum { JOX_UNKNOWN_TAG = 63 }; /* bit for any tag when the scene is not known */

typedef enum {
    JOX_NODE_NUMBER = 1,
    JOX_NODE_CONDITION,
    JOX_NODE_TARGET,
    JOX_NODE_OWN, /* own.NAME: a number or, where a place is wanted, a place */
    JOX_NODE_STEER,
    JOX_NODE_DIST,
    JOX_NODE_CIRCUITS,
    JOX_NODE_LIST, /* a list in memory; op: JoxListChange of it, with the item in `a` or `target` */
    JOX_NODE_MACHINE,
    JOX_NODE_PATCH,   /* in a mod: a table that changes another file's machine */
    JOX_NODE_REPLACE, /* in a mod: a table that replaces another file's machine */
    JOX_NODE_WAIT,    /* a step of a sequence; `hook` refers to its seconds */
    JOX_NODE_BACK,    /* in a transition's `to`: the state that was left */
    JOX_NODE_NONE,    /* in a patch: removes a key */
    JOX_NODE_LAYER,   /* in a patch: a function that extends the one before it; `op` is its JoxLayer
                       */
    JOX_NODE_ERROR    /* stands for a value whose error is already reported */
} JoxNodeKind;

/* Position of a name, with the number of its source. */
typedef struct JoxNamePlace {
    JoxPosition at;
    uint32_t source;
} JoxNamePlace;

/* Filter of a target, from which JoxAgentFilter is compiled; names that are NULL: any. */
typedef struct JoxNodeFilter {
    const char *state, *machine, *memory;
    JoxNamePlace state_at, memory_at;
    bool grouped;
    int32_t group;
    double least, greatest;
    bool flies, fallen;
    double comes, within; /* m; 0: anything */
    double ahead;         /* degrees; 0: any direction */
} JoxNodeFilter;

typedef struct JoxNode JoxNode;
struct JoxNode {
    JoxNodeKind kind;
    int op;  /* JoxOp of a number or condition */
    int arg; /* JoxNow of a `now` value */
    double number;
    const char *name;  /* name of an own value, memory, message or target; interned */
    const char *field; /* name of a value of a message; NULL: its sender */
    JoxTargetKind target_kind;
    int32_t target_arg;
    JoxNode *a, *b, *c; /* operands */
    JoxNode *target, *place;
    JoxNode *score; /* number by which a target chooses the best one, or NULL */
    union {
        JoxDist dist;      /* JOX_NODE_DIST */
        JoxSteerTerm term; /* JOX_NODE_STEER: one term, with its target and weight in nodes here */
        JoxNodeFilter filter; /* JOX_NODE_TARGET: which agents it selects */
    };
    JoxNode *weight;
    JoxNode *next;    /* next term of a sum of steerings */
    int32_t compiled; /* 1 + index of the expression that it was compiled to; 0: not yet */
    uint32_t
        compiled_in; /* scope of that (JoxBuild.scope), as clocks and own values depend on it */
    int steps;       /* of a sequence: registry reference of its steps\' items by name; else 0 */
    int hook;        /* registry reference of the function or table it holds, or LUA_NOREF */
    JoxPosition position;
    JoxNamePlace written; /* where the name of an own value, state or memory, or the word `machine`,
                             is written */
};

/* ---- kinds of values, and calls while a file loads ---- */

/* Kinds of values that a variable or expression may hold, as bits; used to find misuse. */
enum {
    JOX_KIND_FALSE = 1, /* nil or false */
    JOX_KIND_PLAIN = 2, /* any other plain Lua value: true, a number, a string */
    JOX_KIND_CONDITION = 4,
    JOX_KIND_VALUE = 8, /* any other value of the language: a number, a target, ... */
    JOX_KIND_TABLE = 16,
    JOX_KIND_FUNCTION = 32,
    JOX_KIND_UNKNOWN = 64
};

enum { JOX_FACT_PARAMETERS = 8 };

/* Kinds of the arguments and of the first result of a function, over its calls while the file
   loaded. */
typedef struct JoxCallFact {
    uint32_t source;
    int first_line, last_line;
    uint8_t given[JOX_FACT_PARAMETERS], returned;
} JoxCallFact;

/* An operator or test of Lua's own on a value of the language, which Lua always takes for true. */
typedef struct JoxMisuse {
    uint32_t source, at; /* number of the source and of the token */
    bool certain;        /* surely wrong; if false, reported only where a condition was expected */
    bool reported;
} JoxMisuse;

/* Result of a `require`: which file a name refers to. */
typedef struct JoxRequired {
    uint32_t asking, given; /* numbers of the sources: with the `require`, and the file found */
    const char *name;       /* interned */
} JoxRequired;

/* ---- scripts ---- */

enum {
    JOX_HOOK_TIMED = 16 /* first calls that are timed; of later ones, one in 64 is */
};

/* How a function of a mod extends the function that stood before it. */
typedef enum JoxLayer {
    JOX_LAYER_ALONE, /* it stands in its place, or is the behaviour's own */
    JOX_LAYER_BEFORE,
    JOX_LAYER_AFTER,
    JOX_LAYER_AROUND /* it is passed the former function, and calls it or does not */
} JoxLayer;

/* A plain function of the behaviour, run for one agent at a time while the crowd runs. */
typedef struct JoxHook {
    int ref; /* registry reference */
    JoxLayer layer;
    int32_t previous;   /* hook that it extends; -1: none, but see the next two */
    int32_t expression; /* extends a compiled condition: its expression; else -1 */
    bool steers;        /* extends a compiled steering, whose velocity the agent has */
    int previous_ref;   /* AROUND: registry reference of the function that it is passed */
    char *where;        /* "state Circle > transition 2 (to Exit) > on_take" */
    uint32_t first_upvalue, upvalue_count; /* items of JoxScript.upvalues that it reaches */
    bool may_assign; /* a file of its code assigns upvalues: they are set back after each call */
    uint64_t calls, failures, timed;
    double first;             /* s, sum over the first calls, which are all timed */
    double seconds;           /* s, sum over the later calls that were timed, `timed` in number */
    uint32_t second;          /* second of simulated time that the next two members count in */
    uint32_t second_failures; /* failures in that second */
    uint64_t repeated;        /* failures in that second that were not reported in full */
    char *complaint;          /* message of the last failure that was reported in full */
    bool suspended;
} JoxHook;

/* A name of a field of `me` and of views. `key` is the address of Lua's text, which the registry
   keeps: equal short texts are one. */
typedef struct JoxField {
    const void *key;
    int16_t kind;      /* JoxFieldKind; -1: none */
    int16_t parameter; /* -1: none */
    int16_t slot;      /* memory of the script's machine; -1: none */
} JoxField;
enum { JOX_FIELDS = 512, JOX_VIEWS = 64 };

/* One Lua state, with what was read of a behaviour and the files that it requires. */
typedef struct JoxScript {
    JoxVm vm; /* first, as jox_script_of casts */
    JoxLua *owner;
    JoxNode **nodes;
    size_t node_count, node_capacity, node_bytes;
    const JoxScope *scope;       /* while loading; not owned */
    JoxDiagnostics *diagnostics; /* while loading; not owned */
    const char *called;          /* while loading: the word that was called last, and where */
    JoxPosition called_at;
    const JoxMod *mod;        /* mod of the file that is running; NULL: the behaviour's own files */
    JoxPatchChanges changes;  /* changes of the machine's table by mods */
    JoxBelonging *belongings; /* tags and teams that the script names; moved to the machine */
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
    JoxUpvalues upvalues; /* upvalues of all functions, one function after the other */
    JoxHook *hooks;
    uint32_t hook_count;
    uint32_t hook_walked; /* while loading: function whose upvalues are being recorded */
    size_t hook_capacity;
    JoxMemorySlot *memory; /* declared by memory{} */
    uint32_t memory_count;
    size_t memory_capacity;
    JoxPosition memory_at[JOX_MOST_SET]; /* where each is declared */
    JoxMachine *built;         /* under construction, kept here so that a failure can free it */
    const JoxMachine *machine; /* machine of the running function */
    int me;                    /* registry reference of `me`, which functions are passed */
    struct JoxMe *me_object;   /* that object */
    uint32_t field_count;
    bool has_unlisted;           /* some names of memory are not among the fields */
    JoxField fields[JOX_FIELDS]; /* names of `me` and views, by address, with open addressing */
    int views;                   /* registry reference of a list of views, which calls share */
    struct JoxView *view_objects[JOX_VIEWS]; /* items of that list */
    uint32_t view_count;                     /* number of views made by the running function */
    struct {
        uint32_t agent, slot;
    } read[16];          /* latest reads of neighbours' memory by the running function, as a ring */
    uint32_t read_count; /* number of all such reads */
    uint32_t draws;      /* random numbers drawn by the running function */
    JoxHookKind kind;    /* purpose of the running call */
    int32_t running;     /* innermost hook that runs */
    double nested;       /* time of hooks within the running one, s, if that is measured */
    bool measured;
    uint32_t agent; /* index of the agent that the function runs for */
} JoxScript;
static_assert(offsetof(JoxScript, vm) == 0, "jox_script_of casts");

/* A write of a function into a neighbour's memory, applied after the step. */
typedef struct JoxWrite {
    uint32_t agent_id, slot;
    uint16_t machine; /* at the time of the write, as the agent may change its machine in the same
                         step */
    bool depends;     /* the function had read that memory before */
    const char *file; /* file and line of the write */
    int line;
    double value;
} JoxWrite;

struct JoxLua {
    JoxVmGroup group;
    JoxScript **scripts;
    uint32_t script_count;
    size_t script_capacity;
    JoxMachineRun *machines;
    double clock_cost; /* time of reading the clock, s */
    double arriving;   /* estimated time of functions as agents arrive, outside of steps, s */
    /* Columns of all agents before the step, which views of neighbours read. */
    uint16_t *before_state, *before_machine;
    double *before_memory;
    size_t before_capacity, before_machine_capacity, before_memory_capacity;
    JoxWrite *writes;
    uint32_t write_count;
    size_t write_capacity;
    const JoWord *words; /* of the program; not owned */
    uint32_t word_count;
    JoxAct *acts; /* actions of the program in this step */
    uint32_t act_count;
    size_t act_capacity;
    uint64_t lost_writes; /* lost writes since the last report */
    uint32_t lost_second;
};

/* Creates a Lua state with the language in it; NULL if memory runs out. */
JoxScript *jox_script_create(JoxLua *lua);
/* Frees the script with everything that was read of its files. */
void jox_script_free(JoxScript *script);
static inline JoxScript *jox_script_of(lua_State *L) {
    return (JoxScript *)jox_vm_of(L);
}
/* Removes the script of a machine from `lua` and returns it, for the caller to free; NULL if there
   is none. */
JoxScript *jox_script_detach(JoxLua *lua, const JoxMachine *machine);
/* Returns the script of a machine, or NULL. */
const JoxScript *jox_lua_script(const JoxLua *lua, const JoxMachine *machine);
/* Reads a file as jox_vm_read does, reports to the script's diagnostics, and makes the outline. */
JoxSource *jox_script_read(JoxScript *script, const char *path, const char *text, size_t length,
                           JoxPosition from);
/* Makes the table on top of the stack that of the words that scripts can name; pops it. */
void jox_script_set_words(lua_State *L);

/* Returns the bit of a tag or the number of a team that a script sets (`is_set`) or asks for: the
   scene's, or a new one if the scene has none of that name. -1 if there are too many, or the scene
   is not known. */
int32_t jox_script_tag_or_team(JoxScript *script, const char *name, bool is_team, bool is_set,
                               JoxPosition at);

/* Debug hook of Lua for calls and returns while a file loads: records kinds of arguments and
   results. */
void jox_calls_watch(lua_State *L, lua_Debug *about);
/* Returns the record of the function on these lines; NULL if it was not called. */
JoxCallFact *jox_calls_find(const JoxScript *script, uint32_t source, int first_line,
                            int last_line);

/* Reports an error at the word's position in the running line and pushes an error value; returns 1.
   In a function of the running crowd it raises the error instead. */
int jox_word_error(lua_State *L, const char *word, const char *code, const char *hint,
                   const char *format, ...) __attribute__((format(printf, 5, 6)));
/* Returns the position of a word in the innermost running line of a script, and marks that
   occurrence as used. */
JoxPosition jox_word_position(lua_State *L, const char *word);
/* Returns the position as jox_word_position does, with the number of its source. */
JoxNamePlace jox_word_place(lua_State *L, const char *word);
/* Returns the place of the call of a word, which runs; errors of the word are reported there. */
JoxNamePlace jox_word_call_place(lua_State *L, const char *word);

JoxNode *jox_node_push(lua_State *L, JoxNodeKind kind); /* creates a node and pushes it */
JoxNode *jox_node_get(lua_State *L, int index);         /* NULL if the value is no node */
/* Returns a number, number node or own value as a node; NULL for anything else. */
JoxNode *jox_node_number(lua_State *L, int index);
/* Returns a value of a message as a target, where one is wanted; any other node as it is. */
JoxNode *jox_node_target(lua_State *L, JoxNode *node);
/* Pushes an operation on one or two nodes (`b` NULL: one). */
JoxNode *jox_node_push_operation(lua_State *L, JoxNodeKind kind, int op, JoxNode *a, JoxNode *b);
/* The metamethod __index of nodes: their methods and fields. */
int jox_node_index(lua_State *L);
/* Pushes a node again. */
void jox_node_repush(lua_State *L, JoxNode *node);
/* Returns a node for a number; nothing is pushed. */
JoxNode *jox_node_constant(lua_State *L, double value);
/* Returns what a value is, for messages: "a condition". */
const char *jox_node_kind(lua_State *L, int index);
bool jox_node_is_error(lua_State *L, int index);
int jox_node_push_error(lua_State *L); /* returns 1 */
/* Registers the metatable of nodes, with the operators. */
void jox_nodes_open(lua_State *L, const luaL_Reg *operators);
extern const luaL_Reg jox_operators[];
/* Add the words of words.c and of values.c to the table on top of the stack. */
void jox_words_add(lua_State *L);
void jox_values_add(lua_State *L);
/* Adds `before`, `afterwards` and `around`, by which patches extend functions. In layers.c. */
void jox_layers_add(lua_State *L);
/* Returns the word that makes a layer: "before". */
const char *jox_layer_word(JoxLayer layer);
/* Adds the words of sequence.c. */
void jox_sequence_add(lua_State *L);
/* Makes the environment of scripts. */
void jox_environment_open(lua_State *L);
/* The function `require` of scripts. */
int jox_require(lua_State *L);
/* Writes the words' names to `names`, up to `capacity`; returns how many. */
size_t jox_word_names(const char **names, size_t capacity);
/* Reads argument `index` of a word as the letter of the vocabulary says. NULL with an error value
   pushed if it does not fit. */
JoxNode *jox_word_argument(lua_State *L, const char *word, int index, char letter);
/* Pushes and returns the place that a string names, an argument of a word, as a target; NULL with
   an error pushed (place_words.c). */
JoxNode *jox_read_place_name(lua_State *L, const char *word, const char *name);
/* Pushes the value of a word; false with nothing pushed if there is none of that name. */
bool jox_word_lookup(lua_State *L, const char *name);

/* Words of the program (program_words.c). Pushes the value of one; false with nothing pushed if
   there is none of that name. */
bool jox_program_word_push(lua_State *L, const char *name);
/* Returns the word that a token names, or NULL. */
const JoWord *jox_program_word_find(const JoxLua *lua, const JoxToken *name);
/* Writes their names to `names`, up to `capacity`; returns how many. */
size_t jox_program_word_names(const JoxLua *lua, const char **names, size_t capacity);
/* Returns whether a value is an action of the program. */
bool jox_program_word_is_action(lua_State *L, int index);

/* Registers `me` and the views of neighbours. */
void jox_me_open(JoxScript *script);
/* Adds the names of a machine's memory to the fields that `me` and views find by address. In
   fields.c. */
void jox_fields_add_memory(JoxScript *script, const JoxMachine *machine);
/* Makes `me` and the views of earlier calls invalid, for a new call. */
void jox_me_begin(JoxScript *script);

#endif
