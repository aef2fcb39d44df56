/* Assignments to upvalues: found in the source when a file loads, and by their values after a call.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "lua/language/script.h"

static JoxDiagnostics diagnostics;

static JoxScript *open_upvalue_script(JoxLua *lua) {
    static const JoxScope OPEN = {0};
    JoxScript *script = jox_script_create(lua);
    assert_non_null(script);
    script->scope = &OPEN;
    script->diagnostics = &diagnostics;
    script->vm.loading = true;
    return script;
}

typedef struct Assigned {
    const char *text; /* returns a function */
    const char *name; /* NULL: none */
    int line;
} Assigned;

/* Returns the token where the function that a text returns assigns an upvalue; NULL if none. */
static const JoxToken *find_assigned_upvalue(JoxScript *script, const char *text) {
    const char *why, *names[64];
    int line, count = 0, top;
    lua_Debug about;
    JoxSource *source = jox_script_read(script, "t.lua", text, strlen(text), (JoxPosition){0});
    assert_non_null(source);
    assert_int_equal(luaL_loadbufferx(script->vm.L, text, strlen(text), "=b3", "t"), LUA_OK);
    assert_true(jox_vm_call(&script->vm, 0, 1, 100000, &why, &line));
    top = lua_gettop(script->vm.L);
    for (; (names[count] = lua_getupvalue(script->vm.L, top, count + 1)); count++)
        lua_pop(script->vm.L, 1);
    lua_getinfo(script->vm.L, ">S", &about);
    assert_int_equal(about.short_src[1], '3');
    return jox_outline_assigned(source, about.linedefined, about.lastlinedefined, names,
                                (size_t)count);
}

static void assigned_upvalues_are_found(void **state) {
    (void)state;
    static const Assigned CASES[] = {
        {"local n = 0\nreturn function(me)\n n = n + 1\nend", "n", 3},
        {"local n = 0\nreturn function(me) local n = 0 n = n + 1 return n end", NULL, 0},
        {"local n = 0\nreturn function(me) return n + 1 end", NULL, 0},
        {"local n = 0\nreturn function(me) local n = (function() n = n + 1 return n end)() return "
         "n end",
         "n", 2},
        {"return function() local n = 0\n return function() n = n + 1 end end", NULL, 0},
        {"return function() local n = 0 return function() return function() n = 1 end end end",
         NULL, 0},
        {"local n\nreturn function() return function()\n n = 1 end end", "n", 3},
        {"local n\nreturn function() local x\n return function() x = 1\n return function() x = 2\n "
         "n = 1 end end end",
         "n", 5},
        {"local function make() local kept = 0 return function() kept = kept + 1\n return kept end "
         "end\nreturn make()",
         "kept", 1},
        {"local function make() local kept = 0 return function() kept = kept + 1 end end\n"
         "return function() return make() end",
         NULL, 0},
        {"local f\nreturn function()\n function f() end end", "f", 3},
        {"return function() local function f() return f() end return f end", NULL, 0},
        {"local a, b\nreturn function() local t = {}\n a, t.x = 1, 2 end", "a", 3},
        {"local a\nreturn function() for i = 1, 3 do\n a = i end end", "a", 3},
        {"local a = {}\nreturn function() a.x = 1 end", NULL, 0},
        {"local a\nreturn function() local t = {}\n t[a], t[1].x, a = 1, 2, 3 end", "a", 3},
        {"local a\nreturn function() local t = {a = 1, function() local a a = 2 end} end", NULL, 0},
        {"local a\nreturn function() local t = {b = {function()\n a = 2 end}} end", "a", 3},
        {"local a\nreturn function() repeat local a = 1 until a == 1 for a = 1, 2 do a = a end end",
         NULL, 0},
        {"local a\nreturn function(a) if a then a = 1 elseif a then a = 2 else a = 3 end end", NULL,
         0},
        {"local a\nreturn function(...) local b = select('#', ...) if b then do local a = 1 end\n"
         " a = 2 end end",
         "a", 3},
        {"local a <const>, b = 1, 2\nreturn function() while b do local b <const> = a end\n b = a "
         "end",
         "b", 3},
        {"local a, f\nreturn function() f(a).x = 1 f{a = 1}[a], f.a.b = 1\n f(function() a = 2 "
         "end) "
         "end",
         "a", 3},
        {"local a local function count() a = 1 end count() return function() return a end", NULL,
         0},
    };
    JoxLua *lua = jox_lua_create(NULL);
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        JoxScript *script = open_upvalue_script(lua);
        const JoxToken *t = find_assigned_upvalue(script, CASES[i].text);
        if ((t != NULL) != (CASES[i].name != NULL))
            fail_msg("%s\n %s", CASES[i].text, t ? "was found" : "was not found");
        if (t && (!jox_token_is(t, CASES[i].name) || t->line != CASES[i].line))
            fail_msg("%s\n gave %.*s in line %d", CASES[i].text, (int)t->length, t->text, t->line);
        if (t && !jox_outline_assigns_shared(script->vm.sources[0]))
            fail_msg("%s\n: upvalues would not be set back", CASES[i].text);
        jox_script_free(script);
    }
    jox_lua_free(lua);
}

/* Upvalues are set back after calls only if a function of the file assigns a variable that is
   declared outside of it. */
