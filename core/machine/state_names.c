/* Names of poses; names and paths of states, and of the outer states around them, which run
 * machines of their own.
 */
#include <stdio.h>
#include <string.h>

#include "base/format/name.h"
#include "machine/machine.h"

const char *const jox_poses[JOX_POSE_COUNT] = {NULL,
#define X(pose, name) name,
                                               JOX_POSES(X)
#undef X
};

int jox_machine_state(const JoxMachine *machine, const char *name) {
    for (uint32_t s = 0; s < machine->state_count; s++)
        if (strcmp(machine->states[s].name, name) == 0)
            return (int)s;
    return -1;
}

int jox_machine_outer(const JoxMachine *machine, const char *name) {
    for (uint32_t o = 0; o < machine->outer_count; o++)
        if (strcmp(machine->outer[o].name, name) == 0)
            return (int)o;
    return -1;
}

int jox_machine_entry(const JoxMachine *machine, const char *name) {
    const int state = jox_machine_state(machine, name),
              outer = state < 0 ? jox_machine_outer(machine, name) : -1;
    return outer < 0 ? state : machine->outer[outer].start;
}

const JoxState *jox_parameter_setter(const JoxMachine *machine, const JoxState *state, int p) {
    for (uint32_t l = state->depth + 1u; l-- > 0;)
        if (jox_state_on_level(machine, state, l)->sets >> p & 1)
            return jox_state_on_level(machine, state, l);
    return NULL;
}

bool jox_state_is_in(const JoxState *state, const char *name) {
    return state->depth > 0 ? jox_name_is_within(state->name, name)
                            : strcmp(state->name, name) == 0;
}

bool jox_state_answers(const JoxState *state, const char *name) {
    bool answers = strcmp(state->name, name) == 0;
    for (const char *part = state->name; part && !answers && state->depth > 0;) {
        answers = jox_name_is_within(part, name);
        part = strchr(part, '.');
        part = part ? part + 1 : NULL;
    }
    return answers;
}

const char *jox_transition_leads_to(const JoxMachine *machine, const JoxTransition *t) {
    return t->back ? "back" : machine->states[t->to].name;
}

bool jox_state_is_step(const JoxMachine *machine, const JoxState *state) {
    if (state->depth == 0)
        return false;
    const uint16_t outer = state->around[state->depth - 1];
    const size_t around = strlen(machine->outer[outer].name) + 1;
    for (uint32_t s = 0; s < machine->state_count; s++) {
        const JoxState *beside = &machine->states[s];
        if (beside->depth != state->depth || beside->around[state->depth - 1] != outer)
            continue;
        const size_t digits = strspn(beside->name + around, "0123456789");
        if (digits > 0 && beside->name[around + digits] == ' ')
            return true;
    }
    return false;
}

const JoxState *jox_first_state_within(const JoxMachine *machine, uint32_t outer) {
    const uint32_t level = machine->outer[outer].depth;
    uint32_t s = 0;
    while (machine->states[s].depth <= level || machine->states[s].around[level] != outer)
        s++;
    return &machine->states[s];
}

void jox_state_path(const JoxState *state, char path[256]) {
    int n = snprintf(path, 256, "states.");
    for (const char *c = state->name; *c && n < 255; c++)
        if (*c == '.' && state->depth > 0)
            n += snprintf(path + n, 256 - (size_t)n, ".runs.states.");
        else
            n += snprintf(path + n, 256 - (size_t)n, "%c", *c);
}

bool jox_counter_counts(const JoxMachine *machine, const JoxCounter *counter, uint32_t state) {
    const JoxState *is = &machine->states[state];
    bool within = false;
    for (uint32_t l = 0; l < is->depth; l++)
        within |= counter->state == -2 - (int32_t)is->around[l];
    return within || counter->state == -1 || counter->state == (int32_t)state;
}
