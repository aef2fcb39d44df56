/* The words `sequence` and `wait`: makes a machine of steps that follow one another. Each step
   becomes a state that leads to the next when it is over; the machine ends after the last. Called
   by values.c. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/name.h"
#include "base/mem.h"
#include "lua/language/vocabulary.h"

enum { MOST_STEPS = 200, MOST_NAME = 60 };

/* wait(seconds): a step that stands for a number, distribution or expression of seconds. */
static int make_wait(lua_State *L) {
    jox_word_call_place(L, "wait");
    const JoxNode *node = jox_node_get(L, 1);
    const bool number = lua_type(L, 1) == LUA_TNUMBER ||
                        (node && (node->kind == JOX_NODE_NUMBER || node->kind == JOX_NODE_OWN ||
                                  node->kind == JOX_NODE_DIST));
    if (node && node->kind == JOX_NODE_ERROR)
        return jox_node_push_error(L);
    if (!number || lua_gettop(L) > 1)
        return jox_word_error(L, "wait", "bad-argument", "Example: wait(2), or wait(uniform(1, 3))",
                              "wait takes a number of seconds");
    JoxNode *wait = jox_node_push(L, JOX_NODE_WAIT);
    lua_pushvalue(L, 1);
    wait->hook = luaL_ref(L, LUA_REGISTRYINDEX);
    return 1;
}

/* Where the table of a sequence stands on the stack, and what was made of it. */
typedef struct Sequence {
    lua_State *L;
    int items, states, steps; /* stack: the table; states; step names = numbers of their items */
    JoxNamePlace written;     /* the word `sequence` */
    uint32_t count;           /* steps so far */
    int item;                 /* number of the present item */
    char first[MOST_NAME + 1], before[MOST_NAME + 1]; /* names of the first step, the one before */
    bool leads_on;                                    /* the step before leads to the next */
} Sequence;

/* Reports an error in the present item. */
static void report_step(const Sequence *s, const char *hint, const char *message) {
    const JoxScript *script = jox_script_of(s->L);
    JoxPosition at = s->written.at;
    char root[24], path[48];
    jox_vm_charge(s->L, 2000);
    if (at.file && s->written.source < script->vm.source_count &&
        jox_outline_root(script->vm.sources[s->written.source], at.line, at.column, root)) {
        snprintf(path, sizeof path, "%s%s%d", root, *root ? "." : "", s->item);
        at = jox_outline_at(script->vm.sources[s->written.source], path);
    }
    jox_diag_error(script->diagnostics, at, "bad-step", hint, "item %d of this sequence %s",
                   s->item, message);
}

static void set_node(lua_State *L, int table, const char *key, JoxNode *node) {
    lua_pushstring(L, key);
    jox_node_repush(L, node);
    lua_rawset(L, table);
}

/* Returns the node of a step's key; NULL if it has none. */
static JoxNode *get_node(lua_State *L, int table, const char *key) {
    lua_pushstring(L, key);
    lua_rawget(L, table);
    JoxNode *node = jox_node_get(L, -1);
    lua_pop(L, 1);
    return node;
}

static bool has_key(lua_State *L, int table, const char *key) {
    lua_pushstring(L, key);
    const bool has = lua_rawget(L, table) != LUA_TNIL;
    lua_pop(L, 1);
    return has;
}

/* ---- names ---- */

/* Returns the word of a steering. */
static const char *find_steering_word(JoxSteerKind kind) {
    for (size_t w = 0; w < jox_word_count; w++)
        if (jox_words[w].makes == JOX_NODE_STEER && jox_words[w].op == (int)kind)
            return jox_words[w].name;
    return "step";
}

