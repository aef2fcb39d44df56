/* Words with a syntax of their own: distributions, orbits, memory, now, own, settings, the
   machine's table and the patches of mods. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/language/vocabulary.h"

/* orbit(place [, { inward, density_near, density_far, far, beyond }]) */
static int make_orbit(lua_State *L) {
    jox_word_call_place(L, "orbit");
    JoxNode *place = jox_word_argument(L, "orbit", 1, 'p');
    if (!place)
        return 1;
    JoxNode *node = jox_node_push(L, JOX_NODE_STEER);
    node->term.kind = JOX_STEER_ORBIT;
    node->target = place;
    const JoxWordNumber *number;
    for (uint32_t k = 0; (number = jox_word_number("orbit", k)); k++)
        node->term.args[k] = number->standard;
    if (lua_isnoneornil(L, 2) || lua_type(L, 2) != LUA_TTABLE)
        return 1;
    lua_pushnil(L);
    while (lua_next(L, 2)) {
        const char *key = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "?";
        int found = -1;
        for (uint32_t k = 0; (number = jox_word_number("orbit", k)); k++)
            found = strcmp(number->name, key) == 0 ? (int)k : found;
        if (found < 0 || lua_type(L, -1) != LUA_TNUMBER)
            return jox_word_error(L, key, "bad-argument",
                                  "orbit takes inward, density_near, density_far, far and beyond",
                                  "bad option '%s' of orbit", key);
        number = jox_word_number("orbit", (uint32_t)found);
        double value = lua_tonumber(L, -1);
        if (!(value >= number->least && value <= number->greatest))
            return jox_word_error(
                L, key, "out-of-range", NULL, "%s of orbit must be from %g to %g%s%s, not %g", key,
                number->least, number->greatest, *number->unit ? " " : "", number->unit, value);
        node->term.args[found] = value;
        lua_pop(L, 1);
    }
    lua_pushvalue(L, -1);
    return 1;
}

/* normal(mean, deviation [, least, greatest]), uniform(a, b) and the like. */
static int make_dist(lua_State *L) {
    const JoxWord *word = lua_touserdata(L, lua_upvalueindex(1));
    const JoxDistKind kind = (JoxDistKind)word->op;
    const int count = lua_gettop(L);
    JOX_ASSERT(word->makes == JOX_NODE_DIST);
    jox_word_call_place(L, word->name);
    double v[JOX_DIST_CHOICES];
    for (int i = 0; i < count && i < JOX_DIST_CHOICES; i++) {
        if (lua_type(L, i + 1) != LUA_TNUMBER || !(fabs(lua_tonumber(L, i + 1)) < 1e9))
            return jox_word_error(L, word->name, "bad-argument", NULL,
                                  "argument %d of %s must be a plain number", i + 1, word->name);
        v[i] = lua_tonumber(L, i + 1);
    }
    JoxDist dist;
    if (!jox_dist_make(kind, v, count, &dist))
        return jox_word_error(L, word->name, "bad-argument", jox_dist_usage,
                              "wrong arguments of %s", word->name);
    jox_node_push(L, JOX_NODE_DIST)->dist = dist;
    return 1;
}

static int make_machine(lua_State *L) {
    const JoxNamePlace written = jox_word_call_place(L, "machine");
    if (lua_type(L, 1) != LUA_TTABLE)
        return jox_word_error(L, "machine", "bad-argument",
                              "machine { name = ..., states = { ... } }", "machine takes a table");
    JoxNode *node = jox_node_push(L, JOX_NODE_MACHINE);
    node->written = written;
    lua_pushvalue(L, 1);
    node->hook = luaL_ref(L, LUA_REGISTRYINDEX);
    return 1;
}

static const JoxMemorySlot *find_memory(const JoxScript *script, const char *name) {
    for (uint32_t m = 0; m < script->memory_count; m++)
        if (strcmp(script->memory[m].name, name) == 0)
            return &script->memory[m];
    return NULL;
}

