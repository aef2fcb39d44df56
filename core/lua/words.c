/* The vocabulary: every word, what it takes and what it makes. One table drives the loader and the
   suggestions for misspelt names. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "lua/internal.h"

/* Kinds of arguments: p place, t target (a place by name, or a target value), n number
   (expression), s string (a tag), d plain number; a lower-case letter after '?' may be left out. */
typedef struct Word {
    const char *name, *takes;
    JoxNodeKind makes;
    int op; /* JoxOp, JoxSteerKind or JoxTargetKind */
    const char *meaning;
} Word;

static const Word WORDS[] = {
    {"inside", "t?p", JOX_NODE_CONDITION, JOX_OP_INSIDE, "the agent, or a target, is in a place"},
    {"crosses", "p", JOX_NODE_CONDITION, JOX_OP_CROSSES,
     "the last step crossed a line, right to left"},
    {"near", "tn", JOX_NODE_CONDITION, JOX_OP_NEAR, "the target is nearer than so many metres"},
    {"touches", "t", JOX_NODE_CONDITION, JOX_OP_TOUCHES, "the target is at arm's length"},
    {"first_in", "p", JOX_NODE_CONDITION, JOX_OP_FIRST_IN, "the agent heads the queue"},
    {"after", "n", JOX_NODE_CONDITION, JOX_OP_AFTER, "so many seconds in this state"},
    {"stuck", "n", JOX_NODE_CONDITION, JOX_OP_STUCK, "has not moved 0.25 m for so many seconds"},
    {"hit_by", "t", JOX_NODE_CONDITION, JOX_OP_HIT_BY, "a fast target touches the agent"},
    {"grounded", "t", JOX_NODE_CONDITION, JOX_OP_GROUNDED, "the body touches the ground"},
    {"incoming", "tn", JOX_NODE_CONDITION, JOX_OP_INCOMING,
     "the target will pass within so many metres"},
    {"kicked", "t", JOX_NODE_CONDITION, JOX_OP_KICKED,
     "the agent kicked the body in the last step"},
    {"sees", "t", JOX_NODE_CONDITION, JOX_OP_SEES, "the target is within perception"},
    {"density", "p", JOX_NODE_NUMBER, JOX_OP_PLACE_DENSITY, "people per square metre in a place"},
    {"count", "p", JOX_NODE_NUMBER, JOX_OP_PLACE_COUNT, "people in a place"},
    {"distance", "t", JOX_NODE_NUMBER, JOX_OP_DISTANCE, "metres to the target"},
    {"min", "nn", JOX_NODE_NUMBER, JOX_OP_MIN, "the lesser"},
    {"max", "nn", JOX_NODE_NUMBER, JOX_OP_MAX, "the greater"},
    {"abs", "n", JOX_NODE_NUMBER, JOX_OP_ABS, "without sign"},
    {"sqrt", "n", JOX_NODE_NUMBER, JOX_OP_SQRT, "square root"},
    {"clamp", "nnn", JOX_NODE_NUMBER, JOX_OP_CLAMP, "kept between two bounds"},
    {"nearest", "s", JOX_NODE_TARGET, JOX_TARGET_NEAREST, "the nearest seen with a tag"},
    {"one_of", "p", JOX_NODE_TARGET, JOX_TARGET_ONE_OF, "a member of a set, drawn on entry"},
    {"seek", "t", JOX_NODE_STEER, JOX_STEER_SEEK, "towards the target"},
    {"away_from", "t", JOX_NODE_STEER, JOX_STEER_AWAY_FROM, "straight away from the target"},
    {"queue", "p", JOX_NODE_STEER, JOX_STEER_QUEUE, "to one's place in a queue"},
    {"along", "p", JOX_NODE_STEER, JOX_STEER_ALONG, "along a line, or a queue to its head"},
    {"follow", "t?d", JOX_NODE_STEER, JOX_STEER_FOLLOW, "behind the target"},
    {"drift", "dd", JOX_NODE_STEER, JOX_STEER_DRIFT, "in a fixed direction"},
    {"circuits", "p", JOX_NODE_CIRCUITS, 0, "turns about a place, counter-clockwise"},
};
enum { WORD_COUNT = sizeof WORDS / sizeof *WORDS };

