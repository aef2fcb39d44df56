/* Plain functions of behaviours, called for one agent at a time on the stepping thread. `me` reads
   the agent and writes its memory; it is worth nothing once the call is over. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "lua/internal.h"

static const char ME[] = "jostle me";
enum { MOST_FAILURES = 100 }; /* in a second, before a behaviour's functions are suspended */

void jox_lua_attach(JoxLua *lua, JoxMind *mind, JoxLuaComplain *complain, void *context) {
    lua->mind = mind;
    lua->complain = complain;
    lua->complain_context = context;
}

uint64_t jox_lua_failures(const JoxLua *lua) {
    return lua->failures;
}

/* The agent that `me` stands for; raises an error where it was kept from an earlier call. */
static uint32_t check_me(lua_State *L, JoxVm *vm) {
    const uint32_t *run = luaL_checkudata(L, 1, ME);
    if (vm->loading || *run != vm->run)
        luaL_error(L, "`me` was kept from an earlier call; it is valid during its own only");
    return vm->agent;
}

static int32_t memory_slot(const JoxMachine *m, const char *name) {
    for (uint32_t s = 0; s < m->memory_count; s++)
        if (*name && strcmp(m->memory[s].name, name) == 0)
            return (int32_t)s;
    return -1;
}

static int me_index(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    uint32_t i = check_me(L, vm);
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
    const JoxMind *mind = vm->owner->mind;
    const JoxAgents *a = mind->agents;
    const JoxMachine *m = vm->machine;
    int32_t slot = memory_slot(m, name);
    int parameter = jox_parameter_find(name);
    const struct {
        const char *name;
        double value;
    } numbers[] = {{"id", a->id[i]},
                   {"x", a->x[i]},
                   {"y", a->y[i]},
                   {"vx", a->vx[i]},
                   {"vy", a->vy[i]},
                   {"time", mind->tick * mind->dt},
                   {"time_in_state", (mind->tick - a->entered[i]) * mind->dt},
                   {"density", a->density[i]},
                   {"pushed", sqrt((double)a->force_x[i] * a->force_x[i] +
                                   (double)a->force_y[i] * a->force_y[i])},
                   {"compression", a->compression[i]},
                   {"team", a->team[i]}};
    if (slot >= 0) {
        double value = a->memory[(size_t)i * a->memory_stride + (uint32_t)slot];
        if (m->memory[slot].kind == JOX_MEMORY_BOOLEAN)
            lua_pushboolean(L, value != 0.0);
        else
            lua_pushnumber(L, value);
        return 1;
    }
    for (size_t n = 0; n < sizeof numbers / sizeof *numbers; n++)
        if (strcmp(numbers[n].name, name) == 0) {
            lua_pushnumber(L, numbers[n].value);
            return 1;
        }
    if (strcmp(name, "state") == 0)
        lua_pushstring(L, m->states[a->state[i]].name);
    else if (parameter >= 0)
        lua_pushnumber(L, a->param[parameter][i]);
    else
        return luaL_error(L, "me has no '%s'", name);
    return 1;
}

static int me_newindex(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    uint32_t i = check_me(L, vm);
    const char *name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
    int32_t slot = memory_slot(vm->machine, name);
    if (slot < 0)
        return luaL_error(L, "'%s' is not in memory; only what memory { ... } declares can be set",
                          name);
    double value;
    if (vm->machine->memory[slot].kind == JOX_MEMORY_BOOLEAN) {
        if (lua_type(L, 3) != LUA_TBOOLEAN)
            return luaL_error(L, "memory '%s' is true or false", name);
        value = lua_toboolean(L, 3);
    } else {
        if (lua_type(L, 3) != LUA_TNUMBER || !isfinite(lua_tonumber(L, 3)))
            return luaL_error(L, "memory '%s' is a finite number", name);
        value = lua_tonumber(L, 3);
    }
    const JoxAgents *a = vm->owner->mind->agents;
    a->memory[(size_t)i * a->memory_stride + (uint32_t)slot] = value;
    return 0;
}

