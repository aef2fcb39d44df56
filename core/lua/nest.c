/* Reads the states of a behaviour's machine and of those that its states run. A state within outer
   ones inherits what it does not set, and their transitions, which come before its own. Called by
   build.c, once nest_states.c has found the states. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/read_table.h"

/* Pushes the table of a state. */
static void push_state_table(JoxBuild *b, const JoxState *state, uint32_t nested) {
    lua_State *L = b->script->vm.L;
    const int top = lua_gettop(L);
    const int32_t outer = b->nested[nested].outer;
    const size_t prefix = outer < 0 ? 0 : strlen(b->machine->outer[outer].name) + 1;
    luaL_checkstack(L, 8, "states");
    lua_rawgeti(L, LUA_REGISTRYINDEX, b->nested[nested].table);
    jox_read_field(L, top + 1, "states");
    jox_read_field(L, top + 2, state->name + prefix);
    lua_replace(L, top + 1);
    lua_settop(L, top + 1);
}

/* ---- what a machine says for all of its states ---- */

/* Reads the keys of a machine that its states share. */
static void read_nested(JoxBuild *b, uint32_t number) {
    static const char *const NAMES[] = {"name",   "version", "start",   "defaults", "own",
                                        "public", "counts",  "renamed", "states"};
    lua_State *L = b->script->vm.L;
    JoxNested *nested = &b->nested[number];
    const JoxNested *parent = &b->nested[nested->parent];
    const int top = lua_gettop(L);
    b->nest = number;
    b->level = -1;
    b->scope++;
    lua_rawgeti(L, LUA_REGISTRYINDEX, nested->table);
    if (number > 0) {
        memcpy(nested->is_set, parent->is_set, sizeof nested->is_set);
        memcpy(nested->defaults, parent->defaults, sizeof nested->defaults);
        jox_read_check(b, top + 1, nested->path, NAMES, sizeof NAMES / sizeof *NAMES, false);
    }
    jox_read_defaults(b, top + 1, nested->path, number);
    jox_read_own(b, top + 1, nested->path);
    lua_settop(L, top);
}

static void add_renamed(JoxBuild *b, const char *from, const char *to) {
    JoxMachine *m = b->machine;
    JOX_RESERVE(m->renamed, b->renamed_capacity, m->renamed_count + 1);
    m->renamed[m->renamed_count++] = (struct JoxRenamed){jox_strdup(from), jox_strdup(to)};
}

/* Appends old names of a state within outer ones: `rest` with each old name of the state on a
   level, and of those around it, before it. `renamed` of a machine gives old names of its own
   states. */
static void add_old_names(JoxBuild *b, const JoxState *state, uint32_t level, uint32_t nested,
                          const char *rest) {
    enum { MOST = 2000 };
    lua_State *L = b->script->vm.L;
    const int top = lua_gettop(L);
    const JoxState *on = jox_state_on_level(b->machine, state, level);
    const char *dot = level > 0 ? strrchr(on->name, '.') : NULL, *name = dot ? dot + 1 : on->name;
    const uint32_t parent = b->nested[nested].parent;
    char longer[256];
    snprintf(longer, sizeof longer, "%.100s%s%.120s", name, *rest ? "." : "", rest);
    if (level > 0)
        add_old_names(b, state, level - 1, parent, longer);
    else if (strcmp(longer, state->name) != 0 && b->machine->renamed_count < MOST)
        add_renamed(b, longer, state->name);
    luaL_checkstack(L, 8, "renamed");
    lua_rawgeti(L, LUA_REGISTRYINDEX, b->nested[nested].table);
    if (jox_read_field(L, top + 1, "renamed") == LUA_TTABLE)
        for (lua_pushnil(L); lua_next(L, top + 2); lua_pop(L, 1)) {
            jox_vm_charge(L, 10);
            if (lua_type(L, -2) != LUA_TSTRING || lua_type(L, -1) != LUA_TSTRING ||
                strcmp(lua_tostring(L, -1), name) != 0)
                continue;
            snprintf(longer, sizeof longer, "%.100s%s%.120s", lua_tostring(L, -2), *rest ? "." : "",
                     rest);
            if (level > 0)
                add_old_names(b, state, level - 1, parent, longer);
            else if (b->machine->renamed_count < MOST)
                add_renamed(b, longer, state->name);
        }
    lua_settop(L, top);
}

