/* Prints definitions of the vocabulary for lua-language-server (`jostle reference lua-ls`):
   scripts/editor/jostle.lua. Types follow from the tables of words, keys, parameters and fields;
   tests/scenes/editor.sh checks that all of them are there and that each line can be read. */
#include <stdio.h>
#include <string.h>

#include "lua/behaviour_reference.h"
#include "lua/language/vocabulary.h"
#include "lua/signature.h"
#include "lua/test_words.h"

/* Returns the type of a word's argument: by its letter in `takes`, else by its name. */
static const char *get_argument_type(const JoxSignatureItem *p, char letter) {
    static const char *const NAMED[][2] = {
        {"place", "jostle.Place"}, {"tag", "jostle.Tag"},   {"options", "jostle.OrbitOptions"},
        {"metres", "number"},      {"degrees", "number"},   {"name", "string"},
        {"mean", "number"},        {"deviation", "number"}, {"shape", "number"},
        {"scale", "number"},       {"least", "number"},     {"greatest", "number"},
        {"a", "number"},           {"b", "number"},         {"...", "number"}};
    switch (letter) {
    case 'p':
        return "jostle.Place";
    case 't':
        return "jostle.AnyTarget";
    case 'm':
        return "jostle.Target";
    case 'n':
        return "jostle.Value";
    case 'c':
        return "jostle.Condition";
    case 'd':
        return "number";
    case 'g':
        return "jostle.Tag";
    case 's':
    case 'w':
        return "string";
    default:
        break;
    }
    for (size_t n = 0; n < sizeof NAMED / sizeof *NAMED; n++)
        if (strcmp(NAMED[n][0], p->name) == 0)
            return NAMED[n][1];
    return "any";
}

/* Prints the annotations of parameters; letters of `takes` tell their types if there is one for
   each. */
static void print_parameters(JoxText *out, const JoxSignature *s, const char *takes) {
    int letters = 0;
    for (const char *t = takes ? takes : ""; *t; t++)
        letters += *t != '?' && *t != '*';
    const char *letter = takes && letters == s->count ? takes : "";
    for (int p = 0; p < s->count; p++) {
        letter += *letter == '?';
        const char *type = get_argument_type(&s->items[p], *letter);
        letter += *letter != 0;
        jox_text_printf(out, "---@param %s%s %s\n", s->items[p].name,
                        s->items[p].optional && !s->items[p].variadic ? "?" : "", type);
    }
}

/* Prints the parameters of a function and its end: "(target, metres) end". */
static void print_parameter_list(JoxText *out, const JoxSignature *s) {
    jox_text_add(out, "(");
    for (int p = 0; p < s->count; p++)
        jox_text_printf(out, "%s%s", p ? ", " : "", s->items[p].name);
    jox_text_add(out, ") end\n");
}

/* Prints other forms of a word, "inside(place)" of "inside(place) or inside(target, place)", as
   overloads; returns the last form. */
static const char *print_overloads(JoxText *out, const char *signature, const char *class) {
    const char * or ;
    while ((or = strstr(signature, ") or "))) {
        const JoxSignature s = jox_signature_read(signature, or +1);
        jox_text_add(out, "---@overload fun(");
        for (int p = 0; p < s.count; p++)
            jox_text_printf(out, "%s%s: %s", p ? ", " : "", s.items[p].name,
                            get_argument_type(&s.items[p], 0));
        jox_text_printf(out, "): %s\n", class);
        signature = or +5;
    }
    return signature;
}

/* ---- words ---- */

