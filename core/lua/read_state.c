/* Reads one state of a machine: steering, parameters, actions, transitions. Called by build.c. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/language/vocabulary.h"
#include "lua/read_table.h"

/* Reads the weight of a steering term: a number, or an expression computed in each step. */
static JoxValue read_weight(JoxBuild *b, JoxNode *weight, JoxPosition position) {
    JoxValue value = {.kind = JOX_VALUE_UNSET};
    if (weight && weight->kind == JOX_NODE_NUMBER && weight->op == JOX_OP_CONST) {
        value = (JoxValue){JOX_VALUE_CONST, weight->number, 0, 0, 0};
        if (!(fabs(weight->number) <= JOX_MOST_WEIGHT))
            jox_build_error(b, position, "out-of-range", NULL,
                            "a weight must be from %d to %d, not %g", -JOX_MOST_WEIGHT,
                            JOX_MOST_WEIGHT, weight->number);
    } else if (weight) {
        value =
            (JoxValue){JOX_VALUE_EXPRESSION, 0.0, jox_build_expression(b, weight, position), 0, 0};
        if (value.index < 0)
            value = (JoxValue){.kind = JOX_VALUE_UNSET};
    }
    return value;
}

static void read_steer(JoxBuild *b, int index, const char *path, JoxState *state) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_istable(L, index) && state->steer_count == 0);
    char full[256];
    jox_read_join(full, path, "steer");
    int type = jox_read_field(L, index, "steer");
    JoxNode *node = jox_node_get(L, -1);
    if (lua_iscfunction(L, -1)) {
        jox_build_error(b, jox_read_at(b, full), "bad-value", "steer = wander(), or seek(goal)",
                        "a word of steering that takes arguments is called, with parentheses");
        lua_pop(L, 1);
        return;
    }
    if (jox_read_is_function(L, -1)) {
        int32_t extends;
        state->steer[0] = (JoxSteerTerm){
            .kind = JOX_STEER_FUNCTION, .target = -1, .hook = jox_read_function(b, full, &extends)};
        state->steer_count = 1;
        if (extends < 0)
            return;
        node = jox_node_get(L, -1); /* the steering that it extends */
        type = lua_type(L, -1);
        b->script->hooks[extends].steers = type != LUA_TNIL;
    }
    for (JoxNode *t = node; t && t->kind == JOX_NODE_STEER; t = t->next) {
        if (state->steer_count == JOX_MOST_TERMS) {
            jox_build_error(b, jox_read_at(b, full), "too-complex", NULL,
                            "a steering has at most %d terms", JOX_MOST_TERMS);
            break;
        }
        JoxSteerTerm *term = &state->steer[state->steer_count++];
        *term = t->term;
        term->target = t->target ? jox_build_target(b, t->target) : -1;
        if (term->kind == JOX_STEER_FIELD && term->target >= 0)
            term->lead = jox_build_lead(b, state, &b->machine->targets[term->target]);
        term->weight = read_weight(b, t->weight, jox_read_at(b, full));
        term->drift[0] = read_weight(b, t->a, jox_read_at(b, full));
        term->drift[1] = read_weight(b, t->b, jox_read_at(b, full));
    }
    if (type != LUA_TNIL &&
        !(node && (node->kind == JOX_NODE_STEER || node->kind == JOX_NODE_ERROR)))
        jox_build_error(b, jox_read_at(b, full), "bad-value", "Example: steer = seek(goal)",
                        "steer must be a steering or a function, not %s",
                        node ? "this value" : lua_typename(L, type));
    lua_pop(L, 1);
}

static void read_lasts(JoxBuild *b, int index, const char *path, JoxState *state) {
    const JoxParameterInfo lasts = jox_table_key_number("state", "lasts");
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_istable(L, index));
    char full[256];
    jox_read_join(full, path, "lasts");
    if (jox_read_field(L, index, "lasts") == LUA_TNIL) {
        lua_pop(L, 1);
        return;
    }
    JoxNode *node = jox_node_get(L, -1);
    if (node && node->kind == JOX_NODE_OWN) {
        state->lasts_expression = jox_build_expression(b, node, jox_read_at(b, full));
        lua_pop(L, 1);
        return;
    }
    bool is_dist;
    JoxDist dist;
    JoxValue value = jox_read_value(b, full, &lasts, &is_dist, &dist);
    state->has_lasts = is_dist || value.kind == JOX_VALUE_CONST;
    state->lasts = is_dist ? dist : jox_dist_constant(value.number);
    state->lasts_expression = value.kind == JOX_VALUE_EXPRESSION ? value.index : -1;
}

