/* Sections of the machines' state, for hashing, saving and restoring; and overwriting the
   scratch. */
#include <string.h>

#include "machine/machine_parts.h"

static void hash_text(JoxHash *hash, const char *text) {
    jox_hash_add(hash, text, strlen(text) + 1);
}

/* Hashes the layout of a machine's columns: names of states, transitions, own values and memory.
   Parameters and conditions may differ between runs that share state. */
static uint64_t hash_shape(const JoxMachine *machine) {
    JoxHash hash = jox_hash_begin();
    hash_text(&hash, machine->name);
    for (uint32_t s = 0; s < machine->state_count; s++) {
        hash_text(&hash, machine->states[s].name);
        for (uint32_t k = 0; k < machine->states[s].transition_count; k++)
            hash_text(&hash, machine->states[s].transitions[k].id);
    }
    jox_hash_add(&hash, &machine->own_count, sizeof machine->own_count);
    for (uint32_t o = 0; o < machine->own_count; o++)
        hash_text(&hash, machine->own[o].name);
    jox_hash_add(&hash, &machine->memory_count, sizeof machine->memory_count);
    for (uint32_t m = 0; m < machine->memory_count; m++)
        hash_text(&hash, machine->memory[m].dormant ? machine->memory[m].identity
                                                    : machine->memory[m].name);
    return jox_hash_end(&hash);
}

static void list_count_sections(JoxMachineCounts *counts, JoxSections *s) {
    jox_section(s, "taken", counts->taken, sizeof *counts->taken, counts->taken_count);
    jox_section(s, "spent", counts->states, sizeof *counts->states, counts->state_count);
    JOX_SECTION(s, "since", counts->since);
    size_t count = jox_section_count(s, "before", counts->before_count, sizeof *counts->taken);
    if (s->mode == JOX_SECTIONS_RESTORE) {
        JOX_RESERVE_ZEROED(counts->before, counts->before_capacity, count);
        for (size_t b = count; b < counts->before_count; b++) {
            jox_free(counts->before[b].from);
            jox_free(counts->before[b].to);
            counts->before[b] = (struct JoxTakenBefore){0};
        }
        counts->before_count = (uint32_t)count;
    }
    for (size_t b = 0; b < count; b++) {
        jox_section_string(s, "before_from", &counts->before[b].from);
        jox_section_string(s, "before_to", &counts->before[b].to);
        JOX_SECTION(s, "before_taken", counts->before[b].taken);
    }
}

/* Reports restored state that refers to machines, states or names that do not exist. */
static void check_restored(const JoxMachineRun *run, JoxSections *s) {
    const char *fault = jox_states_fault(run);
    if (fault)
        jox_sections_fail(s, "state", fault);
    fault = jox_edits_fault(run);
    if (fault)
        jox_sections_fail(s, "edits", fault);
    fault = jox_signals_fault(run);
    if (fault)
        jox_sections_fail(s, "called", fault);
}

/* Gives names the numbers of a restored state, and numbers those after them that it lacks. A
   process that loads other versions of behaviours numbers names in another order, and functions add
   some. */
static void restore_names(JoxMachineRun *run, char *const *names, size_t count) {
    JoxMachineSet *set = run->set;
    char **old = set->names;
    const uint32_t old_count = set->name_count;
    jox_free(set->name_table);
    set->names = NULL;
    set->name_table = NULL;
    set->name_count = 0;
    set->name_capacity = set->name_room = 0;
    for (size_t n = 0; n < count; n++)
        jox_machines_name(run, names[n]);
    for (uint32_t n = 0; n < old_count; n++)
        jox_machines_name(run, old[n]);
    for (uint32_t m = 0; m < set->count; m++)
        jox_machine_number_names(run, set->built[m]);
    for (uint32_t n = 0; n < old_count; n++)
        jox_free(old[n]);
    jox_free(old);
}