/* Returns the class of what a word makes. */
static const char *get_word_class(const JoxWord *word) {
    static const char *const OWN[][2] = {
        {"neighbours", "jostle.Counted"}, {"told", "jostle.Message"},
        {"circuits", "jostle.Counter"},   {"nobody", "jostle.Nobody"},
        {"back", "jostle.Back"},          {"none", "jostle.None"}};
    for (size_t o = 0; o < sizeof OWN / sizeof *OWN; o++)
        if (strcmp(OWN[o][0], word->name) == 0)
            return OWN[o][1];
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

/* Words with a syntax of their own; "" for those that lua-language-server knows as Lua's own. */
static const char *get_whole_definition(const char *name) {
    static const char *const DEFINITIONS[][2] = {
        {"require", ""},
        {"print", ""},
        {"machine", "---@param sheet jostle.Machine\n---@return jostle.MachineValue\n"
                    "function machine(sheet) end\n"},
        {"sequence", "---@param steps table\n---@return jostle.MachineValue\n"
                     "function sequence(steps) end\n"},
        {"wait", "---@param seconds jostle.Value|jostle.Drawn\n---@return any\n"
                 "function wait(seconds) end\n"},
        {"memory", "---@generic T: table<string, any>\n---@param declared T\n"
                   "---@return T|jostle.Remembered\nfunction memory(declared) end\n"},
        {"patch", "---@param behaviour string\n---@return fun(changes: table): any\n"
                  "function patch(behaviour) end\n"},
        {"replace", "---@param behaviour string\n---@return fun(sheet: jostle.Machine): any\n"
                    "function replace(behaviour) end\n"},
        {"before", "---@param run fun(me: jostle.Me)\n---@return any\nfunction before(run) end\n"},
        {"afterwards",
         "---@param run fun(me: jostle.Me)\n---@return any\nfunction afterwards(run) end\n"},
        {"around", "---@param run fun(me: jostle.Me, previous: fun(me: jostle.Me): any, any): any, "
                   "any\n---@return any\nfunction around(run) end\n"},
        {"now", "---@type jostle.Now\nnow = nil\n"},
        {"own", "---@type jostle.Own\nown = nil\n"},
        {"settings", "---@type table<string, any>\nsettings = nil\n"}};
    for (size_t d = 0; d < sizeof DEFINITIONS / sizeof *DEFINITIONS; d++)
        if (strcmp(DEFINITIONS[d][0], name) == 0)
            return DEFINITIONS[d][1];
    return NULL;
}

static void print_word(JoxText *out, const JoxWord *word) {
    const char *whole = get_whole_definition(word->name), *class = get_word_class(word);
    if (*word->name == ':' || (whole && !*whole))
        return;
    jox_text_printf(out, "\n--- `%s`%s%s: %s\n", word->signature, *word->unit ? " in " : "",
                    word->unit, word->meaning);
    const JoxWordNumber *number;
    for (uint32_t n = 0; (number = jox_word_number(word->name, n)); n++)
        jox_text_printf(out, "---\n--- `%s`: %g to %g%s%s\n", number->name, number->least,
                        number->greatest, *number->unit ? " " : "", number->unit);
    if (whole) {
        jox_text_add(out, whole);
    } else if (!word->takes) {
        jox_text_printf(out, "---@type %s\n%s = nil\n", class, word->name);
    } else {
        const char *form = print_overloads(out, word->signature, class);
        const JoxSignature s = jox_signature_read(form, form + strlen(form));
        if (strcmp(word->name, "near") == 0) /* also a function of tests */
            jox_text_add(out,
                         "---@overload fun(value: number, wanted: number, tolerance: number)\n");
        print_parameters(out, &s, word->takes);
        jox_text_printf(out, "---@return %s\nfunction %s", class, word->name);
        print_parameter_list(out, &s);
    }
}

/* Prints the filters as methods of a class. */
static void print_filters(JoxText *out, const char *class) {
    for (size_t w = 0; w < jox_word_count; w++) {
        const JoxWord *word = &jox_words[w];
        const bool of_bodies = strcmp(word->name, ":flying") == 0; /* people do not fly */
        if (*word->name != ':' || (of_bodies && strcmp(class, "Counted") == 0))
            continue;
        const char *form = word->signature + 2; /* after "of" */
        const JoxSignature s = jox_signature_read(form, form + strlen(form));
        jox_text_printf(out, "--- %s\n", word->meaning);
        print_parameters(out, &s, NULL);
        jox_text_printf(out, "---@return jostle.%s\nfunction %s%s", class, class, word->name);
        print_parameter_list(out, &s);
    }
}

/* ---- tables ---- */

/* Prints "---@field name type meaning, unit". */
static void print_field(JoxText *out, const char *name, bool optional, const char *type,
                        const char *meaning, const char *unit) {
    jox_text_printf(out, "---@field %s%s %s %s%s%s\n", name, optional ? "?" : "", type, meaning,
                    *unit ? ", " : "", unit);
}

/* Returns a key's type. */
static const char *get_key_type(const JoxTableKey *key) {
    static const char *const KEYS[][3] = {
        {"machine", "version", "number"},
        {"machine", "own", "table<string, number|boolean|string|jostle.Drawn>"},
        {"", "counts", "table<string, jostle.Counter>"},
        {"", "kick", "jostle.Kick"},
        {"", "throw", "jostle.Throw"},
        {"", "set", "jostle.Set"},
        {"", "tell", "jostle.Tell"}};
    static const char *const TYPES[][2] = {
        {"text", "string"},
        {"number", "jostle.Value"},
        {"plain number", "number"},
        {"true or false", "boolean"},
        {"name", "string"},
        {"name of a state", "string"},
        {"name of a pose", "\"brace\"|\"raise\"|\"carry\"|\"throw\"|\"point\"|\"sit\"|\"kneel\""},
        {"name of a state, or back", "string|jostle.Back"},
        {"name of a behaviour", "string"},
        {"name, or table", "string|jostle.Signal"},
        {"table of parameters", "jostle.Parameters"},
        {"table of names", "table<string, string>"},
        {"table of states", "table<string, jostle.State>"},
        {"machine", "jostle.MachineValue"},
        {"steering or function", "jostle.Steering|fun(me: jostle.Me): number, number"},
        {"number, distribution", "jostle.Value|jostle.Drawn"},
        {"condition", "jostle.Condition"},
        {"condition or function(me)", "jostle.Condition|fun(me: jostle.Me): boolean"},
        {"target", "jostle.AnyTarget"},
        {"\"equal\" or \"nearest\"", "\"equal\"|\"nearest\""},
        {"tag or list of tags", "string|string[]"},
        {"name or list of names", "string|string[]"},
        {"function(me)", "fun(me: jostle.Me)"}};
    for (size_t k = 0; k < sizeof KEYS / sizeof *KEYS; k++)
        if ((!*KEYS[k][0] || strcmp(KEYS[k][0], key->owner) == 0) &&
            strcmp(KEYS[k][1], key->name) == 0)
            return KEYS[k][2];
    for (size_t t = 0; t < sizeof TYPES / sizeof *TYPES; t++)
        if (strcmp(TYPES[t][0], key->type) == 0)
            return TYPES[t][1];
    return "any";
}

/* Prints the class of one of the machine's tables, with further lines after its head. */
static void print_table(JoxText *out, const char *class, const char *owner, const char *more) {
    jox_text_printf(out, "\n---@class jostle.%s\n%s", class, more);
    for (size_t k = 0; k < jox_table_key_count; k++) {
        const JoxTableKey *key = &jox_table_keys[k];
        if (strcmp(key->owner, owner) == 0)
            print_field(out, key->name, true, get_key_type(key), key->meaning, key->unit);
    }
}

/* Prints the parameters as fields of a type; those of `but` are left out. */
static void print_parameter_fields(JoxText *out, bool optional, const char *type, const char *but) {
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxParameterInfo *info = &jox_parameters[p];
        if (strcmp(info->name, but) == 0)
            continue;
        JoxText meaning = {0};
        jox_text_printf(&meaning, "%s%s%s; %g to %g, default %g", info->meaning,
                        *info->unit ? ", " : "", info->unit, info->least, info->greatest,
                        info->value);
        print_field(out, info->name, optional, type, meaning.data, "");
        jox_text_free(&meaning);
    }
}

