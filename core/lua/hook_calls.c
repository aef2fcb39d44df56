/* Calls plain functions of behaviours, for one agent at a time on the stepping thread, with the
   functions of mods that extend them; measures their time. The machines of a run call it through
   JoxMachineRun.call. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/clock.h"
#include "lua/language/script.h"
#include "lua/loader.h"
#include "lua/read_table.h"

/* The first calls of a function are timed; of later ones, one in so many. */
enum { TIMED = JOX_HOOK_TIMED, TIMED_BITS = 6, TIMED_ONE_IN = 1 << TIMED_BITS };

/* Fibonacci hashing times one number in 64, spread evenly over every remainder. Timing each 64th
   call would always hit the same agent if 64 agents are in a state. */
bool jox_lua_is_timed(uint64_t call) {
    return call < TIMED || call * UINT64_C(0x9e3779b97f4a7c15) >> (64 - TIMED_BITS) == 0;
}

/* Returns the time since `begun`, s, without that of reading the clock, which takes longer than a
   short function. */
static double get_time_since(const JoxLua *lua, double begun) {
    const double took = jox_clock_thread() - begun - lua->clock_cost;
    return took > 0.0 ? took : 0.0;
}

/* Reads the result of `when` or `steer`; returns NULL, or what is wrong with it. */
static const char *read_result(lua_State *L, JoxHookKind kind, double result[2]) {
    if (kind == JOX_HOOK_WHEN) {
        if (lua_type(L, -2) != LUA_TBOOLEAN && lua_type(L, -2) != LUA_TNIL)
            return "a `when` function must return true or false";
        result[0] = lua_toboolean(L, -2);
    } else if (kind == JOX_HOOK_STEER) {
        if (lua_type(L, -2) != LUA_TNUMBER || lua_type(L, -1) != LUA_TNUMBER)
            return "a `steer` function must return two numbers, the velocity in m/s";
        result[0] = lua_tonumber(L, -2);
        result[1] = lua_tonumber(L, -1);
        if (!(fabs(result[0]) <= 100.0 && fabs(result[1]) <= 100.0))
            return "a `steer` function must return a velocity of at most 100 m/s";
    }
    return NULL;
}

/* Returns the line of a function that failed as a whole, not at one of its lines. */
static int find_function_line(JoxScript *script, const lua_Debug *where) {
    const int source = jox_vm_source(&script->vm, where->short_src);
    script->vm.failed_source = source > 0 ? (size_t)source : 0;
    script->vm.traceback[0] = 0;
    return where->linedefined;
}

/* Returns what is wrong with the results on top of the stack of a hook, or NULL; else stores them.
   What runs before or after another function leaves its result alone. */
static const char *take_results(lua_State *L, const JoxHook *hook, JoxHookKind kind,
                                double result[2]) {
    const bool asked = kind == JOX_HOOK_WHEN || kind == JOX_HOOK_STEER;
    if (hook->layer != JOX_LAYER_BEFORE && hook->layer != JOX_LAYER_AFTER)
        return read_result(L, kind, result);
    return asked && !lua_isnil(L, -2) ? "what runs before or afterwards returns nothing here: the "
                                        "result is changed by `around`"
                                      : NULL;
}

/* ---- functions within one that extends them by `around` ---- */

static void run_within(lua_State *L, JoxScript *script, int32_t number, double result[2]);

/* Stores the result of what the lowest function of mods extends, which is none itself: a compiled
   condition or steering, or nothing. */
static void read_extended(const JoxScript *script, const JoxHook *hook, double result[2]) {
    const JoxMachineRun *machines = script->owner->machines;
    const JoxAgents *a = machines->agents;
    if (script->kind == JOX_HOOK_WHEN)
        result[0] = hook->expression < 0
                        ? 1.0
                        : jox_machines_expression(machines, script->machine, hook->expression,
                                                  script->agent) != 0.0;
    result[0] =
        script->kind == JOX_HOOK_STEER && hook->steers ? a->pref_x[script->agent] : result[0];
    result[1] =
        script->kind == JOX_HOOK_STEER && hook->steers ? a->pref_y[script->agent] : result[1];
}

