/* Loading behaviours: positions of errors, compiled conditions, limits of the sandbox. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "base/mem.h"
#include "geom/place_kinds.h"
#include "lua/loader.h"

static JoxDiagnostics diagnostics;

/* Loads a text; returns the machine or NULL, and keeps the diagnostics for the test. */
static JoxMachine *load_in(JoxLua *lua, const JoxScope *scope, const char *text) {
    jox_diag_free(&diagnostics);
    return jox_lua_load_text(lua, "t.lua", text, strlen(text), scope, &diagnostics);
}

typedef struct Mistake {
    const char *text;
    int line, column;
    const char *code, *says; /* says: part of the message or hint */
} Mistake;

#define SHEET(rest)                                                                                \
    "return machine { name = \"m\", start = \"A\", states = { A = {\n" rest "\n} } }"

static const Mistake MISTAKES[] = {
    {SHEET("{ to = \"A\", when = stuk(3) }"), 2, 20, "unknown-word", "stuck"},
    {SHEET("{ to = \"A\", when = after(3) and stuck(2) }"), 2, 29, "lua-operator", "&"},
    {SHEET("{ to = \"A\", when = not after(3) }"), 2, 20, "lua-operator", "~"},
    {SHEET("{ to = \"A\", when = now.speed == 3 }"), 2, 30, "lua-operator", ":is"},
    {SHEET("{ to = \"A\", when = now.speed > 3 }"), 2, 30, "bad-operator", ":above"},
    {SHEET("{ to = \"A\", when = true }"), 2, 13, "bad-condition", "Leave"},
    {SHEET("{ to = \"A\", when = now.speed }"), 2, 13, "bad-condition", ":above"},
    {SHEET("{ to = \"B\", when = after(3) }"), 2, 3, "unknown-state", "'B'"},
    {SHEET("{ too = \"A\" }"), 2, 3, "unknown-key", "'to'"},
    {SHEET("sped = 3"), 2, 1, "unknown-key", "'speed'"},
    {SHEET("speed = 99"), 2, 1, "out-of-range", "0 to 20"},
    {SHEET("speed = 2 * speed"), 2, 13, "unknown-word", "own.speed"},
    {SHEET("steer = 3"), 2, 1, "bad-value", "steering"},
    {SHEET("steer = seek(3)"), 2, 9, "bad-argument", "target"},
    {SHEET("push = 150 * now.speed:below(3)"), 2, 12, "bad-operand", "parentheses"},
    {SHEET("{ to = \"A\", when = after(1) & now.speed }"), 2, 29, "bad-operand", ":above"},
    {SHEET("kick = { nearest \"ball\" }"), 2, 1, "missing-key", "impulse"},
    {SHEET("on_enter = 3"), 2, 1, "bad-value", "function"},
    {"x = 3\n" SHEET(""), 1, 1, "global-assignment", "local"},
    {"local a = now.sped\n" SHEET(""), 1, 15, "unknown-word", "speed"},
    {"local m = memory { n = \"x\" }\n" SHEET(""), 1, 20, "bad-memory", "remembered"},
    {"local q = normal(1)\n" SHEET(""), 1, 11, "bad-argument", "deviation"},
    {"return 3", 0, 0, "no-machine", "machine"},
    {"local a = = 3", 1, 11, "lua-error", "unexpected symbol"},
    {SHEET("speed = 1,\nspeed = 2"), 3, 1, "doubled-key", "line 2"},
    {"local t = { a = 1, [\"a\"] = 2 }\n" SHEET(""), 1, 21, "doubled-key", "'a'"},
    {"return machine { name = \"m\", start = \"A\", states = { A = {},\nB = {}, A = {} } }", 2, 9,
     "doubled-key", "'A'"},
    {"memory { n = 0 }\nlocal m = memory { n = 1 }\n" SHEET(""), 2, 20, "bad-memory", "before"},
    {"memory { n = 0 }\nlocal m = memory { n = false }\n" SHEET(""), 2, 20, "bad-memory", "before"},
};

