/* Plain functions of behaviours, called for one agent at a time on the stepping thread: the call,
   what it costs, and what is said where it fails. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/clock.h"
#include "base/mem.h"
#include "lua/language/script.h"
#include "lua/loader.h"

enum { TIMED = 16 }; /* first calls that are timed; of later ones, one in as many is */

/* One number in 16, by Fibonacci hashing: evenly many of the numbers that leave any one remainder,
   as those of one person's calls do where as many people are in a state as one in so many is timed.
 */
bool jox_lua_is_timed(uint64_t call) {
    return call < TIMED || call * UINT64_C(0x9e3779b97f4a7c15) >> 60 == 0;
}

void jox_lua_attach(JoxLua *lua, JoxMachineRun *machines, JoxLuaComplain *complain, void *context) {
    JOX_ASSERT(!machines || machines->agents);
    lua->machines = machines;
    lua->group.say = complain;
    lua->group.say_context = context;
}

void jox_lua_sections(void *context, const JoxMachine *machine, JoxSections *s) {
    JoxLua *lua = context;
    JoxScript *script = machine->vm >= 0 ? lua->scripts[machine->vm] : NULL;
    jox_sections_module(s, "hooks");
    jox_section_model(s, machine->name, script ? script->hook_count : 0);
    for (uint32_t h = 0; script && h < script->hook_count; h++) {
        JoxHook *hook = &script->hooks[h];
        JOX_SECTION(s, "second", hook->second);
        JOX_SECTION(s, "second_failures", hook->second_failures);
        JOX_SECTION(s, "suspended", hook->suspended);
        jox_sections_unhashed(s, true);
        JOX_SECTION(s, "calls", hook->calls);
        JOX_SECTION(s, "failures", hook->failures);
        jox_sections_unhashed(s, false);
    }
}

/* Reports text that a script may have written: control characters, which a terminal would obey, are
   removed from each line. */
static void say(JoxLua *lua, char *text) {
    for (char *line = text; *line;) {
        char *end = strchr(line, '\n');
        if (end)
            *end = 0;
        jox_text_clean(line);
        if (!end)
            break;
        *end = '\n';
        line = end + 1;
    }
    if (lua->group.say)
        lua->group.say(lua->group.say_context, text);
}

/* A new simulated second begins for a hook: failures of the last one that were only counted are
   reported as a number. */
static void new_second(JoxLua *lua, const JoxScript *script, JoxHook *hook, uint32_t second) {
    char text[1024];
    if (hook->repeated > 0) {
        snprintf(text, sizeof text, "%.200s: %.200s: %llu times more in a second\n",
                 script->machine->path, hook->where, (unsigned long long)hook->repeated);
        say(lua, text);
    }
    hook->second = second;
    hook->second_failures = 0;
    hook->repeated = 0;
}

/* Reports a new failure in full. One with the same message as the last is only counted, and the
   count is reported once a simulated second. */
