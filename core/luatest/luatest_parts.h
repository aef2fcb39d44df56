/* Shared by the files of luatest: the running test file, and the functions that make its tables and
   texts. test_file.c owns a JoxTestRun; the functions of tests find it by jox_test_run_of. */
#ifndef JOX_LUATEST_LUATEST_PARTS_H
#define JOX_LUATEST_LUATEST_PARTS_H

#include "lua/language/script.h"
#include "luatest/test_file.h"

/* A test that a file has registered. */
typedef struct JoxTest {
    char *name;
    int line, function; /* line of its `test`; reference of its function in Lua's registry */
} JoxTest;

/* A test file while it runs. */
typedef struct JoxTestRun {
    const JoxTestDriver *driver;
    const char *path;
    JoxTest *tests;
    uint32_t test_count;
    size_t test_capacity;
    bool running;                  /* a test is running, and not the file's own code */
    uint64_t assertions, failures; /* number in the present test; failures count even in a pcall */
    double simulated, stepping;    /* simulated and processor time of the present test, s */
    JoxText yaml;                  /* text of the scene that is being loaded */
    void *last;                    /* the driver's handle of the scene that was used last, or NULL;
                                      a failure says what its agents wait for */
    const char *wanted;            /* state that agents did not reach, or NULL; and their group */
    int32_t wanted_group;
} JoxTestRun;

/* Returns the test file that runs in a Lua state. */
JoxTestRun *jox_test_run_of(lua_State *L);
/* The functions equal, near, truthy and fails of tests. */
extern const luaL_Reg jox_test_assertions[];
/* Adds all functions of tests, except `test`, to the table on top of the stack. */
void jox_test_scene_words(lua_State *L);
/* Appends the table at `index` as a YAML scene (JSON is YAML). Raises errors in Lua. */
void jox_test_scene_yaml(lua_State *L, JoxTestRun *run, int index, JoxText *out);

/* Returns a number of the options table at `index`, or `standard` if it is absent; likewise a text,
   or NULL. Raise errors in Lua. */
double jox_test_number_option(lua_State *L, int index, const char *name, double standard);
const char *jox_test_text_option(lua_State *L, int index, const char *name);
/* Raises an error if the options table at `index` has a key that is not known. */
void jox_test_check_options(lua_State *L, int index, const char *const *known, size_t count);

/* Reads the option `name` of the table at `index`: a list of texts, or (`pairs`) a table as texts
   "KEY=VALUE", sorted. Returns their number, and pushes a table that keeps the texts alive. Raises
   errors in Lua. */
size_t jox_test_read_texts(lua_State *L, int index, const char *name, bool pairs,
                           const char *out[64]);

/* Returns the argument at `index`, which must be the name of a state of some machine. Raises an
   error in Lua if none has it. In state_counts.c. */
const char *jox_test_check_state(lua_State *L, const JoxMachineRun *machines, int index);
/* Counts the agents of a group (-1: of all) in a state (NULL: in any). */
uint32_t jox_test_count_in_state(const JoxMachineRun *machines, const char *state, int32_t group);
/* Returns how many agents of a group (-1: of all) have a machine without a state of this name. */
uint32_t jox_test_count_without(const JoxMachineRun *machines, const char *state, int32_t group);
/* Pushes the number of agents in each state, "Walk 3, Rest 2". */
void jox_test_push_counts(lua_State *L, const JoxMachineRun *machines, int32_t group);

/* Present speed of an agent, m/s. */
double jox_test_speed(const JoxAgents *agents, uint32_t i);
/* Sets a field of the table on top of the stack. */
void jox_test_set_number(lua_State *L, const char *name, double value);
/* Pushes a table with the state of an agent: parameters, memory, position, ... It is a copy. */
void jox_test_push_agent(lua_State *L, const JoxTestDriver *driver, void *scene, uint32_t i);

#endif
