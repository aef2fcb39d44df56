/* Functions that build a machine, shared by the files of lua/. The loader calls jox_patch_behaviour
   and jox_build; build.c reads the machine and calls read_state.c, actions.c and declare.c, which
   use read_table.c and compile.c. */
#ifndef JOX_LUA_READ_TABLE_H
#define JOX_LUA_READ_TABLE_H

#include "lua/language/script.h"

/* A machine of those that are built into one: the behaviour's own, or one that an outer state
   runs. */
typedef struct JoxNested {
    int table;       /* registry reference of its table */
    int32_t outer;   /* index of the outer state that runs it; -1: the behaviour's own */
    uint32_t parent; /* number of the machine that has this state */
    char path[256];  /* path of its table: "states.Guard.runs" */
    int32_t source;  /* number of the source that writes it; -1 unknown */
    char root[24];   /* its path in the outline of that source */
    int steps;       /* for a sequence: registry reference, see JoxNode; else 0 */
    /* Defaults that no machine around it sets; UNSET: it has none. */
    bool is_set[JOX_PARAM_COUNT]; /* by it or a machine around it */
    JoxValue defaults[JOX_PARAM_COUNT];
} JoxNested;

/* The machine under construction. */
typedef struct JoxBuild {
    JoxScript *script;
    const JoxSource *source;
    JoxMachine *machine;
    struct JoxKinds *kinds; /* kinds of the script's expressions, made on first use */
    size_t expression_capacity, target_capacity, own_capacity, memory_capacity, counter_capacity,
        state_capacity, name_capacity, sighting_capacity, outer_capacity, nested_capacity,
        renamed_capacity;
    bool scores_places; /* that target is a place */
    bool scores;       /* the score of a target is being compiled, in which `other` has a meaning */
    JoxNested *nested; /* item 0: the behaviour's own machine */
    uint32_t nested_count;
    uint32_t *state_nested, *outer_nested; /* per state and outer state: the machine that has it */
    size_t state_nested_capacity, outer_nested_capacity;
    /* What clocks and names of own values mean at present: machine, and level of the outer state
       that is read, -1: a state without `runs`. `scope` numbers these. */
    uint32_t nest;
    int32_t level;
    uint32_t scope;
} JoxBuild;
/* Returns the index of a target in the machine, added on first use; -1 for an error node. */
int16_t jox_build_target(JoxBuild *build, const JoxNode *node);
/* Returns the index of a name of a signal, state, machine or memory, added on first use. */
int16_t jox_build_name(JoxBuild *build, const char *name, JoxNameUse use);
/* Does the same, and keeps the first place that uses it. */
int16_t jox_build_name_at(JoxBuild *build, const char *text, JoxNameUse use, JoxPosition at);
/* Returns the number of the source with this path; 0 if there is none. */
uint32_t jox_build_source(const JoxBuild *build, const char *file);
/* Returns the slot of an own value, added on first use; a name of "" adds a new one. */
int32_t jox_build_own(JoxBuild *build, const char *name);
/* Returns the slot of an own value that an expression uses, and keeps where it is first used. */
int32_t jox_build_own_at(JoxBuild *build, const JoxNode *node);
/* Returns the slot of memory, added on first use; a name of "" adds a new one. */
int32_t jox_build_memory(JoxBuild *build, const char *name);
/* Adds a hidden slot of memory, with the identity `role` and the name of what it is for. Returns
   it. */
int32_t jox_build_hidden(JoxBuild *build, const char *role, const char *of, JoxMemoryKind kind);
/* Returns JoxSteerTerm.lead of the next term of a state, with this target. */
uint32_t jox_build_lead(JoxBuild *build, const JoxState *state, const JoxTarget *target);
/* Compiles an expression; returns its index, or -1 with an error at `position`. */
int32_t jox_build_expression(JoxBuild *build, const JoxNode *node, JoxPosition position);
/* Reports an error in the machine. */
void jox_build_error(JoxBuild *build, JoxPosition position, const char *code, const char *hint,
                     const char *format, ...) __attribute__((format(printf, 5, 6)));

/* Applies the patches of the scope's mods to the machine on top of the stack; false with
   diagnostics. */
bool jox_patch_behaviour(JoxScript *script);
/* Builds script->built from the value on top of the stack; errors go to the diagnostics. */
void jox_build(JoxScript *script, const JoxSource *source);

/* Returns the position of a path as "states.Circle.2.when". */
JoxPosition jox_read_at(JoxBuild *build, const char *path);
/* Returns the line of a path, and the number of its source. */
int32_t jox_read_line(JoxBuild *build, const char *path, uint16_t *source);
/* Returns the tokens of a path's value and their source; NULL if the file does not write it out. */
const JoxPath *jox_read_span(const JoxBuild *build, const char *path, const JoxSource **source);
/* Finds Lua operators and tests on values of the language in all files of the script; reports those
   that are certain. In misuse.c. */
void jox_misuse_find(JoxBuild *build);
/* Reports uncertain misuse within the value at a path; returns whether any misuse there was
   reported, which explains why the value is wrong. */
bool jox_misuse_explains(JoxBuild *build, const char *path);
/* Reports writes of functions into copies of lists in memory. */
void jox_list_copies_find(JoxBuild *build);
/* Returns the slot of memory of a name, or -1. */
int32_t jox_read_memory(const JoxBuild *build, const char *name);
/* Reads `counts` of the table at `index`, for `state` as in JoxCounter. */
void jox_read_counts(JoxBuild *build, int index, const char *prefix, int32_t state);
/* Reads `set`, `signal` and `tell` of the table at `index`; `every` NULL: the signal takes no
   interval. */
