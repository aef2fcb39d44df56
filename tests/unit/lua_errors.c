/* Errors in behaviours: each is reported with its exact position, hint and part of the table. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "lua/loader.h"

typedef struct Mistake {
    const char *text;
    JoxSeverity severity;
    int line, column, end;
    const char *code, *says; /* says: part of the message, hint or context */
} Mistake;

#define ERROR JOX_SEVERITY_ERROR
#define WARNING JOX_SEVERITY_WARNING
#define HEAD "return machine { name = \"m\", start = \"A\", states = {\n"
static const Mistake MISTAKES[] = {
    {"local n = 0\n" HEAD "A = { on_enter = function(me)\n  n = n + 1\nend } } }", ERROR, 4, 3, 4,
     "assigned-upvalue", "memory"},
    {"local n = 0\nlocal function count() n = n + 1 end\n" HEAD
     "A = { on_enter = function() count() end } } }",
     ERROR, 2, 24, 25, "assigned-upvalue", "'n'"},
    {"local a = after(3)(4)\n" HEAD "A = {} } }", ERROR, 1, 16, 17, "bad-call", "cannot be called"},
    {HEAD "A = { steer = hold\n{ to = \"A\" } } } }", ERROR, 2, 0, 0, "bad-call", "comma missing"},
    {"local c = near(\"k\")\n" HEAD "A = {} } }", ERROR, 1, 11, 15, "bad-argument", "not nothing"},
    {"local a, b = = 1\n" HEAD "A = {} } }", ERROR, 1, 14, 15, "lua-error", "unexpected symbol"},
    {HEAD "A = { on_enter = me.laps = 1 } } }", ERROR, 2, 26, 27, "lua-error", "expected"},
    {HEAD "A = { { to = \"A\", chance = 3 } } } }", ERROR, 2, 19, 25, "out-of-range",
     "0 to 1, not"},
    {"local c = require \"../x\"\n" HEAD "A = {} } }", ERROR, 1, 19, 25, "bad-require",
     "not a plain name"},
    {"local c = require \"nowhere\"\n" HEAD "A = {} } }", ERROR, 1, 19, 28, "missing-file",
     "nowhere"},
    {HEAD "} }", ERROR, 1, 43, 49, "no-states", "at least one"},
    {"return patch \"tawaf\" {}", ERROR, 1, 8, 13, "not-a-mod", "patches/"},
    {"local x = settings.weight\n" HEAD "A = {} } }", ERROR, 1, 20, 26, "not-a-mod", "mods"},
    {"local mine = memory { laps = 0 }\nlocal c = mine.lap:is(3)\n" HEAD "A = {} } }", ERROR, 2, 16,
     19, "unknown-memory", "'laps'"},
    {"local mine = memory { laps = 0 }\n" HEAD "A = { set = { lap = 3 } } } }", ERROR, 3, 15, 18,
     "unknown-key", "'laps'"},
    {HEAD "A = { counts = { laps = circuits \"k\" } } } }", ERROR, 2, 18, 22, "unknown-memory",
     "memory { laps"},
    {"local c = now.speed:abov(3)\n" HEAD "A = {} } }", ERROR, 1, 21, 25, "unknown-method",
     "'above'"},
    {"local c = count(\"k\"):in_state(\"A\")\n" HEAD "A = {} } }", ERROR, 1, 22, 30, "bad-operand",
     "neighbours"},
    {HEAD "A = { { to = \"B\", when = after(1) } },\nB = { { to = \"A\" } },\nC = { { to = \"A\" } "
          "} } }",
     WARNING, 4, 1, 2, "unreachable-state", "'C'"},
    {HEAD "A = { { to = \"B\", when = after(1) } },\nB = { steer = drift(1, 0) } } }", WARNING, 3,
     1, 2, "no-way-out", "removes"},
    {"-- gr\xc3\xbc\xdf\n" HEAD "A = {} } }", ERROR, 1, 7, 8, "bad-text", "Latin-1"},
    {HEAD "A = { signal = \"a\\0b\" } } }", ERROR, 2, 18, 19, "bad-text", "zero byte"},
    {HEAD "A = { signal = 'ab\\x00' } } }", ERROR, 2, 19, 20, "bad-text", "zero byte"},
    {HEAD "A = { signal = 'a\\\\\\u{000}' } } }", ERROR, 2, 20, 21, "bad-text", "zero byte"},
    {HEAD "A = { signal = 'a\\z\n  \\00' } } }", ERROR, 3, 3, 4, "bad-text", "zero byte"},
    {HEAD "A = { signal = 'a\\\n\\0' } } }", ERROR, 3, 1, 2, "bad-text", "zero byte"},
    {"local x = \n" HEAD "A = {} } }", ERROR, 2, 1, 7, "lua-error", "unexpected symbol"},
    {HEAD "[\"`id`\"] = {}, A = {} } }", ERROR, 2, 2, 8, "bad-name", "no name for a state"},
    {"return machine { name = \"a\\nb\", start = \"A\", states = { A = {} } }", ERROR, 1, 18, 22,
     "bad-name", "no name for a machine"},
    {HEAD "A = { signal = 3 } } }", ERROR, 2, 7, 13, "bad-value", "a signal is a name"},
    {HEAD "A = { signal = { \"x\", every = 0 } } } }", ERROR, 2, 7, 13, "out-of-range", "every"},
    {HEAD "A = { throw = { nearest \"ball\", speed = 4 } } } }", ERROR, 2, 7, 12, "missing-key",
     "`at`"},
    {HEAD "A = { throw = { nearest \"ball\", at = \"x\" } } } }", ERROR, 2, 7, 12, "missing-key",
     "`speed`"},
    {HEAD "A = { kick = { at = \"x\", impulse = 3 } } } }", ERROR, 2, 7, 11, "bad-value",
     "first item"},
    {HEAD "A = { kick = { nearest \"ball\", impulse = 3, lift = 91 } } } }", ERROR, 2, 45, 49,
     "out-of-range", "0 to 90 degree"},
    {HEAD "A = { kick = { nearest \"ball\", impulse = 3, lift = -1 } } } }", ERROR, 2, 45, 49,
     "out-of-range", "0 to 90 degree"},
    {HEAD "A = { kick = { nearest \"ball\", impulse = 3, lift = \"up\" } } } }", ERROR, 2, 45, 49,
     "bad-value", "number"},
    {HEAD "A = { kick = { nearest \"ball\", speed = 51 } } } }", ERROR, 2, 32, 37, "out-of-range",
     "0 to 50 m/s"},
    {HEAD "A = { kick = { nearest \"ball\", impulse = 3, speed = 3 } } } }", ERROR, 2, 7, 11,
     "bad-value", "both"},
    {HEAD "A = { kick = { nearest \"ball\", impulse = 3, lfit = 30 } } } }", ERROR, 2, 45, 49,
     "unknown-key", "'lift'"},
    {HEAD "A = { throw = { nearest \"ball\", at = \"x\", speed = 3, lift = 30 } } } }", ERROR, 2,
     54, 58, "unknown-key", "unknown key 'lift'"},
    {HEAD "A = { turn = 0.4 } } }", ERROR, 2, 7, 11, "unknown-key", "see breadth and depth"},
    {HEAD "A = { become = 3 } } }", ERROR, 2, 7, 13, "bad-value", "name of a behaviour"},
    {HEAD "A = { steer = seek(goal) * seek(goal) } } }", ERROR, 2, 26, 27, "bad-operand",
     "steering"},
    {HEAD "A = { steer = follow(goal, after(1)) } } }", ERROR, 2, 15, 21, "bad-argument", "plain"},
    {HEAD "A = { steer = dodge(\"post\", 2) } } }", ERROR, 2, 15, 20, "bad-argument",
     "a body or an agent, as of `nearest`, not a place"},
    {HEAD "A = { steer = dodge(own.camp) } } }", ERROR, 2, 15, 20, "bad-argument", "not a place"},
    {"local c = incoming(home, 1)\n" HEAD "A = {} } }", ERROR, 1, 11, 19, "bad-argument",
     "not a place"},
    {"local c = incoming(goal, 1)\n" HEAD "A = {} } }", ERROR, 1, 11, 19, "bad-argument",
     "not a place"},
    {"local c = kicked(\"post\")\n" HEAD "A = {} } }", ERROR, 1, 11, 17, "bad-argument",
     "not a place"},
    {"local c = hit_by(3)\n" HEAD "A = {} } }", ERROR, 1, 11, 17, "bad-argument", "not number"},
    {"local c = nearest(\"ball\"):incoming(0)\n" HEAD "A = {} } }", ERROR, 1, 27, 35,
     "out-of-range", "0.01 to 100 m"},
    {"local c = nearest(\"anyone\"):flying()\n" HEAD "A = {} } }", ERROR, 1, 29, 35, "bad-operand",
     "tag of bodies"},
    {"local c = nearest(\"b\"):flying():in_state(\"A\")\n" HEAD "A = {} } }", ERROR, 1, 33, 41,
     "bad-operand", "of bodies"},
    {"local c = goal:incoming(1)\n" HEAD "A = {} } }", ERROR, 1, 16, 24, "bad-operand",
     "nothing of"},
    {HEAD "A = { take = home } } }", ERROR, 2, 7, 11, "bad-value", "not a place"},
    {HEAD "A = { approach = \"post\" } } }", ERROR, 2, 7, 15, "bad-value", "not a place"},
    {HEAD "A = { kick = { goal, impulse = 3 } } } }", ERROR, 2, 7, 11, "bad-value", "not a place"},
    {HEAD "A = { lasts = \"long\" } } }", ERROR, 2, 7, 12, "bad-value", "number"},
    {HEAD "A = { colour = \"gren\" } } }", ERROR, 2, 7, 13, "bad-value", "'gren' is no colour"},
    {HEAD "A = { colour = 7 } } }", ERROR, 2, 7, 13, "bad-value", "colour must be a text"},
    {HEAD "A = { push_weight = \"most\" } } }", ERROR, 2, 7, 18, "bad-value", "nearest"},
    {HEAD "A = { { to = \"A\", chance = 2 } } } }", ERROR, 2, 19, 25, "out-of-range",
     "transition 1 (to A)"},
    {HEAD "A = { { to = \"A\", when = after(1) | stuk(15) } } } }", ERROR, 2, 37, 41,
     "unknown-word", "machine m > state A > transition 1 (to A)"},
    {HEAD "A = {},\n[3] = {} } }", ERROR, 1, 43, 49, "bad-value", "names"},
    {HEAD "A = 3 } }", ERROR, 2, 1, 2, "bad-value", "tables"},
    {"return machine { start = \"A\", states = { A = {} } }", ERROR, 0, 0, 0, "missing-key",
     "name"},
    {"return machine { name = \"m\", version = \"2\", start = \"A\", states = { A = {} } }", ERROR,
     1, 30, 37, "bad-value", "not string"},
    {"return machine { name = \"m\", version = 1 / 0, start = \"A\", states = { A = {} } }", ERROR,
     1, 30, 37, "bad-value", "finite"},
    {"return machine { name = \"m\", start = \"B\", states = { A = {} } }", ERROR, 1, 30, 35,
     "unknown-state", "'B'"},
    {"return machine { name = \"m\", start = \"A\", defaults = 3, states = { A = {} } }", ERROR, 1,
     43, 51, "bad-value", "table"},
    {"return machine { name = \"m\", start = \"A\", renamed = { B = 3 }, states = { A = {} } }",
     ERROR, 1, 43, 50, "bad-value", "old names"},
    {"return machine { name = \"m\", start = \"A\", renamed = { B = \"C\" }, states = { A = {} } }",
     WARNING, 1, 55, 56, "unknown-name", "there is no state, own value or memory 'C'"},
    {"return machine { name = \"m\", start = \"A\", renamed = { B = \"A\" },\n"
     "states = { A = { { to = \"B\", when = after(1) } } } }",
     ERROR, 2, 25, 28, "renamed", "'B' is called 'A' now"},
    {HEAD "A = { steer = hold, pose = 'rase' } } }", ERROR, 2, 21, 25, "bad-value",
     "Did you mean 'raise'?"},
    {HEAD "A = { steer = hold, lies = 1 } } }", ERROR, 2, 21, 25, "bad-value",
     "lies must be true or false"},
    {HEAD "A = { steer = hold speed = 2 } } }", ERROR, 2, 20, 25, "lua-error",
     "comma missing before 'speed'"},
    {HEAD "A = { transitions = {} } } }", ERROR, 2, 7, 18, "unknown-key", "items of the state"},
    {HEAD "A = { to = \"A\" } } }", ERROR, 2, 7, 9, "unknown-key", "items of the state"},
    {HEAD "A = { { to = \"A\", when = seek \"goal\" } } } }", ERROR, 2, 19, 23, "bad-condition",
     "near(goal, 1)"},
    {"local b = nearest(ball)\n" HEAD "A = {} } }", ERROR, 1, 19, 23, "unknown-word", "in quotes"},
    {HEAD "A = { speed = \"5 km/h\" } } }", ERROR, 2, 7, 12, "bad-value", "in m/s"},
    {HEAD "A = { { to = \"B\" }, { to = \"B\", when = after(1) } },\nB = { steer = hold } } }",
     WARNING, 2, 21, 22, "never-fires", "always taken"},
    {HEAD "A = { { to = \"B\", when = lasted } },\nB = { steer = hold } } }", WARNING, 2, 7, 8,
     "never-fires", "lasts = 5"},
    {HEAD "A = { { to = \"B\" } },\nB = { { to = \"A\" } } } }", WARNING, 2, 1, 2, "no-time",
     "after(1)"},
    {HEAD "A = { perception = 3, { to = \"B\", when = near(nearest \"anyone\", 5) } },\n"
          "B = { steer = hold } } }",
     WARNING, 2, 23, 24, "out-of-sight", "perception is 3 m"},
    {"local w = heard(3)\n" HEAD "A = {} } }", ERROR, 1, 11, 16, "bad-argument", "a name"},
    {"local w = neighbours(3)\n" HEAD "A = {} } }", ERROR, 1, 11, 21, "bad-argument", "a tag"},
    {"local w = after(1, 2)\n" HEAD "A = {} } }", ERROR, 1, 11, 16, "bad-argument", "1 argument"},
    {"local w = orbit(\"k\", { inwards = 2 })\n" HEAD "A = {} } }", ERROR, 1, 24, 31,
     "bad-argument", "'inwards'"},
    {"local inner = machine { start = \"I\", states = {\n I = { { to = \"J\" } } } }\n" HEAD
     "A = { runs = inner } } }",
     ERROR, 2, 10, 12, "unknown-state", "state I > transition 1"},
    {HEAD "A = { runs = machine { start = \"I\", states = { I = {\n push = -1 } } } } } }", ERROR,
     3, 2, 6, "out-of-range", "machine m > state A > state I"},
    {HEAD "A = { runs = machine { start = \"I\", states = { I = { { to = \"A\" } } } } } } }",
     ERROR, 2, 56, 58, "unknown-state", "ask `done`"},
    {HEAD "A = { runs = 3 } } }", ERROR, 2, 7, 11, "bad-value", "needs a machine, not number"},
    {HEAD "A = { runs = { states = {} } } } }", ERROR, 2, 7, 11, "bad-value", "machine { ... }"},
    {"local t = {}\nlocal m = machine { name = \"m\", start = \"A\", states = { A = t } }\n"
     "t.runs = m\nreturn m",
     ERROR, 3, 3, 7, "runs-itself", "runs the machine that it is in"},
    {"local function within(m) return machine { start = \"I\", states = { I = { runs = m } } } "
     "end\n"
     "local m = machine { start = \"Z\", states = { Z = {} } }\n" HEAD
     "A = { runs = within(within(within(m))) } } }",
     ERROR, 1, 73, 77, "too-deep", "depth of 4"},
    {HEAD "[\"A.b\"] = { runs = machine { start = \"I\", states = { I = {} } } }, A = {} } }",
     ERROR, 2, 2, 7, "bad-name", "no dot"},
    {HEAD "A = { removes = true, runs = machine { start = \"I\", states = { I = {} } } } } }",
     ERROR, 2, 7, 14, "bad-value", "runs a machine"},
    {HEAD "A = { { to = \"A\", when = done } } } }", ERROR, 2, 19, 23, "no-machine",
     "runs = machine"},
    {HEAD "A = { runs = machine { start = \"I\", states = { I = {}, J = {} } } } } }", WARNING, 2,
     56, 57, "unreachable-state", "'J'"},
    {HEAD "A = { steer = hold },\n"
          "B = { runs = machine { start = \"I\", states = { I = {}, J = {} } } } } }",
     WARNING, 3, 1, 2, "unreachable-state", "state 'B'"},
    {HEAD "A = { runs = sequence { wait(1),\n wander() } } } }", ERROR, 3, 2, 8, "bad-step",
     "does not end by itself"},
    {HEAD "A = { runs = sequence { \"x\", \"y\", wait(1) } } } }", ERROR, 2, 30, 33, "bad-step",
     "second name"},
    {HEAD "A = { runs = sequence { wait(1), \"x\" } } } }", ERROR, 2, 34, 37, "bad-step",
     "belongs after a name"},
    {HEAD "A = { runs = sequence { wait(1), { steer = hold, lasts = -1 } } } } }", ERROR, 2, 50, 55,
     "out-of-range", "step 2"},
    {"local w = wait(\"x\")\n" HEAD "A = {} } }", ERROR, 1, 11, 15, "bad-argument", "seconds"},
    {"local w = sequence {}\n" HEAD "A = {} } }", ERROR, 1, 11, 19, "bad-argument", "steps"},
    /* several of one word on a line */
    {"local c = near(\"k\") & near(\"l\", 3)\n" HEAD "A = {} } }", ERROR, 1, 11, 15, "bad-argument",
     "nothing"},
    {"local c = min(\"x\", max(1, min(2, 3)))\n" HEAD "A = {} } }", ERROR, 1, 11, 14,
     "bad-argument", "argument 1 of min"},
    {HEAD "A = { runs = machine { start = \"I\", states = { I = { sped = 1 } } } }, B = { runs = "
          "machine { start = \"I\", states = { I = {} } } } } }",
     ERROR, 2, 54, 58, "unknown-key", "machine m > state A > state I"},
    {"local a, b = machine { start = \"I\", states = { I = {} } }, machine { start = \"I\", "
     "states = { I = { sped = 1 } } }\n" HEAD "A = { runs = a }, B = { runs = b } } }",
     ERROR, 1, 100, 104, "unknown-key", "state I"},
    {"local p = machine { start = \"I\", own = { c = 1 }, states = { I = {} } }\n"
     "local q = machine { start = \"I\", own = { c = 2 }, states = { I = {} } }\n" HEAD
     "A = { runs = p, { to = \"B\", when = after(1) } },\nB = { runs = q } } }",
     WARNING, 2, 42, 43, "doubled-own", "own.c is declared otherwise at t.lua:1:42"},
    {HEAD "A = { runs = machine { start = \"I\", states = { I = {} } } },\n[\"A.I\"] = {} } }",
     ERROR, 3, 2, 7, "bad-name", "that 'A' runs, at t.lua:2:48"},
    {"local mine = memory { laps = 0, state = 0 }\n" HEAD
     "A = { steer = hold, on_enter = function(me) me.laps = 1 end } } }",
     WARNING, 1, 33, 38, "hidden-field", "hides me.state: name of its state"},
    {"local mine = memory { speed = 0 }\n" HEAD
     "A = { steer = hold, on_enter = function(me) me.speed = 1 end } } }",
     WARNING, 1, 23, 28, "hidden-field", "hides me.speed"},
    {HEAD
     "A = { runs = machine { start = \"I\", states = { I = {} } }, { to = \"B\", when = done } "
     "},\nB = { steer = hold } } }",
     WARNING, 2, 72, 76, "never-fires", "that 'A' runs ends it"},
    {HEAD
     "A = { runs = sequence { { runs = machine { start = \"I\", states = { I = {} } } } } } } }",
     WARNING, 2, 25, 26, "never-fires", "step 1"},
    {HEAD "A = { runs = sequence { { steer = hold, when = joined \"q\" } } } } }", WARNING, 2, 41,
     45, "never-fires", "does not queue"},
    {HEAD "A = { steer = queue \"p\", { to = \"B\", when = first_in \"q\" } },\n"
          "B = { steer = hold } } }",
     WARNING, 2, 38, 42, "never-fires", "does not queue"},
    /* words of people who know each other */
    {HEAD "A = { steer = seek(other) } } }", ERROR, 2, 20, 25, "bad-value", "best(\"people\""},
    {"local b = best(\"p\", best(\"q\", other.x).x)\n" HEAD "A = { face = b } } }", ERROR, 1, 21,
     25, "too-complex", "score of another"},
    {"local b = best(nearest \"p\", other.x)\n" HEAD "A = {} } }", ERROR, 1, 11, 15, "bad-argument",
     "filters follow it"},
    {"local b = nearest(own.x)\n" HEAD "A = {} } }", ERROR, 1, 11, 18, "bad-argument",
     "seek(own.x)"},
    {"local b = sees(nearest \"p\", 5)\n" HEAD "A = {} } }", ERROR, 1, 11, 15, "bad-argument",
     "sees(nearest(\"people\"):within(5))"},
    {"local b = neighbours(\"p\", 5)\n" HEAD "A = {} } }", ERROR, 1, 11, 21, "bad-argument",
     "neighbours(\"people\"):within(5)"},
    {"local mine = memory { ids = list(3) }\nlocal a = mine.ids[1]\n" HEAD "A = {} } }", ERROR, 2,
     16, 19, "bad-operand", ".first and .last"},
    {"local mine = memory { ids = list(3) }\n" HEAD
     "A = { steer = hold, on_enter = function(me) me.ids[1] = 3 end } } }",
     ERROR, 3, 48, 51, "copied-list", "changes the copy alone"},
    {"local mine = memory { ids = list(3) }\n" HEAD
     "A = { steer = hold, on_enter = function(me) table.insert(me.ids, 3) end } } }",
     ERROR, 3, 61, 64, "copied-list", "me.NAME = list"},
    {"local mine = memory { ids = list(3) }\nlocal a = #mine.ids\n" HEAD "A = {} } }", ERROR, 2, 11,
     12, "bad-operator", ".size"},
    {"local mine = memory { ids = list(3) }\n" HEAD
     "A = { tell = { nearest \"p\", \"go\", all = mine.ids } } } }",
     ERROR, 3, 35, 38, "bad-value", "one message for each item"},
    {"local mine = memory { on = false }\n" HEAD "A = { set = { on = now.speed } } } }", ERROR, 3,
     15, 17, "bad-value", "becomes a condition by"},
    {HEAD "A = { { to = \"back\", when = after(1) } } } }", ERROR, 2, 9, 11, "unknown-state",
     "without quotes: to = back"},
    {"local mine = memory { a = 0 }\nlocal n = mine.pain:above(1)\n" HEAD "A = {} } }", ERROR, 2,
     16, 20, "unknown-memory", "own.pain"},
    {"local mine = memory { met = list(3) }\n" HEAD "A = { set = { met = push(mine.met, 1) } } } }",
     ERROR, 3, 21, 25, "unknown-word", "mine.met:push(value)"},
    {HEAD "A = { steer = seek(sender) } } }", ERROR, 2, 20, 26, "unknown-word", "shot.sender"},
    {"local need = told \"need\"\nlocal mine = memory { who = nobody }\n" HEAD
     "A = { { to = \"A\", when = need:from(mine.who) } } } }",
     ERROR, 4, 31, 35, "bad-call", "same(need.sender"},
    {"local b = best(\"p\", other.team)\n" HEAD "A = { face = b } } }", ERROR, 1, 27, 31,
     "unknown-method", "opponents"},
    {"local b = best(\"p\", other.id)\n" HEAD "A = { face = b } } }", ERROR, 1, 27, 29,
     "unknown-method", "same(a, b)"},
    {"local mine = memory { who = nobody }\n" HEAD "A = { steer = seek(mine.who) } } }", WARNING, 1,
     23, 26, "unset-memory", "it stays nobody"},
    {"local mine = memory { ids = list(3) }\n" HEAD "A = { speed = mine.ids.size } } }", WARNING, 1,
     23, 26, "unset-memory", "mine.ids:push(...)"},
    {"local mine = memory { ids = list(3) }\n" HEAD "A = { set = { ids = mine.ids:push(1) },\n"
     "{ to = \"B\", when = mine.ids.size:at_least(4) } }, B = { steer = hold } } }",
     WARNING, 4, 13, 17, "never-fires", "holds at most 3 items"},
    {"local mine = memory { who = nobody }\nlocal need = told \"need\"\n" HEAD
     "A = { steer = seek(mine.who),\n{ when = after(1), set = { who = need.sender } } } } }",
     WARNING, 5, 1, 2, "unasked-message", "when = told \"need\""},
};

