/* Reads the actions of states and transitions: setting memory, signals, kicking, taking and
   throwing bodies, becoming another machine; and `counts`, memory that counts by itself.
   read_tell.c reads messages. Called by read_state.c and build.c. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/language/vocabulary.h"
#include "lua/read_table.h"

/* Reads the value that a slot of memory is set to; pops it. */
static void read_assign(JoxBuild *b, const char *path, int32_t slot, struct JoxAssign *assign) {
    static const JoxParameterInfo ANY = {"this", "", "", -1e12, 1e12, 0};
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(slot >= 0 && (uint32_t)slot < b->machine->memory_count);
    JoxNode *node = jox_node_get(L, -1);
    *assign = (struct JoxAssign){.slot = slot, .target = -1};
    if (b->machine->memory[slot].kind == JOX_MEMORY_NUMBER) {
        bool is_dist;
        JoxDist dist;
        assign->value = jox_read_value(b, path, &ANY, &is_dist, &dist);
        if (is_dist)
            jox_build_error(b, jox_read_at(b, path), "bad-value",
                            "Use `lasts` or an own value for what is drawn",
                            "memory is set to a number or an expression");
        return;
    }
    if (lua_type(L, -1) == LUA_TBOOLEAN) {
        assign->value = (JoxValue){JOX_VALUE_CONST, lua_toboolean(L, -1), 0, 0, 0};
        lua_pop(L, 1);
    } else if (node && node->kind == JOX_NODE_CONDITION) {
        assign->value =
            (JoxValue){JOX_VALUE_EXPRESSION, 0.0, jox_read_condition(b, path, NULL), 0, 0};
        if (assign->value.index < 0)
            assign->value.kind = JOX_VALUE_UNSET;
    } else {
        if (!node || node->kind != JOX_NODE_ERROR)
            jox_build_error(b, jox_read_at(b, path), "bad-value",
                            "A number becomes a condition by :above, :below, :at_least, :at_most "
                            "or :is",
                            "this memory is true or false, or set to a condition, not %s",
                            jox_node_kind(L, -1));
        lua_pop(L, 1);
    }
}

/* Reads the change of a list, on top of the stack; pops it. */
static void read_list_change(JoxBuild *b, const char *path, int32_t slot,
                             struct JoxAssign *assign) {
    lua_State *L = b->script->vm.L;
    const char *name = b->machine->memory[slot].name;
    JoxNode *node = jox_node_get(L, -1);
    *assign = (struct JoxAssign){.slot = slot, .target = -1, .change = JOX_LIST_CLEAR};
    if (node && node->kind == JOX_NODE_LIST && node->op != JOX_LIST_NONE &&
        strcmp(node->name, name) == 0) {
        assign->change = (JoxListChange)node->op;
        if (node->target)
            assign->target = jox_build_target(b, node->target);
        if (node->a)
            assign->value =
                (JoxValue){JOX_VALUE_EXPRESSION, 0.0,
                           jox_build_expression(b, node->a, jox_read_at(b, path)), 0, 0};
        if (node->a && assign->value.index < 0)
            assign->value.kind = JOX_VALUE_UNSET;
    } else if (!node || node->kind != JOX_NODE_ERROR) {
        jox_build_error(b, jox_read_at(b, path), "bad-value",
                        "Example: set = { met = mine.met:push(nearest \"people\") }",
                        "'%.60s' is a list, which is set by its own :push, :remove or :clear",
                        name);
    }
    lua_pop(L, 1);
}

/* Reads whom a slot of memory is set to, under a key of the table at `table`. */
static void read_assign_somebody(JoxBuild *b, int table, const char *path, const char *key,
                                 int32_t slot, struct JoxAssign *assign) {
    char full[256];
    *assign = (struct JoxAssign){.slot = slot, .target = jox_read_target(b, table, path, key)};
    if (assign->target < 0)
        return;
    const JoxTargetKind kind = b->machine->targets[assign->target].kind;
    jox_read_join(full, path, key);
    if (kind == JOX_TARGET_HOME || kind == JOX_TARGET_LAST_SEEN)
        jox_build_error(b, jox_read_at(b, full), "bad-value",
                        "Remember a person, a body or a place, and steer to the point itself",
                        "memory '%s' holds somebody, and a point is not", key);
}

