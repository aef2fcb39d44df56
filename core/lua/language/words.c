/* Words that are called: reads their arguments as the vocabulary says and makes a value. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/plurals.h"
#include "lua/language/vocabulary.h"

static const char WORDS[] = "jostle words"; /* registry key of the table of words */

size_t jox_word_names(const char **names, size_t capacity) {
    size_t n = 0;
    for (; n < jox_word_count && n < capacity; n++)
        names[n] = jox_words[n].name;
    return n;
}

/* ---- arguments ---- */

/* Returns whether a value may stand for a place. */
static bool can_be_place(const JoxNode *node) {
    return node->kind == JOX_NODE_OWN ||
           (node->kind == JOX_NODE_TARGET &&
            (jox_target_kind_is_place(node->target_kind) || node->target_kind == JOX_TARGET_OTHER));
}

/* Writes how a word that takes a tag is used in place of what it was given. */
static void explain_tag(lua_State *L, const char *word, int index, char hint[160]) {
    const JoxNode *node = jox_node_get(L, index);
    if (node && node->kind == JOX_NODE_TARGET && strcmp(word, "best") == 0)
        snprintf(hint, 160,
                 "best chooses itself, and filters follow it: best(\"people\", "
                 "other.speed):within(5)");
    else if (node && node->kind == JOX_NODE_OWN)
        snprintf(hint, 160,
                 "Write the tag in quotes: %s \"ball\". An own value that names a place is a "
                 "target by itself: seek(own.%.40s)",
                 word, node->name);
    else
        snprintf(hint, 160, "Example: %s",
                 strcmp(word, "best") == 0 ? jox_word_example(word) : "nearest \"ball\"");
}

/* Pushes and returns the target for a tag, or for "opponents", "teammates" or "anyone"; NULL with
   an error pushed. */
static JoxNode *read_tag_argument(lua_State *L, const char *word, int index) {
    static const struct {
        const char *name;
        JoxTargetKind kind;
    } RELATIONS[] = {{"opponents", JOX_TARGET_OPPONENT},
                     {"teammates", JOX_TARGET_TEAMMATE},
                     {"anyone", JOX_TARGET_ANYONE}};
    JoxScript *script = jox_script_of(L);
    const JoxScope *scope = script->scope;
    if (lua_type(L, index) != LUA_TSTRING) {
        char hint[160];
        explain_tag(L, word, index, hint);
        jox_word_error(L, word, "bad-argument", hint, "argument %d of %s must be a tag, not %s",
                       index, word,
                       lua_isnoneornil(L, index) ? "nothing" : jox_node_kind(L, index));
        return NULL;
    }
    const char *name = lua_tostring(L, index);
    JoxTargetKind kind = JOX_TARGET_NEAREST;
    int32_t arg = JOX_UNKNOWN_TAG; /* the scene is not known: no agent has it */
    for (size_t r = 0; r < sizeof RELATIONS / sizeof *RELATIONS; r++)
        if (strcmp(RELATIONS[r].name, name) == 0) {
            kind = RELATIONS[r].kind;
            arg = 0;
        }
    if (kind == JOX_TARGET_NEAREST) {
        arg = jox_script_tag_or_team(script, name, false, false, jox_word_position(L, name));
        if (arg < 0 && scope->complete) {
            jox_word_error(L, name, "too-many-tags", NULL,
                           "a scene has at most 64 different tags, with those that states set");
            return NULL;
        }
        arg = arg < 0 ? JOX_UNKNOWN_TAG : arg;
    }
    JoxNode *node = jox_node_push(L, JOX_NODE_TARGET);
    node->target_kind = kind;
    node->target_arg = arg;
    node->name = jox_vm_intern(&script->vm, name);
    return node;
}

/* Returns whether the scene has walls of the name; false with an error pushed. */
static bool check_gate_name(lua_State *L, int index) {
    const JoxScope *scope = jox_script_of(L)->scope;
    const char *name = lua_tostring(L, index), *names[256];
    size_t count = 0;
    for (uint32_t r = 0; scope->walls && r < scope->walls->ring_count && count < 256; r++)
        if (scope->walls->rings[r].name)
            names[count++] = scope->walls->rings[r].name;
    for (size_t n = 0; n < count; n++)
        if (strcmp(names[n], name) == 0)
            return true;
    if (!scope->complete || count == 256)
        return true;
    char hint[JOX_HINT];
    jox_word_error(L, name, "unknown-wall", jox_did_you_mean(name, names, count, hint),
                   "the scene has no walls named '%s'", name);
    return false;
}

