/* The rule for names that users give to groups, places, regions, states, teams, tags, probes,
   bodies and walls. Such names appear in files, pictures and pages. */
#ifndef JOX_BASE_FORMAT_NAME_H
#define JOX_BASE_FORMAT_NAME_H

#include <stdbool.h>

/* Whether a name follows the rule: letters and marks of any script, digits, spaces, '_', '-' and
   '.', from 1 to 100 bytes of UTF-8, without a space, '-' or '.' at the beginning and a space at
   the end. */
bool jox_name_is_plain(const char *name);
/* Returns whether a state's name is `outer`, or that of a state within an outer state of this name:
   "Guard.Walk" is within "Guard". */
bool jox_name_is_within(const char *name, const char *outer);
/* The rule as a hint in messages. */
#define JOX_NAME_RULE                                                                              \
    "Letters, digits, spaces, _ - and . are allowed (not a space, - or . at the beginning)"

#endif
