/* The verbs of input lines, once: drives reading, writing, what is said of mistakes, and the page
   that explains them. */
#ifndef JOX_WORLD_VERBS_H
#define JOX_WORLD_VERBS_H

#include "base/text.h"
#include "jostle.h"
#include "world/input/input_entries.h"

typedef struct JoWorld JoWorld;

typedef enum JoxInputWordKind {
    JOX_WORD_NUMBER,
    JOX_WORD_WHOLE, /* a number of a thing: an agent's id, a body's row */
    JOX_WORD_NAME,
    JOX_WORD_PATH,
    JOX_WORD_FILES /* how many files follow */
} JoxInputWordKind;

/* What stands behind a verb. */
typedef struct JoxInputWord {
    const char *name;
    JoxInputWordKind kind;
    double least, most;
    const char *unit;
} JoxInputWord;

/* The tool of verbs that programs have, and no page. */
#define JOX_VERB_PROGRAM "program"

typedef struct JoxVerb {
    const char *name;
    JoxInputWord words[10];
    uint32_t least, most; /* words that it takes: so many or so many */
    const char *example, *meaning;
    const char *tool; /* of the live page that people need for it, a name of view: {tools}, or
                         JOX_VERB_PROGRAM; NULL: stands in logs alone */
    /* Does it, before a step; false with a sentence in `why`. NULL: what a run does, or nothing. */
    bool (*perform)(JoWorld *world, const JoxInputEntry *entry, JoxText *why);
} JoxVerb;

enum { JOX_INPUT_MOST_VERBS = 32 };
extern const JoxVerb jox_input_verbs[];
extern const uint32_t jox_input_verb_count;

/* Does what a program wants, before a step: looks at names and numbers as the reader of a log does,
   performs it and has it recorded (world->record). False with `error` (it may be NULL). */
bool jox_input_perform(JoWorld *world, JoxInputEntry *entry, JoError *error);
/* Whether a line can hold the name; else a sentence in `why`. */
bool jox_input_check_name(const char *what, const char *name, JoxText *why);

/* "push AGENT FX FY" */
void jox_input_append_usage(const JoxVerb *verb, JoxText *out);
/* The page of Markdown. */
void jox_input_append_reference(JoxText *out);

#endif