/* Words that are values by themselves. */
static const struct Value {
    const char *name;
    JoxNodeKind kind;
    int op, arg;
} VALUES[] = {
    {"lasted", JOX_NODE_CONDITION, JOX_OP_LASTED, 0},
    {"density_here", JOX_NODE_NUMBER, JOX_OP_NOW, JOX_NOW_density},
    {"headway", JOX_NODE_NUMBER, JOX_OP_NOW, JOX_NOW_headway},
    {"pushed", JOX_NODE_NUMBER, JOX_OP_NOW, JOX_NOW_pushed},
    {"compression", JOX_NODE_NUMBER, JOX_OP_NOW, JOX_NOW_compression},
    {"contacts", JOX_NODE_NUMBER, JOX_OP_NOW, JOX_NOW_contacts},
    {"time_in_state", JOX_NODE_NUMBER, JOX_OP_NOW, JOX_NOW_time_in_state},
    {"goal", JOX_NODE_TARGET, JOX_TARGET_GOAL, 0},
    {"hold", JOX_NODE_STEER, JOX_STEER_HOLD, 0},
    {"spread", JOX_NODE_STEER, JOX_STEER_SPREAD, 0},
    {"player", JOX_NODE_STEER, JOX_STEER_PLAYER, 0},
};
enum { VALUE_COUNT = sizeof VALUES / sizeof *VALUES };

static const char *const OTHERS[] = {"machine", "memory", "orbit", "normal",
                                     "uniform", "choose", "now",   "own"};
enum { OTHER_COUNT = sizeof OTHERS / sizeof *OTHERS };

const char *const *jox_words_names(size_t *count) {
    static const char *names[WORD_COUNT + VALUE_COUNT + OTHER_COUNT];
    size_t n = 0;
    for (size_t i = 0; i < WORD_COUNT; i++)
        names[n++] = WORDS[i].name;
    for (size_t i = 0; i < VALUE_COUNT; i++)
        names[n++] = VALUES[i].name;
    for (size_t i = 0; i < OTHER_COUNT; i++)
        names[n++] = OTHERS[i];
    *count = n;
    return names;
}

/* ---- errors at words ---- */

JoxPosition jox_word_position(lua_State *L, const char *word) {
    JoxVm *vm = jox_vm_of(L);
    lua_Debug debug;
    for (int level = 1; lua_getstack(L, level, &debug); level++) {
        lua_getinfo(L, "Sl", &debug);
        int number;
        if (debug.currentline < 1 || sscanf(debug.short_src, "b%d", &number) != 1 ||
            (size_t)number >= vm->source_count)
            continue;
        JoxSource *source = &vm->sources[number];
        const JoxToken *t = jox_source_find(source, debug.currentline, word);
        if (!t && word[0] == '<') /* Lua turns a > b into b < a */
            t = jox_source_find(source, debug.currentline, word[1] ? ">=" : ">");
        return t ? (JoxPosition){source->path, t->line, t->column, t->end_column}
                 : (JoxPosition){source->path, debug.currentline, 0, 0};
    }
    return (JoxPosition){vm->source_count ? vm->sources[0].path : NULL, 0, 0, 0};
}

int jox_word_error(lua_State *L, const char *word, const char *code, const char *hint,
                   const char *format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    JoxVm *vm = jox_vm_of(L);
    if (!vm->loading)
        return luaL_error(L, "%s", text); /* inside a hook: words make nothing there */
    JoxPosition position = jox_word_position(L, word);
    jox_diag_error(vm->diagnostics, position, code, hint, "%s", text);
    jox_node_push(L, JOX_NODE_POISON);
    return 1;
}

static const char *did_you_mean(const char *word, const char *const *names, size_t count,
                                char hint[96]) {
    const char *near = jox_suggest(word, names, count);
    if (!near)
        return NULL;
    snprintf(hint, 96, "Did you mean '%s'?", near);
    return hint;
}

/* ---- arguments ---- */

/* The place that a string names, as a target; NULL with an error pushed. */
static JoxNode *place_by_name(lua_State *L, const char *name) {
    JoxVm *vm = jox_vm_of(L);
    int32_t index = -1;
    if (vm->scope->places)
        index = jox_place_find(vm->scope->places, vm->scope->place_count, name);
    if (index < 0 && vm->scope->complete) {
        const char *names[256];
        size_t count = vm->scope->place_count < 256 ? vm->scope->place_count : 256;
        for (size_t i = 0; i < count; i++)
            names[i] = vm->scope->places[i].name;
        char hint[96];
        jox_word_error(L, name, "unknown-place", did_you_mean(name, names, count, hint),
                       "the scene has no place '%s'", name);
        return NULL;
    }
    JoxNode *node = jox_node_push(L, JOX_NODE_TARGET);
    node->target_kind = JOX_TARGET_PLACE;
    node->target_arg = index;
    node->name = jox_vm_intern(vm, name);
    return node;
}