/* Returns the number of a team, which the scene need not have; 0 with an error. */
static uint16_t read_team(JoxBuild *b, const char *path, const char *name) {
    const int32_t number = strlen(name) > 60 ? -1
                                             : jox_script_tag_or_team(b->script, name, true, true,
                                                                      jox_read_at(b, path));
    if (number < 0 && b->script->scope->complete)
        jox_build_error(b, jox_read_at(b, path), "too-many-teams", NULL,
                        "states set at most %d teams that no group has, with names of at most 60 "
                        "bytes",
                        JOX_MOST_SET_TEAMS);
    return number < 0 ? 0 : (uint16_t)number;
}

/* Reads `team` and `tags` of a `set`, unless memory has these names. */
static void read_belonging(JoxBuild *b, int table, const char *path, JoxActions *actions) {
    lua_State *L = b->script->vm.L;
    char part[256];
    jox_read_join(part, path, "team");
    const int type = jox_read_field(L, table, "team");
    if (jox_read_memory(b, "team") < 0 && type == LUA_TSTRING) {
        actions->sets_team = true;
        actions->team = read_team(b, part, lua_tostring(L, -1));
    } else if (jox_read_memory(b, "team") < 0 && type != LUA_TNIL) {
        jox_build_error(b, jox_read_at(b, part), "bad-value", "Example: set = { team = \"red\" }",
                        "team is the name of a team");
    }
    lua_settop(L, table);
    if (jox_read_memory(b, "tags") >= 0)
        return;
    actions->sets_tags = jox_read_field(L, table, "tags") != LUA_TNIL;
    lua_settop(L, table);
    actions->tags = jox_read_tags(b, table, path, "tags", true);
}

/* Reads `set`: the memory, team and tags that are set. */
static void read_set_action(JoxBuild *b, int index, const char *path, JoxActions *actions) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_istable(L, index) && !actions->set);
    char full[256], part[256];
    jox_read_join(full, path, "set");
    int type = jox_read_field(L, index, "set"), table = lua_gettop(L);
    if (type != LUA_TTABLE) {
        if (type != LUA_TNIL)
            jox_build_error(b, jox_read_at(b, full), "bad-value",
                            "Example: set = { touched = true }", "set must be a table");
        lua_pop(L, 1);
        return;
    }
    const JoxScript *script = b->script;
    const char *names[66];
    read_belonging(b, table, full, actions);
    actions->set = jox_alloc(script->memory_count + 1, sizeof *actions->set);
    for (uint32_t m = 0; m < script->memory_count; m++) {
        names[m] = script->memory[m].name;
        if (jox_read_field(L, table, names[m]) == LUA_TNIL) {
            lua_pop(L, 1);
            continue;
        }
        struct JoxAssign *assign = &actions->set[actions->set_count++];
        const int32_t slot = jox_read_memory(b, names[m]);
        jox_read_join(part, full, names[m]);
        if (jox_memory_is_list(&b->machine->memory[slot])) {
            read_list_change(b, part, slot, assign);
            continue;
        }
        if (b->machine->memory[slot].kind != JOX_MEMORY_SOMEBODY) {
            read_assign(b, part, slot, assign);
            continue;
        }
        lua_pop(L, 1);
        read_assign_somebody(b, table, full, names[m], slot, assign);
    }
    names[script->memory_count] = "team";
    names[script->memory_count + 1] = "tags";
    jox_read_check(b, table, full, names, script->memory_count + 2, false);
    lua_settop(L, table - 1);
}

/* Reads signal = "name", or { "name", every = seconds } if `every` is not NULL. */
static void read_signal(JoxBuild *b, int index, const char *path, JoxActions *actions,
                        double *every) {
    static const char *const KEYS[] = {"every"};
    lua_State *L = b->script->vm.L;
    char full[256];
    jox_read_join(full, path, "signal");
    int type = jox_read_field(L, index, "signal"), top = lua_gettop(L);
    actions->signal = -1;
    if (type == LUA_TTABLE && every) {
        jox_read_check(b, top, full, KEYS, 1, true);
        if (jox_read_field(L, top, "every") == LUA_TNUMBER)
            *every = lua_tonumber(L, -1);
        const JoxParameterInfo info = jox_table_key_number("signal", "every");
        if (!lua_isnil(L, -1) && !(*every >= info.least && *every <= info.greatest))
            jox_build_error(b, jox_read_at(b, full), "out-of-range", NULL,
                            "every must be a plain number from %g to %g %s", info.least,
                            info.greatest, info.unit);
        if (lua_rawlen(L, top) > 1)
            jox_build_error(b, jox_read_at(b, full), "bad-value",
                            "Call out a name for each, or keep it in memory that is `public`",
                            "a signal is a name and carries no value");
        lua_rawgeti(L, top, 1);
        type = lua_type(L, -1);
    }
    if (type == LUA_TSTRING && lua_rawlen(L, -1) > 0 && lua_rawlen(L, -1) <= 60)
        actions->signal = jox_build_name(b, lua_tostring(L, -1), JOX_NAME_SIGNALLED);
    else if (type != LUA_TNIL || lua_gettop(L) > top)
        jox_build_error(b, jox_read_at(b, full), "bad-value", "Example: signal = \"alarm\"",
                        "a signal is a name of 1 to 60 bytes");
    lua_settop(L, top - 1);
}

