/* Functions of Lua that behaviours can use: their results, errors and budgets; frozen tables. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "base/mem.h"
#include "lua/language/script.h"
#include "lua/vm/library.h"

static JoxDiagnostics diagnostics;
static char printed[65536];
static int lines;

static void keep_line(void *context, const char *text) {
    (void)context;
    size_t used = strlen(printed);
    snprintf(printed + used, sizeof printed - used, "%s", text);
    lines++;
}

static JoxScript *open_library_script(JoxLua *lua) {
    static const JoxScope OPEN = {0};
    JoxScript *script = jox_script_create(lua);
    assert_non_null(script);
    script->scope = &OPEN;
    script->diagnostics = &diagnostics;
    script->vm.loading = true;
    printed[0] = 0;
    lines = 0;
    lua->group.say = keep_line;
    return script;
}

/* Runs a text; returns its results as text, or "error: " and the message. */
static const char *run_in_script(JoxScript *script, const char *text) {
    static char result[1024];
    const char *why;
    int line;
    if (!jox_script_read(script, "t.lua", text, strlen(text), (JoxPosition){0}) ||
        luaL_loadbufferx(script->vm.L, text, strlen(text), "=b0", "t") != LUA_OK) {
        snprintf(result, sizeof result, "refused");
        lua_settop(script->vm.L, 0);
        return result;
    }
    if (!jox_vm_call(&script->vm, 0, 1, script->owner->group.limits.load_instructions, &why,
                     &line)) {
        snprintf(result, sizeof result, "error: %s", why);
        return result;
    }
    snprintf(result, sizeof result, "%s", jox_library_text(script->vm.L, -1, NULL));
    lua_settop(script->vm.L, 0);
    return result;
}

static const char *run_text(const char *text) {
    JoxLua *lua = jox_lua_create(NULL);
    JoxScript *script = open_library_script(lua);
    const char *result = run_in_script(script, text);
    jox_script_free(script);
    jox_diag_free(&diagnostics);
    jox_lua_free(lua);
    return result;
}

typedef struct Case {
    const char *text, *gives; /* gives: the result, or part of the error message */
} Case;

static void check_cases(const Case *cases, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const char *got = run_text(cases[i].text);
        bool wants_error = strncmp(cases[i].gives, "error: ", 7) == 0;
        bool good = wants_error ? strncmp(got, "error: ", 7) == 0 && strstr(got, cases[i].gives + 7)
                                : strcmp(got, cases[i].gives) == 0;
        if (!good)
            fail_msg("%s\n gave '%s', not '%s'", cases[i].text, got, cases[i].gives);
    }
}
#define CHECK(cases) check_cases(cases, sizeof cases / sizeof *cases)

static void number_functions_give_exact_results(void **state) {
    (void)state;
    static const Case CASES[] = {
        {"return math.floor(2.7)", "2"},
        {"return math.floor(-2.5)", "-3"},
        {"return math.ceil(2.1)", "3"},
        {"return math.floor(1e300) == 1e300", "true"},
        {"return math.type(math.floor(2.0))", "integer"},
        {"return math.type(2.0)", "float"},
        {"return math.type('2')", "nil"},
        {"return math.tointeger(3.0)", "3"},
        {"return math.tointeger(3.5)", "nil"},
        {"return math.tointeger('3')", "nil"},
        {"return math.maxinteger + 1 == math.mininteger", "true"},
        {"return math.abs(math.mininteger) == math.mininteger", "true"},
        {"return math.abs(-2)", "2"},
        {"return math.max(1, 3, 2)", "3"},
        {"return math.min(1.5, -1)", "-1"},
        {"return math.max(1, 'x')", "error: number expected"},
        {"return math.fmod(-7, 3)", "-1"},
        {"return math.fmod(math.mininteger, -1)", "0"},
        {"return math.fmod(1, 0)", "error: zero"},
        {"return string.format('%.6f', math.acos(-1) - math.pi)", "0.000000"},
        {"return string.format('%.6f', math.log(8, 2))", "3.000000"},
        {"return math.huge > math.maxinteger", "true"},
        {"return 1 // 0", "error: divide by zero"},
        {"return tonumber('0x10')", "16"},
        {"return tonumber(' 12 ')", "12"},
        {"return tonumber('1e1')", "10.0"},
        {"return tonumber('12a')", "nil"},
        {"return tonumber('ff', 16)", "255"},
        {"return tonumber('-z', 36)", "-35"},
        {"return tonumber('2', 2)", "nil"},
        {"return tonumber('', 10)", "nil"},
        {"return string.char(65, 0)", "error: a byte of a text is from 1 to 255"},
        {"return string.format('%c', 0)", "error: a byte of a text is from 1 to 255"},
        {"return tonumber({})", "nil"},
        {"return tonumber('1', 99)", "error: base"},
        {"return math.random()", "error: at load use"},
        {"return tostring(0/0)", "nan"},
    };
    CHECK(CASES);
}

