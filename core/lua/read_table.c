/* Reads keys and values of a machine's table and checks them. Every error is reported, not only the
   first. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/language/vocabulary.h"
#include "lua/read_table.h"

enum { KEYS_MOST = 64 };

/* Reports an unknown key at its position, or at that of the table around it, with the key that was
   meant. */
static void report_unknown_key(JoxBuild *b, const char *path, const char *key,
                               const char *const *known, size_t count) {
    char full[256], hint[JOX_HINT];
    snprintf(full, sizeof full, "%s%s%s", path, *path ? "." : "", key);
    const bool transition = !strcmp(key, "transitions") || !strcmp(key, "to") ||
                            !strcmp(key, "when") || !strcmp(key, "chance");
    if (transition && !strncmp(path, "states.", 7) && !strchr(path + 7, '.')) {
        jox_build_error(b, jox_read_at(b, full), "unknown-key",
                        "Transitions are items of the state's table: { to = \"Next\", when = "
                        "after(5) }",
                        "a state has no key '%s'", key);
        return;
    }
    const char *successor = jox_parameter_successor(key);
    jox_build_error(b, jox_read_at(b, full), "unknown-key",
                    successor ? successor : jox_did_you_mean(key, known, count, hint),
                    "unknown key '%s'", key);
}

/* Reports string keys of the table at `index` that are not known, in ascending order. */
void jox_read_check(JoxBuild *b, int index, const char *path, const char *const *known,
                    size_t count, bool items) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_istable(L, index));
    JOX_ASSERT(count <= 0 || known);
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
        report_unknown_key(b, path, wrong[k], known, count);
}

/* Pushes table[key] by raw access and returns its type. */
int jox_read_field(lua_State *L, int index, const char *key) {
    JOX_ASSERT(lua_istable(L, index));
    lua_pushstring(L, key);
    return lua_rawget(L, index);
}

void jox_read_join(char path[256], const char *prefix, const char *key) {
    snprintf(path, 256, "%.190s%s%.60s", prefix, *prefix ? "." : "", key);
}

void jox_read_item_path(const JoxMachine *m, const JoxState *state, const JoxTransition *t,
                        char path[256]) {
    char around[256], item[16];
    jox_state_path(jox_state_on_level(m, state, t->level), around);
    snprintf(item, sizeof item, "%u", t->item + 1u);
    jox_read_join(path, around, item);
}

int32_t jox_read_hook(JoxBuild *b, int index, const char *path, const char *key) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(index > 0 && lua_istable(L, index));
    char full[256];
    int32_t extends = -1, hook = -1;
    jox_read_join(full, path, key);
    int type = jox_read_field(L, index, key);
    if (lua_iscfunction(L, -1) && !jox_program_word_is_action(L, -1)) {
        jox_build_error(b, jox_read_at(b, full), "bad-value", "Write: function(me) ... end",
                        "'%s' must be a function of an agent, not a word", key);
    } else if (jox_read_is_function(L, -1)) {
        hook = jox_read_function(b, full, &extends);
        if (extends < 0)
            return hook;
        type = lua_type(L, -1);
    }
    if (type != LUA_TNIL && !jox_node_is_error(L, -1))
        jox_build_error(b, jox_read_at(b, full), "bad-value", "Write: function(me) ... end",
                        "'%s' must be a function, not %s", key, jox_node_kind(L, -1));
    lua_pop(L, 1);
    return hook;
}

