/* Explains why a transition was taken: prints its condition as an expression, with the present
   value of each word. */
#include <math.h>

#include "machine/machine_parts.h"

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

/* Precedence of operators, loosest first: an operand that binds less tightly than its surroundings
   is put in parentheses. */
typedef enum { BINDS_OR, BINDS_AND, BINDS_COMPARED, BINDS_SUM, BINDS_PRODUCT, BINDS_ALL } Binding;

/* Text of the expression in a register. Zero-initialise; free the text. */
typedef struct Written {
    JoxText text;
    Binding binding;
    bool boundless; /* an infinite constant */
} Written;

static const struct {
    JoxOp op;
    const char *sign;
    Binding binding;
} SIGNS[] = {
    {JOX_OP_ADD, "+", BINDS_SUM},      {JOX_OP_SUB, "-", BINDS_SUM},
    {JOX_OP_MUL, "*", BINDS_PRODUCT},  {JOX_OP_DIV, "/", BINDS_PRODUCT},
    {JOX_OP_GT, ">", BINDS_COMPARED},  {JOX_OP_GE, ">=", BINDS_COMPARED},
    {JOX_OP_LT, "<", BINDS_COMPARED},  {JOX_OP_LE, "<=", BINDS_COMPARED},
    {JOX_OP_EQ, "is", BINDS_COMPARED}, {JOX_OP_AND, "and", BINDS_AND},
    {JOX_OP_OR, "or", BINDS_OR},
};

static void add_operand(const Written *of, Binding within, JoxText *out) {
    const bool loose = of->binding < within;
    jox_text_printf(out, loose ? "(%s)" : "%s", of->text.data ? of->text.data : "");
}

/* Prints the operation with an infix sign between its inputs; returns false if it has no sign. */
static bool print_infix(const JoxInstruction *in, const Written *registers, Written *to) {
    for (size_t s = 0; s < sizeof SIGNS / sizeof *SIGNS; s++) {
        if (SIGNS[s].op != (JoxOp)in->op)
            continue;
        to->binding = SIGNS[s].binding;
        /* The right side of - and / binds more tightly: 1 - (2 - 3). */
        const bool uneven = in->op == JOX_OP_SUB || in->op == JOX_OP_DIV;
        add_operand(&registers[in->a], to->binding, &to->text);
        jox_text_printf(&to->text, " %s ", SIGNS[s].sign);
        add_operand(&registers[in->b], to->binding + (uneven ? 1 : 0), &to->text);
        return true;
    }
    return false;
}

/* Prints the filter of a target: ":in_state("Wait")". */
static void print_filter(const JoxMachine *machine, const JoxAgentFilter *filter, JoxText *out) {
    if (filter->flies)
        jox_text_add(out, ":flying()");
    if (filter->within > 0.0f)
        jox_text_printf(out, ":within(%.6g)", (double)filter->within);
    if (filter->ahead > 0.0f)
        jox_text_printf(out, ":ahead(%.6g)", (double)filter->ahead);
    if (filter->comes > 0.0f)
        jox_text_printf(out, ":incoming(%.6g)", (double)filter->comes);
    if (!filter->some)
        return;
    if (filter->fallen)
        jox_text_add(out, ":fallen()");
    if (filter->state >= 0)
        jox_text_printf(out, ":in_state(\"%s\")", machine->names[filter->state].text);
    if (filter->machine >= 0)
        jox_text_printf(out, ":of_machine(\"%s\")", machine->names[filter->machine].text);
    if (filter->group >= 0)
        jox_text_printf(out, ":of_group(number %d)", filter->group);
    if (filter->memory < 0)
        return;
    jox_text_printf(out, ":where(\"%s\", %.6g", machine->names[filter->memory].text, filter->least);
    jox_text_printf(out, isinf(filter->greatest) ? ")" : ", %.6g)", filter->greatest);
}

