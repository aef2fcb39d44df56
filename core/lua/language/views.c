/* Views of others, as functions get them: of neighbours, of whom memory holds, and of bodies. A
   view shows an agent as it was before the step; writes to its memory take effect after the step.
   It is not valid once the call has ended. me_and_neighbours.c hands them out. */
#include "lua/language/views.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/language/fields.h"
#include "machine/lists.h"

static const char VIEW[] = "jostle view";

struct JoxView {
    const char *type;
    uint32_t run, index;     /* index of the agent; of a body its row */
    bool is_body, is_hidden; /* is_hidden: of somebody who is remembered and out of sight */
};

/* ---- memory ---- */

/* Pushes a list in memory as a table. */
static void push_list(lua_State *L, JoxScript *script, const JoxMachine *machine,
                      const double *memory, int32_t index) {
    const JoxMemorySlot *slot = &machine->memory[index];
    double items[JOX_MOST_ITEMS];
    const uint32_t size = jox_list_read(script->owner->machines, machine, memory, index, items);
    jox_vm_charge(L, 20 * (size + 1));
    luaL_checkstack(L, 4, NULL);
    lua_createtable(L, (int)size, 0);
    for (uint32_t k = 0; k < size; k++) {
        if (slot->kind == JOX_MEMORY_PEOPLE)
            jox_view_push_somebody(L, script, items[k]);
        else
            lua_pushnumber(L, items[k]);
        lua_rawseti(L, -2, k + 1);
    }
}

void jox_view_push_memory(lua_State *L, JoxScript *script, const JoxMachine *machine,
                          const double *memory, int32_t index) {
    const JoxMemorySlot *slot = &machine->memory[index];
    if (jox_memory_is_list(slot))
        push_list(L, script, machine, memory, index);
    else if (slot->kind == JOX_MEMORY_BOOLEAN)
        lua_pushboolean(L, memory[index] != 0.0);
    else if (slot->kind == JOX_MEMORY_SOMEBODY)
        jox_view_push_somebody(L, script, memory[index]);
    else
        lua_pushnumber(L, memory[index]);
}

/* Returns the somebody at a stack index as a number: nil, a view or the name of a place; raises an
   error if it is none of them. */
static double check_somebody(lua_State *L, const JoxScript *script, const char *name, int index) {
    const JoxMachineRun *machines = script->owner->machines;
    const JoxView *view = lua_rawlen(L, index) == sizeof *view ? lua_touserdata(L, index) : NULL;
    if (lua_isnoneornil(L, index))
        return JOX_NOBODY;
    if (lua_touserdata(L, index) == (void *)script->me_object)
        return 1.0 + machines->agents->id[script->agent];
    if (lua_type(L, index) == LUA_TSTRING) {
        const int32_t place =
            jox_place_find(machines->places, machines->place_count, lua_tostring(L, index));
        if (place >= 0)
            return JOX_WHO_PLACE + place;
    }
    if (!view || view->type != VIEW || view->run != script->vm.run)
        luaL_error(L, "%s is somebody: me, a neighbour, the name of a place of the scene, or nil",
                   name);
    return view->is_body ? JOX_WHO_BODY + machines->objects->rows[view->index].id
                         : 1.0 + machines->agents->id[view->index];
}

void jox_view_set_list(lua_State *L, const JoxScript *script, double *memory, int32_t index,
                       int at) {
    const JoxMemorySlot *slot = &script->machine->memory[index];
    double items[JOX_MOST_ITEMS] = {0};
    const size_t count = lua_type(L, at) == LUA_TTABLE ? lua_rawlen(L, at) : SIZE_MAX;
    if (count > slot->capacity)
        luaL_error(L, "memory '%s' is a list of at most %d items", slot->name, (int)slot->capacity);
    for (size_t k = 0; k < count; k++) {
        lua_rawgeti(L, at, (lua_Integer)k + 1);
        if (slot->kind == JOX_MEMORY_PEOPLE)
            items[k] = check_somebody(L, script, slot->name, -1);
        else if (lua_type(L, -1) == LUA_TNUMBER && isfinite(lua_tonumber(L, -1)))
            items[k] = lua_tonumber(L, -1);
        else
            luaL_error(L, "memory '%s' is a list of finite numbers", slot->name);
        lua_pop(L, 1);
    }
    memcpy(memory + slot->items, items, slot->capacity * sizeof *items);
    memory[index] = (double)count;
}

