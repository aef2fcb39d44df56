/* Runs test files of behaviours, written in Lua. The runner knows scenes by a driver alone, which
   run_tests.c implements for the command `jostle test`. */
#ifndef JOX_LUATEST_TEST_FILE_H
#define JOX_LUATEST_TEST_FILE_H

#include "lua/loader.h"

/* A scene that a test asks for. */
typedef struct JoxTestScene {
    const char *text; /* YAML; NULL: the file `path` has the scene */
    size_t length;
    const char *path; /* scene's file; with `text`, the test's file: paths are relative to it */
    const char *const *sets, *const *mods; /* overrides "KEY=VALUE"; names of mods */
    size_t set_count, mod_count;
    bool has_seed, has_dt;
    uint64_t seed;
    double dt;
    uint32_t threads;
} JoxTestScene;

/* A question about agents: why they stay in their states. */
typedef struct JoxTestQuestion {
    int64_t agent;                  /* id; -1: all that the next members mean */
    const char *group, *state, *to; /* as in JoWhyDef; NULL: any */
} JoxTestQuestion;

/* Functions by which tests reach scenes; `scene` is a handle that `load` returned, `context` the
   member below. */
typedef struct JoxTestDriver {
    /* Loads a scene; NULL with the errors appended to `why`. */
    void *(*load)(void *context, const JoxTestScene *scene, JoxText *why);
    void (*free)(void *context, void *scene);
    bool (*step)(void *context, void *scene, JoxText *why);
    const JoxMachineRun *(*machines)(void *context, void *scene);
    double (*time)(void *context, void *scene);                     /* simulated time, s */
    uint64_t (*hash)(void *context, void *scene);                   /* hash of the world's state */
    int32_t (*group)(void *context, void *scene, const char *name); /* index, or -1 */
    /* Position (m) and velocity (m/s) of a body by name, x y z each; false if there is none. */
    bool (*body)(void *context, void *scene, const char *name, double out[6]);
    /* Appends the answer to a question, or what is wrong with it: then returns false. */
    bool (*why)(void *context, void *scene, const JoxTestQuestion *question, JoxText *out);
    const char *(*group_name)(void *context, void *scene, int32_t group); /* NULL for -1 */
    /* Name of a team by its number; NULL for 0, and for teams of parties. */
    const char *(*team_name)(void *context, void *scene, uint16_t team);
    /* Writes the text of a behaviour that a test contains to a file; returns its path, valid until
       the tests end, or NULL. */
    const char *(*keep)(void *context, const char *text, size_t length);
    void *context;
} JoxTestDriver;

typedef struct JoxTestResult {
    const char *file, *name, *message; /* message: the failure; "" if passed */
    int line;
    bool passed;
    double simulated, seconds; /* simulated time, processor time, s */
} JoxTestResult;
/* Called with the result of each test. */
typedef void JoxTestReport(void *context, const JoxTestResult *result);

/* Runs the tests of a file whose names contain `only` (NULL: all), and reports each. False with
   diagnostics if the file cannot be read or run. `out` receives the output of `print` in tests. */
bool jox_lua_test(const char *path, const char *only, const JoxTestDriver *driver,
                  JoxTestReport *report, void *context, JoxLuaComplain *out, void *out_context,
                  JoxDiagnostics *diagnostics);

#endif