/* Writes the name of a step without one: "2 seek door". */
static void name_step(const Sequence *s, int table, char name[MOST_NAME + 1]) {
    const JoxNode *steer = get_node(s->L, table, "steer");
    const bool waits = has_key(s->L, table, "lasts");
    const char *word = has_key(s->L, table, "runs")                           ? "run"
                       : steer && steer->kind != JOX_NODE_STEER               ? "step"
                       : steer && steer->term.kind == JOX_STEER_HOLD && waits ? "wait"
                       : steer ? find_steering_word(steer->term.kind)
                       : waits ? "wait"
                               : "step";
    const JoxNode *target = steer && steer->kind == JOX_NODE_STEER ? steer->target : NULL;
    const bool named =
        target && target->name && jox_name_is_plain(target->name) && strlen(target->name) < 40;
    snprintf(name, MOST_NAME + 1, "%u %s%s%s", s->count + 1, word, named ? " " : "",
             named ? target->name : "");
    for (char *c = name; *c; c++) /* a dot separates names of states */
        *c = *c == '.' ? ' ' : *c;
}

/* Checks a name that the author gives a step. */
static bool check_step_name(const Sequence *s, const char *name) {
    const bool plain = jox_name_is_plain(name) && strlen(name) <= MOST_NAME && !strchr(name, '.');
    lua_pushstring(s->L, name);
    const bool known = lua_rawget(s->L, s->states) != LUA_TNIL;
    lua_pop(s->L, 1);
    if (!plain)
        report_step(s, JOX_NAME_RULE, "has no plain name of at most 60 bytes, without a dot");
    else if (known)
        report_step(s, "Give it another name", "has the name of a step before");
    return plain && !known;
}

/* ---- the end of a step ---- */

/* Returns the condition that a step is over that goes to a target. */
static JoxNode *make_arrival(lua_State *L, JoxNode *target) {
    const bool place = target->kind == JOX_NODE_OWN || (target->kind == JOX_NODE_TARGET &&
                                                        target->target_kind < JOX_TARGET_NEAREST);
    JoxNode *node = jox_node_push(L, JOX_NODE_CONDITION);
    node->op = place ? JOX_OP_ARRIVED : JOX_OP_NEAR;
    node->place = place ? target : NULL;
    node->target = place ? NULL : target;
    node->a =
        place ? NULL : jox_node_constant(L, target->target_kind == JOX_TARGET_HOME ? 0.5 : 1.0);
    lua_pop(L, 1); /* the script keeps it */
    return node;
}

static JoxNode *make_condition(lua_State *L, JoxOp op) {
    JoxNode *node = jox_node_push(L, JOX_NODE_CONDITION);
    node->op = op;
    lua_pop(L, 1);
    return node;
}

/* Pushes the condition that ends a step, nil: at once. Returns false if none does. */
static bool push_ending(lua_State *L, int table) {
    JoxNode *steer = get_node(L, table, "steer"), *over = NULL;
    lua_pushstring(L, "when");
    if (lua_rawget(L, table) != LUA_TNIL)
        return true;
    if (has_key(L, table, "lasts"))
        over = make_condition(L, JOX_OP_LASTED);
    else if (has_key(L, table, "runs"))
        over = make_condition(L, JOX_OP_DONE);
    else if (steer && steer->kind == JOX_NODE_STEER && !steer->next && steer->target &&
             (steer->term.kind == JOX_STEER_SEEK || steer->term.kind == JOX_STEER_FIELD))
        over = make_arrival(L, steer->target);
    else if (steer && steer->kind == JOX_NODE_STEER && !steer->next && steer->target &&
             steer->term.kind == JOX_STEER_QUEUE) {
        over = make_condition(L, JOX_OP_FIRST_IN);
        over->place = steer->target;
    } else if (steer && steer->kind == JOX_NODE_STEER && !steer->next &&
               steer->term.kind == JOX_STEER_RIDE) {
        over = make_condition(L, JOX_OP_RODE);
    } else if (has_key(L, table, "steer") && !(steer && steer->kind == JOX_NODE_ERROR)) {
        return false;
    }
    lua_pop(L, 1);
    if (over)
        jox_node_repush(L, over);
    else
        lua_pushnil(L);
    return true;
}

/* ---- steps ---- */

