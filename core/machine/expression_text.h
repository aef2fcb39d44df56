/* Expressions as text, instruction by instruction: as written, and with the value of each word.
   explain.c prints transitions that were taken with it, why.c those that were not. */
#ifndef JOX_MACHINE_EXPRESSION_TEXT_H
#define JOX_MACHINE_EXPRESSION_TEXT_H

#include "machine/machine_parts.h"

/* Precedence of operators, loosest first: an operand that binds less tightly than its surroundings
   is put in parentheses. */
typedef enum {
    JOX_BINDS_OR,
    JOX_BINDS_AND,
    JOX_BINDS_COMPARED,
    JOX_BINDS_SUM,
    JOX_BINDS_PRODUCT,
    JOX_BINDS_ALL
} JoxBinding;

/* Text of the expression in a register. Zero-initialise; free by jox_spelled_free. */
typedef struct JoxSpelled {
    JoxText plain;  /* as written: "now.speed > 0.5" */
    JoxText valued; /* with the values of its words: "now.speed 0.32 > 0.5" */
    JoxBinding binding;
    bool boundless; /* an infinite constant */
    bool constant;  /* no word in it */
    bool condition; /* one word that is true or false */
} JoxSpelled;

/* Spells the result of an instruction, `value` for the agent, from what its inputs in `registers`
   are. `to` must be zero. */
void jox_spell_instruction(const JoxMachine *machine, const JoxInstruction *in,
                           const JoxSpelled *registers, double value, JoxSpelled *to);
/* Returns whether an operation on the surroundings is a condition, not a number. */
bool jox_op_is_condition(JoxOp op);
/* Returns the sign of an operation that is written between its inputs, as ">"; NULL: it has
   none. */
const char *jox_operation_sign(JoxOp op);
/* Appends a target as it is written, with its filters. */
void jox_spell_target(const JoxMachine *machine, const JoxTarget *target, JoxText *out);
void jox_spelled_free(JoxSpelled *spelled);

#endif
