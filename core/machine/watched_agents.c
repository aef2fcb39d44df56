/* Records for watched agents: the last transition, and what wrote their values. No step reads
   them. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "machine/machine_parts.h"

void jox_watch_due(const JoxMachineRun *run, const JoxTaken *due) {
    for (uint32_t n = 0; n < run->watched_count; n++)
        if (run->watched[n].agent_id == due->agent_id) {
            run->watched[n].due.length = 0;
            jox_machines_explain(run, due, &run->watched[n].due);
        }
}

void jox_watch_taken(const JoxMachineRun *run, const JoxTaken *taken) {
    const JoxMachine *machine = run->set->items[taken->machine];
    for (uint32_t n = 0; n < run->watched_count; n++) {
        JoxWatched *watched = &run->watched[n];
        if (watched->agent_id != taken->agent_id)
            continue;
        watched->took = true;
        watched->tick = run->tick;
        snprintf(watched->from, sizeof watched->from, "%s", machine->states[taken->from].name);
        snprintf(watched->to, sizeof watched->to, "%s", machine->states[taken->to].name);
        memset(watched->rolls, 0, sizeof watched->rolls);
        watched->why.length = 0;
        jox_text_add(&watched->why, watched->due.data);
    }
}

void jox_watch_roll(const JoxMachineRun *run, uint32_t i, uint32_t transition, double drawn) {
    for (uint32_t n = 0; n < run->watched_count; n++)
        if (run->watched[n].agent_id == run->agents->id[i])
            run->watched[n].rolls[transition] = (struct JoxRolled){true, run->tick, drawn};
}

void jox_machines_record_writer(JoxMachineRun *run, uint32_t i, const JoxWrote *wrote) {
    for (uint32_t n = 0; n < run->watched_count; n++) {
        JoxWatched *watched = &run->watched[n];
        uint32_t k = 0;
        if (watched->agent_id != run->agents->id[i])
            continue;
        while (k < watched->wrote_count && (watched->wrote[k].is_memory != wrote->is_memory ||
                                            watched->wrote[k].machine != run->agents->machine[i] ||
                                            watched->wrote[k].index != wrote->index))
            k++;
        if (k == watched->wrote_count) {
            JOX_RESERVE(watched->wrote, watched->wrote_capacity, k + 1);
            watched->wrote_count++;
        }
        watched->wrote[k] = *wrote;
        watched->wrote[k].machine = run->agents->machine[i];
        watched->wrote[k].tick = run->tick;
    }
}

/* Finds the transition or state that actions belong to. */
static JoxWrote find_writer(const JoxMachine *machine, const JoxActions *actions) {
    JoxWrote wrote = {.is_memory = true, .by = JOX_WROTE_STATE};
    for (uint32_t o = 0; o < machine->outer_count; o++)
        if (&machine->outer[o].enters == actions)
            wrote.state = (uint16_t)(machine->state_count + o);
    for (uint32_t s = 0; s < machine->state_count; s++) {
        const JoxState *state = &machine->states[s];
        if (&state->enters == actions)
            wrote.state = (uint16_t)s;
        for (uint32_t t = 0; t < state->transition_count; t++)
            if (&state->transitions[t].does == actions) {
                wrote.by = JOX_WROTE_TRANSITION;
                wrote.state = (uint16_t)s;
                wrote.transition = (uint16_t)t;
            }
    }
    return wrote;
}

void jox_watch_actions(JoxMachineRun *run, const JoxMachine *machine, const JoxActions *actions,
                       uint32_t i) {
    bool watched = false;
    for (uint32_t n = 0; n < run->watched_count; n++)
        watched |= run->watched[n].agent_id == run->agents->id[i];
    if (!watched || actions->set_count == 0)
        return;
    JoxWrote wrote = find_writer(machine, actions);
    for (uint32_t n = 0; n < actions->set_count; n++) {
        wrote.index = (uint16_t)actions->set[n].slot;
        jox_machines_record_writer(run, i, &wrote);
    }
}

void jox_watched_end(JoxWatched *watched) {
    jox_text_free(&watched->why);
    jox_text_free(&watched->due);
    jox_free(watched->wrote);
    jox_free(watched->came);
    jox_free(watched->overheard);
    *watched = (JoxWatched){0};
}
