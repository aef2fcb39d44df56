/* Verbs that act on agents. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "world/turn_chests.h"
#include "world/verbs/verb_functions.h"
#include "world/world.h"

enum { MOST_NAMES = 256 };

/* Returns the index of a live agent by its id, or JOX_NO_INDEX with a sentence in `why`. */
static uint32_t find_live_agent(const JoWorld *world, uint32_t id, JoxText *why) {
    const JoxAgents *a = &world->state.agents;
    uint32_t i = jox_agents_find(a, id);
    if (i != JOX_NO_INDEX)
        return i;
    if (id < a->next_id)
        jox_text_printf(why, "agent %u has left", id);
    else
        jox_text_printf(why, "there is no agent %u; ids go up to %u", id,
                        a->next_id ? a->next_id - 1 : 0);
    return JOX_NO_INDEX;
}

/* Returns whether a part of the machine was renamed, with a sentence in `why`. */
static bool is_renamed(const JoxMachine *machine, JoxPart part, const char *name, JoxText *why) {
    const char *now = jox_machine_renamed(machine, part, name);
    if (now)
        jox_text_printf(why, "'%.60s' of %.60s is called '%.60s' now", name, machine->name, now);
    return now != NULL;
}

/* Returns the machine of an agent; NULL with a sentence if it has none. */
static const JoxMachine *get_machine(const JoWorld *world, uint32_t i, JoxText *why) {
    const JoxAgents *a = &world->state.agents;
    if (a->machine[i] != JOX_NO_MACHINE)
        return world->model.machines.items[a->machine[i]];
    jox_text_printf(why, "agent %u has no behaviour", a->id[i]);
    return NULL;
}

/* Sets what machines read to the state of the coming step. */
static void update_machines(JoWorld *world) {
    world->machines.tick = (uint32_t)world->state.tick;
    world->machines.places = world->model.places;
    world->machines.place_count = world->model.place_count;
}

bool jox_perform_push(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    JoxAgents *a = &world->state.agents;
    uint32_t i = find_live_agent(world, entry->number, why);
    if (i == JOX_NO_INDEX)
        return false;
    a->ext_x[i] += (float)entry->numbers[0];
    a->ext_y[i] += (float)entry->numbers[1];
    return true;
}

/* A log may name players that have not entered yet, but none that has left. */
bool jox_perform_player(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    const bool to_come = entry->line != 0 && entry->number >= world->state.agents.next_id;
    if (!to_come && find_live_agent(world, entry->number, why) == JOX_NO_INDEX)
        return false;
    jox_input_set_player(&world->state.input, entry->number, (float)entry->numbers[0],
                         (float)entry->numbers[1], entry->given > 2 && entry->numbers[2] > 0.5);
    return true;
}

bool jox_perform_spawn(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    const char *names[MOST_NAMES];
    uint32_t count = 0;
    for (uint32_t g = 0; g < world->model.group_count; g++) {
        const JoxGroup *group = &world->model.groups[g];
        if (count < MOST_NAMES)
            names[count++] = group->name;
        if (strcmp(group->name, entry->names[0]) != 0)
            continue;
        for (uint32_t s = 0; s < group->set_count; s++)
            if (group->set[s].kind == JOX_SET_ANTIPODE) {
                jox_text_printf(why,
                                "who is of '%.60s' is bound for the point opposite to where "
                                "it begins: nobody can be added",
                                group->name);
                return false;
            }
        const JoxV2 at = {(float)entry->numbers[0], (float)entry->numbers[1]};
        uint32_t agent = JOX_NO_INDEX;
        const JoxBirthSpot spot = jox_world_spawn_at(world, g, at, &agent);
        if (agent != JOX_NO_INDEX) {
            JOX_ASSERT(agent + 1 == world->state.agents.count);
            jox_world_turn_newcomers(world, agent);
            return true;
        }
        world->state.statistics.not_placed++;
        jox_world_explain_unplaced(&world->model.storeys, spot, at, why);
        return false;
    }
    return jox_event_refuse_name("group", entry->names[0], names, count, why);
}

bool jox_perform_remove(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    uint32_t i = find_live_agent(world, entry->number, why);
    if (i == JOX_NO_INDEX)
        return false;
    world->state.agents.removed[i] = 1;
    world->state.statistics.removed += jox_agents_compact(&world->state.agents);
    return true;
}

bool jox_perform_teleport(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    JoxAgents *a = &world->state.agents;
    const JoxV2 wanted = {(float)entry->numbers[0], (float)entry->numbers[1]};
    JoxV2 at = wanted;
    uint32_t i = find_live_agent(world, entry->number, why);
    if (i == JOX_NO_INDEX)
        return false;
    jox_world_apply_walls(world);
    const JoxBirthSpot spot = jox_nav_free_spot(world->scratch.nav, a, i, &at);
    if (!jox_birth_succeeds(spot)) {
        jox_world_explain_unplaced(&world->model.storeys, spot, wanted, why);
        return false;
    }
    a->x[i] = a->prev_x[i] = a->still_x[i] = at.x;
    a->y[i] = a->prev_y[i] = a->still_y[i] = at.y;
    jox_agents_wrap(a, i);
    a->vx[i] = a->vy[i] = a->next_x[i] = a->next_y[i] = 0.0f;
    a->still[i] = a->displaced_x[i] = a->displaced_y[i] = a->settled[i] = 0.0f;
    jox_nav_invalidate_order(world->scratch.nav); /* the order in memory no longer follows space */
    return true;
}