static bool read_flag(JoxBuild *b, int index, const char *path, const char *key) {
    lua_State *L = b->script->vm.L;
    char full[256];
    const int type = jox_read_field(L, index, key);
    jox_read_join(full, path, key);
    if (type != LUA_TNIL && type != LUA_TBOOLEAN)
        jox_build_error(b, jox_read_at(b, full), "bad-value", NULL, "%s must be true or false",
                        key);
    const bool set = lua_toboolean(L, -1);
    lua_pop(L, 1);
    return set;
}

static void read_flags(JoxBuild *b, int index, const char *path, JoxState *state) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_istable(L, index));
    char full[256];
    state->removes = read_flag(b, index, path, "removes");
    state->lies = read_flag(b, index, path, "lies");
    state->ends = read_flag(b, index, path, "ends");
    int type = jox_read_field(L, index, "push_weight");
    jox_read_join(full, path, "push_weight");
    const char *weight = type == LUA_TSTRING ? lua_tostring(L, -1) : "";
    state->push_nearest = strcmp(weight, "nearest") == 0;
    if (type != LUA_TNIL && !state->push_nearest && strcmp(weight, "equal") != 0)
        jox_build_error(b, jox_read_at(b, full), "bad-value", NULL,
                        "push_weight must be \"equal\" or \"nearest\"");
    lua_pop(L, 1);
}

static void read_pose(JoxBuild *b, int index, const char *path, JoxState *state) {
    lua_State *L = b->script->vm.L;
    char full[256], hint[JOX_HINT];
    const int type = jox_read_field(L, index, "pose");
    const char *text = type == LUA_TSTRING ? lua_tostring(L, -1) : "";
    jox_read_join(full, path, "pose");
    uint32_t pose = 1;
    while (pose < JOX_POSE_COUNT && strcmp(text, jox_poses[pose]) != 0)
        pose++;
    if (type != LUA_TNIL && pose == JOX_POSE_COUNT)
        jox_build_error(b, jox_read_at(b, full), "bad-value",
                        jox_did_you_mean(text, jox_poses + 1, JOX_POSE_COUNT - 1, hint),
                        "pose must be \"brace\", \"raise\", \"carry\", \"throw\", \"point\", "
                        "\"sit\" or \"kneel\"");
    else if (type != LUA_TNIL)
        state->pose = (uint8_t)pose;
    lua_pop(L, 1);
}

static void read_colour(JoxBuild *b, int index, const char *path, JoxState *state) {
    lua_State *L = b->script->vm.L;
    char full[256];
    const int type = jox_read_field(L, index, "colour");
    const char *text = type == LUA_TSTRING ? lua_tostring(L, -1) : "";
    jox_read_join(full, path, "colour");
    if (type != LUA_TNIL && !jox_colour_read(text, &state->colour)) {
        JoxText hint = {0};
        jox_colour_hint(text, &hint);
        if (type == LUA_TSTRING)
            jox_build_error(b, jox_read_at(b, full), "bad-value", hint.data, "'%.40s' is no colour",
                            text);
        else
            jox_build_error(b, jox_read_at(b, full), "bad-value", hint.data,
                            "colour must be a text, not %s", lua_typename(L, type));
        jox_text_free(&hint);
    }
    lua_pop(L, 1);
}

void jox_read_id(lua_State *L, int index, int nth, char id[128]) {
    if (jox_read_field(L, index, "id") != LUA_TSTRING) {
        lua_pop(L, 1);
        jox_read_field(L, index, "to");
    }
    const JoxNode *node = jox_node_get(L, -1);
    const bool back = node && node->kind == JOX_NODE_BACK;
    snprintf(id, 100, "%s",
             lua_type(L, -1) == LUA_TSTRING && lua_rawlen(L, -1) ? lua_tostring(L, -1)
             : lua_isnil(L, -1)                                  ? "reaction"
             : back                                              ? "back"
                                                                 : "?");
    lua_pop(L, 1);
    if (nth > 1)
        snprintf(id + strlen(id), 28, "#%d", nth);
}

