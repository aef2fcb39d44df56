/* Words that the program adds to the language of behaviours (jostle_words.h). */
#ifndef JOX_RUN_PROGRAM_WORDS_H
#define JOX_RUN_PROGRAM_WORDS_H

#include "run/run.h"

/* Copies the words of `def` into the scene, and gives them to its scripts and machines, before any
   is loaded. */
void jox_run_set_words(JoScene *scene, const JoSceneDef *def, JoxDiagnostics *diagnostics);
/* Does the actions that agents called for in the step, and reports values that were not finite. */
void jox_run_do_program_acts(JoScene *scene);
void jox_run_free_words(JoScene *scene);

#endif
