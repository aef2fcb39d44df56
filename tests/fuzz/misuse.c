/* Makes a behaviour by choosing among productions of Lua's grammar: functions, tests, loops and
   tables over values of the language. The parser must read all that Lua accepts to its end, and the
   search for misuse must end in a machine or in errors. */
#include <lauxlib.h>
#include <lua.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "lua/loader.h"
#include "lua/vm/syntax.h"
#include "support/fuzz.h"

typedef struct Choices {
    const uint8_t *at, *end;
    JoxText out;
    int depth;
} Choices;

enum { DEEPEST = 12, LONGEST = 16000 };

static uint32_t pick(Choices *c, uint32_t sides) {
    return c->at < c->end ? *c->at++ % sides : 0;
}

static void add_source(Choices *c, const char *text) {
    jox_text_add(&c->out, text);
}

#define ADD_ONE_OF(c, ...)                                                                         \
    do {                                                                                           \
        static const char *const CHOICES[] = {__VA_ARGS__};                                        \
        add_source(c, CHOICES[pick(c, sizeof CHOICES / sizeof *CHOICES)]);                         \
    } while (0)

static void add_block(Choices *c);
static void add_expression(Choices *c);

static void add_name(Choices *c) {
    ADD_ONE_OF(c, "a", "b", "c", "far", "mine", "goal", "lasted", "now", "self", "_ENV");
}

/* ---- expressions ---- */

static void add_list(Choices *c) {
    add_expression(c);
    for (uint32_t n = pick(c, 3); n > 0; n--) {
        add_source(c, ", ");
        add_expression(c);
    }
}

static void add_function_body(Choices *c) {
    ADD_ONE_OF(c, "()", "(a)", "(a, b)", "(...)", "(a, ...)", "(self, far, goal)");
    add_source(c, " ");
    add_block(c);
    add_source(c, " end");
}

static void add_table(Choices *c) {
    add_source(c, "{");
    for (uint32_t n = pick(c, 4); n > 0; n--) {
        ADD_ONE_OF(c, "", "a = ", "far = ", "['a'] = ", "[1] = ", "[far] = ");
        add_expression(c);
        ADD_ONE_OF(c, ", ", "; ");
    }
    add_source(c, "}");
}

/* Adds an expression that may be called, indexed or assigned to. */
static void add_suffixed(Choices *c) {
    if (pick(c, 8) == 7) {
        add_source(c, "(");
        add_expression(c);
        add_source(c, ")");
    } else {
        add_name(c);
    }
    for (uint32_t n = pick(c, 3); n > 0; n--)
        switch (pick(c, 7)) {
        case 0:
        case 1:
            ADD_ONE_OF(c, ".laps", ".met", ".a", ".far");
            break;
        case 2:
            add_source(c, "[");
            add_expression(c);
            add_source(c, "]");
            break;
        case 3:
            ADD_ONE_OF(c, ":above", ":is", ":a", ":where");
            ADD_ONE_OF(c, "(1)", "'x'", "()", "{}");
            break;
        case 4:
            ADD_ONE_OF(c, " 'x'", " [[x]]", " [==[]x]==]", "''");
            break;
        case 5:
            add_table(c);
            break;
        default:
            add_source(c, "(");
            add_list(c);
            add_source(c, ")");
        }
}

static void add_simple(Choices *c) {
    switch (pick(c, 8)) {
    case 0:
        ADD_ONE_OF(c, "nil", "false", "true", "...", "1", "0x.8p1", "3e-2", "1//2", "'x'", "[[y]]");
        break;
    case 1:
        ADD_ONE_OF(c, "after(1)", "near('spot')", "nearest 'people'", "heard 'run'", "now.speed",
                   "mine.laps", "mine.met", "seek(goal)", "lasted", "require 'far'", "own.far",
                   "gather('hall', 90)", "stuck(2)", "chance(0.5)", "uniform(1, 2)");
        break;
    case 2:
        add_source(c, "function");
        add_function_body(c);
        break;
    case 3:
        add_table(c);
        break;
    default:
        add_suffixed(c);
    }
}

static void add_expression(Choices *c) {
    const bool full = ++c->depth > DEEPEST || c->out.length > LONGEST;
    const uint32_t kind = full ? 0 : pick(c, 8);
    if (full) {
        add_source(c, "a");
    } else if (kind < 4) {
        add_simple(c);
    } else if (kind == 4) {
        ADD_ONE_OF(c, "not ", "- ", "#", "~");
        add_expression(c);
    } else {
        add_expression(c);
        ADD_ONE_OF(c, " and ", " or ", " == ", " ~= ", " & ", " | ", "..", " < ", "^", " >> ",
                   " // ", " ~ ", " + ", " % ");
        add_expression(c);
    }
    c->depth--;
}

