/* Names of states in tests, and the number of agents in each. scene_methods.c calls it. */
#include "luatest/luatest_parts.h"

#include "base/format/name.h"

const char *jox_test_check_state(lua_State *L, const JoxMachineRun *machines, int index) {
    const char *name = luaL_checkstring(L, index), *names[256];
    size_t count = 0;
    const char *whole = NULL; /* name of a state of a nested machine, without that of the outer */
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        for (uint32_t s = 0; s < machine->state_count; s++) {
            if (jox_state_is_in(&machine->states[s], name))
                return name;
            if (!whole && jox_state_answers(&machine->states[s], name))
                whole = machine->states[s].name;
            if (count < 256)
                names[count++] = machine->states[s].name;
        }
        for (uint32_t o = 0; o < machine->outer_count && count < 256; o++)
            names[count++] = machine->outer[o].name;
    }
    const char *near = whole ? whole : jox_suggest(name, names, count);
    luaL_error(L, "no machine of the scene has a state '%s'%s%s", name,
               near ? "; did you mean " : "", near ? near : "");
    return NULL;
}

uint32_t jox_test_count_in_state(const JoxMachineRun *machines, const char *state, int32_t group) {
    const JoxAgents *a = machines->agents;
    uint32_t count = 0;
    for (uint32_t i = 0; i < a->count; i++)
        count +=
            (group < 0 || a->group[i] == group) &&
            (!state ||
             (a->machine[i] != JOX_NO_MACHINE &&
              jox_state_is_in(&machines->set->items[a->machine[i]]->states[a->state[i]], state)));
    return count;
}

/* Returns whether one of the first `count` machines has a state of this whole name. */
static bool is_state_counted(const JoxMachineRun *machines, uint32_t count, const char *name) {
    for (uint32_t m = 0; m < count; m++)
        if (jox_machine_state(machines->set->items[m], name) >= 0)
            return true;
    return false;
}

uint32_t jox_test_count_without(const JoxMachineRun *machines, const char *state, int32_t group) {
    const JoxAgents *a = machines->agents;
    uint32_t count = 0;
    for (uint32_t i = 0; i < a->count; i++)
        count += (group < 0 || a->group[i] == group) &&
                 (a->machine[i] == JOX_NO_MACHINE ||
                  jox_machine_entry(machines->set->items[a->machine[i]], state) < 0);
    return count;
}

void jox_test_push_counts(lua_State *L, const JoxMachineRun *machines, int32_t group) {
    JoxText text = {0};
    for (uint32_t m = 0; m < machines->set->count; m++)
        for (uint32_t s = 0; s < machines->set->items[m]->state_count; s++) {
            const char *name = machines->set->items[m]->states[s].name;
            uint32_t people = jox_test_count_in_state(machines, name, group);
            if (people && !is_state_counted(machines, m, name))
                jox_text_printf(&text, "%s%s %u", text.length ? ", " : "", name, people);
        }
    lua_pushstring(L, text.length ? text.data : "nobody is left");
    jox_text_free(&text);
}