/* Appends the transition to the step `next` to the table of the step before. */
static void lead_on(Sequence *s, const char *next) {
    lua_State *L = s->L;
    const int top = lua_gettop(L);
    if (s->count == 0 || !s->leads_on)
        return;
    lua_pushstring(L, s->before);
    lua_rawget(L, s->states);
    lua_newtable(L);
    lua_pushstring(L, next);
    lua_setfield(L, top + 2, "to");
    lua_pushstring(L, "when");
    lua_rawget(L, top + 1);
    lua_setfield(L, top + 2, "when");
    lua_rawseti(L, top + 1, (lua_Integer)lua_rawlen(L, top + 1) + 1);
    lua_pushnil(L);
    lua_setfield(L, top + 1, "when");
    lua_settop(L, top);
}

/* Adds the step whose table is on top of the stack, and pops it. Until the next step is known, the
   condition that ends it is its key `when`. */
static void add_step(Sequence *s, const char *given) {
    lua_State *L = s->L;
    const int table = lua_gettop(L);
    char name[MOST_NAME + 1];
    if (given)
        snprintf(name, sizeof name, "%s", given);
    else
        name_step(s, table, name);
    lead_on(s, name);
    s->leads_on =
        !has_key(L, table, "removes") && !has_key(L, table, "become") && !has_key(L, table, "ends");
    if (s->leads_on && !push_ending(L, table)) {
        report_step(s, "Say when: { steer = wander(), lasts = 5 }, or { steer = ..., when = ... }",
                    "does not end by itself");
        lua_pushnil(L);
    }
    if (s->leads_on)
        lua_setfield(L, table, "when");
    if (s->count++ == 0)
        snprintf(s->first, sizeof s->first, "%s", name);
    snprintf(s->before, sizeof s->before, "%s", name);
    lua_pushstring(L, name);
    lua_pushinteger(L, s->item);
    lua_rawset(L, s->steps);
    lua_pushstring(L, name);
    lua_pushvalue(L, table);
    lua_rawset(L, s->states);
    lua_settop(L, table - 1);
}

/* Pushes a copy of the step's table at a stack index, without `name`. */
static void push_step_copy(lua_State *L, int index) {
    lua_newtable(L);
    const int copy = lua_gettop(L);
    for (lua_pushnil(L); lua_next(L, index);) {
        jox_vm_charge(L, 5);
        lua_pushvalue(L, -2);
        lua_insert(L, -2);
        lua_rawset(L, copy);
    }
    lua_pushnil(L);
    lua_setfield(L, copy, "name");
}

/* Pushes the state's table of the item at a stack index; false with an error if it is no step. */
static bool push_step(Sequence *s, int index) {
    lua_State *L = s->L;
    JoxNode *node = jox_node_get(L, index);
    const int type = lua_type(L, index);
    if (type == LUA_TTABLE) {
        push_step_copy(L, index);
        return true;
    }
    lua_newtable(L);
    const int table = lua_gettop(L);
    if (node && node->kind == JOX_NODE_STEER) {
        set_node(L, table, "steer", node);
    } else if (node && node->kind == JOX_NODE_MACHINE) {
        set_node(L, table, "runs", node);
    } else if (node && node->kind == JOX_NODE_WAIT) {
        JoxNode *hold = jox_node_push(L, JOX_NODE_STEER);
        lua_setfield(L, table, "steer");
        hold->term.kind = JOX_STEER_HOLD;
        lua_rawgeti(L, LUA_REGISTRYINDEX, node->hook);
        lua_setfield(L, table, "lasts");
    } else if (type == LUA_TFUNCTION && !lua_iscfunction(L, index)) {
        lua_pushvalue(L, index);
        lua_setfield(L, table, "on_enter");
    } else {
        lua_pop(L, 1);
        if (!node || node->kind != JOX_NODE_ERROR)
            report_step(s,
                        "Example: sequence { seek \"door\", wait(2), { steer = hold, lasts = 1 } }",
                        "is no step: a steering, wait(seconds), a machine, a function, a state's "
                        "table, or the name of the step after it");
        return false;
    }
    return true;
}

