/* The runner: a test file registers its tests, each is called under a budget of its own. */
#include "luatest/testing.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

#include "base/mem.h"
#include "luatest/trial.h"

enum { MOST_TESTS = 1000 };
static const uint64_t BUDGET = 1000000000; /* instructions of a test */

JoxTrial *jox_trial_of(lua_State *L) {
    lua_getfield(L, LUA_REGISTRYINDEX, "jostle trial");
    JoxTrial *trial = lua_touserdata(L, -1);
    lua_pop(L, 1);
    return trial;
}

double jox_trial_clock(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* test("name", function() ... end) */
static int word_test(lua_State *L) {
    JoxTrial *trial = jox_trial_of(L);
    luaL_checktype(L, 1, LUA_TSTRING);
    luaL_checktype(L, 2, LUA_TFUNCTION);
    if (trial->running)
        return luaL_error(L, "tests stand side by side, not within each other");
    if (trial->test_count >= MOST_TESTS)
        return luaL_error(L, "a file has at most %d tests", MOST_TESTS);
    JOX_RESERVE(trial->tests, trial->test_capacity, trial->test_count + 1);
    JoxTest *test = &trial->tests[trial->test_count++];
    *test = (JoxTest){.name = jox_strdup(lua_tostring(L, 1)), .line = jox_vm_place(L).line};
    jox_text_clean(test->name);
    lua_pushvalue(L, 2);
    test->function = luaL_ref(L, LUA_REGISTRYINDEX);
    return 0;
}

static void run_one(JoxVm *vm, JoxTrial *trial, JoxTest *test, JoxTestReport *report,
                    void *context) {
    const char *path = vm->sources[0].path, *why = NULL;
    JoxText message = {0};
    int line = 0;
    trial->assertions = 0;
    trial->simulated = trial->stepping = 0.0;
    trial->failures = 0;
    double begun = jox_trial_clock();
    lua_rawgeti(vm->L, LUA_REGISTRYINDEX, test->function);
    trial->running = true;
    bool good = jox_vm_call(vm, 0, 0, BUDGET, &why, &line);
    trial->running = false;
    if (!good)
        jox_text_printf(&message, "%s:%d: %s\n%s", path, line ? line : test->line, why,
                        vm->traceback);
    else if (trial->assertions == 0)
        jox_text_printf(&message, "%s:%d: this test asserts nothing\n", path, test->line);
    else if (trial->failures > 0)
        jox_text_printf(&message, "%s:%d: an assertion failed within a pcall\n", path, test->line);
    JoxTestResult result = {.file = path,
                            .name = test->name,
                            .message = message.data ? message.data : "",
                            .line = line ? line : test->line,
                            .passed = message.length == 0,
                            .simulated = trial->simulated,
                            .seconds = jox_trial_clock() - begun};
    report(context, &result);
    jox_text_free(&message);
    lua_settop(vm->L, 0);
    lua_gc(vm->L, LUA_GCCOLLECT); /* scenes are freed with their handles */
}

/* The words of a test file in place of those of sheets. */
static int open_words(lua_State *L) {
    static const luaL_Reg WORDS[] = {{"test", word_test}, {NULL, NULL}};
    lua_newtable(L);
    luaL_setfuncs(L, WORDS, 0);
    jox_trial_open(L);
    lua_setfield(L, LUA_REGISTRYINDEX, "jostle words");
    return 0;
}

static void fail_file(JoxVm *vm, const char *why, int line, JoxDiagnostics *diagnostics) {
    jox_diag_error(diagnostics, ((JoxPosition){vm->sources[0].path, line, 0, 0}), "lua-error", NULL,
                   "%s", why);
    jox_diag_attach_source(diagnostics, vm->sources[0].path, vm->sources[0].text,
                           vm->sources[0].length);
}

static bool run_file(JoxVm *vm, const char *path, JoxTrial *trial, const char *only,
                     JoxTestReport *report, void *context, JoxDiagnostics *diagnostics) {
    const char *why = NULL;
    int line = 0;
    vm->untimed = true;
    vm->diagnostics = diagnostics;
    if (!jox_vm_read(vm, path, NULL, 0, (JoxPosition){0}))
        return false;
    vm->diagnostics = NULL;
    lua_pushlightuserdata(vm->L, trial);
    lua_setfield(vm->L, LUA_REGISTRYINDEX, "jostle trial");
    lua_pushcfunction(vm->L, open_words);
    bool good = jox_vm_call(vm, 0, 0, BUDGET, &why, &line);
    if (good && !jox_source_compile(vm, 0)) {
        int used = 0, number;
        const char *text = lua_tostring(vm->L, -1);
        if (text && sscanf(text, "b%d:%d: %n", &number, &line, &used) == 2)
            text += used;
        fail_file(vm, text ? text : "not enough memory", line, diagnostics);
        return false;
    }
    static const JoxScope NO_SCOPE = {0};
    vm->scope = &NO_SCOPE;
    vm->loading = true; /* require works */
    vm->diagnostics = diagnostics;
    const size_t errors = diagnostics->errors;
    good = good && jox_vm_call(vm, 0, 0, BUDGET, &why, &line);
    vm->loading = false;
    vm->diagnostics = NULL;
    if (good && diagnostics->errors > errors) { /* a word of the file that means nothing */
        for (size_t s = 0; s < vm->source_count; s++)
            jox_diag_attach_source(diagnostics, vm->sources[s].path, vm->sources[s].text,
                                   vm->sources[s].length);
        return false;
    }
    if (!good) {
        fail_file(vm, why, line, diagnostics);
        return false;
    }
    for (uint32_t t = 0; t < trial->test_count; t++)
        if (!only || strstr(trial->tests[t].name, only))
            run_one(vm, trial, &trial->tests[t], report, context);
    return true;
}

bool jox_lua_test(const char *path, const char *only, const JoxTestDriver *driver,
                  JoxTestReport *report, void *context, JoxLuaComplain *out, void *out_context,
                  JoxDiagnostics *diagnostics) {
    JoxLua *lua = jox_lua_create(NULL);
    lua->complain = out;
    lua->complain_context = out_context;
    JoxVm *vm = jox_vm_create(lua);
    JoxTrial trial = {.driver = driver, .path = path};
    bool good = vm && run_file(vm, path, &trial, only, report, context, diagnostics);
    if (!vm)
        jox_diag_error(diagnostics, ((JoxPosition){path, 0, 0, 0}), "lua-error", NULL,
                       "no memory for a Lua state");
    jox_vm_free(vm);
    for (uint32_t t = 0; t < trial.test_count; t++)
        jox_free(trial.tests[t].name);
    jox_free(trial.tests);
    jox_text_free(&trial.yaml);
    jox_lua_free(lua);
    return good;
}
