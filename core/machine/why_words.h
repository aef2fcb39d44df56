/* Measures of single words of a condition, and the surroundings where they do not hold. */
#ifndef JOX_MACHINE_WHY_WORDS_H
#define JOX_MACHINE_WHY_WORDS_H

#include "machine/expression_text.h"
#include "machine/why.h"

static inline JoxV2 jox_why_position(const JoxMachineRun *run, uint32_t agent) {
    return (JoxV2){run->agents->x[agent], run->agents->y[agent]};
}
/* why_targets.c: append who or what a target is, or why it is not found (returns false); who it
   means, seen or not, as "prey is agent 12"; and how many pass a target that chooses, and what the
   others lack. */
bool jox_why_add_target(const JoxMachineRun *run, uint32_t agent, int32_t index, JoxText *out);
void jox_why_add_identity(const JoxMachineRun *run, uint32_t agent, int32_t index, JoxText *out);
void jox_why_add_count(const JoxMachineRun *run, uint32_t agent, int32_t index, JoxText *out);
/* Appends what an agent or body is called: "agent 12 (in Walk)", "body 'ball'", "body 3". */
void jox_why_add_somebody(const JoxMachineRun *run, uint32_t agent, int32_t object, JoxText *out);
/* why_calls.c: append who called a signal last, or calls it now, when, where and how far from the
   agent against its reach, m; and which message of a name waits, or what became of the last. */
void jox_why_add_call(const JoxMachineRun *run, uint32_t agent, uint32_t name, double reach,
                      JoxText *out);
void jox_why_add_told(const JoxMachineRun *run, uint32_t agent, uint32_t name, JoxText *out);
/* why_words.c: fills value, bound, relation, unit and note of a word on the agent's time or
   surroundings; `a` is its first input. */
void jox_why_measure(const JoxMachineRun *run, uint32_t agent, const JoxInstruction *in, double a,
                     JoxWhyTerm *term);
/* Returns the unit of a word that is a number; "" if it has none. */
const char *jox_why_unit(const JoxInstruction *in);

#endif