/* Lists the names by number. */
static void list_names(JoxMachineRun *run, JoxSections *s) {
    JoxMachineSet *set = run->set;
    const bool restores = s->mode == JOX_SECTIONS_RESTORE;
    const size_t count = jox_section_count(s, "names", set->name_count, 1);
    char **names = restores ? jox_alloc(count + 1, sizeof *names) : set->names;
    bool whole = true;
    for (size_t n = 0; n < count && !s->failed; n++) {
        jox_section_string(s, "name", &names[n]);
        whole &= names[n] != NULL;
    }
    if (!restores)
        return;
    if (whole && !s->failed)
        restore_names(run, names, count);
    for (size_t n = 0; n < count; n++)
        jox_free(names[n]);
    jox_free(names);
}

void jox_machines_sections(JoxMachineRun *run, JoxSections *s) {
    JoxMachineSet *set = run->set;
    JoxMachineState *state = run->state;
    jox_sections_module(s, "machines");
    jox_section_model(s, "count", set->count);
    for (uint32_t m = 0; m < set->count; m++)
        jox_section_model(s, set->built[m]->name, hash_shape(set->built[m]));
    JOX_SECTION(s, "tick", run->tick);
    JOX_SECTION_ARRAY(s, "called", state->called, state->called_count, state->called_capacity);
    JOX_SECTION_ARRAY(s, "announced", state->announced, state->announced_count,
                      state->announced_capacity);
    JOX_SECTION_ARRAY(s, "pending", state->pending, state->pending_count, state->pending_capacity);
    JOX_SECTION_ARRAY(s, "sent", state->sent, state->sent_count, state->sent_capacity);
    JOX_SECTION_ARRAY(s, "waiting", state->waiting, state->waiting_count, state->waiting_capacity);
    JOX_SECTION_ARRAY(s, "thrown", state->thrown, state->thrown_count, state->thrown_capacity);
    JOX_SECTION_ARRAY(s, "edits", state->edits, state->edit_count, state->edit_capacity);
    for (uint32_t m = 0; run->hook_sections && m < set->count; m++)
        run->hook_sections(run->call_context, set->built[m], s);
    jox_sections_module(s, "machines");
    jox_sections_unhashed(s, true);
    list_names(run, s);
    for (uint32_t m = 0; m < set->count; m++)
        list_count_sections(&state->counts[m], s);
    JOX_SECTION_ARRAY(s, "calls", state->calls, state->call_count, state->call_capacity);
    JOX_SECTION_ARRAY(s, "tallies", state->tallies, state->tally_count, state->tally_capacity);
    JOX_SECTION(s, "messages_lost", state->messages_lost);
    JOX_SECTION(s, "messages_unasked", state->messages_unasked);
    JOX_SECTION(s, "messages_to_nobody", state->messages_to_nobody);
    JOX_SECTION(s, "hook_failures", state->hook_failures);
    JOX_SECTION(s, "changes_lost", state->changes_lost);
    jox_sections_unhashed(s, false);
    if (s->mode != JOX_SECTIONS_RESTORE)
        return;
    if (!s->failed)
        check_restored(run, s);
    for (uint32_t m = 0; m < set->count && !s->failed; m++)
        jox_edits_apply(run, m);
}

void jox_machines_forget(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    uint32_t n = s ? s->capacity : 0;
    run->taken_count = run->kick_count = run->grip_count = 0;
    if (n == 0)
        return;
    jox_gatherings_forget(s);
    s->batch_count = s->list_count = s->heard_count = s->everywhere_count = 0;
    struct {
        void *cells;
        size_t size;
    } all[] = {{s->grouped, sizeof *s->grouped}, {s->in_state, sizeof *s->in_state},
               {s->fired, sizeof *s->fired},     {s->reacts, sizeof *s->reacts},
               {s->rank, sizeof *s->rank},       {s->queue, sizeof *s->queue},
               {s->list, sizeof *s->list},       {run->push_on, 1},
               {run->push_nearest, 1},           {run->push_toward_x, 4},
               {run->push_toward_y, 4}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        memset(all[k].cells, 0xa5, n * all[k].size);
    if (s->heading)
        memset(s->heading, 0xa5, s->heading_capacity * sizeof *s->heading);
    if (s->place_capacity)
        memset(s->place_people, 0xa5, s->place_capacity * sizeof *s->place_people);
}
