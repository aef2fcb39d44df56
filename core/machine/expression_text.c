#include "machine/expression_text.h"

#include <math.h>
#include <string.h>

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

static const struct {
    JoxOp op;
    const char *sign;
    JoxBinding binding;
} SIGNS[] = {
    {JOX_OP_ADD, "+", JOX_BINDS_SUM},      {JOX_OP_SUB, "-", JOX_BINDS_SUM},
    {JOX_OP_MUL, "*", JOX_BINDS_PRODUCT},  {JOX_OP_DIV, "/", JOX_BINDS_PRODUCT},
    {JOX_OP_GT, ">", JOX_BINDS_COMPARED},  {JOX_OP_GE, ">=", JOX_BINDS_COMPARED},
    {JOX_OP_LT, "<", JOX_BINDS_COMPARED},  {JOX_OP_LE, "<=", JOX_BINDS_COMPARED},
    {JOX_OP_EQ, "is", JOX_BINDS_COMPARED}, {JOX_OP_AND, "and", JOX_BINDS_AND},
    {JOX_OP_OR, "or", JOX_BINDS_OR},
};

/* Words that are written otherwise than their operation is called. */
static const struct {
    JoxOp op;
    const char *word;
} WORDS[] = {
    {JOX_OP_PLACE_DENSITY, "density"},    {JOX_OP_PLACE_COUNT, "count"},
    {JOX_OP_OUTER_AFTER, "after"},        {JOX_OP_OUTER_LASTED, "lasted"},
    {JOX_OP_OUTER_TIME, "time_in_state"}, {JOX_OP_OUTER_EVERY, "every"},
};

/* Returns one of the two texts of an expression. */
static JoxText *text_of(JoxSpelled *of, bool valued) {
    return valued ? &of->valued : &of->plain;
}

static const char *operand_text(const JoxSpelled *of, bool valued) {
    const char *data = valued ? of->valued.data : of->plain.data;
    return data ? data : "";
}

static void add_operand(const JoxSpelled *of, JoxBinding within, bool valued, JoxText *out) {
    const bool loose = of->binding < within;
    jox_text_printf(out, loose ? "(%s)" : "%s", operand_text(of, valued));
}

const char *jox_operation_sign(JoxOp op) {
    for (size_t s = 0; s < sizeof SIGNS / sizeof *SIGNS; s++)
        if (SIGNS[s].op == op)
            return SIGNS[s].sign;
    return NULL;
}

