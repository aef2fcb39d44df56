/* Entering and leaving several levels at once: a state, and outer states around it, which run
   machines of their own. Called by think.c. */
#include "base/assert.h"
#include "machine/machine_parts.h"

void jox_call_hook(JoxMachineRun *run, int32_t hook, JoxHookKind kind, uint32_t agent) {
    double unused[2] = {0.0, 0.0};
    if (hook >= 0 && run->call)
        run->call(run->call_context, jox_machine_of(run, agent), hook, kind, agent, unused);
}

void jox_exit_states(JoxMachineRun *run, uint32_t i, uint32_t level) {
    const JoxMachine *machine = jox_machine_of(run, i);
    const JoxState *state = &machine->states[run->agents->state[i]];
    JOX_ASSERT(level <= state->depth);
    for (uint32_t l = state->depth + 1u; l-- > level;)
        jox_call_hook(run, jox_state_on_level(machine, state, l)->on_exit, JOX_HOOK_EXIT, i);
}

void jox_complete_entry(JoxMachineRun *run, uint32_t i, uint32_t level) {
    const JoxMachine *machine = jox_machine_of(run, i);
    const JoxState *state = &machine->states[run->agents->state[i]];
    JOX_ASSERT(level <= state->depth);
    for (uint32_t l = level; l <= state->depth; l++) {
        const JoxState *on = jox_state_on_level(machine, state, l);
        jox_machines_draw_lasts(run, i, l);
        jox_actions_do(run, machine, &on->enters, i);
        jox_call_hook(run, on->on_enter, JOX_HOOK_ENTER, i);
    }
}

uint16_t jox_destination(const JoxMachineRun *run, const JoxTransition *t, uint32_t i) {
    const JoxAgents *a = run->agents;
    const JoxMachine *machine = jox_machine_of(run, i);
    const JoxState *state = &machine->states[a->state[i]];
    const uint32_t slot = jox_state_on_level(machine, state, t->level)->came_from;
    const double was = t->back && slot ? a->memory[(size_t)i * a->memory_stride + slot - 1] : 0.0;
    return was >= 1.0 && was <= machine->state_count ? (uint16_t)(was - 1.0) : t->to;
}

void jox_note_left_state(JoxMachineRun *run, const JoxTransition *t, uint32_t i, uint16_t to) {
    const JoxAgents *a = run->agents;
    const JoxMachine *machine = jox_machine_of(run, i);
    const JoxState *state = &machine->states[to];
    const size_t first = (size_t)i * a->memory_stride;
    for (uint32_t l = t->level; !t->back && l <= state->depth; l++) {
        const uint32_t slot = jox_state_on_level(machine, state, l)->came_from;
        if (slot) /* a machine that begins anew has left no state yet */
            a->memory[first + slot - 1] = l == t->level ? 1.0 + a->state[i] : 0.0;
    }
}
