/* The returned table becomes a JoxMachine. Everything wrong is reported, not only the first. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "base/name.h"
#include "lua/read.h"
#include "lua/vocabulary.h"

enum { KEYS_MOST = 64 };

/* The source that a path of the machine was written in, and its path there. */
static JoxSource *locate(const JoxBuild *b, const char *path, char there[512]) {
    const JoxOrigin *origin = jox_origin_of(b->vm, path);
    if (!origin) {
        snprintf(there, 512, "%s", path);
        return b->source;
    }
    size_t n = strlen(origin->path);
    const char *rest = path + n + (n && path[n] == '.');
    snprintf(there, 512, "%.250s%s%.250s", origin->from, *rest && *origin->from ? "." : "", rest);
    return &b->vm->sources[origin->source];
}

JoxPosition jox_read_at(const JoxBuild *b, const char *path) {
    char there[512];
    const JoxSource *source = locate(b, path, there);
    return jox_source_path(source, there);
}

const JoxPath *jox_read_span(const JoxBuild *b, const char *path, JoxSource **source) {
    char there[512];
    *source = locate(b, path, there);
    return jox_source_path_find(*source, there);
}

/* Position of a key itself: of the key written out, or of the table around it. */
static void unknown_key(JoxBuild *b, const char *path, const char *key, const char *const *known,
                        size_t count) {
    char full[256], hint[160];
    snprintf(full, sizeof full, "%s%s%s", path, *path ? "." : "", key);
    const char *near = jox_suggest(key, known, count);
    if (near)
        snprintf(hint, sizeof hint, "Did you mean '%s'?", near);
    jox_build_error(b, jox_read_at(b, full), "unknown-key", near ? hint : NULL, "unknown key '%s'",
                    key);
}

/* Reports string keys of the table at `index` that are not known, in ascending order. */
void jox_read_check(JoxBuild *b, int index, const char *path, const char *const *known,
                    size_t count, bool items) {
    lua_State *L = b->vm->L;
    const char *wrong[KEYS_MOST];
    size_t n = 0;
    lua_pushnil(L);
    while (lua_next(L, index)) {
        lua_pop(L, 1);
        if (lua_type(L, -1) != LUA_TSTRING) {
            if (!items || !lua_isinteger(L, -1))
                jox_build_error(b, jox_read_at(b, path), "bad-key", NULL,
                                "this table takes names as keys");
            continue;
        }
        const char *key = lua_tostring(L, -1);
        bool found = false;
        for (size_t k = 0; k < count; k++)
            found |= strcmp(known[k], key) == 0;
        if (found || n == KEYS_MOST)
            continue;
        size_t place = n++;
        for (; place > 0 && strcmp(wrong[place - 1], key) > 0; place--)
            wrong[place] = wrong[place - 1];
        wrong[place] = key;
    }
    for (size_t k = 0; k < n; k++)
        unknown_key(b, path, wrong[k], known, count);
}

/* Pushes table[key] by raw access; its type. */
int jox_read_field(lua_State *L, int index, const char *key) {
    lua_pushstring(L, key);
    return lua_rawget(L, index);
}

void jox_read_join(char path[256], const char *prefix, const char *key) {
    snprintf(path, 256, "%.190s%s%.60s", prefix, *prefix ? "." : "", key);
}

/* "states.Circle.2.on_take" in words: "state Circle > transition 2 > on_take". */
static void describe(const char *path, JoxText *out) {
    char part[128];
    for (int depth = 0; *path; depth++) {
        size_t n = strcspn(path, ".");
        snprintf(part, sizeof part, "%.*s", (int)n, path);
        bool number = part[strspn(part, "0123456789")] == 0;
        if (depth > 0)
            jox_text_printf(out, "%s%s%s", depth > 1 ? " > " : "",
                            depth == 1                               ? "state "
                            : number || (depth == 2 && *part == '@') ? "transition "
                                                                     : "",
                            *part == '@' ? part + 1 : part);
        path += n + (path[n] == '.');
    }
}

