/* Signals that agents give, the table of names that machines share, and the actions of entries and
   transitions. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/hash.h"
#include "base/mem.h"
#include "machine/machine_parts.h"

/* Returns the cell of a name in the hash table, or the empty cell where it belongs. */
static size_t find_name_cell(const JoxMachineSet *set, const char *name) {
    JoxHash hash = jox_hash_begin();
    jox_hash_add(&hash, name, strlen(name));
    size_t at = jox_hash_end(&hash) & (set->name_room - 1);
    while (set->name_table[at] && strcmp(set->names[set->name_table[at] - 1], name) != 0)
        at = (at + 1) & (set->name_room - 1);
    return at;
}

/* Grows the hash table so that at most a third is full. */
static void widen_table(JoxMachineSet *set) {
    if (3 * (size_t)set->name_count < set->name_room)
        return;
    jox_free(set->name_table);
    set->name_table = NULL;
    set->name_room = set->name_room ? 2 * set->name_room : 64;
    set->name_table = jox_alloc(set->name_room, sizeof *set->name_table);
    for (uint32_t n = 0; n < set->name_count; n++)
        set->name_table[find_name_cell(set, set->names[n])] = n + 1;
}

uint32_t jox_machines_name(JoxMachineRun *run, const char *name) {
    JoxMachineSet *set = run->set;
    widen_table(set);
    const size_t at = find_name_cell(set, name);
    if (set->name_table[at])
        return set->name_table[at] - 1;
    JOX_RESERVE(set->names, set->name_capacity, set->name_count + 1);
    set->names[set->name_count] = jox_strdup(name);
    set->name_table[at] = ++set->name_count;
    return set->name_count - 1;
}

void jox_machines_call(JoxMachineRun *run, uint32_t agent, uint32_t name) {
    const JoxAgents *a = run->agents;
    JOX_ASSERT(name < run->set->name_count && agent < a->count);
    JOX_RESERVE(run->state->called, run->state->called_capacity, run->state->called_count + 1);
    run->state->called[run->state->called_count++] =
        (JoxSignal){name, a->id[agent], a->x[agent], a->y[agent]};
}

void jox_machines_announce(JoxMachineRun *run, uint32_t name) {
    JOX_RESERVE(run->state->announced, run->state->announced_capacity,
                run->state->announced_count + 1);
    run->state->announced[run->state->announced_count++] = name;
}

/* Returns the name of the signal that the agent's state, or the outer state on a level, repeats in
   this step; -1: none. Entering gave the first one. */
static int32_t find_repeated_signal(const JoxMachineRun *run, const JoxMachine *machine, uint32_t i,
                                    uint32_t level) {
    const JoxState *state = &machine->states[run->agents->state[i]];
    const JoxState *on = jox_state_on_level(machine, state, level);
    if (!(on->signal_every > 0.0))
        return -1;
    const double time = jox_time_on_level(run, machine, i, level);
    return jox_is_interval_over(time, run->dt, on->signal_every) ? on->enters.signal : -1;
}

static bool repeats_signals(const JoxMachine *machine, const JoxState *state) {
    bool repeats = state->signal_every > 0.0;
    for (uint32_t l = 0; l < state->depth; l++)
        repeats |= machine->outer[state->around[l]].signal_every > 0.0;
    return repeats;
}

void jox_machines_repeat_signals(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    const JoxAgents *a = run->agents;
    s->list_count = 0;
    for (uint32_t b = 0; b < s->batch_count; b++) {
        const JoxBatchRange *batch = &s->batches[b];
        const JoxMachine *machine = run->set->items[batch->machine];
        const JoxState *state = &machine->states[batch->state];
        for (uint32_t n = 0; repeats_signals(machine, state) && n < batch->count; n++) {
            const uint32_t i = s->grouped[batch->begin + n];
            int32_t name = -1;
            for (uint32_t l = 0; name < 0 && l <= state->depth; l++)
                name = find_repeated_signal(run, machine, i, l);
            if (name >= 0)
                s->list[s->list_count++] = i;
        }
    }
    jox_sort_by_id(run, s->list, s->list_count);
    for (uint32_t n = 0; n < s->list_count; n++) {
        const uint32_t i = s->list[n];
        const JoxMachine *machine = jox_machine_of(run, i);
        for (uint32_t l = 0; l <= machine->states[a->state[i]].depth; l++) {
            const int32_t name = find_repeated_signal(run, machine, i, l);
            if (name >= 0)
                jox_machines_call(run, i, machine->names[name].number);
        }
    }
}

void jox_actions_do(JoxMachineRun *run, const JoxMachine *machine, const JoxActions *actions,
                    uint32_t i) {
    JoxAgents *a = run->agents;
    double values[JOX_MOST_SET];
    JOX_ASSERT(actions->set_count <= JOX_MOST_SET);
    const uint32_t first_sent = run->state->sent_count;
    if (actions->tell)
        jox_tell(run, machine, actions->tell, i);
    for (uint32_t n = 0; n < actions->set_count; n++)
        values[n] = actions->set[n].target >= 0
                        ? jox_target_draw_who(run, i, actions->set[n].target,
                                              1 + (uint32_t)actions->set[n].slot)
                        : jox_value(run, machine, &actions->set[n].value, i);
    for (uint32_t n = 0; n < actions->set_count; n++) {
        const struct JoxAssign *assign = &actions->set[n];
        double *memory = a->memory + (size_t)i * a->memory_stride;
        if (!isfinite(values[n]))
            jox_odd_note(run, i, JOX_ACTION_MEMORY + assign->slot, &assign->value, values[n]);
        else if (assign->change != JOX_LIST_NONE)
            jox_list_change(run, machine, memory, assign->slot, assign->change, values[n]);
        else
            memory[assign->slot] = values[n];
    }
    jox_sightings_note_agent(run, i);
    if (run->watched_count)
        jox_watch_actions(run, machine, actions, i);
    if (run->traces && a->id[i] == run->trace_id)
        jox_trace_actions(run, machine, actions, i, first_sent);
    if (actions->sets_team)
        a->team[i] = actions->team;
    if (actions->sets_tags)
        a->tags[i] = actions->tags;
    if (actions->signal >= 0)
        jox_machines_call(run, i, machine->names[actions->signal].number);
}
