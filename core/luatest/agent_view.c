/* The table that tests get for an agent: a copy of its state. Reading a name that it does not have
   is an error, so that a misspelt one fails the test. */
#include <math.h>
#include <string.h>

#include "base/format/name.h"
#include "geom/storeys.h"
#include "luatest/luatest_parts.h"
#include "machine/lists.h"

double jox_test_speed(const JoxAgents *a, uint32_t i) {
    return sqrt((double)a->vx[i] * a->vx[i] + (double)a->vy[i] * a->vy[i]);
}

void jox_test_set_number(lua_State *L, const char *name, double value) {
    lua_pushnumber(L, value);
    lua_setfield(L, -2, name);
}

/* Pushes whom memory holds: the id of an agent, the name of a place, "body N", or nil. */
static void push_somebody(lua_State *L, const JoxMachineRun *machines, double who) {
    const uint32_t i = jox_who_agent(machines, who);
    JoxText text = {0};
    if (i != JOX_NO_INDEX) {
        lua_pushinteger(L, machines->agents->id[i]);
    } else if (!jox_who_exists(machines, who)) {
        lua_pushnil(L);
    } else {
        jox_who_print(machines, who, &text);
        lua_pushstring(L, text.data);
    }
    jox_text_free(&text);
}

/* Pushes a list in memory as a table. */
static void push_list(lua_State *L, const JoxMachineRun *machines, const JoxMachine *machine,
                      const double *memory, int32_t index) {
    const JoxMemorySlot *slot = &machine->memory[index];
    double items[JOX_MOST_ITEMS];
    const uint32_t size = jox_list_read(machines, machine, memory, index, items);
    lua_newtable(L);
    for (uint32_t k = 0; k < size; k++) {
        if (slot->kind == JOX_MEMORY_PEOPLE)
            push_somebody(L, machines, items[k]);
        else
            lua_pushnumber(L, items[k]);
        lua_rawseti(L, -2, k + 1);
    }
}

/* Pushes a table of the agent's own values by name, but for those that set parameters: a number, or
   the name of a place. */
static void push_own_values(lua_State *L, const JoxMachineRun *machines, uint32_t i) {
    const JoxAgents *a = machines->agents;
    const JoxMachine *m =
        a->machine[i] == JOX_NO_MACHINE ? NULL : machines->set->items[a->machine[i]];
    lua_newtable(L);
    for (uint32_t s = 0; m && s < m->own_count; s++) {
        const JoxOwnSlot *slot = &m->own[s];
        const double value = jox_own(a, i, s);
        if (!*slot->name || slot->general || jox_parameter_find(slot->name) >= 0)
            continue;
        if (slot->is_place && value >= 0.0 && value < machines->place_count)
            lua_pushstring(L, machines->places[(uint32_t)value].name);
        else
            lua_pushnumber(L, value);
        lua_setfield(L, -2, slot->name);
    }
}

/* ---- names that a view does not have ---- */

/* Returns the key of the table at `table` that is most like `name`; NULL if none is. */
static const char *suggest_key(lua_State *L, int table, const char *name) {
    const char *names[256];
    size_t count = 0;
    lua_pushnil(L);
    while (lua_next(L, table)) {
        lua_pop(L, 1);
        if (count < 256 && lua_type(L, -1) == LUA_TSTRING)
            names[count++] = lua_tostring(L, -1);
    }
    return jox_suggest(name, names, count);
}

/* Returns whether the table at `table` has a key. */
static bool has_key(lua_State *L, int table, const char *name) {
    lua_pushstring(L, name);
    const bool has = lua_rawget(L, table) != LUA_TNIL;
    lua_pop(L, 1);
    return has;
}

/* __index of the table of an agent, for a name that it does not have, or that is nil: upvalue 1 has
   the names that may be nil. */
static int index_agent(lua_State *L) {
    const char *name = luaL_tolstring(L, 2, NULL);
    if (has_key(L, lua_upvalueindex(1), name))
        return lua_pushnil(L), 1;
    lua_pushliteral(L, "own");
    if (lua_rawget(L, 1) == LUA_TTABLE && has_key(L, lua_gettop(L), name))
        return luaL_error(L, "an agent has no '%s'; it is an own value: own.%s", name, name);
    const char *near = suggest_key(L, 1, name);
    if (!near)
        near = suggest_key(L, lua_upvalueindex(1), name);
    return luaL_error(L, "an agent has no '%s'%s%s", name, near ? "; did you mean " : "",
                      near ? near : "");
}

/* __index of the table `own` of an agent, whose own table is upvalue 1 and may hold the name. */
static int index_own(lua_State *L) {
    const char *name = luaL_tolstring(L, 2, NULL), *near = suggest_key(L, 1, name);
    if (has_key(L, lua_upvalueindex(1), name))
        return luaL_error(L,
                          "'%s' is no own value; memory and parameters are fields of the agent "
                          "itself: .%s without own",
                          name, name);
    return luaL_error(L, "the agent has no own value '%s'%s%s", name,
                      near ? "; did you mean own." : "", near ? near : "");
}