void jox_read_actions(JoxBuild *build, int index, const char *path, JoxActions *actions,
                      double *every);
/* Reads tell = { whom, "name", VALUE = number or target, ... }. */
void jox_read_tell(JoxBuild *build, int index, const char *path, JoxActions *actions);
/* Reads kick, take, throw, grasp and become of a state. */
void jox_read_body_actions(JoxBuild *build, int index, const char *path, JoxState *state);
/* nest_states.c: finds all states of a machine and of those that its states run; adds them without
   content. */
void jox_nest_collect(JoxBuild *build, const JoxNode *machine);
/* nest.c: reads the content of all states, and what nested machines say for all of theirs. */
void jox_nest_read(JoxBuild *build);
/* nest_names.c. */
void jox_nest_free(JoxBuild *build);
/* Returns the machine whose table encloses a path, with the rest of the path; the behaviour's own
   if no state runs one there. */
const JoxNested *jox_nest_enclosing(const JoxBuild *build, const char *path, const char **rest);
/* Writes the whole name of a state that a machine calls `name`. */
void jox_nest_name(const JoxBuild *build, uint32_t nested, const char *name, char whole[256]);
/* Returns the own slot of a parameter's default in the present scope, or -1. */
int32_t jox_nest_own(const JoxBuild *build, const char *name);
/* Gives every parameter an own value of its name. In defaults.c. */
void jox_read_parameter_values(JoxBuild *build);
/* Reads `defaults` of the machine's table at `index` and `path`. In defaults.c. */
void jox_read_defaults(JoxBuild *build, int index, const char *path, uint32_t nested);
/* Warns of parts of the machine that have no effect. In lint.c. */
void jox_lint(JoxBuild *build);
/* Warns of memory that is read and never set, and of messages read where none is asked for. In
   lint_memory.c. */
void jox_lint_memory(JoxBuild *build);
/* Read `own` and `public` of the machine's table at `index` and `path`. In declare.c. */
void jox_read_own(JoxBuild *build, int index, const char *path);
void jox_read_public(JoxBuild *build, int index, const char *path);
/* Writes the id of the transition table at `index`; `nth` numbers equal ids: "Exit", "Exit#2". */
void jox_read_id(lua_State *L, int index, int nth, char id[128]);
/* Joins a path and a key with a dot. */
void jox_read_join(char path[256], const char *prefix, const char *key);
/* Writes the path of an item, in the table of the state that lists it. */
void jox_read_item_path(const JoxMachine *machine, const JoxState *state, const JoxTransition *item,
                        char path[256]);
/* Pushes table[key] by raw access and returns its type. */
int jox_read_field(lua_State *L, int index, const char *key);
/* Reports string keys of a table that are not known; other keys too, unless `items`. */
void jox_read_check(JoxBuild *build, int index, const char *path, const char *const *known,
                    size_t count, bool items);
/* Returns whether a value is a function, or functions of mods that extend what stands there. */
bool jox_read_is_function(lua_State *L, int index);
/* Adds hooks for the function on top of the stack, popped, and for all that it extends; returns the
   number of the one to call. `path` names it in messages. If the lowest one extends no function,
   *extends is its number and the value that it extends (nil: none) is pushed; else *extends is
   -1. */
int32_t jox_read_function(JoxBuild *build, const char *path, int32_t *extends);
/* Reports a failure of a function at a line of the source that failed last; counts and suspends. */
void jox_hook_report_failure(JoxLua *lua, JoxScript *script, JoxHook *hook, const char *why,
                             int line);
/* Returns the registry reference of the function that hook `number`, which extends another one by
   `around`, is passed to call that. In hook_calls.c. */
int jox_hook_make_previous(JoxScript *script, int32_t number);
/* Reads a function under a key; returns its hook number or -1. */
int32_t jox_read_hook(JoxBuild *build, int index, const char *path, const char *key);
/* Reads a number, distribution or expression, popped, and checks its range; a distribution goes to
   dist. */
JoxValue jox_read_value(JoxBuild *build, const char *path, const JoxParameterInfo *info,
                        bool *is_dist, JoxDist *dist);
/* Reads a value as jox_read_value does; a distribution is drawn once per agent into an own value.
 */
JoxValue jox_read_parameter(JoxBuild *build, const char *path, const JoxParameterInfo *info);
/* Compiles the condition on top of the stack, popped; returns its expression or -1. A function
   becomes *hook, if `hook` is not NULL. */
int32_t jox_read_condition(JoxBuild *build, const char *path, int32_t *hook);
/* Reads a target under a key, a place's name or a target value; returns its index or -1. */
int16_t jox_read_target(JoxBuild *build, int index, const char *path, const char *key);
/* Reports the target of a key, -1: none, if it is a place where a body or an agent is wanted. */
void jox_read_check_moves(JoxBuild *build, const char *path, const char *key, int16_t target);
/* Reads a target under a key that is a body or an agent; returns its index or -1. */
int16_t jox_read_mover(JoxBuild *build, int index, const char *path, const char *key);
/* Returns the bits of a tag or list of tags, which are given to agents (`is_set`) or asked for. */
uint64_t jox_read_tags(JoxBuild *build, int index, const char *path, const char *key, bool is_set);
/* Reads the table at `index` into a state whose name is set; `number` as JoxCounter.state. */
void jox_read_state(JoxBuild *build, int index, JoxState *state, int32_t number);

/* Records where a transition of the state at `path` is written, by its number, unless that is
   known: in the behaviour's file, or in that of a mod that wrote the whole state. */
void jox_origin_keep(JoxScript *script, const char *path, const char *number,
                     const char *canonical);
#endif
