/* Tests of behaviours, written in Lua: the words of a test file, and running its tests. */
#ifndef JOX_LUATEST_TESTING_H
#define JOX_LUATEST_TESTING_H

#include "lua/loader.h"

/* What a test asks of a scene; test.c implements it. Handles are its own. */
typedef struct JoxTestScene {
    const char *text; /* YAML, or NULL: the file `path` */
    size_t length;
    const char
        *path; /* of the scene's file, or of the test's, beside which behaviours are looked for */
    const char *const *sets, *const *mods;
    size_t set_count, mod_count;
    bool has_seed, has_dt;
    uint64_t seed;
    double dt;
    uint32_t threads;
} JoxTestScene;

typedef struct JoxTestDriver {
    /* NULL with what is wrong appended to `why`. */
    void *(*load)(void *context, const JoxTestScene *scene, JoxText *why);
    void (*free)(void *context, void *scene);
    bool (*step)(void *context, void *scene, JoxText *why);
    const JoxMachineRun *(*machines)(void *context, void *scene);
    double (*time)(void *context, void *scene); /* simulated, s */
    uint64_t (*hash)(void *context, void *scene);
    int32_t (*group)(void *context, void *scene, const char *name);
    /* Pose of a body by name: position and velocity, x y z; false if there is none. */
    bool (*body)(void *context, void *scene, const char *name, double out[6]);
    /* Keeps the text of a behaviour that stands in the test; its path, valid until the end. */
    const char *(*keep)(void *context, const char *text, size_t length);
    void *context;
} JoxTestDriver;

typedef struct JoxTestResult {
    const char *file, *name, *message; /* message: what failed; "" */
    int line;
    bool passed;
    double simulated, seconds; /* s; seconds of processor time */
} JoxTestResult;
typedef void JoxTestReport(void *context, const JoxTestResult *result);

/* Runs the tests of a file whose names contain `only` (NULL: all), and reports each. False with
   diagnostics if the file cannot be read or run. `out` receives what tests print. */
bool jox_lua_test(const char *path, const char *only, const JoxTestDriver *driver,
                  JoxTestReport *report, void *context, JoxLuaComplain *out, void *out_context,
                  JoxDiagnostics *diagnostics);

#endif
