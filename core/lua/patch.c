/* Mods change a behaviour's table before it is read: key by key, transitions by their ids. Tables
   are copied where they change, for a file may use one table in several places. Every path that is
   set is kept with where it was set. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/path.h"
#include "base/sort.h"
#include "lua/language/vocabulary.h"
#include "lua/loader.h"
#include "lua/read.h"

enum { DEEPEST = 8 };

typedef struct Patch {
    JoxScript *script;
    uint32_t source; /* number of the patch's file */
    int32_t mod;
} Patch;

static void fail(const Patch *p, const char *from, const char *code, const char *hint,
                 const char *message, const char *name) {
    jox_diag_error(p->script->diagnostics, jox_outline_at(p->script->vm.sources[p->source], from),
                   code, hint, message, name);
}

static void set_origin(const Patch *p, const char *path, const char *from, bool removes) {
    jox_origin_set(p->script, (JoxOrigin){(char *)path, p->source, (char *)from, p->mod, removes});
}

/* Pushes a copy of the table at `index`, its items shared. */
static void push_copy(lua_State *L, int index) {
    lua_newtable(L);
    int copy = lua_gettop(L);
    lua_pushnil(L);
    while (lua_next(L, index)) {
        jox_vm_charge(L, 5);
        lua_pushvalue(L, -2);
        lua_insert(L, -2);
        lua_rawset(L, copy);
    }
}

static bool is_none(lua_State *L, int index) {
    JoxNode *node = jox_node_get(L, index);
    return node && node->kind == JOX_NODE_NONE;
}

/* Pushes the string keys of the table at `index`, sorted, as a list; returns how many. Other keys
   are an error, but for a list's where there may be `items`. */
static lua_Integer push_keys(const Patch *p, int index, const char *from, bool items) {
    lua_State *L = p->script->vm.L;
    size_t count = 0, most = 0;
    bool odd = false;
    for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1))
        most++;
    jox_vm_charge(L, 50 * most);
    const char **keys = lua_newuserdatauv(L, (most + 1) * sizeof *keys, 0);
    for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
        if (lua_type(L, -2) == LUA_TSTRING)
            keys[count++] = lua_tostring(L, -2); /* the table holds it */
        else
            odd |= !items || !lua_isinteger(L, -2);
    }
    if (odd)
        fail(p, from, "bad-key", "Example: states = { Walk = { push = 5 } }",
             "this table of a patch takes names as keys%s", "");
    jox_sort_texts(keys, count);
    lua_createtable(L, (int)count, 0);
    for (size_t k = 0; k < count; k++) {
        lua_pushstring(L, keys[k]);
        lua_rawseti(L, -2, (lua_Integer)k + 1);
    }
    lua_remove(L, -2);
    return (lua_Integer)count;
}

/* Whether the table at `index` is a list and nothing else. */
static bool is_list(lua_State *L, int index) {
    bool list = lua_type(L, index) == LUA_TTABLE && lua_rawlen(L, index) > 0;
    if (!list)
        return false;
    for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1))
        list &= lua_isinteger(L, -2) != 0;
    return list;
}

typedef void Merge(const Patch *p, int base, int change, const char *path, const char *from,
                   int depth);

/* Sets base[key] to the value on top of the stack, popped; tables are merged by `inner` where both
   sides have one, but a list takes a list's place. */
static void merge_key(const Patch *p, int base, const char *key, const char *path, const char *from,
                      Merge *inner, int depth) {
    lua_State *L = p->script->vm.L;
    int value = lua_gettop(L);
    char whole[256], there[256];
    jox_read_join(whole, path, key);
    jox_read_join(there, from, key);
    luaL_checkstack(L, 12, NULL);
    int had = jox_read_field(L, base, key);
    if (is_none(L, value)) {
        if (had == LUA_TNIL)
            fail(p, there, "unknown-key", NULL, "there is no '%s' to take away", key);
        lua_pushnil(L);
        lua_setfield(L, base, key);
        set_origin(p, whole, there, true);
    } else if (had == LUA_TTABLE && lua_type(L, value) == LUA_TTABLE && inner && depth < DEEPEST &&
               !(is_list(L, value) && is_list(L, value + 1))) {
        push_copy(L, value + 1);
        inner(p, lua_gettop(L), value, whole, there, depth + 1);
        lua_setfield(L, base, key);
    } else {
        lua_pushvalue(L, value);
        lua_setfield(L, base, key);
        set_origin(p, whole, there, false);
    }
    lua_settop(L, value - 1);
}

