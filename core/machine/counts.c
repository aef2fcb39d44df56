/* How often transitions were taken, over all versions of a machine that ran. */
#include <string.h>

#include "base/mem.h"
#include "machine/internal.h"

void jox_machine_add_before(JoxMachine *machine, const char *from, const char *to, uint64_t taken) {
    for (uint32_t b = 0; b < machine->before_count; b++)
        if (!strcmp(machine->before[b].from, from) && !strcmp(machine->before[b].to, to)) {
            machine->before[b].taken += taken;
            return;
        }
    machine->before =
        jox_realloc(machine->before, machine->before_count + 1, sizeof *machine->before);
    machine->before[machine->before_count++] =
        (JoxTakenBefore){jox_strdup(from), jox_strdup(to), taken};
}

void jox_machine_carry_before(const JoxMachine *old, JoxMachine *next) {
    for (uint32_t b = 0; b < old->before_count; b++)
        jox_machine_add_before(next, old->before[b].from, old->before[b].to, old->before[b].taken);
}

/* What older versions counted between two states. */
static uint64_t before(const JoxMachine *machine, const char *from, const char *to) {
    for (uint32_t b = 0; b < machine->before_count; b++)
        if (!strcmp(machine->before[b].from, from) && !strcmp(machine->before[b].to, to))
            return machine->before[b].taken;
    return 0;
}

/* Whether a transition of this version leads from one to the other. */
static bool leads(const JoxMachine *machine, const char *from, const char *to) {
    int state = jox_machine_state(machine, from);
    for (uint32_t k = 0; state >= 0 && k < machine->states[state].transition_count; k++)
        if (!strcmp(machine->states[machine->states[state].transitions[k].to].name, to))
            return true;
    return false;
}

void jox_mind_taken(const JoxMind *mind, uint32_t index, JoxTakenVisit *visit, void *context) {
    const JoxMachine *machine = mind->machines[index];
    for (uint32_t s = 0; s < machine->state_count; s++) {
        const JoxState *from = &machine->states[s];
        for (uint32_t k = 0; k < from->transition_count; k++) {
            const char *to = machine->states[from->transitions[k].to].name;
            uint64_t sum = before(machine, from->name, to);
            bool first = true;
            for (uint32_t o = 0; o < from->transition_count; o++)
                if (from->transitions[o].to == from->transitions[k].to) {
                    first &= o >= k;
                    sum += from->transitions[o].taken;
                }
            if (first) /* several may lead to the same state */
                visit(context, from->name, to, sum);
        }
    }
    for (uint32_t b = 0; b < machine->before_count; b++)
        if (!leads(machine, machine->before[b].from, machine->before[b].to))
            visit(context, machine->before[b].from, machine->before[b].to,
                  machine->before[b].taken);
}