void jox_hooks_open(JoxVm *vm) {
    static const luaL_Reg META[] = {
        {"__index", me_index}, {"__newindex", me_newindex}, {NULL, NULL}};
    luaL_newmetatable(vm->L, ME);
    luaL_setfuncs(vm->L, META, 0);
    lua_pushboolean(vm->L, 0);
    lua_setfield(vm->L, -2, "__metatable");
    lua_pop(vm->L, 1);
    uint32_t *run = lua_newuserdatauv(vm->L, sizeof *run, 0);
    *run = 0;
    luaL_setmetatable(vm->L, ME);
    lua_setfield(vm->L, LUA_REGISTRYINDEX, "me"); /* the one object that is handed out */
}

static void say(JoxLua *lua, const char *text) {
    if (lua->complain)
        lua->complain(lua->complain_context, text);
}

/* Says each new failure in full; the same again is counted and said once a second. */
static void report(JoxLua *lua, JoxVm *vm, JoxHookKind kind, const char *why, int line) {
    static const char *const KINDS[] = {"on_enter", "on_exit", "on_take", "when", "steer"};
    const JoxMind *mind = lua->mind;
    char text[1024];
    uint32_t second = (uint32_t)(mind->tick * mind->dt);
    if (second != vm->failures_tick) {
        if (vm->repeated > 0) {
            snprintf(text, sizeof text, "%s: ... and %llu times more\n", vm->machine->path,
                     (unsigned long long)vm->repeated);
            say(lua, text);
        }
        vm->failures = 0;
        vm->repeated = 0;
        vm->failures_tick = second;
    }
    lua->failures++;
    if (++vm->failures == MOST_FAILURES) {
        vm->suspended = true;
        snprintf(text, sizeof text,
                 "%s: its functions failed %d times within a second and are suspended until the "
                 "file is reloaded; agents stay in their states\n",
                 vm->machine->path, MOST_FAILURES);
        say(lua, text);
        return;
    }
    if (vm->last_complaint && strcmp(vm->last_complaint, why) == 0) {
        vm->repeated++;
        return;
    }
    jox_free(vm->last_complaint);
    vm->last_complaint = jox_strdup(why);
    snprintf(text, sizeof text,
             "%s:%d: %s\n machine %s > state %s > %s; agent %u, step %u, seed %llu\n",
             vm->machine->path, line, why, vm->machine->name,
             vm->machine->states[mind->agents->state[vm->agent]].name, KINDS[kind],
             mind->agents->id[vm->agent], mind->tick, (unsigned long long)mind->seed);
    say(lua, text);
}

/* Reads what `when` or `steer` returned; NULL or what is wrong with it. */
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

bool jox_lua_call(void *context, const JoxMachine *machine, int32_t hook, JoxHookKind kind,
                  uint32_t agent, double result[2]) {
    JoxLua *lua = context;
    JoxVm *vm = machine->vm >= 0 ? lua->vms[machine->vm] : NULL;
    if (!vm || vm->suspended || (uint32_t)hook >= vm->hook_count)
        return false;
    lua_State *L = vm->L;
    vm->machine = machine;
    vm->agent = agent;
    vm->draws = 0;
    vm->run++;
    lua_rawgeti(L, LUA_REGISTRYINDEX, vm->hooks[hook]);
    lua_getfield(L, LUA_REGISTRYINDEX, "me");
    *(uint32_t *)lua_touserdata(L, -1) = vm->run;
    const char *why = NULL;
    int line = 0;
    bool good = jox_vm_call(vm, 1, 2, lua->limits.hook_instructions, &why, &line);
    if (good) {
        why = read_result(L, kind, result);
        good = !why;
        lua_settop(L, 0);
    }
    if (!good)
        report(lua, vm, kind, why, line);
    return good;
}
