/* Reading JSON that the engine wrote: every number with its path. */
#ifndef JOX_BASE_JSON_H
#define JOX_BASE_JSON_H

#include <stdbool.h>

/* `path`: keys and indices (from 0) joined by dots, as "states.walker.Walk". */
typedef void JoxJsonNumber(void *context, const char *path, double value);

/* Calls `number` for each number of an object, in order. False if the text is no JSON object (what
   came before the mistake has been reported). Escapes in keys are kept as they are. */
bool jox_json_numbers(const char *text, JoxJsonNumber *number, void *context);

#endif
