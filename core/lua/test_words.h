/* The functions of tests of behaviours (core/luatest) and the methods of a scene, described for the
   reference page and for editors, which are made in this room. core/luatest asserts that it has
   exactly these. */
#ifndef JOX_LUA_TEST_WORDS_H
#define JOX_LUA_TEST_WORDS_H

#include <stddef.h>

typedef struct JoxTestWord {
    const char *name;      /* of a method of a scene: with ":" before it */
    const char *signature; /* "s:count([state [, options]])" */
    const char *types;     /* types of its arguments for lua-language-server, separated by ';' */
    const char *returns;   /* type of its result; "": none */
    const char *meaning;
} JoxTestWord;
extern const JoxTestWord jox_test_words[];
extern const size_t jox_test_word_count;

/* An option of a table that a function of tests takes. */
typedef struct JoxTestOption {
    const char *owner; /* the class of the table: "SceneOptions" */
    const char *name, *type, *meaning;
} JoxTestOption;
extern const JoxTestOption jox_test_options[];
extern const size_t jox_test_option_count;

/* Returns whether there is a row of this name. */
int jox_test_word_is_known(const char *name);

#endif
