/* Lua tables as trees for base/format/patch.h; patch.c applies patches through it. Transitions are
   found by their ids. Tables are copied where they change, as a file may use one table in several
   places. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/sort.h"
#include "lua/patch_tree.h"
#include "lua/read_table.h"

int jox_nodes_push_value(JoxLuaNodes *n, void *node) {
    JOX_ASSERT((intptr_t)node >= 1 && (intptr_t)node <= n->count);
    jox_vm_charge(n->L, 5);
    lua_rawgeti(n->L, n->list, (intptr_t)node);
    return lua_gettop(n->L);
}

void *jox_nodes_pop_value(JoxLuaNodes *n) {
    if (lua_isnil(n->L, -1)) {
        lua_pop(n->L, 1);
        return NULL;
    }
    lua_rawseti(n->L, n->list, ++n->count);
    return (void *)(intptr_t)n->count;
}

/* Makes a node of the value on top of the stack, and sets the stack to `top`. */
static void *pop_node(JoxLuaNodes *n, int top) {
    void *node = jox_nodes_pop_value(n);
    lua_settop(n->L, top);
    return node;
}

/* Reports an error at key `from` of the patch. */
static void report_patch_error(JoxLuaNodes *n, const char *from, const char *code, const char *hint,
                               const char *message, const char *name) {
    JoxPosition at = jox_outline_at(n->script->vm.sources[n->source], from);
    jox_diag_error(n->script->diagnostics, at, code, hint, message, name);
}

/* Reports a name that the machine has renamed; false if it has not. */
static bool report_renamed(JoxLuaNodes *n, const char *from, const char *name) {
    lua_State *L = n->L;
    const int top = lua_gettop(L);
    const char *now = NULL;
    if (jox_read_field(L, n->table, "renamed") == LUA_TTABLE &&
        jox_read_field(L, top + 1, name) == LUA_TSTRING)
        now = jox_vm_intern(&n->script->vm, lua_tostring(L, -1));
    lua_settop(L, top);
    if (now)
        jox_diag_renamed(n->script->diagnostics,
                         jox_outline_at(n->script->vm.sources[n->source], from), name, now);
    return now != NULL;
}

/* ---- operations of JoxPatchTree ---- */

static JoxPatchKind get_lua_kind(void *c, void *node) {
    JoxLuaNodes *n = c;
    const int at = jox_nodes_push_value(n, node);
    const JoxNode *value = jox_node_get(n->L, at);
    const JoxPatchKind result = value && value->kind == JOX_NODE_NONE ? JOX_PATCH_NOTHING
                                : lua_type(n->L, at) != LUA_TTABLE    ? JOX_PATCH_LEAF
                                : jox_table_is_list(n->L, at)         ? JOX_PATCH_LIST
                                                                      : JOX_PATCH_MAP;
    lua_settop(n->L, at - 1);
    return result;
}

static void *copy_lua_node(void *c, void *node) {
    JoxLuaNodes *n = c;
    const int at = jox_nodes_push_value(n, node);
    jox_table_push_copy(n->L, at);
    lua_pushvalue(n->L, -1);
    lua_pushboolean(n->L, true);
    lua_rawset(n->L, n->copies);
    return pop_node(n, at - 1);
}

/* Lists the string keys of a table, sorted. Other keys are an error, except items where items may
   be. */
static uint32_t list_lua_keys(void *c, void *map, const char *path, const char *from,
                              const char *const **names) {
    JoxLuaNodes *n = c;
    lua_State *L = n->L;
    const int at = jox_nodes_push_value(n, map);
    const size_t length = path ? strlen(path) : 0;
    const bool states = length >= 6 && strcmp(path + length - 6, "states") == 0;
    const bool items = length > 0 && !states;
    size_t count = 0, most = 0;
    bool odd = false;
    for (lua_pushnil(L); lua_next(L, at); lua_pop(L, 1))
        most++;
    jox_vm_charge(L, 50 * most);
    const char **found = lua_newuserdatauv(L, (most + 1) * sizeof *found, 0);
    for (lua_pushnil(L); lua_next(L, at); lua_pop(L, 1))
        if (lua_type(L, -2) == LUA_TSTRING)
            found[count++] = lua_tostring(L, -2); /* valid while the table lives */
        else
            odd |= !items || !lua_isinteger(L, -2);
    if (odd)
        report_patch_error(n, from, "bad-key", "Example: states = { Walk = { push = 5 } }",
                           "this table of a patch takes names as keys%s", "");
    jox_sort_texts(found, count);
    *names = found;
    pop_node(n, at - 1); /* the list of nodes keeps the keys alive */
    return (uint32_t)count;
}