/* Reads `renamed` of a machine that a state runs: old names of memory and own values. Those of
   states are added by add_old_names. */
static void read_renamed_values(JoxBuild *b, uint32_t number) {
    lua_State *L = b->script->vm.L;
    const JoxMachine *m = b->machine;
    const int top = lua_gettop(L);
    char path[256], full[256], whole[256];
    jox_read_join(path, b->nested[number].path, "renamed");
    lua_rawgeti(L, LUA_REGISTRYINDEX, b->nested[number].table);
    if (jox_read_field(L, top + 1, "renamed") == LUA_TTABLE)
        for (lua_pushnil(L); lua_next(L, top + 2); lua_pop(L, 1)) {
            const bool texts = lua_type(L, -2) == LUA_TSTRING && lua_type(L, -1) == LUA_TSTRING;
            const char *from = texts ? lua_tostring(L, -2) : "",
                       *to = texts ? lua_tostring(L, -1) : "";
            jox_nest_name(b, number, to, whole);
            jox_read_join(full, path, from);
            if (!texts)
                jox_build_error(b, jox_read_at(b, path), "bad-value", "renamed = { Old = \"New\" }",
                                "renamed maps old names of states, own values and memory to new "
                                "ones");
            else if (jox_machine_has(m, JOX_PART_MEMORY, to) ||
                     jox_machine_has(m, JOX_PART_OWN, to))
                add_renamed(b, from, to);
            else if (jox_machine_entry(m, whole) < 0)
                jox_diag_warn(b->script->diagnostics, jox_read_at(b, full), "unknown-name",
                              "Give the name that it has in this version",
                              "there is no state, own value or memory '%.60s'", to);
        }
    lua_settop(L, top);
}

/* Reads where a machine begins, and its counters. */
static void finish_nested(JoxBuild *b, uint32_t number) {
    lua_State *L = b->script->vm.L;
    const JoxNested *nested = &b->nested[number];
    const int top = lua_gettop(L);
    b->nest = number;
    b->level = -1;
    b->scope++;
    if (number > 0)
        read_renamed_values(b, number);
    lua_rawgeti(L, LUA_REGISTRYINDEX, nested->table);
    jox_read_counts(b, top + 1, nested->path, nested->outer < 0 ? -1 : -2 - nested->outer);
    jox_read_public(b, top + 1, nested->path);
    lua_settop(L, top);
}

/* ---- inheritance ---- */

/* Parts of a state that it inherits if its table lacks the key. */
static const struct Inherited {
    const char *key;
    size_t offset, size;
} INHERITED[] = {
#define PART(key, member)                                                                          \
    { key, offsetof(JoxState, member), sizeof((JoxState *)0)->member }
    PART("pose", pose),
    PART("steer", steer),
    PART("steer", steer_count),
    PART("lies", lies),
    PART("push_weight", push_nearest),
    PART("push_when", push_when),
    PART("push_toward", push_toward),
    PART("push_only", push_only),
    PART("ignore", ignore),
    PART("face", face),
    PART("approach", approach),
    PART("colour", colour),
    PART("kick", kick),
    PART("kick", kick_at),
    PART("kick", kick_impulse),
    PART("kick", kick_speed),
    PART("kick", kick_lift),
    PART("throw", toss),
    PART("throw", toss_at),
    PART("throw", toss_speed),
    PART("take", take),
    PART("drop", drop),
    PART("grasp", grasp),
    PART("grasp", grip),
    PART("stays_in", stays_in),
#undef PART
};

/* Returns whether a state's table, at a stack index, has a key. */
static bool has_key(lua_State *L, int table, const char *key) {
    const bool has = jox_read_field(L, table, key) != LUA_TNIL;
    lua_pop(L, 1);
    return has;
}

/* Notes which parameters a state sets, and gives it what it does not set and the outer state around
   it has. */