static void each_kind_of_mistake_has_its_place(void **state) {
    (void)state;
    int wrong = 0;
    for (size_t i = 0; i < sizeof MISTAKES / sizeof *MISTAKES; i++) {
        const Mistake *m = &MISTAKES[i];
        JoxDiagnostics diagnostics = {0};
        JoxLua *lua = jox_lua_create(NULL);
        jox_machine_free(
            jox_lua_load_text(lua, "t.lua", m->text, strlen(m->text), NULL, &diagnostics));
        bool found = false;
        for (size_t d = 0; d < diagnostics.count; d++) {
            const JoxDiagnostic *item = &diagnostics.items[d];
            found |=
                item->severity == m->severity && item->line == m->line &&
                item->column == m->column && item->end_column == m->end &&
                !strcmp(item->code, m->code) &&
                (strstr(item->message, m->says) || (item->hint && strstr(item->hint, m->says)) ||
                 (item->context && strstr(item->context, m->says)));
        }
        if (!found) {
            JoxText text = {0};
            jox_diag_json(&diagnostics, &text);
            printf("wanted %d:%d-%d %s '%s' for\n%s\ngot %s\n", m->line, m->column, m->end, m->code,
                   m->says, m->text, text.data);
            jox_text_free(&text);
            wrong++;
        }
        jox_diag_free(&diagnostics);
        jox_lua_free(lua);
    }
    assert_int_equal(wrong, 0);
}