static void every_mistake_has_its_place(void **state) {
    (void)state;
    JoxLua *lua = jox_lua_create(NULL);
    for (size_t i = 0; i < sizeof MISTAKES / sizeof *MISTAKES; i++) {
        const Mistake *m = &MISTAKES[i];
        assert_null(load_in(lua, NULL, m->text));
        assert_true(diagnostics.errors >= 1);
        const JoxDiagnostic *d = &diagnostics.items[0];
        bool said = strstr(d->message, m->says) || (d->hint && strstr(d->hint, m->says));
        if (d->line != m->line || d->column != m->column || strcmp(d->code, m->code) || !said)
            fail_msg("%s\n gave %d:%d %s: %s (%s)", m->text, d->line, d->column, d->code,
                     d->message, d->hint ? d->hint : "");
    }
    jox_diag_free(&diagnostics);
    jox_lua_free(lua);
}

static void all_mistakes_of_a_file_are_reported_at_once(void **state) {
    (void)state;
    JoxLua *lua = jox_lua_create(NULL);
    assert_null(load_in(lua, NULL, SHEET("sped = 3, push = foo,\nhorizon = -1, face = bar")));
    assert_int_equal(diagnostics.errors, 4);
    jox_diag_free(&diagnostics);
    jox_lua_free(lua);
}

static void names_are_checked_against_the_scene(void **state) {
    (void)state;
    JoxPlace places[] = {{.name = "start_line", .kind = JOX_PLACE_LINE, .start = -1},
                         {.name = "kaaba", .kind = JOX_PLACE_POLYGON, .start = 0}};
    const char *tags[] = {"ball"};
    JoxScope scope = {
        .places = places, .place_count = 2, .tags = tags, .tag_count = 1, .complete = true};
    JoxLua *lua = jox_lua_create(NULL);
    assert_null(load_in(lua, &scope, SHEET("steer = orbit \"kaba\"")));
    assert_string_equal(diagnostics.items[0].code, "unknown-place");
    assert_string_equal(diagnostics.items[0].hint, "Did you mean 'kaaba'?");
    JoxMachine *m = load_in(lua, &scope, SHEET("steer = seek(nearest \"bal\"), ignore = \"ball\""));
    assert_non_null(m); /* a state may set the tag: known once all machines are there */
    assert_int_equal(m->belonging_count, 2);
    assert_int_equal(m->targets[m->states[0].steer[0].target].arg, 1);
    assert_int_equal(m->states[0].ignore, 1);
    jox_lua_release(lua, m);
    jox_machine_free(m);
    m = load_in(lua, &scope, SHEET("steer = orbit \"kaaba\""));
    assert_non_null(m);
    assert_int_equal(m->targets[m->states[0].steer[0].target].arg, 1);
    jox_machine_free(m);
    jox_diag_free(&diagnostics);
    jox_lua_free(lua);
}

/* Expects the operations of the only condition, in order of execution. */
static void expect_code(JoxLua *lua, const char *when, const JoxOp *ops, uint32_t count) {
    char text[512];
    snprintf(text, sizeof text,
             "local mine = memory { laps = 0, flag = false }\n"
             "return machine { name = \"m\", start = \"A\", states = { A = { "
             "{ to = \"A\", when = %s } } } }",
             when);
    JoxMachine *m = load_in(lua, NULL, text);
    if (!m)
        fail_msg("%s: %s", when, diagnostics.items[0].message);
    const JoxExpression *p = &m->expressions[m->states[0].transitions[0].when];
    assert_int_equal(p->count, count);
    for (uint32_t i = 0; i < count; i++)
        if (p->code[i].op != ops[i])
            fail_msg("%s: instruction %u is %d, not %d", when, i, p->code[i].op, ops[i]);
    jox_lua_release(lua, m);
    jox_machine_free(m);
}