static void text_functions_give_exact_results(void **state) {
    (void)state;
    static const Case CASES[] = {
        {"return ('abc'):upper()", "ABC"},
        {"return ('abc'):reverse()", "cba"},
        {"return ('abc'):byte(2)", "98"},
        {"return select('#', ('abc'):byte(1, -1))", "3"},
        {"return select('#', ('abc'):byte(10))", "0"},
        {"return select('#', ('x'):rep(300):byte(1, -1))", "error: 200"},
        {"return string.char(74, 111)", "Jo"},
        {"return string.char(256)", "error: 255"},
        {"return ('abc'):sub(-2)", "bc"},
        {"return ('abc'):sub(math.mininteger, math.maxinteger)", "abc"},
        {"return ('abc'):sub(math.maxinteger, math.mininteger)", ""},
        {"return ('ab'):rep(3, '-')", "ab-ab-ab"},
        {"return ('ab'):rep(math.maxinteger)", "error: 1 MB"},
        {"return ('ab'):rep(math.mininteger)", ""},
        {"return (''):rep(math.maxinteger)", ""},
        {"return (''):rep(math.maxinteger, 'x')", "error: 1 MB"},
        {"return ('a.b'):find('.')", "2"},
        {"return ('abcabc'):find('ca', 2)", "3"},
        {"return ('abc'):find('')", "1"},
        {"return ('abc'):find('', 4)", "4"},
        {"return ('abc'):find('', 5)", "nil"},
        {"return ('abc'):find('a', math.mininteger)", "1"},
        {"return ('abc'):find('a', math.maxinteger)", "nil"},
        {"return ('a%d'):find('%d')", "error: plain text"},
        {"return ('a%d'):find('%d', 1, true)", "2"},
        {"return ('abc'):match('b')", "error: no patterns"},
        {"return ('abc'):gsub('b', 'c')", "error: no patterns"},
        {"return string.format('%5d|%-5d|%05d|%+d', 3, 3, 3, 3)", "    3|3    |00003|+3"},
        {"return string.format('%x %X %o', 255, 255, 8)", "ff FF 10"},
        {"return string.format('%d', 3.0)", "3"},
        {"return string.format('%d', 3.5)", "error: integer"},
        {"return string.format('%5.1f|%e|%g', 2.25, 1, 0.1)", "  2.2|1.000000e+00|0.1"},
        {"return string.format('%5s|%-5s|%.2s', 'ab', 'ab', 'abc')", "   ab|ab   |ab"},
        {"return string.format('%s %s %s', nil, true, {})", "nil true table"},
        {"return string.format('%c%%', 65)", "A%"},
        {"return #string.format('%99.99f', -1.7e308)", "410"},
        {"return string.format('%100d', 1)", "error: 99"},
        {"return string.format('%.100f', 1)", "error: 99"},
        {"return string.format('%9999999999999999999d', 1)", "error: 99"},
        {"return string.format('%q', 'x')", "error: does not know"},
        {"return string.format('%n', 1)", "error: does not know"},
        {"return string.format('%', 1)", "error: does not know"},
        {"return string.format('%*d', 5, 1)", "error: does not know"},
        {"return string.format('%d')", "error: lacks a value"},
        {"return string.format('%f', 0/0)", "nan"},
        {"return #string.format('%s', ('x'):rep(2^20))", "1048576"},
        {"local s = ('x'):rep(2^20) return string.format('%s%s', s, s)", "error: 1 MB"},
        {"return tostring(print)", "function"},
        {"return tostring({})", "table"},
        {"return tostring(hold)", "value"},
    };
    CHECK(CASES);
}