/* list(capacity [, nobody]): memory that begins as an empty list of numbers, or of somebody. */
static int make_list(lua_State *L) {
    jox_word_call_place(L, "list");
    const JoxNode *of = jox_node_get(L, 2);
    const bool people = of && of->kind == JOX_NODE_TARGET && of->target_kind == JOX_TARGET_NOBODY;
    const double capacity = lua_type(L, 1) == LUA_TNUMBER ? lua_tonumber(L, 1) : 0.0;
    if (!(capacity >= 1.0 && capacity <= JOX_MOST_ITEMS && capacity == floor(capacity)) ||
        (!people && !lua_isnoneornil(L, 2)))
        return jox_word_error(
            L, "list", "bad-argument", "list(8) is a list of numbers, list(8, nobody) of people",
            "list takes a length from 1 to %d, and `nobody` if it holds people", JOX_MOST_ITEMS);
    JoxNode *node = jox_node_push(L, JOX_NODE_LIST);
    node->arg = (int)capacity;
    node->target_kind = people ? JOX_TARGET_NOBODY : JOX_TARGET_PLACE;
    return 1;
}

/* Returns the kind of memory that begins as the value on top of the stack; -1 if none does. */
static int read_memory_kind(lua_State *L) {
    const JoxNode *node = jox_node_get(L, -1);
    if (node && node->kind == JOX_NODE_LIST && !node->name)
        return node->target_kind == JOX_TARGET_NOBODY ? JOX_MEMORY_PEOPLE : JOX_MEMORY_LIST;
    if (lua_type(L, -1) == LUA_TNUMBER)
        return JOX_MEMORY_NUMBER;
    if (lua_type(L, -1) == LUA_TBOOLEAN)
        return JOX_MEMORY_BOOLEAN;
    return node && node->kind == JOX_NODE_TARGET && node->target_kind == JOX_TARGET_NOBODY
               ? JOX_MEMORY_SOMEBODY
               : -1;
}

/* memory { laps = 0, touched = false }: declares what each agent remembers. */
static int make_memory(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    jox_word_call_place(L, "memory");
    if (!script->vm.loading || lua_type(L, 1) != LUA_TTABLE)
        return jox_word_error(L, "memory", "bad-argument", "memory { laps = 0, touched = false }",
                              "memory takes a table");
    lua_pushnil(L);
    while (lua_next(L, 1)) {
        const char *name = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "?";
        const bool wrong = jox_node_is_error(L, -1); /* told where it was made */
        const int kind = wrong ? JOX_MEMORY_NUMBER : read_memory_kind(L);
        if (lua_type(L, -2) != LUA_TSTRING || kind < 0 || script->memory_count >= JOX_MOST_SET)
            return jox_word_error(L, name, "bad-memory",
                                  "Numbers, true or false, `nobody` and list(8) can be remembered",
                                  "memory '%s' cannot be %s%s", name,
                                  jox_node_get(L, -1) ? "" : "a ", jox_node_kind(L, -1));
        JOX_RESERVE(script->memory, script->memory_capacity, script->memory_count + 1);
        double value = wrong                        ? 0.0
                       : kind == JOX_MEMORY_NUMBER  ? lua_tonumber(L, -1)
                       : kind == JOX_MEMORY_BOOLEAN ? lua_toboolean(L, -1)
                                                    : JOX_NOBODY;
        const JoxMemorySlot *known = find_memory(script, name);
        const uint32_t capacity = kind == JOX_MEMORY_LIST || kind == JOX_MEMORY_PEOPLE
                                      ? (uint32_t)jox_node_get(L, -1)->arg
                                      : 0;
        if (known && known->initial == value && known->kind == (JoxMemoryKind)kind &&
            known->capacity == capacity) {
            lua_pop(L, 1); /* another file declares it too */
            continue;
        }
        if (known)
            return jox_word_error(L, name, "bad-memory", "Give one of them another name",
                                  "memory '%s' is declared before, and begins otherwise there",
                                  name);
        if (!isfinite(value))
            return jox_word_error(L, name, "bad-memory", NULL,
                                  "memory '%s' must begin with a finite number", name);
        JoxMemorySlot slot = {.name = jox_strdup(name),
                              .kind = (JoxMemoryKind)kind,
                              .capacity = capacity,
                              .dormant = wrong,
                              .initial = value};
        uint32_t at =
            script->memory_count++; /* inserted in order of names, as tables have no order */
        for (; at > 0 && strcmp(script->memory[at - 1].name, name) > 0; at--) {
            script->memory[at] = script->memory[at - 1];
            script->memory_at[at] = script->memory_at[at - 1];
        }
        script->memory[at] = slot;
        script->memory_at[at] = jox_word_position(L, name);
        lua_pop(L, 1);
    }
    luaL_getmetatable(L, "jostle memory");
    lua_newuserdatauv(L, 1, 0);
    lua_insert(L, -2);
    lua_setmetatable(L, -2);
    return 1;
}