void jox_read_actions(JoxBuild *b, int index, const char *path, JoxActions *actions,
                      double *every) {
    read_set_action(b, index, path, actions);
    read_signal(b, index, path, actions, every);
    jox_read_tell(b, index, path, actions);
}

/* Reads a kick or throw: { body, at = target, VALUE = number }; returns the target of the body or
   -1. Further keys that the action has are accepted and not read. */
static int16_t read_body_action(JoxBuild *b, int index, const char *path, const char *action,
                                const JoxParameterInfo *info, int16_t *at, JoxValue *value) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_istable(L, index) && info->least < info->greatest);
    const char *keys[4];
    const size_t key_count = jox_table_key_names(action, false, keys, 4);
    char full[256], part[256], hint[JOX_HINT];
    int16_t what = -1;
    jox_read_join(full, path, action);
    *at = -1;
    int type = jox_read_field(L, index, action), table = lua_gettop(L);
    snprintf(hint, sizeof hint, "Example: %s = { nearest \"ball\", at = goal, %s = 4 }", action,
             info->name);
    if (type == LUA_TTABLE) {
        jox_read_check(b, table, full, keys, key_count, true);
        lua_rawgeti(L, table, 1);
        JoxNode *body = jox_node_get(L, -1);
        if (body && body->kind == JOX_NODE_TARGET) {
            what = jox_build_target(b, body);
            jox_read_check_moves(b, full, action, what);
        } else if (!body || body->kind != JOX_NODE_ERROR) {
            jox_build_error(b, jox_read_at(b, full), "bad-value", hint,
                            "%s needs the body as its first item", action);
        }
        lua_pop(L, 1);
        *at = jox_read_target(b, table, full, "at");
        jox_read_join(part, full, info->name);
        if (jox_read_field(L, table, info->name) == LUA_TNIL) {
            lua_pop(L, 1);
            jox_build_error(b, jox_read_at(b, full), "missing-key", hint, "%s needs `%s`", action,
                            info->name);
        } else {
            *value = jox_read_parameter(b, part, info);
        }
    } else if (type != LUA_TNIL) {
        jox_build_error(b, jox_read_at(b, full), "bad-value", hint, "%s must be a table", action);
    }
    lua_settop(L, table - 1);
    return what;
}

/* Returns whether the kick of a state, if it has one, has a key. */
static bool kick_has_key(lua_State *L, int index, const char *key) {
    const int top = lua_gettop(L);
    const bool has = jox_read_field(L, index, "kick") == LUA_TTABLE &&
                     jox_read_field(L, top + 1, key) != LUA_TNIL;
    lua_settop(L, top);
    return has;
}

/* Reads a kick: with the speed of the body, or else the impulse, and the lift, which it may lack.
 */
static void read_kick(JoxBuild *b, int index, const char *path, JoxState *state) {
    const JoxParameterInfo impulse = jox_table_key_number("kick", "impulse"),
                           speed = jox_table_key_number("kick", "speed"),
                           lift = jox_table_key_number("kick", "lift");
    lua_State *L = b->script->vm.L;
    char kick[256], full[256];
    jox_read_join(kick, path, "kick");
    const bool sets = kick_has_key(L, index, "speed");
    state->kick =
        read_body_action(b, index, path, "kick", sets ? &speed : &impulse, &state->kick_at,
                         sets ? &state->kick_speed : &state->kick_impulse);
    if (sets && kick_has_key(L, index, "impulse"))
        jox_build_error(b, jox_read_at(b, kick), "bad-value",
                        "Keep one of them; in a patch, set the other to none",
                        "kick has both `impulse` and `speed`");
    const int top = lua_gettop(L);
    jox_read_join(full, kick, "lift");
    if (jox_read_field(L, index, "kick") == LUA_TTABLE &&
        jox_read_field(L, top + 1, "lift") != LUA_TNIL)
        state->kick_lift = jox_read_parameter(b, full, &lift);
    lua_settop(L, top);
}

