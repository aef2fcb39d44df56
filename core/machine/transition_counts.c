/* Statistics of a machine over all its versions: how often transitions were taken, and how long
   agents were in its states. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "machine/machine_parts.h"

void jox_counts_begin(JoxMachineCounts *counts, const JoxMachine *machine, uint32_t tick) {
    uint32_t count = 0;
    for (uint32_t s = 0; s < machine->state_count; s++) {
        JOX_ASSERT(machine->states[s].first_transition == count);
        count += machine->states[s].transition_count;
    }
    JOX_RESERVE(counts->taken, counts->taken_capacity, count);
    if (count)
        memset(counts->taken, 0, count * sizeof *counts->taken);
    counts->taken_count = count;
    JOX_RESERVE(counts->states, counts->state_capacity, machine->state_count);
    memset(counts->states, 0, machine->state_count * sizeof *counts->states);
    counts->state_count = machine->state_count;
    counts->since = tick;
}

enum { LOOKED_AT = 16 }; /* steps between two samples of perception */

/* Returns the greatest perception in a batch, m. */
static float find_greatest_perception(const JoxMachineRun *run, const JoxBatchRange *batch) {
    const JoxParameterColumn perception = run->agents->param[JOX_PARAM_perception];
    const uint32_t *agents = run->scratch->grouped + batch->begin;
    float sight = 0.0f;
    for (uint32_t n = 0; n < batch->count; n++)
        sight = jox_maxf(sight, jox_at(perception, agents[n]));
    return sight;
}

void jox_counts_spend(JoxMachineRun *run) {
    const JoxMachineScratch *s = run->scratch;
    for (uint32_t b = 0; b < s->batch_count; b++) {
        const JoxBatchRange *batch = &s->batches[b];
        JoxStateCounts *counts = &run->state->counts[batch->machine].states[batch->state];
        counts->spent += batch->count;
        counts->steps +=
            b == 0 || batch[-1].machine != batch->machine || batch[-1].state != batch->state;
        if (run->tick % LOOKED_AT == 0)
            counts->sight = fmax(counts->sight, (double)find_greatest_perception(run, batch));
    }
}

void jox_counts_add_before(JoxMachineCounts *counts, const char *from, const char *to,
                           uint64_t taken) {
    for (uint32_t b = 0; b < counts->before_count; b++)
        if (!strcmp(counts->before[b].from, from) && !strcmp(counts->before[b].to, to)) {
            counts->before[b].taken += taken;
            return;
        }
    JOX_RESERVE(counts->before, counts->before_capacity, counts->before_count + 1);
    counts->before[counts->before_count++] =
        (struct JoxTakenBefore){jox_strdup(from), jox_strdup(to), taken};
}

void jox_counts_free(JoxMachineCounts *counts) {
    for (uint32_t b = 0; b < counts->before_count; b++) {
        jox_free(counts->before[b].from);
        jox_free(counts->before[b].to);
    }
    jox_free(counts->before);
    jox_free(counts->taken);
    jox_free(counts->states);
    *counts = (JoxMachineCounts){0};
}

/* Returns how often older versions went from one state to another. */
static uint64_t find_old_count(const JoxMachineCounts *counts, const char *from, const char *to) {
    for (uint32_t b = 0; b < counts->before_count; b++)
        if (!strcmp(counts->before[b].from, from) && !strcmp(counts->before[b].to, to))
            return counts->before[b].taken;
    return 0;
}

/* Returns whether this version has a transition between two states. */
static bool has_transition(const JoxMachine *machine, const char *from, const char *to) {
    int state = jox_machine_state(machine, from);
    for (uint32_t k = 0; state >= 0 && k < machine->states[state].transition_count; k++)
        if (!strcmp(jox_transition_leads_to(machine, &machine->states[state].transitions[k]), to))
            return true;
    return false;
}

void jox_machines_taken(const JoxMachineRun *run, uint32_t index, JoxTakenVisit *visit,
                        void *context) {
    const JoxMachine *machine = run->set->items[index];
    const JoxMachineCounts *counts = &run->state->counts[index];
    for (uint32_t s = 0; s < machine->state_count; s++) {
        const JoxState *from = &machine->states[s];
        for (uint32_t k = 0; k < from->transition_count; k++) {
            if (from->transitions[k].stays)
                continue;
            const char *to = jox_transition_leads_to(machine, &from->transitions[k]);
            uint64_t sum = find_old_count(counts, from->name, to);
            bool first = true;
            for (uint32_t o = 0; o < from->transition_count; o++)
                if (!from->transitions[o].stays &&
                    from->transitions[o].to == from->transitions[k].to &&
                    from->transitions[o].back == from->transitions[k].back) {
                    first &= o >= k;
                    sum += counts->taken[from->first_transition + o];
                }
            if (first) /* several transitions may lead to the same state */
                visit(context, from->name, to, sum);
        }
    }
    for (uint32_t b = 0; b < counts->before_count; b++)
        if (!has_transition(machine, counts->before[b].from, counts->before[b].to))
            visit(context, counts->before[b].from, counts->before[b].to, counts->before[b].taken);
}
