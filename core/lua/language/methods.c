/* Methods and fields of expressions: comparisons of numbers, filters and numbers of targets, values
   of messages, and what is asked of lists or changes them. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "lua/language/vocabulary.h"

/* Compares two numbers; pushes a condition. */
static int push_comparison(lua_State *L, int op, const char *name) {
    if (jox_node_is_error(L, 1) || jox_node_is_error(L, 2))
        return jox_node_push_error(L);
    JoxNode *a = jox_node_number(L, 1), *b = jox_node_number(L, 2);
    if (lua_type(L, 2) == LUA_TBOOLEAN &&
        a) { /* mine.flag:is(true) never gets here, as a condition is no number */
        return jox_word_error(L, name, "bad-argument", NULL, ":%s wants a number", name);
    }
    if (!a || !b)
        return jox_word_error(L, name, "bad-argument", "Example: now.speed:below(0.5)",
                              ":%s compares a number with a number, not %s with %s", name,
                              jox_node_kind(L, 1),
                              lua_gettop(L) < 2 ? "nothing" : jox_node_kind(L, 2));
    jox_node_push_operation(L, JOX_NODE_CONDITION, op, a, b);
    return 1;
}
static int method_above(lua_State *L) {
    return push_comparison(L, JOX_OP_GT, "above");
}
static int method_below(lua_State *L) {
    return push_comparison(L, JOX_OP_LT, "below");
}
static int method_at_least(lua_State *L) {
    return push_comparison(L, JOX_OP_GE, "at_least");
}
static int method_at_most(lua_State *L) {
    return push_comparison(L, JOX_OP_LE, "at_most");
}
static int method_is(lua_State *L) {
    return push_comparison(L, JOX_OP_EQ, "is");
}

/* ---- filters of targets: in_state, of_machine, of_group, where, fallen, flying,
   incoming ---- */

/* Pushes a copy of the value that a method is called on, `nearest` or `neighbours`, and returns the
   filter of the copy, for the method to change; NULL with an error pushed. */
static JoxNodeFilter *push_filtered_target(lua_State *L, const char *method) {
    if (jox_node_is_error(L, 1)) {
        jox_node_push_error(L);
        return NULL;
    }
    const JoxNode *of = jox_node_get(L, 1);
    const bool counts = of && of->kind == JOX_NODE_NUMBER && of->op == JOX_OP_NEIGHBOURS;
    const JoxNode *target = counts ? of->target : of;
    const bool others =
        target && target->kind == JOX_NODE_TARGET && jox_target_kind_moves(target->target_kind);
    if (!others) {
        jox_word_error(L, method, "bad-operand", "Example: nearest(\"people\"):in_state(\"Exit\")",
                       ":%s says which of `nearest` or `neighbours`, it is nothing of %s", method,
                       jox_node_kind(L, 1));
        return NULL;
    }
    JoxNode *copy = jox_node_push(L, JOX_NODE_TARGET);
    *copy = *target;
    if (counts) {
        JoxNode *node = jox_node_push(L, JOX_NODE_NUMBER);
        node->op = JOX_OP_NEIGHBOURS;
        node->target = copy;
    }
    return &copy->filter;
}

/* Returns a filter by name, which argument 2 is; NULL with an error pushed. */
static JoxNodeFilter *push_named_target(lua_State *L, const char *method) {
    JoxNodeFilter *filter = push_filtered_target(L, method);
    if (filter && (lua_type(L, 2) != LUA_TSTRING || lua_rawlen(L, 2) > 60 || lua_rawlen(L, 2) == 0))
        jox_word_error(L, method, "bad-operand", "Example: nearest(\"people\"):in_state(\"Exit\")",
                       ":%s takes a name, which %s is not", method, jox_node_kind(L, 2));
    else if (filter && filter->flies)
        jox_word_error(L, method, "bad-operand", "Take one of them out",
                       ":%s is of people, and :flying of bodies", method);
    else
        return filter;
    return NULL;
}

static int method_in_state(lua_State *L) {
    JoxNodeFilter *filter = push_named_target(L, "in_state");
    if (filter) {
        filter->state = jox_vm_intern(jox_vm_of(L), lua_tostring(L, 2));
        filter->state_at = jox_word_place(L, filter->state);
    }
    return 1;
}

