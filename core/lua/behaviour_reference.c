#include "lua/behaviour_reference.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lua/language/vocabulary.h"

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
        "memory and `goal` can be set.\n\n| of me | what | unit | meaning |\n|---|---|---|---|\n");
    for (size_t k = 0; k < jox_me_key_count; k++)
        jox_text_printf(out, "| `%s` | %s | %s | %s |\n", jox_me_keys[k].name, jox_me_keys[k].type,
                        jox_me_keys[k].unit, jox_me_keys[k].meaning);
}

/* ---- editors ---- */

/* Returns the class of what a word makes, for lua-language-server. */
static const char *get_word_class(const JoxWord *word) {
    switch (word->makes) {
    case JOX_NODE_CONDITION:
        return "jostle.Condition";
    case JOX_NODE_NUMBER:
        return "jostle.Number";
    case JOX_NODE_TARGET:
        return "jostle.Target";
    case JOX_NODE_STEER:
        return "jostle.Steering";
    case JOX_NODE_DIST:
        return "jostle.Drawn";
    default:
        return "any";
    }
}

/* Returns the type of an argument by its letter, for lua-language-server. */
static const char *get_argument_type(char letter) {
    return letter == 'p'   ? "string|jostle.Target|jostle.Number"
           : letter == 't' ? "string|jostle.Target|jostle.Number"
           : letter == 'm' ? "jostle.Target"
           : letter == 'n' ? "number|jostle.Number"
           : letter == 'd' ? "number"
                           : "string";
}

static void print_word_definition(JoxText *out, const JoxWord *word) {
    if (*word->name == ':') /* a method, which jox_lua_definitions prints */
        return;
    static const char *const KEYWORDLESS[] = {"require", "print", "machine"};
    for (size_t k = 0; k < 2; k++)
        if (!strcmp(word->name, KEYWORDLESS[k]))
            return; /* Lua's own */
    jox_text_printf(out, "\n--- `%s`%s%s: %s\n", word->signature, *word->unit ? " in " : "",
                    word->unit, word->meaning);
    if (word->takes && *word->takes != '*') {
        char list[64] = "";
        int n = 0;
        for (const char *t = word->takes; *t; t++) {
            bool optional = *t == '?';
            t += optional;
            n++;
            jox_text_printf(out, "---@param a%d%s %s\n", n, optional ? "?" : "",
                            get_argument_type(*t));
            snprintf(list + strlen(list), sizeof list - strlen(list), "%sa%d", n > 1 ? ", " : "",
                     n);
        }
        jox_text_printf(out, "---@return %s\nfunction %s(%s) end\n", get_word_class(word),
                        word->name, list);
    } else if (!strcmp(word->name, "machine")) {
        jox_text_add(
            out, "---@param sheet jostle.Machine\n---@return any\nfunction machine(sheet) end\n");
    } else if (!strcmp(word->name, "patch") || !strcmp(word->name, "replace")) {
        jox_text_printf(out,
                        "---@param behaviour string\n---@return fun(sheet: table): any\nfunction "
                        "%s(behaviour) end\n",
                        word->name);
    } else if (!strcmp(word->name, "before") || !strcmp(word->name, "afterwards") ||
               !strcmp(word->name, "around")) {
        jox_text_printf(
            out, "---@param f fun(me: jostle.Me%s)%s\n---@return any\nfunction %s(f) end\n",
            !strcmp(word->name, "around") ? ", previous: fun(me: jostle.Me): any, any" : "",
            !strcmp(word->name, "around") ? ": any, any" : "", word->name);
    } else if (word->takes) {
        jox_text_printf(out, "---@return %s\nfunction %s(...) end\n", get_word_class(word),
                        word->name);
    } else if (!strcmp(word->name, "now") || !strcmp(word->name, "own") ||
               !strcmp(word->name, "settings")) {
        jox_text_printf(out, "---@type table<string, jostle.Number>\n%s = {}\n", word->name);
    } else {
        jox_text_printf(out, "---@type %s\n%s = nil\n", get_word_class(word), word->name);
    }
}

/* Returns a key's type in the notation of lua-language-server. */
static const char *editor_type(const char *type) {
    static const char *const TYPES[][2] = {
        {"text", "string"},
        {"number", "number"},
        {"plain number", "number"},
        {"true or false", "boolean"},
        {"name", "string"},
        {"name of a state", "string"},
        {"name of a behaviour", "string"},
        {"name of a place", "string"},
        {"name, or table", "string|table"},
        {"table", "table"},
        {"table of parameters", "jostle.State"},
        {"table of names", "table<string, string>"},
        {"table of states", "table<string, jostle.State>"},
        {"steering or function", "jostle.Steering|fun(me: jostle.Me): number, number"},
        {"number, distribution", "number|jostle.Number|jostle.Drawn"},
        {"condition", "jostle.Condition"},
        {"condition or function(me)", "jostle.Condition|fun(me: jostle.Me): boolean"},
        {"target", "string|jostle.Target|jostle.Number"},
        {"\"equal\" or \"nearest\"", "\"equal\"|\"nearest\""},
        {"tag or list of tags", "string|string[]"},
        {"name or list of names", "string|string[]"},
        {"function(me)", "fun(me: jostle.Me)"},
        {"function(name)", "fun(name: string)"},
        {"list", "jostle.Me[]"}};
    for (size_t t = 0; t < sizeof TYPES / sizeof *TYPES; t++)
        if (!strcmp(TYPES[t][0], type))
            return TYPES[t][1];
    return "any";
}

