/* Words that the program which embeds the engine has registered (jostle_words.h): values of the
   machine's table, and actions that functions call. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/language/vocabulary.h"

enum { MOST_NAME = 40, MOST_ACTS = 1000000 };

/* ---- registration ---- */

/* Returns why behaviours cannot have a word of this name, or NULL. */
static const char *find_name_fault(const char *name) {
    static const char *const TAKEN[] = {
        "and",      "break",  "do",       "else",     "elseif", "end",   "false",   "for",
        "function", "goto",   "if",       "in",       "local",  "nil",   "not",     "or",
        "repeat",   "return", "then",     "true",     "until",  "while", "assert",  "error",
        "ipairs",   "math",   "me",       "next",     "pairs",  "pcall", "print",   "select",
        "string",   "table",  "tonumber", "tostring", "type",   "other", "previous"};
    for (size_t t = 0; t < sizeof TAKEN / sizeof *TAKEN; t++)
        if (strcmp(TAKEN[t], name) == 0)
            return "Lua or the language has this name";
    for (size_t w = 0; w < jox_word_count; w++)
        if (strcmp(jox_words[w].name, name) == 0)
            return "the language has a word of this name";
    if (jox_parameter_find(name) >= 0)
        return "a parameter has this name";
    const char *c = name;
    while (isalnum((unsigned char)*c) || *c == '_')
        c++;
    return *c || !*name || isdigit((unsigned char)*name) || strlen(name) > MOST_NAME
               ? "a name has letters, digits and _, begins with no digit, and has at most 40 bytes"
               : NULL;
}

/* Returns whether a text is given, on one line and without control characters. */
static bool is_plain_text(const char *text, bool may_be_empty) {
    if (!text || (!*text && !may_be_empty) || strlen(text) > 400)
        return false;
    while ((unsigned char)*text >= 0x20 && *text != 0x7f)
        text++;
    return !*text;
}

static const char *find_word_fault(const JoWord *word) {
    const bool acts = word->kind == JO_WORD_ACTION;
    const char *fault = word->name ? find_name_fault(word->name) : "it has no name";
    if (fault)
        return fault;
    if (!is_plain_text(word->meaning, false))
        return "`meaning` must be a text of one line";
    if (!is_plain_text(word->unit, true))
        return "`unit` must be a text of one line, which may be empty";
    if (!is_plain_text(word->example, false) || !strstr(word->example, word->name))
        return "`example` must be a text of one line in which the word stands";
    if (word->kind > JO_WORD_ACTION || (int)word->kind < 0)
        return "its kind is none of JoWordKind";
    if (acts ? !word->act : !word->values)
        return acts ? "an action needs the function `act`" : "it needs the function `values`";
    return NULL;
}

bool jox_program_words_check(const JoWord *words, size_t count, JoxText *why) {
    for (size_t w = 0; w < count; w++) {
        const char *fault = find_word_fault(&words[w]);
        for (size_t o = 0; o < w && !fault; o++)
            fault = strcmp(words[o].name, words[w].name) == 0 ? "it is registered twice" : NULL;
        if (fault) {
            jox_text_printf(why, "word %zu of the program, '%.40s': %s", w + 1,
                            words[w].name ? words[w].name : "", fault);
            return false;
        }
    }
    return true;
}

void jox_lua_set_words(JoxLua *lua, const JoWord *words, uint32_t count) {
    JOX_ASSERT(!count || words);
    lua->words = words;
    lua->word_count = count;
}

/* ---- in scripts ---- */

const JoWord *jox_program_word_find(const JoxLua *lua, const JoxToken *name) {
    for (uint32_t w = 0; w < lua->word_count; w++)
        if (jox_token_is(name, lua->words[w].name))
            return &lua->words[w];
    return NULL;
}

size_t jox_program_word_names(const JoxLua *lua, const char **names, size_t capacity) {
    size_t n = 0;
    for (; n < lua->word_count && n < capacity; n++)
        names[n] = lua->words[n].name;
    return n;
}

/* An action, called by a function or in its place: keeps it until the step ends. */
static int call_action(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    JoxLua *lua = script->owner;
    const uint32_t number = (uint32_t)lua_tointeger(L, lua_upvalueindex(1));
    const char *name = lua->words[number].name;
    if (script->vm.loading || !lua->machines)
        return luaL_error(
            L, "'%s' acts for an agent: call it in a function, or write on_enter = %s", name, name);
    lua_rawgeti(L, LUA_REGISTRYINDEX, script->me);
    const int given = lua_gettop(L) - 1, first = given && lua_rawequal(L, 1, given + 1) ? 2 : 1;
    JoxAct act = {.word = number, .agent_id = lua->machines->agents->id[script->agent]};
    if (given - first + 1 > JOX_ACT_NUMBERS)
        return luaL_error(L, "'%s' takes at most %d numbers", name, JOX_ACT_NUMBERS);
    for (int n = first; n <= given; n++) {
        if (lua_type(L, n) != LUA_TNUMBER || !isfinite(lua_tonumber(L, n)))
            return luaL_error(L, "'%s' takes numbers, not %s", name,
                              lua_type(L, n) == LUA_TNUMBER ? "one that is not finite"
                                                            : luaL_typename(L, n));
        act.numbers[act.count++] = lua_tonumber(L, n);
    }
    if (lua->act_count >= MOST_ACTS)
        return luaL_error(L, "over %d actions of the program in one step", MOST_ACTS);
    JOX_RESERVE(lua->acts, lua->act_capacity, lua->act_count + 1);
    lua->acts[lua->act_count++] = act;
    return 0;
}

bool jox_program_word_is_action(lua_State *L, int index) {
    return lua_tocfunction(L, index) == call_action;
}

bool jox_program_word_push(lua_State *L, const char *name) {
    JoxScript *script = jox_script_of(L);
    const JoxLua *lua = script->owner;
    uint32_t w = 0;
    while (w < lua->word_count && strcmp(lua->words[w].name, name) != 0)
        w++;
    if (w == lua->word_count)
        return false;
    if (lua->words[w].kind == JO_WORD_ACTION) {
        lua_pushinteger(L, w);
        lua_pushcclosure(L, call_action, 1);
        return true;
    }
    if (!script->vm.loading)
        luaL_error(L, "'%s' makes a value of the machine's table and cannot be used in a function",
                   name);
    const bool number = lua->words[w].kind == JO_WORD_NUMBER;
    JoxNode *node = jox_node_push(L, number ? JOX_NODE_NUMBER : JOX_NODE_CONDITION);
    node->op = number ? JOX_OP_PROGRAM_NUMBER : JOX_OP_PROGRAM_CONDITION;
    node->arg = (int)w;
    node->name = lua->words[w].name;
    return true;
}

/* ---- acts ---- */

const JoxAct *jox_lua_acts(const JoxLua *lua, uint32_t *count) {
    *count = lua->act_count;
    return lua->acts;
}

void jox_lua_forget_acts(JoxLua *lua) {
    lua->act_count = 0;
}
