/* Parameters that people set during a run. The edits are state; the machine that runs is a copy of
   the built one with the edits applied. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "machine/machine_parts.h"

/* Returns the own slot from which a machine's default of a parameter is drawn, or -1. */
static int32_t find_own_slot(const JoxMachine *machine, int32_t state, int parameter) {
    return state == -1 ? jox_machine_own_slot(machine, jox_parameters[parameter].name) : -1;
}

/* Gives a value of the outer state on a level to a state within it, unless that or an outer state
   between them sets the parameter itself. */
static void inherit_edit(const JoxMachine *machine, JoxState *state, uint32_t level, int parameter,
                         const JoxValue *value) {
    for (uint32_t l = level + 1u; l <= state->depth; l++)
        if (jox_state_on_level(machine, state, l)->sets >> parameter & 1)
            return;
    state->param[parameter] = *value;
}

/* Sets a parameter of an outer state, and of the states within it that inherit it. */
static void apply_outer_edit(JoxMachine *machine, uint32_t outer, int parameter,
                             const JoxValue *value) {
    const uint32_t level = machine->outer[outer].depth;
    JOX_ASSERT(outer < machine->outer_count);
    machine->outer[outer].param[parameter] = *value;
    machine->outer[outer].sets |= 1ull << parameter;
    for (uint32_t o = outer + 1; o < machine->outer_count; o++)
        if (jox_state_is_within(&machine->outer[o], level, outer))
            inherit_edit(machine, &machine->outer[o], level, parameter, value);
    for (uint32_t s = 0; s < machine->state_count; s++)
        if (jox_state_is_within(&machine->states[s], level, outer))
            inherit_edit(machine, &machine->states[s], level, parameter, value);
}

static void apply_edit(JoxMachine *machine, const JoxParameterEdit *edit) {
    const JoxValue set = {JOX_VALUE_CONST, edit->value, 0, JOX_LINE_LIVE, 0};
    int32_t slot = find_own_slot(machine, edit->state, edit->parameter);
    JOX_ASSERT(edit->state < (int32_t)machine->state_count);
    if (slot >= 0)
        machine->own[slot].dist = jox_dist_constant(edit->value);
    if (edit->state == -1) {
        machine->defaults[edit->parameter] = set;
    } else if (edit->state < -1) {
        apply_outer_edit(machine, (uint32_t)(-2 - edit->state), edit->parameter, &set);
    } else {
        machine->states[edit->state].param[edit->parameter] = set;
        machine->states[edit->state].sets |= 1ull << edit->parameter;
    }
}

/* Returns the copy of a machine, renewed from the built one. It owns its states, outer
   states and own slots; everything that they point to belongs to the built machine. */
static JoxMachine *renew_copy(JoxMachineSet *set, uint32_t index) {
    const JoxMachine *built = set->built[index];
    JoxMachine *copy = set->edited[index];
    JoxState *states, *outer;
    JoxOwnSlot *own;
    if (!copy) {
        copy = set->edited[index] = jox_alloc(1, sizeof *copy);
        states = jox_alloc((size_t)built->state_count + 1, sizeof *states);
        outer = jox_alloc((size_t)built->outer_count + 1, sizeof *outer);
        own = jox_alloc((size_t)built->own_count + 1, sizeof *own);
    } else {
        states = copy->states;
        outer = copy->outer;
        own = copy->own;
    }
    *copy = *built;
    copy->states = memcpy(states, built->states, built->state_count * sizeof *states);
    if (built->outer_count)
        memcpy(outer, built->outer, built->outer_count * sizeof *outer);
    copy->outer = outer;
    if (built->own_count)
        memcpy(own, built->own, built->own_count * sizeof *own);
    copy->own = own;
    return copy;
}

void jox_edits_apply(JoxMachineRun *run, uint32_t index) {
    JoxMachineSet *set = run->set;
    const JoxMachineState *state = run->state;
    JoxMachine *copy = NULL;
    JOX_CHECK(jox_edits_check(run));
    for (uint32_t e = 0; e < state->edit_count; e++) {
        if (state->edits[e].machine != index)
            continue;
        copy = copy ? copy : renew_copy(set, index);
        apply_edit(copy, &state->edits[e]);
    }
    set->items[index] = copy ? copy : set->built[index];
}

void jox_edits_end(JoxMachineRun *run, uint32_t index) {
    JoxMachineState *state = run->state;
    JoxMachineSet *set = run->set;
    uint32_t kept = 0;
    for (uint32_t e = 0; e < state->edit_count; e++)
        if (state->edits[e].machine != index)
            state->edits[kept++] = state->edits[e];
    state->edit_count = kept;
    set->items[index] = set->built[index];
    if (!set->edited[index])
        return;
    jox_free(set->edited[index]->states);
    jox_free(set->edited[index]->outer);
    jox_free(set->edited[index]->own);
    jox_free(set->edited[index]);
    set->edited[index] = NULL;
}

/* Adds an edit; it replaces one of the same parameter. */
static void store_edit(JoxMachineState *state, JoxParameterEdit edit) {
    uint32_t kept = 0;
    for (uint32_t e = 0; e < state->edit_count; e++) {
        const JoxParameterEdit *old = &state->edits[e];
        if (old->machine != edit.machine || old->state != edit.state ||
            old->parameter != edit.parameter)
            state->edits[kept++] = *old;
    }
    state->edit_count = kept;
    JOX_RESERVE(state->edits, state->edit_capacity, kept + 1);
    state->edits[state->edit_count++] = edit;
}

/* Writes a parameter of the agent's state to its column, if it is a constant or an own value. */
static void write_parameter(JoxMachineRun *run, uint32_t i, int p) {
    const JoxMachine *machine = jox_machine_of(run, i);
    const JoxValue *value =
        jox_state_parameter(machine, &machine->states[run->agents->state[i]], p);
    if (value->kind == JOX_VALUE_CONST || value->kind == JOX_VALUE_OWN)
        jox_param_set(run->agents, p, i,
                      jox_parameter_store((JoxParameter)p, jox_value(run, machine, value, i)));
}

/* Returns whether a state is that of an edit, is within its outer state, or inherits the defaults
   that it changes. */
static bool is_in_edited(const JoxMachine *machine, uint16_t state, int32_t number) {
    const uint32_t outer = (uint32_t)(-2 - number);
    return number < -1
               ? jox_state_is_within(&machine->states[state], machine->outer[outer].depth, outer)
               : number < 0 || state == number;
}

void jox_machines_set_parameter(JoxMachineRun *run, uint32_t index, int32_t number, int parameter,
                                double value) {
    JoxAgents *a = run->agents;
    run->edits_made++;
    store_edit(run->state, (JoxParameterEdit){index, number, parameter, 0, value});
    jox_edits_apply(run, index);
    const JoxMachine *machine = run->set->items[index];
    int32_t slot = find_own_slot(machine, number, parameter);
    for (uint32_t i = 0; i < a->count; i++) {
        if (a->machine[i] != index || !is_in_edited(machine, a->state[i], number))
            continue;
        bool follows = slot >= 0 && !(slot < 64 && (a->given[i] >> slot & 1));
        if (follows)
            jox_own_set(a, i, (uint32_t)slot, value);
        for (int p = 0; p < JOX_PARAM_COUNT; p++) {
            const JoxState *state = &machine->states[a->state[i]];
            const JoxValue *held = jox_state_parameter(machine, state, p);
            if (p == parameter || (follows && held->kind == JOX_VALUE_OWN && held->index == slot))
                write_parameter(run, i, p);
        }
    }
    jox_shared_settle(a);
}
