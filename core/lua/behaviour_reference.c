#include "lua/behaviour_reference.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lua/language/vocabulary.h"
#include "lua/test_words.h"

static const struct Section {
    const char *title, *intro;
    JoxNodeKind makes;
} SECTIONS[] = {
    {"Conditions", "Joined by `&`, `|` and `~`; method calls bind before `~`, then `&`, then `|`.",
     JOX_NODE_CONDITION},
    {"Numbers",
     "Joined by `+ - * /`; made conditions by `:above(n)`, `:below(n)`, `:at_least(n)`, "
     "`:at_most(n)` and `:is(n)`.",
     JOX_NODE_NUMBER},
    {"Targets",
     "Where a target is asked for, the name of a place does as well. Walls that are open, and "
     "those "
     "lower than 1.3 m, hide nobody. A body hides whoever is behind it if it reaches above 1.3 m, "
     "is "
     "at least half a metre wide and nobody carries it.",
     JOX_NODE_TARGET},
    {"Steering", "Weighted sums: `0.8 * seek(goal) + 0.2 * spread`.", JOX_NODE_STEER},
    {"Drawn values", "For `defaults`, parameters and `lasts`.", JOX_NODE_DIST},
    {"Counting", "", JOX_NODE_CIRCUITS},
    {"The machine's table, and others", "", 0},
};

/* Prints text into a cell of a Markdown table; | is escaped. */
static void print_cell(JoxText *out, const char *text) {
    for (const char *c = text; *c; c++) {
        if (*c == '|')
            jox_text_add(out, "\\");
        jox_text_append(out, c, 1);
    }
}

static void print_words(JoxText *out, const struct Section *section) {
    jox_text_printf(out, "\n### %s\n\n%s%s| word | unit | meaning | example |\n|---|---|---|---|\n",
                    section->title, section->intro, *section->intro ? "\n\n" : "");
    for (size_t w = 0; w < jox_word_count; w++) {
        const JoxWord *word = &jox_words[w];
        if (word->makes != section->makes)
            continue;
        jox_text_add(out, "| `");
        print_cell(out, word->signature);
        jox_text_printf(out, "` | %s | ", word->unit);
        print_cell(out, word->meaning);
        const JoxWordNumber *number;
        for (uint32_t n = 0; (number = jox_word_number(word->name, n)); n++) {
            jox_text_printf(out, "%s`%s` %g to %g%s%s", n ? ", " : "; ", number->name,
                            number->least, number->greatest, *number->unit ? " " : "",
                            number->unit);
            if (!isnan(number->standard))
                jox_text_printf(out, ", default %g", number->standard);
        }
        jox_text_add(out, " | `");
        print_cell(out, word->example);
        jox_text_add(out, "` |\n");
    }
}

static void print_keys(JoxText *out, const char *owner, const char *title, const char *intro) {
    jox_text_printf(
        out, "\n### %s\n\n%s%s| key | what | unit | meaning | example |\n|---|---|---|---|---|\n",
        title, intro, *intro ? "\n\n" : "");
    for (size_t k = 0; k < jox_table_key_count; k++) {
        const JoxTableKey *key = &jox_table_keys[k];
        if (strcmp(key->owner, owner) != 0)
            continue;
        jox_text_printf(out, "| `%s` | ", key->name);
        print_cell(out, key->type);
        jox_text_printf(out, " | %s | ", key->unit);
        print_cell(out, key->meaning);
        jox_text_add(out, " | `");
        print_cell(out, key->example);
        jox_text_add(out, "` |\n");
    }
}

/* Returns a value in a parameter's range that is not its default. */
static double get_sample_value(const JoxParameterInfo *p) {
    if (p == &jox_parameters[JOX_PARAM_breadth])
        return 0.5; /* more than the depth that the default radius gives */
    double value = p->value + 0.25 * ((p->value < 1.0 ? 1.0 : p->value));
    return value > p->greatest ? p->greatest : value;
}