/* Reads the items in order; a text names the step after it. */
static void add_steps(Sequence *s) {
    lua_State *L = s->L;
    const int top = lua_gettop(L);
    char label[MOST_NAME + 1] = "";
    for (s->item = 1; lua_rawgeti(L, s->items, s->item) != LUA_TNIL; s->item++) {
        jox_vm_charge(L, 50);
        const char *name = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
        if (s->count == MOST_STEPS) {
            report_step(s, "Run a second one in a step", "is one too many");
            break;
        }
        if (name && *label)
            report_step(s, "A text names the step after it", "is a second name for one step");
        else if (name && check_step_name(s, name))
            snprintf(label, sizeof label, "%s", name);
        if (!name) {
            lua_pushnil(L);
            if (lua_istable(L, top + 1))
                lua_getfield(L, top + 1, "name");
            const char *own = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
            const bool good = !own || check_step_name(s, own);
            if (own && *label)
                report_step(s, "Keep one of them", "has a name before it, and one of its own");
            if (push_step(s, top + 1))
                add_step(s, *label ? label : good ? own : NULL);
            *label = 0;
        }
        lua_settop(L, top);
    }
    lua_settop(L, top);
    s->item--;
    if (*label)
        report_step(s, "A text names the step after it",
                    "is the last: a step belongs after a name");
}

/* sequence { step, ... }: a machine. Its names are keys of the table, as of any machine. */
static int make_sequence(lua_State *L) {
    if (!jox_script_of(L)->vm.loading)
        return luaL_error(L, "'sequence' makes a machine and cannot be used in a function");
    const JoxNamePlace written = jox_word_call_place(L, "sequence");
    if (lua_type(L, 1) != LUA_TTABLE || lua_gettop(L) > 1 || lua_rawlen(L, 1) == 0)
        return jox_word_error(L, "sequence", "bad-argument",
                              "Example: sequence { seek \"door\", wait(2) }",
                              "sequence takes a table of steps");
    luaL_checkstack(L, 30, "sequence");
    lua_newtable(L); /* the machine's table: keys as given, states of the steps */
    for (lua_pushnil(L); lua_next(L, 1);) {
        jox_vm_charge(L, 5);
        lua_pushvalue(L, -2);
        lua_insert(L, -2);
        if (lua_type(L, -2) == LUA_TSTRING)
            lua_rawset(L, 2);
        else
            lua_pop(L, 2);
    }
    lua_newtable(L);
    lua_newtable(L);
    Sequence s = {.written = written, .L = L, .items = 1, .states = 3, .steps = 4};
    add_steps(&s);
    lua_settop(L, 4);
    if (s.count == 0)
        return jox_node_push_error(L);
    if (s.leads_on) {
        char end[MOST_NAME + 1] = "End";
        for (uint32_t n = 2; has_key(L, s.states, end); n++)
            snprintf(end, sizeof end, "End %u", n);
        lua_newtable(L);
        lua_pushboolean(L, true);
        lua_setfield(L, -2, "ends");
        lua_setfield(L, s.states, end);
        lead_on(&s, end);
    }
    if (!has_key(L, 2, "start")) {
        lua_pushstring(L, s.first);
        lua_setfield(L, 2, "start");
    }
    lua_pushvalue(L, s.states);
    lua_setfield(L, 2, "states");
    JoxNode *node = jox_node_push(L, JOX_NODE_MACHINE);
    node->written = s.written;
    lua_pushvalue(L, 2);
    node->hook = luaL_ref(L, LUA_REGISTRYINDEX);
    lua_pushvalue(L, s.steps);
    node->steps = luaL_ref(L, LUA_REGISTRYINDEX);
    return 1;
}

void jox_sequence_add(lua_State *L) {
    static const luaL_Reg WORDS[] = {
        {"sequence", make_sequence}, {"wait", make_wait}, {NULL, NULL}};
    luaL_setfuncs(L, WORDS, 0);
}