/* Returns whether the table at a stack index is a copy that is merged into. */
static bool is_copy(JoxLuaNodes *n, int index) {
    lua_pushvalue(n->L, index);
    const bool copy = lua_rawget(n->L, n->copies) != LUA_TNIL;
    lua_pop(n->L, 1);
    return copy;
}

static void *get_lua_key(void *c, void *map, const char *key) {
    JoxLuaNodes *n = c;
    const int at = jox_nodes_push_value(n, map);
    jox_read_field(n->L, at, key);
    const JoxNode *machine = jox_node_get(n->L, -1);
    if (machine && machine->kind == JOX_NODE_MACHINE && is_copy(n, at))
        lua_rawgeti(n->L, LUA_REGISTRYINDEX, machine->hook);
    return pop_node(n, at - 1);
}

/* Replaces the table on top of the stack by a machine of it, written where the one is that key
   `key` of the table at `at` has, if that is a machine. */
static void make_machine_again(JoxLuaNodes *n, int at, const char *key) {
    lua_State *L = n->L;
    jox_read_field(L, at, key);
    const JoxNode *was = jox_node_get(L, -1);
    lua_pop(L, 1);
    if (!was || was->kind != JOX_NODE_MACHINE)
        return;
    JoxNode *machine = jox_node_push(L, JOX_NODE_MACHINE);
    machine->written = was->written;
    machine->steps = was->steps;
    lua_pushvalue(L, -2);
    machine->hook = luaL_ref(L, LUA_REGISTRYINDEX);
    lua_remove(L, -2);
}

static void set_lua_key(void *c, void *map, const char *key, const JoxPatchPlace *place,
                        void *value) {
    JoxLuaNodes *n = c;
    const int at = jox_nodes_push_value(n, map);
    lua_pushstring(n->L, key);
    jox_nodes_push_value(n, value);
    if (!place) /* merged: what was there, changed */
        make_machine_again(n, at, key);
    lua_rawset(n->L, at);
    lua_settop(n->L, at - 1);
}

static void remove_lua_key(void *c, void *map, const char *key) {
    JoxLuaNodes *n = c;
    const int at = jox_nodes_push_value(n, map);
    lua_pushstring(n->L, key);
    lua_pushnil(n->L);
    lua_rawset(n->L, at);
    lua_settop(n->L, at - 1);
}

static uint32_t count_lua_items(void *c, void *node) {
    JoxLuaNodes *n = c;
    const int at = jox_nodes_push_value(n, node);
    const uint32_t items = lua_istable(n->L, at) ? (uint32_t)lua_rawlen(n->L, at) : 0;
    lua_settop(n->L, at - 1);
    return items;
}

static void *get_lua_item(void *c, void *node, uint32_t i) {
    JoxLuaNodes *n = c;
    const int at = jox_nodes_push_value(n, node);
    lua_rawgeti(n->L, at, (lua_Integer)i + 1);
    return pop_node(n, at - 1);
}

/* A removed item is `false` until sweep_lua_items. */
static void put_lua_item(void *c, void *node, uint32_t i, void *value) {
    JOX_ASSERT(i <= count_lua_items(c, node));
    JoxLuaNodes *n = c;
    const int at = jox_nodes_push_value(n, node);
    if (value)
        jox_nodes_push_value(n, value);
    else
        lua_pushboolean(n->L, 0);
    lua_rawseti(n->L, at, (lua_Integer)i + 1);
    lua_settop(n->L, at - 1);
}

static void insert_lua_item(void *c, void *node, uint32_t i, void *value) {
    JoxLuaNodes *n = c;
    const int at = jox_nodes_push_value(n, node);
    const lua_Integer length = (lua_Integer)lua_rawlen(n->L, at), place = (lua_Integer)i + 1;
    JOX_ASSERT(place <= length + 1);
    for (lua_Integer k = length; k >= place; k--) {
        jox_vm_charge(n->L, 2);
        lua_rawgeti(n->L, at, k);
        lua_rawseti(n->L, at, k + 1);
    }
    jox_nodes_push_value(n, value);
    lua_rawseti(n->L, at, place);
    lua_settop(n->L, at - 1);
}