/* Prints the functions of tests and the methods of their scenes. */
static void print_tests(JoxText *out) {
    jox_text_add(out,
                 "\n## Tests\n\nA file NAME_test.lua has tests, which `jostle test` runs. `s` is a "
                 "scene. Options are tables, as\n`s:reaches(\"Exit\", { within = 20, agents "
                 "= \"visitors\" })`.\n\n| function | meaning |\n|---|---|\n");
    for (size_t w = 0; w < jox_test_word_count; w++)
        jox_text_printf(out, "| `%s` | %s |\n", jox_test_words[w].signature,
                        jox_test_words[w].meaning);
    jox_text_add(out, "\n| options of | option | meaning |\n|---|---|---|\n");
    for (size_t o = 0; o < jox_test_option_count; o++) {
        const JoxTestOption *option = &jox_test_options[o];
        const char *separator = "";
        jox_text_add(out, "| ");
        char class[48];
        snprintf(class, sizeof class, "jostle.%.30s", option->owner);
        for (size_t w = 0; w < jox_test_word_count; w++)
            if (strstr(jox_test_words[w].types, class)) {
                jox_text_printf(out, "%s`%s`", separator,
                                jox_test_words[w].name + (*jox_test_words[w].name == ':'));
                separator = ", ";
            }
        jox_text_printf(out, " | `%s` | %s |\n", option->name, option->meaning);
    }
}

void jox_lua_reference(JoxText *out) {
    jox_text_add(
        out,
        "# Every word of behaviours\n\n"
        "Made by `jostle reference behaviours`; every example is run by the tests. SI units\n"
        "throughout. A behaviour is a file that returns one `machine`; README.md of this folder\n"
        "begins with an empty one.\n\n## Words\n");
    for (size_t s = 0; s < sizeof SECTIONS / sizeof *SECTIONS; s++)
        print_words(out, &SECTIONS[s]);
    jox_text_add(
        out,
        "\n## Parameters\n\nKeys of `defaults` and of every state. A value is a number, a drawn "
        "value (once per agent), or an\nexpression that is computed each step. Torsos: "
        "`breadth = normal(0.49, 0.04, 0.4, 0.6), depth = normal(0.26, 0.03, 0.2,\n0.34)` draws "
        "adults in ordinary clothes; `core/walking.md` has the measures of men and women, and how "
        "to let breadth,\ndepth and mass go together.\n\n"
        "| parameter | unit | range | default | meaning | example |\n|---|---|---|---|---|---|\n");
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxParameterInfo *info = &jox_parameters[p];
        jox_text_printf(out, "| `%s` | %s | %g to %g | %g | %s | `%s = %g` |\n", info->name,
                        info->unit, info->least, info->greatest, info->value, info->meaning,
                        info->name, get_sample_value(info));
    }
    jox_text_add(out, "\n## Tables\n");
    print_keys(out, "machine", "machine { ... }", "");
    print_keys(out, "state", "A state", "And every parameter; the items are its transitions.");
    print_keys(out, "kick", "kick = { body, ... }", "");
    print_keys(out, "throw", "throw = { body, ... }", "");
    print_keys(out, "signal", "signal = { name, ... }", "");
    print_keys(out, "transition", "A transition", "");
    jox_text_add(
        out,
        "\n## Functions\n\n`on_enter`, `on_exit`, `on_take`, `when` and `steer` may be plain "
        "functions of `me`. They run for the agents\nconcerned, in order of id, after the compiled "
        "transitions. `me` also has every parameter and whatever `memory`\ndeclares; parameters, "
        "memory and `goal` can be set. A call takes about 0.1 us, `me.neighbours` of ten 0.7 us, "
        "each name of `me` or a\nneighbour 0.02 us; `--profile-lua` tells what each function "
        "takes.\n\n| of me | what | unit | meaning |\n|---|---|---|---|\n");
    for (size_t k = 0; k < jox_me_key_count; k++)
        jox_text_printf(out, "| `%s` | %s | %s | %s |\n", jox_me_keys[k].name, jox_me_keys[k].type,
                        jox_me_keys[k].unit, jox_me_keys[k].meaning);
    print_tests(out);
}