/* __index of what memory{} returns: the expression of a name. */
static int memory_index(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
    const char *names[64];
    for (uint32_t i = 0; i < script->memory_count; i++) {
        names[i] = script->memory[i].name;
        if (strcmp(script->memory[i].name, name) == 0) {
            if (script->memory[i].dormant) /* its first value is wrong */
                return jox_node_push_error(L);
            static const JoxNodeKind KINDS[] = {[JOX_MEMORY_NUMBER] = JOX_NODE_NUMBER,
                                                [JOX_MEMORY_BOOLEAN] = JOX_NODE_CONDITION,
                                                [JOX_MEMORY_SOMEBODY] = JOX_NODE_TARGET,
                                                [JOX_MEMORY_LIST] = JOX_NODE_LIST,
                                                [JOX_MEMORY_PEOPLE] = JOX_NODE_LIST};
            JoxNode *node = jox_node_push(L, KINDS[script->memory[i].kind]);
            node->op = JOX_OP_MEMORY;
            node->target_kind = script->memory[i].kind == JOX_MEMORY_PEOPLE ? JOX_TARGET_NOBODY
                                : script->memory[i].kind == JOX_MEMORY_LIST ? JOX_TARGET_PLACE
                                                                            : JOX_TARGET_MEMORY;
            if (node->kind == JOX_NODE_LIST)
                node->op = JOX_LIST_NONE;
            node->name = jox_vm_intern(&script->vm, name);
            return 1;
        }
    }
    char hint[JOX_HINT], declare[160];
    const char *near = jox_did_you_mean(name, names, script->memory_count, hint);
    snprintf(declare, sizeof declare,
             "Declare it: memory { %.40s = 0 }. What was drawn once for the agent is own.%.40s",
             name, name);
    return jox_word_error(L, name, "unknown-memory", near ? near : declare, "memory has no '%s'",
                          name);
}