static int method_of_machine(lua_State *L) {
    JoxNodeFilter *filter = push_named_target(L, "of_machine");
    if (filter)
        filter->machine = jox_vm_intern(jox_vm_of(L), lua_tostring(L, 2));
    return 1;
}

static int method_of_group(lua_State *L) {
    const JoxScope *scope = jox_script_of(L)->scope;
    JoxNodeFilter *filter = push_named_target(L, "of_group");
    if (!filter)
        return 1;
    const char *name = lua_tostring(L, 2), *names[256];
    size_t count = 0;
    filter->grouped = true;
    filter->group = -2; /* the scene is not known: matches no group */
    for (uint32_t g = 0; g < scope->group_count; g++) {
        if (count < 256)
            names[count++] = scope->groups[g].name;
        if (strcmp(scope->groups[g].name, name) == 0)
            filter->group = (int32_t)g;
    }
    char hint[JOX_HINT];
    if (filter->group < 0 && scope->complete)
        return jox_word_error(L, name, "unknown-group", jox_did_you_mean(name, names, count, hint),
                              "the scene has no group '%s'", name);
    return 1;
}

static int method_where(lua_State *L) {
    const int given = lua_gettop(L), least = lua_type(L, 3), greatest = lua_type(L, 4);
    const bool truth = given == 3 && least == LUA_TBOOLEAN;
    const bool numbers = given < 3 || (given == 3 && least == LUA_TNUMBER) ||
                         (given == 4 && least == LUA_TNUMBER && greatest == LUA_TNUMBER);
    JoxNodeFilter *filter = push_named_target(L, "where");
    if (!filter)
        return 1;
    if (!truth && !numbers)
        return jox_word_error(L, "where", "bad-argument",
                              "nearest(\"people\"):where(\"laps\", 0, 2), or (\"ill\", false)",
                              "after the name, :where takes a least and a greatest number, or true "
                              "or false");
    filter->memory = jox_vm_intern(jox_vm_of(L), lua_tostring(L, 2));
    filter->memory_at = jox_word_place(L, filter->memory);
    filter->least = truth ? lua_toboolean(L, 3) : given > 2 ? lua_tonumber(L, 3) : 1.0;
    filter->greatest = truth ? filter->least : given > 3 ? lua_tonumber(L, 4) : INFINITY;
    return 1;
}

static int method_flying(lua_State *L) {
    JoxNodeFilter *filter = push_filtered_target(L, "flying");
    if (!filter)
        return 1;
    const JoxNode *of = jox_node_get(L, 1);
    if (of->kind != JOX_NODE_TARGET || of->target_kind != JOX_TARGET_NEAREST || filter->state ||
        filter->machine || filter->memory || filter->grouped || filter->fallen)
        return jox_word_error(L, "flying", "bad-operand", "Example: nearest(\"ball\"):flying()",
                              ":flying is of `nearest` with a tag of bodies");
    filter->flies = true;
    return 1;
}

static int method_fallen(lua_State *L) {
    JoxNodeFilter *filter = push_filtered_target(L, "fallen");
    if (filter && filter->flies)
        return jox_word_error(L, "fallen", "bad-operand", "Take one of them out",
                              ":fallen is of people, and :flying of bodies");
    if (filter)
        filter->fallen = true;
    return 1;
}

/* Reads the plain number that a filter takes as argument 2 into *to; false with an error pushed. */
static bool read_filter_number(lua_State *L, const char *word, double *to) {
    const JoxWordNumber *number = jox_word_number(word, 0);
    *to = lua_type(L, 2) == LUA_TNUMBER ? lua_tonumber(L, 2) : NAN;
    if (*to >= number->least && *to <= number->greatest)
        return true;
    jox_word_error(L, word + 1, "out-of-range", jox_word_example(word),
                   "%s takes a plain number from %g to %g %s", word, number->least,
                   number->greatest, number->unit);
    return false;
}

static int method_incoming(lua_State *L) {
    JoxNodeFilter *filter = push_filtered_target(L, "incoming");
    if (filter)
        read_filter_number(L, ":incoming", &filter->comes);
    return 1;
}

static int method_within(lua_State *L) {
    JoxNodeFilter *filter = push_filtered_target(L, "within");
    if (filter)
        read_filter_number(L, ":within", &filter->within);
    return 1;
}