int32_t jox_read_add_hook(JoxBuild *b, const char *path) { /* takes the function from the stack */
    JoxVm *vm = b->vm;
    JoxText where = {0};
    describe(path, &where);
    JOX_RESERVE(vm->hooks, vm->hook_capacity, vm->hook_count + 1);
    vm->hooks[vm->hook_count] =
        (JoxHook){.ref = luaL_ref(vm->L, LUA_REGISTRYINDEX), .where = where.data};
    b->machine->hook_count = vm->hook_count + 1;
    return (int32_t)vm->hook_count++;
}

int32_t jox_read_hook(JoxBuild *b, int index, const char *path, const char *key) {
    lua_State *L = b->vm->L;
    char full[256];
    jox_read_join(full, path, key);
    int type = jox_read_field(L, index, key);
    if (type == LUA_TFUNCTION)
        return jox_read_add_hook(b, full);
    if (type != LUA_TNIL && !jox_node_get(L, -1))
        jox_build_error(b, jox_read_at(b, full), "bad-value", "Write: function(me) ... end",
                        "'%s' must be a function, not %s", key, lua_typename(L, type));
    lua_pop(L, 1);
    return -1;
}

/* A number, distribution or expression for a parameter; pops it. */
JoxValue jox_read_value(JoxBuild *b, const char *path, const JoxParameterInfo *info, bool *is_dist,
                        JoxDist *dist) {
    lua_State *L = b->vm->L;
    JoxPosition position = jox_read_at(b, path);
    JoxValue value = {.kind = JOX_VALUE_UNSET, .line = position.line};
    JoxNode *node = jox_node_get(L, -1);
    *is_dist = false;
    if (lua_type(L, -1) == LUA_TNUMBER) {
        value.kind = JOX_VALUE_CONST;
        value.number = lua_tonumber(L, -1);
        if (!(value.number >= info->least && value.number <= info->greatest))
            jox_build_error(b, position, "out-of-range", NULL,
                            "%s must be from %g to %g %s, not %g", info->name, info->least,
                            info->greatest, info->unit, value.number);
    } else if (node && node->kind == JOX_NODE_DIST) {
        *is_dist = true;
        *dist = node->dist;
    } else if (node && node->kind == JOX_NODE_OWN) {
        value.kind = JOX_VALUE_OWN;
        value.index = jox_build_own_at(b, node);
    } else if (node && node->kind == JOX_NODE_NUMBER) {
        value.kind = JOX_VALUE_PROGRAM;
        value.index = jox_build_program(b, node, position);
        if (value.index < 0)
            value.kind = JOX_VALUE_UNSET;
    } else if (!node || node->kind != JOX_NODE_POISON) {
        jox_build_error(b, position, "bad-value", "Give a number, a distribution or an expression",
                        "%s must be a number, not %s", info->name,
                        node ? "this value" : luaL_typename(L, -1));
    }
    lua_pop(L, 1);
    return value;
}

JoxValue jox_read_parameter(JoxBuild *b, const char *path, const JoxParameterInfo *info) {
    bool is_dist;
    JoxDist dist;
    JoxValue value = jox_read_value(b, path, info, &is_dist, &dist);
    if (is_dist) { /* drawn once per agent, into a slot of its own */
        value.kind = JOX_VALUE_OWN;
        value.index = jox_build_own(b, "");
        b->machine->own[value.index].dist = dist;
    }
    return value;
}

