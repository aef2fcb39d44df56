/* Names that scripts can use besides Lua's own functions: words, `require`, random numbers of the
   agent. For any other name it suggests the one that was meant. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "lua/language/script.h"

/* Returns why a name of Lua's own libraries is missing; NULL for any other name. */
static const char *explain_absent_name(const char *name) {
    static const struct {
        const char *name, *why;
    } ABSENT[] = {
        {"io", "Behaviours have no files"},
        {"os", "Behaviours have no clock and no files; me.time is the simulated time"},
        {"debug", "Behaviours cannot look into the engine"},
        {"package", "require \"name\" loads a file beside this one"},
        {"coroutine", "A state of the machine is what a coroutine would remember"},
        {"loadstring", "Code is not made from texts"},
        {"loadfile", "require \"name\" loads a file beside this one"},
        {"dofile", "require \"name\" loads a file beside this one"},
        {"setmetatable", "Tables have no metatables here"},
        {"getmetatable", "Tables have no metatables here"},
        {"rawget", "Tables have no metatables here: t[key] is raw"},
        {"rawset", "Tables have no metatables here: t[key] = value is raw"},
        {"rawequal", "Tables have no metatables here: == is raw"},
        {"rawlen", "Tables have no metatables here: # is raw"},
        {"collectgarbage", "Memory is looked after by the engine"},
        {"xpcall", "pcall catches errors"},
        {"_G", "There are no globals; what an agent remembers belongs in memory"},
        {"utf8", "string.byte and string.char work on bytes"},
    };
    for (size_t i = 0; i < sizeof ABSENT / sizeof *ABSENT; i++)
        if (strcmp(ABSENT[i].name, name) == 0)
            return ABSENT[i].why;
    return NULL;
}

/* Returns what to write for a name that exists behind a dot or a colon alone; NULL for any other
   name. */
static const char *explain_member_name(const char *name) {
    static const char LIST[] = "It belongs to a list: set = { met = mine.met:push(value) }, "
                               ":remove(value), :clear()";
    static const struct {
        const char *name, *why;
    } MEMBERS[] = {
        {"sender", "It belongs to a message: local shot = told \"shot\", then shot.sender"},
        {"push", LIST},
        {"remove", LIST},
        {"clear", LIST},
        {"contains", "It belongs to a list: mine.met:contains(value)"},
        {"size", "It belongs to a list: mine.met.size"},
        {"where", "It belongs to a target: nearest(\"people\"):where(\"busy\", 0, 0)"},
        {"in_state", "It belongs to a target: nearest(\"people\"):in_state(\"Wait\")"},
    };
    for (size_t i = 0; i < sizeof MEMBERS / sizeof *MEMBERS; i++)
        if (strcmp(MEMBERS[i].name, name) == 0)
            return MEMBERS[i].why;
    return NULL;
}

/* Returns whether a place or tag of the scene has the name. */
static bool is_name_in_scene(const JoxScope *scope, const char *name) {
    for (uint32_t p = 0; p < scope->place_count; p++)
        if (strcmp(scope->places[p].name, name) == 0)
            return true;
    for (uint32_t t = 0; t < scope->tag_count; t++)
        if (strcmp(scope->tags[t], name) == 0)
            return true;
    return false;
}

/* Replaces the word `other` on top of the stack by a copy that keeps its position, as it has a
   meaning in scores alone. */
static void push_placed_target(lua_State *L, JoxPosition at) {
    const JoxNode *node = jox_node_get(L, -1);
    if (!node || node->kind != JOX_NODE_TARGET || node->target_kind != JOX_TARGET_OTHER)
        return;
    JoxNode *copy = jox_node_push(L, JOX_NODE_TARGET);
    *copy = *node;
    copy->position = at;
}