static void print_table_definition(JoxText *out, const char *class, const char *owner,
                                   bool parameters) {
    jox_text_printf(out, "\n---@class %s\n", class);
    for (size_t k = 0; k < jox_table_key_count; k++)
        if (!strcmp(jox_table_keys[k].owner, owner))
            jox_text_printf(out, "---@field %s? %s %s%s%s\n", jox_table_keys[k].name,
                            editor_type(jox_table_keys[k].type), jox_table_keys[k].meaning,
                            *jox_table_keys[k].unit ? ", " : "", jox_table_keys[k].unit);
    for (int p = 0; parameters && p < JOX_PARAM_COUNT; p++) {
        const JoxParameterInfo *info = &jox_parameters[p];
        jox_text_printf(
            out, "---@field %s? number|jostle.Number|jostle.Drawn %s%s%s; %g to %g, default %g\n",
            info->name, info->meaning, *info->unit ? ", " : "", info->unit, info->least,
            info->greatest, info->value);
    }
}

/* Prints a method of `nearest` and `neighbours`. */
static void print_filter_definition(JoxText *out, const JoxWord *word) {
    static const char *const CLASSES[] = {"Number", "Target"};
    const bool flying = !strcmp(word->name, ":flying");
    const bool plain = flying || !strcmp(word->name, ":fallen");
    const bool metres = !strcmp(word->name, ":incoming");
    for (size_t c = flying; c < 2; c++) { /* `neighbours` are people, who do not fly */
        jox_text_printf(out, "--- %s\n", word->meaning);
        if (!plain)
            jox_text_printf(out, "---@param %s\n", metres ? "metres number" : "name string");
        jox_text_printf(out, "---@return jostle.%s\nfunction %s%s(%s%s) end\n", CLASSES[c],
                        CLASSES[c], word->name,
                        plain    ? ""
                        : metres ? "metres"
                                 : "name",
                        !strcmp(word->name, ":where") ? ", ..." : "");
    }
}

void jox_lua_definitions(JoxText *out) {
    jox_text_add(
        out,
        "---@meta\n"
        "-- Definitions of the words of behaviours for lua-language-server.\n"
        "-- Made by `jostle reference lua-ls`. In .luarc.json: \"workspace.library\": "
        "[\"scripts/editor\"]\n"
        "\n---@class jostle.Condition\n---@operator band(jostle.Condition): jostle.Condition\n"
        "---@operator bor(jostle.Condition): jostle.Condition\n---@operator bnot: "
        "jostle.Condition\n"
        "\n---@class jostle.Number\n---@operator add(number|jostle.Number): jostle.Number\n"
        "---@operator sub(number|jostle.Number): jostle.Number\n"
        "---@operator mul(number|jostle.Number): jostle.Number\n"
        "---@operator div(number|jostle.Number): jostle.Number\n---@operator unm: jostle.Number\n"
        "local Number = {}\n");
    static const char *const METHODS[] = {"above", "below", "at_least", "at_most", "is"};
    for (size_t m = 0; m < 5; m++)
        jox_text_printf(out,
                        "---@param n number|jostle.Number\n---@return jostle.Condition\nfunction "
                        "Number:%s(n) end\n",
                        METHODS[m]);
    jox_text_add(out, "\n---@class jostle.Target\nlocal Target = {}\n");
    for (size_t w = 0; w < jox_word_count; w++)
        if (*jox_words[w].name == ':')
            print_filter_definition(out, &jox_words[w]);
    jox_text_add(out,
                 "\n---@class jostle.Drawn\n"
                 "\n---@class jostle.Steering\n---@operator add(jostle.Steering): jostle.Steering\n"
                 "---@operator mul(number|jostle.Number): jostle.Steering\n");
    print_table_definition(out, "jostle.Machine", "machine", false);
    print_table_definition(out, "jostle.State", "state", true);
    print_table_definition(out, "jostle.Transition", "transition", false);
    jox_text_add(out, "\n---@class jostle.Me\n");
    for (size_t k = 0; k < jox_me_key_count; k++)
        jox_text_printf(out, "---@field %s %s %s%s%s\n", jox_me_keys[k].name,
                        editor_type(jox_me_keys[k].type), jox_me_keys[k].meaning,
                        *jox_me_keys[k].unit ? ", " : "", jox_me_keys[k].unit);
    jox_text_add(out, "---@field [string] any a parameter, or what memory declares\n");
    for (size_t w = 0; w < jox_word_count; w++)
        print_word_definition(out, &jox_words[w]);
}

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
    jox_text_add(
        out,
        "  },\n}\nmax_line_length = 120\n"
        "files[\"**/*_test.lua\"] = { read_globals = { \"test\", \"scene\", \"equal\", \"near\", "
        "\"truthy\", \"fails\", \"refused\" } }\n");
}

/* ---- examples ---- */

static const char MEMORY[] = "local mine = memory { laps = 0, touched = false, prey = nobody }\n";

/* Prints a behaviour with an example in its machine, in a state, or in a transition. */
static void print_example(JoxText *out, const char *top, const char *state,
                          const char *transition) {
    jox_text_printf(
        out,
        "%sreturn machine {\n  name = \"example\", version = 1, start = \"Start\",%s%s\n"
        "  states = {\n    Start = { { to = \"Trial\", when = after(0.2), set = { prey = nearest "
        "\"people\" } } },\n"
        "    Trial = { %s\n      { to = \"Next\"%s } },\n"
        "    Next = { steer = hold, set = { laps = mine.laps, touched = false, prey = nobody } },\n"
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
        print_example(out, "", "", part);
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
