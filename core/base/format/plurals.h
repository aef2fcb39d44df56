/* Numbers with nouns in the singular or plural ("12 agents"), and articles, for messages. */
#ifndef JOX_BASE_FORMAT_PLURALS_H
#define JOX_BASE_FORMAT_PLURALS_H

#include <stdint.h>

#include "base/text.h"

enum { JOX_NOUN = 96 };

/* Writes a number with a comma at each third digit, "35,000"; returns `out`. */
const char *jox_number_text(char out[JOX_NOUN], uint64_t number);
/* Writes "1 agent" or "12 agents". An irregular plural stands behind a bar: "person|people". A
   result that is too long is cut. Returns `out`, for use as an argument. */
const char *jox_noun(char out[JOX_NOUN], uint64_t number, const char *noun);
/* Appends the same to a text. */
void jox_text_noun(JoxText *text, uint64_t number, const char *noun);
/* Writes the noun alone: "agent" for 1, else "agents". */
const char *jox_noun_alone(char out[JOX_NOUN], uint64_t number, const char *noun);
/* Returns "a" or "an", by the noun's first letter. */
const char *jox_article(const char *noun);

#endif
