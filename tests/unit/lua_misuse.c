/* Lua's own operators between values of the language: what is valid must load, and what would drop
   an operand in silence must be refused at its place. The parser on which that rests reads all Lua.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/file.h"
#include "base/mem.h"
#include "base/overlay.h"
#include "lua/language/script.h"
#include "lua/loader.h"

/* A whole behaviour: what comes before the machine, the condition, and further keys of the state.
 */
#define BEHAVIOUR(before, when, keys)                                                              \
    before "\nreturn machine { name = \"m\", start = \"A\", states = { A = { steer = hold, " keys  \
           " { to = \"B\", when = " when " } }, B = { steer = hold } } }"
#define MINE "local mine = memory { laps = 0, met = false }\n"

/* A library that some of the behaviours require. */
static const char LIBRARY[] =
    "local crowd = { far = 12 }\n"
    "local function default_place(name) return name or \"post\" end\n"
    "function crowd.close(place, metres) return near(default_place(place), metres or 2) end\n"
    "function crowd.all(list)\n"
    "  local all\n"
    "  for _, c in ipairs(list) do all = all and all & c or c end\n"
    "  return all\n"
    "end\n"
    "function crowd.unless(c, other)\n"
    "  if not other then return ~c end\n"
    "  if other == nil then other = lasted end\n"
    "  return ~c & other\n"
    "end\n"
    "function crowd.with(c, extra)\n"
    "  extra = extra or lasted\n"
    "  return extra and (c & extra) or c\n"
    "end\n"
    "function crowd.to(target) target = target or goal; return seek(target) end\n"
    "function crowd.both(a, b) return a and b end\n" /* misuse where conditions are given */
    "crowd.packed = now.density:above(4)\n"
    "return crowd\n";

static const char *const GOOD[] = {
    BEHAVIOUR(
        MINE
        "local function f(me)\n  local laps = me.laps\n  if laps == 1 then me.laps = 2 end\nend",
        "mine.laps:is(0)", "on_enter = f,"),
    BEHAVIOUR(
        MINE "local busy = after(3)", "busy",
        "on_enter = function(me) local busy = me.laps > 2 and not me.met if busy then me.laps = "
        "0 end end,"),
    BEHAVIOUR("local busy = after(3)\nlocal function f(me, busy) return busy and 1 or 0 end",
              "busy", "on_enter = function(me) if f(me) == 1 then me.goal = \"post\" end end,"),
    BEHAVIOUR("local busy = after(3)", "busy",
              "on_enter = function(me) for busy = 1, 3 do if busy == 2 then return end end end,"),
    BEHAVIOUR("local busy = after(3)", "busy",
              "on_enter = function(me) for _, busy in ipairs(me.neighbours) do if busy and "
              "busy.state ~= \"A\" then return end end end,"),
    BEHAVIOUR("local busy = 3\ndo local busy = after(1) end\nlocal n = busy == 3 and 1 or 2",
              "after(n)", ""),
    BEHAVIOUR("local hard = 3 > 2", "hard and after(3) or after(5)", ""),
    BEHAVIOUR("local n = 3", "(n == 3 and n ~= 4 and not (n > 5)) and after(n) or lasted", ""),
    BEHAVIOUR("local fast = type(own) == \"table\" and 2 or 1", "after(fast)", ""),
    BEHAVIOUR("local lib = require \"crowd\"",
              "lib.close() & lib.close(\"post\", 3) & lib.all { after(1), after(2) }", ""),
    BEHAVIOUR("local lib = require \"crowd\"",
              "lib.unless(after(1)) | lib.unless(after(1), after(2)) | lib.with(after(1)) | "
              "lib.with(after(2), lasted)",
              ""),
    BEHAVIOUR("local lib = require \"crowd\"", "lib.packed & lib.both(3, after(1))", ""),
    BEHAVIOUR("local function either(a) if a then return after(1) end end",
              "(either(false) or after(2)) & (either(true) or after(3))", ""),
    BEHAVIOUR(
        "local t = {}\nfor i = 1, 3 do t[i] = after(i) end\nlocal c\nfor _, x in ipairs(t) do\n"
        "if c then c = c | x else c = x end end",
        "c", ""),
    BEHAVIOUR(
        "local c\nrepeat local n = 1 c = after(n) until n == 1\ngoto on\n::on::\nwhile not c do "
        "c = after(1) end",
        "c", ""),
    BEHAVIOUR("local function kind(x) if x == \"any\" then return goal end return x end",
              "near(kind(\"any\"), 2) | near(kind(nearest \"ball\"), 2)", ""),
};

