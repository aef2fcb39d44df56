/* Runs a test file: its code registers tests, which are then called one by one, each with its own
   budget of instructions. */
#include "luatest/test_file.h"

#include <string.h>

#include "base/clock.h"
#include "base/mem.h"
#include "luatest/luatest_parts.h"

enum { MOST_TESTS = 1000 };
static const uint64_t BUDGET = 1000000000; /* instructions of Lua that a test may execute */

/* test("name", function() ... end) */
static int word_test(lua_State *L) {
    JoxTestRun *run = jox_test_run_of(L);
    luaL_checktype(L, 1, LUA_TSTRING);
    luaL_checktype(L, 2, LUA_TFUNCTION);
    if (run->running)
        return luaL_error(L, "a test cannot contain another test");
    if (run->test_count >= MOST_TESTS)
        return luaL_error(L, "a file has at most %d tests", MOST_TESTS);
    JOX_RESERVE(run->tests, run->test_capacity, run->test_count + 1);
    JoxTest *test = &run->tests[run->test_count++];
    *test = (JoxTest){.name = jox_strdup(lua_tostring(L, 1)), .line = jox_vm_place(L).line};
    jox_text_clean(test->name);
    lua_pushvalue(L, 2);
    test->function = luaL_ref(L, LUA_REGISTRYINDEX);
    return 0;
}

/* Appends what the agents of the scene that was used last wait for, in at most MOST_LINES lines:
   what keeps them from the state that they did not reach, if the test asked for that. */
static void explain_failure(const JoxTestRun *run, JoxText *message) {
    enum { MOST_LINES = 30 };
    const JoxTestDriver *driver = run->driver;
    if (!run->last || driver->machines(driver->context, run->last)->agents->count > 1000)
        return;
    const JoxTestQuestion question = {
        .agent = -1,
        .to = run->wanted,
        .group =
            run->wanted ? driver->group_name(driver->context, run->last, run->wanted_group) : NULL};
    JoxText why = {0};
    driver->why(driver->context, run->last, &question, &why);
    jox_text_add(message, "what its agents wait for (s:why tells more):\n");
    const char *line = why.data;
    for (int n = 0; line && *line && n < MOST_LINES; n++) {
        const size_t length = strcspn(line, "\n");
        jox_text_printf(message, "  %.*s\n", (int)length, line);
        line += length + (line[length] == '\n');
    }
    jox_text_add(message, line && *line ? "  ...\n" : "");
    jox_text_free(&why);
}

/* Calls a test and reports its result. It fails by an error, by an assertion that failed within a
   pcall, or by having no assertions. */
static void run_registered_test(JoxScript *script, JoxTestRun *run, JoxTest *test,
                                JoxTestReport *report, void *context) {
    const char *path = script->vm.sources[0]->path, *why = NULL;
    JoxText message = {0};
    int line = 0;
    run->assertions = 0;
    run->simulated = run->stepping = 0.0;
    run->failures = 0;
    run->last = NULL;
    run->wanted = NULL;
    double begun = jox_clock_thread();
    lua_rawgeti(script->vm.L, LUA_REGISTRYINDEX, test->function);
    run->running = true;
    bool good = jox_vm_call(&script->vm, 0, 0, BUDGET, &why, &line);
    run->running = false;
    if (!good)
        jox_text_printf(&message, "%s:%d: %s\n%s", path, line ? line : test->line, why,
                        script->vm.traceback);
    else if (run->assertions == 0)
        jox_text_printf(&message, "%s:%d: this test asserts nothing\n", path, test->line);
    else if (run->failures > 0)
        jox_text_printf(&message, "%s:%d: an assertion failed within a pcall\n", path, test->line);
    if (message.length)
        explain_failure(run, &message);
    JoxTestResult result = {.file = path,
                            .name = test->name,
                            .message = message.data ? message.data : "",
                            .line = line ? line : test->line,
                            .passed = message.length == 0,
                            .simulated = run->simulated,
                            .seconds = jox_clock_thread() - begun};
    report(context, &result);
    jox_text_free(&message);
    lua_settop(script->vm.L, 0);
    lua_gc(script->vm.L, LUA_GCCOLLECT); /* frees the test's scenes */
}

