/* Why a transition was taken, in words. */
#include "machine/internal.h"

static const char *const OPS[] = {
#define X(name) #name,
    JOX_OPS(X)
#undef X
};
static const char *const NOWS[] = {
#define X(name, ...) #name,
    JOX_MEASURED(X)
#undef X
};

/* One line per instruction: what it is, of what, and its value for the agent at present. */
static void print_expression(const JoxMachineRun *run, const JoxMachine *machine,
                             const JoxExpression *expression, uint32_t agent, JoxText *out) {
    static _Thread_local JoxRegisters registers;
    for (uint32_t k = 0; k < expression->count; k++) {
        const JoxInstruction *in = &expression->code[k];
        JoxExpression one = {(JoxInstruction *)in, 1};
        jox_eval(run, machine, &one, &agent, 1, registers);
        jox_text_printf(out, "      r%u = %s", in->to, OPS[in->op]);
        if (in->op == JOX_OP_NOW)
            jox_text_printf(out, " %s", NOWS[in->arg]);
        if (in->op == JOX_OP_OWN)
            jox_text_printf(out, " %s", machine->own[in->arg].name);
        if (in->op == JOX_OP_MEMORY)
            jox_text_printf(out, " %s", machine->memory[in->arg].name);
        if (in->target >= 0)
            jox_text_printf(out, " %s", machine->targets[in->target].name);
        if (in->place >= 0)
            jox_text_printf(out, " in %s", machine->targets[in->place].name);
        if (in->name >= 0)
            jox_text_printf(out, " '%s'", machine->names[in->name].text);
        jox_text_printf(out, " -> %.6g\n", registers[in->to][0]);
    }
}

void jox_machines_explain(const JoxMachineRun *run, const JoxTaken *taken, JoxText *out) {
    const JoxMachine *machine = run->set->items[taken->machine];
    const JoxTransition *t = &machine->states[taken->from].transitions[taken->transition];
    jox_text_printf(out, "t=%.2f agent %u %s: %s -> %s (transition %u '%s', %s:%d)\n",
                    run->tick * run->dt, taken->agent_id, machine->name,
                    machine->states[taken->from].name, machine->states[taken->to].name,
                    taken->transition + 1u, t->id, machine->path, t->line);
    uint32_t agent = jox_agents_find(run->agents, taken->agent_id);
    if (t->when < 0 || agent == JOX_NO_INDEX)
        return;
    jox_text_add(out, "    its condition:\n");
    print_expression(run, machine, &machine->expressions[t->when], agent, out);
}