/* Reads `become` of a state: the name of another behaviour. */
static void read_become(JoxBuild *b, int index, const char *path, JoxState *state) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_istable(L, index) && !state->become);
    char full[256];
    jox_read_join(full, path, "become");
    int type = jox_read_field(L, index, "become");
    state->become_machine = -1;
    if (type == LUA_TSTRING && lua_rawlen(L, -1) <= 100) {
        state->become = jox_strdup(lua_tostring(L, -1));
        JoxPosition at = jox_read_at(b, full);
        state->become_file = jox_strdup(at.file);
        state->become_line = at.line;
        state->become_column = at.column;
    } else if (type != LUA_TNIL) {
        jox_build_error(b, jox_read_at(b, full), "bad-value", "Example: become = \"walker\"",
                        "become is the name of a behaviour");
    }
    lua_pop(L, 1);
}

/* Reads `grip` of a state, N, which `grasp` requires. */
static void read_grip(JoxBuild *b, int index, const char *path, JoxState *state) {
    const JoxParameterInfo grip = jox_table_key_number("state", "grip");
    char full[256];
    jox_read_join(full, path, "grip");
    if (jox_read_field(b->script->vm.L, index, "grip") == LUA_TNIL) {
        lua_pop(b->script->vm.L, 1);
        return;
    }
    state->grip = jox_read_parameter(b, full, &grip);
    if (state->grasp < 0)
        jox_build_error(b, jox_read_at(b, full), "missing-key",
                        "Example: grasp = nearest \"people\", grip = 400",
                        "grip is of a state with `grasp`");
}

void jox_read_body_actions(JoxBuild *b, int index, const char *path, JoxState *state) {
    const JoxParameterInfo speed = jox_table_key_number("throw", "speed");
    char full[256];
    read_kick(b, index, path, state);
    state->toss =
        read_body_action(b, index, path, "throw", &speed, &state->toss_at, &state->toss_speed);
    jox_read_join(full, path, "throw");
    if (state->toss >= 0 && state->toss_at < 0)
        jox_build_error(b, jox_read_at(b, full), "missing-key",
                        "Example: throw = { nearest \"ball\", at = goal, speed = 6 }",
                        "throw needs `at`, a target");
    state->take = jox_read_mover(b, index, path, "take");
    state->drop = jox_read_mover(b, index, path, "drop");
    state->grasp = jox_read_mover(b, index, path, "grasp");
    read_grip(b, index, path, state);
    read_become(b, index, path, state);
}

/* ---- counts ---- */

/* Reads the value on top of the stack as what is counted into a slot of memory; pops nothing. */
static void add_counter(JoxBuild *b, const char *path, uint32_t slot, int32_t state) {
    JOX_ASSERT(slot < b->machine->memory_count);
    JoxMachine *m = b->machine;
    JoxNode *node = jox_node_get(b->script->vm.L, -1);
    if (node && node->kind == JOX_NODE_CIRCUITS) {
        JOX_RESERVE(m->counters, b->counter_capacity, m->counter_count + 1);
        JoxCounter counter = {
            .target = jox_build_target(b, node->target), .value = (int32_t)slot, .state = state};
        const char *name = m->memory[slot].name;
        counter.angle = jox_build_hidden(b, JOX_IDENTITY_ANGLE, name, JOX_MEMORY_NUMBER);
        counter.begun = jox_build_hidden(b, JOX_IDENTITY_BEGUN, name, JOX_MEMORY_NUMBER);
        m->counters[m->counter_count++] = counter;
    } else if (!node || node->kind != JOX_NODE_ERROR) {
        jox_build_error(b, jox_read_at(b, path), "bad-value", "Example: laps = circuits \"kaaba\"",
                        "this must be something that can be counted");
    }
}

void jox_read_counts(JoxBuild *b, int index, const char *prefix, int32_t state) {
    lua_State *L = b->script->vm.L;
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
    for (uint32_t slot = 0; slot < b->script->memory_count;
         slot++) { /* by slot, as tables have no order */
        if (jox_read_field(L, table, m->memory[slot].name) != LUA_TNIL) {
            jox_read_join(full, path, m->memory[slot].name);
            add_counter(b, full, slot, state);
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