/* ---- luacheck ---- */

void jox_lua_luacheck(JoxText *out) {
    static const char *const PLAIN[] = {"pairs",    "ipairs", "next",   "type",   "tostring",
                                        "tonumber", "error",  "assert", "select", "pcall",
                                        "math",     "string", "table"};
    jox_text_add(out,
                 "-- The words of behaviours, for luacheck. Made by `jostle reference luacheck`.\n"
                 "std = {\n  read_globals = {\n");
    for (size_t w = 0; w < jox_word_count; w++)
        if (*jox_words[w].name != ':')
            jox_text_printf(out, "    \"%s\",\n", jox_words[w].name);
    for (size_t p = 0; p < sizeof PLAIN / sizeof *PLAIN; p++)
        jox_text_printf(out, "    \"%s\",\n", PLAIN[p]);
    jox_text_add(out, "  },\n}\nmax_line_length = 120\n"
                      "files[\"**/*_test.lua\"] = { read_globals = {");
    const char *comma = " ";
    for (size_t w = 0; w < jox_test_word_count; w++)
        if (*jox_test_words[w].name != ':') {
            jox_text_printf(out, "%s\"%s\"", comma, jox_test_words[w].name);
            comma = ", ";
        }
    jox_text_add(out, " } }\n");
}

/* ---- examples ---- */

static const char MEMORY[] =
    "local mine = memory { laps = 0, touched = false, prey = nobody, met = list(4, nobody) }\n";

static const char RUNS[] =
    "runs = machine { start = \"Wait\", states = { Wait = { ends = true, steer = hold } } },";

/* Prints a behaviour with an example in its machine, in a state, or in a transition. */
static void print_example(JoxText *out, const char *top, const char *state,
                          const char *transition) {
    jox_text_printf(
        out,
        "%sreturn machine {\n  name = \"example\", version = 1, start = \"Start\",%s%s\n"
        "  states = {\n    Start = { { to = \"Trial\", when = after(0.2), set = { prey = nearest "
        "\"people\", met = mine.met:push(nearest \"people\") } } },\n"
        "    Trial = { %s\n      { to = \"Next\"%s } },\n"
        "    Next = { steer = hold, set = { laps = mine.laps, touched = false, prey = nobody, met "
        "= mine.met:clear() } },\n"
        "  },\n}\n",
        MEMORY,
        strstr(top, "public") || strstr(top, "counts") || strstr(state, "counts")
            ? ""
            : " public = \"laps\",",
        top, state, transition);
}

static void print_word_example(const JoxWord *word, JoxText *out, bool *of_mod) {
    char part[512];
    const char *e = word->example;
    *of_mod = false;
    switch (word->makes) {
    case JOX_NODE_CONDITION:
        snprintf(part, sizeof part, ", when = %s | after(1)", e);
        print_example(out, "", word->op == JOX_OP_DONE ? RUNS : "", part);
        return;
    case JOX_NODE_NUMBER:
        snprintf(part, sizeof part, "speed = clamp(%s, 0, 2), steer = drift(1, 0),", e);
        print_example(out, "", part, ", when = after(1)");
        return;
    case JOX_NODE_TARGET:
        snprintf(part, sizeof part, "steer = seek(%s), face = %s,", e, e);
        print_example(out, "", part, ", when = after(1)");
        return;
    case JOX_NODE_STEER:
        snprintf(part, sizeof part, "steer = %s,", e);
        print_example(out, "", part, ", when = after(1)");
        return;
    case JOX_NODE_DIST:
        snprintf(part, sizeof part, " defaults = { speed = %s },", e);
        print_example(out, part, "", ", when = after(1)");
        return;
    case JOX_NODE_CIRCUITS:
        snprintf(part, sizeof part, " counts = { laps = %s },", e);
        print_example(out, part, "", ", when = after(1)");
        return;
    default:
        break;
    }
    if (strstr(e, "patch") || strstr(e, "replace")) {
        jox_text_printf(out, "return %s\n", e);
        *of_mod = true;
    } else if (!strcmp(e, "back")) {
        print_example(out, "", "{ to = back, when = after(0.5) },", ", when = after(1)");
    } else if (!strncmp(e, "sequence", 8)) {
        snprintf(part, sizeof part, "runs = %s,", e);
        print_example(out, "", part, ", when = done | after(1)");
    } else if (!strncmp(e, "machine", 7)) {
        jox_text_printf(out, "return %s\n", e);
    } else if (!strncmp(e, "memory", 6)) {
        print_example(out, "", "", ", when = mine.laps:is(0)");
    } else if (!strncmp(e, "require", 7) || !strncmp(e, "print", 5)) {
        jox_text_printf(out, "%s%s\n", strncmp(e, "require", 7) ? "" : "local library = ", e);
        print_example(out, "", "", ", when = after(1)");
    } else {
        snprintf(part, sizeof part, "push = 10 * %s,", e);
        print_example(out, "", part, ", when = after(1)");
    }
}

