/* Numbers with what they count, in the singular or the plural, and articles: for messages. */
#ifndef JOX_BASE_FORMAT_NOUN_H
#define JOX_BASE_FORMAT_NOUN_H

#include <stdint.h>

#include "base/text.h"

enum { JOX_NOUN = 96 };

/* "35,000": a comma at each third digit. */
const char *jox_number_text(char out[JOX_NOUN], uint64_t number);
/* "1 agent", "12 agents"; a noun with another plural has it behind a bar: "person|people". One that
   is too long is cut. Returns `out`, so that it can stand in a call. */
const char *jox_noun(char out[JOX_NOUN], uint64_t number, const char *noun);
/* The same, appended. */
void jox_text_noun(JoxText *text, uint64_t number, const char *noun);
/* The noun alone, in the number's form: "agent" of 1, else "agents". */
const char *jox_noun_alone(char out[JOX_NOUN], uint64_t number, const char *noun);
/* "a" or "an", by the noun's first letter. */
const char *jox_article(const char *noun);

#endif