/* A backtick marks what is refused. */
static const char *const BAD[] = {
    BEHAVIOUR("", "after(3) `and stuck(2)", ""),
    BEHAVIOUR("", "after(3) `or stuck(2)", ""),
    BEHAVIOUR("", "`not after(3)", ""),
    BEHAVIOUR(MINE, "mine.laps `== 7", ""),
    BEHAVIOUR(MINE, "mine.laps `~= 7", ""),
    BEHAVIOUR(MINE, "mine.met `and after(1)", ""),
    BEHAVIOUR("local mine <const> = memory { met = false }\n", "after(1) & (mine.met `and lasted)",
              ""),
    BEHAVIOUR("local a = after(1)\nlocal b = a `and stuck(2)", "b", ""),
    BEHAVIOUR("local a, b = after(1), `not after(2)", "a & (b or after(3))", ""),
    BEHAVIOUR("local c = { busy = after(1) }", "c.busy `and after(2)", ""),
    BEHAVIOUR("local c = {}\nc.busy = after(1)", "c.busy `and after(2)", ""),
    BEHAVIOUR(
        "local c = { after(1), after(2) }\nlocal all = after(3)\nfor _, x in ipairs(c) do all = x "
        "`and all end",
        "all", ""),
    BEHAVIOUR("local function busy(x) return near(x, 2) `and stuck(2) end", "busy(\"post\")", ""),
    BEHAVIOUR("local function busy(a, b) return a `and b end", "busy(after(1), stuck(2))", ""),
    BEHAVIOUR("local function busy(a, b) return a `or b end", "busy(after(1), stuck(2))", ""),
    BEHAVIOUR("local function calm(a) return `not a end", "(calm(after(1)) or after(2))", ""),
    BEHAVIOUR("local function busy() return after(1) end", "busy() `and lasted", ""),
    BEHAVIOUR("local function busy() return after(1) end\nlocal function calm() return busy() end",
              "calm() `or lasted", ""),
    BEHAVIOUR("local lib = require \"crowd\"", "lib.close() `and lib.packed", ""),
    BEHAVIOUR("local lib = require \"crowd\"", "lib.packed `or lib.close()", ""),
    BEHAVIOUR(MINE, "after(1)", "set = { met = mine.laps `== 3 },"),
    BEHAVIOUR(MINE, "after(1)", "push_when = mine.met `and lasted,"),
    BEHAVIOUR("", "after(1)", "speed = own.speed `or 2,"),
    BEHAVIOUR("", "after(1)", "approach = nearest \"ball\" `or goal,"),
    BEHAVIOUR("local busy = after(1)", "busy",
              "on_enter = function(me) if busy `and me.x > 3 then me.goal = \"post\" end end,"),
    BEHAVIOUR("local busy = after(1)", "busy",
              "on_enter = function(me) `if busy then me.goal = \"post\" end end,"),
    BEHAVIOUR("local busy = after(1)", "function(me) return `not busy end", ""),
    BEHAVIOUR("local t = { { after(1) }, { after(2) } }", "t[1][1] `and t[2][1]", ""),
};

/* The behaviour's text without its mark, which gives the place. */
static void split_mark(const char *marked, char *text, int *line, int *column) {
    const char *mark = strchr(marked, '`'), *begins = marked;
    *line = 1;
    for (const char *c = marked; mark && c < mark; c++)
        if (*c == '\n') {
            begins = c + 1;
            ++*line;
        }
    *column = mark ? (int)(mark - begins) + 1 : 0;
    for (; *marked; marked++)
        if (*marked != '`')
            *text++ = *marked;
    *text = 0;
}

/* Loads a text beside the library; the number of errors, with the first in *first. */
static uint32_t errors_of(const char *text, JoxDiagnostics *diagnostics) {
    JoxOverlay overlay = {0};
    JoxLua *lua = jox_lua_create(NULL);
    jox_overlay_put(&overlay, "./crowd.lua", LIBRARY, sizeof LIBRARY - 1);
    const JoxOverlay *before = jox_overlay_use(&overlay);
    JoxMachine *m = jox_lua_load_text(lua, "t.lua", text, strlen(text), NULL, diagnostics);
    jox_overlay_use(before);
    assert_true((m == NULL) == (diagnostics->errors > 0));
    jox_lua_release(lua, m);
    jox_machine_free(m);
    jox_lua_free(lua);
    jox_overlay_free(&overlay);
    return (uint32_t)diagnostics->errors;
}