/* Merges one key of a table; the value is on top of the stack. */
typedef void MergeKey(const Patch *p, int base, const char *key, const char *path, const char *from,
                      int depth);

/* Visits the string keys of a change, in ascending order; others are an error, but for items. */
static void merge_keys(const Patch *p, int base, int change, const char *path, const char *from,
                       int depth, MergeKey *visit, bool items) {
    lua_State *L = p->script->vm.L;
    lua_Integer count = push_keys(p, change, from, items);
    int keys = lua_gettop(L);
    for (lua_Integer k = 1; k <= count; k++) {
        lua_rawgeti(L, keys, k);
        const char *key = lua_tostring(L, -1);
        jox_read_field(L, change, key);
        visit(p, base, key, path, from, depth);
        lua_settop(L, keys);
    }
    lua_settop(L, keys - 1);
}

static Merge merge_plain;
static void plain_key(const Patch *p, int base, const char *key, const char *path, const char *from,
                      int depth) {
    merge_key(p, base, key, path, from, merge_plain, depth);
}

/* Plain tables: defaults, counts, renamed, kick, throw, set. */
static void merge_plain(const Patch *p, int base, int change, const char *path, const char *from,
                        int depth) {
    lua_State *L = p->script->vm.L;
    merge_keys(p, base, change, path, from, depth, plain_key, true);
    lua_Integer items = (lua_Integer)lua_rawlen(L, change);
    for (lua_Integer i = 1; i <= items; i++) { /* the body of a kick */
        char number[24], whole[256], there[256];
        snprintf(number, sizeof number, "%lld", (long long)i);
        jox_read_join(whole, path, number);
        jox_read_join(there, from, number);
        lua_rawgeti(L, change, i);
        lua_rawseti(L, base, i);
        set_origin(p, whole, there, false);
    }
}

/* ---- transitions ---- */

/* Gives every transition of the state its id, as a copy of its own, and keeps where it stands. Once
   a state. */
static void name_transitions(const Patch *p, int state, const char *path) {
    lua_State *L = p->script->vm.L;
    lua_Integer count = (lua_Integer)lua_rawlen(L, state);
    char ids[JOX_MOST_TRANSITIONS][128];
    for (lua_Integer i = 1; i <= count && i <= JOX_MOST_TRANSITIONS; i++) {
        if (lua_rawgeti(L, state, i) == LUA_TTABLE) {
            bool taken = true;
            for (int nth = 1; taken; nth++) { /* as without patches */
                taken = false;
                jox_read_id(L, lua_gettop(L), nth, ids[i - 1]);
                for (lua_Integer o = 1; o < i; o++)
                    taken |= strcmp(ids[o - 1], ids[i - 1]) == 0;
            }
            push_copy(L, lua_gettop(L));
            lua_pushstring(L, ids[i - 1]);
            lua_setfield(L, -2, "id");
            lua_rawseti(L, state, i);
            char item[160], canonical[256], number[24];
            snprintf(item, sizeof item, "@%.60s", ids[i - 1]);
            snprintf(number, sizeof number, "%lld", (long long)i);
            jox_read_join(canonical, path, item);
            jox_origin_keep(p->script, path, number, canonical);
        } else {
            ids[i - 1][0] = 0;
        }
        lua_pop(L, 1);
    }
}

