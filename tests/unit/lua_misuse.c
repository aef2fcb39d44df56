/* Lua operators on values of the language: valid code must load, and code that would lose an
   operand must be refused at its position. Also tests the parser, which must read all Lua. */
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

/* A whole behaviour from the text before the machine, a condition, and further keys of the state.
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
    "function crowd.both(a, b) return a and b end\n" /* misuse if called with conditions */
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

/* Valid behaviours with common idioms: libraries that build states, options, defaults. None may
   give a message. */
static const char *const IDIOMS[] = {
    /* options that are constants at the top of the file */
    BEHAVIOUR("local opts = { extra = after(9) }\nlocal cond = stuck(2)\n"
              "if opts.extra then cond = cond | opts.extra end",
              "cond", ""),
    BEHAVIOUR("local opts = {}\nopts.extra = after(9)\nlocal cond = stuck(2)\n"
              "if opts.extra and opts.other then cond = cond | opts.extra end",
              "cond", ""),
    BEHAVIOUR("local opts = { when = after(9) }\nlocal w = opts.when or lasted", "w", ""),
    BEHAVIOUR("local opts = { when = after(9) }", "opts.when or lasted", ""),
    BEHAVIOUR("local opts = { at = nearest \"ball\" }", "near(opts.at or \"post\", 2)", ""),
    BEHAVIOUR("local opts = { calm = after(9) }\nlocal c = after(1)\n"
              "if not opts.calm then c = lasted end",
              "c", ""),
    BEHAVIOUR("local DEFAULTS = { far = near(\"post\", 9) }\n"
              "local function pick(o) return o.far or DEFAULTS.far end",
              "pick { } & pick { far = after(1) }", ""),
    BEHAVIOUR(
        "local opts = { when = after(9) }\nlocal w = opts.when\nif w then w = w | stuck(3) end",
        "w", ""),
    /* values that `or` chooses */
    BEHAVIOUR("local maybe\nlocal w = maybe or after(3)\nlocal c = stuck(1)\n"
              "if w then c = c | w end",
              "c", ""),
    BEHAVIOUR("local maybe = nil\nlocal w = maybe or after(3)", "w", ""),
    BEHAVIOUR("local w = after(3)\nw = w or lasted", "w", ""),
    BEHAVIOUR("local function f(w) w = w or after(3) if w then return w end return lasted end",
              "f() | f(stuck(2))", ""),
    BEHAVIOUR("local function f(o) local w = o.when or after(3) if w then return w end end",
              "f { }", ""),
    BEHAVIOUR("local function f(w) local c = w if c then return c & after(1) end return lasted end",
              "f(stuck(2))", ""),
    /* lists of transitions, and states that are built in a loop */
    BEHAVIOUR("local list = { { to = \"B\", when = after(2) } }\nlocal c = stuck(9)\n"
              "for _, t in ipairs(list) do if t.when then c = c | t.when end end",
              "c", ""),
    BEHAVIOUR("local list = { { to = \"B\", when = after(2) }, { to = \"B\", when = after(4) } }\n"
              "local all\nfor _, t in ipairs(list) do\n"
              "local w = t.when or lasted all = all and all | w or w end",
              "all", ""),
    "local states = {}\nfor i = 1, 3 do\n  local last = i == 3\n"
    "  states[\"S\" .. i] = { steer = hold, { to = last and \"S1\" or \"S\" .. (i + 1), when = "
    "after(i) } }\nend\nreturn machine { name = \"m\", start = \"S1\", states = states }",
    "local function stop(name, opts)\n  opts = opts or {}\n  return { steer = hold,\n"
    "    { to = name, when = opts.when or after(opts.wait or 2) } }\nend\n"
    "return machine { name = \"m\", start = \"A\", states = {\n"
    "  A = stop(\"B\", { when = stuck(2) }), B = stop(\"A\") } }",
    "local rows = { A = { \"B\", after(1) }, B = { \"A\", after(2), lasted } }\nlocal states = {}\n"
    "for name, row in pairs(rows) do\n  local when = row[2]\n"
    "  if row[3] then when = when & row[3] end\n"
    "  states[name] = { steer = hold, { to = row[1], when = when } }\nend\n"
    "return machine { name = \"m\", start = \"A\", states = states }",
    /* functions that give a condition or nothing */
    BEHAVIOUR("local function maybe(n) if n then return after(n) end end", "maybe(2) or lasted",
              ""),
    BEHAVIOUR("local function maybe(n) if n then return after(n) end end\nlocal c = stuck(1)\n"
              "if maybe(2) then c = c | maybe(2) end",
              "c", ""),
    BEHAVIOUR("local function pick(n) if n > 1 then return after(n) else return nil end end\n"
              "local c = pick(2)\nif not c then c = lasted end",
              "c", ""),
    /* varargs, closures, nested functions, shadowing */
    BEHAVIOUR("local function any(...)\n  local all\n  for i = 1, select(\"#\", ...) do\n"
              "    local c = select(i, ...)\n    if c then all = all and all | c or c end\n  end\n"
              "  return all\nend",
              "any(after(1), nil, stuck(2))", ""),
    BEHAVIOUR("local function maker()\n  local made\n  return function(c)\n"
              "    if made then made = made | c else made = c end\n    return made\n  end\nend\n"
              "local add = maker()\nadd(after(1))",
              "add(stuck(2))", ""),
    BEHAVIOUR("local busy = after(1)\ndo\n  local busy = false\n  if busy then return end\nend",
              "busy", ""),
    BEHAVIOUR("local c = after(1)\nlocal function f() local c = nil if c then return c end return "
              "lasted end",
              "c & f()", ""),
    /* pcall, goto, division, methods of strings */
    BEHAVIOUR("local ok, c = pcall(function() return after(2) end)\n"
              "if not ok or not c then c = lasted end",
              "c", ""),
    BEHAVIOUR("local c = after(1)\nfor i = 1, 4 do\n  if i % 2 == 0 then goto on end\n"
              "  c = c | stuck(i)\n  ::on::\nend",
              "c", ""),
    BEHAVIOUR("local n = 7 // 2\nlocal c = n == 3 and after(n) or lasted", "c", ""),
    BEHAVIOUR("local name = (\"post\"):upper():lower()\n"
              "local c = name:sub(1, 1) == \"p\" and near(name, 2) or after(1)",
              "c", ""),
    BEHAVIOUR("local extra <const> = { after(1) }\nlocal c = extra[1] or lasted", "c", ""),
    BEHAVIOUR("local lib = require \"crowd\"\nlocal c = lasted\n"
              "if lib.packed then c = c | lib.packed end",
              "c", ""),
    BEHAVIOUR(MINE "local flags = { met = mine.met }\nlocal c = after(5)\n"
                   "if flags.met then c = c & ~flags.met end",
              "c", ""),
    BEHAVIOUR("local c = after(1)\nrepeat local more = c c = more | stuck(1) until c", "c", ""),
};