static void table_functions_give_exact_results(void **state) {
    (void)state;
    static const Case CASES[] = {
        {"local t = {1, 3} table.insert(t, 2, 2) return table.concat(t, ',')", "1,2,3"},
        {"local t = {} table.insert(t, 'x') return t[1]", "x"},
        {"table.insert({}, 5, 1)", "error: outside"},
        {"table.insert({}, 1, 1, 1)", "error: takes"},
        {"table.insert(math, 1)", "error: library"},
        {"table.move({1}, 1, 1, 1, string)", "error: library"},
        {"local t = {1, 2, 3} return table.remove(t, 1) .. table.concat(t)", "123"},
        {"local t = {1, 2, 3} return table.remove(t) .. #t", "32"},
        {"return table.remove({})", "nil"},
        {"return table.remove({}, 7)", "error: outside"},
        {"return select('#', table.unpack({1, nil, 3}, 1, 3))", "3"},
        {"return table.unpack({}, 1, 201)", "error: 200"},
        {"return table.unpack({}, math.mininteger, math.maxinteger)", "error: 200"},
        {"return select('#', table.unpack({}, math.maxinteger, math.maxinteger))", "1"},
        {"return table.pack(1, nil, nil).n", "3"},
        {"return table.concat(table.move({1, 2, 3}, 1, 3, 2))", "1123"},
        {"return table.concat(table.move({1, 2, 3}, 2, 3, 1))", "233"},
        {"table.move({}, 1, 1e9, 1)", "error: 100,000"},
        {"table.move({}, 1, 2, math.maxinteger)", "error: too large"},
        {"return table.concat({}, '', math.maxinteger, math.maxinteger)", "error: neither"},
        {"return table.concat({1, {}})", "error: neither"},
        {"return table.concat({'a', 'b', 'c'}, ' ', 2, 3)", "b c"},
        {"local t = {3, 1, 2} table.sort(t) return table.concat(t)", "123"},
        {"local t = {3, 1, 2} table.sort(t, function(a, b) return a > b end) "
         "return table.concat(t)",
         "321"},
        {"local t = {'b', 'B', 'a'} table.sort(t) return table.concat(t)", "Bab"},
        {"local t = {} for i = 1, 99 do t[i] = {i % 3, i} end\n"
         "table.sort(t, function(a, b) return a[1] < b[1] end)\n"
         "for i = 2, 99 do if t[i - 1][1] == t[i][1] and t[i - 1][2] > t[i][2] then "
         "return 'unstable' end end return 'stable'",
         "stable"},
        {"table.sort({1, 'x'})", "error: cannot compare"},
        {"local t = {3, 2, 1, 0} pcall(table.sort, t, function(a, b) if a * b == 0 then error('x') "
         "end "
         "return a < b end) return table.concat(t)",
         "3210"},
        {"local t = {} for i = 1, 500 do t[i] = i end table.sort(t, function() return true end) "
         "local s = 0 for i = 1, 500 do s = s + t[i] end return s",
         "125250"},
        {"local t = {3, 2, 1} table.sort(t, function(a, b) t[1] = nil t[2] = nil t[3] = nil "
         "return a < b end) return table.concat(t)",
         "123"},
    };
    CHECK(CASES);
}