/* Place of the transition with this id in a state, or 0 with an error. */
static lua_Integer find_transition(const Patch *p, int state, const char *id, const char *from) {
    lua_State *L = p->script->vm.L;
    const char *names[JOX_MOST_TRANSITIONS];
    char hint[96];
    size_t count = 0;
    lua_Integer length = (lua_Integer)lua_rawlen(L, state), found = 0;
    int top = lua_gettop(L);
    for (lua_Integer i = 1; i <= length; i++, lua_settop(L, top)) {
        jox_vm_charge(L, 10);
        if (lua_rawgeti(L, state, i) != LUA_TTABLE ||
            jox_read_field(L, top + 1, "id") != LUA_TSTRING)
            continue;
        const char *name = jox_vm_intern(&p->script->vm, lua_tostring(L, -1));
        if (count < JOX_MOST_TRANSITIONS)
            names[count++] = name;
        found = strcmp(name, id) == 0 ? i : found;
    }
    if (!found)
        fail(p, from, "unknown-transition", jox_did_you_mean(id, names, count, hint),
             "this state has no transition '%s'", id);
    return found;
}

/* Puts the transition on top of the stack at place `at`, and keeps where it stands. */
static void insert_transition(const Patch *p, int state, lua_Integer at, const char *path,
                              const char *from) {
    lua_State *L = p->script->vm.L;
    char id[128], item[160], canonical[256];
    if (lua_type(L, -1) != LUA_TTABLE) {
        fail(p, from, "bad-value", "Example: { to = \"Exit\", when = after(5) }",
             "a transition must be a table, not %s", luaL_typename(L, -1));
        lua_pop(L, 1);
        return;
    }
    push_copy(L, lua_gettop(L));
    lua_remove(L, -2);
    int item_at = lua_gettop(L), nth = 1;
    lua_Integer length = (lua_Integer)lua_rawlen(L, state);
    if (length >= 2 * JOX_MOST_TRANSITIONS) {
        fail(p, from, "too-many", "Split the state", "%s has too many transitions", path);
        lua_pop(L, 1);
        return;
    }
    bool taken = true;
    for (; taken && nth <= length + 1; nth++) { /* the first id that is free */
        taken = false;
        jox_read_id(L, item_at, nth, id);
        for (lua_Integer i = 1; i <= length; i++) {
            jox_vm_charge(L, 10);
            bool table = lua_rawgeti(L, state, i) == LUA_TTABLE;
            if (table && jox_read_field(L, item_at + 1, "id") == LUA_TSTRING)
                taken |= strcmp(lua_tostring(L, -1), id) == 0;
            lua_settop(L, item_at);
        }
    }
    lua_pushstring(L, id);
    lua_setfield(L, item_at, "id");
    for (lua_Integer i = length; i >= at; i--) {
        jox_vm_charge(L, 2);
        lua_rawgeti(L, state, i);
        lua_rawseti(L, state, i + 1);
    }
    lua_rawseti(L, state, at);
    snprintf(item, sizeof item, "@%.60s", id);
    jox_read_join(canonical, path, item);
    set_origin(p, canonical, from, false);
}

/* One transition, or a list of them, on top of the stack, popped: put in from place `at` on. */
static void insert_all(const Patch *p, int state, lua_Integer at, const char *path,
                       const char *from) {
    lua_State *L = p->script->vm.L;
    int value = lua_gettop(L);
    bool list = lua_type(L, value) == LUA_TTABLE && lua_rawlen(L, value) > 0;
    lua_Integer count = list ? (lua_Integer)lua_rawlen(L, value) : 1;
    for (lua_Integer i = 1; i <= count; i++) {
        char there[256], number[24];
        snprintf(number, sizeof number, "%lld", (long long)i);
        jox_read_join(there, from, number);
        if (list)
            lua_rawgeti(L, value, i);
        else
            lua_pushvalue(L, value);
        insert_transition(p, state, at + i - 1, path, list ? there : from);
    }
    lua_settop(L, value - 1);
}