static void report(JoxLua *lua, JoxScript *script, JoxHook *hook, const char *why, int line) {
    JOX_ASSERT(why && line >= 0);
    const JoxMachineRun *machines = lua->machines;
    char text[2600];
    uint32_t second = (uint32_t)(machines->tick * machines->dt);
    if (second != hook->second)
        new_second(lua, script, hook, second);
    lua->machines->state->hook_failures++;
    hook->failures++;
    if (++hook->second_failures == JOX_MOST_FAILURES) {
        hook->suspended = true;
        snprintf(
            text, sizeof text,
            "%.200s: %.200s: it failed %d times within a second and is suspended until the file "
            "is reloaded; agents stay in their states\n",
            script->machine->path, hook->where, JOX_MOST_FAILURES);
        say(lua, text);
        return;
    }
    if ((hook->complaint && strcmp(hook->complaint, why) == 0) ||
        !jox_vm_may_say(&script->vm, second)) {
        hook->repeated++;
        return;
    }
    jox_free(hook->complaint);
    hook->complaint = jox_strdup(why);
    snprintf(text, sizeof text,
             "%.200s:%d: %.400s\n%s machine %.60s > %.200s; agent %u, step %u, seed %llu\n",
             script->vm.sources[script->vm.failed_source]->path, line, why, script->vm.traceback,
             script->machine->name, hook->where, machines->agents->id[script->agent],
             machines->tick, (unsigned long long)machines->seed);
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

/* The line of a function that failed as a whole, and not at one of its lines. */
static int blame_function(JoxScript *script, const lua_Debug *where) {
    const int source = jox_vm_source(&script->vm, where->short_src);
    script->vm.failed_source = source > 0 ? (size_t)source : 0;
    script->vm.traceback[0] = 0;
    return where->linedefined;
}

bool jox_lua_call(void *context, const JoxMachine *machine, int32_t number, JoxHookKind kind,
                  uint32_t agent, double result[2]) {
    JoxLua *lua = context;
    JoxScript *script = machine->vm >= 0 ? lua->scripts[machine->vm] : NULL;
    if (!script || (uint32_t)number >= script->hook_count || script->hooks[number].suspended)
        return false;
    JoxHook *hook = &script->hooks[number];
    lua_State *L = script->vm.L;
    const bool first = hook->calls < TIMED, timed = jox_lua_is_timed(hook->calls);
    const double begun = timed ? jox_clock_thread() : 0.0;
    hook->calls++;
    script->machine = machine;
    script->agent = agent;
    script->draws = script->read_count = 0;
    script->vm.run++;
    lua_rawgeti(L, LUA_REGISTRYINDEX, hook->ref);
    lua_rawgeti(L, LUA_REGISTRYINDEX, script->me);
    *(uint32_t *)lua_touserdata(L, -1) = script->vm.run;
    const char *why = NULL;
    int line = 0;
    bool good = jox_vm_call(&script->vm, 1, 2, lua->group.limits.hook_instructions, &why, &line);
    char name[64], changed[200];
    lua_Debug where;
    if (good) {
        why = read_result(L, kind, result);
        good = !why;
        if (why) {
            lua_rawgeti(L, LUA_REGISTRYINDEX, hook->ref);
            lua_getinfo(L, ">S", &where);
            line = blame_function(script, &where);
        }
        lua_settop(L, 0);
    }
    if (jox_upvalues_restore(L, &script->upvalues, hook->first_upvalue, hook->upvalue_count, name,
                             &where)) {
        line = blame_function(script, &where);
        snprintf(
            changed, sizeof changed,
            "a function changed '%s', a variable from outside of it, and it was set back: what "
            "an agent remembers belongs in memory",
            name);
        why = changed;
        good = false;
    }
    if (timed) {
        const double took = jox_clock_thread() - begun;
        *(first ? &hook->first : &hook->seconds) += took;
        hook->timed += !first;
        lua->arriving += lua->machines->spawning ? (first ? 1.0 : TIMED) * took : 0.0;
    }
    if (!good)
        report(lua, script, hook, why, line);
    return good;
}

/* ---- what others read and write ---- */

/* Where memory that was written is now: in a machine that the agent became meanwhile, memory of the
   same name and kind goes along. -1: nowhere. */
static int32_t slot_now(const JoxMachineRun *machines, uint32_t i, const JoxWrite *write) {
    const uint16_t machine = machines->agents->machine[i];
    if (machine == write->machine)
        return (int32_t)write->slot;
    const JoxMemorySlot *was = &machines->set->items[write->machine]->memory[write->slot];
    const JoxMachine *now = machine == JOX_NO_MACHINE ? NULL : machines->set->items[machine];
    for (uint32_t s = 0; now && s < now->memory_count; s++)
        if (*was->name && strcmp(now->memory[s].name, was->name) == 0 &&
            now->memory[s].kind == was->kind)
            return (int32_t)s;
    return -1;
}

/* Whether something else has changed the memory in this step that a function worked out anew from
   what it was before the step: the change is lost. Who agree that it is true lose nothing. */
static bool is_stale(const JoxLua *lua, uint32_t i, uint32_t slot, const JoxWrite *write) {
    const JoxAgents *a = lua->machines->agents;
    const size_t at = (size_t)i * a->memory_stride + slot;
    if (!write->depends || a->machine[i] != write->machine ||
        lua->before_machine[i] != write->machine || a->memory[at] == lua->before_memory[at])
        return false;
    const JoxMachine *m = lua->machines->set->items[write->machine];
    return m->memory[slot].kind == JOX_MEMORY_NUMBER || a->memory[at] != write->value;
}

/* Tells once in a simulated second that changes of others' memory are lost. */
static void tell_lost(JoxLua *lua, const JoxWrite *write) {
    const JoxMachineRun *machines = lua->machines;
    const uint32_t second = (uint32_t)(machines->tick * machines->dt) + 1;
    char text[700], more[60] = "";
    lua->lost_writes++;
    machines->state->changes_lost++;
    if (lua->lost_second == second)
        return;
    if (lua->lost_writes > 1)
        snprintf(more, sizeof more, " (%llu such before)",
                 (unsigned long long)lua->lost_writes - 1);
    snprintf(
        text, sizeof text,
        "%.200s:%d: '%.60s' of agent %u is changed by several in step %u, here from what it was "
        "before "
        "the step: a change is lost%s. Let the agent itself count: a signal, or a condition on "
        "others, tells it when\n",
        write->file ? write->file : "", write->line,
        machines->set->items[write->machine]->memory[write->slot].name, write->agent_id,
        machines->tick, more);
    lua->lost_second = second;
    lua->lost_writes = 0;
    say(lua, text);
}

void jox_lua_bracket(void *context, bool begins) {
    JoxLua *lua = context;
    JoxAgents *a = lua->machines->agents;
    if (begins) {
        JOX_RESERVE(lua->before_state, lua->before_capacity, a->count);
        JOX_RESERVE(lua->before_machine, lua->before_machine_capacity, a->count);
        JOX_RESERVE(lua->before_memory, lua->before_memory_capacity,
                    (size_t)a->count * a->memory_stride);
        if (a->count)
            memcpy(lua->before_state, a->state, a->count * sizeof *a->state);
        if (a->count)
            memcpy(lua->before_machine, a->machine, a->count * sizeof *a->machine);
        if (a->count && a->memory_stride)
            memcpy(lua->before_memory, a->memory,
                   (size_t)a->count * a->memory_stride * sizeof *a->memory);
        return;
    }
    for (uint32_t w = 0; w < lua->write_count; w++) {
        const JoxWrite *write = &lua->writes[w];
        const uint32_t i = jox_agents_find(a, write->agent_id);
        const int32_t slot = i == JOX_NO_INDEX ? -1 : slot_now(lua->machines, i, write);
        if (slot < 0)
            continue;
        if (is_stale(lua, i, (uint32_t)slot, write))
            tell_lost(lua, write);
        a->memory[(size_t)i * a->memory_stride + (uint32_t)slot] = write->value;
        const JoxWrote wrote = {
            .is_memory = true, .index = (uint16_t)slot, .by = JOX_WROTE_FUNCTION};
        jox_machines_wrote(lua->machines, i, &wrote);
    }
    lua->write_count = 0;
}

/* ---- costs ---- */

/* s, of all its calls; those that were not timed take what those that were take. */
static double estimate(const JoxHook *hook) {
    return hook->first + (hook->timed
                              ? hook->seconds / (double)hook->timed * (double)(hook->calls - TIMED)
                              : 0.0);
}

double jox_lua_seconds(const JoxLua *lua, const JoxMachine *machine, uint64_t *calls) {
    const JoxScript *script = jox_lua_script(lua, machine);
    double seconds = 0.0;
    *calls = 0;
    for (uint32_t h = 0; script && h < script->hook_count; h++) {
        const JoxHook *hook = &script->hooks[h];
        *calls += hook->calls;
        seconds += estimate(hook);
    }
    return seconds;
}

JoxLuaTotal jox_lua_total(const JoxLua *lua, double stepped) {
    const JoxMachineSet *set = lua->machines->set;
    JoxLuaTotal total = {.stepping = stepped + lua->arriving, .cut = 1.0};
    for (uint32_t m = 0; m < set->count; m++) {
        uint64_t calls;
        total.seconds += jox_lua_seconds(lua, set->items[m], &calls);
        total.calls += calls;
    }
    if (total.seconds > total.stepping) {
        total.cut = total.stepping / total.seconds;
        total.seconds = total.stepping;
    }
    return total;
}

bool jox_lua_cost(const JoxLua *lua, const JoxMachine *machine, uint32_t n, JoLuaCost *cost) {
    const JoxScript *script = jox_lua_script(lua, machine);
    if (!script || n >= script->hook_count)
        return false;
    const JoxHook *hook = &script->hooks[n];
    *cost = (JoLuaCost){.behaviour = machine->name,
                        .file = machine->path,
                        .where = hook->where,
                        .calls = hook->calls,
                        .failures = hook->failures,
                        .seconds = estimate(hook),
                        .suspended = hook->suspended};
    return true;
}