double jox_view_check_memory(lua_State *L, const JoxScript *script, const JoxMemorySlot *slot,
                             int index) {
    if (slot->kind == JOX_MEMORY_SOMEBODY)
        return check_somebody(L, script, slot->name, index);
    if (slot->kind == JOX_MEMORY_BOOLEAN) {
        if (lua_type(L, index) != LUA_TBOOLEAN)
            luaL_error(L, "memory '%s' is true or false", slot->name);
        return lua_toboolean(L, index);
    }
    if (lua_type(L, index) != LUA_TNUMBER || !isfinite(lua_tonumber(L, index)))
        luaL_error(L, "memory '%s' is a finite number", slot->name);
    return lua_tonumber(L, index);
}

/* ---- views of neighbours ---- */

/* Returns the view at index 1; raises an error if it was kept from an earlier call. */
static const JoxView *check_view(lua_State *L, const JoxScript *script) {
    const JoxView *view = lua_touserdata(L, 1);
    if (!view || view->type != VIEW)
        luaL_typeerror(L, 1, VIEW);
    if (script->vm.loading || view->run != script->vm.run)
        luaL_error(L, "a neighbour was kept from an earlier call; it is valid during its own only");
    return view;
}

/* Pushes a field of a body; raises an error if it has none of that name. */
static int push_body_field(lua_State *L, const JoxObject *body, const JoxField *field) {
    switch (field->kind) {
    case FIELD_ID:
        return lua_pushinteger(L, body->id), 1;
    case FIELD_X:
        return lua_pushnumber(L, body->position.x), 1;
    case FIELD_Y:
        return lua_pushnumber(L, body->position.y), 1;
    case FIELD_VX:
        return lua_pushnumber(L, body->velocity.x), 1;
    case FIELD_VY:
        return lua_pushnumber(L, body->velocity.y), 1;
    }
    return luaL_error(L, "a body has no '%s': it has id, x, y, vx, vy and in_sight",
                      jox_field_key(L));
}

/* __index of a view. */
static int view_index(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    JoxLua *lua = script->owner;
    const JoxView *view = check_view(L, script);
    const JoxField *field = jox_field_find(script, lua_topointer(L, 2));
    if (field->kind == FIELD_IN_SIGHT)
        return lua_pushboolean(L, !view->is_hidden), 1;
    if (view->is_hidden && field->kind != FIELD_ID)
        return luaL_error(L, "'%s' is not known of one who is out of sight: ask in_sight first",
                          jox_field_key(L));
    if (view->is_body)
        return push_body_field(L, &lua->machines->objects->rows[view->index], field);
    const uint32_t i = view->index;
    const JoxAgents *a = lua->machines->agents;
    const uint16_t machine = lua->before_machine[i];
    const JoxMachine *m = machine == JOX_NO_MACHINE ? NULL : lua->machines->set->items[machine];
    const bool of_machine = field->kind == FIELD_STATE || field->kind == FIELD_MACHINE;
    if (of_machine && m) {
        uint16_t state = lua->before_state[i] < m->state_count ? lua->before_state[i] : m->start;
        lua_pushstring(L, field->kind == FIELD_STATE ? m->states[state].name : m->name);
        return 1;
    }
    const int32_t slot = jox_field_slot(L, script, m, field);
    if (slot >= 0) {
        const uint32_t most = sizeof script->read / sizeof *script->read;
        script->read[script->read_count % most].agent = i;
        script->read[script->read_count++ % most].slot = (uint32_t)slot;
        jox_view_push_memory(L, script, m, lua->before_memory + (size_t)i * a->memory_stride, slot);
        return 1;
    }
    if (jox_field_push(L, lua->machines, i, field))
        return 1;
    /* One without a machine, whom a program moves, or with another machine. */
    const char *name = jox_field_key(L);
    if (of_machine || jox_machine_memory(script->machine, name) >= 0)
        return lua_pushnil(L), 1;
    return luaL_error(L, "a neighbour has no '%s'", name);
}

/* Returns whether the present call has read this memory of a neighbour: its last 16 reads count. */
static bool has_read(const JoxScript *script, uint32_t agent, uint32_t slot) {
    const uint32_t most = sizeof script->read / sizeof *script->read;
    const uint32_t count = script->read_count < most ? script->read_count : most;
    for (uint32_t r = 0; r < count; r++)
        if (script->read[r].agent == agent && script->read[r].slot == slot)
            return true;
    return false;
}