/* Whether a target may stand for a place. */
static bool is_place(const JoxNode *node) {
    return node->kind == JOX_NODE_OWN ||
           (node->kind == JOX_NODE_TARGET && node->target_kind < JOX_TARGET_NEAREST);
}

/* Reads argument `index` of a word as its letter asks; NULL with an error (or poison) pushed. */
static JoxNode *read_argument(lua_State *L, const Word *word, int index, char letter) {
    static const struct {
        char letter;
        const char *what;
    } WANTED[] = {{'p', "a place"},
                  {'t', "a target or the name of a place"},
                  {'n', "a number"},
                  {'d', "a plain number"},
                  {'s', "a tag"}};
    JoxNode *node = jox_node_get(L, index);
    if (node && node->kind == JOX_NODE_POISON) {
        jox_node_push(L, JOX_NODE_POISON);
        return NULL;
    }
    JoxNode *result = NULL;
    if ((letter == 'p' || letter == 't') && lua_type(L, index) == LUA_TSTRING)
        return place_by_name(L, lua_tostring(L, index));
    if (letter == 'p' && node && is_place(node))
        result = node;
    if (letter == 't' && node && (node->kind == JOX_NODE_TARGET || node->kind == JOX_NODE_OWN))
        result = node;
    if (letter == 'n')
        result = jox_node_number(L, index);
    if (letter == 'd' && lua_type(L, index) == LUA_TNUMBER && isfinite(lua_tonumber(L, index)))
        result = jox_node_number(L, index);
    if (result)
        return result;
    const char *what = "";
    for (size_t i = 0; i < sizeof WANTED / sizeof *WANTED; i++)
        if (WANTED[i].letter == letter)
            what = WANTED[i].what;
    char hint[128];
    snprintf(hint, sizeof hint, "%s: %s", word->name, word->meaning);
    jox_word_error(L, word->name, "bad-argument", hint, "argument %d of %s must be %s, not %s",
                   index, word->name, what,
                   lua_gettop(L) < index ? "nothing"
                   : node                ? "another value"
                                         : luaL_typename(L, index));
    return NULL;
}

/* The bit of a tag, or the relation that a name stands for. */
static int make_nearest(lua_State *L, const Word *word) {
    JoxVm *vm = jox_vm_of(L);
    if (lua_type(L, 1) != LUA_TSTRING)
        return read_argument(L, word, 1, 's') ? 0 : 1;
    const char *name = lua_tostring(L, 1);
    int32_t bit = -1;
    JoxTargetKind kind = strcmp(name, "opponents") == 0   ? JOX_TARGET_OPPONENT
                         : strcmp(name, "teammates") == 0 ? JOX_TARGET_TEAMMATE
                                                          : JOX_TARGET_NEAREST;
    for (uint32_t i = 0; i < vm->scope->tag_count; i++)
        if (strcmp(vm->scope->tags[i], name) == 0)
            bit = (int32_t)i;
    if (kind == JOX_TARGET_NEAREST && bit < 0 && vm->scope->complete) {
        char hint[96];
        return jox_word_error(L, name, "unknown-tag",
                              did_you_mean(name, vm->scope->tags, vm->scope->tag_count, hint),
                              "nothing in the scene bears the tag '%s'", name);
    }
    JoxNode *node = jox_node_push(L, JOX_NODE_TARGET);
    node->target_kind = kind;
    node->target_arg = bit < 0 ? 63 : bit;
    node->name = jox_vm_intern(vm, name);
    return 1;
}

static bool too_many(lua_State *L, const Word *word, int given, int most) {
    if (given <= most)
        return false;
    jox_word_error(L, word->name, "bad-argument", word->meaning, "%s takes %d argument%s, not %d",
                   word->name, most, most == 1 ? "" : "s", given);
    return true;
}