/* Returns whether a transition before `t` has this id. */
static bool is_earlier_id(const JoxState *state, const JoxTransition *t, const char *id) {
    for (const JoxTransition *other = state->transitions; other < t; other++)
        if (strcmp(other->id, id) == 0)
            return true;
    return false;
}

/* Returns where the value of a key begins, or the position of the key if the value is not written
   out. */
static JoxPosition locate_value(JoxBuild *b, const char *path) {
    const JoxSource *source;
    const JoxPath *span = jox_read_span(b, path, &source);
    if (!span || span->first >= source->token_count)
        return jox_read_at(b, path);
    const JoxToken *t = &source->tokens[span->first];
    return (JoxPosition){source->path, t->line, t->column, t->end_column};
}

/* Returns whether an item does anything besides leading to a state; one that rests on messages uses
   them up. */
static bool does_something(const JoxMachine *m, const JoxTransition *t) {
    return jox_asks_for_messages(m, t->rests) || t->does.set_count || t->does.signal >= 0 ||
           t->does.tell || t->does.sets_team || t->does.sets_tags || t->on_take >= 0;
}

/* Reads the condition of an item: `when`, and `every` joined with it. */
static void read_item_condition(JoxBuild *b, int index, const char *path, JoxTransition *t) {
    const JoxParameterInfo every = jox_table_key_number("transition", "every");
    lua_State *L = b->script->vm.L;
    char full[256];
    jox_read_join(full, path, "every");
    const int type = jox_read_field(L, index, "every");
    const double seconds = type == LUA_TNUMBER ? lua_tonumber(L, -1) : NAN;
    lua_pop(L, 1);
    if (type != LUA_TNIL && !(seconds >= every.least && seconds <= every.greatest))
        jox_build_error(b, jox_read_at(b, full), "out-of-range", "Example: every = 0.5",
                        "every must be a plain number from %g to %g %s", every.least,
                        every.greatest, every.unit);
    jox_read_join(full, path, "when");
    const int when = jox_read_field(L, index, "when");
    if (type == LUA_TNIL) {
        t->when = jox_read_condition(b, full, &t->when_hook);
        return;
    }
    const JoxNode *condition = jox_node_get(L, -1);
    if (when == LUA_TFUNCTION) {
        jox_build_error(b, jox_read_at(b, full), "bad-condition",
                        "Ask in on_take, which is called each time",
                        "`every` goes with a condition, not with a function");
        lua_pop(L, 1);
        return;
    }
    if (when != LUA_TNIL && !(condition && condition->kind == JOX_NODE_CONDITION)) {
        t->when = jox_read_condition(b, full, NULL); /* says what is wrong with it */
        return;
    }
    JoxNode *due = jox_node_push(L, JOX_NODE_CONDITION);
    due->op = JOX_OP_EVERY;
    due->a = jox_node_constant(L, isnan(seconds) ? 1.0 : seconds);
    if (when != LUA_TNIL) {
        JoxNode *both = jox_node_push(L, JOX_NODE_CONDITION);
        both->op = JOX_OP_AND;
        both->a = due;
        both->b = (JoxNode *)condition;
    }
    t->when = jox_read_condition(b, full, NULL);
    lua_settop(L, index);
}

