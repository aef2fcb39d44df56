/* Names of fields of `me` and of views, and their values; me_and_neighbours.c calls it. */
#include "lua/language/fields.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "machine/lifts.h"

static const char *const FIELD_NAMES[FIELD_COUNT] = {
    [FIELD_X] = "x",
    [FIELD_Y] = "y",
    [FIELD_STOREY] = "storey",
    [FIELD_HEIGHT] = "height",
    [FIELD_VX] = "vx",
    [FIELD_VY] = "vy",
    [FIELD_ID] = "id",
    [FIELD_TIME] = "time",
    [FIELD_TIME_IN_STATE] = "time_in_state",
    [FIELD_DENSITY] = "density",
    [FIELD_PUSHED] = "pushed",
    [FIELD_COMPRESSION] = "compression",
    [FIELD_LOAD] = "load",
    [FIELD_FALLEN] = "fallen",
    [FIELD_TEAM] = "team",
    [FIELD_GOAL] = "goal",
    [FIELD_STATE] = "state",
    [FIELD_MACHINE] = "machine",
    [FIELD_NEIGHBOURS] = "neighbours",
    [FIELD_SIGNAL] = "signal",
    [FIELD_TELL] = "tell",
    [FIELD_TOLD] = "told",
    [FIELD_HOLDING] = "holding",
    [FIELD_STRIKER] = "striker",
    [FIELD_IN_SIGHT] = "in_sight",
};

/* Longest text that Lua keeps once, and the number of fields from which on names of memory are
   compared one by one. */
enum { LONGEST_NAME = 40, MOST_FIELDS = JOX_FIELDS / 2 };

/* Adds a name, which the registry keeps alive, and returns its entry. */
static JoxField *add_field(JoxScript *script, const char *name) {
    lua_State *L = script->vm.L;
    lua_pushstring(L, name);
    JoxField *field = jox_field_find(script, lua_topointer(L, -1));
    if (!field->key) {
        field->key = lua_topointer(L, -1);
        script->field_count++;
        luaL_ref(L, LUA_REGISTRYINDEX);
    } else {
        lua_pop(L, 1);
    }
    return field;
}

void jox_fields_open(JoxScript *script) {
    for (uint32_t k = 0; k < JOX_FIELDS; k++)
        script->fields[k] = (JoxField){NULL, -1, -1, -1};
    for (int16_t f = 0; f < FIELD_COUNT; f++)
        add_field(script, FIELD_NAMES[f])->kind = f;
    for (int16_t p = 0; p < JOX_PARAM_COUNT; p++)
        add_field(script, jox_parameters[p].name)->parameter = p;
}

void jox_fields_add_memory(JoxScript *script, const JoxMachine *machine) {
    for (uint32_t s = machine->memory_count; s-- > 0;) { /* of doubled names the first counts */
        const char *name = machine->memory[s].name;
        if (!*name)
            continue;
        if (script->field_count < MOST_FIELDS && strlen(name) <= LONGEST_NAME)
            add_field(script, name)->slot = (int16_t)s;
        else
            script->has_unlisted = true;
    }
}

const char *jox_field_key(lua_State *L) {
    return lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "?";
}

int32_t jox_field_slot(lua_State *L, const JoxScript *script, const JoxMachine *machine,
                       const JoxField *field) {
    if (machine == script->machine && (field->key || !script->has_unlisted))
        return field->slot;
    return machine ? jox_machine_memory(machine, jox_field_key(L)) : -1;
}

static double get_vector_length(float x, float y) {
    return sqrt((double)x * x + (double)y * y);
}

bool jox_field_push(lua_State *L, const JoxMachineRun *machines, uint32_t i,
                    const JoxField *field) {
    JOX_ASSERT(i < machines->agents->count);
    const JoxAgents *a = machines->agents;
    switch (field->kind) {
    case FIELD_X:
        return lua_pushnumber(L, a->x[i]), true;
    case FIELD_Y:
        return lua_pushnumber(L, jox_in_plan(a->storeys, jox_v2(a->x[i], a->y[i])).y), true;
    case FIELD_STOREY:
        return lua_pushinteger(L, jox_storey_at(a->storeys, jox_v2(a->x[i], a->y[i]))), true;
    case FIELD_HEIGHT:
        return lua_pushnumber(L, jox_machines_height(machines, i)), true;
    case FIELD_VX:
        return lua_pushnumber(L, a->vx[i]), true;
    case FIELD_VY:
        return lua_pushnumber(L, a->vy[i]), true;
    case FIELD_ID:
        return lua_pushinteger(L, a->id[i]), true;
    case FIELD_TIME:
        return lua_pushnumber(L, machines->tick * machines->dt), true;
    case FIELD_TIME_IN_STATE:
        return lua_pushnumber(L, (machines->tick - a->entered[i]) * machines->dt), true;
    case FIELD_DENSITY:
        return lua_pushnumber(L, a->density[i]), true;
    case FIELD_PUSHED:
        return lua_pushnumber(L, get_vector_length(a->force_x[i], a->force_y[i])), true;
    case FIELD_COMPRESSION:
        return lua_pushnumber(L, a->compression[i]), true;
    case FIELD_LOAD:
        return lua_pushnumber(L, a->load[i]), true;
    case FIELD_FALLEN:
        return lua_pushnumber(L, a->fallen[i]), true;
    case FIELD_TEAM:
        return lua_pushinteger(L, a->team[i]), true;
    case FIELD_GOAL:
        if (a->goal[i] >= 0 && (uint32_t)a->goal[i] < machines->place_count)
            lua_pushstring(L, machines->places[a->goal[i]].name);
        else
            lua_pushnil(L);
        return true;
    }
    if (field->parameter < 0)
        return false;
    return lua_pushnumber(L, jox_param(a, (JoxParameter)field->parameter, i)), true;
}