/* __newindex of a view: queues a write of a neighbour's memory. */
static int view_newindex(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    JoxLua *lua = script->owner;
    const JoxView *view = check_view(L, script);
    const JoxAgents *a = lua->machines->agents;
    if (view->is_body || view->is_hidden)
        return luaL_error(L, view->is_body ? "a body has no memory"
                                           : "one who is out of sight is told by me.tell");
    const uint32_t i = view->index;
    const uint16_t machine = lua->before_machine[i];
    const JoxMachine *m = machine == JOX_NO_MACHINE ? NULL : lua->machines->set->items[machine];
    const int32_t slot = jox_field_slot(L, script, m, jox_field_find(script, lua_topointer(L, 2)));
    if (slot < 0)
        return luaL_error(L, "only the memory of a neighbour can be set, and '%s' is not in it",
                          jox_field_key(L));
    if (lua->write_count >= 100000)
        return luaL_error(L, "too much is written to neighbours in one step");
    if (jox_memory_is_list(&m->memory[slot]))
        return luaL_error(L, "a list of a neighbour cannot be set: tell it, by me.tell");
    double value = jox_view_check_memory(L, script, &m->memory[slot], 3);
    JOX_RESERVE(lua->writes, lua->write_capacity, lua->write_count + 1);
    const JoxPosition at = jox_vm_place(L);
    lua->writes[lua->write_count++] = (JoxWrite){.agent_id = a->id[i],
                                                 .slot = (uint32_t)slot,
                                                 .machine = machine,
                                                 .depends = has_read(script, i, (uint32_t)slot),
                                                 .file = at.file,
                                                 .line = at.line,
                                                 .value = value};
    return 0;
}

/* Makes a view, which is not valid yet, and pushes it. */
static JoxView *make_view(lua_State *L) {
    JoxView *view = lua_newuserdatauv(L, sizeof *view, 0);
    *view = (JoxView){.type = VIEW};
    luaL_setmetatable(L, VIEW);
    return view;
}

/* Calls share their first views: no view can be kept from one call to the next, as all that lasts
   is frozen. */
JoxView *jox_view_push(lua_State *L, JoxScript *script, uint32_t i) {
    const uint32_t n = script->view_count++;
    JoxView *view;
    if (n < JOX_VIEWS) {
        lua_rawgeti(L, -1, n + 1);
        view = script->view_objects[n];
    } else {
        view = make_view(L);
    }
    view->run = script->vm.run;
    view->index = i;
    view->is_body = view->is_hidden = false;
    return view;
}

void jox_view_push_somebody(lua_State *L, JoxScript *script, double who) {
    const JoxMachineRun *machines = script->owner->machines;
    const uint32_t i = jox_who_agent(machines, who);
    const int32_t row = jox_who_row(machines, who), place = jox_who_place(machines, who);
    if (i == JOX_NO_INDEX && row < 0) {
        if (place >= 0)
            lua_pushstring(L, machines->places[place].name);
        else
            lua_pushnil(L);
        return;
    }
    if (!script->machine->views) /* the state before the step was not kept */
        luaL_error(L, "write the name as such, not one that is put together");
    luaL_checkstack(L, 3, NULL);
    lua_rawgeti(L, LUA_REGISTRYINDEX, script->views);
    JoxView *view = jox_view_push(L, script, row >= 0 ? (uint32_t)row : i);
    view->is_body = row >= 0;
    view->is_hidden = row >= 0 ? !jox_sees_body(machines, script->agent, (uint32_t)row)
                               : !jox_sees_agent(machines, script->agent, i);
    lua_remove(L, -2);
}

/* ---- messages ---- */

/* Writes the keys of the table at a stack index to `keys`, ascending; returns how many. */
static uint32_t list_value_names(lua_State *L, int table, const char *keys[JOX_MOST_CARRIED]) {
    uint32_t count = 0;
    for (lua_pushnil(L); lua_next(L, table); count++) {
        lua_pop(L, 1);
        const char *key = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
        if (!key || lua_rawlen(L, -1) > 60)
            luaL_error(L, "values of a message have names of at most 60 bytes");
        if (strcmp(key, "sender") == 0)
            luaL_error(L, "`sender` is who told the message: give the value another name");
        if (count == JOX_MOST_CARRIED)
            luaL_error(L, "a message carries at most %d values", JOX_MOST_CARRIED);
        uint32_t at = count;
        for (; at > 0 && strcmp(keys[at - 1], key) > 0; at--)
            keys[at] = keys[at - 1];
        keys[at] = key;
    }
    return count;
}