/* Refused behaviours; a backtick marks the position of the error. */
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
    BEHAVIOUR("local c = { busy = after(1) }", "c.busy `or after(2)", ""),
    BEHAVIOUR("local c = { busy = after(1) }", "`not c.busy", ""),
    BEHAVIOUR("local c = { busy = after(1) }\nlocal b = c.busy `and stuck(2)", "b", ""),
    BEHAVIOUR("local c = { busy = after(1) }", "c.busy",
              "on_enter = function(me) `if c.busy then me.goal = \"post\" end end,"),
    BEHAVIOUR(
        "local c = { busy = after(1) }", "c.busy",
        "on_exit = function(me) if me.x > 1 and `not c.busy then me.goal = \"post\" end end,"),
    BEHAVIOUR("local busy = after(1)\nlocal function run(me) while me.x > 3 do\n"
              "`if busy then return end end end",
              "busy", "on_enter = run,"),
    BEHAVIOUR("local a = after(1)\nlocal c = a `or lasted", "c", ""),
    BEHAVIOUR("local a = after(1)\na = after(2)", "a `or lasted", ""),
    BEHAVIOUR("local a = after(1)\nif 3 > 2 then a = after(2) end", "a `and lasted", ""),
    BEHAVIOUR("local opts = { when = after(9) }\nlocal w = opts.when or lasted", "w `and after(1)",
              ""),
    BEHAVIOUR("local lib = require \"crowd\"\nlocal w = lib.packed `or lasted", "w", ""),
    BEHAVIOUR(MINE "local n = mine.laps `== 3", "after(1)", "set = { met = n },"),
    BEHAVIOUR(MINE "local c = lasted\nif mine.laps `== 3 then c = after(1) end", "c", ""),
    BEHAVIOUR(MINE, "(mine.met `and lasted) | after(3)", ""),
    BEHAVIOUR("local function both() return after(1) `and lasted end", "both()", ""),
    BEHAVIOUR("local states = { after(1) }\nlocal c\nfor i = 1, 1 do c = stuck(i) `and lasted end",
              "c", ""),
    BEHAVIOUR("", "near(\"post\", 2) `and ~stuck(1) | lasted", ""),
    BEHAVIOUR("", "after(1) & (stuck(2) `or lasted)", ""),
    BEHAVIOUR("", "(`not near(\"post\", 2)) or after(2)", ""),
    BEHAVIOUR("", "now.speed `~= 0", ""),
    BEHAVIOUR("", "own.speed `== 0", ""),
    BEHAVIOUR("", "sees(nearest \"ball\") `and after(1)", ""),
    BEHAVIOUR("", "heard \"alarm\" `or after(9)", ""),
    BEHAVIOUR("local t = { c = after(1) }", "after(1)", "push_when = t.c `and lasted,"),
    BEHAVIOUR("local lib = require \"crowd\"", "`not lib.packed", ""),
    BEHAVIOUR("local near_post = near(\"post\", 2)\nlocal function far(me) return `not near_post "
              "end",
              "far", ""),
};