JoxValue jox_read_value(JoxBuild *b, const char *path, const JoxParameterInfo *info, bool *is_dist,
                        JoxDist *dist) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(info->least <= info->greatest && lua_gettop(L) > 0);
    JoxPosition position = jox_read_at(b, path);
    JoxValue value = {.kind = JOX_VALUE_UNSET};
    value.line = jox_read_line(b, path, &value.source);
    JoxNode *node = jox_node_get(L, -1);
    *is_dist = false;
    if (lua_type(L, -1) == LUA_TNUMBER) {
        value.kind = JOX_VALUE_CONST;
        value.number = lua_tonumber(L, -1);
        if (!(value.number >= info->least && value.number <= info->greatest))
            jox_build_error(b, position, "out-of-range", NULL,
                            "%s must be from %g to %g%s%s, not %g", info->name, info->least,
                            info->greatest, *info->unit ? " " : "", info->unit, value.number);
    } else if (node && node->kind == JOX_NODE_DIST) {
        *is_dist = true;
        *dist = node->dist;
    } else if (node && node->kind == JOX_NODE_OWN) {
        value.kind = JOX_VALUE_OWN;
        value.index = jox_build_own_at(b, node);
    } else if (node && node->kind == JOX_NODE_NUMBER) {
        value.kind = JOX_VALUE_EXPRESSION;
        value.index = jox_build_expression(b, node, position);
        if (value.index < 0)
            value.kind = JOX_VALUE_UNSET;
    } else if (!node || node->kind != JOX_NODE_ERROR) {
        const char *text = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "";
        char hint[96] = "Give a number, a distribution or an expression";
        if (*text >= '0' && *text <= '9')
            snprintf(hint, sizeof hint, "Numbers stand without quotes and units%s%s: %s = 1.4",
                     *info->unit ? ", in " : "", info->unit, info->name);
        jox_build_error(b, position, "bad-value", hint, "%s must be a number, not %s", info->name,
                        node ? "this value" : luaL_typename(L, -1));
    }
    lua_pop(L, 1);
    return value;
}

JoxValue jox_read_parameter(JoxBuild *b, const char *path, const JoxParameterInfo *info) {
    bool is_dist;
    JoxDist dist;
    JoxValue value = jox_read_value(b, path, info, &is_dist, &dist);
    if (is_dist) { /* drawn once per agent, into an own value without a name */
        value.kind = JOX_VALUE_OWN;
        value.index = jox_build_own(b, "");
        b->machine->own[value.index].dist = dist;
    }
    return value;
}

int32_t jox_read_condition(JoxBuild *b, const char *path, int32_t *hook) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_gettop(L) > 0);
    JoxNode *node = jox_node_get(L, -1);
    int type = lua_type(L, -1);
    int32_t expression = -1, extends = -1;
    if (hook && lua_iscfunction(L, -1)) {
        jox_build_error(b, jox_read_at(b, path), "bad-condition", "Example: when = after(5)",
                        jox_program_word_is_action(L, -1)
                            ? "an action of the program is no condition"
                            : "a word that takes arguments is called, with parentheses");
        lua_pop(L, 1);
        return -1;
    }
    if (hook && jox_read_is_function(L, -1)) {
        *hook = jox_read_function(b, path, &extends);
        if (extends < 0)
            return -1;
        node = jox_node_get(L, -1); /* the condition that it extends; nil: always */
        type = lua_type(L, -1);
    }
    bool trapped = type != LUA_TNIL && jox_misuse_explains(b, path);
    if (node && node->kind == JOX_NODE_CONDITION) {
        expression = jox_build_expression(b, node, jox_read_at(b, path));
    } else if (type != LUA_TNIL && !trapped && !(node && node->kind == JOX_NODE_ERROR)) {
        const char *hint =
            type == LUA_TBOOLEAN ? "Leave `when` out for always; compare with :is, "
                                   ":above, ... and join with & | ~"
            : !node              ? NULL
            : node->kind == JOX_NODE_STEER
                ? "Steering belongs to `steer`; that one is there is near(goal, 1), or "
                  "inside(goal)"
            : node->kind == JOX_NODE_TARGET
                ? "Ask something of it: sees(target), near(target, metres)"
                : "A number becomes a condition by :above, :below, :at_least, "
                  ":at_most or :is";
        jox_build_error(b, jox_read_at(b, path), "bad-condition", hint,
                        "this must be a condition, not %s", jox_node_kind(L, -1));
    }
    lua_pop(L, 1);
    if (extends < 0)
        return expression;
    b->script->hooks[extends].expression = expression;
    return -1;
}