/* Calls a hook within the function that runs; errors of it are errors of that. */
static void call_within(lua_State *L, JoxScript *script, int32_t number, double result[2]) {
    JoxHook *hook = &script->hooks[number];
    const int32_t outer = script->running;
    const double nested = script->nested;
    const bool counted = hook->calls >= TIMED && jox_lua_is_timed(hook->calls),
               first = hook->calls < TIMED, timed = first || counted || script->measured;
    const double begun = timed ? jox_clock_thread() : 0.0;
    hook->calls++;
    script->running = number;
    script->nested = 0.0;
    luaL_checkstack(L, 8, "functions of mods");
    lua_rawgeti(L, LUA_REGISTRYINDEX, hook->ref);
    lua_rawgeti(L, LUA_REGISTRYINDEX, script->me);
    if (hook->layer == JOX_LAYER_AROUND)
        lua_rawgeti(L, LUA_REGISTRYINDEX, hook->previous_ref);
    lua_call(L, 1 + (hook->layer == JOX_LAYER_AROUND), 2);
    const char *why = take_results(L, hook, script->kind, result);
    if (why)
        luaL_error(L, "%s", why);
    lua_pop(L, 2);
    const double took = timed ? get_time_since(script->owner, begun) : 0.0;
    if (first || counted)
        *(first ? &hook->first : &hook->seconds) += took - script->nested;
    hook->timed += counted;
    script->nested = nested + took + (timed ? 2.0 * script->owner->clock_cost : 0.0);
    script->running = outer;
}

/* Runs what a hook extends. */
static void run_extended(lua_State *L, JoxScript *script, const JoxHook *hook, double result[2]) {
    if (hook->previous < 0)
        read_extended(script, hook, result);
    else
        run_within(L, script, hook->previous, result);
}

/* Runs a hook and what it extends, within the function that runs. */
static void run_within(lua_State *L, JoxScript *script, int32_t number, double result[2]) {
    const JoxHook *hook = &script->hooks[number];
    double unused[2];
    if (hook->layer == JOX_LAYER_BEFORE && !hook->suspended)
        call_within(L, script, number, unused);
    if (hook->layer == JOX_LAYER_BEFORE || hook->layer == JOX_LAYER_AFTER ||
        (hook->layer == JOX_LAYER_AROUND && hook->suspended))
        run_extended(L, script, hook, result);
    else if (!hook->suspended)
        call_within(L, script, number, result);
    if (hook->layer == JOX_LAYER_AFTER && !hook->suspended)
        call_within(L, script, number, unused);
}

/* previous(me): what a function that extends by `around` is passed. */
static int call_previous(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    const int32_t number = (int32_t)lua_tointeger(L, lua_upvalueindex(1));
    double result[2] = {0.0, 0.0};
    if (script->vm.loading || !script->owner->machines)
        return luaL_error(L, "the former function runs for an agent only");
    lua_rawgeti(L, LUA_REGISTRYINDEX, script->me);
    if (lua_gettop(L) != 2 || !lua_rawequal(L, 1, 2))
        return luaL_error(L, "the former function takes `me`: write previous(me)");
    run_extended(L, script, &script->hooks[number], result);
    if (script->kind == JOX_HOOK_WHEN)
        lua_pushboolean(L, result[0] != 0.0);
    else if (script->kind == JOX_HOOK_STEER)
        lua_pushnumber(L, result[0]), lua_pushnumber(L, result[1]);
    return script->kind == JOX_HOOK_WHEN ? 1 : script->kind == JOX_HOOK_STEER ? 2 : 0;
}

int jox_hook_make_previous(JoxScript *script, int32_t number) {
    lua_pushinteger(script->vm.L, number);
    lua_pushcclosure(script->vm.L, call_previous, 1);
    return luaL_ref(script->vm.L, LUA_REGISTRYINDEX);
}

/* ---- calls ---- */

/* Returns whether the place of a failure is within a function's own lines. */
static bool failed_within(JoxScript *script, const JoxHook *hook, int line) {
    lua_Debug where;
    lua_rawgeti(script->vm.L, LUA_REGISTRYINDEX, hook->ref);
    lua_getinfo(script->vm.L, ">S", &where);
    return jox_vm_source(&script->vm, where.short_src) == (int)script->vm.failed_source &&
           line >= where.linedefined && line <= where.lastlinedefined;
}

/* Sets the variables that one function shares with the code around it back; returns whether one had
   changed. Most files assign none, which their syntax tree shows. */
static bool restore_shared(JoxScript *script, const JoxHook *hook, char name[64],
                           lua_Debug *where) {
    const JoxUpvalues *all = &script->upvalues;
    lua_State *L = script->vm.L;
    if (hook->may_assign)
        return jox_upvalues_restore(L, all, hook->first_upvalue, hook->upvalue_count, name, where);
    JOX_ASSERT(
        !jox_upvalues_restore(L, all, hook->first_upvalue, hook->upvalue_count, name, where));
    return false;
}