static void files_that_assign_no_upvalues_are_known(void **state) {
    (void)state;
    static const struct {
        const char *text;
        bool assigns;
    } CASES[] = {
        {"local n = 0 n = 1 return function() local n = n n = n + 1 return n end", false},
        {"local t = {} t.x = 1 return function(me) me.x = t.x for i = 1, 3 do i = 2 end end",
         false},
        {"local function f() end return function() f() end", false},
        {"local n = 0 local function f() n = 1 end return function() return n end", true},
        {"return function() local n = 0 return function() n = 1 end end", true},
        {"local f return function() return function() function f() end end end", true},
    };
    JoxLua *lua = jox_lua_create(NULL);
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        JoxScript *script = open_upvalue_script(lua);
        find_assigned_upvalue(script, CASES[i].text);
        if (jox_outline_assigns_shared(script->vm.sources[0]) != CASES[i].assigns)
            fail_msg("%s: not %d", CASES[i].text, CASES[i].assigns);
        jox_script_free(script);
    }
    jox_lua_free(lua);
}

/* Functions with lines far apart, many names and constants, and deep nesting. */
static void assigned_upvalues_of_large_functions_are_found(void **state) {
    (void)state;
    JoxLua *lua = jox_lua_create(NULL);
    JoxScript *script = open_upvalue_script(lua);
    JoxText text = {0};
    jox_text_add(&text, "local last = 0 return function()\n");
    for (int i = 0; i < 300; i++)
        jox_text_printf(&text, "do local v%d = {'%0*d', %d.5, %d, nil, true, false}%s end\n", i,
                        i % 70 + 1, i, i, i << 20, i % 50 ? "" : "\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n");
    for (int i = 0; i < 400; i++)
        jox_text_add(&text, "\n");
    for (int i = 0; i < 60; i++)
        jox_text_add(&text, "(function() ");
    jox_text_add(&text, "last = 1");
    for (int i = 0; i < 60; i++)
        jox_text_add(&text, " end)()");
    jox_text_add(&text, " end");
    int wanted = 1;
    for (const char *c = text.data; *c; c++)
        wanted += *c == '\n';
    const JoxToken *t = find_assigned_upvalue(script, text.data);
    assert_non_null(t);
    assert_true(jox_token_is(t, "last"));
    assert_int_equal(t->line, wanted);
    jox_text_free(&text);
    jox_script_free(script);
    jox_lua_free(lua);
}

static void add_upvalues(lua_State *L, int index, void *context) {
    jox_upvalues_add(L, index, context, 0);
}

static JoxUpvalues watched;
static int watch_argument(lua_State *L) {
    jox_freeze(L, 1, add_upvalues, &watched);
    return 0;
}

/* Restores the upvalues that a function changed and names the first, also if the source does not
   show it. */
static void changed_upvalues_are_set_back(void **state) {
    (void)state;
    static const struct {
        const char *text, *name; /* name: changed upvalue, or NULL */
        uint32_t count;          /* number of upvalues it could change */
    } CASES[] = {
        {"local n = 0 return function() n = n + 1 end", "n", 1},
        {"local n = 1 return function() n = 1.0 end", "n", 1},
        {"local n = 0.0 return function() n = -0.0 end", "n", 1},
        {"local n = 0 / 0 return function() n = n end", NULL, 1},
        {"local n = 1 return function() local n = (function() n = n + 1 end)() end", "n", 1},
        {"local n = 1 return function() n = n + 1 error('x') end", "n", 1},
        {"local n = 1 return function() n = n + 1 n = n - 1 end", NULL, 1},
        {"local n = 'x' return function() n = 'y' end", "n", 1},
        {"local n = 'x' return function() n = 'x' end", NULL, 1},
        {"local function f() end return function() f = nil end", "f", 1},
        {"local t = {} return function() t = {} end", "t", 1},
        {"local a, b = 1, 2 local function f() b = 3 end return function() f(a) end", "b", 3},
        {"local b = 2 local t = {{f = function() b = 3 end}} return function() t[1].f() end", "b",
         2},
        {"local a = 1 return function() return function() a = 3 end end", NULL, 1},
        {"local a = 1 return function() (function() a = 3 end)() end", "a", 1},
        {"return function() local a = 1 (function() a = 3 end)() end", NULL, 0},
        {"return function() return math.abs(1) end", NULL, 0},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        JoxLua *lua = jox_lua_create(NULL);
        JoxScript *script = open_upvalue_script(lua);
        lua_State *L = script->vm.L;
        const char *why, *text = CASES[i].text;
        char name[64] = "";
        int line;
        lua_Debug where;
        watched.count = 0;
        assert_int_equal(luaL_loadbufferx(L, text, strlen(text), "=b0", "t"), LUA_OK);
        assert_true(jox_vm_call(&script->vm, 0, 1, 100000, &why, &line));
        int function = luaL_ref(L, LUA_REGISTRYINDEX);
        lua_pushcfunction(L, watch_argument);
        lua_rawgeti(L, LUA_REGISTRYINDEX, function);
        assert_true(jox_vm_call(&script->vm, 1, 0, 100000, &why, &line));
        if (watched.count != CASES[i].count)
            fail_msg("%s: %u variables", text, watched.count);
        lua_rawgeti(L, LUA_REGISTRYINDEX, function);
        jox_vm_call(&script->vm, 0, 0, 100000, &why, &line);
        assert_int_equal(lua_gettop(L), 0);
        bool changed = jox_upvalues_restore(L, &watched, 0, watched.count, name, &where);
        if (changed != (CASES[i].name != NULL) || (changed && strcmp(name, CASES[i].name) != 0))
            fail_msg("%s: '%s' changed", text, name);
        assert_false(jox_upvalues_restore(L, &watched, 0, watched.count, name, &where));
        assert_int_equal(lua_gettop(L), 0);
        jox_script_free(script);
        jox_diag_free(&diagnostics);
        jox_lua_free(lua);
    }
    jox_free(watched.items);
    watched = (JoxUpvalues){0};
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(assigned_upvalues_are_found),
        cmocka_unit_test(files_that_assign_no_upvalues_are_known),
        cmocka_unit_test(assigned_upvalues_of_large_functions_are_found),
        cmocka_unit_test(changed_upvalues_are_set_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