/* Prints a word with its arguments: distance(stone), near(ball, 1.2), heard("go"). */
static void print_word(const JoxMachine *machine, const JoxInstruction *in,
                       const Written *registers, JoxText *out) {
    const uint8_t inputs[] = {in->a, in->b, in->c};
    const char *before = "(";
    if (in->op == JOX_OP_OF) {
        jox_text_printf(out, "%s.%s", machine->targets[in->target].name, NOWS[in->arg]);
        return;
    }
    for (const char *c = OPS[in->op]; *c; c++)
        jox_text_printf(out, "%c", *c >= 'A' && *c <= 'Z' ? *c - 'A' + 'a' : *c);
    const int16_t targets[] = {in->target, in->place};
    for (int k = 0; k < 2; k++)
        if (targets[k] >= 0) {
            jox_text_printf(out, "%s%s", before, machine->targets[targets[k]].name);
            print_filter(machine, &machine->targets[targets[k]].filter, out);
            before = ", ";
        }
    if (in->name >= 0) {
        jox_text_printf(out, "%s\"%s\"", before, machine->names[in->name].text);
        before = ", ";
    }
    for (uint32_t k = 0; k < jox_op_inputs((JoxOp)in->op); k++) {
        if (registers[inputs[k]].boundless) /* a reach that was omitted */
            continue;
        jox_text_printf(out, "%s%s", before, registers[inputs[k]].text.data);
        before = ", ";
    }
    if (*before == ',')
        jox_text_add(out, ")");
}

static bool is_condition(JoxOp op) {
    return op >= JOX_OP_INSIDE && op != JOX_OP_NEIGHBOURS && op != JOX_OP_THEIRS &&
           op != JOX_OP_OF && op != JOX_OP_QUEUED;
}

/* Prints the result of an instruction, which is `value` for the agent. */
static void print_instruction(const JoxMachine *machine, const JoxInstruction *in,
                              const Written *registers, double value, Written *to) {
    const JoxOp op = (JoxOp)in->op;
    to->binding = BINDS_ALL;
    if (print_infix(in, registers, to))
        return;
    if (op == JOX_OP_CONST) {
        jox_text_printf(&to->text, "%.6g", in->number);
        to->boundless = isinf(in->number);
    } else if (op == JOX_OP_NOT || op == JOX_OP_NEG) {
        jox_text_printf(&to->text, op == JOX_OP_NOT ? "not (%s)" : "-(%s)",
                        registers[in->a].text.data);
    } else {
        if (op == JOX_OP_NOW)
            jox_text_printf(&to->text, "now.%s", NOWS[in->arg]);
        else if (op == JOX_OP_OWN)
            jox_text_printf(&to->text, "own.%s", machine->own[in->arg].name);
        else if (op == JOX_OP_MEMORY)
            jox_text_printf(&to->text, "mine.%s", machine->memory[in->arg].name);
        else
            print_word(machine, in, registers, &to->text);
        if (is_condition(op))
            jox_text_add(&to->text, value != 0.0 ? " is true" : " is false");
        else
            jox_text_printf(&to->text, " %.4g", value);
    }
}

static void print_expression(const JoxMachineRun *run, const JoxMachine *machine,
                             const JoxExpression *expression, uint32_t agent, JoxText *out) {
    static _Thread_local JoxRegisters values;
    Written registers[JOX_MOST_REGISTERS] = {0};
    for (uint32_t k = 0; k < expression->count; k++) {
        const JoxInstruction *in = &expression->code[k];
        JoxExpression one = {(JoxInstruction *)in, 1};
        Written to = {0};
        jox_eval(run, machine, &one, &agent, 1, values);
        print_instruction(machine, in, registers, values[in->to][0], &to);
        jox_text_free(&registers[in->to].text);
        registers[in->to] = to;
    }
    jox_text_printf(out, "    when %s\n", registers[0].text.data);
    for (uint32_t r = 0; r < JOX_MOST_REGISTERS; r++)
        jox_text_free(&registers[r].text);
}

void jox_machines_explain(const JoxMachineRun *run, const JoxTaken *taken, JoxText *out) {
    const JoxMachine *machine = run->set->items[taken->machine];
    const JoxTransition *t = &machine->states[taken->from].transitions[taken->transition];
    jox_text_printf(out, "t=%.2f agent %u %s: %s -> %s (transition %u '%s', %s:%d)\n",
                    run->tick * run->dt, taken->agent_id, machine->name,
                    machine->states[taken->from].name, machine->states[taken->to].name,
                    taken->transition + 1u, t->id, jox_machine_file(machine, t->source), t->line);
    uint32_t agent = jox_agents_find(run->agents, taken->agent_id);
    if (t->when < 0 || agent == JOX_NO_INDEX)
        return;
    print_expression(run, machine, &machine->expressions[t->when], agent, out);
}
