/* `me`, the agent that a function runs for: reads the agent, writes its memory, own values and
   goal, gives signals, tells messages. It is not valid once the call has ended. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/language/fields.h"
#include "lua/language/views.h"
#include "lua/language/vocabulary.h"

static const char ME[] = "jostle me";

/* `me`: the one object that is passed to functions. */
typedef struct JoxMe {
    const char *type;
    uint32_t run;
} JoxMe;

/* Pushes the list of views of the agent's neighbours. */
static int push_neighbours(lua_State *L, JoxScript *script, uint32_t i) {
    JOX_ASSERT(script->machine);
    uint32_t seen[JOX_SMALL_CROWD];
    if (!script->machine->views) /* the state before the step was not kept */
        return luaL_error(L, "write me.neighbours as such, not by a name that is put together");
    const uint32_t count = jox_machines_seen(script->owner->machines, i, seen);
    jox_vm_charge(L, 20 * (count + 1));
    lua_createtable(L, (int)count, 0);
    lua_rawgeti(L, LUA_REGISTRYINDEX, script->views);
    for (uint32_t k = 0; k < count; k++) {
        jox_view_push(L, script, seen[k]);
        lua_rawseti(L, -3, k + 1);
    }
    lua_pop(L, 1);
    return 1;
}

/* Returns the agent that `me` stands for; raises an error if it was kept from an earlier call. */
static uint32_t check_me(lua_State *L, const JoxScript *script) {
    const JoxMe *me = lua_touserdata(L, 1);
    if (me != script->me_object)
        luaL_typeerror(L, 1, ME);
    if (script->vm.loading || me->run != script->vm.run)
        luaL_error(L, "`me` was kept from an earlier call; it is valid during its own only");
    return script->agent;
}

void jox_me_begin(JoxScript *script) {
    script->view_count = 0;
    script->me_object->run = ++script->vm.run;
}

/* me.signal("name") and me:signal("name"): heard in the next step. */
static int me_signal(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    int at = lua_type(L, 1) == LUA_TUSERDATA ? 2 : 1;
    if (script->vm.loading)
        return luaL_error(L, "signals are given while the crowd runs");
    if (lua_type(L, at) != LUA_TSTRING)
        return luaL_error(L, "a signal is a name");
    if (lua_gettop(L) > at)
        return luaL_error(L,
                          "a signal is a name and carries no value: call out a name for each, or "
                          "keep it in memory that is `public`, which others read");
    const char *name = lua_tostring(L, at);
    jox_vm_charge(L, 20 + (script->machine->name_count + script->owner->machines->set->name_count) /
                              8);
    if (script->owner->machines->state->called_count > 1000000)
        return luaL_error(L, "too many signals are given in one step");
    for (uint32_t n = 0; n < script->machine->name_count; n++)
        if (strcmp(script->machine->names[n].text, name) == 0) {
            jox_machines_call(script->owner->machines, script->agent,
                              script->machine->names[n].number);
            return 0;
        }
    if (lua_rawlen(L, at) > 60 || script->owner->machines->set->name_count > 10000)
        return luaL_error(L, "a signal's name has at most 60 bytes, and there are not so many");
    jox_machines_call(script->owner->machines, script->agent,
                      jox_machines_name(script->owner->machines, name));
    return 0;
}