/* Removes the mark from a behaviour's text; returns its position. */
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

/* Loads a text beside the library; returns the number of errors. */
static uint32_t count_errors(const char *text, JoxDiagnostics *diagnostics) {
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
        if (count_errors(GOOD[i], &diagnostics) > 0)
            fail_msg("%s\n gave %s:%d:%d %s", GOOD[i], diagnostics.items[0].file,
                     diagnostics.items[0].line, diagnostics.items[0].column,
                     diagnostics.items[0].message);
        jox_diag_free(&diagnostics);
    }
}

static void idioms_load_without_messages(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof IDIOMS / sizeof *IDIOMS; i++) {
        JoxDiagnostics diagnostics = {0};
        count_errors(IDIOMS[i], &diagnostics);
        for (size_t d = 0; d < diagnostics.count; d++) {
            const JoxDiagnostic *told = &diagnostics.items[d];
            if (told->severity == JOX_SEVERITY_ERROR || !strcmp(told->code, "lua-operator"))
                fail_msg("%s\n gave %s:%d:%d %s", IDIOMS[i], told->file, told->line, told->column,
                         told->message);
        }
        jox_diag_free(&diagnostics);
    }
}

/* While a file loads, a test of a value that is always there may be a constant switch. */
static void test_of_constant_gives_a_note(void **state) {
    (void)state;
    JoxDiagnostics diagnostics = {0};
    const char *text = BEHAVIOUR("local extra = after(9)\nlocal c = stuck(2)\n"
                                 "if extra then c = c | extra end",
                                 "c", "");
    assert_int_equal(count_errors(text, &diagnostics), 0);
    const JoxDiagnostic *note = NULL;
    for (size_t d = 0; d < diagnostics.count; d++)
        if (!strcmp(diagnostics.items[d].code, "lua-operator"))
            note = &diagnostics.items[d];
    assert_non_null(note);
    assert_int_equal(note->severity, JOX_SEVERITY_NOTE);
    assert_int_equal(note->line, 3);
    assert_int_equal(note->column, 1);
    jox_diag_free(&diagnostics);
}

static void misuse_is_refused_at_its_place(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof BAD / sizeof *BAD; i++) {
        JoxDiagnostics diagnostics = {0};
        char text[1024];
        int line, column;
        split_mark(BAD[i], text, &line, &column);
        const uint32_t errors = count_errors(text, &diagnostics);
        const JoxDiagnostic *d = errors ? &diagnostics.items[0] : NULL;
        if (!d || strcmp(d->code, "lua-operator") || d->line != line || d->column != column)
            fail_msg("%s\n gave %d:%d %s", BAD[i], d ? d->line : 0, d ? d->column : 0,
                     d ? d->message : "nothing");
        jox_diag_free(&diagnostics);
    }
}

/* A library function is checked with the kinds of the arguments it was called with. */
static void library_function_is_judged_by_its_arguments(void **state) {
    (void)state;
    JoxDiagnostics diagnostics = {0};
    assert_int_equal(count_errors(BEHAVIOUR("local lib = require \"crowd\"",
                                            "lib.both(after(1), lib.packed)", ""),
                                  &diagnostics),
                     1);
    assert_string_equal(diagnostics.items[0].file, "./crowd.lua");
    assert_int_equal(diagnostics.items[0].line, 19);
    jox_diag_free(&diagnostics);
}

/* Texts that the parser must read to the end, with their number of functions and variables. */
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

/* 3,000 names within 45 functions of 190 variables each: more than the search looks at. */
static void file_too_large_to_search_is_reported(void **state) {
    (void)state;
    JoxText text = {0};
    JoxDiagnostics diagnostics = {0};
    for (int f = 0; f < 45; f++) {
        jox_text_add(&text, "local function f() local a");
        for (int v = 1; v < 190; v++)
            jox_text_add(&text, ",a");
        jox_text_add(&text, "\n");
    }
    jox_text_add(&text, "return { near");
    for (int n = 0; n < 3000; n++)
        jox_text_add(&text, ",near");
    jox_text_add(&text, " }");
    for (int f = 0; f < 45; f++)
        jox_text_add(&text, " end");
    jox_text_add(&text, BEHAVIOUR("", "after(1) and after(2)", ""));
    assert_int_equal(count_errors(text.data, &diagnostics), 0);
    assert_int_equal(diagnostics.count, 1);
    assert_string_equal(diagnostics.items[0].code, "too-large");
    jox_diag_free(&diagnostics);
    jox_text_free(&text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(valid_lua_loads),
        cmocka_unit_test(idioms_load_without_messages),
        cmocka_unit_test(test_of_constant_gives_a_note),
        cmocka_unit_test(misuse_is_refused_at_its_place),
        cmocka_unit_test(library_function_is_judged_by_its_arguments),
        cmocka_unit_test(parser_reads_all_of_lua),
        cmocka_unit_test(file_too_large_to_search_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