/* Reports a name that no state of the machine that is read has. */
static void report_unknown_state(JoxBuild *b, const char *path, const char *to) {
    const JoxMachine *m = b->machine;
    const char *names[256];
    char hint[JOX_HINT], prefix[256];
    size_t count = 0;
    jox_nest_name(b, b->nest, "", prefix);
    const size_t n = strlen(prefix);
    for (uint32_t s = 0; s < m->state_count + m->outer_count && count < 256; s++) {
        const char *name =
            s < m->state_count ? m->states[s].name : m->outer[s - m->state_count].name;
        if (strncmp(name, prefix, n) == 0 && (b->nest == 0 || !strchr(name + n, '.')))
            names[count++] = name + n;
    }
    const char *near = jox_did_you_mean(to, names, count, hint);
    if (b->nest > 0 && jox_machine_entry(m, to) >= 0) /* a state of the outer machine */
        near = "A machine that a state runs knows its own states: end it by a state with `ends = "
               "true`, and ask `done` around it";
    if (strcmp(to, "back") == 0)
        near = "Write it without quotes: to = back";
    jox_build_error(b, jox_read_at(b, path), "unknown-state", near, "there is no state '%s'", to);
}

/* Reads the state that a transition leads to. */
static void read_destination(JoxBuild *b, int index, const char *path, const JoxState *state,
                             JoxTransition *t) {
    lua_State *L = b->script->vm.L;
    const JoxMachine *m = b->machine;
    char full[256], whole[256];
    jox_read_join(full, path, "to");
    const char *to = jox_read_field(L, index, "to") == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
    const JoxNode *node = jox_node_get(L, -1);
    jox_nest_name(b, b->nest, to ? to : "", whole);
    int target = to ? jox_machine_entry(m, whole) : -1;
    const char *now = to && target < 0 ? jox_machine_renamed(m, JOX_PART_STATE, whole) : NULL;
    t->stays = lua_isnil(L, -1);
    if (node && node->kind == JOX_NODE_BACK) {
        t->back = true;
        target = b->nest == 0 ? m->start : m->outer[b->nested[b->nest].outer].start;
    } else if (t->stays) {
        target = b->level >= 0 ? state->start : (int)(state - m->states);
    } else if (!to && !(node && node->kind == JOX_NODE_ERROR)) {
        jox_build_error(b, jox_read_at(b, full), "missing-key",
                        "Example: { to = \"Exit\", when = after(5) }",
                        "`to` is the name of a state");
    } else if (now) {
        jox_diag_renamed(b->script->diagnostics, locate_value(b, full), to,
                         now + strlen(whole) - strlen(to));
    } else if (to && target < 0) {
        report_unknown_state(b, full, to);
    }
    lua_pop(L, 1);
    t->to = target < 0 ? 0 : (uint16_t)target;
}

static void read_transition(JoxBuild *b, int index, const char *path, const char *id,
                            const JoxState *state, JoxTransition *t) {
    const JoxParameterInfo chance = jox_table_key_number("transition", "chance");
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_istable(L, index) && *id);
    const char *known[16];
    char full[256];
    *t = jox_transition_blank(jox_strdup(id));
    t->line = jox_read_line(b, path, &t->source);
    jox_read_check(b, index, path, known, jox_table_key_names("transition", false, known, 16),
                   false);
    read_destination(b, index, path, state, t);
    read_item_condition(b, index, path, t);
    t->rests = t->when;
    for (int32_t hook = t->when_hook; hook >= 0; hook = b->script->hooks[hook].previous)
        t->rests = b->script->hooks[hook].expression;
    jox_read_join(full, path, "chance");
    if (jox_read_field(L, index, "chance") == LUA_TNIL)
        lua_pop(L, 1);
    else
        t->chance = jox_read_parameter(b, full, &chance);
    jox_read_actions(b, index, path, &t->does, NULL);
    t->on_take = jox_read_hook(b, index, path, "on_take");
    if (t->stays && !does_something(b->machine, t))
        jox_build_error(b, jox_read_at(b, path), "missing-key",
                        "Example: { to = \"Exit\", when = after(5) }",
                        "an item needs `to`, the name of a state, or something to do: set, tell, "
                        "signal or on_take");
}