/* Prints the operation with an infix sign between its inputs; returns false if it has no sign. */
static bool print_infix(const JoxInstruction *in, const JoxSpelled *registers, bool valued,
                        JoxSpelled *to) {
    JoxText *out = text_of(to, valued);
    for (size_t s = 0; s < sizeof SIGNS / sizeof *SIGNS; s++) {
        if (SIGNS[s].op != (JoxOp)in->op)
            continue;
        to->binding = SIGNS[s].binding;
        /* The right side of - and / binds more tightly: 1 - (2 - 3). */
        const bool uneven = in->op == JOX_OP_SUB || in->op == JOX_OP_DIV;
        add_operand(&registers[in->a], to->binding, valued, out);
        jox_text_printf(out, " %s ", SIGNS[s].sign);
        add_operand(&registers[in->b], to->binding + (uneven ? 1 : 0), valued, out);
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

void jox_spell_target(const JoxMachine *machine, const JoxTarget *target, JoxText *out) {
    jox_text_add(out, target->name);
    print_filter(machine, &target->filter, out);
}

/* Prints the word of an operation, in small letters. */
static void print_operation(JoxOp op, JoxText *out) {
    for (size_t w = 0; w < sizeof WORDS / sizeof *WORDS; w++)
        if (WORDS[w].op == op) {
            jox_text_add(out, WORDS[w].word);
            return;
        }
    for (const char *c = OPS[op]; *c; c++)
        jox_text_printf(out, "%c", *c >= 'A' && *c <= 'Z' ? *c - 'A' + 'a' : *c);
}

/* Prints a word with its arguments: distance(stone), near(ball, 1.2), heard("go"). */
static void print_word(const JoxMachine *machine, const JoxInstruction *in,
                       const JoxSpelled *registers, bool valued, JoxText *out) {
    const uint8_t inputs[] = {in->a, in->b, in->c};
    const char *before = "(";
    if (in->op >= JOX_OP_LIST_HAS && in->op <= JOX_OP_LIST_LAST) {
        static const char *const PARTS[] = {":contains", ".size", ".first", ".last"};
        jox_text_printf(out, "mine.%s%s", machine->memory[in->arg].name,
                        PARTS[in->op - JOX_OP_LIST_HAS]);
        if (in->op == JOX_OP_LIST_HAS && in->target >= 0) {
            jox_text_add(out, "(");
            jox_spell_target(machine, &machine->targets[in->target], out);
            jox_text_add(out, ")");
        } else if (in->op == JOX_OP_LIST_HAS) {
            jox_text_printf(out, "(%s)", registers[in->a].plain.data);
        }
        return;
    }
    if (in->op == JOX_OP_MESSAGE) {
        jox_text_printf(out, "told(\"%s\").%s", machine->names[in->name].text,
                        machine->names[in->arg].text);
        return;
    }
    if (in->op == JOX_OP_OF) {
        jox_spell_target(machine, &machine->targets[in->target], out);
        jox_text_printf(out, ".%s", NOWS[in->arg]);
        return;
    }
    print_operation((JoxOp)in->op, out);
    const int16_t targets[] = {in->target, in->place};
    for (int k = 0; k < 2; k++)
        if (targets[k] >= 0) {
            jox_text_add(out, before);
            jox_spell_target(machine, &machine->targets[targets[k]], out);
            before = ", ";
        }
    if (in->name >= 0) {
        jox_text_printf(out, "%s\"%s\"", before, machine->names[in->name].text);
        before = ", ";
    }
    for (uint32_t k = 0; k < jox_op_inputs((JoxOp)in->op); k++) {
        if (registers[inputs[k]].boundless) /* a reach that was omitted */
            continue;
        jox_text_printf(out, "%s%s", before, operand_text(&registers[inputs[k]], valued));
        before = ", ";
    }
    if (*before == ',')
        jox_text_add(out, ")");
}

bool jox_op_is_condition(JoxOp op) {
    return op >= JOX_OP_INSIDE && op != JOX_OP_NEIGHBOURS && op != JOX_OP_THEIRS &&
           op != JOX_OP_OF && op != JOX_OP_MESSAGE &&
           (op < JOX_OP_LIST_SIZE || op > JOX_OP_LIST_LAST) && op != JOX_OP_QUEUED &&
           op != JOX_OP_LEFT && op != JOX_OP_PROGRAM_NUMBER && op != JOX_OP_OUTER_TIME;
}

/* Prints one of the two texts of an instruction. */
static void print_instruction(const JoxMachine *machine, const JoxInstruction *in,
                              const JoxSpelled *registers, double value, bool valued,
                              JoxSpelled *to) {
    const JoxOp op = (JoxOp)in->op;
    JoxText *out = text_of(to, valued);
    to->binding = JOX_BINDS_ALL;
    if (print_infix(in, registers, valued, to))
        return;
    if (op == JOX_OP_CONST) {
        jox_text_printf(out, "%.6g", in->number);
        return;
    }
    if (op == JOX_OP_NOT && registers[in->a].condition) {
        jox_text_printf(out, "not %s", registers[in->a].plain.data);
        if (valued)
            jox_text_add(out, value != 0.0 ? " is true" : " is false");
        return;
    }
    if (op == JOX_OP_NOT || op == JOX_OP_NEG) {
        jox_text_printf(out, op == JOX_OP_NOT ? "not (%s)" : "-(%s)",
                        operand_text(&registers[in->a], valued));
        return;
    }
    if (op == JOX_OP_NOW)
        jox_text_printf(out, "now.%s", NOWS[in->arg]);
    else if (op == JOX_OP_OWN)
        jox_text_printf(out, "own.%s", machine->own[in->arg].name);
    else if (op == JOX_OP_MEMORY)
        jox_text_printf(out, "mine.%s", machine->memory[in->arg].name);
    else if (op == JOX_OP_PROGRAM_NUMBER || op == JOX_OP_PROGRAM_CONDITION)
        jox_text_add(out, machine->names[in->name].text);
    else
        print_word(machine, in, registers, valued, out);
    if (valued && jox_op_is_condition(op))
        jox_text_add(out, value != 0.0 ? " is true" : " is false");
    else if (valued)
        jox_text_printf(out, " %.4g", value);
}

void jox_spell_instruction(const JoxMachine *machine, const JoxInstruction *in,
                           const JoxSpelled *registers, double value, JoxSpelled *to) {
    const JoxOp op = (JoxOp)in->op;
    const uint8_t inputs[] = {in->a, in->b, in->c};
    print_instruction(machine, in, registers, value, false, to);
    print_instruction(machine, in, registers, value, true, to);
    to->condition = jox_op_is_condition(op);
    to->boundless = op == JOX_OP_CONST && isinf(in->number);
    to->constant = op == JOX_OP_CONST || (op < JOX_OP_DISTANCE && jox_op_inputs(op) > 0);
    for (uint32_t k = 0; k < jox_op_inputs(op); k++)
        to->constant = to->constant && registers[inputs[k]].constant;
}

void jox_spelled_free(JoxSpelled *spelled) {
    jox_text_free(&spelled->plain);
    jox_text_free(&spelled->valued);
    *spelled = (JoxSpelled){0};
}