static int method_ahead(lua_State *L) {
    JoxNodeFilter *filter = push_filtered_target(L, "ahead");
    if (filter)
        read_filter_number(L, ":ahead", &filter->ahead);
    return 1;
}

static const luaL_Reg METHODS[] = {{"above", method_above},
                                   {"below", method_below},
                                   {"at_least", method_at_least},
                                   {"at_most", method_at_most},
                                   {"is", method_is},
                                   {"in_state", method_in_state},
                                   {"of_machine", method_of_machine},
                                   {"of_group", method_of_group},
                                   {"where", method_where},
                                   {"fallen", method_fallen},
                                   {"flying", method_flying},
                                   {"incoming", method_incoming},
                                   {"within", method_within},
                                   {"ahead", method_ahead},
                                   {NULL, NULL}};

/* __index of a target: what is measured of it. `names` has `count` names of methods, and room for
   those of all that is measured. */
static int index_target(lua_State *L, const char *name, const char **names, size_t count) {
    static const char *const MEASURED[] = {
#define X(name, ...) #name,
        JOX_MEASURED(X)
#undef X
    };
    static const struct {
        const char *name, *instead;
    } ABSENT[] = {
        {"team", "Who is of its team: nearest \"teammates\", nearest \"opponents\""},
        {"id", "Whether two targets are the same: same(a, b)"},
        {"radius", "touches(target) and near(target, 1) ask for its distance; in functions a view "
                   "has its radius"},
        {"state", "nearest(\"people\"):in_state(\"Wait\") chooses by it"},
        {"own", "Only the agent itself reads its own values; others read theirs(target, \"NAME\"), "
                "memory that is public"},
    };
    for (int i = 0; i < JOX_NOW_COUNT; i++) {
        names[count++] = MEASURED[i];
        if (strcmp(MEASURED[i], name) != 0)
            continue;
        JoxNode *node = jox_node_push(L, JOX_NODE_NUMBER);
        node->op = JOX_OP_OF;
        node->arg = i;
        node->target = jox_node_get(L, 1);
        return 1;
    }
    char hint[JOX_HINT], theirs[128];
    snprintf(theirs, sizeof theirs, "Public memory of an agent is theirs(target, \"%.60s\")", name);
    const char *near = jox_did_you_mean(name, names, count, hint), *instead = NULL;
    for (size_t k = 0; k < sizeof ABSENT / sizeof *ABSENT; k++)
        if (strcmp(ABSENT[k].name, name) == 0)
            instead = ABSENT[k].instead;
    return jox_word_error(L, name, "unknown-method",
                          instead ? instead
                          : near  ? hint
                                  : theirs,
                          "a target has no '%s'", name);
}

/* __index of told "name": the sender of the message, or a value of it. */
static int index_message(lua_State *L, const JoxNode *told, const char *name) {
    const bool sender = strcmp(name, "sender") == 0;
    JoxNode *node = jox_node_push(L, sender ? JOX_NODE_TARGET : JOX_NODE_NUMBER);
    node->op = JOX_OP_MESSAGE;
    node->target_kind = JOX_TARGET_MESSAGE;
    node->name = told->name;
    node->field = sender ? NULL : jox_vm_intern(jox_vm_of(L), name);
    node->written = sender ? told->written : jox_word_place(L, node->field);
    return 1;
}

/* ---- lists ---- */

/* Returns the list that a method is called on; NULL with an error pushed. */
static const JoxNode *get_list(lua_State *L, const char *method) {
    const JoxNode *list = jox_node_get(L, 1);
    if (list && list->kind == JOX_NODE_LIST && list->name && list->op == JOX_LIST_NONE)
        return list;
    jox_word_error(L, method, "bad-operand", "local mine = memory { met = list(8, nobody) }",
                   ":%s is of a list in memory, not of %s", method, jox_node_kind(L, 1));
    return NULL;
}

/* Reads the item that a method of a list takes as argument 2 into `to`; false with an error pushed.
 */
static bool read_item(lua_State *L, const char *method, const JoxNode *list, JoxNode *to) {
    const bool people = list->target_kind == JOX_TARGET_NOBODY;
    to->name = list->name;
    if (people) {
        lua_settop(L, 2);
        to->target = jox_word_argument(L, method, 2, 't');
        return to->target != NULL;
    }
    to->a = jox_node_number(L, 2);
    if (to->a)
        return true;
    jox_word_error(L, method, "bad-argument", "For people: list(8, nobody)",
                   ":%s takes a number, as this list holds numbers, not %s", method,
                   jox_node_kind(L, 2));
    return false;
}