static void inherit_parts(JoxBuild *b, JoxState *state, uint32_t nested) {
    lua_State *L = b->script->vm.L;
    const int top = lua_gettop(L);
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        state->sets |= (uint64_t)(state->param[p].kind != JOX_VALUE_UNSET) << p;
    if (state->depth == 0)
        return;
    const JoxState *outer = &b->machine->outer[state->around[state->depth - 1]];
    push_state_table(b, state, nested);
    for (size_t k = 0; k < sizeof INHERITED / sizeof *INHERITED; k++) {
        const struct Inherited *part = &INHERITED[k];
        if (!has_key(L, top + 1, part->key))
            memcpy((char *)state + part->offset, (const char *)outer + part->offset, part->size);
    }
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        if (state->param[p].kind == JOX_VALUE_UNSET)
            state->param[p] = outer->param[p];
    lua_settop(L, top);
}

/* Puts the transitions of the outer states around a state before its own. */
static void inherit_transitions(JoxBuild *b, JoxState *state) {
    const JoxMachine *m = b->machine;
    uint32_t count = state->transition_count, n = 0;
    for (uint32_t l = 0; l < state->depth; l++)
        count += m->outer[state->around[l]].transition_count;
    if (state->depth == 0)
        return;
    if (count > JOX_MOST_TRANSITIONS) {
        char path[256];
        jox_state_path(state, path);
        jox_build_error(b, jox_read_at(b, path), "too-many", "Split the state",
                        "state '%.100s' has %u transitions with those of the states around it, at "
                        "most %d",
                        state->name, count, JOX_MOST_TRANSITIONS);
        return;
    }
    JoxTransition *all = jox_alloc(count + 1, sizeof *all);
    for (uint32_t l = 0; l < state->depth; l++) {
        const JoxState *outer = &m->outer[state->around[l]];
        for (uint32_t t = 0; t < outer->transition_count; t++)
            all[n++] = outer->transitions[t];
    }
    for (uint32_t t = 0; t < state->transition_count; t++)
        all[n++] = state->transitions[t];
    for (uint32_t t = 0; t < n; t++)
        if (all[t].stays)
            all[t].to = (uint16_t)(state - m->states);
    jox_free(state->transitions);
    state->transitions = all;
    state->transition_count = count;
}

/* Returns whether a target of a state is "one of" a set of places. */
static bool is_one_of(const JoxMachine *m, int16_t target) {
    return target >= 0 && (m->targets[target].kind == JOX_TARGET_ONE_OF ||
                           m->targets[target].kind == JOX_TARGET_ONE_OF_OWN);
}

/* Returns the level of the state around from which a state has the target "one of" that it draws
   on entering; its own depth without one. */
static int8_t find_goal_level(JoxBuild *b, const JoxState *state, uint32_t nested) {
    lua_State *L = b->script->vm.L;
    const JoxMachine *m = b->machine;
    const char *key = NULL;
    for (uint32_t t = 0; t < state->steer_count; t++)
        key = is_one_of(m, state->steer[t].target) ? "steer" : key;
    const struct {
        const char *key;
        int16_t target;
    } OTHERS[] = {{"face", state->face},
                  {"kick", state->kick_at},
                  {"throw", state->toss_at},
                  {"push_toward", state->push_toward},
                  {"stays_in", state->stays_in}};
    for (size_t k = 0; !key && k < sizeof OTHERS / sizeof *OTHERS; k++)
        key = is_one_of(m, OTHERS[k].target) ? OTHERS[k].key : NULL;
    uint32_t level = state->depth;
    for (uint32_t in = nested; key && level > 0; level--, in = b->nested[in].parent) {
        push_state_table(b, jox_state_on_level(m, state, level), in);
        const bool has = has_key(L, lua_gettop(L), key);
        lua_pop(L, 1);
        if (has)
            break;
    }
    return (int8_t)level;
}

/* Notes the outer states whose machines end in a state. */
static void find_ended(const JoxMachine *m, JoxState *state) {
    for (uint32_t l = 0; l < state->depth; l++) /* by the state within each of them */
        if (jox_state_on_level(m, state, l + 1)->ends)
            state->done |= (uint8_t)(1u << l);
}

/* Gives a state memory of the one that was left for it, if a transition leads back. */
static void add_came_from(JoxBuild *b, JoxState *state) {
    for (uint32_t t = 0; t < state->transition_count; t++)
        if (state->transitions[t].back && state->transitions[t].level == state->depth &&
            !state->came_from)
            state->came_from = 1 + (uint32_t)jox_build_hidden(b, JOX_IDENTITY_CAME_FROM,
                                                              state->name, JOX_MEMORY_STATE);
}

