/* Explains why a transition was taken: prints its condition as an expression, with the present
   value of each word. */
#include "machine/expression_text.h"

/* Appends who told the message of a name that waits, and when. */
static void add_sender(const JoxMachineRun *run, uint32_t agent, uint32_t name, JoxText *out) {
    const JoxMessage *message = jox_message_find(run, agent, name);
    if (message)
        jox_text_printf(out, " (by agent %u at %.2f s)", message->from, message->sent * run->dt);
}

static void print_expression(const JoxMachineRun *run, const JoxMachine *machine,
                             const JoxExpression *expression, uint32_t agent, JoxText *out) {
    static _Thread_local JoxRegisters values;
    JoxSpelled registers[JOX_MOST_REGISTERS] = {0};
    for (uint32_t k = 0; k < expression->count; k++) {
        const JoxInstruction *in = &expression->code[k];
        JoxExpression one = {(JoxInstruction *)in, 1};
        JoxSpelled to = {0};
        jox_eval(run, machine, &one, &agent, 1, values);
        jox_spell_instruction(machine, in, registers, values[in->to][0], &to);
        if (in->op == JOX_OP_TOLD)
            add_sender(run, agent, machine->names[in->name].number, &to.valued);
        jox_spelled_free(&registers[in->to]);
        registers[in->to] = to;
    }
    jox_text_printf(out, "    when %s\n", registers[0].valued.data);
    for (uint32_t r = 0; r < JOX_MOST_REGISTERS; r++)
        jox_spelled_free(&registers[r]);
}

void jox_machines_explain(const JoxMachineRun *run, const JoxTaken *taken, JoxText *out) {
    const JoxMachine *machine = run->set->items[taken->machine];
    const JoxTransition *t = &machine->states[taken->from].transitions[taken->transition];
    if (t->stays)
        jox_text_printf(out, "t=%.2f agent %u %s: in %s, reaction (%s:%d)\n", run->tick * run->dt,
                        taken->agent_id, machine->name, machine->states[taken->from].name,
                        jox_machine_file(machine, t->source), t->line);
    else
        jox_text_printf(out, "t=%.2f agent %u %s: %s -> %s (transition %u '%s', %s:%d)\n",
                        run->tick * run->dt, taken->agent_id, machine->name,
                        machine->states[taken->from].name, machine->states[taken->to].name,
                        taken->transition + 1u, t->id, jox_machine_file(machine, t->source),
                        t->line);
    uint32_t agent = jox_agents_find(run->agents, taken->agent_id);
    if (t->when < 0 || agent == JOX_NO_INDEX)
        return;
    print_expression(run, machine, &machine->expressions[t->when], agent, out);
}