static void conditions_compile_as_they_read(void **state) {
    (void)state;
    JoxLua *lua = jox_lua_create(NULL);
    const JoxOp lasted[] = {JOX_OP_LASTED};
    expect_code(lua, "lasted", lasted, 1);
    /* Method calls bind before ~, ~ before &, & before |. */
    const JoxOp mixed[] = {JOX_OP_LASTED, JOX_OP_NOW, JOX_OP_CONST,  JOX_OP_GT,
                           JOX_OP_NOT,    JOX_OP_AND, JOX_OP_MEMORY, JOX_OP_OR};
    expect_code(lua, "lasted & ~now.speed:above(2) | mine.flag", mixed, 8);
    const JoxOp number[] = {JOX_OP_CONST, JOX_OP_NOW,   JOX_OP_OWN, JOX_OP_MAX,
                            JOX_OP_MUL,   JOX_OP_CONST, JOX_OP_LT};
    expect_code(lua, "(30 * max(now.speed, own.speed)):below(9)", number, 7);
    const JoxOp place[] = {JOX_OP_PLACE_DENSITY, JOX_OP_CONST, JOX_OP_GT};
    expect_code(lua, "density(\"x\"):above(6)", place, 3);
    jox_diag_free(&diagnostics);
    jox_lua_free(lua);
}

static void the_sandbox_holds(void **state) {
    (void)state;
    static const char *const ATTACKS[] = {
        "while true do end",
        "local function f() return f() end return f()",
        "local function f() return 1 + f() end return f()",
        "local t = {} while true do t[#t + 1] = t end",
        "local s = \"x\" while true do s = s .. s end",
        "return (\"x\"):rep(1e9)",
        "return string.rep(\"x\", 1e18)",
        "for i = 1, 1e9 do local t = { i } end",
        "return load(\"return 1\")()",
        "return loadfile(\"/etc/passwd\")",
        "return dofile(\"/etc/passwd\")",
        "return io.open(\"/etc/passwd\")",
        "return os.getenv(\"HOME\")",
        "return debug.getregistry()",
        "return require(\"../../etc/passwd\")",
        "return require(\"/etc/passwd\")",
        "return package.path",
        "return coroutine.wrap(function() end)",
        "return collectgarbage(\"collect\")",
        "setmetatable({}, { __gc = function() while true do end end })",
        "getmetatable(\"\").__index = nil",
        "error(setmetatable({}, { __tostring = function() while true do end end }))",
        "math.huge = 3",
        "string.upper = nil",
        "_G.x = 1",
        "return _ENV",
        "goto a ::a:: goto a",
        "local t = {} for i = 1, 3000 do t[i] = i end for k in pairs(t) do end",
        "return ((((((((((((((((((((((((",
        "return {{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{",
        "\x1bLua",
        "",
        "local s = spread for i = 1, 60 do s = s + spread end s = 2 * s + s return 3",
        "local s = (\"x\"):rep(1e6) while true do local t = s .. s end",
        "local s = (\"x\"):rep(1e6) while true do s:upper() end",
    };
    JoxLua *lua = jox_lua_create(NULL);
    for (size_t i = 0; i < sizeof ATTACKS / sizeof *ATTACKS; i++) {
        clock_t begun = clock();
        JoxMachine *m = load_in(lua, NULL, ATTACKS[i]);
        if (m || diagnostics.errors == 0)
            fail_msg("not refused: %s", ATTACKS[i]);
        if ((double)(clock() - begun) / CLOCKS_PER_SEC > 5.0) /* a hang, even on a slow build */
            fail_msg("took %.1f s: %s", (double)(clock() - begun) / CLOCKS_PER_SEC, ATTACKS[i]);
    }
    JoxText many = {0}; /* unclosed tables must not be scanned again and again */
    for (int i = 0; i < 30000; i++)
        jox_text_add(&many, "machine{");
    jox_diag_free(&diagnostics);
    assert_null(load_in(lua, NULL, many.data));
    jox_text_free(&many);
    const char deep[] = "local e = now.speed for i = 1, 90000 do e = -e end\n" SHEET("");
    JoxMachine *unused = load_in(lua, NULL, deep);
    assert_non_null(unused); /* made, but of no use: only what a state names is compiled */
    jox_lua_release(lua, unused);
    jox_machine_free(unused);
    assert_null(load_in(lua, NULL,
                        "local e = now.speed for i = 1, 90000 do e = -e end\n" SHEET("push = e")));
    assert_string_equal(diagnostics.items[0].code, "too-complex");
    const char zero[] = "return \0 machine {}";
    jox_diag_free(&diagnostics);
    assert_null(jox_lua_load_text(lua, "t.lua", zero, sizeof zero - 1, NULL, &diagnostics));
    char *large = jox_alloc(10 << 20, 1);
    memset(large, '-', 10 << 20);
    jox_diag_free(&diagnostics);
    assert_null(jox_lua_load_text(lua, "t.lua", large, 10 << 20, NULL, &diagnostics));
    assert_non_null(strstr(diagnostics.items[0].message, "256 KB"));
    jox_free(large);
    jox_diag_free(&diagnostics);
    jox_lua_free(lua);
}

