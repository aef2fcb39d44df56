/* The answer of the last call, as all files of the WebAssembly module give it. */
#ifndef JOX_WASM_MODULE_H
#define JOX_WASM_MODULE_H

#include "base/text.h"
#include "jostle.h"

/* Marks a function that JavaScript calls. */
#define JOX_MODULE_CALL __attribute__((used, visibility("default")))

/* Makes a text the last answer; the text is empty afterwards. */
void jox_module_answer(JoxText *text);
/* Makes an error the last answer: {"errors": [{...}]}. */
void jox_module_answer_error(const JoError *error);
/* Makes a text of the library the last answer, and owns it. Returns whether there is one. */
bool jox_module_answer_text(char *text);

#endif