static void valid_lua_loads(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof GOOD / sizeof *GOOD; i++) {
        JoxDiagnostics diagnostics = {0};
        if (errors_of(GOOD[i], &diagnostics) > 0)
            fail_msg("%s\n gave %s:%d:%d %s", GOOD[i], diagnostics.items[0].file,
                     diagnostics.items[0].line, diagnostics.items[0].column,
                     diagnostics.items[0].message);
        jox_diag_free(&diagnostics);
    }
}

static void misuse_is_refused_at_its_place(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof BAD / sizeof *BAD; i++) {
        JoxDiagnostics diagnostics = {0};
        char text[1024];
        int line, column;
        split_mark(BAD[i], text, &line, &column);
        const uint32_t errors = errors_of(text, &diagnostics);
        const JoxDiagnostic *d = errors ? &diagnostics.items[0] : NULL;
        if (!d || strcmp(d->code, "lua-operator") || d->line != line || d->column != column)
            fail_msg("%s\n gave %d:%d %s", BAD[i], d ? d->line : 0, d ? d->column : 0,
                     d ? d->message : "nothing");
        jox_diag_free(&diagnostics);
    }
}

/* What a library does with what it is given is judged by what it is given. */
static void library_function_is_judged_by_its_arguments(void **state) {
    (void)state;
    JoxDiagnostics diagnostics = {0};
    assert_int_equal(
        errors_of(BEHAVIOUR("local lib = require \"crowd\"", "lib.both(after(1), lib.packed)", ""),
                  &diagnostics),
        1);
    assert_string_equal(diagnostics.items[0].file, "./crowd.lua");
    assert_int_equal(diagnostics.items[0].line, 19);
    jox_diag_free(&diagnostics);
}

/* What the parser must read whole, in the number of functions and variables that it has. */
static const struct {
    const char *text;
    size_t functions, variables;
} SYNTAX[] = {
    {"", 0, 0},
    {"local a <const>, b <close> = 1, nil return a", 0, 2},
    {"local s = \"a\\\nb\\z   \n  end\" .. 'it\\'s' .. [==[ ]] end ]==]", 0, 1},
    {"local n = .5 + 3. + 0x.8p-1 + 1e-5 - 0xe-1 .. 2 local m = n//2 ~ 1 >> 2 << 3", 0, 2},
    {"local function f(...) local t = {...} return select('#', ...), t end return f", 1, 2},
    {"local t = {} function t.a.b:c(x) return self, x end function t.d() end", 2, 2},
    {"for i = 1, 2, 3 do end for a, b, c, d in next, {} do break end", 0, 5},
    {"local x repeat local y = x until y or not x while x do x = nil end", 0, 2},
    {"do goto e ; ::e:: end if 1 then elseif 2 then else end return;", 0, 0},
    {"local f = function() end f() f'' f{} f[[]] f():g''{}.h = 1, 2 ; (f)(1)", 1, 1},
    {"local t = { 1, 2; a = 3, ['b'] = 4, [5] = function() return {} end, }", 1, 1},
    {"return -2 ^ -3 ^ 4, not not #'' , ~~1, 1 .. 2 .. 3, a.b.c[d].e", 0, 0},
};

static void parser_reads_all_of_lua(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof SYNTAX / sizeof *SYNTAX; i++) {
        JoxSource source = {.text = (char *)SYNTAX[i].text, .length = strlen(SYNTAX[i].text)};
        jox_source_scan(&source);
        JoxSyntax *s = jox_syntax_read(&source);
        if (!s->whole || s->function_count - 1 != SYNTAX[i].functions ||
            s->variable_count != SYNTAX[i].variables)
            fail_msg("%s\n gave %d, %zu functions, %zu variables", SYNTAX[i].text, s->whole,
                     s->function_count - 1, s->variable_count);
        jox_syntax_free(s);
        jox_free(source.tokens);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(valid_lua_loads),
        cmocka_unit_test(misuse_is_refused_at_its_place),
        cmocka_unit_test(library_function_is_judged_by_its_arguments),
        cmocka_unit_test(parser_reads_all_of_lua),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
