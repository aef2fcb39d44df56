/* Transitions of the last second, counted for the live page. */
#include "base/mem.h"
#include "live/live_parts.h"

static bool same_machines(const JoxLive *live, const JoxMind *mind) {
    bool same = live->machine_count == mind->machine_count;
    for (uint32_t m = 0; same && m < mind->machine_count; m++)
        same = live->machines[m] == mind->machines[m];
    return same;
}

/* Numbers the transitions of all machines; those that were counted under other numbers are
   forgotten. */
static void number_transitions(JoxLive *live, const JoxMind *mind) {
    for (uint32_t m = 0; m < live->machine_count; m++)
        jox_free(live->state_begins[m]);
    live->machine_count = mind->machine_count;
    live->count = 0;
    for (uint32_t m = 0; m < mind->machine_count; m++) {
        const JoxMachine *machine = mind->machines[m];
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

static void push_taken(JoxLive *live, JoxLiveTaken taken) {
    if (live->count == live->capacity) { /* a ring: straightened when it grows */
        uint32_t wider = live->capacity ? 2 * live->capacity : 256;
        JoxLiveTaken *ring = jox_alloc(wider, sizeof *ring);
        for (uint32_t n = 0; n < live->count; n++)
            ring[n] = live->taken[(live->first + n) % live->capacity];
        jox_free(live->taken);
        live->taken = ring;
        live->capacity = wider;
        live->first = 0;
    }
    live->taken[(live->first + live->count++) % live->capacity] = taken;
    live->fired[taken.which]++;
}

void jox_live_renumber(JoxLive *live, const JoxMind *mind) {
    if (!same_machines(live, mind) || !live->fired)
        number_transitions(live, mind);
}

void jox_live_count(JoxLive *live, const JoScene *scene) {
    const JoWorld *world = scene->world;
    const JoxMind *mind = &world->mind;
    jox_live_renumber(live, mind);
    if (live->noted == world->tick)
        return;
    live->noted = world->tick;
    const uint64_t second = (uint64_t)(1.0 / world->def.dt + 0.5);
    while (live->count && live->taken[live->first].tick + second <= world->tick) {
        live->fired[live->taken[live->first].which]--;
        live->first = (live->first + 1) % live->capacity;
        live->count--;
    }
    for (uint32_t n = 0; n < mind->taken_count; n++) {
        const JoxTaken *taken = &mind->taken[n];
        const uint32_t which = live->state_begins[taken->machine][taken->from] + taken->transition;
        push_taken(live, (JoxLiveTaken){world->tick, which});
    }
}