bool jox_perform_goal(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    JoxAgents *a = &world->state.agents;
    uint32_t i = find_live_agent(world, entry->number, why);
    const JoxMachine *machine = i == JOX_NO_INDEX ? NULL : get_machine(world, i, why);
    if (!machine)
        return false;
    int place = jox_place_find(world->model.places, world->model.scene_places, entry->names[0]);
    if (place < 0) {
        const char *names[MOST_NAMES];
        uint32_t count = 0;
        for (uint32_t p = 0; p < world->model.scene_places && count < MOST_NAMES; p++)
            names[count++] = world->model.places[p].name;
        return jox_event_refuse_name("place", entry->names[0], names, count, why);
    }
    update_machines(world);
    a->goal[i] = place;
    for (uint32_t s = 0; s < machine->own_count; s++)
        if (machine->own[s].is_place && strcmp(machine->own[s].name, "goal") == 0)
            jox_machines_set_own(&world->machines, i, s, place);
    return true;
}

bool jox_perform_state(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    uint32_t i = find_live_agent(world, entry->number, why);
    const JoxMachine *machine = i == JOX_NO_INDEX ? NULL : get_machine(world, i, why);
    if (!machine)
        return false;
    int state = jox_machine_entry(machine, entry->names[0]);
    if (state >= 0) {
        update_machines(world);
        jox_machines_set_state(&world->machines, i, (uint16_t)state);
        if (world->state.agents.removed[i]) /* a state in which agents leave */
            world->state.statistics.removed += jox_agents_compact(&world->state.agents);
        return true;
    }
    const char *names[MOST_NAMES];
    uint32_t count = 0;
    for (uint32_t s = 0; s < machine->state_count && count < MOST_NAMES; s++)
        names[count++] = machine->states[s].name;
    char kind[100];
    snprintf(kind, sizeof kind, "state of %.60s named", machine->name);
    return !is_renamed(machine, JOX_PART_STATE, entry->names[0], why) &&
           jox_event_refuse_name(kind, entry->names[0], names, count, why);
}

bool jox_perform_memory(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    const JoxAgents *a = &world->state.agents;
    uint32_t i = find_live_agent(world, entry->number, why);
    const JoxMachine *machine = i == JOX_NO_INDEX ? NULL : get_machine(world, i, why);
    if (!machine)
        return false;
    const char *names[MOST_NAMES];
    uint32_t count = 0;
    const double value = entry->numbers[0];
    for (uint32_t s = 0; s < machine->memory_count; s++) {
        const JoxMemorySlot *slot = &machine->memory[s];
        if (*slot->name && count < MOST_NAMES)
            names[count++] = slot->name;
        if (!*slot->name || strcmp(slot->name, entry->names[0]) != 0)
            continue;
        if (slot->kind == JOX_MEMORY_BOOLEAN && value != 0.0 && value != 1.0) {
            jox_text_printf(why, "%.60s is true or false: 1 or 0, not %g", slot->name, value);
            return false;
        }
        if (jox_memory_is_list(slot)) {
            jox_text_printf(why, "%.60s is a list, which a program cannot set", slot->name);
            return false;
        }
        if (slot->kind == JOX_MEMORY_SOMEBODY && value != JOX_NOBODY &&
            !jox_who_exists(&world->machines, value)) {
            jox_text_printf(why,
                            "%.60s holds somebody: 1 + the id of an agent, or 0 for nobody; %.15g "
                            "is nobody in the world",
                            slot->name, value);
            return false;
        }
        a->memory[(size_t)i * a->memory_stride + s] = value;
        jox_machines_record_writer(
            &world->machines, i,
            &(JoxWrote){.is_memory = true, .index = (uint16_t)s, .by = JOX_WROTE_PROGRAM});
        return true;
    }
    return !is_renamed(machine, JOX_PART_MEMORY, entry->names[0], why) &&
           jox_event_refuse_name("memory named", entry->names[0], names, count, why);
}

bool jox_perform_parameter(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    JoxAgents *a = &world->state.agents;
    uint32_t i = find_live_agent(world, entry->number, why);
    if (i == JOX_NO_INDEX)
        return false;
    const int p = jox_parameter_find(entry->names[0]);
    if (p < 0) {
        const char *names[JOX_PARAM_COUNT];
        const char *successor = jox_parameter_successor(entry->names[0]);
        if (successor) {
            jox_text_printf(why, "there is no parameter '%s'. %s", entry->names[0], successor);
            return false;
        }
        for (int n = 0; n < JOX_PARAM_COUNT; n++)
            names[n] = jox_parameters[n].name;
        return jox_event_refuse_name("parameter", entry->names[0], names, JOX_PARAM_COUNT, why);
    }
    const JoxParameterInfo *info = &jox_parameters[p];
    const double value = entry->numbers[0];
    if (!(value >= info->least && value <= info->greatest)) {
        jox_text_printf(why, "%s must be from %g to %g%s%s, not %g", info->name, info->least,
                        info->greatest, *info->unit ? " " : "", info->unit, value);
        return false;
    }
    jox_param_set(a, p, i, jox_parameter_store((JoxParameter)p, value));
    jox_nav_end_births(world->scratch.nav); /* it may be wider now */
    if (a->machine[i] == JOX_NO_MACHINE)
        return true;
    update_machines(world);
    const JoxMachine *machine = world->model.machines.items[a->machine[i]];
    for (uint32_t s = 0; s < machine->own_count; s++)
        if (strcmp(machine->own[s].name, info->name) == 0)
            jox_machines_set_own(&world->machines, i, s, value);
    jox_machines_record_writer(&world->machines, i,
                               &(JoxWrote){.index = (uint16_t)p, .by = JOX_WROTE_PROGRAM});
    return true;
}
