/* Part of jostle.h, which includes it: words that a program adds to the language of behaviours.
 * Numbers and conditions are computed by the program for many agents at once; actions call it back
 * for one agent. A behaviour uses them as the words that are built in:
 *
 *     Wait = { speed = 1.2 - 0.01 * noise, { to = "Leave", when = noise:above(80) | gate_is_free }
 * }, Leave = { on_enter = ring_bell }              -- or in a function: ring_bell(), ring_bell(2.5)
 *
 * They are checked as those are; a scene whose behaviours use them loads in this program alone. */
#ifndef JOSTLE_WORDS_H
#define JOSTLE_WORDS_H

#include "jostle.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum JoWordKind { JO_WORD_NUMBER, JO_WORD_CONDITION, JO_WORD_ACTION } JoWordKind;

/* Writes the value of a number, or 0 or 1 of a condition, for `count` agents. `agents` are their
   indices in the columns of jo_world_column; count is at most 256. Called within a step, and while
   a scene loads, by several
   threads at the same time for different agents, and possibly several times in a step for the same
   one: it reads the world, by jostle_read.h, and data of the program that nobody changes meanwhile,
   and changes nothing. So that a run depends on its seed alone, equal worlds must give equal
   values. A value that is not finite counts as 0, and is reported. */
typedef void JoWordValues(void *context, const JoWorld *world, const uint32_t *agents,
                          uint32_t count, double *values);
/* Does the action of an agent, with the numbers, at most 4, that the behaviour gave. Called on the
   thread that steps, at the end of the step, in the order in which the agents acted: by id within
   one kind of function (on_exit, on_take, on_enter of a transition belong together). The functions
   of jostle_act.h may be called, the scene may not be stepped. The agent may have left meanwhile
   (jo_agent_is_live). */
typedef void JoWordAction(void *context, JoWorld *world, JoAgent agent, const double *numbers,
                          uint32_t count);

/* A word. All texts are required; they stand in the reference and in editors. */
typedef struct JoWord {
    const char *name;    /* letters, digits and _, as a local of Lua; no word of the language */
    const char *unit;    /* of a number: "dB"; else "" */
    const char *meaning; /* in a sentence */
    const char *example; /* a condition or number with it: "noise:above(80)"; of an action: a call
                            of it: "ring_bell(2.5)" */
    JoWordKind kind;
    JoWordValues *values; /* NUMBER, CONDITION */
    JoWordAction *act;    /* ACTION */
    void *context;        /* passed to the functions */
} JoWord;

/* Return the reference of words as a page of Markdown, and their definitions for
   lua-language-server, to lie beside scripts/editor/jostle.lua; free them with jo_free. Examples
   are checked. NULL with `error` if a word or its example is wrong. */
JO_API char *jo_words_reference(const JoWord *words, size_t count, JoError *error);
JO_API char *jo_words_definitions(const JoWord *words, size_t count, JoError *error);

#ifdef __cplusplus
}
#endif

#endif