static void pairs_visits_keys_in_order(void **state) {
    (void)state;
    static const Case CASES[] = {
        {"local s = '' for k in pairs({b = 1, a = 1, 7, [1.5] = 1, [-1] = 1, [2^60] = 1}) do "
         "s = s .. k .. ' ' end return s",
         "-1 1 1.5 1152921504606846976 a b "},
        {"local t = {} for i = 1, 10000 do t['k' .. i] = i end local n = 0 "
         "for k, v in pairs(t) do n = n + v end return n",
         "50005000"},
        {"local t = {a = 1, b = 2, c = 3} local s = '' for k in pairs(t) do t.b = nil t.z = 1 "
         "s = s .. k end return s",
         "ac"},
        {"for k in pairs({[true] = 1}) do end", "error: numbers and texts"},
        {"return next({})", "nil"},
        {"return next({b = 1, a = 2})", "a"},
        {"return next({b = 1, a = 2}, 'a')", "b"},
        {"return next({b = 1, a = 2}, 'b')", "nil"},
        {"return next({1, 2}, 0.5)", "1"},
        {"return next({[math.maxinteger] = 1, [9.3e18] = 2}, math.maxinteger)", "9.3e+18"},
        {"local s = 0 for i, v in ipairs({4, 5, nil, 6}) do s = s + v end return s", "9"},
        {"local t = {} for i = 1, 70000 do t[i] = i end for k in pairs(t) do end", "error: 65536"},
    };
    CHECK(CASES);
}

static void errors_are_caught_but_not_spent_budgets(void **state) {
    (void)state;
    static const Case CASES[] = {
        {"return pcall(error, 'x')", "false"},
        {"return select(2, pcall(error, 'x', 0))", "x"},
        {"return select(2, pcall(function() local a = nil; return a.b end))",
         "b0:1: attempt to index a nil value (local 'a')"},
        {"return select('#', pcall(function() return 1, 2, 3 end))", "4"},
        {"pcall(function() while true do end end) return 'survived'", "error: too long"},
        {"while true do pcall(function() while true do end end) end", "error: too long"},
        {"pcall(function() local s = ('x'):rep(2^20) while true do s = s .. s end end) "
         "return 'survived'",
         "error: memory"},
        {"pcall(function() local t = {} for i = 1, 1e9 do t[i] = {} end end) return 1", "error: "},
        {"local function f() pcall(f) pcall(f) end f()", "error: too long"},
        {"local function f() return pcall(f) end return f()", "true"},
        {"local function f() return f(f()) end f()", "error: "},
        {"error({})", "error: needs a text"},
        {"error()", "error: needs a text"},
        {"assert(false, 'why')", "error: why"},
        {"assert(nil)", "error: assertion failed"},
        {"return select('#')", "0"},
        {"return select(-1, 1, 2)", "2"},
        {"return select(0, 1)", "error: not so many"},
        {"return select(math.mininteger, 1)", "error: not so many"},
        {"local _ENV = {}", "refused"},
        {"return '_ENV' -- _ENV", "_ENV"},
    };
    CHECK(CASES);
}

/* Copies the lines printed while loading, which the VM keeps. */
static void keep_printed(JoxScript *script) {
    printed[0] = 0;
    keep_line(NULL, script->vm.printed_text.data);
    lines = 0;
    for (const char *c = script->vm.printed_text.data; *c; c++)
        lines += *c == '\n';
}

static void print_is_limited(void **state) {
    (void)state;
    JoxLua *lua = jox_lua_create(NULL);
    JoxScript *script = open_library_script(lua);
    run_in_script(script, "print('a', 1, nil)\nprint('\\27[2J\\n' .. ('x'):rep(9999))");
    keep_printed(script);
    assert_non_null(strstr(printed, "t.lua:1: a 1 nil\n"));
    assert_non_null(strstr(printed, "t.lua:2: ?[2J xxx"));
    assert_non_null(strstr(printed, "xxx ...\n"));
    run_in_script(script, "for i = 1, 1000 do print(i) end");
    keep_printed(script);
    assert_int_equal(lines, 101);
    assert_non_null(strstr(printed, "t.lua:1: ... print is limited\n"));
    jox_script_free(script);
    jox_diag_free(&diagnostics);
    jox_lua_free(lua);
}

/* ---- frozen tables ---- */

static void count_function(lua_State *L, int index, void *context) {
    (void)L;
    (void)index;
    ++*(int *)context;
}