static const JoxWord *find_word(const char *name) {
    for (size_t i = 0; i < jox_word_count; i++)
        if (strcmp(jox_words[i].name, name) == 0)
            return &jox_words[i];
    return NULL;
}

/* Returns whether an argument is a place, or the name of one. */
static bool names_place(lua_State *L, int index) {
    const JoxNode *node = jox_node_get(L, index);
    return node ? can_be_place(node) || node->kind == JOX_NODE_TARGET
                : lua_type(L, index) == LUA_TSTRING;
}

JoxNode *jox_word_argument(lua_State *L, const char *word, int index, char letter) {
    JOX_ASSERT(index >= 1 && letter);
    static const struct {
        char letter;
        const char *what;
    } WANTED[] = {{'p', "a place"},
                  {'t', "a target or the name of a place"},
                  {'m', "a body or an agent, as of `nearest`"},
                  {'n', "a number"},
                  {'c', "a condition"},
                  {'d', "a plain number"},
                  {'g', "a tag"},
                  {'s', "a name of 1 to 60 bytes"},
                  {'w', "the name of walls"}};
    JoxNode *node = jox_node_get(L, index);
    if (node && node->kind == JOX_NODE_ERROR) {
        jox_node_push(L, JOX_NODE_ERROR);
        return NULL;
    }
    if (letter == 'p' || letter == 't' || letter == 'm')
        node = jox_node_target(L, node);
    JoxNode *result = NULL;
    if ((letter == 'p' || letter == 't') && lua_type(L, index) == LUA_TSTRING)
        return jox_read_place_name(L, word, lua_tostring(L, index));
    if (letter == 'p' && node && can_be_place(node))
        result = node;
    if (letter == 't' && node && (node->kind == JOX_NODE_TARGET || node->kind == JOX_NODE_OWN))
        result = node;
    if (letter == 'm' && node && node->kind == JOX_NODE_TARGET &&
        jox_target_kind_moves(node->target_kind))
        result = node;
    if (letter == 'n')
        result = jox_node_number(L, index);
    if (letter == 'c' && node && node->kind == JOX_NODE_CONDITION)
        result = node;
    if (letter == 'd' && lua_type(L, index) == LUA_TNUMBER && isfinite(lua_tonumber(L, index)))
        result = jox_node_number(L, index);
    if (letter == 'g')
        return read_tag_argument(L, word, index);
    if (letter == 'w' && lua_type(L, index) == LUA_TSTRING && !check_gate_name(L, index))
        return NULL;
    if ((letter == 's' || letter == 'w') && lua_type(L, index) == LUA_TSTRING &&
        lua_rawlen(L, index) > 0 && lua_rawlen(L, index) <= 60) {
        result = jox_node_push(L, JOX_NODE_TARGET); /* only carries the name */
        result->name = jox_vm_intern(jox_vm_of(L), lua_tostring(L, index));
        result->written = jox_word_place(L, result->name);
    }
    if (result)
        return result;
    const char *what = "";
    for (size_t i = 0; i < sizeof WANTED / sizeof *WANTED; i++)
        if (WANTED[i].letter == letter)
            what = WANTED[i].what;
    char hint[256] = "";
    const JoxWord *known = find_word(word);
    if (known)
        snprintf(hint, sizeof hint, "%s: %s", known->signature, known->meaning);
    jox_word_error(L, word, "bad-argument", *hint ? hint : NULL,
                   "argument %d of %s must be %s, not %s", index, word, what,
                   lua_isnoneornil(L, index)                ? "nothing"
                   : letter == 'm' && names_place(L, index) ? "a place"
                   : node                                   ? "another value"
                   : lua_type(L, index) == LUA_TSTRING      ? "this text"
                                                            : luaL_typename(L, index));
    return NULL;
}

/* Returns whether the n-th number of a word is in its range; false with an error pushed. */
static bool check_word_range(lua_State *L, const JoxWord *word, uint32_t n, double value) {
    const JoxWordNumber *number = jox_word_number(word->name, n);
    if (!number || (value >= number->least && value <= number->greatest))
        return true;
    jox_word_error(L, word->name, "out-of-range", word->meaning,
                   "%s of %s must be from %g to %g%s%s, not %g", number->name, word->signature,
                   number->least, number->greatest, *number->unit ? " " : "", number->unit, value);
    return false;
}