static void sweep_lua_items(void *c, void *node) {
    JoxLuaNodes *n = c;
    const int at = jox_nodes_push_value(n, node);
    const lua_Integer length = (lua_Integer)lua_rawlen(n->L, at);
    lua_Integer kept = 0;
    for (lua_Integer k = 1; k <= length; k++) {
        jox_vm_charge(n->L, 2);
        if (lua_rawgeti(n->L, at, k) == LUA_TBOOLEAN)
            lua_pop(n->L, 1);
        else
            lua_rawseti(n->L, at, ++kept);
    }
    for (lua_Integer k = kept + 1; k <= length; k++) {
        lua_pushnil(n->L);
        lua_rawseti(n->L, at, k);
    }
    lua_settop(n->L, at - 1);
}

static const char *get_lua_text(void *c, void *leaf) {
    JoxLuaNodes *n = c;
    const int at = jox_nodes_push_value(n, leaf);
    const char *result = lua_type(n->L, at) == LUA_TSTRING ? lua_tostring(n->L, at) : NULL;
    lua_settop(n->L, at - 1); /* valid while the list holds it */
    return result;
}

/* Pushes the id of a transition and returns it; NULL if the item has none. */
static const char *push_transition_id(JoxLuaNodes *n, int state, lua_Integer i) {
    jox_vm_charge(n->L, 10);
    const bool table = lua_rawgeti(n->L, state, i) == LUA_TTABLE;
    if (!table || jox_read_field(n->L, lua_gettop(n->L), "id") != LUA_TSTRING)
        return NULL;
    return lua_tostring(n->L, -1);
}

static bool has_lua_item_id(void *c, void *node, uint32_t i, const char *id) {
    JoxLuaNodes *n = c;
    const int at = jox_nodes_push_value(n, node);
    const char *own = push_transition_id(n, at, (lua_Integer)i + 1);
    const bool is = own && strcmp(own, id) == 0;
    lua_settop(n->L, at - 1);
    return is;
}

/* Returns whether a transition of the state has the id. */
static bool is_id_used(JoxLuaNodes *n, int state, const char *id) {
    const int top = lua_gettop(n->L);
    bool taken = false;
    for (lua_Integer i = 1; i <= (lua_Integer)lua_rawlen(n->L, state) && !taken; i++) {
        const char *own = push_transition_id(n, state, i);
        taken = own && strcmp(own, id) == 0;
        lua_settop(n->L, top);
    }
    return taken;
}

/* Copies a transition for insertion, with the id `keep` or the first free one. */
static void *admit_lua_item(void *c, void *node, void *value, const char *path, const char *keep,
                            const JoxPatchPlace *place, char id[JOX_PATCH_ID]) {
    JOX_ASSERT(!keep || *keep);
    JoxLuaNodes *n = c;
    lua_State *L = n->L;
    const int state = jox_nodes_push_value(n, node), at = jox_nodes_push_value(n, value);
    if (lua_type(L, at) != LUA_TTABLE)
        report_patch_error(n, place->from, "bad-value",
                           "Example: { to = \"Exit\", when = after(5) }",
                           "a transition must be a table, not %s", luaL_typename(L, at));
    else if (lua_rawlen(L, state) >= 2 * JOX_MOST_TRANSITIONS)
        report_patch_error(n, place->from, "too-many", "Split the state",
                           "%s has too many transitions", path);
    if (lua_type(L, at) != LUA_TTABLE || lua_rawlen(L, state) >= 2 * JOX_MOST_TRANSITIONS) {
        lua_settop(L, state - 1);
        return NULL;
    }
    jox_table_push_copy(L, at);
    if (keep)
        snprintf(id, JOX_PATCH_ID, "%s", keep);
    else
        for (int nth = 1; jox_read_id(L, at, nth, id), is_id_used(n, state, id);)
            nth++;
    lua_pushstring(L, id);
    lua_setfield(L, at + 1, "id");
    lua_pushvalue(L, at + 1);
    return pop_node(n, state - 1);
}

/* Puts what a key has, `now` or NULL, behind the function of a mod that extends it; NULL if the
   patch's value does not extend. */