static int make_word(lua_State *L) {
    const Word *word = lua_touserdata(L, lua_upvalueindex(1));
    if (!jox_vm_of(L)->loading)
        return luaL_error(L, "'%s' makes a value of the sheet and cannot be used in a function",
                          word->name);
    if (word->makes == JOX_NODE_TARGET && word->op == JOX_TARGET_NEAREST)
        return make_nearest(L, word);
    JoxNode *arguments[3] = {NULL, NULL, NULL};
    int count = 0, given = lua_gettop(L); /* reading arguments pushes more */
    for (const char *t = word->takes; *t; t++) {
        bool optional = *t == '?';
        t += optional;
        if (optional && count + 1 > given)
            break;
        if (!(arguments[count] = read_argument(L, word, count + 1, *t)))
            return 1;
        count++;
    }
    int most = (int)strlen(word->takes) - (strchr(word->takes, '?') != NULL);
    if (too_many(L, word, given, most))
        return 1;
    JoxNode *node = jox_node_push(L, word->makes);
    node->op = word->op;
    switch (word->makes) {
    case JOX_NODE_TARGET: /* one_of */
        if (arguments[0]->kind != JOX_NODE_TARGET || arguments[0]->target_kind != JOX_TARGET_PLACE)
            return jox_word_error(L, "one_of", "bad-argument", "Example: one_of \"gates\"",
                                  "one_of takes the name of a set of places");
        node->target_kind = JOX_TARGET_ONE_OF;
        node->target_arg = arguments[0]->target_arg;
        node->name = arguments[0]->name;
        break;
    case JOX_NODE_STEER:
        node->term.kind = (JoxSteerKind)word->op;
        if (word->takes[0] != 'd')
            node->target = arguments[0];
        for (int i = 0; i < 2; i++)
            if (arguments[i] && arguments[i]->kind == JOX_NODE_NUMBER)
                node->term.args[word->takes[0] == 'd' ? i : 0] = arguments[i]->number;
        break;
    case JOX_NODE_CIRCUITS:
        node->target = arguments[0];
        break;
    default:
        if (word->op == JOX_OP_INSIDE && !arguments[1]) { /* inside(place): of the agent itself */
            node->place = arguments[0];
            break;
        }
        for (int i = 0, n = 0; i < count; i++) {
            char letter = word->takes[i] == '?' ? word->takes[i + 1] : word->takes[i];
            letter = word->op == JOX_OP_INSIDE && i == 1 ? 'p' : letter;
            if (letter == 't')
                node->target = arguments[i];
            else if (letter == 'p')
                node->place = arguments[i];
            else if (n++ == 0)
                node->a = arguments[i];
            else if (!node->b)
                node->b = arguments[i];
            else
                node->c = arguments[i];
        }
    }
    if (word->op == JOX_OP_INSIDE && word->makes == JOX_NODE_CONDITION && !is_place(node->place))
        return jox_word_error(L, "inside", "bad-argument", "Example: inside(ball, own.court)",
                              "inside needs a place");
    return 1;
}

/* orbit(place [, { inward, density_near, density_far, far, beyond }]) */
static int make_orbit(lua_State *L) {
    static const char *const KEYS[] = {"inward", "density_near", "density_far", "far", "beyond"};
    static const Word ORBIT = {"orbit", "p", JOX_NODE_STEER, JOX_STEER_ORBIT, "round a place"};
    JoxNode *place = read_argument(L, &ORBIT, 1, 'p');
    if (!place)
        return 1;
    JoxNode *node = jox_node_push(L, JOX_NODE_STEER);
    node->term.kind = JOX_STEER_ORBIT;
    node->target = place;
    memcpy(node->term.args, (double[]){0.5, 5.6, 4.6, 40.0, 50.0}, 5 * sizeof(double));
    if (lua_isnoneornil(L, 2) || lua_type(L, 2) != LUA_TTABLE)
        return 1;
    lua_pushnil(L);
    while (lua_next(L, 2)) {
        const char *key = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "?";
        int found = -1;
        for (int k = 0; k < 5; k++)
            found = strcmp(KEYS[k], key) == 0 ? k : found;
        if (found < 0 || lua_type(L, -1) != LUA_TNUMBER || !(fabs(lua_tonumber(L, -1)) < 1e6))
            return jox_word_error(L, key, "bad-argument",
                                  "orbit takes inward, density_near, density_far, far and beyond",
                                  "bad option '%s' of orbit", key);
        node->term.args[found] = lua_tonumber(L, -1);
        lua_pop(L, 1);
    }
    lua_pushvalue(L, -1);
    return 1;
}