/* Compares a printed error, with the source line and context, to its text. Columns are characters,
   also behind letters of two bytes. */
static void an_error_is_shown_in_full(void **state) {
    (void)state;
    static const char SHEET[] =
        "return machine { name = \"tawaf\", start = \"ToStone\", states = {\n"
        "  ToStone = {\n"
        "    { --[[ zurück ]] to = \"ToStone\", when = after(90) | stuk(15) } } } }";
    static const char SHOWN[] =
        "behaviours/t.lua:3:57: unknown word 'stuk'. Did you mean 'stuck'?\n"
        "    3 |     { --[[ zurück ]] to = \"ToStone\", when = after(90) | stuk(15) } } } }\n"
        "      |                                                         ^^^^\n"
        " machine tawaf > state ToStone > transition 1 (to ToStone)\n";
    JoxDiagnostics diagnostics = {0};
    JoxText text = {0};
    JoxLua *lua = jox_lua_create(NULL);
    assert_null(
        jox_lua_load_text(lua, "behaviours/t.lua", SHEET, strlen(SHEET), NULL, &diagnostics));
    jox_diag_print(&diagnostics, &text);
    assert_string_equal(text.data, SHOWN);
    jox_text_free(&text);
    jox_diag_free(&diagnostics);
    jox_lua_free(lua);
}

