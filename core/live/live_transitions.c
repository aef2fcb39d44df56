/* Counts of the transitions taken in the last second, for the status message. */
#include "base/assert.h"
#include "base/mem.h"
#include "live/live_parts.h"

static bool has_numbered_machines(const JoxLive *live, const JoxMachineRun *machines) {
    bool same = live->machine_count == machines->set->count;
    for (uint32_t m = 0; same && m < machines->set->count; m++)
        same = live->machines[m] == machines->set->items[m];
    return same;
}

/* Numbers the transitions of all machines in one sequence, and drops the counts, which have the old
   numbers. */
static void number_transitions(JoxLive *live, const JoxMachineRun *machines) {
    for (uint32_t m = 0; m < live->machine_count; m++)
        jox_free(live->state_begins[m]);
    live->machine_count = machines->set->count;
    live->count = 0;
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        live->machines[m] = machine;
        live->state_begins[m] = jox_alloc(machine->state_count + 1, sizeof(uint32_t));
        uint32_t number = live->begins[m];
        for (uint32_t s = 0; s < machine->state_count; s++) {
            live->state_begins[m][s] = number;
            number += machine->states[s].transition_count;
        }
        live->state_begins[m][machine->state_count] = live->begins[m + 1] = number;
    }
    jox_free(live->fired);
    live->fired = jox_alloc(live->begins[live->machine_count] + 1, sizeof *live->fired);
}

static void count_taken_transition(JoxLive *live, JoxLiveTaken taken) {
    if (live->count == live->capacity) { /* copied in order, so that the new ring begins at 0 */
        uint32_t wider = live->capacity ? 2 * live->capacity : 256;
        JoxLiveTaken *ring = jox_alloc(wider, sizeof *ring);
        for (uint32_t n = 0; n < live->count; n++)
            ring[n] = live->taken[(live->first + n) % live->capacity];
        jox_free(live->taken);
        live->taken = ring;
        live->capacity = wider;
        live->first = 0;
    }
    JOX_ASSERT(live->count < live->capacity &&
               taken.transition < live->begins[live->machine_count]);
    live->taken[(live->first + live->count++) % live->capacity] = taken;
    live->fired[taken.transition]++;
}

void jox_live_number_transitions(JoxLive *live, const JoxMachineRun *machines) {
    if (!has_numbered_machines(live, machines) || !live->fired)
        number_transitions(live, machines);
}

void jox_live_count_transitions(JoxLive *live, const JoScene *scene) {
    const JoWorld *world = scene->world;
    const JoxMachineRun *machines = &world->machines;
    jox_live_number_transitions(live, machines);
    if (live->counted_tick == world->state.tick)
        return;
    live->counted_tick = world->state.tick;
    const uint64_t second = (uint64_t)(1.0 / world->model.def.dt + 0.5);
    while (live->count && live->taken[live->first].tick + second <= world->state.tick) {
        JOX_ASSERT(live->fired[live->taken[live->first].transition] > 0);
        live->fired[live->taken[live->first].transition]--;
        live->first = (live->first + 1) % live->capacity;
        live->count--;
    }
    for (uint32_t n = 0; n < machines->taken_count; n++) {
        const JoxTaken *taken = &machines->taken[n];
        JOX_ASSERT(taken->machine < live->machine_count &&
                   taken->from < live->machines[taken->machine]->state_count);
        const uint32_t number = live->state_begins[taken->machine][taken->from] + taken->transition;
        count_taken_transition(live, (JoxLiveTaken){world->state.tick, number});
    }
}