int16_t jox_read_target(JoxBuild *b, int index, const char *path, const char *key) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(index > 0 && lua_istable(L, index));
    char full[256];
    jox_read_join(full, path, key);
    int type = jox_read_field(L, index, key);
    JoxNode *node = jox_node_target(L, jox_node_get(L, -1)), named = {.kind = JOX_NODE_TARGET};
    int16_t target = -1;
    if (type == LUA_TSTRING) {
        named.name = lua_tostring(L, -1);
        named.target_kind = JOX_TARGET_PLACE;
        named.target_arg = -1;
        const JoxScope *scope = b->script->scope;
        if (scope->places)
            named.target_arg = jox_place_find(scope->places, scope->place_count, named.name);
        if (named.target_arg < 0 && scope->complete)
            jox_build_error(b, jox_read_at(b, full), "unknown-place", NULL,
                            "the scene has no place '%s'", named.name);
        target = jox_build_target(b, &named);
    } else if (node && (node->kind == JOX_NODE_TARGET || node->kind == JOX_NODE_OWN)) {
        target = jox_build_target(b, node);
    } else if (type != LUA_TNIL && !(node && node->kind == JOX_NODE_ERROR)) {
        jox_build_error(b, jox_read_at(b, full), "bad-value", "Example: face = \"black_stone\"",
                        "'%s' must be a target or the name of a place", key);
    }
    lua_pop(L, 1);
    return target;
}

void jox_read_check_moves(JoxBuild *b, const char *path, const char *key, int16_t target) {
    if (target >= 0 && !jox_target_kind_moves(b->machine->targets[target].kind))
        jox_build_error(b, jox_read_at(b, path), "bad-value",
                        "Write nearest \"ball\", or another tag",
                        "'%s' needs a body or an agent, not a place", key);
}

int16_t jox_read_mover(JoxBuild *b, int index, const char *path, const char *key) {
    char full[256];
    jox_read_join(full, path, key);
    const int16_t target = jox_read_target(b, index, path, key);
    jox_read_check_moves(b, full, key, target);
    return target;
}

/* Adds the bit of the tag on top of the stack to `mask`. */
static void add_tag_bit(JoxBuild *b, const char *path, bool is_set, uint64_t *mask) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_gettop(L) > 0);
    if (lua_type(L, -1) != LUA_TSTRING || lua_rawlen(L, -1) > 60) {
        jox_build_error(b, jox_read_at(b, path), "bad-value", NULL,
                        "tags are names of at most 60 bytes");
        return;
    }
    const int32_t bit =
        jox_script_tag_or_team(b->script, lua_tostring(L, -1), false, is_set, jox_read_at(b, path));
    if (bit >= 0)
        *mask |= (uint64_t)1 << bit;
    else if (b->script->scope->complete)
        jox_build_error(b, jox_read_at(b, path), "too-many-tags", NULL,
                        "a scene has at most 64 different tags, with those that states set");
}

uint64_t jox_read_tags(JoxBuild *b, int index, const char *path, const char *key, bool is_set) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(index > 0 && lua_istable(L, index));
    char full[256];
    uint64_t mask = 0;
    jox_read_join(full, path, key);
    int type = jox_read_field(L, index, key);
    if (type == LUA_TTABLE) {
        for (lua_Integer i = 1; lua_rawgeti(L, -1, i) != LUA_TNIL; i++) {
            add_tag_bit(b, full, is_set, &mask);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
    } else if (type != LUA_TNIL) {
        add_tag_bit(b, full, is_set, &mask);
    }
    lua_pop(L, 1);
    return mask;
}

int32_t jox_read_memory(const JoxBuild *b, const char *name) {
    return jox_machine_memory(b->machine, name);
}