/* An error in a machine that two states run is reported once, and leaves room for others. */
static void an_error_of_a_shared_machine_comes_once(void **state) {
    (void)state;
    static const char SHEET[] =
        "local p = machine { start = \"I\", states = { I = { sped = 1 }, J = { { to = \"K\" } } } "
        "}\n" HEAD "A = { runs = p, { to = \"B\", when = after(1) } },\nB = { runs = p } } }";
    static const char UNREACHED[] =
        "local p = machine { start = \"I\", states = { I = { steer = hold }, J = { steer = hold } "
        "} }\n" HEAD "A = { runs = p, { to = \"B\", when = after(1) } },\nB = { runs = p } } }";
    JoxDiagnostics diagnostics = {0};
    JoxLua *lua = jox_lua_create(NULL);
    assert_null(jox_lua_load_text(lua, "t.lua", SHEET, strlen(SHEET), NULL, &diagnostics));
    assert_int_equal(diagnostics.errors, 2);
    assert_int_equal(diagnostics.count, 2);
    jox_diag_free(&diagnostics);
    diagnostics = (JoxDiagnostics){0};
    jox_machine_free(
        jox_lua_load_text(lua, "t.lua", UNREACHED, strlen(UNREACHED), NULL, &diagnostics));
    assert_int_equal(diagnostics.warnings, 1);
    jox_diag_free(&diagnostics);
    jox_lua_free(lua);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_kind_of_mistake_has_its_place),
                                       cmocka_unit_test(an_error_of_a_shared_machine_comes_once),
                                       cmocka_unit_test(an_error_is_shown_in_full)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