static void *extend_lua_key(void *c, void *now, const JoxPatchPlace *at) {
    static const char *const FUNCTIONS[] = {"on_enter", "on_exit", "on_take", "when", "steer"};
    enum {
        COUNT = sizeof FUNCTIONS / sizeof *FUNCTIONS,
        MOST_LAYERS = 32 /* Lua nests at most 200 calls of C, some four for each */
    };
    JoxLuaNodes *n = c;
    lua_State *L = n->L;
    const int top = jox_nodes_push_value(n, at->value) - 1;
    const JoxNode *change = jox_node_get(L, top + 1);
    uint32_t known = 0;
    if (!change || change->kind != JOX_NODE_LAYER) {
        lua_settop(L, top);
        return NULL;
    }
    while (known < COUNT && strcmp(FUNCTIONS[known], at->key) != 0)
        known++;
    if (known == COUNT)
        report_patch_error(n, at->from, "bad-value",
                           "before, afterwards and around extend on_enter, on_exit, on_take, when "
                           "and steer",
                           "'%s' holds no function that could be extended", at->key);
    JoxNode *layer = jox_node_push(L, known == COUNT ? JOX_NODE_ERROR : JOX_NODE_LAYER);
    layer->op = change->op;
    layer->name = change->name;
    layer->hook = change->hook;
    layer->arg = LUA_NOREF;
    layer->number = 1.0;
    if (now) {
        const JoxNode *extended = jox_node_get(L, jox_nodes_push_value(n, now));
        if (extended && extended->kind == JOX_NODE_LAYER)
            layer->number = extended->number + 1.0;
        layer->arg = luaL_ref(L, LUA_REGISTRYINDEX);
    }
    if (layer->number > MOST_LAYERS)
        report_patch_error(n, at->from, "too-many", "Let one function do the work of several",
                           "over %s functions of mods extend each other here", "32");
    return pop_node(n, top);
}

static JoxPosition locate_lua_change(void *c, const JoxPatchPlace *at) {
    const JoxLuaNodes *n = c;
    return jox_outline_at(n->script->vm.sources[n->source], at->from);
}

/* Gives each transition of a state its id, in a copy of its own, and records where it is written.
 */
static void set_transition_ids(JoxLuaNodes *n, int state, const char *path) {
    lua_State *L = n->L;
    const lua_Integer length = (lua_Integer)lua_rawlen(L, state);
    char ids[JOX_MOST_TRANSITIONS][128];
    for (lua_Integer i = 1; i <= length && i <= JOX_MOST_TRANSITIONS; i++) {
        ids[i - 1][0] = 0;
        if (lua_rawgeti(L, state, i) == LUA_TTABLE) {
            bool taken = true;
            for (int nth = 1; taken; nth++) { /* numbered as without patches */
                taken = false;
                jox_read_id(L, lua_gettop(L), nth, ids[i - 1]);
                for (lua_Integer o = 1; o < i; o++)
                    taken |= strcmp(ids[o - 1], ids[i - 1]) == 0;
            }
            jox_table_push_copy(L, lua_gettop(L));
            lua_pushstring(L, ids[i - 1]);
            lua_setfield(L, -2, "id");
            lua_rawseti(L, state, i);
            char mark[160], canonical[256], number[24];
            snprintf(mark, sizeof mark, "@%.60s", ids[i - 1]);
            snprintf(number, sizeof number, "%lld", (long long)i);
            jox_read_join(canonical, path, mark);
            jox_origin_keep(n->script, path, number, canonical);
        }
        lua_pop(L, 1);
    }
}

/* Returns whether a path leads to a state, `depth` being that of the table of states: 1, and 3 more
   for each outer state around. */
static bool is_in_states(const char *path, int depth) {
    int outer = 0;
    for (const char *at = path; (at = strstr(at, ".runs.states.")); at++)
        outer++;
    return strncmp(path, "states.", 7) == 0 && depth == 1 + 3 * outer;
}