/* normal(mean, deviation [, least, greatest]), uniform(a, b), choose(a, b, ...) */
static int make_dist(lua_State *L) {
    static const char *const NAMES[] = {"normal", "uniform", "choose"};
    int which = (int)lua_tointeger(L, lua_upvalueindex(1)), count = lua_gettop(L);
    double v[JOX_DIST_CHOICES];
    for (int i = 0; i < count && i < JOX_DIST_CHOICES; i++) {
        if (lua_type(L, i + 1) != LUA_TNUMBER || !(fabs(lua_tonumber(L, i + 1)) < 1e9))
            return jox_word_error(L, NAMES[which], "bad-argument", NULL,
                                  "argument %d of %s must be a plain number", i + 1, NAMES[which]);
        v[i] = lua_tonumber(L, i + 1);
    }
    bool good = which == 0   ? (count == 2 || count == 4) && v[1] >= 0 && (count < 4 || v[2] < v[3])
                : which == 1 ? count == 2 && v[0] <= v[1]
                             : count >= 1 && count <= JOX_DIST_CHOICES;
    if (!good)
        return jox_word_error(L, NAMES[which], "bad-argument",
                              "normal(mean, deviation [, least, greatest]), uniform(least, "
                              "greatest), choose(a, b, ...) with at most 8",
                              "wrong arguments of %s", NAMES[which]);
    JoxNode *node = jox_node_push(L, JOX_NODE_DIST);
    node->dist = (JoxDist){.kind = (JoxDistKind)(JOX_DIST_NORMAL), .lo = -INFINITY, .hi = INFINITY};
    node->dist.kind = which == 0   ? JOX_DIST_NORMAL
                      : which == 1 ? JOX_DIST_UNIFORM
                                   : JOX_DIST_CHOOSE;
    node->dist.a = v[0];
    node->dist.b = count > 1 ? v[1] : 0.0;
    if (which == 0 && count == 4) {
        node->dist.lo = v[2];
        node->dist.hi = v[3];
    }
    node->dist.choices = count;
    memcpy(node->dist.values, v, (size_t)count * sizeof *v);
    return 1;
}

static int make_machine(lua_State *L) {
    if (lua_type(L, 1) != LUA_TTABLE)
        return jox_word_error(L, "machine", "bad-argument",
                              "machine { name = ..., states = { ... } }", "machine takes a table");
    JoxNode *node = jox_node_push(L, JOX_NODE_MACHINE);
    lua_pushvalue(L, 1);
    node->hook = luaL_ref(L, LUA_REGISTRYINDEX);
    return 1;
}

/* memory { laps = 0, touched = false }: what each agent remembers. */
static int make_memory(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    if (!vm->loading || lua_type(L, 1) != LUA_TTABLE)
        return jox_word_error(L, "memory", "bad-argument", "memory { laps = 0, touched = false }",
                              "memory takes a table");
    lua_pushnil(L);
    while (lua_next(L, 1)) {
        int type = lua_type(L, -1);
        const char *name = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "?";
        if (lua_type(L, -2) != LUA_TSTRING || (type != LUA_TNUMBER && type != LUA_TBOOLEAN) ||
            vm->memory_count >= 64)
            return jox_word_error(L, name, "bad-memory", "Numbers and booleans can be remembered",
                                  "memory '%s' cannot be a %s", name, luaL_typename(L, -1));
        JOX_RESERVE(vm->memory, vm->memory_capacity, vm->memory_count + 1);
        double value = type == LUA_TNUMBER ? lua_tonumber(L, -1) : lua_toboolean(L, -1);
        JoxMemorySlot slot = {jox_strdup(name),
                              type == LUA_TNUMBER ? JOX_MEMORY_NUMBER : JOX_MEMORY_BOOLEAN, value};
        uint32_t at = vm->memory_count++; /* sorted, for tables have no order */
        for (; at > 0 && strcmp(vm->memory[at - 1].name, name) > 0; at--)
            vm->memory[at] = vm->memory[at - 1];
        vm->memory[at] = slot;
        lua_pop(L, 1);
    }
    luaL_getmetatable(L, "jostle memory");
    lua_newuserdatauv(L, 1, 0);
    lua_insert(L, -2);
    lua_setmetatable(L, -2);
    return 1;
}

