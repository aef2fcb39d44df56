/* The language of behaviours, once: every word and every key of a machine's tables, with what it
   takes, makes and means, and an example. Drives the loader, the suggestions, the reference page
   and the definitions for editors. */
#ifndef JOX_LUA_LANGUAGE_VOCABULARY_H
#define JOX_LUA_LANGUAGE_VOCABULARY_H

#include "lua/language/script.h"

/* What a word's arguments are, a letter each: p place, t target (a place by name, or a target
   value), n number (expression), d plain number, g tag, s name, w the name of
   walls. '?' before a letter: may be left
   out. NULL: a word that is no call; "*": reads its arguments itself. */
typedef struct JoxWord {
    const char *name, *takes;
    JoxNodeKind makes; /* 0: something of the table itself */
    int op;            /* JoxOp, JoxSteerKind or JoxTargetKind */
    int arg;           /* JoxNow */
    const char *signature, *unit, *meaning;
    const char *example; /* an expression of what it makes */
} JoxWord;

extern const JoxWord jox_words[];
extern const size_t jox_word_count;

/* A plain number that a word takes: the letters d of `takes` in their order, and the options of
   orbit. */
typedef struct JoxWordNumber {
    const char *word, *name;
    double least, greatest, standard; /* standard: where it is left out; NAN: it never is */
    const char *unit;
} JoxWordNumber;

extern const JoxWordNumber jox_word_numbers[];
extern const size_t jox_word_number_count;
/* The n-th number of a word, from 0; NULL behind the last. */
const JoxWordNumber *jox_word_number(const char *word, uint32_t n);

/* A key of one of the machine's tables; parameters are further keys of states and of `defaults`. */
typedef struct JoxTableKey {
    const char *owner; /* "machine", "state", "transition", "kick", "throw", "signal" */
    const char *name, *type, *unit, *meaning;
    const char *example;    /* as it stands in its table */
    double least, greatest; /* of plain numbers; both 0: of no number, or checked elsewhere */
} JoxTableKey;

extern const JoxTableKey jox_table_keys[];
extern const size_t jox_table_key_count;

/* Names of an owner's keys, written to `names`; with `parameters` those too. Returns how many. */
size_t jox_table_key_names(const char *owner, bool parameters, const char **names, size_t capacity);

/* Name, unit and range of a key that holds a number. */
JoxParameterInfo jox_table_key_number(const char *owner, const char *name);

/* What `me` knows besides memory and parameters, and what it can be asked to do. */
typedef struct JoxMeKey {
    const char *name, *type, *unit, *meaning;
} JoxMeKey;
extern const JoxMeKey jox_me_keys[];
extern const size_t jox_me_key_count;

#endif