static void read_state_transitions(JoxBuild *b, int index, const char *path, JoxState *state) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(!state->transitions);
    uint32_t count = (uint32_t)lua_rawlen(L, index);
    if (count > JOX_MOST_TRANSITIONS) {
        jox_build_error(b, jox_read_at(b, path), "too-many", "Split the state",
                        "a state has at most %d transitions", JOX_MOST_TRANSITIONS);
        count = JOX_MOST_TRANSITIONS;
    }
    state->transitions = jox_alloc(count + 1, sizeof *state->transitions);
    for (uint32_t i = 0; i < count; i++) {
        char full[256], item[160], id[128];
        snprintf(item, sizeof item, "%u", i + 1);
        jox_read_join(full, path, item);
        if (lua_rawgeti(L, index, i + 1) != LUA_TTABLE) {
            jox_build_error(b, jox_read_at(b, full), "bad-value",
                            "Example: { to = \"Exit\", when = after(5) }",
                            "a transition must be a table, not %s", luaL_typename(L, -1));
            lua_pop(L, 1);
            continue;
        }
        JoxTransition *t = &state->transitions[state->transition_count];
        int nth = 1;
        do
            jox_read_id(L, lua_gettop(L), nth++, id);
        while (is_earlier_id(state, t, id));
        snprintf(item, sizeof item, "@%.60s", id); /* as patches name it: by its id */
        if (b->script->changes.count > 0) {
            char canonical[256];
            jox_read_join(canonical, path, item);
            for (size_t o = 0; o < b->script->changes.count; o++)
                if (strcmp(b->script->changes.items[o].path, canonical) == 0)
                    memcpy(full, canonical, sizeof full);
        }
        read_transition(b, lua_gettop(L), full, id, state, t);
        t->level = state->depth;
        t->item = (uint16_t)i;
        state->transition_count++;
        lua_pop(L, 1);
    }
}

/* Reads a target that is a polygon, or an own value that may be one. */
static int16_t read_area(JoxBuild *b, int index, const char *path, const char *key) {
    const JoxScope *scope = b->script->scope;
    char full[256];
    jox_read_join(full, path, key);
    const int16_t number = jox_read_target(b, index, path, key);
    const JoxTarget *target = number < 0 ? NULL : &b->machine->targets[number];
    if (target && jox_target_kind_moves(target->kind))
        jox_build_error(b, jox_read_at(b, full), "bad-value", "Example: stays_in = \"yard\"",
                        "'%s' needs a place, not a body or an agent", key);
    else if (target && target->kind == JOX_TARGET_PLACE && target->arg >= 0 && scope->places &&
             !jox_place_is_area(&scope->places[target->arg]))
        jox_build_error(b, jox_read_at(b, full), "bad-value", "Name a polygon of the scene",
                        "'%s' needs a place with an area", key);
    return number;
}

void jox_read_state(JoxBuild *b, int index, JoxState *state, int32_t number) {
    const char *known[96];
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_istable(L, index) && state->name);
    JOX_ASSERT(number < (int32_t)b->machine->state_count && number != -1);
    char path[256], full[256];
    jox_state_path(state, path);
    jox_read_check(b, index, path, known, jox_table_key_names("state", true, known, 96), true);
    state->line = jox_read_line(b, path, &state->source);
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        jox_read_join(full, path, jox_parameters[p].name);
        if (jox_read_field(L, index, jox_parameters[p].name) == LUA_TNIL)
            lua_pop(L, 1);
        else
            state->param[p] = jox_read_parameter(b, full, &jox_parameters[p]);
    }
    read_steer(b, index, path, state);
    read_lasts(b, index, path, state);
    read_flags(b, index, path, state);
    read_pose(b, index, path, state);
    read_colour(b, index, path, state);
    jox_read_body_actions(b, index, path, state);
    jox_read_actions(b, index, path, &state->enters, &state->signal_every);
    jox_read_counts(b, index, path, number);
    jox_read_join(full, path, "push_when");
    jox_read_field(L, index, "push_when");
    state->push_when = jox_read_condition(b, full, NULL);
    state->push_toward = jox_read_target(b, index, path, "push_toward");
    state->face = jox_read_target(b, index, path, "face");
    state->approach = jox_read_mover(b, index, path, "approach");
    state->stays_in = read_area(b, index, path, "stays_in");
    state->ignore = jox_read_tags(b, index, path, "ignore", false);
    state->push_only = jox_read_tags(b, index, path, "push_only", false);
    state->on_enter = jox_read_hook(b, index, path, "on_enter");
    state->on_exit = jox_read_hook(b, index, path, "on_exit");
    read_state_transitions(b, index, path, state);
}