static void remove_transition(const Patch *p, int state, lua_Integer at, const char *id,
                              const char *path, const char *from) {
    lua_State *L = p->script->vm.L;
    char item[160], canonical[256];
    lua_Integer length = (lua_Integer)lua_rawlen(L, state);
    for (lua_Integer i = at; i <= length; i++) {
        jox_vm_charge(L, 2);
        lua_rawgeti(L, state, i + 1);
        lua_rawseti(L, state, i);
    }
    snprintf(item, sizeof item, "@%.60s", id);
    jox_read_join(canonical, path, item);
    set_origin(p, canonical, from, true);
}

typedef enum { CHANGE, REPLACE, INSERT_BEFORE, INSERT_AFTER, REMOVE, APPEND, VERBS } Verb;
static const char *const VERB_NAMES[VERBS] = {"change",       "replace", "insert_before",
                                              "insert_after", "remove",  "append"};

/* change, replace, insert_before, insert_after: a table of id = transition. */
static void merge_by_id(const Patch *p, Verb verb, int state, int table, const char *path,
                        const char *from) {
    lua_State *L = p->script->vm.L;
    lua_Integer count = push_keys(p, table, from, false);
    int keys = lua_gettop(L);
    for (lua_Integer k = 1; k <= count; k++) {
        char there[256], item[160], canonical[256];
        lua_rawgeti(L, keys, k);
        const char *id = lua_tostring(L, -1);
        jox_read_join(there, from, id);
        lua_Integer at = find_transition(p, state, id, there);
        jox_read_field(L, table, id);
        int value = lua_gettop(L);
        if (!at)
            ;
        else if (verb == CHANGE && lua_type(L, value) == LUA_TTABLE) {
            snprintf(item, sizeof item, "@%.60s", id);
            jox_read_join(canonical, path, item);
            lua_rawgeti(L, state, at);
            push_copy(L, lua_gettop(L));
            merge_plain(p, lua_gettop(L), value, canonical, there, 2);
            lua_rawseti(L, state, at);
        } else if (verb == CHANGE) {
            fail(p, there, "bad-value", "Example: change = { Exit = { chance = 0.5 } }",
                 "the change of '%s' must be a table", id);
        } else if (verb == REPLACE) {
            char kept[128];
            snprintf(kept, sizeof kept, "%s", id);
            remove_transition(p, state, at, kept, path, there);
            if (lua_type(L, value) == LUA_TTABLE) { /* it keeps its id */
                push_copy(L, value);
                lua_pushstring(L, kept);
                lua_setfield(L, -2, "id");
                lua_replace(L, value);
            }
            insert_all(p, state, at, path, there);
        } else {
            insert_all(p, state, verb == INSERT_BEFORE ? at : at + 1, path, there);
        }
        lua_settop(L, keys);
    }
    lua_settop(L, keys - 1);
}

static void merge_remove(const Patch *p, int state, int table, const char *path, const char *from) {
    lua_State *L = p->script->vm.L;
    lua_Integer count = (lua_Integer)lua_rawlen(L, table);
    for (lua_Integer i = 1; i <= count; i++) {
        char id[128];
        lua_rawgeti(L, table, i);
        snprintf(id, sizeof id, "%s", lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "?");
        lua_pop(L, 1);
        lua_Integer at = find_transition(p, state, id, from);
        if (at)
            remove_transition(p, state, at, id, path, from);
    }
}

static void merge_verb(const Patch *p, Verb verb, int state, const char *path, const char *from) {
    lua_State *L = p->script->vm.L;
    int table = lua_gettop(L);
    char there[256];
    jox_read_join(there, from, VERB_NAMES[verb]);
    if (lua_type(L, table) != LUA_TTABLE)
        fail(p, there, "bad-value", "Example: remove = { \"Exit\" }, change = { Exit = { ... } }",
             "'%s' must be a table", VERB_NAMES[verb]);
    else if (verb == REMOVE)
        merge_remove(p, state, table, path, there);
    else if (verb == APPEND)
        insert_all(p, state, (lua_Integer)lua_rawlen(L, state) + 1, path, there);
    else
        merge_by_id(p, verb, state, table, path, there);
    lua_settop(L, table - 1);
}

