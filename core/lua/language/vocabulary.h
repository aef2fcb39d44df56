/* The vocabulary of behaviours: every word, every key of a machine's tables and every field of
   `me`, with arguments, result, meaning and an example. The loader, the suggestions, the reference
   page and the definitions for editors all read these tables. */
#ifndef JOX_LUA_LANGUAGE_VOCABULARY_H
#define JOX_LUA_LANGUAGE_VOCABULARY_H

#include "lua/language/script.h"

/* A word. `takes` has a letter for each argument: p place, t target (a place's name or a target
   value), m target that is a body or an agent, n number or expression, d plain number, g tag, s
   name, w name of walls; '?' before a letter: optional. NULL: not called; "*": reads its arguments
   itself. */
typedef struct JoxWord {
    const char *name, *takes;
    JoxNodeKind makes; /* 0: the word belongs to the machine's table itself */
    int op;            /* JoxOp, JoxSteerKind or JoxTargetKind */
    int arg;           /* JoxNow */
    const char *signature, *unit, *meaning;
    const char *example; /* an expression of the kind it makes */
} JoxWord;

extern const JoxWord jox_words[];
extern const size_t jox_word_count;

/* Range of a plain number that a word takes: of its letters d in order, or an option of orbit. */
typedef struct JoxWordNumber {
    const char *word, *name;
    double least, greatest, standard; /* standard: the default; NAN: must be given */
    const char *unit;
} JoxWordNumber;

extern const JoxWordNumber jox_word_numbers[];
extern const size_t jox_word_number_count;
/* Returns the example of a word. */
const char *jox_word_example(const char *word);
/* Returns the n-th number of a word, from 0; NULL past the last. */
const JoxWordNumber *jox_word_number(const char *word, uint32_t n);

/* A key of one of the machine's tables; states and `defaults` also have all parameters as keys. */
typedef struct JoxTableKey {
    const char *owner; /* "machine", "state", "transition", "kick", "throw", "signal" */
    const char *name, *type, *unit, *meaning;
    const char *example;    /* as written in its table */
    double least, greatest; /* range of a plain number; both 0: no number, or checked elsewhere */
} JoxTableKey;

extern const JoxTableKey jox_table_keys[];
extern const size_t jox_table_key_count;

/* Writes the names of an owner's keys to `names`, with `parameters` those of the parameters too;
   returns how many. */
size_t jox_table_key_names(const char *owner, bool parameters, const char **names, size_t capacity);

/* Returns name, unit and range of a key that holds a number. */
JoxParameterInfo jox_table_key_number(const char *owner, const char *name);

/* A field or method of `me`, besides memory and parameters. */
typedef struct JoxMeKey {
    const char *name, *type, *unit, *meaning;
} JoxMeKey;
extern const JoxMeKey jox_me_keys[];
extern const size_t jox_me_key_count;

#endif