/* Reports more arguments than a word takes. */
static bool report_extra_arguments(lua_State *L, const JoxWord *word, int given, int most) {
    if (given <= most)
        return false;
    char arguments[JOX_NOUN], within[160];
    const bool near = given == 2 && lua_type(L, 2) == LUA_TNUMBER &&
                      (strcmp(word->takes, "t") == 0 || strcmp(word->takes, "g") == 0);
    const char *tag = *word->takes == 't' ? "nearest(\"people\")" : "\"people\"";
    snprintf(within, sizeof within, "For a distance: %s(%s%s:within(%.6g)%s", word->name, tag,
             *word->takes == 't' ? "" : ")", near ? lua_tonumber(L, 2) : 0.0,
             *word->takes == 't' ? ")" : "");
    jox_word_error(L, word->name, "bad-argument", near ? within : word->meaning,
                   "%s takes %s, not %d", word->name,
                   jox_noun(arguments, (uint64_t)most, "argument"), given);
    return true;
}

/* Stores arguments of a condition or number in the members that compile.c reads. */
static void store_arguments(JoxNode *node, const JoxWord *word, JoxNode *const *arguments,
                            int count) {
    JOX_ASSERT(count >= 0 && count <= 3);
    const char *letter = word->takes;
    for (int i = 0; i < count; i++, letter++) {
        letter += *letter == '?';
        if (*letter == 'p')
            node->place = arguments[i];
        else if ((*letter == 't' || *letter == 'm') && node->target)
            node->place = arguments[i]; /* a second target */
        else if (*letter == 't' || *letter == 'm')
            node->target = arguments[i];
        else if (*letter == 's' || *letter == 'w') {
            node->name = arguments[i]->name;
            node->written = arguments[i]->written;
        } else if (*letter == 'g')
            node->target = arguments[i];
        else if (!node->a)
            node->a = arguments[i];
        else if (!node->b)
            node->b = arguments[i];
        else
            node->c = arguments[i];
    }
}

/* Checks the argument of last_seen, memory that holds somebody; false with an error pushed. */
static bool read_sighting(lua_State *L, JoxNode *node, const JoxNode *of) {
    if (of->target_kind == JOX_TARGET_MEMORY) {
        node->name = of->name;
        return true;
    }
    jox_word_error(L, "last_seen", "bad-argument", "local mine = memory { prey = nobody }",
                   "last_seen takes memory that holds somebody");
    return false;
}

/* Fills the target one_of or best_place, a member of a set that is named, or that the scene names
   for the group; false with an error pushed. */
static bool build_member(lua_State *L, JoxNode *node, const JoxWord *word,
                         JoxNode *const *arguments) {
    const JoxNode *set = arguments[0];
    const bool own = set->kind == JOX_NODE_OWN;
    if (!own && (set->target_kind != JOX_TARGET_PLACE)) {
        char hint[80];
        snprintf(hint, sizeof hint, "Example: %s", jox_word_example(word->name));
        jox_word_error(L, word->name, "bad-argument", hint, "%s takes a set of places", word->name);
        return false;
    }
    node->target_kind = !own                            ? (JoxTargetKind)word->op
                        : word->op == JOX_TARGET_ONE_OF ? JOX_TARGET_ONE_OF_OWN
                                                        : JOX_TARGET_BEST_OWN;
    node->target_arg = set->target_arg;
    node->name = set->name;
    node->position = own ? set->position : jox_script_of(L)->called_at;
    node->written = set->written;
    node->score = arguments[1];
    return true;
}

/* Pushes and returns the value that a word makes of its arguments; NULL with an error pushed if
   they do not fit together. */
static JoxNode *build_word_value(lua_State *L, const JoxWord *word, JoxNode *const *arguments,
                                 int count) {
    JoxNode *node = jox_node_push(L, word->makes);
    node->op = word->op;
    node->arg = word->arg;
    switch (word->makes) {
    case JOX_NODE_TARGET: /* nearest, one_of */
        if (word->op == JOX_TARGET_ONE_OF || word->op == JOX_TARGET_BEST_PLACE) {
            if (!build_member(L, node, word, arguments))
                return NULL;
            break;
        }
        node->target_kind =
            word->op == JOX_TARGET_NEAREST ? arguments[0]->target_kind : (JoxTargetKind)word->op;
        node->target_arg = arguments[0]->target_arg;
        node->name = arguments[0]->name;
        if (word->op == JOX_TARGET_LAST_SEEN && !read_sighting(L, node, arguments[0]))
            return NULL;
        node->position = jox_script_of(L)->called_at;
        if (count > 1)
            node->score = arguments[1]; /* best */
        break;
    case JOX_NODE_STEER:
        node->term.kind = (JoxSteerKind)word->op;
        if (word->op == JOX_STEER_TOGETHER)
            node->term.args[0] =
                count ? arguments[0]->number : jox_word_number(word->name, 0)->standard;
        else if (word->op == JOX_STEER_DRIFT)
            node->a = arguments[0], node->b = arguments[1];
        else
            node->target = arguments[0];
        if (word->op == JOX_STEER_GATHER && word->arg) /* spread_over */
            node->term.args[1] = 1.0;
        else if (word->op == JOX_STEER_DODGE || word->op == JOX_STEER_FOLLOW ||
                 word->op == JOX_STEER_FORMATION || word->op == JOX_STEER_GATHER)
            node->term.args[0] =
                count > 1 ? arguments[1]->number : jox_word_number(word->name, 0)->standard;
        break;
    case JOX_NODE_CIRCUITS:
        node->target = arguments[0];
        break;
    default:
        store_arguments(node, word, arguments, count);
        if (word->op == JOX_OP_INSIDE && count == 1) { /* inside(place) is about the agent itself */
            node->place = arguments[0];
            node->target = NULL;
        }
        if (word->op == JOX_OP_HEARD && count == 1)
            node->a = jox_node_constant(L, INFINITY);
        if (word->makes == JOX_NODE_CONDITION && word->op == JOX_OP_INSIDE &&
            !can_be_place(node->place)) {
            jox_word_error(L, "inside", "bad-argument", "Example: inside(ball, own.court)",
                           "inside needs a place");
            return NULL;
        }
    }
    return node;
}