/* __index of `me`. */
static int me_index(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    uint32_t i = check_me(L, script);
    const JoxMachineRun *machines = script->owner->machines;
    const JoxAgents *a = machines->agents;
    const JoxMachine *m = script->machine;
    const JoxField *field = jox_field_find(script, lua_topointer(L, 2));
    const int32_t slot = jox_field_slot(L, script, m, field);
    if (slot >= 0)
        return jox_view_push_memory(L, script, m, a->memory + (size_t)i * a->memory_stride, slot),
               1;
    switch (field->kind) {
    case FIELD_STATE:
        return lua_pushstring(L, m->states[a->state[i]].name), 1;
    case FIELD_MACHINE:
        return lua_pushstring(L, m->name), 1;
    case FIELD_NEIGHBOURS:
        return push_neighbours(L, script, i);
    case FIELD_SIGNAL:
        return lua_pushcfunction(L, me_signal), 1;
    case FIELD_TELL:
        return lua_pushcfunction(L, jox_me_tell), 1;
    case FIELD_TOLD:
        return lua_pushcfunction(L, jox_me_told), 1;
    case FIELD_HOLDING:
        return jox_view_push_somebody(L, script, jox_who_is_held(machines, i)), 1;
    case FIELD_STRIKER:
        return jox_view_push_somebody(L, script, jox_who_struck(machines, i)), 1;
    }
    if (jox_field_push(L, machines, i, field))
        return 1;
    const char *name = jox_field_key(L);
    const char *now = jox_machine_renamed(m, JOX_PART_MEMORY, name);
    if (now)
        return luaL_error(L, "me.%s is called me.%s now", name, now);
    const char *names[96];
    size_t count = 0;
    jox_vm_charge(L, 2000); /* a suggestion compares with all names */
    for (size_t k = 0; k < jox_me_key_count; k++)
        names[count++] = jox_me_keys[k].name;
    for (uint32_t s = 0; s < m->memory_count && count < 96; s++)
        names[count++] = m->memory[s].name;
    const char *near = jox_suggest(name, names, count);
    return near ? luaL_error(L, "me has no '%s'. Did you mean '%s'?", name, near)
                : luaL_error(L, "me has no '%s'", name);
}

/* Records where a function writes a value that a trace watches. */
static void record_write(lua_State *L, JoxMachineRun *machines, uint32_t i, bool is_memory,
                         int32_t index) {
    if (!machines->watched_count)
        return;
    const JoxPosition at = jox_vm_place(L);
    JoxWrote wrote = {.is_memory = is_memory,
                      .index = (uint16_t)index,
                      .by = JOX_WROTE_FUNCTION,
                      .line = at.line};
    snprintf(wrote.file, sizeof wrote.file, "%s", at.file ? at.file : "");
    jox_machines_record_writer(machines, i, &wrote);
}

/* __newindex of `me`. */
static int me_newindex(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    uint32_t i = check_me(L, script);
    JoxMachineRun *machines = script->owner->machines;
    const JoxField *field = jox_field_find(script, lua_topointer(L, 2));
    const int32_t slot = jox_field_slot(L, script, script->machine, field);
    const int parameter = field->parameter;
    if (slot >= 0) {
        const JoxAgents *a = machines->agents;
        double *memory = a->memory + (size_t)i * a->memory_stride;
        if (jox_memory_is_list(&script->machine->memory[slot]))
            jox_view_set_list(L, script, memory, slot, 3);
        else
            memory[slot] = jox_view_check_memory(L, script, &script->machine->memory[slot], 3);
        record_write(L, machines, i, true, slot);
    } else if (parameter >= 0) { /* an agent's own values begin with its parameters */
        const JoxParameterInfo *info = &jox_parameters[parameter];
        double value = lua_type(L, 3) == LUA_TNUMBER ? lua_tonumber(L, 3) : NAN;
        if (!(value >= info->least && value <= info->greatest))
            return luaL_error(L, "%s must be a number from %f to %f %s", info->name, info->least,
                              info->greatest, info->unit);
        jox_machines_set_own(machines, i, (uint32_t)parameter, value);
        record_write(L, machines, i, false, parameter);
    } else if (field->kind == FIELD_GOAL) {
        int32_t place =
            lua_type(L, 3) == LUA_TSTRING
                ? jox_place_find(machines->places, machines->place_count, lua_tostring(L, 3))
                : -1;
        if (place < 0)
            return luaL_error(L, "goal must be the name of a place of the scene");
        machines->agents->goal[i] = place;
    } else {
        return luaL_error(
            L, "'%s' cannot be set; what an agent remembers is declared by memory { ... }",
            jox_field_key(L));
    }
    return 0;
}

void jox_me_open(JoxScript *script) {
    lua_State *L = script->vm.L;
    jox_view_add_type(L, ME, me_index, me_newindex);
    jox_views_open(script);
    script->me_object = lua_newuserdatauv(L, sizeof *script->me_object, 0);
    *script->me_object = (JoxMe){.type = ME};
    luaL_setmetatable(L, ME);
    script->me = luaL_ref(L, LUA_REGISTRYINDEX);
    jox_fields_open(script);
}