/* Gives the table on top of the stack this function as __index, with the value at `upvalue`. */
static void refuse_unknown_names(lua_State *L, lua_CFunction index, int upvalue) {
    upvalue = lua_absindex(L, upvalue);
    lua_createtable(L, 0, 2);
    lua_pushvalue(L, upvalue);
    lua_pushcclosure(L, index, 1);
    lua_setfield(L, -2, "__index");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
}

/* Adds a name to the table of those that may be nil, at `absent`. */
static void allow_nil(lua_State *L, int absent, const char *name) {
    lua_pushboolean(L, 1);
    lua_setfield(L, absent, name);
}

/* Pushes the team of an agent: its name, the number of a party's team, or nil. */
static void push_team(lua_State *L, const JoxTestDriver *driver, void *scene, uint16_t team) {
    const char *name = driver->team_name(driver->context, scene, team);
    if (name)
        lua_pushstring(L, name);
    else if (team)
        lua_pushinteger(L, team);
    else
        lua_pushnil(L);
}

/* Sets where an agent is, in plan, and in a building on which storey and stair. */
static void push_position(lua_State *L, const JoxAgents *a, uint32_t i) {
    const JoxStoreys *storeys = a->storeys;
    const JoxV2 at = {a->x[i], a->y[i]}, plan = jox_in_plan(storeys, at);
    const int32_t stair = jox_stair_at(storeys, at);
    jox_test_set_number(L, "x", (double)plan.x);
    jox_test_set_number(L, "y", (double)plan.y);
    if (!storeys)
        return;
    lua_pushstring(L, storeys->storeys[jox_storey_at(storeys, at)].name);
    lua_setfield(L, -2, "storey");
    lua_pushstring(L, stair < 0 ? NULL : storeys->stairs[stair].name);
    lua_setfield(L, -2, "stair");
}

void jox_test_push_agent(lua_State *L, const JoxTestDriver *driver, void *scene, uint32_t i) {
    const JoxMachineRun *machines = driver->machines(driver->context, scene);
    static const char *const MAY_BE_NIL[] = {"team",  "group",  "machine",
                                             "state", "storey", "stair"};
    const JoxAgents *a = machines->agents;
    lua_newtable(L);
    const int absent = lua_gettop(L);
    for (size_t n = 0; n < sizeof MAY_BE_NIL / sizeof *MAY_BE_NIL; n++)
        allow_nil(L, absent, MAY_BE_NIL[n]);
    lua_newtable(L);
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        jox_test_set_number(L, jox_parameters[p].name, jox_param(a, p, i));
    if (a->machine[i] != JOX_NO_MACHINE) {
        const JoxMachine *m = machines->set->items[a->machine[i]];
        for (uint32_t s = 0; s < m->memory_count; s++) {
            double value = a->memory[(size_t)i * a->memory_stride + s];
            if (!*m->memory[s].name)
                continue;
            if (m->memory[s].kind == JOX_MEMORY_BOOLEAN) {
                lua_pushboolean(L, value != 0.0);
                lua_setfield(L, -2, m->memory[s].name);
            } else if (jox_memory_is_list(&m->memory[s])) {
                push_list(L, machines, m, a->memory + (size_t)i * a->memory_stride, (int32_t)s);
                lua_setfield(L, -2, m->memory[s].name);
            } else if (m->memory[s].kind == JOX_MEMORY_SOMEBODY) {
                push_somebody(L, machines, value);
                lua_setfield(L, -2, m->memory[s].name);
                allow_nil(L, absent, m->memory[s].name);
            } else {
                jox_test_set_number(L, m->memory[s].name, value);
            }
        }
        lua_pushstring(L, m->name);
        lua_setfield(L, -2, "machine");
        lua_pushstring(L, m->states[a->state[i]].name);
        lua_setfield(L, -2, "state");
    }
    lua_pushinteger(L, a->id[i]);
    lua_setfield(L, -2, "id");
    const int32_t group = a->group[i];
    lua_pushstring(L, driver->group_name(driver->context, scene, group));
    lua_setfield(L, -2, "group");
    push_team(L, driver, scene, a->team[i]);
    lua_setfield(L, -2, "team");
    push_own_values(L, machines, i);
    refuse_unknown_names(L, index_own, -2);
    lua_setfield(L, -2, "own");
    push_position(L, a, i);
    jox_test_set_number(L, "vx", a->vx[i]);
    jox_test_set_number(L, "vy", a->vy[i]);
    jox_test_set_number(L, "now",
                        jox_test_speed(a, i)); /* present speed; `speed` is the wanted speed */
    jox_test_set_number(L, "density", a->density[i]);
    jox_test_set_number(L, "compression", a->compression[i]);
    jox_test_set_number(L, "load", a->load[i]);
    jox_test_set_number(L, "fallen", a->fallen[i]);
    jox_test_set_number(
        L, "pushed",
        sqrt((double)a->force_x[i] * a->force_x[i] + (double)a->force_y[i] * a->force_y[i]));
    refuse_unknown_names(L, index_agent, absent);
    lua_remove(L, absent);
}