/* Called as a word: reads its arguments and pushes its value. */
static int make_word(lua_State *L) {
    const JoxWord *word = lua_touserdata(L, lua_upvalueindex(1));
    JOX_ASSERT(word && word->takes);
    if (!jox_script_of(L)->vm.loading)
        return luaL_error(
            L, "'%s' makes a value of the machine's table and cannot be used in a function",
            word->name);
    jox_word_call_place(L, word->name);
    JoxNode *arguments[3] = {NULL, NULL, NULL};
    int count = 0;
    const int given = lua_gettop(L);
    lua_settop(L, given < 3 ? 3 : given); /* missing arguments are nil; reading pushes more */
    uint32_t numbers = 0;
    for (const char *t = word->takes; *t; t++) {
        bool optional = *t == '?';
        t += optional;
        if (optional && count + 1 > given)
            break;
        if (!(arguments[count] = jox_word_argument(L, word->name, count + 1, *t)))
            return 1;
        const bool plain = *t == 'd' || (arguments[count]->kind == JOX_NODE_NUMBER &&
                                         arguments[count]->op == JOX_OP_CONST && *t == 'n');
        if (plain && !check_word_range(L, word, numbers, arguments[count]->number))
            return 1;
        numbers += *t == 'd' || *t == 'n';
        count++;
    }
    int most = (int)strlen(word->takes) - (strchr(word->takes, '?') != NULL);
    if (report_extra_arguments(L, word, given, most))
        return 1;
    JoxNode *node = build_word_value(L, word, arguments, count);
    if (!node)
        return 1;
    luaL_checkstack(L, 1, NULL);
    jox_node_repush(L, node);
    return 1;
}

bool jox_word_lookup(lua_State *L, const char *name) {
    lua_getfield(L, LUA_REGISTRYINDEX, WORDS);
    lua_pushstring(L, name);
    lua_rawget(L, -2);
    lua_remove(L, -2);
    if (!lua_isnil(L, -1))
        return true;
    lua_pop(L, 1);
    return false;
}

/* Pushes the value of a word that is not called. */
static void push_word_value(lua_State *L, const JoxWord *word) {
    JOX_ASSERT(!word->takes && word->makes);
    JoxNode *node = jox_node_push(L, word->makes);
    node->op = word->op;
    node->arg = word->arg;
    if (word->makes == JOX_NODE_STEER)
        node->term.kind = (JoxSteerKind)word->op;
    if (word->makes == JOX_NODE_TARGET)
        node->target_kind = (JoxTargetKind)word->op;
    node->name = jox_vm_intern(jox_vm_of(L), word->name);
}

void jox_words_add(lua_State *L) {
    JOX_ASSERT(lua_istable(L, -1));
    for (size_t i = 0; i < jox_word_count; i++) {
        const JoxWord *word = &jox_words[i];
        if (word->makes == 0 || (word->takes && *word->takes == '*'))
            continue; /* values.c adds these */
        if (word->takes) {
            lua_pushlightuserdata(L, (void *)word);
            lua_pushcclosure(L, make_word, 1);
        } else {
            push_word_value(L, word);
        }
        lua_setfield(L, -2, word->name);
    }
}

void jox_script_set_words(lua_State *L) {
    JOX_ASSERT(lua_istable(L, -1));
    lua_setfield(L, LUA_REGISTRYINDEX, WORDS);
}