/* Gives the Lua state the functions of tests in place of those of behaviours. */
static int open_words(lua_State *L) {
    static const luaL_Reg WORDS[] = {{"test", word_test}, {NULL, NULL}};
    lua_newtable(L);
    luaL_setfuncs(L, WORDS, 0);
    jox_test_scene_words(L);
    jox_script_set_words(L);
    return 0;
}

/* Adds an error in the test file itself. */
static void fail_file(JoxScript *script, const char *why, int line, JoxDiagnostics *diagnostics) {
    jox_diag_error(diagnostics, ((JoxPosition){script->vm.sources[0]->path, line, 0, 0}),
                   "lua-error", NULL, "%s", why);
    jox_diag_attach_source(diagnostics, script->vm.sources[0]->path, script->vm.sources[0]->text,
                           script->vm.sources[0]->length);
}

static bool run_tests_of_file(JoxScript *script, const char *path, JoxTestRun *run,
                              const char *only, JoxTestReport *report, void *context,
                              JoxDiagnostics *diagnostics) {
    const char *why = NULL;
    int line = 0;
    script->vm.untimed = true;
    script->diagnostics = diagnostics;
    if (!jox_script_read(script, path, NULL, 0, (JoxPosition){0}))
        return false;
    script->diagnostics = NULL;
    lua_pushlightuserdata(script->vm.L, run);
    lua_setfield(script->vm.L, LUA_REGISTRYINDEX, "jostle test run");
    lua_pushcfunction(script->vm.L, open_words);
    bool good = jox_vm_call(&script->vm, 0, 0, BUDGET, &why, &line);
    if (good && !jox_vm_compile(&script->vm, 0)) {
        const char *text = lua_tostring(script->vm.L, -1);
        size_t source;
        if (text)
            text = jox_vm_split(&script->vm, text, &line, &source);
        fail_file(script, text ? text : "not enough memory", line, diagnostics);
        return false;
    }
    static const JoxScope NO_SCOPE = {0};
    script->scope = &NO_SCOPE;
    script->vm.loading = true; /* `require` is allowed */
    script->diagnostics = diagnostics;
    const size_t errors = diagnostics->errors;
    good = good && jox_vm_call(&script->vm, 0, 0, BUDGET, &why, &line);
    script->vm.loading = false;
    script->diagnostics = NULL;
    if (good && diagnostics->errors > errors) { /* the file uses a name that does not exist */
        for (size_t s = 0; s < script->vm.source_count; s++)
            jox_diag_attach_source(diagnostics, script->vm.sources[s]->path,
                                   script->vm.sources[s]->text, script->vm.sources[s]->length);
        return false;
    }
    if (!good) {
        fail_file(script, why, line, diagnostics);
        return false;
    }
    for (uint32_t t = 0; t < run->test_count; t++)
        if (!only || strstr(run->tests[t].name, only))
            run_registered_test(script, run, &run->tests[t], report, context);
    return true;
}

bool jox_lua_test(const char *path, const char *only, const JoxTestDriver *driver,
                  JoxTestReport *report, void *context, JoxLuaComplain *out, void *out_context,
                  JoxDiagnostics *diagnostics) {
    JoxLua *lua = jox_lua_create(NULL);
    lua->group.say = out;
    lua->group.say_context = out_context;
    JoxScript *script = jox_script_create(lua);
    JoxTestRun run = {.driver = driver, .path = path};
    bool good = script && run_tests_of_file(script, path, &run, only, report, context, diagnostics);
    if (!script)
        jox_diag_error(diagnostics, ((JoxPosition){path, 0, 0, 0}), "lua-error", NULL,
                       "no memory for a Lua state");
    jox_script_free(script);
    for (uint32_t t = 0; t < run.test_count; t++)
        jox_free(run.tests[t].name);
    jox_free(run.tests);
    jox_text_free(&run.yaml);
    jox_lua_free(lua);
    return good;
}