static void state_key(const Patch *p, int base, const char *key, const char *path, const char *from,
                      int depth) {
    int verb = 0;
    while (verb < VERBS && strcmp(VERB_NAMES[verb], key) != 0)
        verb++;
    if (verb < VERBS)
        merge_verb(p, (Verb)verb, base, path, from);
    else
        merge_key(p, base, key, path, from, merge_plain, depth);
}

static void merge_state(const Patch *p, int base, int change, const char *path, const char *from,
                        int depth) {
    if (lua_rawlen(p->script->vm.L, change) > 0)
        fail(p, from, "bad-patch",
             "Say where: insert_before = { ID = {...} }, insert_after, replace, change, append, "
             "or remove = { \"ID\" }",
             "%s: transitions of a patch need a place", path);
    name_transitions(p, base, path);
    merge_keys(p, base, change, path, from, depth, state_key, true);
}

/* Reports a patch of a state that is not there, where it is one and not a new state: it has verbs.
   The value is on top of the stack. */
static bool changes_nothing(const Patch *p, int base, const char *key, const char *from) {
    lua_State *L = p->script->vm.L;
    int value = lua_gettop(L);
    bool verbs = false;
    for (int v = 0; lua_type(L, value) == LUA_TTABLE && v < VERBS; v++) {
        verbs |= jox_read_field(L, value, VERB_NAMES[v]) != LUA_TNIL;
        lua_pop(L, 1);
    }
    bool there = jox_read_field(L, base, key) != LUA_TNIL;
    lua_pop(L, 1);
    if (there || !verbs)
        return false;
    const char *names[64];
    char whole[256], hint[96];
    size_t count = 0;
    lua_pushnil(L);
    while (lua_next(L, base)) {
        lua_pop(L, 1);
        if (lua_type(L, -1) == LUA_TSTRING && count < 64)
            names[count++] = jox_vm_intern(&p->script->vm, lua_tostring(L, -1));
    }
    jox_read_join(whole, from, key);
    fail(p, whole, "unknown-state", jox_did_you_mean(key, names, count, hint),
         "there is no state '%s' to change", key);
    return true;
}

static void states_key(const Patch *p, int base, const char *key, const char *path,
                       const char *from, int depth) {
    if (!changes_nothing(p, base, key, from))
        merge_key(p, base, key, path, from, merge_state, depth);
}

static void merge_states(const Patch *p, int base, int change, const char *path, const char *from,
                         int depth) {
    merge_keys(p, base, change, path, from, depth, states_key, false);
}

static void machine_key(const Patch *p, int base, const char *key, const char *path,
                        const char *from, int depth) {
    merge_key(p, base, key, path, from, strcmp(key, "states") ? merge_plain : merge_states, depth);
}

/* ---- a mod's file ---- */

bool jox_lua_patch_target(const char *text, size_t length, char target[128], bool *replaces,
                          int *line, int *column) {
    JoxSource source = {.text = jox_strndup(text, length), .length = length};
    bool found = false;
    jox_source_scan(&source);
    for (size_t i = 0; i + 1 < source.token_count && !found; i++) {
        const JoxToken *t = &source.tokens[i];
        bool patch = jox_token_is(t, "patch"), replace = jox_token_is(t, "replace");
        size_t at = i + 1 + jox_token_is(t + 1, "(");
        if ((!patch && !replace) || at >= source.token_count ||
            source.tokens[at].kind != JOX_TOKEN_STRING)
            continue;
        snprintf(target, 128, "%.*s", (int)source.tokens[at].length, source.tokens[at].text);
        *replaces = replace;
        *line = source.tokens[at].line;
        *column = source.tokens[at].column;
        found = true;
    }
    jox_source_free(&source);
    return found;
}