static int memory_index(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
    const char *names[64];
    for (uint32_t i = 0; i < vm->memory_count; i++) {
        names[i] = vm->memory[i].name;
        if (strcmp(vm->memory[i].name, name) == 0) {
            bool flag = vm->memory[i].kind == JOX_MEMORY_BOOLEAN;
            JoxNode *node = jox_node_push(L, flag ? JOX_NODE_CONDITION : JOX_NODE_NUMBER);
            node->op = JOX_OP_MEMORY;
            node->name = jox_vm_intern(vm, name);
            return 1;
        }
    }
    char hint[96];
    return jox_word_error(L, name, "unknown-memory",
                          did_you_mean(name, names, vm->memory_count, hint), "memory has no '%s'",
                          name);
}

static int now_index(lua_State *L) {
    static const char *const NAMES[] = {
#define X(name, unit, meaning) #name,
        JOX_NOW(X)
#undef X
    };
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
    for (int i = 0; i < JOX_NOW_COUNT; i++)
        if (strcmp(NAMES[i], name) == 0) {
            JoxNode *node = jox_node_push(L, JOX_NODE_NUMBER);
            node->op = JOX_OP_NOW;
            node->arg = i;
            return 1;
        }
    char hint[96];
    return jox_word_error(L, name, "unknown-word", did_you_mean(name, NAMES, JOX_NOW_COUNT, hint),
                          "nothing called '%s' is measured now", name);
}

static int own_index(lua_State *L) {
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
    JoxNode *node = jox_node_push(L, JOX_NODE_OWN);
    node->op = JOX_OP_OWN;
    node->name = jox_vm_intern(jox_vm_of(L), name);
    return 1;
}

static void add_object(lua_State *L, const char *type, lua_CFunction index) {
    luaL_newmetatable(L, type);
    lua_pushcfunction(L, index);
    lua_setfield(L, -2, "__index");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_pop(L, 1);
}

bool jox_word_lookup(lua_State *L, const char *name) {
    lua_getfield(L, LUA_REGISTRYINDEX, "jostle words");
    lua_pushstring(L, name);
    lua_rawget(L, -2);
    lua_remove(L, -2);
    if (!lua_isnil(L, -1))
        return true;
    lua_pop(L, 1);
    return false;
}

void jox_words_open(JoxVm *vm) {
    lua_State *L = vm->L;
    add_object(L, "jostle memory", memory_index);
    add_object(L, "jostle now", now_index);
    add_object(L, "jostle own", own_index);
    lua_newtable(L);
    for (size_t i = 0; i < WORD_COUNT; i++) {
        lua_pushlightuserdata(L, (void *)&WORDS[i]);
        lua_pushcclosure(L, make_word, 1);
        lua_setfield(L, -2, WORDS[i].name);
    }
    for (size_t i = 0; i < VALUE_COUNT; i++) {
        JoxNode *node = jox_node_push(L, VALUES[i].kind);
        node->op = VALUES[i].op;
        node->arg = VALUES[i].arg;
        if (VALUES[i].kind == JOX_NODE_STEER)
            node->term.kind = (JoxSteerKind)VALUES[i].op;
        if (VALUES[i].kind == JOX_NODE_TARGET)
            node->target_kind = (JoxTargetKind)VALUES[i].op;
        node->name = jox_vm_intern(vm, VALUES[i].name);
        lua_setfield(L, -2, VALUES[i].name);
    }
    for (int i = 0; i < 3; i++) {
        lua_pushinteger(L, i);
        lua_pushcclosure(L, make_dist, 1);
        lua_setfield(L, -2, (const char *[]){"normal", "uniform", "choose"}[i]);
    }
    lua_pushcfunction(L, make_orbit);
    lua_setfield(L, -2, "orbit");
    lua_pushcfunction(L, make_machine);
    lua_setfield(L, -2, "machine");
    lua_pushcfunction(L, make_memory);
    lua_setfield(L, -2, "memory");
    for (int i = 0; i < 2; i++) {
        lua_newuserdatauv(L, 1, 0);
        luaL_setmetatable(L, i ? "jostle own" : "jostle now");
        lua_setfield(L, -2, i ? "own" : "now");
    }
    lua_setfield(L, LUA_REGISTRYINDEX, "jostle words");
}
