/* The table of verbs of input logs. Reading, writing, error messages and the reference page use its
   rows. */
#ifndef JOX_WORLD_VERB_TABLE_H
#define JOX_WORLD_VERB_TABLE_H

#include "base/text.h"
#include "jostle.h"
#include "world/input/input_entries.h"

typedef struct JoWorld JoWorld;

typedef enum JoxInputWordKind {
    JOX_WORD_NUMBER,
    JOX_WORD_WHOLE, /* id of an agent or row of a body */
    JOX_WORD_NAME,
    JOX_WORD_PATH,
    JOX_WORD_FILES /* how many files follow */
} JoxInputWordKind;

/* A word behind a verb: name, kind, range and unit. */
typedef struct JoxInputWord {
    const char *name;
    JoxInputWordKind kind;
    double least, most;
    const char *unit;
} JoxInputWord;

/* The tool of verbs that only programs use. */
#define JOX_VERB_PROGRAM "program"

typedef struct JoxVerb {
    const char *name;
    JoxInputWord words[10];
    uint32_t least, most; /* it takes `least` or `most` words */
    const char *example, *meaning;
    const char *tool; /* tool of the live page for it, a name of view: {tools}, or JOX_VERB_PROGRAM;
                         NULL: in logs only */
    /* Does it, before a step; returns false with a sentence in `why`. NULL: done by run, or nothing
       to do. */
    bool (*perform)(JoWorld *world, const JoxInputEntry *entry, JoxText *why);
} JoxVerb;

enum { JOX_INPUT_MOST_VERBS = 32 };
extern const JoxVerb jox_input_verbs[];
extern const uint32_t jox_input_verb_count;

/* Performs an action of a program, before a step: checks names and numbers as the reader of a log
   does, does it and records it (world->record). Returns false with `error`, which may be NULL. */
bool jox_input_perform(JoWorld *world, JoxInputEntry *entry, JoError *error);
/* Returns whether a line of a log can hold a name; else a sentence in `why`. */
bool jox_input_check_name(const char *what, const char *name, JoxText *why);

/* Appends a verb and its words: "push AGENT FX FY". */
void jox_input_append_usage(const JoxVerb *verb, JoxText *out);
/* Appends the reference page of input logs, in Markdown. */
void jox_input_append_reference(JoxText *out);

#endif