static const char *const SHIPPED[] = {"behaviours/tawaf.lua",    "behaviours/dodgeball.lua",
                                      "behaviours/player.lua",   "behaviours/walker.lua",
                                      "behaviours/runner.lua",   "behaviours/stander.lua",
                                      "behaviours/antipodal.lua"};

static void shipped_behaviours_load_and_their_prefixes_do_no_harm(void **state) {
    (void)state;
    JoxLua *lua = jox_lua_create(NULL);
    for (size_t i = 0; i < sizeof SHIPPED / sizeof *SHIPPED; i++) {
        size_t length;
        char *text = jox_read_file(SHIPPED[i], 1 << 20, &length);
        assert_non_null(text);
        for (size_t n = 0; n <= length; n += n < 200 ? 1 : 7) {
            jox_diag_free(&diagnostics);
            JoxMachine *m = jox_lua_load_text(lua, SHIPPED[i], text, n, NULL, &diagnostics);
            assert_true(m != NULL || diagnostics.errors > 0);
            jox_lua_release(lua, m);
            jox_machine_free(m);
        }
        jox_diag_free(&diagnostics);
        JoxMachine *m = jox_lua_load(lua, SHIPPED[i], NULL, &diagnostics);
        assert_non_null(m);
        uint32_t files;
        assert_string_equal(jox_lua_files(lua, m, &files)[0].path, SHIPPED[i]);
        jox_lua_release(lua, m);
        jox_machine_free(m);
        jox_free(text);
    }
    jox_diag_free(&diagnostics);
    jox_lua_free(lua);
}

/* If agents are called in turn, one in 64 calls of each agent is timed, for any number of them. */
static void each_agent_has_its_share_of_timed_calls(void **state) {
    (void)state;
    for (uint64_t people = 1; people <= 64; people++)
        for (uint64_t one = 0; one < people; one++) {
            uint32_t timed = 0;
            for (uint64_t round = 0; round < 6400; round++)
                timed += jox_lua_is_timed(round * people + one);
            if (timed < 75 || timed > 130) /* 100, and the first 16 calls of all */
                fail_msg("%u of 6400 calls of number %u of %u", timed, (unsigned)one,
                         (unsigned)people);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_agent_has_its_share_of_timed_calls),
        cmocka_unit_test(every_mistake_has_its_place),
        cmocka_unit_test(all_mistakes_of_a_file_are_reported_at_once),
        cmocka_unit_test(names_are_checked_against_the_scene),
        cmocka_unit_test(conditions_compile_as_they_read),
        cmocka_unit_test(the_sandbox_holds),
        cmocka_unit_test(shipped_behaviours_load_and_their_prefixes_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