static void print_key_example(const JoxTableKey *key, JoxText *out) {
    char part[512];
    bool become = !strcmp(key->name, "become");
    if (!strcmp(key->owner, "machine")) {
        bool whole = !strcmp(key->name, "states"), own = !strcmp(key->name, "name") ||
                                                         !strcmp(key->name, "start") ||
                                                         !strcmp(key->name, "version");
        if (whole)
            jox_text_printf(out, "return machine { name = \"example\", start = \"Start\", %s }\n",
                            key->example);
        else if (own)
            jox_text_printf(out, "return machine { %s%s%s, states = { Start = {} } }\n",
                            key->example, strcmp(key->name, "name") ? ", name = \"example\"" : "",
                            strcmp(key->name, "start") ? ", start = \"Start\"" : "");
        else {
            snprintf(part, sizeof part, " %s,", key->example);
            print_example(out, part, "", ", when = after(1)");
        }
    } else if (!strcmp(key->owner, "state")) {
        snprintf(part, sizeof part, "%s,", key->example);
        print_example(out, "", part, become ? ", when = after(1)" : ", when = after(1) | lasted");
    } else if (!strcmp(key->owner, "transition")) {
        bool to = !strcmp(key->name, "to");
        snprintf(part, sizeof part, "%s%s", to ? "" : ", ", to ? "" : key->example);
        print_example(out, "", "", part);
    } else if (!strcmp(key->owner, "signal")) {
        snprintf(part, sizeof part, "signal = { \"alarm\", %s },", key->example);
        print_example(out, "", part, ", when = after(1)");
    } else {
        bool kick = !strcmp(key->owner, "kick"), at = !strcmp(key->name, "at");
        bool strength = !strcmp(key->name, "impulse") || !strcmp(key->name, "speed");
        snprintf(part, sizeof part, "%s = { nearest \"ball\", %s%s },", key->owner, key->example,
                 kick ? (strength ? "" : ", impulse = 3")
                 : at ? ", speed = 5"
                      : ", at = \"post\"");
        print_example(out, "", part, ", when = after(1)");
    }
}

bool jox_lua_example(size_t n, JoxText *name, JoxText *out, bool *of_mod) {
    *of_mod = false;
    if (n < jox_word_count) {
        jox_text_add(name, jox_words[n].name);
        print_word_example(&jox_words[n], out, of_mod);
        return true;
    }
    n -= jox_word_count;
    if (n < jox_table_key_count) {
        jox_text_printf(name, "%s.%s", jox_table_keys[n].owner, jox_table_keys[n].name);
        print_key_example(&jox_table_keys[n], out);
        return true;
    }
    n -= jox_table_key_count;
    if (n >= JOX_PARAM_COUNT)
        return false;
    char part[128];
    jox_text_add(name, jox_parameters[n].name);
    snprintf(part, sizeof part, "%s = %g,", jox_parameters[n].name,
             get_sample_value(&jox_parameters[n]));
    print_example(out, "", part, ", when = after(1)");
    return true;
}