/* ---- statements ---- */

static void add_loop(Choices *c) {
    switch (pick(c, 4)) {
    case 0:
        ADD_ONE_OF(c, "for a = 1, 2 do ", "for k, a in pairs(b) do ",
                   "for _, a in ipairs{far} do ");
        break;
    case 1:
        add_source(c, "while ");
        add_expression(c);
        add_source(c, " do break; ");
        break;
    case 2:
        add_source(c, "repeat ");
        add_block(c);
        add_source(c, " break until ");
        add_expression(c);
        return;
    default:
        add_source(c, "do ");
    }
    add_block(c);
    add_source(c, " end");
}

static void add_test(Choices *c) {
    add_source(c, "if ");
    add_expression(c);
    add_source(c, " then ");
    add_block(c);
    if (pick(c, 3) == 2) {
        add_source(c, " elseif ");
        add_expression(c);
        add_source(c, " then ");
        add_block(c);
    }
    if (pick(c, 3) == 2) {
        add_source(c, " else ");
        add_block(c);
    }
    add_source(c, " end");
}

static void add_declaration(Choices *c) {
    add_source(c, "local ");
    if (pick(c, 4) == 3) {
        add_source(c, "function ");
        add_name(c);
        add_function_body(c);
        return;
    }
    add_name(c);
    ADD_ONE_OF(c, "", "", "", ", a", ", far, b", " <const>", " <close>");
    if (pick(c, 5) == 4)
        return;
    add_source(c, " = ");
    add_list(c);
}

static void add_statement(Choices *c) {
    switch (pick(c, 8)) {
    case 0:
        add_test(c);
        break;
    case 1:
        add_loop(c);
        break;
    case 2:
    case 3:
        add_declaration(c);
        break;
    case 4:
        add_source(c, "function ");
        add_name(c);
        ADD_ONE_OF(c, "", ".a", ".far.laps", ":a");
        add_function_body(c);
        break;
    case 5:
        ADD_ONE_OF(c, "goto on", "::on::", "break", ";", "return", "return;", "return a and far");
        break;
    case 6:
        add_suffixed(c);
        add_source(c, "(a)");
        break;
    default:
        add_suffixed(c);
        ADD_ONE_OF(c, ".a", "[far]", ".laps, b");
        add_source(c, " = ");
        add_list(c);
    }
}

static void add_block(Choices *c) {
    if (++c->depth < DEEPEST && c->out.length < LONGEST)
        for (uint32_t n = pick(c, 4); n > 0; n--) {
            add_statement(c);
            ADD_ONE_OF(c, "\n", "; ", " -- far\n", " --[[ a ]] ");
        }
    c->depth--;
}

/* ---- one input ---- */

static void check_parser(const JoxText *text) {
    lua_State *lua = luaL_newstate();
    FUZZ_CHECK(lua);
    if (luaL_loadbufferx(lua, text->data, text->length, "=fuzz", "t") == LUA_OK) {
        JoxSource source = {.text = text->data, .length = text->length};
        jox_source_scan(&source);
        JoxSyntax *syntax = jox_syntax_read(&source);
        FUZZ_CHECK(syntax->whole);
        jox_syntax_free(syntax);
        jox_free(source.tokens);
    }
    lua_close(lua);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const JoxScope ANY = {.complete = false};
    Choices c = {data, data + size, {0}, 0};
    add_source(
        &c,
        "local mine = memory { laps = 0, met = false }\nlocal a, far = after(1), near 'spot'\n");
    for (uint32_t n = 1 + pick(&c, 8); n > 0; n--) {
        add_statement(&c);
        add_source(&c, "\n");
    }
    add_source(
        &c, "return machine { name = 'm', start = 'A', states = { A = { steer = hold, { to = 'A', "
            "when = ");
    add_expression(&c);
    add_source(&c, " } } } }\n");
    if (getenv("FUZZ_SHOW"))
        puts(c.out.data);
    check_parser(&c.out);
    JoxLuaLimits limits = jox_lua_default_limits();
    limits.load_instructions = 100000;
    JoxDiagnostics diagnostics = {0};
    JoxLua *lua = jox_lua_create(&limits);
    JoxMachine *machine =
        jox_lua_load_text(lua, "behaviours/fuzz.lua", c.out.data, c.out.length, &ANY, &diagnostics);
    FUZZ_CHECK((machine != NULL) == (diagnostics.errors == 0));
    jox_machine_free(machine);
    jox_lua_free(lua);
    fuzz_end_diagnostics(&diagnostics);
    jox_text_free(&c.out);
    return 0;
}