static int method_contains(lua_State *L) {
    const JoxNode *list = get_list(L, "contains");
    if (!list)
        return 1;
    JoxNode item = {0};
    if (!read_item(L, "contains", list, &item))
        return 1;
    JoxNode *node = jox_node_push(L, JOX_NODE_CONDITION);
    node->op = JOX_OP_LIST_HAS;
    node->name = item.name;
    node->a = item.a ? item.a : jox_node_constant(L, 0.0);
    node->target = item.target;
    jox_node_repush(L, node);
    return 1;
}

/* Pushes a changed list. */
static int push_change(lua_State *L, const char *method, JoxListChange change) {
    const JoxNode *list = get_list(L, method);
    if (!list)
        return 1;
    JoxNode item = {.name = list->name};
    if (change != JOX_LIST_CLEAR && !read_item(L, method, list, &item))
        return 1;
    JoxNode *node = jox_node_push(L, JOX_NODE_LIST);
    node->op = change;
    node->name = item.name;
    node->a = item.a;
    node->target = item.target;
    node->target_kind = list->target_kind;
    return 1;
}
static int method_push(lua_State *L) {
    return push_change(L, "push", JOX_LIST_PUSH);
}
static int method_remove(lua_State *L) {
    return push_change(L, "remove", JOX_LIST_REMOVE);
}
static int method_clear(lua_State *L) {
    return push_change(L, "clear", JOX_LIST_CLEAR);
}

/* __index of a list: its size, its first and its last item. */
static int index_list(lua_State *L, const JoxNode *list, const char *name) {
    const bool people = list->target_kind == JOX_TARGET_NOBODY, size = strcmp(name, "size") == 0;
    const bool last = strcmp(name, "last") == 0;
    if (lua_type(L, 2) != LUA_TSTRING)
        return jox_word_error(L, list->name ? list->name : "[", "bad-operand",
                              "Its ends are .first and .last; :contains(item) asks for an item. In "
                              "functions a list is a table",
                              "a list has no items by number");
    if (!size && !last && strcmp(name, "first") != 0)
        return jox_word_error(L, name, "unknown-method",
                              "A list has size, first, last, :contains, :push, :remove and :clear",
                              "a list has no '%s'", name);
    JoxNode *node = jox_node_push(L, people && !size ? JOX_NODE_TARGET : JOX_NODE_NUMBER);
    node->op = size ? JOX_OP_LIST_SIZE : last ? JOX_OP_LIST_LAST : JOX_OP_LIST_FIRST;
    node->target_kind = JOX_TARGET_ITEM;
    node->arg = last;
    node->name = list->name;
    return 1;
}

static const luaL_Reg LIST_METHODS[] = {{"contains", method_contains},
                                        {"push", method_push},
                                        {"remove", method_remove},
                                        {"clear", method_clear},
                                        {NULL, NULL}};

int jox_node_index(lua_State *L) {
    if (jox_node_is_error(L, 1))
        return jox_node_push_error(L);
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
    const char *names[sizeof METHODS / sizeof *METHODS + JOX_NOW_COUNT];
    size_t count = 0;
    for (const luaL_Reg *m = METHODS; m->name; m++) {
        names[count++] = m->name;
        if (strcmp(m->name, name) == 0) {
            lua_pushcfunction(L, m->func);
            return 1;
        }
    }
    const JoxNode *of = jox_node_get(L, 1);
    if (of->kind == JOX_NODE_LIST) {
        for (const luaL_Reg *m = LIST_METHODS; m->name; m++)
            if (strcmp(m->name, name) == 0)
                return lua_pushcfunction(L, m->func), 1;
        return index_list(L, of, name);
    }
    if (of->kind == JOX_NODE_CONDITION && of->op == JOX_OP_TOLD && *name && strlen(name) <= 60)
        return index_message(L, of, name);
    if (of->kind == JOX_NODE_TARGET)
        return index_target(L, name, names, count);
    char hint[JOX_HINT] = "Numbers have above, below, at_least, at_most and is";
    jox_did_you_mean(name, names, count, hint);
    return jox_word_error(L, name, "unknown-method", hint, "%s has no '%s'", jox_node_kind(L, 1),
                          name);
}
