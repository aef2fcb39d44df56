/* What testing.c (running tests) and scene.c (what a test says) share. */
#ifndef JOX_LUATEST_INTERNAL_H
#define JOX_LUATEST_INTERNAL_H

#include "lua/language/script.h"
#include "luatest/testing.h"

typedef struct JoxTest {
    char *name;
    int line, function; /* registry reference */
} JoxTest;

/* One test file while it runs. */
typedef struct JoxTestRun {
    const JoxTestDriver *driver;
    const char *path;
    JoxTest *tests;
    uint32_t test_count;
    size_t test_capacity;
    bool running;
    uint64_t assertions, failures; /* failures: of assertions, also where a pcall swallowed them */
    double simulated, stepping;    /* s, of the present test; stepping: processor time */
    JoxText yaml;                  /* of the scene that is being made */
} JoxTestRun;

JoxTestRun *jox_test_run_of(lua_State *L);
/* equal, near, truthy, fails */
extern const luaL_Reg jox_test_assertions[];
/* Adds the words of a test to the table on top of the stack. */
void jox_test_scene_words(lua_State *L);
/* Appends the table at `index` as a YAML scene (JSON is YAML). Raises errors. */
void jox_test_scene_yaml(lua_State *L, JoxTestRun *run, int index, JoxText *out);

/* Texts of a list, or "KEY=VALUE" of a table, kept by the Lua table that is pushed; returns how
   many. */
size_t jox_test_read_texts(lua_State *L, int index, const char *name, bool pairs,
                           const char *out[64]);

/* Present speed, m/s. */
double jox_test_speed(const JoxAgents *agents, uint32_t i);
void jox_test_set_number(lua_State *L, const char *name, double value);
/* Pushes a table with all of an agent. */
void jox_test_push_agent(lua_State *L, const JoxMachineRun *machines, uint32_t i);

#endif