/* Every parameter has a slot of its own name, so that a scene's group can set any of them. */
static void read_defaults(JoxBuild *b, int index) {
    lua_State *L = b->vm->L;
    const char *known[JOX_PARAM_COUNT];
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxParameterInfo *info = &jox_parameters[p];
        known[p] = info->name;
        int32_t slot = jox_build_own(b, info->name);
        b->machine->own[slot].dist = jox_dist_constant(info->value);
        b->machine->defaults[p] = (JoxValue){JOX_VALUE_OWN, 0.0, slot, 0};
    }
    if (jox_read_field(L, index, "defaults") == LUA_TTABLE) {
        int table = lua_gettop(L);
        jox_read_check(b, table, "defaults", known, JOX_PARAM_COUNT, false);
        for (int p = 0; p < JOX_PARAM_COUNT; p++) {
            char path[256];
            bool is_dist;
            JoxDist dist;
            jox_read_join(path, "defaults", known[p]);
            if (jox_read_field(L, table, known[p]) == LUA_TNIL) {
                lua_pop(L, 1);
                continue;
            }
            JoxValue value = jox_read_value(b, path, &jox_parameters[p], &is_dist, &dist);
            b->machine->defaults[p].line = value.line;
            if (is_dist)
                b->machine->own[p].dist = dist;
            else if (value.kind == JOX_VALUE_CONST)
                b->machine->own[p].dist = jox_dist_constant(value.number);
            else if (value.kind != JOX_VALUE_UNSET)
                b->machine->defaults[p] = value;
        }
    } else if (!lua_isnil(L, -1)) {
        jox_build_error(b, jox_read_at(b, "defaults"), "bad-value", NULL,
                        "defaults must be a table");
    }
    lua_pop(L, 1);
}

/* A condition's program; -1 for none. Pops the value. A function becomes *hook where allowed. */
int32_t jox_read_condition(JoxBuild *b, const char *path, int32_t *hook) {
    lua_State *L = b->vm->L;
    JoxNode *node = jox_node_get(L, -1);
    int type = lua_type(L, -1);
    int32_t program = -1;
    if (hook && type == LUA_TFUNCTION) {
        *hook = jox_read_add_hook(b, path);
        return -1;
    }
    bool trapped = type != LUA_TNIL && jox_read_traps(b, path);
    if (node && node->kind == JOX_NODE_CONDITION) {
        program = jox_build_program(b, node, jox_read_at(b, path));
    } else if (type != LUA_TNIL && !trapped && !(node && node->kind == JOX_NODE_POISON)) {
        const char *hint = type == LUA_TBOOLEAN ? "Leave `when` out for always; compare with :is, "
                                                  ":above, ... and join with & | ~"
                           : node ? "A number becomes a condition by :above, :below, :at_least, "
                                    ":at_most or :is"
                                  : NULL;
        jox_build_error(b, jox_read_at(b, path), "bad-condition", hint,
                        "this must be a condition, not %s",
                        node ? "a number" : lua_typename(L, type));
    }
    lua_pop(L, 1);
    return program;
}

/* A target named by a key (a place's name or a target value), or -1. */
int16_t jox_read_target(JoxBuild *b, int index, const char *path, const char *key) {
    lua_State *L = b->vm->L;
    char full[256];
    jox_read_join(full, path, key);
    int type = jox_read_field(L, index, key);
    JoxNode *node = jox_node_get(L, -1), named = {.kind = JOX_NODE_TARGET};
    int16_t target = -1;
    if (type == LUA_TSTRING) {
        named.name = lua_tostring(L, -1);
        named.target_kind = JOX_TARGET_PLACE;
        named.target_arg = -1;
        const JoxScope *scope = b->vm->scope;
        if (scope->places)
            named.target_arg = jox_place_find(scope->places, scope->place_count, named.name);
        if (named.target_arg < 0 && scope->complete)
            jox_build_error(b, jox_read_at(b, full), "unknown-place", NULL,
                            "the scene has no place '%s'", named.name);
        target = jox_build_target(b, &named);
    } else if (node && (node->kind == JOX_NODE_TARGET || node->kind == JOX_NODE_OWN)) {
        target = jox_build_target(b, node);
    } else if (type != LUA_TNIL && !(node && node->kind == JOX_NODE_POISON)) {
        jox_build_error(b, jox_read_at(b, full), "bad-value", "Example: face = \"black_stone\"",
                        "'%s' must be a target or the name of a place", key);
    }
    lua_pop(L, 1);
    return target;
}

