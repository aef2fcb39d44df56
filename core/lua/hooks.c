/* Calls plain functions of behaviours, for one agent at a time on the stepping thread; measures
   their time and reports their failures. The machines of a run call it through JoxMachineRun.call.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/clock.h"
#include "base/mem.h"
#include "lua/language/script.h"
#include "lua/loader.h"

enum { TIMED = 16 }; /* number of first calls that are timed; of later ones, one in as many is */

/* Fibonacci hashing times one number in 16, spread evenly over every remainder. Timing each 16th
   call would always hit the same agent if 16 agents are in a state. */
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

/* Reports text that may quote a script; removes control characters, which a terminal would obey,
   from each line. */
static void report_lines(JoxLua *lua, char *text) {
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

/* Begins a second of simulated time for a function: reports how many failures of the last one were
   only counted. */
static void begin_failure_second(JoxLua *lua, const JoxScript *script, JoxHook *hook,
                                 uint32_t second) {
    char text[1024];
    if (hook->repeated > 0) {
        snprintf(text, sizeof text, "%.200s: %.200s: %llu times more in a second\n",
                 script->machine->path, hook->where, (unsigned long long)hook->repeated);
        report_lines(lua, text);
    }
    hook->second = second;
    hook->second_failures = 0;
    hook->repeated = 0;
}

/* Reports a failure in full if its message is new; else counts it for a report once a second of
   simulated time. Suspends the function at JOX_MOST_FAILURES in a second. */
static void report_hook_failure(JoxLua *lua, JoxScript *script, JoxHook *hook, const char *why,
                                int line) {
    JOX_ASSERT(why && line >= 0);
    const JoxMachineRun *machines = lua->machines;
    char text[2600];
    uint32_t second = (uint32_t)(machines->tick * machines->dt);
    if (second != hook->second)
        begin_failure_second(lua, script, hook, second);
    lua->machines->state->hook_failures++;
    hook->failures++;
    if (++hook->second_failures == JOX_MOST_FAILURES) {
        hook->suspended = true;
        snprintf(
            text, sizeof text,
            "%.200s: %.200s: it failed %d times within a second and is suspended until the file "
            "is reloaded; agents stay in their states\n",
            script->machine->path, hook->where, JOX_MOST_FAILURES);
        report_lines(lua, text);
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
    report_lines(lua, text);
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
            line = find_function_line(script, &where);
        }
        lua_settop(L, 0);
    }
    if (jox_upvalues_restore(L, &script->upvalues, hook->first_upvalue, hook->upvalue_count, name,
                             &where)) {
        line = find_function_line(script, &where);
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
        report_hook_failure(lua, script, hook, why, line);
    return good;
}

/* ---- neighbours' memory ---- */

/* Returns the present slot of memory that was written: if the agent has changed its machine, memory
   of the same name and kind; -1 if there is none. */
static int32_t find_present_slot(const JoxMachineRun *machines, uint32_t i, const JoxWrite *write) {
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

/* Returns whether a write overwrites another change of this step that it could not know of: it
   depends on the value before the step. Booleans that are set to the same value lose nothing. */
static bool loses_change(const JoxLua *lua, uint32_t i, uint32_t slot, const JoxWrite *write) {
    const JoxAgents *a = lua->machines->agents;
    const size_t at = (size_t)i * a->memory_stride + slot;
    if (!write->depends || a->machine[i] != write->machine ||
        lua->before_machine[i] != write->machine || a->memory[at] == lua->before_memory[at])
        return false;
    const JoxMachine *m = lua->machines->set->items[write->machine];
    return m->memory[slot].kind == JOX_MEMORY_NUMBER || a->memory[at] != write->value;
}

/* Reports once in a second of simulated time that changes of neighbours' memory were lost. */
static void report_lost_change(JoxLua *lua, const JoxWrite *write) {
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
    report_lines(lua, text);
}

void jox_lua_bracket_hooks(void *context, bool begins) {
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
        const int32_t slot = i == JOX_NO_INDEX ? -1 : find_present_slot(lua->machines, i, write);
        if (slot < 0)
            continue;
        if (loses_change(lua, i, (uint32_t)slot, write))
            report_lost_change(lua, write);
        a->memory[(size_t)i * a->memory_stride + (uint32_t)slot] = write->value;
        const JoxWrote wrote = {
            .is_memory = true, .index = (uint16_t)slot, .by = JOX_WROTE_FUNCTION};
        jox_machines_record_writer(lua->machines, i, &wrote);
    }
    lua->write_count = 0;
}

/* ---- costs ---- */

/* Returns the time of all calls, s: untimed calls are taken to last as long as timed ones on
   average. */
static double estimate_hook_time(const JoxHook *hook) {
    return hook->first + (hook->timed
                              ? hook->seconds / (double)hook->timed * (double)(hook->calls - TIMED)
                              : 0.0);
}

/* Returns the processor time of a machine's functions, s, estimated from the first 16 calls of each
   function and one in 16 of the others; *calls is the number of calls. */
static double measure_seconds(const JoxLua *lua, const JoxMachine *machine, uint64_t *calls) {
    const JoxScript *script = jox_lua_script(lua, machine);
    double seconds = 0.0;
    *calls = 0;
    for (uint32_t h = 0; script && h < script->hook_count; h++) {
        const JoxHook *hook = &script->hooks[h];
        *calls += hook->calls;
        seconds += estimate_hook_time(hook);
    }
    return seconds;
}

JoxLuaTotal jox_lua_total(const JoxLua *lua, double stepped) {
    const JoxMachineSet *set = lua->machines->set;
    JoxLuaTotal total = {.stepping = stepped + lua->arriving, .cut = 1.0};
    for (uint32_t m = 0; m < set->count; m++) {
        uint64_t calls;
        total.seconds += measure_seconds(lua, set->items[m], &calls);
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
                        .seconds = estimate_hook_time(hook),
                        .suspended = hook->suspended};
    return true;
}