/* Prepares a state, the only table whose items have ids, for patches of its transitions. */
static bool enter_lua_state(void *c, void *node, void *change, const char *path, const char *from,
                            int depth) {
    JOX_ASSERT(depth >= 0 && depth <= jox_lua_tree.deepest);
    JoxLuaNodes *n = c;
    if (!is_in_states(path, depth - 1))
        return false;
    if (count_lua_items(c, change) > 0)
        report_patch_error(
            n, from, "bad-patch",
            "Say where: insert_before = { ID = {...} }, insert_after, replace, change, append, "
            "or remove = { \"ID\" }",
            "%s: transitions of a patch need a place", path);
    const int state = jox_nodes_push_value(n, node);
    set_transition_ids(n, state, path);
    lua_settop(n->L, state - 1);
    return true;
}

/* Reports and skips the patch of a state that does not exist. A patch with verbs is meant to change
   one; without, it adds one. */
static bool skips_lua_state(void *c, void *node, const JoxPatchPlace *at, int depth) {
    JoxLuaNodes *n = c;
    bool verbs = false;
    if (!is_in_states(at->from, depth) || get_lua_key(c, node, at->key))
        return false;
    const JoxPatchKind is = get_lua_kind(c, at->value);
    for (int v = 0; (is == JOX_PATCH_MAP || is == JOX_PATCH_LIST) && v < JOX_PATCH_VERBS; v++)
        verbs |= get_lua_key(c, at->value, jox_patch_verbs[v]) != NULL;
    if (!verbs)
        return false;
    if (report_renamed(n, at->from, at->key))
        return true;
    const char *const *names;
    char hint[JOX_HINT];
    const uint32_t known = list_lua_keys(c, node, "states", at->from, &names);
    report_patch_error(n, at->from, "unknown-state",
                       jox_did_you_mean(at->key, names, known < 64 ? known : 64, hint),
                       "there is no state '%s' to change", at->key);
    return true;
}

/* Reports a key or transition that the patch refers to and that does not exist. */
static void report_missing_part(void *c, void *node, const char *name, const JoxPatchPlace *at,
                                bool transition) {
    JoxLuaNodes *n = c;
    if (!transition) {
        report_patch_error(n, at->from, "unknown-key", NULL, "there is no '%s' to take away", name);
        return;
    }
    if (report_renamed(n, at->from, name))
        return;
    const char *names[JOX_MOST_TRANSITIONS];
    char hint[JOX_HINT];
    size_t known = 0;
    const int state = jox_nodes_push_value(n, node);
    for (lua_Integer i = 1; i <= (lua_Integer)lua_rawlen(n->L, state); i++) {
        const char *id = push_transition_id(n, state, i);
        if (id && known < JOX_MOST_TRANSITIONS)
            names[known++] = jox_vm_intern(&n->script->vm, id);
        lua_settop(n->L, state);
    }
    lua_settop(n->L, state - 1);
    report_patch_error(n, at->from, "unknown-transition",
                       jox_did_you_mean(name, names, known, hint),
                       "this state has no transition '%s'", name);
}

/* Reports a verb, or the change of a transition, that is no table. */
static void report_misused_verb(void *c, JoxPatchVerb verb, const JoxPatchPlace *at) {
    if (strcmp(at->key, jox_patch_verbs[verb]) == 0)
        report_patch_error(c, at->from, "bad-value",
                           "Example: remove = { \"Exit\" }, change = { Exit = { ... } }",
                           "'%s' must be a table", at->key);
    else
        report_patch_error(c, at->from, "bad-value",
                           "Example: change = { Exit = { chance = 0.5 } }",
                           "the change of '%s' must be a table", at->key);
}

const JoxPatchTree jox_lua_tree = {.kind = get_lua_kind,
                                   .copy = copy_lua_node,
                                   .keys = list_lua_keys,
                                   .get = get_lua_key,
                                   .set = set_lua_key,
                                   .remove = remove_lua_key,
                                   .count = count_lua_items,
                                   .item = get_lua_item,
                                   .put = put_lua_item,
                                   .insert = insert_lua_item,
                                   .sweep = sweep_lua_items,
                                   .text = get_lua_text,
                                   .is_item = has_lua_item_id,
                                   .admit = admit_lua_item,
                                   .position = locate_lua_change,
                                   .enter = enter_lua_state,
                                   .skips = skips_lua_state,
                                   .missing = report_missing_part,
                                   .misused = report_misused_verb,
                                   .extend = extend_lua_key,
                                   .item_mark = "@",
                                   .verbs = (1u << JOX_PATCH_VERBS) - 1,
                                   .lists_merge = true,
                                   .deepest = 20};