/* Prints what is measured, as fields that are numbers. */
static void print_measured_fields(JoxText *out) {
#define X(name, word, unit, meaning, value)                                                        \
    print_field(out, #name, false, "jostle.Number", meaning, unit);
    JOX_MEASURED(X)
#undef X
}

static void print_tables(JoxText *out) {
    jox_text_add(out,
                 "\n--- Values of parameters, as in `defaults`.\n---@class jostle.Parameters\n");
    print_parameter_fields(out, true, "jostle.Value|jostle.Drawn", "");
    print_table(out, "Machine", "machine", "");
    print_table(
        out, "State: jostle.Parameters", "state",
        "---@field [integer] jostle.Transition the items are its transitions and reactions\n");
    print_table(out, "Transition", "transition", "");
    print_table(out, "Kick", "kick", "---@field [1] jostle.Target the body\n");
    print_table(out, "Throw", "throw", "---@field [1] jostle.Target the body\n");
    print_table(out, "Signal", "signal", "---@field [1] string its name\n");
    jox_text_add(
        out, "\n--- A message: to whom, its name, and up to four values.\n---@class jostle.Tell\n"
             "---@field [1] jostle.Target|jostle.Counted\n---@field [2] string\n"
             "---@field [string] jostle.Value|jostle.Target\n"
             "\n--- Values to set: memory, team and tags.\n---@class jostle.Set\n"
             "---@field team? string\n---@field tags? string|string[]\n"
             "---@field [string] number|boolean|jostle.Number|jostle.Condition|jostle.Target\n");
    jox_text_add(out, "\n--- Options of `orbit`.\n---@class jostle.OrbitOptions\n");
    const JoxWordNumber *number;
    for (uint32_t n = 0; (number = jox_word_number("orbit", n)); n++)
        jox_text_printf(out, "---@field %s? number %g to %g%s%s, default %g\n", number->name,
                        number->least, number->greatest, *number->unit ? " " : "", number->unit,
                        number->standard);
}

/* ---- me and views ---- */

/* Returns the type of a field of `me`, as a view has it too. */
static const char *get_me_type(const JoxMeKey *key) {
    static const char *const FUNCTIONS[][2] = {
        {"signal", "fun(name: string)"},
        {"tell",
         "fun(whom: jostle.View, name: string, values?: table<string, number|jostle.View>)"},
        {"told", "fun(name: string): jostle.Told|nil"}};
    static const char *const TYPES[][2] = {
        {"number", "number"},          {"text", "string"},          {"true or false", "boolean"},
        {"name of a place", "string"}, {"view", "jostle.View|nil"}, {"list", "jostle.View[]"}};
    for (size_t f = 0; f < sizeof FUNCTIONS / sizeof *FUNCTIONS; f++)
        if (strcmp(FUNCTIONS[f][0], key->name) == 0)
            return FUNCTIONS[f][1];
    for (size_t t = 0; t < sizeof TYPES / sizeof *TYPES; t++)
        if (strcmp(TYPES[t][0], key->type) == 0)
            return TYPES[t][1];
    return "any";
}

static void print_me_fields(JoxText *out, bool view) {
    for (size_t k = 0; k < jox_me_key_count; k++) {
        const JoxMeKey *key = &jox_me_keys[k];
        const bool of_me = strncmp(key->type, "function", 8) == 0 || !strcmp(key->type, "list") ||
                           !strcmp(key->type, "view");
        const bool of_view = !strcmp(key->name, "in_sight");
        if (view ? !of_me : !of_view)
            print_field(out, key->name, false, get_me_type(key), key->meaning, key->unit);
    }
    print_parameter_fields(out, false, "number", view ? "" : "neighbours");
}

static void print_agents(JoxText *out) {
    jox_text_add(out, "\n--- The agent that a function runs for. Memory and parameters can be set. "
                      "To have your memory\n--- completed too, name it: ---@class jostle.Me, and "
                      "---@field laps number.\n---@class jostle.Me\n---@field [string] any what "
                      "memory declares\n");
    print_me_fields(out, false);
    jox_text_add(out,
                 "\n--- Another agent, or a body, as it was before the step. Memory alone can be "
                 "set.\n---@class jostle.View\n---@field [string] any what its memory "
                 "declares\n");
    print_me_fields(out, true);
    jox_text_add(out, "\n--- A message that waited.\n---@class jostle.Told\n"
                      "---@field sender jostle.View|nil who told it\n"
                      "---@field [string] any the values that it carries\n");
}

/* ---- tests ---- */

/* Prints a function of tests, or a method of a scene. */
static void print_test_word(JoxText *out, const JoxTestWord *word) {
    const JoxSignature s =
        jox_signature_read(word->signature, word->signature + strlen(word->signature));
    const char *type = word->types;
    if (strcmp(word->name, "near") == 0) /* an overload of the word */
        return;
    jox_text_printf(out, "\n--- `%s`: %s\n", word->signature, word->meaning);
    for (int p = 0; p < s.count; p++) {
        const size_t length = strcspn(type, ";");
        jox_text_printf(out, "---@param %s%s %.*s\n", s.items[p].name,
                        s.items[p].optional ? "?" : "", (int)length, type);
        type += length + (type[length] == ';');
    }
    if (*word->returns)
        jox_text_printf(out, "---@return %s\n", word->returns);
    jox_text_printf(out, "function %s%s", *word->name == ':' ? "Scene" : "", word->name);
    print_parameter_list(out, &s);
}

static void print_tests(JoxText *out) {
    const char *owner = "";
    jox_text_add(out, "\n-- Tests, NAME_test.lua, which `jostle test` runs.\n");
    for (size_t o = 0; o < jox_test_option_count; o++) {
        const JoxTestOption *option = &jox_test_options[o];
        if (strcmp(owner, option->owner) != 0)
            jox_text_printf(out, "\n---@class jostle.%s\n", option->owner);
        owner = option->owner;
        print_field(out, option->name, true, option->type, option->meaning, "");
    }
    jox_text_add(
        out, "\n--- An agent of a scene, as it is now.\n---@class jostle.TestAgent\n"
             "---@field id integer\n---@field state string\n---@field machine string\n"
             "---@field group string|nil\n---@field team string|integer|nil a number: of a "
             "party\n---@field own table<string, number|string> own values; of places the name\n"
             "---@field x number position east, m\n---@field y number position north, m\n"
             "---@field vx number velocity east, m/s\n---@field vy number velocity north, "
             "m/s\n---@field now number present speed, m/s\n---@field density number\n"
             "---@field compression number\n---@field load number\n---@field fallen number\n"
             "---@field pushed number\n---@field [string] any what its memory declares\n");
    print_parameter_fields(out, false, "number", "");
    jox_text_add(out,
                 "\n--- A body of a scene, as it is now: m and m/s.\n---@class jostle.TestBody\n"
                 "---@field x number\n---@field y number\n---@field z number\n"
                 "---@field vx number\n---@field vy number\n---@field vz number\n"
                 "\n--- A scene within a test.\n---@class jostle.Scene\nlocal Scene = {}\n");
    for (size_t w = 0; w < jox_test_word_count; w++)
        print_test_word(out, &jox_test_words[w]);
}

/* ---- all ---- */

/* Prints the classes of values that expressions have. */
static void print_values(JoxText *out) {
    static const char *const METHODS[][2] = {{"above", "greater than"},
                                             {"below", "less than"},
                                             {"at_least", "not less than"},
                                             {"at_most", "not greater than"},
                                             {"is", "equal to"}};
    jox_text_add(out,
                 "\n--- Holds or does not: `a & b`, `a | b`, `~a`.\n---@class jostle.Condition\n"
                 "---@operator band(jostle.Condition): jostle.Condition\n"
                 "---@operator bor(jostle.Condition): jostle.Condition\n"
                 "---@operator bnot: jostle.Condition\n"
                 "\n--- A number that is computed in each step.\n---@class jostle.Number\n"
                 "---@operator add(jostle.Value): jostle.Number\n"
                 "---@operator sub(jostle.Value): jostle.Number\n"
                 "---@operator mul(jostle.Value): jostle.Number\n"
                 "---@operator mul(jostle.Steering): jostle.Steering\n"
                 "---@operator div(jostle.Value): jostle.Number\n---@operator unm: jostle.Number\n"
                 "local Number = {}\n");
    for (size_t m = 0; m < sizeof METHODS / sizeof *METHODS; m++)
        jox_text_printf(out,
                        "--- the number is %s the bound\n---@param bound jostle.Value\n"
                        "---@return jostle.Condition\nfunction Number:%s(bound) end\n",
                        METHODS[m][1], METHODS[m][0]);
    jox_text_add(out, "\n--- A number of people that are seen.\n"
                      "---@class jostle.Counted: jostle.Number\nlocal Counted = {}\n");
    print_filters(out, "Counted");
    jox_text_add(out, "\n--- A person, body or place. Its numbers are 0 if it is not there, or not "
                      "seen.\n---@class jostle.Target\n");
    print_measured_fields(out);
    jox_text_add(out, "local Target = {}\n");
    print_filters(out, "Target");
    jox_text_add(
        out, "\n---@class jostle.Nobody: jostle.Target\n"
             "\n--- A message that waits: `sender`, and the values that it carries.\n"
             "---@class jostle.Message: jostle.Condition\n---@field sender jostle.Target\n"
             "---@field [string] jostle.Memory\n"
             "\n--- What memory holds: a number, a condition, or somebody.\n"
             "---@class jostle.Memory: jostle.Number, jostle.Condition, jostle.Target\n"
             "\n--- What `memory` declares, as expressions.\n---@class jostle.Remembered\n"
             "---@field [string] jostle.Memory\n"
             "\n--- An own value of the agent: a number or a place.\n"
             "---@class jostle.OwnValue: jostle.Number\n"
             "\n---@class jostle.Own\n---@field [string] jostle.OwnValue what `own` declares\n");
    print_parameter_fields(out, false, "jostle.OwnValue", "");
    jox_text_add(out, "\n---@class jostle.Now\n");
    print_measured_fields(out);
    jox_text_add(
        out, "\n--- A value that is drawn once for each agent.\n---@class jostle.Drawn\n"
             "\n---@class jostle.Counter\n\n---@class jostle.None\n\n---@class jostle.Back\n"
             "\n--- A behaviour: what its file returns.\n---@class jostle.MachineValue\n"
             "\n--- A direction in which to go: weighted sums, `0.8 * seek(goal) + 0.2 * spread`.\n"
             "---@class jostle.Steering\n---@operator add(jostle.Steering): jostle.Steering\n"
             "---@operator mul(jostle.Value): jostle.Steering\n"
             "\n---@alias jostle.Value number|jostle.Number\n"
             "---@alias jostle.Place string|jostle.Target|jostle.OwnValue\n"
             "---@alias jostle.AnyTarget string|jostle.Target|jostle.OwnValue\n"
             "---@alias jostle.Tag \"anyone\"|\"teammates\"|\"opponents\"|string\n");
}

void jox_lua_definitions(JoxText *out) {
    jox_text_add(out,
                 "---@meta\n"
                 "-- Definitions of the words of behaviours and of their tests for "
                 "lua-language-server.\n"
                 "-- Made by `jostle reference lua-ls`. In .luarc.json: \"workspace.library\": "
                 "[\"scripts/editor\"]\n");
    print_values(out);
    print_tables(out);
    print_agents(out);
    for (size_t w = 0; w < jox_word_count; w++)
        print_word(out, &jox_words[w]);
    print_tests(out);
}