/* ---- reading ---- */

/* Reads `start`, the state in which a machine begins. */
static void read_start_state(JoxBuild *b, int index, uint32_t number) {
    lua_State *L = b->script->vm.L;
    JoxMachine *m = b->machine;
    char path[256], whole[256];
    jox_read_join(path, b->nested[number].path, "start");
    const char *start =
        jox_read_field(L, index, "start") == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
    jox_nest_name(b, number, start ? start : "", whole);
    int state = start ? jox_machine_entry(m, whole) : -1;
    if (state < 0 && m->state_count > 0)
        jox_build_error(b, jox_read_at(b, path), start ? "unknown-state" : "missing-key", NULL,
                        start ? "there is no state '%s' to start in"
                              : "a machine needs `start`, the name of a state%s",
                        start ? start : "");
    if (number == 0)
        m->start = state < 0 ? 0 : (uint16_t)state;
    else
        m->outer[b->nested[number].outer].start = state < 0 ? 0 : (uint16_t)state;
    lua_pop(L, 1);
}

/* Reports keys of a state that runs a machine and cannot have them. */
static void check_outer_state(JoxBuild *b, const JoxState *state) {
    char path[256], full[256];
    jox_state_path(state, path);
    jox_read_join(full, path, state->removes ? "removes" : "become");
    if (state->removes || state->become)
        jox_build_error(b, jox_read_at(b, full), "bad-value",
                        "Do it in a state to which a transition of this one leads",
                        "a state that runs a machine cannot have `%s`",
                        state->removes ? "removes" : "become");
}

static void read_one(JoxBuild *b, JoxState *state, uint32_t nested, int32_t number, int32_t level) {
    lua_State *L = b->script->vm.L;
    const int top = lua_gettop(L);
    if (b->nest != nested || level >= 0 || b->level >= 0)
        b->scope++;
    b->nest = nested;
    b->level = level;
    push_state_table(b, state, nested);
    jox_read_state(b, top + 1, state, number);
    lua_settop(L, top);
}

void jox_nest_read(JoxBuild *b) {
    JoxMachine *m = b->machine;
    lua_State *L = b->script->vm.L;
    for (uint32_t n = 0; n < b->nested_count; n++)
        read_nested(b, n);
    for (uint32_t n = b->nested_count; n-- > 0;) { /* inner machines first */
        lua_rawgeti(L, LUA_REGISTRYINDEX, b->nested[n].table);
        read_start_state(b, lua_gettop(L), n);
        lua_pop(L, 1);
    }
    for (uint32_t s = 0; s < m->state_count; s++)
        if (m->states[s].depth > 0)
            add_old_names(b, &m->states[s], m->states[s].depth, b->state_nested[s], "");
    for (uint32_t o = 0; o < m->outer_count; o++)
        if (m->outer[o].depth > 0)
            add_old_names(b, &m->outer[o], m->outer[o].depth, b->outer_nested[o], "");
    for (uint32_t o = 0; o < m->outer_count; o++) {
        read_one(b, &m->outer[o], b->outer_nested[o], -2 - (int32_t)o, m->outer[o].depth);
        check_outer_state(b, &m->outer[o]);
    }
    for (uint32_t s = 0; s < m->state_count; s++)
        read_one(b, &m->states[s], b->state_nested[s], (int32_t)s, -1);
    for (uint32_t n = 0; n < b->nested_count; n++)
        finish_nested(b, n);
    for (uint32_t o = 0; o < m->outer_count; o++) {
        inherit_parts(b, &m->outer[o], b->outer_nested[o]);
        add_came_from(b, &m->outer[o]);
    }
    for (uint32_t s = 0; s < m->state_count; s++) {
        JoxState *state = &m->states[s];
        const JoxNested *nested = &b->nested[b->state_nested[s]];
        inherit_parts(b, state, b->state_nested[s]);
        for (int p = 0; p < JOX_PARAM_COUNT; p++)
            if (state->param[p].kind == JOX_VALUE_UNSET)
                state->param[p] = nested->defaults[p];
        state->goal_level = find_goal_level(b, state, b->state_nested[s]);
        add_came_from(b, state);
        inherit_transitions(b, state);
        find_ended(m, state);
    }
}