/* Sets back what a hook, and those that it may have called, changed outside of themselves; returns
   the last one that did and the complaint, or NULL. */
static JoxHook *restore_upvalues(JoxScript *script, JoxHook *hook, char changed[200], int *line) {
    JoxHook *culprit = NULL;
    char name[64];
    lua_Debug where;
    for (JoxHook *h = hook; h;) {
        if (restore_shared(script, h, name, &where)) {
            *line = find_function_line(script, &where);
            snprintf(changed, 200,
                     "a function changed '%s', a variable from outside of it, and it was set back: "
                     "what an agent remembers belongs in memory",
                     name);
            culprit = h;
        }
        const bool calls = hook->layer == JOX_LAYER_AROUND && h->previous >= 0;
        h = calls ? &script->hooks[h->previous] : NULL;
    }
    return culprit;
}

/* Calls the function of one hook, with all that it may call, as a protected call; false if it
   failed, which is reported. */
static bool call_function(JoxLua *lua, JoxScript *script, int32_t number, double result[2]) {
    JoxHook *hook = &script->hooks[number], *failed = NULL;
    lua_State *L = script->vm.L;
    const bool first = hook->calls < TIMED, timed = jox_lua_is_timed(hook->calls),
               around = hook->layer == JOX_LAYER_AROUND;
    const double begun = timed ? jox_clock_thread() : 0.0;
    hook->calls++;
    script->running = number;
    script->nested = 0.0;
    script->measured = timed;
    jox_me_begin(script);
    jox_vm_push_handler(&script->vm);
    lua_rawgeti(L, LUA_REGISTRYINDEX, hook->ref);
    lua_rawgeti(L, LUA_REGISTRYINDEX, script->me);
    if (around)
        lua_rawgeti(L, LUA_REGISTRYINDEX, hook->previous_ref);
    const char *why = NULL;
    int line = 0;
    if (jox_vm_call_handled(&script->vm, 1 + around, 2, lua->group.limits.hook_instructions, &why,
                            &line)) {
        why = take_results(L, hook, script->kind, result);
        if (why) {
            lua_Debug where;
            lua_rawgeti(L, LUA_REGISTRYINDEX, hook->ref);
            lua_getinfo(L, ">S", &where);
            line = find_function_line(script, &where);
            failed = hook;
        }
        lua_settop(L, 0);
    } else { /* the innermost one failed, unless the outer one caught that and failed itself */
        failed = failed_within(script, hook, line) ? hook : &script->hooks[script->running];
    }
    char changed[200];
    JoxHook *changes = restore_upvalues(script, hook, changed, &line);
    if (changes) {
        failed = changes;
        why = changed;
    }
    if (timed) {
        const double took = get_time_since(lua, begun);
        *(first ? &hook->first : &hook->seconds) += took - script->nested;
        hook->timed += !first;
        lua->arriving += lua->machines->spawning ? (first ? 1.0 : TIMED_ONE_IN) * took : 0.0;
    }
    if (failed)
        jox_hook_report_failure(lua, script, failed, why, line);
    return !failed;
}

/* Runs a hook and what it extends, each in a call of its own as far as they do not call each
   other, so that one that fails leaves the others alone. */
static bool run_hook(JoxLua *lua, JoxScript *script, int32_t number, double result[2]) {
    const JoxHook *hook = &script->hooks[number];
    const JoxLayer layer = hook->layer;
    double unused[2];
    if (layer == JOX_LAYER_ALONE || (layer == JOX_LAYER_AROUND && !hook->suspended))
        return !hook->suspended && call_function(lua, script, number, result);
    if (layer == JOX_LAYER_BEFORE && !hook->suspended)
        call_function(lua, script, number, unused);
    bool good = true;
    if (hook->previous >= 0)
        good = run_hook(lua, script, hook->previous, result);
    else
        read_extended(script, hook, result);
    if (layer == JOX_LAYER_AFTER && !hook->suspended)
        call_function(lua, script, number, unused);
    return good;
}

bool jox_lua_call(void *context, const JoxMachine *machine, int32_t number, JoxHookKind kind,
                  uint32_t agent, double result[2]) {
    JoxLua *lua = context;
    JoxScript *script = machine->vm >= 0 ? lua->scripts[machine->vm] : NULL;
    if (!script || (uint32_t)number >= script->hook_count)
        return false;
    script->machine = machine;
    script->agent = agent;
    script->kind = kind;
    script->draws = script->read_count = 0;
    return run_hook(lua, script, number, result);
}