static int functions_met;
static int freeze_argument(lua_State *L) {
    jox_freeze(L, 1, count_function, &functions_met);
    return 1;
}

static void frozen_tables_refuse_writes(void **state) {
    (void)state;
#define TRIED(what)                                                                                \
    "local ok, why = pcall(function() " what " end) if ok then error 'written' end return why"
    static const Case CASES[] = {
        {"return t[1] + t.deep.x + #t", "9"},
        {"return table.concat(t, ' ')", "5 6"},
        {"local s = '' for k, v in pairs(t) do s = s .. k .. ' ' end return s", "1 2 deep f self "},
        {"local s = '' for k, v in ipairs(t) do s = s .. v end return s", "56"},
        {"return next(t)", "1"},
        {"return select(2, table.unpack(t))", "6"},
        {"return table.concat(table.move(t, 1, 2, 1, {}))", "56"},
        {"return t.f()", "7"},
        {TRIED("t.x = 1"), "b0:1: tables are frozen once the file is loaded; what an agent "
                           "remembers belongs in memory"},
        {"t.deep.x = 1", "error: frozen"},
        {"t.self.self[1] = nil", "error: frozen"},
        {"kept().x = 1", "error: frozen"},
        {"table.insert(t, 1)", "error: frozen"},
        {"table.insert(t, 1, 1)", "error: frozen"},
        {"table.remove(t)", "error: frozen"},
        {"table.sort(t)", "error: frozen"},
        {"table.move({1}, 1, 1, 1, t)", "error: frozen"},
        {"table.move(t, 1, 2, 2)", "error: frozen"},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        JoxLua *lua = jox_lua_create(NULL);
        JoxScript *script = open_library_script(lua);
        lua_State *L = script->vm.L;
        const char *why = "", *got;
        char text[1024];
        int line;
        functions_met = 0;
        /* The case is run with the frozen tables as its arguments. */
        snprintf(text, sizeof text,
                 "local hidden = {x = 3}\n"
                 "local function kept() return hidden end\n"
                 "local t = {5, 6, deep = {x = 2}, f = function() return kept().x + 4 end}\n"
                 "t.self = t\n"
                 "return {t, kept, function(t, kept) %s end}",
                 CASES[i].text);
        assert_int_equal(luaL_loadbufferx(L, text, strlen(text), "=b0", "t"), LUA_OK);
        assert_true(jox_vm_call(&script->vm, 0, 1, 100000, &why, &line));
        lua_rawgeti(L, 1, 1);
        lua_rawgeti(L, 1, 2);
        lua_rawgeti(L, 1, 3);
        lua_pushcfunction(L, freeze_argument);
        lua_pushvalue(L, 2);
        assert_true(jox_vm_call(&script->vm, 1, 0, 100000, &why, &line));
        assert_int_equal(functions_met, 2);
        lua_insert(L, 2);
        assert_int_equal(lua_gettop(L), 4);
        bool good = jox_vm_call(&script->vm, 2, 1, 100000, &why, &line);
        got = good ? jox_library_text(L, -1, NULL) : why;
        const char *wanted = CASES[i].gives;
        bool error = strncmp(wanted, "error: ", 7) == 0;
        size_t skip = strncmp(wanted, "b0:1: ", 6) == 0 ? 6 : 0; /* the case runs on another line */
        if (error == good || !strstr(got, wanted + (error ? 7 : skip)))
            fail_msg("%s\n gave '%s', not '%s'", CASES[i].text, got, wanted);
        jox_script_free(script);
        jox_diag_free(&diagnostics);
        jox_lua_free(lua);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(number_functions_give_exact_results),
        cmocka_unit_test(text_functions_give_exact_results),
        cmocka_unit_test(table_functions_give_exact_results),
        cmocka_unit_test(pairs_visits_keys_in_order),
        cmocka_unit_test(errors_are_caught_but_not_spent_budgets),
        cmocka_unit_test(print_is_limited),
        cmocka_unit_test(frozen_tables_refuse_writes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