/* Whether a patch's target is the machine whose table is at `index`: by its name, by its file's, or
   by "mod:file" for one of a mod. */
static bool is_target(JoxScript *script, int index, const char *target) {
    lua_State *L = script->vm.L;
    const char *path = script->vm.sources[0]->path, *stem = jox_path_name(path);
    size_t n = jox_path_stem(stem);
    bool is =
        jox_read_field(L, index, "name") == LUA_TSTRING && !strcmp(lua_tostring(L, -1), target);
    lua_pop(L, 1);
    for (uint32_t m = 0; m < script->scope->mod_count; m++) {
        const JoxMod *mod = &script->scope->mods[m];
        size_t name = strlen(mod->name);
        if (jox_path_below(path, mod->folder)) /* "mod:file" alone */
            return strncmp(target, mod->name, name) == 0 && target[name] == ':' &&
                   strncmp(target + name + 1, stem, n) == 0 && !target[name + 1 + n];
    }
    return is || (strncmp(target, stem, n) == 0 && !target[n]);
}

/* Runs one file of a mod; its patch is left on the stack. NULL with diagnostics. */
static JoxNode *run_file(JoxScript *script, int32_t mod, const JoxModPatch *patch,
                         uint32_t *number) {
    lua_State *L = script->vm.L;
    *number = (uint32_t)script->vm.source_count;
    jox_vm_tried(&script->vm, patch->path);
    if (!jox_script_read(script, patch->path, NULL, 0, (JoxPosition){0}))
        return NULL;
    script->mod = &script->scope->mods[mod];
    if (!jox_vm_compile(&script->vm, *number))
        lua_error(L);
    lua_call(L, 0, 1);
    script->mod = NULL;
    JoxNode *node = jox_node_get(L, -1);
    if (node && (node->kind == JOX_NODE_PATCH || node->kind == JOX_NODE_REPLACE))
        return node;
    if (!node || node->kind != JOX_NODE_ERROR)
        jox_diag_error(script->diagnostics, ((JoxPosition){patch->path, 0, 0, 0}), "no-patch",
                       "End the file with: return patch \"NAME\" { ... }",
                       "this file must return one patch or replacement");
    return NULL;
}

bool jox_patch_apply(JoxScript *script) {
    lua_State *L = script->vm.L;
    JoxNode *machine = jox_node_get(L, -1);
    const JoxScope *scope = script->scope;
    if (!machine || machine->kind != JOX_NODE_MACHINE || scope->mod_count == 0)
        return true;
    size_t errors = script->diagnostics->errors;
    int top = lua_gettop(L);
    lua_rawgeti(L, LUA_REGISTRYINDEX, machine->hook);
    int table = lua_gettop(L);
    for (uint32_t m = 0; m < scope->mod_count; m++)
        for (uint32_t f = 0; f < scope->mods[m].patch_count; f++) {
            const JoxModPatch *patch = &scope->mods[m].patches[f];
            Patch p = {script, 0, (int32_t)m};
            if (!patch->lua || !patch->target || !is_target(script, table, patch->target))
                continue;
            JoxNode *node = run_file(script, (int32_t)m, patch, &p.source);
            if (node) {
                lua_rawgeti(L, LUA_REGISTRYINDEX, node->hook);
                if (node->kind == JOX_NODE_REPLACE) {
                    set_origin(&p, "", "", false);
                    lua_replace(L, table);
                } else {
                    push_copy(L, table);
                    lua_insert(L, -2);
                    merge_keys(&p, lua_gettop(L) - 1, lua_gettop(L), "", "", 0, machine_key, false);
                    lua_pop(L, 1);
                    lua_replace(L, table);
                }
            }
            lua_settop(L, table);
        }
    lua_rawseti(L, LUA_REGISTRYINDEX, machine->hook);
    lua_settop(L, top);
    return script->diagnostics->errors == errors;
}
