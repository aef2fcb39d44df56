/* State of the plain functions of behaviours: reports of failures, writes into neighbours' memory,
   costs. hook_calls.c calls them. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/clock.h"
#include "base/mem.h"
#include "lua/language/script.h"
#include "lua/loader.h"
#include "lua/read_table.h"

void jox_lua_attach(JoxLua *lua, JoxMachineRun *machines, JoxLuaComplain *complain, void *context) {
    JOX_ASSERT(!machines || machines->agents);
    lua->machines = machines;
    lua->clock_cost = jox_clock_thread_cost();
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
void jox_hook_report_failure(JoxLua *lua, JoxScript *script, JoxHook *hook, const char *why,
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
    return hook->first + (hook->timed ? hook->seconds / (double)hook->timed *
                                            (double)(hook->calls - JOX_HOOK_TIMED)
                                      : 0.0);
}

/* Returns the processor time of a machine's functions, s, estimated from the first 16 calls of each
   function and one in 64 of the others; *calls is the number of calls. */
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

const char *jox_lua_last_failure(const JoxLua *lua, const JoxMachine *machine, uint32_t n) {
    const JoxScript *script = jox_lua_script(lua, machine);
    return script && n < script->hook_count ? script->hooks[n].complaint : NULL;
}
