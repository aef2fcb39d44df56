/* Measures of single words of a condition, and the surroundings where they do not hold. */
#ifndef JOX_MACHINE_WHY_WORDS_H
#define JOX_MACHINE_WHY_WORDS_H

#include "machine/expression_text.h"
#include "machine/why.h"

/* Fills value, bound, relation, unit and note of a word on the agent's time or surroundings; `a` is
   its first input. */
void jox_why_measure(const JoxMachineRun *run, uint32_t agent, const JoxInstruction *in, double a,
                     JoxWhyTerm *term);
/* Returns the unit of a word that is a number; "" if it has none. */
const char *jox_why_unit(const JoxInstruction *in);

#endif