/* __index of the environment: a name that is no local variable. */
static int env_index(lua_State *L) {
    JOX_ASSERT(lua_istable(L, lua_upvalueindex(1)));
    JoxScript *script = jox_script_of(L);
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(1)) != LUA_TNIL)
        return 1;
    if (jox_word_lookup(L, name)) {
        if (script->vm.loading) /* marks this occurrence as used */
            push_placed_target(L, jox_word_position(L, name));
        return 1;
    }
    if (jox_program_word_push(L, name)) {
        if (script->vm.loading)
            jox_word_position(L, name);
        return 1;
    }
    if (!script->vm.loading)
        return luaL_error(L, "unknown name '%s'", name);
    enum { SHORT = 4 }; /* bytes: a short name is near to many */
    const char *names[512];
    size_t count = jox_word_names(names, 256);
    count += jox_program_word_names(script->owner, names + count, 256);
    char hint[JOX_HINT];
    const char *near = jox_did_you_mean(name, names, count, hint);
    if (explain_member_name(name))
        snprintf(hint, sizeof hint, "%s", explain_member_name(name));
    else if (jox_parameter_find(name) >= 0)
        snprintf(hint, sizeof hint,
                 "As a value write own.%s (what was drawn) or now.NAME (what is "
                 "measured)",
                 name);
    else if (explain_absent_name(name))
        snprintf(hint, sizeof hint, "%s", explain_absent_name(name));
    else if ((!near || strlen(name) <= SHORT) && is_name_in_scene(script->scope, name))
        snprintf(hint, sizeof hint, "Names of places, tags and gates stand in quotes: \"%.60s\"",
                 name);
    else if (near && strcmp(name, "ball") == 0) /* a usual tag, and near to `back` */
        snprintf(hint, sizeof hint, "Names of places, tags and gates stand in quotes: \"ball\"");
    else if (!near)
        snprintf(hint, sizeof hint,
                 "Words, locals and names in quotes are all that a behaviour can use. A program "
                 "that has "
                 "more words must register them");
    return jox_word_error(L, name, "unknown-word", hint, "unknown word '%s'", name);
}

/* __newindex of the environment: an assignment to a global. */
static int env_newindex(lua_State *L) {
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
    if (!jox_vm_of(L)->loading)
        return luaL_error(L,
                          "globals cannot be set; what an agent remembers belongs in memory: "
                          "'%s'",
                          name);
    jox_word_error(L, name, "global-assignment", "Write: local NAME = ...",
                   "'%s' would be a global", name);
    return 0;
}

/* Draws from the random stream of the agent, a function of seed, agent and tick. */
static int math_random(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    if (script->vm.loading || !script->owner->machines)
        return luaL_error(L, "math.random works in functions of agents only; at load use normal, "
                             "uniform or choose");
    const JoxMachineRun *machines = script->owner->machines;
    double u = jox_random_unit(machines->seed, machines->agents->id[script->agent], machines->tick,
                               JOX_DRAW_LUA, script->draws++);
    if (lua_gettop(L) == 0) {
        lua_pushnumber(L, u);
        return 1;
    }
    double low = lua_gettop(L) > 1 ? floor(luaL_checknumber(L, 1)) : 1.0;
    double high = floor(luaL_checknumber(L, lua_gettop(L) > 1 ? 2 : 1));
    luaL_argcheck(
        L, fabs(low) <= 9007199254740992.0 && fabs(high) <= 9007199254740992.0 && high - low < 1e15,
        1, "the interval is too large");
    luaL_argcheck(L, high >= low, 1, "the interval is empty");
    lua_pushinteger(L, (lua_Integer)(low + floor(u * (high - low + 1.0))));
    return 1;
}

void jox_environment_open(lua_State *L) {
    static const luaL_Reg BASE[] = {{"require", jox_require}, {NULL, NULL}};
    static const luaL_Reg MATH[] = {{"random", math_random}, {NULL, NULL}};
    jox_sandbox_open(L, &(JoxSandbox){BASE, MATH, env_index, env_newindex});
}