/* Reads the values of a message from the table at a stack index, by ascending names. */
static void read_values(lua_State *L, JoxScript *script, int table, JoxMessage *message) {
    const char *keys[JOX_MOST_CARRIED];
    message->count = list_value_names(L, table, keys);
    for (uint32_t v = 0; v < message->count; v++) {
        lua_getfield(L, table, keys[v]);
        message->names[v] = jox_machines_name(script->owner->machines, keys[v]);
        if (lua_type(L, -1) == LUA_TBOOLEAN) {
            message->values[v] = lua_toboolean(L, -1);
        } else if (lua_type(L, -1) == LUA_TNUMBER && isfinite(lua_tonumber(L, -1))) {
            message->values[v] = lua_tonumber(L, -1);
        } else {
            message->values[v] = check_somebody(L, script, keys[v], -1);
            message->somebody |= 1u << v;
        }
        lua_pop(L, 1);
    }
}

/* Returns the number of the name of a message at a stack index. */
static uint32_t check_message_name(lua_State *L, JoxScript *script, int index) {
    if (script->vm.loading)
        luaL_error(L, "messages are told while the crowd runs");
    if (lua_type(L, index) != LUA_TSTRING || lua_rawlen(L, index) > 60 ||
        script->owner->machines->set->name_count > 10000)
        luaL_error(L, "a message has a name of at most 60 bytes, and there are not so many");
    jox_vm_charge(L, 50);
    return jox_machines_name(script->owner->machines, lua_tostring(L, index));
}

/* me.tell(whom, "name" [, { value = 1 }]): waits for its receiver from the next step on. */
int jox_me_tell(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    JoxMachineRun *machines = script->owner->machines;
    /* me:tell(whom, "name"), of which me.tell(me, "name") has the name second */
    const bool method =
        lua_touserdata(L, 1) == (void *)script->me_object && lua_type(L, 2) != LUA_TSTRING;
    const int at = method ? 2 : 1;
    lua_settop(L, at + 2);
    JoxMessage message = {.name = check_message_name(L, script, at + 1),
                          .from = machines->agents->id[script->agent],
                          .sent = machines->tick};
    const double who = check_somebody(L, script, "whom it is told", at);
    const uint32_t i = jox_who_agent(machines, who);
    if (lua_type(L, at + 2) == LUA_TTABLE)
        read_values(L, script, at + 2, &message);
    else if (!lua_isnil(L, at + 2))
        return luaL_error(L, "a message carries a table of values: { damage = 2 }");
    if (i == JOX_NO_INDEX) {
        jox_message_to_nobody(machines, message.name);
        return 0;
    }
    message.to = machines->agents->id[i];
    if (!jox_message_send(machines, &message))
        return luaL_error(L, "too many messages are told in one step");
    return 0;
}

/* me.told("name"): the oldest waiting message of that name, which is used up by it: its sender and
   its values; nil if none waits. */
int jox_me_told(lua_State *L) {
    JoxScript *script = jox_script_of(L);
    JoxMachineRun *machines = script->owner->machines;
    const int at = lua_touserdata(L, 1) == (void *)script->me_object ? 2 : 1; /* me:told(...) */
    const uint32_t name = check_message_name(L, script, at);
    const JoxMessage *message = jox_message_take(machines, script->agent, name);
    if (!message)
        return lua_pushnil(L), 1;
    lua_createtable(L, 0, (int)message->count + 1);
    for (uint32_t v = 0; v < message->count; v++) {
        if (message->somebody >> v & 1)
            jox_view_push_somebody(L, script, message->values[v]);
        else
            lua_pushnumber(L, message->values[v]);
        lua_setfield(L, -2, machines->set->names[message->names[v]]);
    }
    jox_view_push_somebody(L, script, 1.0 + message->from);
    lua_setfield(L, -2, "sender");
    return 1;
}

void jox_view_add_type(lua_State *L, const char *type, lua_CFunction index,
                       lua_CFunction newindex) {
    luaL_newmetatable(L, type);
    lua_pushcfunction(L, index);
    lua_setfield(L, -2, "__index");
    lua_pushcfunction(L, newindex);
    lua_setfield(L, -2, "__newindex");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_pop(L, 1);
}

void jox_views_open(JoxScript *script) {
    lua_State *L = script->vm.L;
    jox_view_add_type(L, VIEW, view_index, view_newindex);
    lua_createtable(L, JOX_VIEWS, 0);
    for (uint32_t n = 0; n < JOX_VIEWS; n++) {
        script->view_objects[n] = make_view(L);
        lua_rawseti(L, -2, n + 1);
    }
    script->views = luaL_ref(L, LUA_REGISTRYINDEX);
}
