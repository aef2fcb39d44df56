/* What build.c (the machine) and state.c (its states) share. */
#ifndef JOX_LUA_READ_H
#define JOX_LUA_READ_H

#include "lua/language/script.h"

/* The machine under construction. */
typedef struct JoxBuild {
    JoxScript *script;
    const JoxSource *source;
    JoxMachine *machine;
    struct JoxKinds *kinds; /* of the script's files; made on first use */
    size_t expression_capacity, target_capacity, own_capacity, memory_capacity, counter_capacity,
        state_capacity, name_capacity;
} JoxBuild;
int16_t jox_build_target(JoxBuild *build, const JoxNode *node);
/* Index of a name that machines share. */
int16_t jox_build_name(JoxBuild *build, const char *name, JoxNameUse use);
int32_t jox_build_own(JoxBuild *build, const char *name);
/* The same for an own value that was written out: keeps where. */
int32_t jox_build_own_at(JoxBuild *build, const JoxNode *node);
int32_t jox_build_memory(JoxBuild *build, const char *name);
int32_t jox_build_expression(JoxBuild *build, const JoxNode *node, JoxPosition position);
void jox_build_error(JoxBuild *build, JoxPosition position, const char *code, const char *hint,
                     const char *format, ...) __attribute__((format(printf, 5, 6)));

/* Runs the patches that the scope's mods have for the machine on top of the stack, and puts the
   changed one in its place. False with diagnostics. */
bool jox_patch_behaviour(JoxScript *script);
/* Makes script->built of the machine on top of the stack; what is wrong goes to the diagnostics. */
void jox_build(JoxScript *script, const JoxSource *source);

/* Position of a path in the source: "states.Circle.2.when". */
JoxPosition jox_read_at(JoxBuild *build, const char *path);
/* The line of that, and the number of its file. */
int32_t jox_read_line(JoxBuild *build, const char *path, uint16_t *source);
/* The tokens of a path's value, and the source they are in; NULL where it is not written out. */
const JoxPath *jox_read_span(const JoxBuild *build, const char *path, const JoxSource **source);
/* misuse.c: finds where Lua's own operators and tests decide by values of the language, in all
   files of the script, and reports what is certain. */
void jox_misuse_find(JoxBuild *build);
/* Reports what is uncertain in the condition at a path; whether any misuse explains what is wrong
   with it. */
bool jox_misuse_explains(JoxBuild *build, const char *path);
/* Slot of a name in memory, or -1. */
int32_t jox_read_memory(const JoxBuild *build, const char *name);
/* Reads the `counts` of the table at `index`, for one state or, with -1, for all. */
void jox_read_counts(JoxBuild *build, int index, const char *prefix, int32_t state);
/* Reads `set` and `signal` of the table at `index`. */
void jox_read_actions(JoxBuild *build, int index, const char *path, JoxActions *actions,
                      double *every);
/* kick, take, throw and become of a state. */
void jox_read_body_actions(JoxBuild *build, int index, const char *path, JoxState *state);
/* lint.c: warns of what of a whole machine is of no use. */
void jox_lint(JoxBuild *build);
/* declare.c: reads `own` and `public` of the machine's table at `index`. */
void jox_read_own(JoxBuild *build, int index);
void jox_read_public(JoxBuild *build, int index);
/* Id of the transition table at `index`, number `nth` of its id: "Exit", "Exit#2". */
void jox_read_id(lua_State *L, int index, int nth, char id[128]);
/* Joins a path and a key. */
void jox_read_join(char path[256], const char *prefix, const char *key);
/* Pushes table[key] by raw access; its type. */
int jox_read_field(lua_State *L, int index, const char *key);
/* Reports string keys of a table that are not known; with `items`, numbers are fine. */
void jox_read_check(JoxBuild *build, int index, const char *path, const char *const *known,
                    size_t count, bool items);
/* Hook number of a function, taken from the stack; `path` says what it is. */
int32_t jox_read_add_hook(JoxBuild *build, const char *path);
int32_t jox_read_hook(JoxBuild *build, int index, const char *path, const char *key);
/* A number, distribution or expression, popped; a distribution goes to *dist. */
JoxValue jox_read_value(JoxBuild *build, const char *path, const JoxParameterInfo *info,
                        bool *is_dist, JoxDist *dist);
/* The same where a distribution is drawn once per agent, into a slot of its own. */
JoxValue jox_read_parameter(JoxBuild *build, const char *path, const JoxParameterInfo *info);
/* A condition, compiled: the index of its expression, -1 for none; a function becomes *hook where
 * `hook` is given. Popped. */
int32_t jox_read_condition(JoxBuild *build, const char *path, int32_t *hook);
/* A target named by a key, or -1. */
int16_t jox_read_target(JoxBuild *build, int index, const char *path, const char *key);
/* The bits of a tag or a list of tags, which agents get (`is_set`) or are asked for. */
uint64_t jox_read_tags(JoxBuild *build, int index, const char *path, const char *key, bool is_set);
/* Fills a state, whose name is set, from the table at `index`. */
void jox_read_state(JoxBuild *build, int index, JoxState *state, int32_t number);

/* Keeps where the transition with this number in the state at `path` stands, unless that is known:
   in the behaviour's file, or in that of a mod that wrote the whole state. */
void jox_origin_keep(JoxScript *script, const char *path, const char *number,
                     const char *canonical);
#endif