/* __index of `now`. */
static int now_index(lua_State *L) {
    static const char *const NAMES[] = {
#define X(name, ...) #name,
        JOX_MEASURED(X)
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
    char hint[JOX_HINT];
    return jox_word_error(L, name, "unknown-word",
                          jox_did_you_mean(name, NAMES, JOX_NOW_COUNT, hint),
                          "nothing called '%s' is measured now", name);
}

/* __index of `own`. */
static int own_index(lua_State *L) {
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
    JoxNode *node = jox_node_push(L, JOX_NODE_OWN);
    node->op = JOX_OP_OWN;
    node->name = jox_vm_intern(jox_vm_of(L), name);
    node->written = jox_word_place(L, name);
    node->position = node->written.at;
    return 1;
}

/* Makes machine { ... } and the changes of mods: patch "name" { ... }, replace "name" { ... }. */
static int make_change(lua_State *L) {
    JoxNodeKind kind = (JoxNodeKind)lua_tointeger(L, lua_upvalueindex(1));
    const char *verb = kind == JOX_NODE_PATCH ? "patch" : "replace";
    if (lua_type(L, 1) != LUA_TTABLE)
        return jox_word_error(L, verb, "bad-argument",
                              "Example: patch \"tawaf\" { states = { ... } }",
                              "%s takes a name and a table", verb);
    JoxNode *node = jox_node_push(L, kind);
    node->name = jox_vm_intern(jox_vm_of(L), lua_tostring(L, lua_upvalueindex(2)));
    lua_pushvalue(L, 1);
    node->hook = luaL_ref(L, LUA_REGISTRYINDEX);
    return 1;
}

/* patch "name" and replace "name": returns the function that takes the table. */
static int make_verb(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    JoxNodeKind kind = (JoxNodeKind)lua_tointeger(L, lua_upvalueindex(1));
    const char *verb = kind == JOX_NODE_PATCH ? "patch" : "replace";
    if (!script->mod)
        return jox_word_error(L, verb, "not-a-mod", "Put it into the patches/ of a mod",
                              "'%s' works in mods only", verb);
    if (lua_type(L, 1) != LUA_TSTRING)
        return jox_word_error(L, verb, "bad-argument",
                              "Example: patch \"tawaf\" { states = { ... } }",
                              "%s takes the name of a behaviour first", verb);
    lua_pushinteger(L, kind);
    lua_pushvalue(L, 1);
    lua_pushcclosure(L, make_change, 2);
    return 1;
}

/* __index of `settings`: a number, boolean or text of the mod. */
static int settings_index(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?", *names[64];
    size_t count = 0;
    if (!script->mod)
        return jox_word_error(L, name, "not-a-mod", NULL, "only mods have settings");
    for (uint32_t s = 0; s < script->mod->setting_count && count < 64; s++) {
        names[count++] = script->mod->settings[s].name;
        if (strcmp(script->mod->settings[s].name, name) == 0) {
            const JoxModSetting *setting = &script->mod->settings[s];
            if (setting->kind == JOX_SETTING_NUMBER)
                lua_pushnumber(L, setting->value);
            else if (setting->kind == JOX_SETTING_BOOL)
                lua_pushboolean(L, setting->value != 0.0);
            else
                lua_pushstring(L, jox_setting_text(setting, setting->value));
            return 1;
        }
    }
    char hint[JOX_HINT];
    return jox_word_error(L, name, "unknown-setting", jox_did_you_mean(name, names, count, hint),
                          "mod %s has no setting '%s'", script->mod->name, name);
}

/* Registers a type with `index` as its __index; adds an object of it under `name`, if given. */
static void add_object(lua_State *L, const char *name, const char *type, lua_CFunction index) {
    luaL_newmetatable(L, type);
    lua_pushcfunction(L, index);
    lua_setfield(L, -2, "__index");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_pop(L, 1);
    if (!name)
        return;
    lua_newuserdatauv(L, 1, 0);
    luaL_setmetatable(L, type);
    lua_setfield(L, -2, name);
}

void jox_values_add(lua_State *L) {
    JOX_ASSERT(lua_istable(L, -1));
    static const luaL_Reg MAKERS[] = {{"orbit", make_orbit},
                                      {"machine", make_machine},
                                      {"memory", make_memory},
                                      {"list", make_list},
                                      {NULL, NULL}};
    luaL_setfuncs(L, MAKERS, 0);
    jox_sequence_add(L);
    for (size_t i = 0; i < jox_word_count; i++)
        if (jox_words[i].makes == JOX_NODE_DIST) {
            lua_pushlightuserdata(L, (void *)&jox_words[i]);
            lua_pushcclosure(L, make_dist, 1);
            lua_setfield(L, -2, jox_words[i].name);
        }
    lua_pushinteger(L, JOX_NODE_PATCH);
    lua_pushcclosure(L, make_verb, 1);
    lua_setfield(L, -2, "patch");
    lua_pushinteger(L, JOX_NODE_REPLACE);
    lua_pushcclosure(L, make_verb, 1);
    lua_setfield(L, -2, "replace");
    jox_node_push(L, JOX_NODE_NONE);
    lua_setfield(L, -2, "none");
    jox_node_push(L, JOX_NODE_BACK);
    lua_setfield(L, -2, "back");
    add_object(L, NULL, "jostle memory", memory_index);
    add_object(L, "now", "jostle now", now_index);
    add_object(L, "own", "jostle own", own_index);
    add_object(L, "settings", "jostle settings", settings_index);
}