/* Adds the bit of the tag on the stack. */
static void add_tag(JoxBuild *b, const char *path, uint64_t *mask) {
    lua_State *L = b->vm->L;
    const JoxScope *scope = b->vm->scope;
    const char *name = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
    for (uint32_t i = 0; name && i < scope->tag_count; i++)
        if (strcmp(scope->tags[i], name) == 0) {
            *mask |= (uint64_t)1 << i;
            return;
        }
    if (!name || scope->complete) {
        const char *near = name ? jox_suggest(name, scope->tags, scope->tag_count) : NULL;
        char hint[96];
        if (near)
            snprintf(hint, sizeof hint, "Did you mean '%s'?", near);
        jox_build_error(b, jox_read_at(b, path), "unknown-tag", near ? hint : NULL,
                        name ? "nothing in the scene bears the tag '%s'" : "tags are names%s",
                        name ? name : "");
    }
}

uint64_t jox_read_tags(JoxBuild *b, int index, const char *path, const char *key) {
    lua_State *L = b->vm->L;
    char full[256];
    uint64_t mask = 0;
    jox_read_join(full, path, key);
    int type = jox_read_field(L, index, key);
    if (type == LUA_TTABLE) {
        for (lua_Integer i = 1; lua_rawgeti(L, -1, i) != LUA_TNIL; i++) {
            add_tag(b, full, &mask);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
    } else if (type != LUA_TNIL) {
        add_tag(b, full, &mask);
    }
    lua_pop(L, 1);
    return mask;
}

int32_t jox_read_memory(const JoxBuild *b, const char *name) {
    for (uint32_t s = 0; s < b->machine->memory_count; s++)
        if (*name && strcmp(b->machine->memory[s].name, name) == 0)
            return (int32_t)s;
    return -1;
}

/* Whether the text at a stack index can be a name, of a state or a machine. */
static bool is_name(lua_State *L, int index) {
    if (lua_type(L, index) != LUA_TSTRING)
        return false;
    const char *text = lua_tostring(L, index);
    return strlen(text) == lua_rawlen(L, index) && jox_name_is_plain(text);
}

/* The states' names, ascending: tables have no order of their own. */
static void name_states(JoxBuild *b, int table) {
    lua_State *L = b->vm->L;
    JoxMachine *m = b->machine;
    lua_pushnil(L);
    while (lua_next(L, table)) {
        bool good = is_name(L, -2) && lua_type(L, -1) == LUA_TTABLE;
        const char *name = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "?";
        char path[256];
        jox_read_join(path, "states", name);
        if (lua_type(L, -2) == LUA_TSTRING && !is_name(L, -2))
            jox_build_error(b, jox_read_at(b, path), "bad-name", JOX_NAME_RULE,
                            "'%.60s' is no name for a state", name);
        else if (!good || m->state_count >= 1000)
            jox_build_error(b, jox_read_at(b, path), "bad-value",
                            "Example: Walk = { steer = seek(goal) }",
                            "states must be tables with names");
        lua_pop(L, 1);
        if (!good || m->state_count >= 1000)
            continue;
        JOX_RESERVE(m->states, b->state_capacity, m->state_count + 1);
        uint32_t place = m->state_count++;
        for (; place > 0 && strcmp(m->states[place - 1].name, name) > 0; place--)
            m->states[place] = m->states[place - 1];
        m->states[place] = jox_state_blank(jox_strdup(name));
    }
}

static void read_states(JoxBuild *b, int index) {
    lua_State *L = b->vm->L;
    JoxMachine *m = b->machine;
    if (jox_read_field(L, index, "states") != LUA_TTABLE) {
        jox_build_error(b, jox_read_at(b, "states"), "missing-key", "states = { Walk = { ... } }",
                        "a machine needs `states`, a table");
        lua_pop(L, 1);
        return;
    }
    int table = lua_gettop(L);
    name_states(b, table);
    for (uint32_t s = 0; s < m->state_count; s++) {
        jox_read_field(L, table, m->states[s].name);
        jox_read_state(b, lua_gettop(L), &m->states[s], (int32_t)s);
        lua_settop(L, table);
    }
    if (m->state_count == 0)
        jox_build_error(b, jox_read_at(b, "states"), "no-states", NULL,
                        "a machine needs at least one state");
    lua_pop(L, 1);
}

static void read_start(JoxBuild *b, int index) {
    lua_State *L = b->vm->L;
    JoxMachine *m = b->machine;
    const char *start =
        jox_read_field(L, index, "start") == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
    int state = start ? jox_machine_state(m, start) : -1;
    if (state < 0 && m->state_count > 0)
        jox_build_error(b, jox_read_at(b, "start"), start ? "unknown-state" : "missing-key", NULL,
                        start ? "there is no state '%s' to start in"
                              : "a machine needs `start`, the name of a state%s",
                        start ? start : "");
    m->start = state < 0 ? 0 : (uint16_t)state;
    lua_pop(L, 1);
}

/* One thing that counts by itself. */
static void read_counter(JoxBuild *b, const char *path, uint32_t slot, int32_t state) {
    JoxMachine *m = b->machine;
    JoxNode *node = jox_node_get(b->vm->L, -1);
    if (node && node->kind == JOX_NODE_CIRCUITS) {
        JOX_RESERVE(m->counters, b->counter_capacity, m->counter_count + 1);
        JoxCounter counter = {
            .target = jox_build_target(b, node->target), .value = (int32_t)slot, .state = state};
        counter.angle = jox_build_memory(b, "");
        counter.begun = jox_build_memory(b, "");
        m->counters[m->counter_count++] = counter;
    } else if (!node || node->kind != JOX_NODE_POISON) {
        jox_build_error(b, jox_read_at(b, path), "bad-value", "Example: laps = circuits \"kaaba\"",
                        "this must be something that can be counted");
    }
}

void jox_read_counts(JoxBuild *b, int index, const char *prefix, int32_t state) {
    lua_State *L = b->vm->L;
    JoxMachine *m = b->machine;
    char path[256], full[256];
    int type = jox_read_field(L, index, "counts"), table = lua_gettop(L);
    jox_read_join(path, prefix, "counts");
    if (type != LUA_TTABLE) {
        if (type != LUA_TNIL)
            jox_build_error(b, jox_read_at(b, path), "bad-value", NULL, "counts must be a table");
        lua_pop(L, 1);
        return;
    }
    for (uint32_t slot = 0; slot < b->vm->memory_count; slot++) { /* in the order of the memory */
        if (jox_read_field(L, table, m->memory[slot].name) != LUA_TNIL) {
            jox_read_join(full, path, m->memory[slot].name);
            read_counter(b, full, slot, state);
        }
        lua_settop(L, table);
    }
    lua_pushnil(L);
    while (lua_next(L, table)) {
        lua_pop(L, 1);
        const char *name = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "?";
        if (jox_read_memory(b, name) >= 0)
            continue;
        jox_read_join(full, path, name);
        jox_build_error(b, jox_read_at(b, full), "unknown-memory",
                        "Declare it: local mine = memory { laps = 0 }",
                        "'%s' is counted but not remembered", name);
    }
    lua_settop(L, table - 1);
}

static void read_renamed(JoxBuild *b, int index) {
    lua_State *L = b->vm->L;
    JoxMachine *m = b->machine;
    size_t capacity = 0;
    if (jox_read_field(L, index, "renamed") == LUA_TTABLE) {
        lua_pushnil(L);
        while (lua_next(L, -2)) {
            if (lua_type(L, -1) == LUA_TSTRING && lua_type(L, -2) == LUA_TSTRING) {
                JOX_RESERVE(m->renamed, capacity, m->renamed_count + 1);
                m->renamed[m->renamed_count++] = (struct JoxRenamed){
                    jox_strdup(lua_tostring(L, -2)), jox_strdup(lua_tostring(L, -1))};
            } else {
                jox_build_error(b, jox_read_at(b, "renamed"), "bad-value",
                                "renamed = { Old = \"New\" }",
                                "renamed maps old names of states to new ones");
            }
            lua_pop(L, 1);
        }
    }
    lua_pop(L, 1);
}

/* States that nothing leads to: a warning, in a patch an error, for there it is a misspelt name. */
static void judge_states(JoxBuild *b) {
    const JoxMachine *m = b->machine;
    for (uint32_t s = 0; s < m->state_count; s++) {
        bool reached = s == m->start;
        for (uint32_t o = 0; o < m->state_count; o++)
            for (uint32_t t = 0; t < m->states[o].transition_count; t++)
                reached |= o != s && m->states[o].transitions[t].to == s;
        if (reached)
            continue;
        char path[256], hint[96];
        const char *names[64], *near = NULL;
        size_t count = 0;
        jox_read_join(path, "states", m->states[s].name);
        const JoxOrigin *origin = jox_origin_of(b->vm, path);
        bool added = origin && origin->mod >= 0 && strcmp(origin->path, path) == 0;
        for (uint32_t o = 0; added && o < m->state_count && count < 64; o++)
            if (o != s)
                names[count++] = m->states[o].name;
        near = jox_did_you_mean(m->states[s].name, names, count, hint);
        jox_diag_add(b->vm->diagnostics, near ? JOX_SEVERITY_ERROR : JOX_SEVERITY_WARNING,
                     jox_read_at(b, path), "unreachable-state", near, NULL, NULL,
                     "nothing leads to state '%s'", m->states[s].name);
    }
}

/* States without a way out, where others have one: agents stay there for ever. */
static void warn_dead_ends(JoxBuild *b) {
    const JoxMachine *m = b->machine;
    for (uint32_t s = 0; s < m->state_count && m->state_count > 1; s++) {
        const JoxState *state = &m->states[s];
        bool stands = state->steer_count == 1 && state->steer[0].kind == JOX_STEER_HOLD;
        char path[256];
        jox_read_join(path, "states", state->name);
        if (state->transition_count == 0 && !state->removes && !state->become && !stands)
            jox_diag_add(
                b->vm->diagnostics, JOX_SEVERITY_WARNING, jox_read_at(b, path), "no-way-out",
                "Add a transition, or `removes = true`; a state with `steer = hold` may be "
                "the end",
                NULL, NULL, "no transition leads out of state '%s'", state->name);
    }
}

void jox_build(JoxVm *vm, JoxSource *source) {
    lua_State *L = vm->L;
    JoxBuild build = {.vm = vm, .source = source};
    JoxNode *node = jox_node_get(L, -1);
    if (!node || node->kind != JOX_NODE_MACHINE) {
        if (!node || node->kind != JOX_NODE_POISON)
            jox_diag_error(vm->diagnostics, ((JoxPosition){source->path, 0, 0, 0}), "no-machine",
                           "End the file with: return machine { ... }",
                           "a behaviour must return one machine, not %s",
                           node ? "a value" : lua_typename(L, lua_type(L, -1)));
        return;
    }
    size_t errors = vm->diagnostics->errors;
    JoxMachine *m = build.machine = vm->built = jox_alloc(1, sizeof *m);
    m->version = 1;
    m->vm = -1;
    m->path = jox_strdup(source->path);
    lua_rawgeti(L, LUA_REGISTRYINDEX, node->hook);
    int table = lua_gettop(L);
    for (uint32_t i = 0; i < vm->memory_count; i++) {
        int32_t slot = jox_build_memory(&build, vm->memory[i].name);
        m->memory[slot].kind = vm->memory[i].kind;
        m->memory[slot].initial = vm->memory[i].initial;
    }
    const char *known[16];
    jox_read_check(&build, table, "", known, jox_sheet_names("machine", false, known, 16), false);
    jox_read_field(L, table, "name");
    m->name = jox_strdup(is_name(L, -1) ? lua_tostring(L, -1) : "machine");
    if (lua_type(L, -1) == LUA_TSTRING && !is_name(L, -1))
        jox_build_error(&build, jox_read_at(&build, "name"), "bad-name", JOX_NAME_RULE,
                        "'%.60s' is no name for a machine", lua_tostring(L, -1));
    else if (!is_name(L, -1))
        jox_build_error(&build, jox_read_at(&build, "name"), "missing-key", "name = \"walker\"",
                        "a machine needs a name");
    lua_pop(L, 1);
    read_defaults(&build, table);
    read_states(&build, table);
    read_start(&build, table);
    jox_read_counts(&build, table, "", -1);
    read_renamed(&build, table);
    if (vm->diagnostics->errors == errors) {
        judge_states(&build);
        warn_dead_ends(&build);
    }
}
